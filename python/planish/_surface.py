"""Spline surfaces of every family."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from . import _abi
from ._calls import LongCall, ProgressCallback
from ._curve import Curve
from ._library import (
    OUT,
    Handle,
    InvalidError,
    argument,
    array,
    call,
    failure,
    lib,
    made,
    output,
    path_of,
    pointer,
    read_only,
    text_of,
)
from ._mesh import Mesh
from ._records import Report, by_reference, options, report_record

_KINDS = {number: word for word, number in _abi.ENUMERATIONS["planish_kind"].items()}
_DOUBLE = np.dtype(np.float64)
#: So many numbers are sooner copied than pointed at.
_FEW = 64
#: Rows that a point takes with all derivatives up to 0, 1 and 2: S; Su, Sv; Suu, Suv, Svv.
_ROWS = {(0, 0): 0, (1, 0): 1, (0, 1): 2, (2, 0): 3, (1, 1): 4, (0, 2): 5}


class Curvatures(NamedTuple):
    """Principal curvatures, k1 >= k2, and their unit directions in space."""

    k1: np.ndarray
    k2: np.ndarray
    d1: np.ndarray
    d2: np.ndarray


class BezierPatch(NamedTuple):
    """One polynomial piece: where it lies in the parameter plane, and its control points (degree_u + 1, degree_v + 1, d)."""

    domain: tuple[float, float, float, float]
    control_points: np.ndarray
    weights: np.ndarray | None


class Surface(Handle):
    """A map from a rectangle of parameters (u,v) to R^dim. Made by `fit` and its kind, by `tensor`, and by `load`.

    ``surface(u, v)`` broadcasts its arguments and returns values of shape (..., dim). Attribute ``report`` tells how a
    fit went; None for surfaces that no fit made.
    """

    _free = "planish_surface_free"
    report: Report | None = None
    #: Kept for `eval`, once it is known: it never changes.
    _dim = 0
    #: The class of each family.
    _families: dict[str, type[Surface]] = {}

    def __init_subclass__(cls, kind: str):
        cls._families[kind] = cls

    @classmethod
    def _own(cls, handle: ctypes.c_void_p, report: Report | None = None) -> Any:
        """The surface behind a handle, as its family."""
        kind = _KINDS[lib.planish_surface_kind(handle)]
        surface = super()._own.__func__(cls._families.get(kind, Surface), handle)
        surface.report = report
        return surface

    @property
    def kind(self) -> str:
        """The family: "tensor", "tspline", "pht" or "d1rc"."""
        return _KINDS[lib.planish_surface_kind(self)]

    @property
    def dim(self) -> int:
        """Components of a value: 3 for a shape, 1 for a scalar field."""
        self._dim = lib.planish_surface_dim(self)
        return self._dim

    @property
    def n_control_points(self) -> int:
        """Number of control points."""
        return lib.planish_surface_coefficient_count(self)

    def _box(self, function: str) -> tuple[float, float, float, float]:
        box = (ctypes.c_double * 4)()
        call(function, self, ctypes.addressof(box))
        return tuple(box)

    @property
    def domain(self) -> tuple[float, float, float, float]:
        """(u0, u1, v0, v1): where the surface is defined."""
        return self._box("planish_surface_domain")

    @property
    def name(self) -> str:
        """What the surface is called, in copies and saved files too; empty without a name. Can be set."""
        return text_of("planish_surface_name", self)

    @name.setter
    def name(self, name: str) -> None:
        call("planish_surface_set_name", self, name.encode())

    @property
    def unit(self) -> str:
        """What one unit is: "millimetre", "metre" or "inch". Can be set, which changes no number."""
        number = lib.planish_surface_unit(self)
        return next(word for word, of in _abi.ENUMERATIONS["planish_unit"].items() if of == number)

    @unit.setter
    def unit(self, unit: str) -> None:
        units = _abi.ENUMERATIONS["planish_unit"]
        if unit not in units:
            raise InvalidError(f"unit is {unit!r}; the choices are {', '.join(map(repr, units))}")
        call("planish_surface_set_unit", self, units[unit])

    @property
    def box(self) -> np.ndarray:
        """The box of the surface over its whole domain, (2, dim): the least of each component, then the largest."""
        box = np.empty((2, self.dim))
        call("planish_surface_box", self, pointer(box))
        return box

    def area(self, *, progress: ProgressCallback | None = None, **tessellate_options: Any) -> float:
        """The area of the part inside the trims, in squares of model units; options say how finely it is divided."""
        long = LongCall(progress)
        record = options("tessellate_options", tessellate_options, **long.fields("tessellate_options"))
        area = ctypes.c_double()
        long("planish_surface_area", self, by_reference(record), ctypes.byref(area))
        return area.value

    def is_closed(self, axis: str) -> bool:
        """Whether the two sides of the domain that bound an axis, "u" or "v", are one curve."""
        axes = _abi.ENUMERATIONS["planish_axis"]
        if axis not in axes:
            raise InvalidError(f"axis is {axis!r}; the choices are 'u', 'v'")
        return bool(lib.planish_surface_is_closed(self, axes[axis]))

    @property
    def data_box(self) -> tuple[float, float, float, float]:
        """(u0, u1, v0, v1): the box of the data's parameters, which may be smaller than the domain."""
        return self._box("planish_surface_data_box")

    # evaluation

    def __call__(self, u: Any, v: Any, **eval_options: Any) -> np.ndarray:
        """Values at (u,v); u and v broadcast, the components are the last axis."""
        return self.eval(_pairs(u, v), **eval_options)

    def eval(self, uv: Any, out: np.ndarray | None = None, **eval_options: Any) -> np.ndarray:
        """Values at parameters of shape (..., 2): an array of shape (..., dim), `out` if given.

        eval_options: ``outside`` is "fail" (the default: a ValueError), "flag" (NaN) or "extrapolate"; ``thread_count``.
        """
        # each step of this costs a tenth of the call for one point
        if type(uv) is not np.ndarray or uv.dtype is not _DOUBLE or not uv.flags.carray:
            uv = array(uv)
        shape = uv.shape
        if not shape or shape[-1] != 2:
            raise InvalidError(f"uv needs rows of 2 numbers, its shape is {shape}")
        wanted = shape[:-1] + (self._dim or self.dim,)
        if out is None:
            out = np.empty(wanted)
        elif out.dtype is not _DOUBLE or out.shape != wanted or not out.flags.carray:
            out = output(out, wanted)
        record = by_reference(options("eval_options", eval_options)) if eval_options else None
        size = uv.size
        given = uv.tobytes() if size <= _FEW else argument(uv)
        handle = self._handle or self._as_parameter_  # which says that it is closed
        status = lib.planish_surface_eval(handle, given, size // 2, record, argument(out))
        if status < 0:
            raise failure(status)
        return out

    def ev(self, u: Any, v: Any, du: int = 0, dv: int = 0, **eval_options: Any) -> np.ndarray:
        """A derivative at (u,v), as scipy's `ev`: du + dv at most 2. A scalar field gives values without a last axis."""
        if (du, dv) not in _ROWS:
            raise InvalidError(f"derivatives up to order 2 are known, got du = {du}, dv = {dv}")
        uv = _pairs(u, v)
        if du + dv == 0:
            values = self.eval(uv, **eval_options)
        else:
            values = self.derivatives(uv, du + dv, **eval_options)[..., _ROWS[du, dv], :]
        return values[..., 0] if self.dim == 1 else values

    def derivatives(self, uv: Any, order: int = 1, **eval_options: Any) -> np.ndarray:
        """S, Su, Sv, Suu, Suv, Svv up to `order` at parameters (..., 2): an array (..., rows, dim)."""
        uv = array(uv, width=2, what="uv")
        out = np.empty(uv.shape[:-1] + ((order + 1) * (order + 2) // 2, self.dim))
        record = by_reference(options("eval_options", eval_options))
        call("planish_surface_eval_derivatives", self, pointer(uv), uv.size // 2, order, record, pointer(out))
        return out

    def grid(self, u: Any, v: Any, **eval_options: Any) -> np.ndarray:
        """Values at all pairs of `u` and `v`: an array (len(u), len(v), dim)."""
        u, v = array(u), array(v)
        out = np.empty((u.size, v.size, self.dim))
        record = by_reference(options("eval_options", eval_options))
        call("planish_surface_eval_grid", self, pointer(u), u.size, pointer(v), v.size, record, pointer(out))
        return out

    def normals(self, uv: Any, **eval_options: Any) -> np.ndarray:
        """Unit normals at parameters (..., 2); of surfaces in space."""
        uv = array(uv, width=2, what="uv")
        out = np.empty(uv.shape[:-1] + (3,))
        record = by_reference(options("eval_options", eval_options))
        call("planish_surface_normals", self, pointer(uv), uv.size // 2, record, pointer(out))
        return out

    def curvatures(self, uv: Any, **eval_options: Any) -> Curvatures:
        """Principal curvatures (in 1 / length) and their directions at parameters (..., 2); of surfaces in space."""
        uv = array(uv, width=2, what="uv")
        out = np.empty(uv.shape[:-1] + (8,))
        record = by_reference(options("eval_options", eval_options))
        call("planish_surface_curvatures", self, pointer(uv), uv.size // 2, record, pointer(out))
        return Curvatures(out[..., 0], out[..., 1], out[..., 2:5], out[..., 5:])

    # queries

    def project(
        self, points: Any, *, progress: ProgressCallback | None = None, **project_options: Any
    ) -> tuple[np.ndarray, np.ndarray]:
        """The closest places to points (..., dim): their parameters (..., 2) and distances (...)."""
        points = array(points, width=self.dim, what="points")
        uv, distances = np.empty(points.shape[:-1] + (2,)), np.empty(points.shape[:-1])
        long = LongCall(progress)
        record = options("project_options", project_options, **long.fields("project_options"))
        count = points.size // self.dim
        long(
            "planish_surface_project",
            *(self, pointer(points), count, by_reference(record), pointer(uv), pointer(distances)),
        )
        return uv, distances

    def fair(
        self,
        tolerance: float = 1e-3,
        *,
        uv: Any = None,
        values: Any = None,
        absolute: bool = False,
        progress: ProgressCallback | None = None,
        **fair_options: Any,
    ) -> Surface:
        """A surface of less energy within a tolerance of this one, or of values (n, dim) at uv (n, 2).

        ``energy`` is "thin_plate" or "curvature_variation", ``border`` "none", "position" or "tangent". Near
        values ``limit`` is "noise", until each is told best from the others, or "tolerance", as far as that lets it.
        """
        uv = np.empty((0, 2)) if uv is None else array(uv, width=2, what="uv")
        values = np.empty((0, self.dim)) if values is None else array(values, what="values")
        if values.size != len(uv) * self.dim:
            raise InvalidError(f"values needs {len(uv)} rows of {self.dim}, its shape is {values.shape}")
        long = LongCall(progress)
        report = report_record("fair_report")
        filled = long.fields("fair_options")
        filled.update(tolerance=tolerance, tolerance_scale="absolute" if absolute else "relative")
        record = options("fair_options", fair_options, **filled)
        data = (pointer(uv), pointer(values), len(uv))
        arguments = (self, *data, by_reference(record), OUT, by_reference(report))
        status, handle = made("planish_surface_fair", *arguments, run=long)
        return Surface._own(handle, Report(report, status))

    def deviation(
        self, mesh: Mesh, *, progress: ProgressCallback | None = None, **deviation_options: Any
    ) -> tuple[np.ndarray, Report]:
        """The distance of each node of a mesh to the surface, and a report of both directions.

        ``report.signed`` has the distances with their sign, positive on the side of the normals, and ``report.uv`` the
        nearest places.
        """
        return deviation_of("planish_surface_deviation", self, mesh, progress, deviation_options)

    def tessellate(self, *, progress: ProgressCallback | None = None, **tessellate_options: Any) -> Mesh:
        """Triangles inside the trims, within a chord tolerance."""
        long = LongCall(progress)
        record = options("tessellate_options", tessellate_options, **long.fields("tessellate_options"))
        return Mesh._own(made("planish_surface_tessellate", self, by_reference(record), OUT, run=long)[1])

    def field_gradient(self, field: Surface, uv: Any, thread_count: int = 0) -> np.ndarray:
        """The gradient along this shape of a scalar field over the same parameters, at parameters (..., 2)."""
        uv = array(uv, width=2, what="uv")
        out = np.empty(uv.shape[:-1] + (3,))
        record = by_reference(options("gradient_options", {"thread_count": thread_count}))
        call("planish_surface_field_gradient", self, field, pointer(uv), uv.size // 2, record, pointer(out))
        return out

    # trims

    @property
    def trims(self) -> list[np.ndarray]:
        """The loops (k, 2) in the parameter plane that bound the surface; can be replaced."""
        loops = []
        for trim in range(lib.planish_surface_trim_count(self)):
            loop = np.empty((lib.planish_surface_trim_point_count(self, trim), 2))
            call("planish_surface_copy_trim", self, trim, pointer(loop), len(loop))
            loops.append(read_only(loop))
        return loops

    @trims.setter
    def trims(self, loops: Iterable[Any]) -> None:
        loops = [array(loop, width=2, what="a trim") for loop in loops]
        counts = np.array([len(loop) for loop in loops], np.uintp)
        points = np.concatenate(loops) if loops else np.empty((0, 2))
        call("planish_surface_set_trims", self, pointer(points), pointer(counts), len(loops))

    def trim_by_curves(
        self,
        loops: Iterable[Curve | Iterable[Curve]],
        tolerance: float = 1e-3,
        *,
        absolute: bool = False,
        progress: ProgressCallback | None = None,
        **trim_options: Any,
    ) -> Report:
        """Trims that follow curves in space within a tolerance; the report says how near they are.

        A loop is one closed curve, or several in order. ``add=1`` keeps the trims that there are, so that a closed curve
        inside cuts a hole.
        """
        loops = [[loop] if isinstance(loop, Curve) else list(loop) for loop in loops]
        counts = np.array([len(loop) for loop in loops], np.uintp)
        handles = (ctypes.c_void_p * int(counts.sum()))(*(curve._as_parameter_ for loop in loops for curve in loop))
        long = LongCall(progress)
        report = report_record("trim_report")
        filled = long.fields("trim_options")
        filled.update(tolerance=tolerance, tolerance_scale="absolute" if absolute else "relative")
        record = options("trim_options", trim_options, **filled)
        arguments = (ctypes.addressof(handles), pointer(counts), len(loops), by_reference(record), by_reference(report))
        return Report(report, long("planish_surface_trim_by_curves", self, *arguments))

    # parts

    def to_tensor(self, *, progress: ProgressCallback | None = None, **convert_options: Any) -> Surface:
        """The same shape as one tensor product surface, exactly."""
        long = LongCall(progress)
        record = by_reference(options("convert_options", convert_options, **long.fields("convert_options")))
        return Surface._own(made("planish_surface_to_tensor", self, record, OUT, run=long)[1], self.report)

    def bezier_patches(self) -> list[BezierPatch]:
        """The polynomial pieces of tensor, T-spline and PHT surfaces."""
        return [self._bezier_patch(index) for index in range(lib.planish_surface_patch_count(self))]

    def _bezier_patch(self, index: int) -> BezierPatch:
        patch = report_record("patch")
        call("planish_surface_copy_patch", self, index, by_reference(patch), None, 0)
        ordinates = np.empty((patch.degree_u + 1, patch.degree_v + 1, patch.ordinate_width))
        call("planish_surface_copy_patch", self, index, by_reference(patch), pointer(ordinates), patch.ordinate_count)
        weights = ordinates[..., -1].copy() if patch.is_rational else None
        points = ordinates if weights is None else ordinates[..., :-1] / weights[..., None]
        return BezierPatch((patch.u_min, patch.u_max, patch.v_min, patch.v_max), points, weights)

    # files and copies

    def write_step(
        self, path: str | os.PathLike, *, progress: ProgressCallback | None = None, **step_options: Any
    ) -> Report:
        """Writes a STEP file; the report tells its faces and poles."""
        return _write_step("planish_surface_write_step", self, path, progress, step_options)

    def write_vtk(
        self,
        path: str | os.PathLike,
        *,
        deviation_from: Mesh | None = None,
        progress: ProgressCallback | None = None,
        **vtk_options: Any,
    ) -> None:
        """Writes a VTK file (.vtu), with the deviation from a mesh if one is given."""
        long = LongCall(progress)
        filled = dict(long.fields("vtk_options"), deviation_from=deviation_from)
        record = options("vtk_options", vtk_options, **filled)
        long("planish_surface_write_vtk", self, path_of(path), by_reference(record))

    def write_report(
        self,
        path: str | os.PathLike,
        mesh: Mesh,
        *,
        progress: ProgressCallback | None = None,
        **report_options: Any,
    ) -> None:
        """Writes an HTML page with the mesh in the colours of its distances, numbers and worst places.

        report_options: ``title``, ``unit``, ``tolerance`` (default: that of the fit), ``remarks``.
        """
        _write_report("planish_surface_write_report", self, mesh, path, progress, report_options)

    def save(self, path: str | os.PathLike) -> None:
        """Saves to a file in the library's own format; `load` reads it."""
        call("planish_surface_save_file", self, path_of(path))

    def tobytes(self) -> bytes:
        """What `save` would write; `loads` reads it."""
        buffer = ctypes.create_string_buffer(lib.planish_surface_save_size(self))
        call("planish_surface_save", self, ctypes.addressof(buffer), len(buffer))
        return buffer.raw

    def __reduce__(self) -> tuple[Any, ...]:
        return _restore, (self.tobytes(), self.report)

    def __copy__(self) -> Surface:
        return Surface._own(made("planish_surface_clone", self, OUT)[1], self.report)

    def __deepcopy__(self, _: Any) -> Surface:
        return self.__copy__()

    def __repr__(self) -> str:
        if not self._handle:
            return "<planish.Surface: closed>"
        told = ""
        if self.report is not None:
            told = f", error {self.report.max_error:.3g} of {self.report.tolerance:.3g}"
        return f"<planish.Surface: {self.kind}, dim {self.dim}, {self.n_control_points} control points{told}>"

    # neighbours: imported only when asked for

    def plot(self, axes: Any = None, **keywords: Any) -> Any:
        """Draws the surface with matplotlib; returns the axes."""
        if axes is None:
            from matplotlib import pyplot

            axes = pyplot.figure().add_subplot(projection="3d")
        mesh = self.tessellate()
        keywords = {"linewidth": 0, "antialiased": False, **keywords}
        axes.plot_trisurf(*mesh.points.T, triangles=mesh.triangles.astype(np.int64), **keywords)
        axes.set_aspect("equal")
        return axes

    def to_geomdl(self) -> Any:
        """As a surface of geomdl (NURBS-Python)."""
        from geomdl import NURBS, BSpline

        tensor = self if self.kind == "tensor" else self.to_tensor()
        points, weights = tensor.control_points, tensor.weights
        surface = (BSpline if weights is None else NURBS).Surface(normalize_kv=False)
        surface.degree_u, surface.degree_v = tensor.degrees
        if weights is not None:
            points = np.concatenate([points * weights[..., None], weights[..., None]], axis=-1)
        surface.set_ctrlpts(points.reshape(-1, points.shape[-1]).tolist(), *points.shape[:2])
        surface.knotvector_u, surface.knotvector_v = (knots.tolist() for knots in tensor.knots)
        return surface


def deviation_of(
    function: str, shape: Handle, mesh: Mesh, progress: ProgressCallback | None, given: dict[str, Any], **places: np.ndarray
) -> tuple[np.ndarray, Report]:
    """Distances and report of a deviation; `places` are further arrays that the call fills, by the names of the report."""
    places = dict(places, signed=np.empty(mesh.n_points), uv=np.empty((mesh.n_points, 2)))
    distances, record = np.empty(mesh.n_points), report_record("deviation_report")
    long = LongCall(progress)
    filled = {f"out_{name}": values for name, values in places.items()}
    call_options = by_reference(options("deviation_options", given, **filled, **long.fields("deviation_options")))
    status = long(function, shape, mesh, call_options, pointer(distances), len(distances), by_reference(record))
    report = Report(record, status)
    for name, values in places.items():
        setattr(report, name, values)
    return distances, report


def _pairs(u: Any, v: Any) -> np.ndarray:
    """u and v, broadcast, as rows (u, v)."""
    u, v = np.broadcast_arrays(np.asarray(u, float), np.asarray(v, float))
    pairs = np.empty(u.shape + (2,))
    pairs[..., 0], pairs[..., 1] = u, v
    return pairs


def expect(values: np.ndarray, shape: tuple[int, ...], what: str) -> None:
    if values.shape != shape:
        raise InvalidError(f"{what} needs the shape {shape}, it has {values.shape}")


def _write_report(
    function: str,
    fitted: Any,
    mesh: Mesh,
    path: str | os.PathLike,
    progress: ProgressCallback | None,
    report_options: dict[str, Any],
) -> None:
    long = LongCall(progress)
    if fitted.report is not None and "tolerance" not in report_options:
        report_options.update(tolerance=fitted.report.tolerance, tolerance_scale="absolute")
        report_options.setdefault("remarks", fitted.report.remarks)
    record = options("report_options", report_options, **long.fields("report_options"))
    long(function, fitted, mesh, path_of(path), by_reference(record))


def _write_step(function: str, shape: Handle, path: Any, progress: Any, given: dict[str, Any]) -> Report:
    long, report = LongCall(progress), report_record("step_report")
    record = options("step_options", given, out_report=report, **long.fields("step_options"))
    return Report(report, long(function, shape, path_of(path), by_reference(record)))


def _restore(saved: bytes, report: Report | None) -> Surface:
    return Surface._own(made("planish_surface_load", saved, len(saved), OUT)[1], report)


def load(path: str | os.PathLike) -> Surface:
    """Loads a surface that `Surface.save` or any other binding has saved."""
    return Surface._own(made("planish_surface_load_file", path_of(path), OUT)[1])


def loads(saved: bytes) -> Surface:
    """A surface from the bytes of `Surface.tobytes`."""
    return Surface._own(made("planish_surface_load", saved, len(saved), OUT)[1])
