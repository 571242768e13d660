"""D1RC-splines: smooth surfaces over triangular control meshes, with sharp edges where they are wanted."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from ._calls import LongCall, ProgressCallback
from ._library import OUT, array, call, indices, lib, made, pointer, read_only
from ._mesh import Mesh
from ._records import by_reference, options
from ._surface import Surface, expect


class D1rcSurface(Surface, kind="d1rc"):
    """A spline over a triangular control mesh: moving a vertex moves the surface around it."""

    @property
    def degree(self) -> int:
        """The degree."""
        return lib.planish_d1rc_degree(self)

    @property
    def control_points(self) -> np.ndarray:
        """The vertices (n, dim) of the control mesh."""
        points = np.empty((self.n_control_points, self.dim))
        call("planish_d1rc_copy_control_points", self, pointer(points), len(points))
        return read_only(points)

    def set_control_points(self, vertices: Any, points: Any) -> None:
        """Moves vertices of the control mesh to points (n, dim)."""
        vertices, points = np.atleast_1d(indices(vertices, what="vertices")), array(points)
        expect(points, (vertices.size, self.dim), "points")
        call("planish_d1rc_set_control_points", self, pointer(vertices), vertices.size, pointer(points))

    @property
    def sharp_edges(self) -> np.ndarray:
        """The sharp edges (n, 2) of the control mesh."""
        count = ctypes.c_size_t()
        lib.planish_d1rc_copy_sharp_edges(self, None, 0, ctypes.byref(count))
        edges = np.empty((count.value, 2), np.uint32)
        call("planish_d1rc_copy_sharp_edges", self, pointer(edges), len(edges), ctypes.byref(count))
        return read_only(edges)

    def set_sharp_edges(self, edges: Any, corners: Any = ()) -> None:
        """Makes these edges (n, 2) of the control mesh sharp and all others smooth; vertices in `corners` are corners."""
        edges = indices(np.reshape(edges, (-1, 2)), 2, "edges")
        corners = indices(np.asarray(corners, np.int64), what="corners")
        call("planish_d1rc_set_sharp_edges", self, pointer(edges), len(edges), pointer(corners), corners.size)

    def edge_continuity(self, edges: Any) -> np.ndarray:
        """How smooth the surface is across each of these edges (n, 2): the order of continuity."""
        edges = indices(np.reshape(edges, (-1, 2)), 2, "edges")
        orders = np.empty(len(edges), np.uint32)
        call("planish_d1rc_edge_continuity", self, pointer(edges), len(edges), pointer(orders))
        return orders

    def influence(self, vertex: int) -> np.ndarray:
        """The triangles of the control mesh on which a vertex moves the surface."""
        count = ctypes.c_size_t()
        lib.planish_d1rc_copy_influence(self, vertex, None, 0, ctypes.byref(count))
        faces = np.empty(count.value, np.uint32)
        call("planish_d1rc_copy_influence", self, vertex, pointer(faces), len(faces), ctypes.byref(count))
        return faces

    def blending_values(self, vertex: int, uv: Any) -> np.ndarray:
        """The values of a vertex's blending function at parameters (..., 2)."""
        uv = array(uv, width=2, what="uv")
        out = np.empty(uv.shape[:-1])
        call("planish_d1rc_blending_values", self, vertex, pointer(uv), out.size, pointer(out))
        return out

    @property
    def knots(self) -> np.ndarray:
        """The knots (n, 2) in the parameter plane; those beyond the control mesh are phantom knots."""
        knots = np.empty((lib.planish_d1rc_knot_count(self), 2))
        call("planish_d1rc_copy_knots", self, pointer(knots), len(knots))
        return read_only(knots)

    @property
    def configurations(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """The knot configurations: their knots, and the edges (n, 2) along which they are cut."""
        return [self._configuration(index) for index in range(lib.planish_d1rc_configuration_count(self))]

    def _configuration(self, index: int) -> tuple[np.ndarray, np.ndarray]:
        count = ctypes.c_size_t()
        knots = np.empty(self.degree + 3, np.uint32)
        lib.planish_d1rc_copy_configuration(self, index, None, None, 0, ctypes.byref(count))
        edges = np.empty((count.value, 2), np.uint32)
        arguments = (self, index, pointer(knots), pointer(edges), len(edges), ctypes.byref(count))
        call("planish_d1rc_copy_configuration", *arguments)
        return knots, edges


def smooth_creased(
    control_mesh: Mesh,
    degree: int = 3,
    *,
    sharp_edges: Any = None,
    progress: ProgressCallback | None = None,
    **d1rc_options: Any,
) -> D1rcSurface:
    """The D1RC-spline over a coarse control mesh: smooth, but for the edges made sharp.

    sharp_edges: (n, 2) nodes; or ``sharp_angle`` in radians finds them.
    """
    long = LongCall(progress)
    filled = long.fields("d1rc_options")
    if sharp_edges is not None:
        edges = indices(sharp_edges, 2, "sharp_edges")
        filled.update(sharp_edges=edges, sharp_edge_count=len(edges))
    record = options("d1rc_options", d1rc_options, degree=degree, **filled)
    return Surface._own(made("planish_d1rc_new", control_mesh, by_reference(record), OUT, run=long)[1])
