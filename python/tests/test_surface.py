import copy
import ctypes
import pickle

import numpy as np
import pytest

import planish

EPSILON = np.finfo(float).eps


def queries(count=500, seed=0):
    return np.random.default_rng(seed).random((count, 2))


def test_calls_broadcast(spline):
    assert spline(0.5, 0.5).shape == (3,)
    assert spline(np.zeros((4, 1)), np.zeros(5)).shape == (4, 5, 3)
    assert np.array_equal(spline(0.25, 0.5), spline.eval([0.25, 0.5]))


def test_out_is_filled_and_checked(spline):
    out = np.empty((7, 3))
    assert spline.eval(np.full((7, 2), 0.5), out=out) is out and np.all(np.isfinite(out))
    with pytest.raises(ValueError, match="out"):
        spline.eval(np.full((7, 2), 0.5), out=np.empty((7, 2)))
    with pytest.raises(ValueError, match="out"):
        spline.eval(np.full((7, 2), 0.5), out=np.empty((7, 3), np.float32))


def test_grid_agrees_with_points(spline):
    u, v = np.linspace(0, 1, 5), np.linspace(0, 1, 4)
    # the same cubics, summed in another order: some 16 products of numbers below 1
    assert np.abs(spline.grid(u, v) - spline(u[:, None], v)).max() <= 64 * EPSILON


def test_derivatives_agree_with_differences(spline):
    uv, step = 0.1 + 0.8 * queries(50), 1e-5
    jets = spline.derivatives(uv, 2)
    for axis, rows in enumerate(((0, 1), (0, 2))):
        shift = np.eye(2)[axis] * step
        difference = (spline.eval(uv + shift) - spline.eval(uv - shift)) / (2 * step)
        # central differences: the third derivative of a cubic with spans of 1/19 is below 6 * 8 * 19^3
        assert np.abs(jets[:, rows[1]] - difference).max() <= 8 * 19**3 * step**2 + 4 * EPSILON / step
    assert np.array_equal(spline.ev(uv[:, 0], uv[:, 1], 1, 1), jets[:, 4])
    with pytest.raises(ValueError):
        spline.ev(0.5, 0.5, 3, 0)


def test_outside_is_an_error_a_flag_or_continued(spline):
    with pytest.raises(ValueError) as caught:
        spline(2.0, 0.5)
    assert caught.value.status == "outside" and caught.value.index == 0
    assert np.isnan(spline(2.0, 0.5, outside="flag")).all()
    assert np.isfinite(spline(2.0, 0.5, outside="extrapolate")).all()
    with pytest.raises(ValueError, match="'fail', 'flag', 'extrapolate'"):
        spline(0.5, 0.5, outside="ignore")


def test_unknown_options_list_the_known_ones(spline, mesh):
    with pytest.raises(TypeError, match="smoothing"):
        planish.fit(mesh, tolerence=1)
    with pytest.raises(TypeError, match="thread_count"):
        spline(0.5, 0.5, threads=1)


def test_parts_make_the_same_surface(spline):
    again = planish.tensor(*spline.knots, spline.control_points)
    uv = queries()
    assert np.array_equal(again.eval(uv), spline.eval(uv))
    assert spline.degrees == (3, 3) and spline.weights is None
    with pytest.raises(ValueError, match="degrees"):
        planish.tensor(*spline.knots, spline.control_points, degrees=(2, 2))


def test_bezier_patches_are_the_surface(spline):
    patches = spline.bezier_patches()
    assert len(patches) == 19 * 19
    for patch in patches[::50]:
        u0, u1, v0, v1 = patch.domain
        # the corners of a Bezier patch are its first and last control points
        corners = patch.control_points[[0, 0, -1, -1], [0, -1, 0, -1]]
        assert np.abs(corners - spline([u0, u0, u1, u1], [v0, v1, v0, v1])).max() <= 64 * EPSILON


def test_editing_keeps_the_shape(spline):
    uv = queries()
    before = spline.eval(uv)
    spline.insert_knots(0, [0.31, 0.32])
    spline.elevate_degree(1, 4)
    assert spline.degrees == (3, 4)
    assert np.abs(spline.eval(uv) - before).max() <= 1e3 * EPSILON
    low, high = spline.split(0, 0.5)
    assert low.domain[:2] == (0, 0.5) and high.domain[:2] == (0.5, 1)


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda s: pickle.loads(pickle.dumps(s))])
def test_copies_are_equal_and_independent(surface, copied):
    other = copied(surface)
    u0, u1, v0, v1 = surface.data_box
    uv = [u0, v0] + queries() * [u1 - u0, v1 - v0]
    assert np.array_equal(other.eval(uv, outside="extrapolate"), surface.eval(uv, outside="extrapolate"))
    assert other.report.max_error == surface.report.max_error
    other.trims = []
    assert len(surface.trims) == 1 and not other.trims


def test_files_come_back(surface, tmp_path):
    surface.save(tmp_path / "s.planish")
    assert planish.load(tmp_path / "s.planish").tobytes() == surface.tobytes() == planish.loads(surface.tobytes()).tobytes()
    report = surface.write_step(tmp_path / "s.step")
    assert report.ok and (tmp_path / "s.step").read_text().startswith("ISO-10303-21;")
    surface.write_vtk(tmp_path / "s.vtu")
    assert (tmp_path / "s.vtu").stat().st_size > 1000
    with pytest.raises(OSError):
        surface.save(tmp_path / "no" / "folder")
    with pytest.raises(OSError):
        planish.loads(surface.tobytes()[:-1])


def test_reports_are_one_page(surface, mesh, tmp_path):
    surface.write_report(tmp_path / "sheet.html", mesh, title="A <sheet>")
    text = (tmp_path / "sheet.html").read_text()
    assert "A &lt;sheet&gt;" in text and "Tolerance met" in text and "http" not in text
    assert len(text) < 1_000_000


def test_projection_finds_the_surface(surface, mesh):
    uv, distances = surface.project(mesh.points)
    assert uv.shape == (300, 2) and np.all(distances <= surface.report.errors + 1e-12 * surface.report.diagonal)
    gaps = np.linalg.norm(surface.eval(uv, outside="extrapolate") - mesh.points, axis=1)
    assert np.abs(gaps - distances).max() <= 1e-12 * surface.report.diagonal


def test_deviation_reports_both_ways(surface, mesh):
    distances, report = surface.deviation(mesh)
    assert distances.shape == (300,) and report.max_distance == distances.max()
    assert report.median_distance == np.sort(distances)[149] and report.distance_99 <= report.max_distance
    assert np.array_equal(np.abs(report.signed), distances)
    raised = planish.Mesh(mesh.points + [0, 0, 0.05], mesh.triangles)
    assert np.all(surface.deviation(raised)[1].signed > 0) == (surface.normals(report.uv)[:, 2].min() > 0)


def test_tessellation_follows_the_trims(surface):
    triangles = surface.tessellate()
    assert triangles.n_loops == len(surface.trims) == 1 and triangles.n_points > 20


def test_trims_follow_curves():
    sheet = planish.tensor([0, 0, 1, 1], [0, 0, 1, 1], np.array([[[0, 0, 0], [0, 4, 0]], [[4, 0, 0], [4, 4, 0.0]]]))
    angle = np.linspace(0, 2 * np.pi, 65)
    ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)
    ring[-1] = ring[0]
    big, small = (planish.interpolate_curve(angle, [2, 2, 0] + radius * ring, ends="periodic") for radius in (1.5, 0.5))
    report = sheet.trim_by_curves([big, [small]], 1e-4, absolute=True)
    assert report.ok and max(report.max_vertex_distance, report.max_distance_between) <= 1e-4
    assert report.vertex_count == sum(map(len, sheet.trims)) and len(sheet.trims) == 2
    # a vertex is on its circle, but for the cubic's 5/384 h^4
    assert np.abs(np.hypot(*(4 * sheet.trims[1] - 2).T) - 0.5).max() < 2e-6
    with pytest.raises(planish.InvalidError, match="not closed"):
        sheet.trim_by_curves([planish.interpolate_curve(angle[:9], ring[:9])])
    assert len(sheet.trims) == 2


def test_normals_and_curvatures_of_a_cylinder():
    # a quarter of a cylinder of radius 2 as a rational quadratic arc
    points = np.array([[[2, 0, z], [2, 2, z], [0, 2, z]] for z in (0.0, 1.0)]).transpose(1, 0, 2)
    weights = np.outer([1, np.sqrt(0.5), 1], [1, 1])
    arc = planish.tensor([0, 0, 0, 1, 1, 1], [0, 0, 1, 1], points, weights)
    uv = queries(20)
    places, normals, curvatures = arc.eval(uv), arc.normals(uv), arc.curvatures(uv)
    outward = places * [0.5, 0.5, 0]
    assert np.abs(np.abs(np.einsum("ij,ij->i", normals, outward)) - 1).max() <= 64 * EPSILON
    known = np.sort(np.abs(np.stack([curvatures.k1, curvatures.k2])), axis=0)
    assert np.abs(known[0]).max() <= 1e-12 and np.abs(known[1] - 0.5).max() <= 1e-12


def test_a_surface_says_how_large_it_is():
    knots_u, knots_v = [0, 0, 1, 2, 3, 4, 4], [0, 0, 1, 1]
    outline = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]], float)
    points = np.stack([np.column_stack([outline, np.full(5, z)]) for z in (0.0, 3.0)], axis=1)
    tube = planish.tensor(knots_u, knots_v, points)
    assert tube.box.tolist() == [[0, 0, 0], [1, 1, 3]]
    assert abs(tube.area() - 12) < 1e-12
    assert tube.is_closed("u") and not tube.is_closed("v")
    with pytest.raises(ValueError):
        tube.is_closed("w")


def test_name_and_unit_are_kept(spline, tmp_path):
    assert (spline.name, spline.unit) == ("", "millimetre")
    spline.name, spline.unit = "Flügel", "metre"
    path = tmp_path / "wing.planish"
    spline.save(path)
    for same in (planish.load(path), copy.copy(spline), pickle.loads(pickle.dumps(spline))):
        assert (same.name, same.unit) == ("Flügel", "metre")
    with pytest.raises(ValueError):
        spline.unit = "furlong"


def test_pht_splines_are_edited_where_they_are_split():
    lines = [0.0, 0.5, 1.0]
    flat = planish.pht(lines, lines, [], np.zeros((9, 4, 1)))
    flat.split_cells([0, 0, 0])
    assert len(flat.cells) == 7 and flat.control_points.shape == (len(flat.vertices), 4, 1)
    uv, hosts = flat.hanging_vertices
    assert len(uv) == len(hosts) == 2 and hosts.max() < len(flat.cells)
    middle = int(np.argmin(((flat.vertices - 0.25) ** 2).sum(axis=1)))
    flat.set_vertex_data([middle], [[[1.0], [0.0], [0.0], [0.0]]])
    assert flat.ev(0.25, 0.25) == 1.0 and flat.ev(0.75, 0.75) == 0.0
    extraction = flat.extraction(flat.cell_at(0.3, 0.3))
    assert extraction.matrix.shape == (16, 4 * len(extraction.vertices))
    # functions of the paper's basis sum to one everywhere: so do the rows
    assert np.abs(extraction.matrix.sum(axis=1) - 1).max() <= 1e-14
    flat.merge_cells([0, 0, 0])
    assert len(flat.cells) == 4


def test_a_closed_handle_is_told(spline):
    spline.close()
    with pytest.raises((ValueError, ctypes.ArgumentError), match="closed"):
        spline(0.5, 0.5)
