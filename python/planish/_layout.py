"""Quad layouts: the patches over which models are made."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._calls import LongCall, ProgressCallback
from ._library import OUT, Handle, call, indices, lib, made, pointer, read_only
from ._mesh import Mesh
from ._records import Report, by_reference, options, report_record


class Layout(Handle):
    """Quadrilaterals that share edges and vertices. ``Layout(corners)``, `Layout.cube`, or `Layout.of_mesh`.

    corners: (n, 4) numbers of vertices, counterclockwise.
    """

    _free = "planish_layout_free"
    report: Report | None = None

    def __init__(self, corners: Any, **layout_options: Any):
        corners = indices(corners, 4, "corners")
        record = options("layout_options", layout_options)
        arguments = (pointer(corners), len(corners), by_reference(record), OUT)
        super().__init__(made("planish_layout_new", *arguments)[1])

    @classmethod
    def cube(cls) -> Layout:
        """The six faces of a cube."""
        return cls._own(made("planish_layout_cube", OUT)[1])

    @classmethod
    def of_mesh(cls, mesh: Mesh, *, progress: ProgressCallback | None = None, **mesh_layout_options: Any) -> Layout:
        """A layout over a mesh, with the place of every node; `report` tells how even it is."""
        long, report = LongCall(progress), report_record("mesh_layout_report")
        record = options("mesh_layout_options", mesh_layout_options, **long.fields("mesh_layout_options"))
        arguments = ("planish_layout_of_mesh", mesh, by_reference(record), OUT, by_reference(report))
        status, handle = made(*arguments, run=long)
        layout = cls._own(handle)
        layout.report = Report(report, status)
        return layout

    @property
    def n_vertices(self) -> int:
        """Number of vertices."""
        return lib.planish_layout_vertex_count(self)

    @property
    def corners(self) -> np.ndarray:
        """The vertices (n, 4) of each quad, counterclockwise."""
        corners = np.empty((lib.planish_layout_quad_count(self), 4), np.uint32)
        call("planish_layout_copy_corners", self, pointer(corners), len(corners))
        return read_only(corners)

    @property
    def edges(self) -> np.ndarray:
        """Six numbers for each edge: what they are stands with `planish_layout_copy_edges`."""
        edges = np.empty((lib.planish_layout_edge_count(self), 6), np.uint32)
        call("planish_layout_copy_edges", self, pointer(edges), len(edges))
        return read_only(edges)

    @property
    def valences(self) -> np.ndarray:
        """How many quads meet at each vertex."""
        valences = np.empty(self.n_vertices, np.uint32)
        call("planish_layout_copy_valences", self, pointer(valences), len(valences))
        return read_only(valences)

    @property
    def node_map(self) -> tuple[np.ndarray, np.ndarray]:
        """For each node of the mesh its quad and its place (n, 2) there, both from 0 to 1; empty without a mesh."""
        count = lib.planish_layout_node_count(self)
        quads, uv = np.empty(count, np.uint32), np.empty((count, 2))
        if count:
            call("planish_layout_copy_node_map", self, pointer(quads), pointer(uv), count)
        return read_only(quads), read_only(uv)

    def __repr__(self) -> str:
        if not self._handle:
            return "<planish.Layout: closed>"
        return f"<planish.Layout: {len(self.corners)} quads, {self.n_vertices} vertices>"
