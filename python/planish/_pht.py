"""PHT-splines: C1 bicubic surfaces over hierarchical T-meshes, refined only where they must be."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np

from . import _abi
from ._calls import LongCall, ProgressCallback
from ._library import OUT, InvalidError, array, call, indices, lib, made, pointer, read_only
from ._records import by_reference, options
from ._surface import Surface, expect
from ._tensor import TensorSurface

_BASES = _abi.ENUMERATIONS["planish_pht_basis"]
#: What numbers of cells and vertices are made of.
_NUMBER = _abi.ELEMENTS["planish_pht_set_data", "vertices"]
_SIDES = _abi.ENUMERATIONS["planish_border_side"]


class Extraction(NamedTuple):
    """How the control points of some basis vertices make the Bezier ordinates of one cell: ordinates = matrix @ points."""

    vertices: np.ndarray
    matrix: np.ndarray


class PhtSurface(Surface, kind="pht"):
    """A PHT-spline surface: data (value, both first derivatives, the mixed one) at the basis vertices of a T-mesh.

    A rational surface keeps the data of (w x, .., w): its `width` is dim + 1.
    """

    @property
    def width(self) -> int:
        """Numbers in a row of data: dim, or dim + 1 of a rational surface."""
        return lib.planish_pht_width(self)

    @property
    def cells(self) -> np.ndarray:
        """The leaves (level, i, j) of the T-mesh."""
        cells = np.empty((lib.planish_pht_cell_count(self), 3), np.uint32)
        call("planish_pht_copy_cells", self, pointer(cells), len(cells))
        return read_only(cells)

    @property
    def vertices(self) -> np.ndarray:
        """The parameters (n, 2) of the basis vertices."""
        vertices = np.empty((lib.planish_pht_vertex_count(self), 2))
        call("planish_pht_copy_vertices", self, pointer(vertices), len(vertices))
        return read_only(vertices)

    @property
    def hanging_vertices(self) -> tuple[np.ndarray, np.ndarray]:
        """The parameters (n, 2) of the T-vertices, and the number of the leaf that hosts each."""
        count = lib.planish_pht_hanging_count(self)
        uv, hosts = np.empty((count, 2)), np.empty(count, np.uint32)
        call("planish_pht_copy_hanging", self, pointer(uv), pointer(hosts), count)
        return read_only(uv), read_only(hosts)

    def cell_at(self, u: float, v: float) -> int:
        """The number of the leaf at (u,v)."""
        return lib.planish_pht_cell_at(self, u, v)

    def neighbours(self, cell: int) -> np.ndarray:
        """The numbers of the leaves that share part of an edge with a leaf."""
        count = ctypes.c_size_t()
        lib.planish_pht_copy_neighbours(self, cell, None, 0, ctypes.byref(count))
        cells = np.empty(count.value, _NUMBER)
        call("planish_pht_copy_neighbours", self, cell, pointer(cells), len(cells), ctypes.byref(count))
        return cells

    @property
    def vertex_data(self) -> np.ndarray:
        """Value, both first derivatives and the mixed one at the basis vertices: (n, 4, width)."""
        data = np.empty((lib.planish_pht_vertex_count(self), 4, self.width))
        call("planish_pht_copy_data", self, pointer(data), len(data))
        return read_only(data)

    def set_vertex_data(self, vertices: Any, data: Any) -> None:
        """Changes the data (n, 4, width) at basis vertices, by number."""
        vertices, data = _numbers(vertices), array(data)
        expect(data, (len(vertices), 4, self.width), "data")
        call("planish_pht_set_data", self, pointer(vertices), len(vertices), pointer(data))

    @property
    def control_points(self) -> np.ndarray:
        """The four control points of each basis vertex: (n, 4, width), in the basis of the paper."""
        return self.control_points_in("canonical")

    def control_points_in(self, basis: str) -> np.ndarray:
        """The same in the basis "canonical" (of the paper) or "support_sized" (better conditioned)."""
        points = np.empty((lib.planish_pht_vertex_count(self), 4, self.width))
        call("planish_pht_copy_control_points", self, _word(_BASES, basis, "basis"), pointer(points), len(points))
        return read_only(points)

    def set_control_points(self, vertices: Any, points: Any, basis: str = "canonical") -> None:
        """Changes all four control points (n, 4, width) of basis vertices, by number."""
        vertices, points = _numbers(vertices), array(points)
        expect(points, (len(vertices), 4, self.width), "points")
        number = _word(_BASES, basis, "basis")
        call("planish_pht_set_control_points", self, pointer(vertices), len(vertices), number, pointer(points))

    def extraction(self, cell: int, basis: str = "canonical") -> Extraction:
        """How control points make the 4 x 4 Bezier ordinates of a leaf: vertices (n,) and matrix (16, 4 n)."""
        number, count = _word(_BASES, basis, "basis"), ctypes.c_size_t()
        lib.planish_pht_copy_extraction(self, cell, number, None, None, 0, ctypes.byref(count))
        vertices, matrix = np.empty(count.value, np.uint32), np.empty((16, 4 * count.value))
        arguments = (self, cell, number, pointer(vertices), pointer(matrix), len(vertices), ctypes.byref(count))
        call("planish_pht_copy_extraction", *arguments)
        return Extraction(vertices, matrix)

    def split_cells(self, cells: Any) -> None:
        """Splits leaves (level, i, j) in four; the shape stays."""
        cells = np.atleast_2d(indices(cells, 3, "cells"))
        call("planish_pht_split", self, pointer(cells), len(cells))

    def merge_cells(self, cells: Any) -> None:
        """Merges the four children of cells (level, i, j); the exact inverse of splitting them."""
        cells = np.atleast_2d(indices(cells, 3, "cells"))
        call("planish_pht_merge", self, pointer(cells), len(cells))

    def refine_region(self, region: Any, level: int, max_cells: int = 1_000_000) -> None:
        """Splits the leaves in (u0, u1, v0, v1) down to a level; the shape stays."""
        region = array(region)
        expect(region, (4,), "region")
        call("planish_pht_refine_region", self, pointer(region), level, max_cells)

    def simplify(self, tolerance: float, *, progress: ProgressCallback | None = None) -> float:
        """Merges cells where the surface moves by at most `tolerance`, in its units; returns a bound of how far it did."""
        long = LongCall(progress)
        record = options("pht_simplify_options", **long.fields("pht_simplify_options"))
        deviation = ctypes.c_double()
        long("planish_pht_simplify", self, tolerance, by_reference(record), ctypes.byref(deviation))
        return deviation.value

    def to_tensor_patches(self, level_spread: int = 1) -> list[TensorSurface]:
        """The same shape as few tensor product surfaces, each over cells whose levels differ by at most `level_spread`."""
        count, long = ctypes.c_size_t(), LongCall()
        record = options("pht_patches_options", level_spread=level_spread, **long.fields("pht_patches_options"))
        long("planish_pht_to_tensor_patches", self, by_reference(record), None, 0, ctypes.byref(count))
        handles = (ctypes.c_void_p * count.value)()
        arguments = (self, by_reference(record), ctypes.addressof(handles), len(handles), ctypes.byref(count))
        long("planish_pht_to_tensor_patches", *arguments)
        return [Surface._own(ctypes.c_void_p(handle)) for handle in handles]

    def stitch(self, side: str, other: PhtSurface, other_side: str, *, reversed: bool = False) -> None:
        """Joins sides ("low_u", "high_u", "low_v", "high_v") of two surfaces smoothly; both change."""
        sides = _word(_SIDES, side, "side"), _word(_SIDES, other_side, "other_side")
        call("planish_pht_stitch", self, sides[0], other, sides[1], int(reversed))


def pht(
    lines_u: Any, lines_v: Any, splits: Any, data: Any, *, is_rational: bool = False
) -> PhtSurface:
    """A PHT-spline over the grid of `lines_u` and `lines_v`, its cells (level, i, j) in `splits` split in that order.

    data: (n, 4, width) at the basis vertices: value, both first derivatives, the mixed one.
    """
    lines_u, lines_v = array(lines_u), array(lines_v)
    splits = indices(np.reshape(splits, (-1, 3)), 3, "splits")
    data = array(data)
    if data.ndim != 3 or data.shape[1] != 4:
        expect(data, (len(data), 4, data.shape[-1] if data.ndim else 1), "data")
    dim = data.shape[2] - int(is_rational)
    arguments = (dim, int(is_rational), pointer(lines_u), len(lines_u), pointer(lines_v), len(lines_v))
    rest = (pointer(splits), len(splits), pointer(data), data.size, OUT)
    return Surface._own(made("planish_pht_new", *arguments, *rest)[1])


def pht_from_surface(
    surface: Surface, *, progress: ProgressCallback | None = None, **convert_options: Any
) -> PhtSurface:
    """A PHT-spline within a tolerance of another surface; exact where that is bicubic and C1."""
    long = LongCall(progress)
    record = options("pht_convert_options", convert_options, **long.fields("pht_convert_options"))
    arguments = ("planish_pht_from_surface", surface, by_reference(record), OUT)
    return Surface._own(made(*arguments, run=long)[1], surface.report)


def _word(words: dict[str, int], word: str, what: str) -> int:
    if word not in words:
        raise InvalidError(f"{what} is {word!r}; the choices are {', '.join(map(repr, words))}")
    return words[word]


def _numbers(values: Any) -> np.ndarray:
    return np.atleast_1d(array(indices(values, what="vertices"), _NUMBER))
