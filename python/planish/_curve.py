"""B-spline curves."""

from __future__ import annotations

import ctypes
import os
from typing import Any

import numpy as np

from ._calls import LongCall, ProgressCallback
from ._library import OUT, Handle, InvalidError, array, call, lib, made, path_of, pointer, read_only
from ._records import Report, by_reference, options, report_record


class Curve(Handle):
    """A map from an interval of parameters u to R^dim. ``curve(u)`` returns values of shape (..., dim)."""

    _free = "planish_curve_free"
    report: Report | None = None

    def __init__(self, knots: Any, control_points: Any):
        points, knots = array(control_points), array(knots)
        if points.ndim == 1:
            points = points[:, None]
        degree = len(knots) - len(points) - 1
        if points.ndim != 2 or degree < 0:
            raise InvalidError(f"control_points needs the shape (n, dim) with n < len(knots), it has {points.shape}")
        arguments = (points.shape[1], degree, pointer(knots), len(knots), pointer(points), OUT)
        super().__init__(made("planish_curve_new", *arguments)[1])

    @property
    def dim(self) -> int:
        """Components of a value."""
        return lib.planish_curve_dim(self)

    @property
    def degree(self) -> int:
        """The degree."""
        return lib.planish_curve_degree(self)

    @property
    def domain(self) -> tuple[float, float]:
        """(u0, u1): where the curve is defined."""
        interval = (ctypes.c_double * 2)()
        call("planish_curve_domain", self, ctypes.addressof(interval))
        return tuple(interval)

    @property
    def knots(self) -> np.ndarray:
        """The knot vector with all multiplicities."""
        knots = np.empty(lib.planish_curve_knot_count(self))
        call("planish_curve_copy_knots", self, pointer(knots), len(knots))
        return read_only(knots)

    @property
    def control_points(self) -> np.ndarray:
        """Control points (n, dim)."""
        points = np.empty((lib.planish_curve_control_point_count(self), self.dim))
        call("planish_curve_copy_control_points", self, pointer(points), len(points))
        return read_only(points)

    def derivatives(self, u: Any, order: int = 1, **eval_options: Any) -> np.ndarray:
        """Value and derivatives up to `order` (at most 2) at parameters (...): an array (..., order + 1, dim)."""
        u = array(u)
        out = np.empty(u.shape + (order + 1, self.dim))
        record = by_reference(options("eval_options", eval_options))
        call("planish_curve_eval", self, pointer(u), u.size, order, record, pointer(out))
        return out

    def __call__(self, u: Any, **eval_options: Any) -> np.ndarray:
        return self.derivatives(u, 0, **eval_options)[..., 0, :]

    def length(self) -> float:
        """The length of the whole curve."""
        return lib.planish_curve_length(self)

    def arc_lengths(self, u: Any) -> np.ndarray:
        """Lengths from the start of the curve to each of `u`."""
        u = array(u)
        out = np.empty(u.shape)
        call("planish_curve_arc_lengths", self, pointer(u), u.size, pointer(out))
        return out

    def project(
        self, points: Any, *, progress: ProgressCallback | None = None, **project_options: Any
    ) -> tuple[np.ndarray, np.ndarray]:
        """The closest places to points (..., dim): their parameters and distances."""
        points = array(points, width=self.dim, what="points")
        u, distances = np.empty(points.shape[:-1]), np.empty(points.shape[:-1])
        long = LongCall(progress)
        record = by_reference(options("project_options", project_options, **long.fields("project_options")))
        long("planish_curve_project", self, pointer(points), u.size, record, pointer(u), pointer(distances))
        return u, distances

    def save(self, path: str | os.PathLike) -> None:
        """Saves to a file in the library's own format; `load_curve` reads it."""
        call("planish_curve_save_file", self, path_of(path))

    def tobytes(self) -> bytes:
        """What `save` would write."""
        buffer = ctypes.create_string_buffer(lib.planish_curve_save_size(self))
        call("planish_curve_save", self, ctypes.addressof(buffer), len(buffer))
        return buffer.raw

    def __reduce__(self) -> tuple[Any, ...]:
        return _restore, (self.tobytes(), self.report)

    def __copy__(self) -> Curve:
        clone = Curve._own(made("planish_curve_clone", self, OUT)[1])
        clone.report = self.report
        return clone

    def __deepcopy__(self, _: Any) -> Curve:
        return self.__copy__()

    def __repr__(self) -> str:
        if not self._handle:
            return "<planish.Curve: closed>"
        count = lib.planish_curve_control_point_count(self)
        return f"<planish.Curve: degree {self.degree}, dim {self.dim}, {count} control points>"


def _restore(saved: bytes, report: Report | None) -> Curve:
    curve = Curve._own(made("planish_curve_load", saved, len(saved), OUT)[1])
    curve.report = report
    return curve


def load_curve(path: str | os.PathLike) -> Curve:
    """Loads a curve that `Curve.save` or any other binding has saved."""
    return Curve._own(made("planish_curve_load_file", path_of(path), OUT)[1])


def interpolate_curve(u: Any, values: Any, **interpolate_options: Any) -> Curve:
    """The curve through values (n, dim) at increasing parameters u (n,)."""
    u, values = _data(u, values)
    record = by_reference(options("interpolate_options", interpolate_options))
    arguments = (pointer(u), pointer(values), len(u), values.size // len(u), record, OUT)
    return Curve._own(made("planish_curve_interpolate", *arguments)[1])


def fit_curve(
    u: Any,
    values: Any,
    tolerance: float = 1e-3,
    *,
    absolute: bool = False,
    progress: ProgressCallback | None = None,
    **curve_options: Any,
) -> Curve:
    """A smooth curve within a tolerance of values (n, dim) at parameters u (n,); `report` tells how well."""
    u, values = _data(u, values)
    long = LongCall(progress)
    errors = np.empty(len(u))
    report = report_record("fit_report")
    scale = "absolute" if absolute else "relative"
    filled = dict(long.fields("curve_options"), tolerance=tolerance, tolerance_scale=scale, out_errors=errors)
    record = options("curve_options", curve_options, **filled)
    status, handle = made(
        "planish_curve_fit",
        *(pointer(u), pointer(values), len(u), values.size // len(u), by_reference(record), OUT),
        by_reference(report),
        run=long,
    )
    curve = Curve._own(handle)
    curve.report = Report(report, status)
    curve.report.errors = read_only(errors)
    return curve


def _data(u: Any, values: Any) -> tuple[np.ndarray, np.ndarray]:
    u, values = array(u), array(values)
    if u.ndim != 1 or not u.size or values.shape[:1] != u.shape:
        raise InvalidError(f"u needs the shape (n,) and values (n, dim), they have {u.shape} and {values.shape}")
    return u, values
