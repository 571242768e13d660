import copy
import pickle

import numpy as np
import pytest
from conftest import ball

import planish


@pytest.fixture(scope="module")
def face(surface):
    return planish.Model.from_surface(surface)


def test_a_surface_with_a_trim_is_a_model_of_one_face(face, surface, mesh):
    assert (face.n_faces, face.n_shells) == (1, 1) and face.n_edges == face.n_vertices >= 1
    only = face.face(0)
    assert only.carrier == "spline" and only.is_forward and len(only.loops) == 1
    assert face.shell(0) == planish.Shell([0], "open", None)
    measured = face.measure()
    assert measured.free_edge_count == face.n_edges and measured.volume == 0
    triangles = mesh.points[mesh.triangles.astype(int)]
    area = 0.5 * np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)
    # facets are flat: their area falls short of the smooth one by the square of their size
    assert abs(measured.area - area.sum()) <= 1e-2 * area.sum()


def test_edges_run_along_their_faces(face):
    vertices = face.vertices
    for index in range(face.n_edges):
        edge = face.edge(index)
        ends = edge.curve(edge.curve.domain)
        assert np.abs(ends - vertices[list(edge.vertices)]).max() <= 1e-6
        assert None in edge.faces and set(edge.faces) - {None} == {0}
    surface = face.face_surface(0)
    for place, (index, _) in enumerate(face.face(0).loops[0]):
        curve, pcurve = face.edge(index).curve, face.pcurve(0, place)
        t = np.linspace(*curve.domain, 7)
        assert np.abs(surface.eval(pcurve(t), outside="extrapolate") - curve(t)).max() <= 1e-5


def test_patches_share_their_edges(mesh):
    model = planish.Model.from_surface(planish.fit(mesh, 3e-4, "pht"))
    shared = [index for index in range(model.n_edges) if None not in model.edge(index).faces]
    assert model.n_faces > 1 and shared
    assert model.measure().max_gap <= 1e-12


@pytest.fixture(scope="module")
def solid():
    points, triangles = ball(40, 21)
    return planish.model(planish.Mesh(points * [1, 1.2, 1.5], triangles), 1e-2)


def test_a_closed_mesh_becomes_a_solid(solid):
    report, measured = solid.report, solid.measure()
    assert report.max_error <= report.tolerance and report.normal_jump <= 1e-10 and report.genus == 0
    assert measured.free_edge_count == 0 and measured.euler_characteristic == 2
    assert solid.shell(0).role == "solid" and all(None not in solid.edge(k).faces for k in range(solid.n_edges))
    # an ellipsoid, whose mesh lies inside
    volume = 4 / 3 * np.pi * 1.2 * 1.5
    assert abs(measured.volume - volume) <= 0.05 * volume
    assert solid.tessellate().n_loops == 0


def test_each_node_knows_where_it_went(solid):
    points, _ = ball(40, 21)
    places = solid.eval(solid.report.faces, solid.report.uv)
    errors = np.linalg.norm(places - points * [1, 1.2, 1.5], axis=1)
    assert np.abs(errors - solid.report.errors).max() <= 1e-9


def test_models_answer_as_surfaces_do(face, surface, mesh):
    faces, uv, distances = face.project(mesh.points)
    assert np.all(faces == 0) and np.all(distances <= surface.report.errors + 1e-9)
    places = face.eval(faces, uv, outside="extrapolate")
    assert np.abs(np.linalg.norm(places - mesh.points, axis=1) - distances).max() <= 1e-12
    jets = face.derivatives(faces, uv, 1, outside="extrapolate")
    normals = face.normals(faces, uv, outside="extrapolate")
    assert np.abs(np.einsum("ij,ij->i", normals, jets[:, 1])).max() <= 1e-12 * np.abs(jets).max()
    assert np.all(face.curvatures(faces, uv, outside="extrapolate").k1.shape == (len(uv),))
    measured, report = face.deviation(mesh)
    assert np.abs(measured - distances).max() <= 1e-12 and report.max_distance == measured.max()
    assert np.all(report.faces == 0) and np.abs(report.uv - uv).max() <= 1e-12 and np.all(np.abs(report.signed) == measured)
    assert face.tessellate().n_loops == 1


def test_models_come_back(face, tmp_path):
    face.save(tmp_path / "m.planish")
    saved = face.tobytes()
    for other in (
        planish.load_model(tmp_path / "m.planish"),
        copy.copy(face),
        pickle.loads(pickle.dumps(face)),
    ):
        assert other.tobytes() == saved
    with pytest.raises(OSError):
        planish.load_model(tmp_path / "none.planish")


def test_step_in_a_file_and_in_memory(face, tmp_path):
    report = face.write_step(tmp_path / "m.step")
    text = (tmp_path / "m.step").read_text()
    assert report.face_count == 1 and text.count("=ADVANCED_FACE(") == 1 and face.step_text() == text


def test_brep_text_names_every_shape(face):
    text = face.to_brep()
    assert text.startswith("DBRep_DrawableShape") and text.rstrip().endswith("+1 0")
    count = int(text.split("TShapes ")[1].split()[0])
    assert count == face.n_vertices + face.n_edges + 1 + 1 + 1
    assert sum(line in ("Ve", "Ed", "Wi", "Fa", "Sh") for line in text.splitlines()) == count


def test_numbers_that_do_not_exist_are_refused(face):
    with pytest.raises(IndexError):
        face.face(1)
    with pytest.raises(IndexError):
        face.edge(face.n_edges)


def bar(sides=24, radius=2.0, height=3.0):
    """A round bar between two lids, and which of them each triangle is on: 1 the wall, 2 below, 3 above."""
    angles = 2 * np.pi * np.arange(sides) / sides
    ring = np.c_[radius * np.cos(angles), radius * np.sin(angles)]
    points = [np.c_[ring, np.full(sides, z)] for z in (0.0, height)] + [[[0, 0, 0], [0, 0, height]]]
    k = np.arange(sides)
    after = (k + 1) % sides
    wall = np.r_[np.c_[k, after, after + sides], np.c_[k, after + sides, k + sides]]
    low, high = np.c_[after, k, np.full(sides, 2 * sides)], np.c_[k + sides, after + sides, np.full(sides, 2 * sides + 1)]
    labels = np.repeat([1, 2, 3], [2 * sides, sides, sides])
    return planish.Mesh(np.concatenate(points), np.concatenate([wall, low, high])), labels


def test_planes_and_cylinders_become_exact_faces():
    mesh, labels = bar()
    made = planish.model(mesh, labels=labels)
    assert (made.n_faces, made.report.exact_face_count, made.report.patch_count) == (3, 3, 0)
    faces = [made.face(index) for index in range(3)]
    wall = next(face for face in faces if face.carrier == "cylinder")
    assert abs(wall.radius - 2) <= 1e-12 and abs(abs(wall.axis[2]) - 1) <= 1e-12
    assert sorted(face.label for face in faces) == [1, 2, 3] and wall.label == 1
    shapes = sorted(made.edge(index).shape for index in range(made.n_edges))
    assert shapes == ["circle", "circle", "line"]
    circle = next(made.edge(index) for index in range(made.n_edges) if made.edge(index).shape == "circle")
    assert np.allclose(circle.radii, 2, atol=1e-12)
    t = np.linspace(*circle.curve.domain, 50)
    assert np.abs(np.hypot(*circle.curve(t)[:, :2].T) - 2).max() <= 1e-10
    measured = made.measure()
    assert abs(measured.volume / (12 * np.pi) - 1) <= 1e-12 and measured.free_edge_count == 0
    # two circles and a line in space, a cylinder and two planes
    text = made.to_brep()
    curves = text.split("\nCurves 3\n")[1].splitlines()[:3]
    assert sorted(line.split()[0] for line in curves) == ["1", "2", "2"]
    surfaces = text.split("\nSurfaces 3\n")[1].splitlines()[:3]
    assert sorted(line.split()[0] for line in surfaces) == ["1", "1", "2"]
    with pytest.raises(planish.InvalidError, match="labels"):
        planish.model(mesh, labels=labels[1:])
    with pytest.raises(planish.InvalidError, match="label_angle is 4"):
        planish.model(mesh, labels=labels, label_angle=4.0)
