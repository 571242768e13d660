"""Triangle meshes."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from ._calls import LongCall, ProgressCallback
from ._library import OUT, Handle, InvalidError, array, call, indices, lib, made, path_of, pointer, read_only, text_of
from ._records import Report, by_reference, options, report_record


def projected(
    name: str, handle: Handle, points: Any, width: int, progress: ProgressCallback | None, given: Mapping[str, Any]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Nearest places in space, by a call that takes `project_options`: of what part, where on it in rows, how far."""
    points = array(points, width=3, what="points")
    shape = points.shape[:-1]
    parts, places, distances = np.empty(shape, np.uint32), np.empty(shape + (width,)), np.empty(shape)
    long = LongCall(progress)
    record = options("project_options", given, **long.fields("project_options"))
    outputs = (pointer(parts), pointer(places), pointer(distances))
    long(name, handle, pointer(points), distances.size, by_reference(record), *outputs)
    return parts, places, distances


class Mesh(Handle):
    """A triangle mesh with its boundary loops, parameters and fields on the nodes.

    points: (n, 3) coordinates.
    triangles: (m, 3) numbers of nodes, counted from 0; faults are mended as ``repair`` says, see `repaired`.
    uv: (n, 2) parameters of the nodes, or None.
    fields: names and (n,) values on the nodes.
    options: those of `planish_mesh_options`, such as ``weld_distance`` and ``repair``.

    Raises a ValueError that names the offender if the triangles do not make a surface.
    """

    _free = "planish_mesh_free"
    #: What was mended.
    repaired: Report
    #: Of a mesh that `decimate` made: how it went.
    report: Report

    def __init__(
        self,
        points: Any,
        triangles: Any,
        uv: Any = None,
        fields: Mapping[str, Any] | None = None,
        **mesh_options: Any,
    ):
        points = array(points, width=3, what="points")
        triangles = indices(triangles, 3, "triangles")
        repairs = report_record("mesh_repairs")
        record = options("mesh_options", mesh_options, out_repairs=repairs)
        _, handle = made(
            "planish_mesh_new",
            *(pointer(points), len(points), pointer(triangles), len(triangles)),
            *(by_reference(record), OUT),
        )
        super().__init__(handle)
        self.repaired = Report(repairs)
        if uv is not None:
            self.uv = uv
        for name, values in (fields or {}).items():
            self[name] = values

    @property
    def n_points(self) -> int:
        """Number of nodes."""
        return lib.planish_mesh_point_count(self)

    @property
    def n_triangles(self) -> int:
        """Number of triangles."""
        return lib.planish_mesh_triangle_count(self)

    @property
    def n_edges(self) -> int:
        """Number of edges."""
        return lib.planish_mesh_edge_count(self)

    @property
    def n_loops(self) -> int:
        """Number of boundary loops: 0 for a closed mesh."""
        return lib.planish_mesh_loop_count(self)

    @property
    def n_components(self) -> int:
        """Number of pieces that are not joined."""
        return lib.planish_mesh_component_count(self)

    @property
    def genus(self) -> int:
        """Number of handles."""
        return lib.planish_mesh_genus(self)

    @property
    def euler_characteristic(self) -> int:
        """Nodes - edges + triangles."""
        return lib.planish_mesh_euler_characteristic(self)

    def _copied(self, function: str, count: int, width: int, dtype: Any = np.float64) -> np.ndarray:
        values = np.empty((count, width), dtype)
        call(function, self, pointer(values), count)
        return read_only(values)

    @property
    def points(self) -> np.ndarray:
        """(n, 3) coordinates; read only."""
        return self._copied("planish_mesh_copy_points", self.n_points, 3)

    @points.setter
    def points(self, points: Any) -> None:
        points = array(points, width=3, what="points")
        call("planish_mesh_set_points", self, pointer(points), len(points))

    @property
    def triangles(self) -> np.ndarray:
        """(m, 3) numbers of nodes; read only."""
        return self._copied("planish_mesh_copy_triangles", self.n_triangles, 3, np.uint32)

    @property
    def uv(self) -> np.ndarray | None:
        """(n, 2) parameters, or None; read only, but can be replaced."""
        if not lib.planish_mesh_has_parameters(self):
            return None
        return self._copied("planish_mesh_copy_parameters", self.n_points, 2)

    @uv.setter
    def uv(self, uv: Any) -> None:
        uv = array(uv, width=2, what="uv")
        call("planish_mesh_set_parameters", self, pointer(uv), len(uv))

    @property
    def node_map(self) -> np.ndarray:
        """What each node was in the arrays or the file, or in the mesh that this one was cut from."""
        return self._copied("planish_mesh_copy_node_map", self.n_points, 1, np.uint32)[:, 0]

    @property
    def triangle_map(self) -> np.ndarray:
        """What each triangle was: the triangle of the arrays, the face of the file, the triangle of the other mesh."""
        return self._copied("planish_mesh_copy_triangle_map", self.n_triangles, 1, np.uint32)[:, 0]

    def write(self, path: str | os.PathLike, **write_options: Any) -> None:
        """Writes OFF, OBJ, PLY or STL, as the name ends; uv where the format can, fields in PLY.

        write_options: those of `planish_mesh_write_options`, such as ``text=True``.
        """
        record = options("mesh_write_options", write_options)
        call("planish_mesh_write", self, path_of(path), by_reference(record))

    @property
    def loops(self) -> list[np.ndarray]:
        """The nodes of each boundary loop in order, the longest loop first."""
        loops = []
        for loop in range(self.n_loops):
            nodes = np.empty(lib.planish_mesh_loop_point_count(self, loop), np.uint32)
            call("planish_mesh_copy_loop", self, loop, pointer(nodes), len(nodes))
            loops.append(read_only(nodes))
        return loops

    # fields on the nodes, as a mapping

    def keys(self) -> list[str]:
        """The names of the fields on the nodes."""
        return [text_of("planish_mesh_field_name", self, field) for field in range(lib.planish_mesh_field_count(self))]

    def __iter__(self) -> Iterator[str]:
        return iter(self.keys())

    def __contains__(self, name: object) -> bool:
        return name in self.keys()

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self:
            raise KeyError(f"there is no field {name!r}; there are {self.keys()}")
        values = np.empty(self.n_points)
        call("planish_mesh_copy_field", self, name.encode(), pointer(values), len(values))
        return read_only(values)

    def __setitem__(self, name: str, values: Any) -> None:
        values = array(values, what=f"field {name!r}")
        if values.ndim != 1:
            raise InvalidError(f"field {name!r} needs one number a node, its shape is {values.shape}")
        call("planish_mesh_set_field", self, name.encode(), pointer(values), len(values))

    def __delitem__(self, name: str) -> None:
        if name not in self:
            raise KeyError(f"there is no field {name!r}; there are {self.keys()}")
        call("planish_mesh_remove_field", self, name.encode())

    # new meshes from this one

    def parameterize(self, *, progress: ProgressCallback | None = None, **parameterize_options: Any) -> Report:
        """Gives the nodes parameters without folds; returns the report of the map."""
        long = LongCall(progress)
        report = report_record("parameterize_report")
        record = options("parameterize_options", parameterize_options, **long.fields("parameterize_options"))
        return Report(report, long("planish_mesh_parameterize", self, by_reference(record), by_reference(report)))

    def map_to_sphere(
        self, *, progress: ProgressCallback | None = None, **sphere_options: Any
    ) -> tuple[np.ndarray, Report]:
        """Unit vectors (n, 3) of the nodes of a closed mesh without handles, one to one, and the report of the map."""
        long = LongCall(progress)
        places, report = np.empty((self.n_points, 3)), report_record("sphere_report")
        record = options("sphere_options", sphere_options, **long.fields("sphere_options"))
        arguments = (self, by_reference(record), pointer(places), len(places), by_reference(report))
        return places, Report(report, long("planish_mesh_map_to_sphere", *arguments))

    def decimate(self, n_points: int, *, progress: ProgressCallback | None = None, **decimate_options: Any) -> Mesh:
        """A coarser mesh of `n_points` nodes, all of them nodes of this one; its `report` tells how it went."""
        long = LongCall(progress)
        report = report_record("decimate_report")
        filled = long.fields("decimate_options")
        record = options("decimate_options", decimate_options, target_count=n_points, **filled)
        status, handle = made(
            "planish_mesh_decimate", self, by_reference(record), OUT, by_reference(report), run=long
        )
        coarse = Mesh._own(handle)
        coarse.report = Report(report, status)
        return coarse

    def remove_triangles(self, triangles: Any) -> Mesh:
        """A copy without these triangles; nodes that none of the others use go with them."""
        triangles = indices(triangles, what="triangles")
        _, handle = made("planish_mesh_remove_triangles", self, pointer(triangles), triangles.size, OUT)
        return Mesh._own(handle)

    def cut_along(self, nodes: Any) -> Mesh:
        """A copy cut open along a path of neighbouring nodes."""
        nodes = indices(nodes, what="nodes")
        return Mesh._own(made("planish_mesh_cut_along", self, pointer(nodes), nodes.size, OUT)[1])

    def shortest_path(self, start: int, end: int) -> np.ndarray:
        """The nodes of the shortest path along edges."""
        nodes, count = np.empty(self.n_points, np.uint32), ctypes.c_size_t()
        call("planish_mesh_shortest_path", self, start, end, pointer(nodes), len(nodes), ctypes.byref(count))
        return nodes[: count.value].copy()

    def find_features(self, **feature_options: Any) -> tuple[np.ndarray, Report]:
        """The edges (n, 2) where the mesh is not smooth, and a report of chains, corners and noise."""
        report, count = report_record("feature_report"), ctypes.c_size_t()
        record = options("feature_options", feature_options, out_report=report)
        arguments = ("planish_mesh_find_features", self, by_reference(record))
        edges = np.empty((self.n_edges, 2), np.uint32)
        status = call(*arguments, pointer(edges), len(edges), ctypes.byref(count))
        return edges[: count.value].copy(), Report(report, status)

    def label_parts(self, labels: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """How each label hangs together, of one label for each triangle: a face is one piece without handles.

        The labels in increasing order, and for each the number of its triangles, of its pieces, which share no edge, and
        of the handles of all its pieces.
        """
        labels, count = indices(labels, what="labels").ravel(), ctypes.c_size_t()
        arguments = ("planish_mesh_label_parts", self, pointer(labels), labels.size)
        call(*arguments, None, None, None, None, 0, ctypes.byref(count))
        found = np.empty(count.value, np.uint32)
        triangles, pieces, handles = (np.empty(count.value, np.uintp) for _ in range(3))
        outputs = (pointer(found), pointer(triangles), pointer(pieces), pointer(handles))
        call(*arguments, *outputs, count.value, ctypes.byref(count))
        return found, triangles, pieces, handles

    def project(
        self, points: Any, *, progress: ProgressCallback | None = None, **project_options: Any
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The nearest places to points (..., 3): triangles (...), places (..., 3), distances (...).

        The way back from places of a model to the mesh that it was fitted to: ``labels[triangles]`` are the labels that
        they came from, on faces of several labels too. Points farther away than ``max_distance`` have the triangle
        4294967295 and NaN.
        """
        return projected("planish_mesh_project", self, points, 3, progress, project_options)

    def split_components(self) -> list[Mesh]:
        """Each piece as a mesh of its own."""
        handles = (ctypes.c_void_p * self.n_components)()
        call("planish_mesh_split_components", self, ctypes.addressof(handles), len(handles))
        return [Mesh._own(ctypes.c_void_p(handle)) for handle in handles]

    def sample_rows(self, row_count: int, **sample_options: Any) -> list[np.ndarray]:
        """Rows of points around the mesh, as `skin` takes them."""
        long = LongCall()
        record = options("sample_rows_options", sample_options, **long.fields("sample_rows_options"))
        counts, needed = np.zeros(row_count, np.uintp), ctypes.c_size_t()
        arguments = ("planish_mesh_sample_rows", self, by_reference(record), pointer(counts), row_count)
        long(*arguments, None, 0, ctypes.byref(needed))
        points = np.empty((needed.value, 3))
        long(*arguments, pointer(points), len(points), ctypes.byref(needed))
        return np.split(points, np.cumsum(counts[:-1]).astype(int))

    # copies

    def __copy__(self) -> Mesh:
        return Mesh._own(made("planish_mesh_clone", self, OUT)[1])

    def __deepcopy__(self, _: Any) -> Mesh:
        return self.__copy__()

    def __reduce__(self) -> tuple[Any, ...]:
        return Mesh, (self.points, self.triangles, self.uv, {name: self[name] for name in self})

    def __repr__(self) -> str:
        if not self._handle:
            return "<planish.Mesh: closed>"
        return (
            f"<planish.Mesh: {self.n_points} points, {self.n_triangles} triangles, "
            f"{self.n_loops} boundary loops, genus {self.genus}>"
        )

    # neighbours: imported only when asked for

    @classmethod
    def from_trimesh(cls, mesh: Any, **mesh_options: Any) -> Mesh:
        """From a `trimesh.Trimesh`."""
        return cls(mesh.vertices, mesh.faces, **mesh_options)

    def to_trimesh(self) -> Any:
        """As a `trimesh.Trimesh`; nodes keep their numbers."""
        import trimesh

        return trimesh.Trimesh(self.points, self.triangles, process=False)

    @classmethod
    def from_meshio(cls, mesh: Any, **mesh_options: Any) -> Mesh:
        """From a `meshio.Mesh`: its triangles and quadrilaterals, and the scalar fields on its points."""
        blocks = mesh.cells_dict
        faces = [np.asarray(blocks["triangle"])] if "triangle" in blocks else []
        if "quad" in blocks:
            quads = np.asarray(blocks["quad"])
            faces += [quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]
        if not faces:
            raise InvalidError(f"the mesh has no triangles or quadrilaterals, only {', '.join(blocks) or 'points'}")
        points = np.asarray(mesh.points, float)
        if points.shape[1] == 2:
            points = np.column_stack([points, np.zeros(len(points))])
        return cls(points, np.concatenate(faces), fields=_scalars(mesh.point_data), **mesh_options)

    def to_meshio(self) -> Any:
        """As a `meshio.Mesh` with the fields."""
        import meshio

        return meshio.Mesh(self.points, {"triangle": self.triangles}, point_data={name: self[name] for name in self})

    @classmethod
    def from_pyvista(cls, mesh: Any, **mesh_options: Any) -> Mesh:
        """From a `pyvista.PolyData`, which is triangulated; with the scalar fields on its points."""
        mesh = mesh.extract_surface() if not hasattr(mesh, "faces") else mesh
        mesh = mesh.triangulate()
        faces = mesh.faces.reshape(-1, 4)[:, 1:]
        return cls(mesh.points, faces, fields=_scalars(mesh.point_data), **mesh_options)

    def to_pyvista(self) -> Any:
        """As a `pyvista.PolyData` with the fields."""
        import pyvista

        mesh = pyvista.make_tri_mesh(self.points, self.triangles.astype(np.int64))
        for name in self:
            mesh.point_data[name] = self[name]
        return mesh


def _scalars(fields: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """The fields with one number a node."""
    return {name: np.asarray(fields[name], float) for name in _names(fields) if np.ndim(fields[name]) == 1}


def _names(fields: Any) -> Iterable[str]:
    return list(fields.keys())


def read_mesh(path: str | os.PathLike, **mesh_options: Any) -> Mesh:
    """Reads OBJ, OFF, PLY or STL. What had to be mended stands in the mesh's `repaired`.

    options: those of `planish_mesh_options`, such as ``repair={"sheets", ...}`` and ``components="largest"``.
    """
    return _read("planish_mesh_read", path_of(path), mesh_options=mesh_options)


def read_mesh_bytes(content: bytes, **mesh_options: Any) -> Mesh:
    """Reads the content of such a file; ``format="ply"`` says what it is, or else the content itself.

    options: those of `planish_mesh_options`.
    """
    return _read("planish_mesh_read_buffer", content, len(content), mesh_options=mesh_options)


def _read(function: str, *source: Any, mesh_options: Mapping[str, Any]) -> Mesh:
    repairs = report_record("mesh_repairs")
    record = options("mesh_options", mesh_options, out_repairs=repairs)
    _, handle = made(function, *source, by_reference(record), OUT)
    mesh = Mesh._own(handle)
    mesh.repaired = Report(repairs)
    return mesh
