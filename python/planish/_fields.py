"""Fields on the nodes of a mesh: fitted again and again, and carried to other points."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from ._calls import LongCall, ProgressCallback
from ._library import OUT, Handle, InvalidError, array, call, lib, made, output, pointer, read_only
from ._mesh import Mesh
from ._model import Model
from ._records import Report, by_reference, options, report_record
from ._surface import Surface


def _rows(values: Any, count: int, what: str) -> tuple[np.ndarray, int]:
    """Values (count, ...) as rows, and how many numbers each has."""
    values = array(values, what=what)
    if values.shape[:1] != (count,) or values.size == 0:
        raise InvalidError(f"{what} needs {count} rows, its shape is {values.shape}")
    return values, values.size // count


class FieldFitter(Handle):
    """Fits fields on the nodes of one mesh, or at the same parameters: grid, factorization and threads are kept.

    ``FieldFitter(mesh)`` or ``FieldFitter(uv=parameters)``, or ``FieldFitter(mesh, model=model)`` for a mesh that a model
    of patches was fitted to: then `fit` gives a `Model` of values over the faces. options: those of
    `planish_field_options`.
    """

    _free = "planish_field_fitter_free"

    def __init__(
        self,
        mesh: Mesh | None = None,
        *,
        uv: Any = None,
        model: Model | None = None,
        progress: ProgressCallback | None = None,
        **field_options: Any,
    ):
        if (mesh is None) == (uv is None) or (mesh is None and model is not None):
            raise TypeError("a FieldFitter is made for a mesh, with or without its model, or for parameters uv")
        self._made_by = (mesh, None if uv is None else np.array(uv, float), model, field_options)
        long = LongCall(progress)
        record = by_reference(options("field_options", field_options, **long.fields("field_options")))
        if model is not None:
            _, handle = made("planish_field_fitter_new_model", model, mesh, record, OUT, run=long)
        elif mesh is not None:
            _, handle = made("planish_field_fitter_new", mesh, record, OUT, run=long)
        else:
            uv = array(uv, width=2, what="uv")
            _, handle = made("planish_field_fitter_new_points", pointer(uv), len(uv), record, OUT, run=long)
        super().__init__(handle)

    @property
    def n_points(self) -> int:
        """Number of data."""
        return lib.planish_field_fitter_point_count(self)

    @property
    def grid(self) -> tuple[int, int]:
        """Different knots along u and v."""
        grid = (ctypes.c_size_t * 2)()
        call("planish_field_fitter_grid", self, ctypes.addressof(grid))
        return tuple(grid)

    @property
    def uv(self) -> np.ndarray:
        """The parameters (n, 2) of the data."""
        uv = np.empty((self.n_points, 2))
        call("planish_field_fitter_copy_parameters", self, pointer(uv), len(uv))
        return read_only(uv)

    def fit(self, values: Any) -> Surface | Model:
        """The field of values (n,) or (n, dim) as a surface, or over the faces of the model; its `report` tells how well."""
        values, dim = _rows(values, self.n_points, "values")
        report = report_record("fit_report")
        arguments = (self, pointer(values), self.n_points, dim, OUT, by_reference(report))
        if self._made_by[2] is not None:
            status, handle = made("planish_field_fitter_fit_model", *arguments)
            field = Model._own(handle)
            field.report = Report(report, status)
            return field
        status, handle = made("planish_field_fitter_fit", *arguments)
        return Surface._own(handle, Report(report, status))

    def update(self, field: Surface, values: Any) -> None:
        """Puts other values into a surface that this fitter made; no memory is asked for."""
        values, dim = _rows(values, self.n_points, "values")
        call("planish_field_fitter_update", self, field, pointer(values), self.n_points, dim)

    def __reduce__(self) -> tuple[Any, ...]:
        return _fitter, self._made_by


def _fitter(
    mesh: Mesh | None, uv: np.ndarray | None, model: Model | None, field_options: dict[str, Any]
) -> FieldFitter:
    return FieldFitter(mesh, uv=uv, model=model, **field_options)


class Transfer(Handle):
    """Carries values from the nodes of a mesh to target points, and forces on these back to the nodes.

    targets: (m, 3) points; model: one of patches that was fitted to the mesh, for meshes that are no disk; options: those
    of `planish_transfer_options`.
    """

    _free = "planish_transfer_free"

    def __init__(
        self,
        source: Mesh,
        targets: Any,
        *,
        model: Model | None = None,
        progress: ProgressCallback | None = None,
        **transfer_options: Any,
    ):
        targets = array(targets, width=3, what="targets")
        long = LongCall(progress)
        report = report_record("transfer_report")
        record = options("transfer_options", transfer_options, **long.fields("transfer_options"))
        arguments = (source, pointer(targets), len(targets), by_reference(record), OUT, by_reference(report))
        if model is None:
            status, handle = made("planish_transfer_new", *arguments, run=long)
        else:
            status, handle = made("planish_transfer_new_model", model, *arguments, run=long)
        super().__init__(handle)
        self.report = Report(report, status)

    @property
    def n_sources(self) -> int:
        """Number of nodes of the source mesh."""
        return lib.planish_transfer_source_count(self)

    @property
    def n_targets(self) -> int:
        """Number of target points."""
        return lib.planish_transfer_target_count(self)

    @property
    def distances(self) -> np.ndarray:
        """How far each target lies from the surface."""
        distances = np.empty(self.n_targets)
        call("planish_transfer_copy_distances", self, pointer(distances), len(distances))
        return read_only(distances)

    @property
    def uv(self) -> np.ndarray:
        """Where each target lies: parameters (m, 2)."""
        uv = np.empty((self.n_targets, 2))
        call("planish_transfer_copy_parameters", self, pointer(uv), len(uv))
        return read_only(uv)

    def apply(self, values: Any, out: np.ndarray | None = None) -> np.ndarray:
        """Values (n, ...) at the nodes become values (m, ...) at the targets."""
        values, dim = _rows(values, self.n_sources, "values")
        out = output(out, (self.n_targets, *values.shape[1:]))
        call("planish_transfer_apply", self, pointer(values), self.n_sources, dim, pointer(out))
        return out

    __call__ = apply

    def apply_transpose(self, forces: Any, out: np.ndarray | None = None) -> np.ndarray:
        """Forces (m, ...) at the targets become forces (n, ...) at the nodes; sums and work stay."""
        forces, dim = _rows(forces, self.n_targets, "forces")
        out = output(out, (self.n_sources, *forces.shape[1:]))
        call("planish_transfer_apply_transpose", self, pointer(forces), self.n_targets, dim, pointer(out))
        return out

    def balance(self, displacements: Any, forces: Any, about: Any = None) -> Report:
        """How well forces, moments and work are conserved for displacements (n, 3) and forces (m, 3)."""
        displacements = array(displacements, width=3, what="displacements")
        forces = array(forces, width=3, what="forces")
        about = None if about is None else array(about, width=3, what="about")
        report = report_record("balance_report")
        status = call(
            "planish_transfer_balance",
            *(self, pointer(displacements), len(displacements), pointer(forces), len(forces)),
            *(pointer(about), by_reference(report)),
        )
        return Report(report, status)
