"""Fits: a mesh, points, a field or rows of points become a smooth surface."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Sequence
from typing import Any

import numpy as np

from ._calls import LongCall, ProgressCallback
from ._curve import Curve
from ._library import OUT, InvalidError, array, made, pointer, read_only
from ._mesh import Mesh, read_mesh
from ._records import Report, by_reference, option_names, options, report_record
from ._surface import Surface

_FAMILIES = ("auto", "tensor", "pht", "d1rc")


def _run(
    function: str,
    record: str,
    data: tuple[Any, ...],
    count: int,
    tolerance: float,
    absolute: bool,
    progress: ProgressCallback | None,
    given: dict[str, Any],
    **filled: Any,
) -> Surface:
    """Calls one of the fits; what it made carries its report, the error and the parameters of each datum."""
    long = LongCall(progress)
    report = report_record("fit_report")
    errors, uv = np.empty(count), np.empty((count, 2))
    filled.update(long.fields(record), out_errors=errors, out_parameters=uv)
    left_out = None
    if "outlier_share" in option_names(record):
        filled["out_left_out"] = left_out = np.zeros(count, np.uint8)
    plane = None
    if given.get("symmetry"):
        filled["out_plane"] = plane = np.zeros(6)
    filled.update(tolerance=tolerance, tolerance_scale="absolute" if absolute else "relative")
    options_record = options(record, given, **filled)
    status, handle = made(function, *data, by_reference(options_record), OUT, by_reference(report), run=long)
    surface = Surface._own(handle, Report(report, status))
    surface.report.errors, surface.report.uv = read_only(errors), read_only(uv)
    if plane is not None:
        surface.report.plane = (read_only(plane[:3]), read_only(plane[3:]))
    if left_out is not None:
        surface.report.left_out = read_only(np.flatnonzero(left_out))
    return surface


def fit(
    mesh: Mesh | str | os.PathLike,
    tolerance: float = 1e-3,
    family: str = "auto",
    *,
    absolute: bool = False,
    progress: ProgressCallback | None = None,
    **fit_options: Any,
) -> Surface:
    """A smooth surface within a tolerance of a mesh (or of the mesh in a file) that one chart can cover.

    tolerance: the largest distance allowed between a node and the surface at the node's parameters, as a fraction of
        the diagonal of the mesh's box, or in its units if `absolute`.
    family: "tensor", what CAD programs take as it is; "pht", refined only where it must be; "d1rc", with sharp edges;
        "auto": "tensor" if it meets the tolerance, else the better of "tensor" and "pht".
    progress: called as ``progress(fraction, error, ...)``; False cancels.
    fit_options: those of the family's record, such as ``smoothing``.

    What single nodes demand: ``fixed`` (numbers of nodes that the surface passes through), ``tolerances`` and ``weights``
    (one for each node; a tolerance of infinity leaves a node out), ``outlier_share`` or ``outlier_scale`` (gross errors are
    found and left out; ``surface.report.left_out`` lists them).
    ``symmetry``: "about" the ``plane`` (a place and a normal, six numbers) or "found" makes the surface its own mirror
    image; ``surface.report.plane`` is the place and the normal.

    A missed tolerance is no exception: ``surface.report.status`` says so, and ``surface.report.errors`` has the error of
    each node. Closed meshes and meshes with handles become solids by `model`.
    """
    if family not in _FAMILIES:
        raise InvalidError(f"family is {family!r}; the choices are {', '.join(map(repr, _FAMILIES))}")
    if not isinstance(mesh, Mesh):
        mesh = read_mesh(mesh)

    def fitted(family: str) -> Surface:
        function, record = f"planish_{family}_fit", f"{family}_options"
        return _run(function, record, (mesh,), mesh.n_points, tolerance, absolute, progress, fit_options)

    if family != "auto":
        return fitted(family)
    surface = fitted("tensor")
    if surface.report.max_error <= surface.report.tolerance:
        return surface
    other = fitted("pht")
    return other if other.report.max_error < surface.report.max_error else surface


def _values(values: Any, count: int) -> tuple[np.ndarray, int]:
    values = array(values, what="values")
    if not count or values.shape[:1] != (count,):
        raise InvalidError(f"values needs {count} rows, its shape is {values.shape}")
    return values, values.size // count


def fit_field(
    mesh: Mesh,
    values: Any,
    tolerance: float = 1e-3,
    family: str = "tensor",
    *,
    absolute: bool = False,
    progress: ProgressCallback | None = None,
    **fit_options: Any,
) -> Surface:
    """A smooth field of values (n,) or (n, dim) on the nodes of a mesh; the tolerance is relative to their box.

    As many rows as the mesh has triangles are taken at their centroids.
    """
    rows = np.shape(values)[:1]
    is_on_triangles = rows == (mesh.n_triangles,) != (mesh.n_points,)
    values, dim = _values(values, mesh.n_triangles if is_on_triangles else mesh.n_points)
    data = (mesh, pointer(values), len(values), dim)
    function, record = f"planish_{_gridded(family)}_fit_field", f"{family}_options"
    return _run(function, record, data, len(values), tolerance, absolute, progress, fit_options)


def fit_points(
    uv: Any,
    values: Any,
    tolerance: float = 1e-3,
    family: str = "tensor",
    *,
    absolute: bool = False,
    progress: ProgressCallback | None = None,
    **fit_options: Any,
) -> Surface:
    """A smooth surface of values (n,) or (n, dim) at scattered parameters uv (n, 2)."""
    uv = array(uv, width=2, what="uv")
    values, dim = _values(values, len(uv))
    data = (pointer(uv), pointer(values), len(uv), dim)
    function, record = f"planish_{_gridded(family)}_fit_points", f"{family}_options"
    return _run(function, record, data, len(uv), tolerance, absolute, progress, fit_options)


def _gridded(family: str) -> str:
    if family not in ("tensor", "pht"):
        raise InvalidError(f"family is {family!r}; the choices are 'tensor', 'pht'")
    return family


def skin(
    rows: Sequence[Any],
    tolerance: float = 1e-3,
    *,
    absolute: bool = False,
    progress: ProgressCallback | None = None,
    **skin_options: Any,
) -> Surface:
    """A T-spline through rows (n_k, dim) of points, each with a count of its own; `report.skin` tells more."""
    rows = [array(row, what=f"row {number}") for number, row in enumerate(rows)]
    if not rows or any(row.ndim != 2 or row.shape[1] != rows[0].shape[1] for row in rows):
        raise InvalidError(f"rows need the shape (n, dim) with one dim, they have {[row.shape for row in rows]}")
    points, counts = np.concatenate(rows), np.array([len(row) for row in rows], np.uintp)
    skin_report = report_record("skin_report")
    surface = _run(
        "planish_tspline_skin",
        "skin_options",
        (pointer(points), pointer(counts), len(rows)),
        *(len(points), tolerance, absolute, progress, skin_options),
        dim=points.shape[1],
        out_report=skin_report,
    )
    surface.report.skin = Report(skin_report)
    return surface


def skin_curves(
    curves: Sequence[Curve],
    tolerance: float = 1e-3,
    *,
    absolute: bool = False,
    progress: ProgressCallback | None = None,
    **skin_options: Any,
) -> Surface:
    """A T-spline through curves."""
    handles = (ctypes.c_void_p * len(curves))(*(curve._as_parameter_ for curve in curves))
    long, report = LongCall(progress), report_record("fit_report")
    filled = dict(
        long.fields("skin_options"), tolerance=tolerance, tolerance_scale="absolute" if absolute else "relative"
    )
    record = options("skin_options", skin_options, **filled)
    arguments = (ctypes.addressof(handles), len(curves), by_reference(record), OUT, by_reference(report))
    status, handle = made("planish_tspline_skin_curves", *arguments, run=long)
    return Surface._own(handle, Report(report, status))
