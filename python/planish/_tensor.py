"""Tensor product B-splines."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any

import numpy as np

from ._library import OUT, InvalidError, array, call, lib, made, pointer, read_only
from ._surface import Surface, expect


class TensorSurface(Surface, kind="tensor"):
    """A tensor product B-spline surface, perhaps rational."""

    @property
    def degrees(self) -> tuple[int, int]:
        """Degrees along u and v."""
        return lib.planish_tensor_degree(self, 0), lib.planish_tensor_degree(self, 1)

    @property
    def knots(self) -> tuple[np.ndarray, np.ndarray]:
        """Knot vectors along u and v with all multiplicities."""
        return self._knots_along(0), self._knots_along(1)

    def _knots_along(self, axis: int) -> np.ndarray:
        knots = np.empty(lib.planish_tensor_knot_count(self, axis))
        call("planish_tensor_copy_knots", self, axis, pointer(knots), len(knots))
        return read_only(knots)

    def _net_shape(self) -> tuple[int, int]:
        return lib.planish_tensor_control_point_count(self, 0), lib.planish_tensor_control_point_count(self, 1)

    @property
    def control_points(self) -> np.ndarray:
        """Control points (n_u, n_v, dim), not multiplied by weights."""
        points = np.empty((*self._net_shape(), self.dim))
        call("planish_tensor_copy_control_points", self, pointer(points), points.size // self.dim)
        return read_only(points)

    @property
    def weights(self) -> np.ndarray | None:
        """Weights (n_u, n_v) of a rational surface, else None."""
        if not lib.planish_tensor_has_weights(self):
            return None
        weights = np.empty(self._net_shape())
        call("planish_tensor_copy_weights", self, pointer(weights), weights.size)
        return read_only(weights)

    def insert_knots(self, axis: int, knots: Any) -> None:
        """Inserts knots along u (axis 0) or v (axis 1); the shape stays."""
        knots = np.atleast_1d(array(knots))
        call("planish_tensor_insert_knots", self, axis, pointer(knots), knots.size)

    def elevate_degree(self, axis: int, degree: int) -> None:
        """Raises the degree along u (axis 0) or v (axis 1) to `degree`; the shape stays."""
        call("planish_tensor_elevate_degree", self, axis, degree)

    def reverse(self, axis: int) -> None:
        """Runs the parameter along u (axis 0) or v (axis 1) the other way."""
        call("planish_tensor_reverse", self, axis)

    def split(self, axis: int, at: float) -> tuple[TensorSurface, TensorSurface]:
        """The parts below and above the parameter `at` along u (axis 0) or v (axis 1)."""
        lower, upper = ctypes.c_void_p(), ctypes.c_void_p()
        call("planish_tensor_split", self, axis, at, ctypes.byref(lower), ctypes.byref(upper))
        return Surface._own(lower), Surface._own(upper)

    # neighbours: imported only when asked for

    @classmethod
    def from_scipy(cls, spline: Any) -> TensorSurface:
        """From a `scipy.interpolate.RectBivariateSpline` or another that has `tck` and `degrees`."""
        knots_u, knots_v, coefficients = spline.tck
        degrees = spline.degrees
        shape = tuple(len(knots) - degree - 1 for knots, degree in zip((knots_u, knots_v), degrees))
        return tensor(knots_u, knots_v, np.reshape(coefficients, (*shape, 1)), degrees=degrees)

    def to_scipy(self) -> Any:
        """A scalar polynomial surface as a spline of scipy.interpolate, evaluated by its `ev`."""
        from scipy.interpolate import BivariateSpline

        if self.dim != 1 or self.weights is not None:
            raise InvalidError("scipy's surfaces are scalar and polynomial")
        spline = BivariateSpline()
        spline.tck = (*self.knots, self.control_points.ravel())
        spline.degrees = self.degrees
        return spline


def tensor(
    knots_u: Any,
    knots_v: Any,
    control_points: Any,
    weights: Any = None,
    *,
    degrees: Sequence[int] | None = None,
) -> TensorSurface:
    """A tensor product B-spline, rational with `weights` (n_u, n_v).

    control_points: (n_u, n_v, dim), or (n_u, n_v) for a scalar.
    degrees: along u and v; by default what the counts of knots and control points say.
    """
    points, knots_u, knots_v = array(control_points), array(knots_u), array(knots_v)
    if points.ndim == 2:
        points = points[..., None]
    if points.ndim != 3:
        raise InvalidError(f"control_points needs the shape (n_u, n_v, dim), it has {points.shape}")
    said = (len(knots_u) - points.shape[0] - 1, len(knots_v) - points.shape[1] - 1)
    degrees = said if degrees is None else tuple(degrees)
    if degrees != said or min(said) < 0:
        raise InvalidError(f"degrees {degrees} do not belong to knots and control points, which say {said}")
    if weights is not None:
        weights = array(weights)
        expect(weights, points.shape[:2], "weights")
    arguments = (points.shape[2], *degrees, pointer(knots_u), len(knots_u), pointer(knots_v), len(knots_v))
    return Surface._own(made("planish_tensor_new", *arguments, pointer(points), pointer(weights), OUT)[1])


def combine(surfaces: Sequence[TensorSurface], factors: Any) -> TensorSurface:
    """sum_k factors[k] surfaces[k] of surfaces over the same knots: morphing, time steps."""
    factors = array(factors)
    expect(factors, (len(surfaces),), "factors")
    handles = (ctypes.c_void_p * len(surfaces))(*(surface._as_parameter_ for surface in surfaces))
    arguments = (ctypes.addressof(handles), pointer(factors), len(surfaces), OUT)
    return Surface._own(made("planish_tensor_combine", *arguments)[1])
