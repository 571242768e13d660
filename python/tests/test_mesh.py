import copy
import pickle

import numpy as np
import pytest
from conftest import ball, sheet

import planish


def test_counts_and_arrays(mesh):
    points, triangles = sheet()
    assert (mesh.n_points, mesh.n_triangles, mesh.n_loops, mesh.genus) == (300, 532, 1, 0)
    assert mesh.euler_characteristic == 1 == mesh.n_points - mesh.n_edges + mesh.n_triangles
    assert np.array_equal(mesh.points, points) and np.array_equal(mesh.triangles, triangles)
    assert len(mesh.loops[0]) == 2 * (20 + 15) - 4
    assert mesh.uv is None


def test_arrays_are_read_only(mesh):
    with pytest.raises(ValueError):
        mesh.points[0] = 0


def test_fields_are_a_mapping():
    points, triangles = sheet()
    height = points[:, 2].copy()
    mesh = planish.Mesh(points, triangles, uv=points[:, :2], fields={"height": height})
    assert list(mesh) == ["height"] and "height" in mesh and "width" not in mesh
    assert np.array_equal(mesh["height"], height) and np.array_equal(mesh.uv, points[:, :2])
    with pytest.raises(KeyError, match="width"):
        mesh["width"]
    with pytest.raises(ValueError):
        mesh["height"] = height[:-1]
    assert np.array_equal(mesh["height"], height)


def test_pickling_and_copying_keep_everything():
    points, triangles = sheet()
    mesh = planish.Mesh(points, triangles, fields={"x": points[:, 0]})
    for other in (pickle.loads(pickle.dumps(mesh)), copy.copy(mesh), copy.deepcopy(mesh)):
        assert np.array_equal(other.points, points) and np.array_equal(other["x"], points[:, 0])


def test_closing_twice_is_fine_and_using_it_is_refused():
    with planish.Mesh(*sheet()) as mesh:
        assert mesh.n_points == 300
    mesh.close()
    assert "closed" in repr(mesh)
    with pytest.raises(Exception, match="closed"):
        mesh.n_points


@pytest.mark.parametrize(
    "change, kind, status, index",
    [
        (lambda p, t: p.__setitem__((7, 1), np.nan), ValueError, "not_finite", 7),
        (lambda p, t: t.__setitem__((3, 0), 999), IndexError, "index", 3),
    ],
)
def test_bad_arrays_name_the_offender(change, kind, status, index):
    points, triangles = sheet()
    change(points, triangles)
    with pytest.raises(kind) as caught:
        planish.Mesh(points, triangles)
    assert isinstance(caught.value, planish.Error)
    assert (caught.value.status, caught.value.index) == (status, index)
    again = pickle.loads(pickle.dumps(caught.value))
    assert (str(again), again.status, again.index) == (str(caught.value), status, index)


def test_negative_and_fractional_indices_are_refused():
    points, triangles = sheet()
    with pytest.raises(ValueError, match="outside"):
        planish.Mesh(points, triangles.astype(int) - 1)
    with pytest.raises(ValueError, match="whole"):
        planish.Mesh(points, triangles + 0.5)


def test_missing_files_are_an_oserror(tmp_path):
    with pytest.raises(OSError) as caught:
        planish.read_mesh(tmp_path / "none.stl")
    assert "none.stl" in str(caught.value)


def test_components_and_paths():
    points, triangles = ball()
    two = planish.Mesh(
        np.concatenate([points, points + [5, 0, 0]]), np.concatenate([triangles, triangles + np.uint32(len(points))])
    )
    assert two.n_components == 2
    parts = two.split_components()
    assert [part.n_points for part in parts] == [len(points)] * 2
    path = parts[0].shortest_path(0, 12)
    assert path[0] == 0 and path[-1] == 12 and len(path) >= 3


def test_decimation_keeps_nodes(mesh):
    coarse = mesh.decimate(60)
    assert coarse.n_points == 60 and coarse.report.ok
    known = {tuple(point) for point in mesh.points}
    assert all(tuple(point) in known for point in coarse.points)


def test_parameterize_reports(mesh):
    other = copy.copy(mesh)
    report = other.parameterize(border="circle")
    assert report.flipped_count == 0 and report.stretch >= 1 and other.uv.shape == (300, 2)


def test_closed_meshes_map_to_the_sphere():
    points, triangles = ball()
    places, report = planish.Mesh(points * [1, 2, 3], triangles).map_to_sphere()
    assert report.folded_triangles == 0 and report.energy >= 4
    assert np.abs(np.linalg.norm(places, axis=1) - 1).max() <= 1e-12


def test_rows_can_be_sampled_and_skinned():
    tube = planish.Mesh(*_tube())
    rows = tube.sample_rows(8)
    assert len(rows) == 8 and all(row.shape[1] == 3 for row in rows)


def _tube(n=24, m=12):
    turn, height = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.linspace(0, 3, m))
    points = np.stack([np.cos(turn), np.sin(turn), height], axis=-1).reshape(-1, 3)
    node = np.arange(m * n).reshape(m, n)
    right = np.roll(node, -1, axis=1)
    a, b, c, d = node[:-1].ravel(), right[:-1].ravel(), right[1:].ravel(), node[1:].ravel()
    return points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]).astype(np.uint32)


def test_files_and_bytes_come_back(tmp_path):
    mesh = planish.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    mesh["width"] = [1, 2, 3, 4]
    for name in ["a.off", "a.obj", "a.ply", "a.stl"]:
        mesh.write(tmp_path / name)
        read = planish.read_mesh(tmp_path / name)
        assert read.n_triangles == 2
        assert planish.read_mesh_bytes((tmp_path / name).read_bytes(), format=name[2:]).n_triangles == 2
    assert list(planish.read_mesh(tmp_path / "a.ply")["width"]) == [1, 2, 3, 4]
    mesh.write(tmp_path / "text.stl", text=True)
    assert (tmp_path / "text.stl").read_bytes().startswith(b"solid")


def test_repairs_are_told_and_chosen():
    points, triangles = np.eye(4, 3), [[0, 1, 2], [0, 1, 2]]
    mesh = planish.Mesh(points, triangles)
    assert (mesh.repaired.duplicate_triangle_count, mesh.repaired.unused_node_count) == (1, 1)
    assert list(mesh.triangle_map) == [0] and list(mesh.node_map) == [0, 1, 2, 3]
    with pytest.raises(ValueError, match="'copies'"):
        planish.Mesh(points, triangles, repair="none")


def test_features_of_a_box():
    cube = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
    faces = [(0, 2, 3), (0, 3, 1), (0, 1, 5), (0, 5, 4), (1, 3, 7), (1, 7, 5), (3, 2, 6), (3, 6, 7), (2, 0, 4), (2, 4, 6)]
    edges, report = planish.Mesh(cube, faces + [(4, 5, 7), (4, 7, 6)]).find_features()
    assert len(edges) == 12 and (report.chain_count, report.corner_count) == (12, 8)


def test_labels_tell_their_pieces_and_places_their_triangles():
    points, triangles = ball()
    mesh = planish.Mesh(points, triangles)
    middles = points[triangles].mean(axis=1)
    labels = np.where(np.abs(middles[:, 2]) > 0.5, 9, 4)
    found, sizes, pieces, handles = mesh.label_parts(labels)
    assert found.tolist() == [4, 9] and sizes.tolist() == [np.sum(labels == 4), np.sum(labels == 9)]
    assert pieces.tolist() == [1, 2] and handles.tolist() == [0, 0]
    nearest, places, distances = mesh.project(middles * 1.01)
    assert np.array_equal(nearest, np.arange(len(triangles)))
    assert np.abs(np.linalg.norm(places - middles * 1.01, axis=1) - distances).max() < 1e-15
    nearest, places, distances = mesh.project([[3, 0, 0]], max_distance=0.5)
    assert nearest[0] == 0xFFFF_FFFF and np.isnan(places).all() and np.isnan(distances).all()
    with pytest.raises(planish.InvalidError, match="labels do not fit"):
        mesh.label_parts(labels[1:])
    with pytest.raises(ValueError, match="not finite"):
        mesh.project([0, np.nan, 0])


def test_layouts():
    cube = planish.Layout.cube()
    assert cube.corners.shape == (6, 4) and np.array_equal(cube.valences, np.full(8, 3)) and len(cube.edges) == 12
    again = planish.Layout(cube.corners)
    assert again.n_vertices == 8 and len(again.node_map[0]) == 0
    layout = planish.Layout.of_mesh(planish.Mesh(*ball()))
    quads, uv = layout.node_map
    assert len(quads) == len(ball()[0]) and quads.max() < len(layout.corners) and uv.min() >= 0 and uv.max() <= 1
    with pytest.raises(ValueError):
        planish.Layout([[0, 1, 2, 2]])


def test_arrays_that_lie_askew_in_memory_are_copied():
    points, triangles = sheet()
    askew = np.frombuffer(b"\0" + points.tobytes(), np.float64, offset=1).reshape(points.shape)
    assert not askew.flags.aligned
    mesh = planish.Mesh(askew, triangles)
    assert np.array_equal(mesh.points, points)
