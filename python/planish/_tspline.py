"""T-splines with control curves: rows of points, skinned."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any

import numpy as np

from ._curve import Curve
from ._library import OUT, array, call, lib, made, pointer, read_only
from ._surface import Surface


class TSplineSurface(Surface, kind="tspline"):
    """A T-spline surface: B-spline curves along u, each with knots of its own, blended along v."""

    @property
    def curves(self) -> list[Curve]:
        """The control curves, as copies."""
        count = lib.planish_tspline_curve_count(self)
        return [Curve._own(made("planish_tspline_clone_curve", self, curve, OUT)[1]) for curve in range(count)]

    @property
    def knots(self) -> np.ndarray:
        """The knot vector along v."""
        knots = np.empty(lib.planish_tspline_knot_count(self))
        call("planish_tspline_copy_knots", self, pointer(knots), len(knots))
        return read_only(knots)

    def insert_knot_u(self, curve: int, u: float) -> None:
        """Inserts a knot into one control curve; the shape stays."""
        call("planish_tspline_insert_knot_u", self, curve, u)

    def insert_knot_v(self, v: float) -> None:
        """Inserts a knot along v, and with it a control curve; the shape stays."""
        call("planish_tspline_insert_knot_v", self, v)

    def remove_knot_u(self, curve: int, knot: int, tolerance: float) -> float:
        """Removes a knot of one control curve if the surface moves by at most `tolerance`; returns by how much."""
        error = ctypes.c_double()
        call("planish_tspline_remove_knot_u", self, curve, knot, tolerance, ctypes.byref(error))
        return error.value


def tspline(knots: Any, curves: Sequence[Curve]) -> TSplineSurface:
    """The T-spline surface of control curves over a knot vector along v."""
    knots = array(knots)
    handles = (ctypes.c_void_p * len(curves))(*(curve._as_parameter_ for curve in curves))
    arguments = (pointer(knots), len(knots), ctypes.addressof(handles), len(curves), OUT)
    return Surface._own(made("planish_tspline_new", *arguments)[1])
