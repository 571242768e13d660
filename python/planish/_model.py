"""Models: faces that share edges and vertices, as open shells, solids and voids."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Iterable
from typing import Any

import numpy as np

from . import _abi, _brep
from ._calls import LongCall, ProgressCallback
from ._curve import Curve
from ._library import OUT, Handle, array, call, indices, lib, made, path_of, pointer, read_only
from ._mesh import Mesh, projected, read_mesh
from ._parts import Edge, Face, Parts, Shell
from ._records import Report, by_reference, options, report_record
from ._surface import Curvatures, Surface, _write_report, _write_step, deviation_of

_NONE = _abi.NONE


def _word(enumeration: str, number: int) -> str:
    return next(word for word, value in _abi.ENUMERATIONS[enumeration].items() if value == number)


def _or_none(number: int) -> int | None:
    return None if number == _NONE else number


class Model(Handle):
    """Faces that share edges and vertices, watertight by construction. Made by `model`, `Model.from_surface`, `load_model`.

    ``report`` tells how a fit went; None for models that no fit made.
    """

    _free = "planish_model_free"
    report: Report | None = None

    @classmethod
    def from_surface(cls, surface: Surface) -> Model:
        """The part of a surface inside its trims as an open shell: one face, or several that share edges."""
        model = cls._own(made("planish_model_from_surface", surface, OUT)[1])
        model.report = surface.report
        return model

    @property
    def dim(self) -> int:
        """Numbers of a place: 3, or those of a value for a field over the faces of a model."""
        return lib.planish_model_dim(self)

    @property
    def n_faces(self) -> int:
        """Number of faces."""
        return lib.planish_model_face_count(self)

    @property
    def n_edges(self) -> int:
        """Number of edges; one between two faces counts once."""
        return lib.planish_model_edge_count(self)

    @property
    def n_vertices(self) -> int:
        """Number of vertices."""
        return lib.planish_model_vertex_count(self)

    @property
    def n_shells(self) -> int:
        """Number of shells."""
        return lib.planish_model_shell_count(self)

    @property
    def vertices(self) -> np.ndarray:
        """The places (n, 3) of the vertices."""
        points = np.empty((self.n_vertices, 3))
        call("planish_model_copy_vertices", self, pointer(points), len(points))
        return read_only(points)

    def face(self, index: int) -> Face:
        """What a face is, with its loops."""
        info = report_record("face_info")
        call("planish_model_face_info", self, index, by_reference(info))
        sizes = np.empty(lib.planish_model_loop_count(self, index), np.uintp)
        count = lib.planish_model_coedge_count(self, index)
        edges, forward = np.empty(count, np.uint32), np.empty(count, np.uint8)
        arguments = (pointer(sizes), len(sizes), pointer(edges), pointer(forward), count)
        call("planish_model_copy_loops", self, index, *arguments)
        coedges = [(int(edge), bool(is_forward)) for edge, is_forward in zip(edges, forward)]
        ends = np.cumsum(sizes).astype(int)
        loops = [coedges[end - int(size) : end] for size, end in zip(sizes, ends)]
        return Face(
            _word("planish_carrier", info.carrier),
            *(tuple(info.origin), tuple(info.axis), tuple(info.x_axis), info.radius),
            *(info.label, info.shell, bool(info.is_forward), loops),
            *(info.max_error, info.rms_error, info.node_count),
        )

    @property
    def n_nodes(self) -> int:
        """Number of nodes of the mesh that the model was fitted to; 0 for a model that no fit made."""
        return lib.planish_model_node_count(self)

    def locate_nodes(self) -> tuple[np.ndarray, np.ndarray]:
        """Where each node of the mesh that the model was fitted to lies: faces (n,) and parameters (n, 2)."""
        faces, uv = np.empty(self.n_nodes, np.uint32), np.empty((self.n_nodes, 2))
        call("planish_model_locate_nodes", self, pointer(faces), pointer(uv), len(faces))
        return faces, uv

    def face_surface(self, index: int) -> Surface:
        """The surface under a face, its loops as trims; planes and cylinders become tensor surfaces."""
        return Surface._own(made("planish_model_copy_face", self, index, OUT)[1])

    def pcurve(self, face: int, coedge: int) -> Curve:
        """Where the `coedge`-th edge of all loops of a face lies in the parameter plane of its surface."""
        return Curve._own(made("planish_model_copy_pcurve", self, face, coedge, OUT)[1])

    def edge(self, index: int) -> Edge:
        """What an edge is, with its curve."""
        info = report_record("edge_info")
        _, handle = made("planish_model_copy_edge", self, index, OUT, by_reference(info))
        return Edge(
            Curve._own(handle),
            (info.vertex_start, info.vertex_end),
            (_or_none(info.face_along), _or_none(info.face_against)),
            *(bool(info.is_sharp), info.angle, info.gap, _word("planish_edge_shape", info.shape)),
            *(tuple(row) for row in (info.origin, info.axis, info.x_axis, info.radii)),
        )

    def shell(self, index: int) -> Shell:
        """What a shell is, with its faces."""
        info = report_record("shell_info")
        call("planish_model_copy_shell", self, index, by_reference(info), None, 0)
        faces = np.empty(info.face_count, np.uint32)
        call("planish_model_copy_shell", self, index, None, pointer(faces), len(faces))
        return Shell(faces.tolist(), _word("planish_shell_role", info.role), _or_none(info.void_in))

    def measure(self) -> Report:
        """Box, area, volume, the largest gap and normal jump, and counts."""
        report = report_record("measure_report")
        return Report(report, call("planish_model_measure", self, by_reference(report)))

    # evaluation and queries

    def eval(self, faces: Any, uv: Any, **eval_options: Any) -> np.ndarray:
        """Places (..., dim) at parameters (..., 2) of faces (...), by number."""
        return self.derivatives(faces, uv, 0, **eval_options)[..., 0, :]

    def derivatives(self, faces: Any, uv: Any, order: int = 1, **eval_options: Any) -> np.ndarray:
        """S, Su, Sv, Suu, Suv, Svv up to `order` at parameters (..., 2) of faces (...): an array (..., rows, dim)."""
        rows = (order + 1) * (order + 2) // 2
        arguments, shape, record = self._places(faces, uv, eval_options)
        out = np.empty(shape + (rows, self.dim))
        call("planish_model_eval", *arguments, order, record, pointer(out))
        return out

    def field_gradient(self, field: Model, faces: Any, uv: Any) -> np.ndarray:
        """Gradients in space (..., field.dim, 3) of a field over the faces, at parameters (..., 2) of faces (...)."""
        arguments, shape, _ = self._places(faces, uv, {})
        out = np.empty(shape + (field.dim, 3))
        call("planish_model_field_gradient", self, field, *arguments[1:], None, pointer(out))
        return out

    def normals(self, faces: Any, uv: Any, **eval_options: Any) -> np.ndarray:
        """Unit normals (..., 3), out of the front of each face, at parameters (..., 2) of faces (...)."""
        arguments, shape, record = self._places(faces, uv, eval_options)
        out = np.empty(shape + (3,))
        call("planish_model_normals", *arguments, record, pointer(out))
        return out

    def curvatures(self, faces: Any, uv: Any, **eval_options: Any) -> Curvatures:
        """Principal curvatures and their directions at parameters (..., 2) of faces (...)."""
        arguments, shape, record = self._places(faces, uv, eval_options)
        out = np.empty(shape + (8,))
        call("planish_model_curvatures", *arguments, record, pointer(out))
        return Curvatures(out[..., 0], out[..., 1], out[..., 2:5], out[..., 5:])

    def _places(self, faces: Any, uv: Any, given: dict[str, Any]) -> tuple[tuple[Any, ...], tuple[int, ...], Any]:
        uv = array(uv, width=2, what="uv")
        faces = indices(np.broadcast_to(faces, uv.shape[:-1]), what="faces")
        record = options("eval_options", given)
        record._kept += [faces, uv]  # as long as the reference to the record lives
        return (self, pointer(faces), pointer(uv), faces.size), faces.shape, by_reference(record)

    def project(
        self, points: Any, *, progress: ProgressCallback | None = None, **project_options: Any
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The nearest places to points (..., 3) over all faces: faces (...), parameters (..., 2), distances (...)."""
        return projected("planish_model_project", self, points, 2, progress, project_options)

    def deviation(
        self, mesh: Mesh, *, progress: ProgressCallback | None = None, **deviation_options: Any
    ) -> tuple[np.ndarray, Report]:
        """The distance of each node of a mesh to the model, and a report of both directions.

        ``report.signed`` has the distances with their sign, positive outside, ``report.faces`` and ``report.uv`` the nearest
        places.
        """
        faces = np.empty(mesh.n_points, np.uint32)
        return deviation_of("planish_model_deviation", self, mesh, progress, deviation_options, faces=faces)

    def tessellate(self, *, progress: ProgressCallback | None = None, **tessellate_options: Any) -> Mesh:
        """Triangles of all faces; faces share the nodes of their edges, so that a solid gives a closed mesh."""
        long = LongCall(progress)
        record = options("tessellate_options", tessellate_options, **long.fields("tessellate_options"))
        return Mesh._own(made("planish_model_tessellate", self, by_reference(record), OUT, run=long)[1])

    # files and copies

    def write_vtk(
        self, path: str | os.PathLike, *, progress: ProgressCallback | None = None, **vtk_options: Any
    ) -> None:
        """Writes a VTK file (.vtu)."""
        long = LongCall(progress)
        record = options("vtk_options", vtk_options, **long.fields("vtk_options"))
        long("planish_model_write_vtk", self, path_of(path), by_reference(record))

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
        _write_report("planish_model_write_report", self, mesh, path, progress, report_options)

    def to_brep(self) -> str:
        """The model as BREP text of OpenCASCADE: FreeCAD, CadQuery and build123d take it from memory."""
        faces, edges, shells = (
            [part(index) for index in range(count)]
            for part, count in ((self.face, self.n_faces), (self.edge, self.n_edges), (self.shell, self.n_shells))
        )
        deviation = self.measure().curve_deviation
        return _brep.text(Parts(faces, edges, shells, self.vertices, self.face_surface, self.pcurve, deviation))

    def write_step(
        self, path: str | os.PathLike, *, progress: ProgressCallback | None = None, **step_options: Any
    ) -> Report:
        """Writes a STEP file: solids with their voids, open shells; the report tells its faces and poles."""
        return _write_step("planish_model_write_step", self, path, progress, step_options)

    def step_text(self, **step_options: Any) -> str:
        """What `write_step` would write."""
        long, size = LongCall(), ctypes.c_size_t()
        record = options("step_options", step_options, **long.fields("step_options"))
        long("planish_model_write_step_memory", self, by_reference(record), None, 0, ctypes.byref(size))
        buffer = ctypes.create_string_buffer(size.value)
        arguments = (by_reference(record), ctypes.addressof(buffer), len(buffer), ctypes.byref(size))
        long("planish_model_write_step_memory", self, *arguments)
        return buffer.raw.decode("ascii")

    def save(self, path: str | os.PathLike) -> None:
        """Saves to a file in the library's own format; `load_model` reads it."""
        call("planish_model_save_file", self, path_of(path))

    def tobytes(self) -> bytes:
        """What `save` would write."""
        buffer = ctypes.create_string_buffer(lib.planish_model_save_size(self))
        call("planish_model_save", self, ctypes.addressof(buffer), len(buffer))
        return buffer.raw

    def __reduce__(self) -> tuple[Any, ...]:
        return _restore, (self.tobytes(), self.report)

    def __copy__(self) -> Model:
        clone = Model._own(made("planish_model_clone", self, OUT)[1])
        clone.report = self.report
        return clone

    def __deepcopy__(self, _: Any) -> Model:
        return self.__copy__()

    def __repr__(self) -> str:
        if not self._handle:
            return "<planish.Model: closed>"
        return f"<planish.Model: {self.n_faces} faces, {self.n_edges} edges, {self.n_shells} shells>"


def _restore(saved: bytes, report: Report | None) -> Model:
    model = Model._own(made("planish_model_load", saved, len(saved), OUT)[1])
    model.report = report
    return model


def load_model(path: str | os.PathLike) -> Model:
    """Loads a model that `Model.save` or any other binding has saved."""
    return Model._own(made("planish_model_load_file", path_of(path), OUT)[1])


def model(
    mesh: Mesh | str | os.PathLike,
    tolerance: float = 1e-3,
    family: str = "auto",
    *,
    absolute: bool = False,
    labels: Any = None,
    progress: ProgressCallback | None = None,
    **model_options: Any,
) -> Model:
    """A watertight model within a tolerance of any mesh (or of the mesh in a file): closed meshes become solids.

    tolerance: the largest distance allowed between a node and the model, as a fraction of the diagonal of the mesh's box,
        or in its units if `absolute`.
    family: "auto" takes exact faces of planes and cylinders where they explain the mesh, else patches with one tangent plane
        along their edges but for sharp ones, or one chart where an open mesh has no features inside or that does better.
    labels: a number for each triangle: edges between different ones are features, and exact faces have it as `label`.
    model_options: those of `planish_model_options`, such as ``patches``.

    ``model.report`` tells how it went, also the volume beside the mesh's, the largest normal jump and gap; its ``errors``,
    ``faces`` and ``uv`` say for each node of the mesh how far it is and where it went.
    """
    if not isinstance(mesh, Mesh):
        mesh = read_mesh(mesh)
    long, report = LongCall(progress), report_record("model_report")
    faces, uv, errors = np.empty(mesh.n_points, np.uint32), np.empty((mesh.n_points, 2)), np.empty(mesh.n_points)
    filled = dict(
        long.fields("model_options"),
        tolerance=tolerance,
        tolerance_scale="absolute" if absolute else "relative",
        family=family,
        out_faces=faces,
        out_uv=uv,
        out_errors=errors,
    )
    if labels is not None:
        labels = np.ascontiguousarray(labels, np.uint32).ravel()
        filled.update(labels=labels, label_count=len(labels))
    record = options("model_options", model_options, **filled)
    arguments = ("planish_model_fit", mesh, by_reference(record), OUT, by_reference(report))
    status, handle = made(*arguments, run=long)
    fitted = Model._own(handle)
    fitted.report = Report(report, status)
    fitted.report.faces, fitted.report.uv, fitted.report.errors = map(read_only, (faces, uv, errors))
    return fitted


def smooth_from_patches(
    patches: Iterable[Surface],
    tolerance: float = 1e-3,
    *,
    absolute: bool = False,
    progress: ProgressCallback | None = None,
    **smooth_options: Any,
) -> Model:
    """One smooth model of tensor surfaces that meet edge to edge within `join_tolerance`.

    tolerance: the largest deviation allowed from the given surfaces, as a fraction of the diagonal of their box, or in their
        units if `absolute`.
    smooth_options: those of `planish_smooth_options`.

    ``model.report`` tells how far the model is from the patches, and how far those were apart.
    """
    patches = list(patches)
    handles = (ctypes.c_void_p * len(patches))(*(patch._as_parameter_ for patch in patches))
    long, report = LongCall(progress), report_record("smooth_report")
    filled = dict(
        long.fields("smooth_options"), tolerance=tolerance, tolerance_scale="absolute" if absolute else "relative"
    )
    record = options("smooth_options", smooth_options, **filled)
    arguments = (ctypes.addressof(handles), len(patches), by_reference(record), OUT, by_reference(report))
    status, handle = made("planish_model_smooth_from_patches", *arguments, run=long)
    smoothed = Model._own(handle)
    smoothed.report = Report(report, status)
    return smoothed
