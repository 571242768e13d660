import _thread
import signal
import threading
import time

import numpy as np
import pytest
from conftest import sheet

import planish


def wave(count=4000, seed=0):
    uv = np.random.default_rng(seed).random((count, 2))
    return uv, np.sin(9 * uv[:, 0]) * uv[:, 1]


@pytest.mark.parametrize("family", ["auto", "tensor", "pht", "d1rc"])
def test_families_keep_the_tolerance_and_report_each_node(mesh, family):
    surface = planish.fit(mesh, 5e-3, family)
    report = surface.report
    assert report.ok and report.max_error <= report.tolerance == 5e-3 * report.diagonal
    places = surface.eval(report.uv, outside="extrapolate")
    errors = np.linalg.norm(places - mesh.points, axis=1)
    assert np.abs(errors - report.errors).max() <= 1e-12 * report.diagonal
    assert report.errors.max() == report.max_error and report.errors.argmax() == report.worst_index


def test_a_missed_tolerance_is_told_not_raised(mesh):
    surface = planish.fit(mesh, 1e-9, "tensor", max_grid=5)
    assert surface.report.status in ("tolerance_not_met", "stagnated") and not surface.report.ok
    assert surface.report.max_error > surface.report.tolerance


def test_absolute_tolerances(mesh):
    assert planish.fit(mesh, 0.01, "tensor", absolute=True).report.tolerance == 0.01


def test_remarks_are_words(mesh):
    remarks = planish.fit(mesh, 1e-2, "tensor").report.remarks
    assert isinstance(remarks, frozenset) and "parameterized" in remarks


def test_wrong_choices_list_the_right_ones(mesh):
    with pytest.raises(ValueError, match="'tensor', 'pht'"):
        planish.fit(mesh, 1e-3, "nurbs")
    with pytest.raises(ValueError, match="least_squares"):
        planish.fit(mesh, 1e-3, "tensor", method="magic")


def test_points_and_fields(mesh):
    uv, values = wave()
    surface = planish.fit_points(uv, values)
    assert surface.report.ok and surface.dim == 1 and surface.ev(0.5, 0.5).shape == ()
    points = mesh.points
    field = planish.fit_field(mesh, np.stack([points[:, 2], points[:, 0]], axis=1), 1e-2)
    assert field.dim == 2 and field.report.ok


def test_progress_raises_what_it_raises():
    uv, values = wave()

    def divide(*_):
        return 1 / 0

    with pytest.raises(ZeroDivisionError):
        planish.fit_points(uv, values, 1e-6, progress=divide)
    with pytest.raises(planish.Cancelled):
        planish.fit_points(uv, values, 1e-6, progress=lambda *_: False)


def test_progress_rises():
    heard = []
    planish.fit_points(*wave(), progress=lambda fraction, *_: heard.append(fraction))
    assert heard and heard == sorted(heard) and 0 <= heard[0] and heard[-1] <= 1


def test_ctrl_c_arrives_while_a_fit_runs():
    n = 400
    mesh = planish.Mesh(*sheet(n, n))
    # shells start jobs in the background without it
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    started = time.perf_counter()
    threading.Timer(0.3, _thread.interrupt_main).start()
    try:
        with pytest.raises(KeyboardInterrupt):
            planish.fit(mesh, 1e-9, "tensor")
    finally:
        signal.signal(signal.SIGINT, before)
    # 160,000 nodes at this tolerance take many times as long
    assert time.perf_counter() - started < 20


def test_fits_run_on_any_thread(mesh):
    results = {}

    def work(number):
        results[number] = planish.fit(mesh, 1e-3, "tensor", thread_count=1).tobytes()

    threads = [threading.Thread(target=work, args=(number,)) for number in range(4)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert len(set(results.values())) == 1 and len(results) == 4


def test_skins_take_rows_of_unlike_counts():
    rows = [
        np.stack([np.linspace(0, 1, n), np.full(n, y), 0.1 * np.sin(5 * np.linspace(0, 1, n) + y)], axis=1)
        for y, n in zip(np.linspace(0, 1, 6), (20, 31, 25, 28, 22, 40))
    ]
    surface = planish.skin(rows, 1e-3)
    assert surface.kind == "tspline" and surface.report.ok and surface.report.skin is not None
    with pytest.raises(ValueError, match="rows"):
        planish.skin([rows[0], rows[1][:, :2]])


def test_creases_stay_sharp():
    cube = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
    faces = [(0, 2, 3), (0, 3, 1), (0, 1, 5), (0, 5, 4), (1, 3, 7), (1, 7, 5), (3, 2, 6), (3, 6, 7), (2, 0, 4), (2, 4, 6)]
    surface = planish.smooth_creased(planish.Mesh(cube, faces), sharp_angle=0.7)
    assert surface.kind == "d1rc" and len(surface.sharp_edges) > 0


def test_curves():
    u = np.linspace(0, 1, 200)
    circle = np.stack([np.cos(u), np.sin(u)], axis=1)
    curve = planish.fit_curve(u, circle, 1e-4)
    assert curve.report.ok and abs(np.diff(curve.arc_lengths([0.0, 1.0]))[0] - 1) < 1e-3
    assert curve.length() >= 1  # it goes on a little beyond the data
    through = planish.interpolate_curve(u[::20], circle[::20])
    assert np.abs(through(u[::20]) - circle[::20]).max() <= 1e-13
    where, distances = through.project(circle[::20])
    assert np.abs(where - u[::20]).max() <= 1e-6 and distances.max() <= 1e-12


def test_field_fitters_are_used_again(mesh):
    points = mesh.points
    fitter = planish.FieldFitter(mesh)
    field = fitter.fit(points[:, 2])
    places = field.eval(fitter.uv, outside="extrapolate")[:, 0]
    assert np.abs(np.abs(places - points[:, 2]).max() - field.report.max_error) <= 1e-12
    fitter.update(field, 2 * points[:, 2])
    assert np.abs(field.eval(fitter.uv, outside="extrapolate")[:, 0] - 2 * places).max() <= 1e-12


def test_transfers_conserve_sums(mesh):
    targets = mesh.points[::7] * [1, 1, 0.999]
    transfer = planish.Transfer(mesh, targets)
    ones = transfer(np.ones(mesh.n_points))
    assert np.abs(ones - 1).max() <= 1e-12
    forces = np.random.default_rng(0).random((len(targets), 3))
    nodal = transfer.apply_transpose(forces)
    assert np.abs(nodal.sum(axis=0) - forces.sum(axis=0)).max() <= 1e-12 * len(targets)


@pytest.mark.parametrize("family", ["tensor", "pht"])
def test_single_data_have_demands_of_their_own(family):
    uv, values = wave(1500)
    fixed = [3, 700, 41]
    surface = planish.fit_points(uv, values, 1e-2, family, fixed=fixed)
    assert surface.report.errors[fixed].max() <= 1e-12 * surface.report.diagonal
    assert surface.report.max_fixed_error == surface.report.errors[fixed].max()
    tolerances = np.where(uv[:, 0] < 0.5, 1e-3, np.inf)
    report = planish.fit_points(uv, values, 1e-2, family, tolerances=tolerances).report
    assert report.ok and (report.errors[uv[:, 0] < 0.5] <= 1e-3 * report.diagonal).all()
    spikes = [10, 500, 900]
    values = values.copy()
    values[spikes] += 0.7
    report = planish.fit_points(uv, values, 1e-2, family, outlier_share=0.01).report
    assert report.ok and report.left_out.tolist() == spikes and report.left_out_count == 3


def test_demands_that_cannot_be_met_are_refused():
    uv, values = wave(100)
    uv[5] = uv[9]
    with pytest.raises(planish.InvalidError, match="5 and 9"):
        planish.fit_points(uv, values, fixed=[9, 5])
    with pytest.raises(planish.RangeError, match="there are 100"):
        planish.fit_points(uv, values, fixed=[100])


@pytest.mark.parametrize("family", ["tensor", "pht"])
def test_symmetric_shapes_give_symmetric_surfaces(family):
    u, v = np.meshgrid(np.linspace(-1, 1, 26), np.linspace(0, 1, 20), indexing="ij")
    u = np.sign(u) * np.abs(u) ** 1.2
    points, triangles = sheet(26, 20)
    points = np.stack([u, v, 0.2 * np.cos(2 * u) * (1 + v)], axis=-1).reshape(-1, 3)
    mesh = planish.Mesh(points, triangles)
    surface = planish.fit(mesh, 3e-3, family, symmetry="about", plane=[0, 0, 0, 1, 0, 0])
    assert surface.report.ok
    uv = np.random.default_rng(1).uniform([-1, 0], [1, 1], (200, 2))
    own, image = surface.eval(uv), surface.eval(uv * [-1, 1])
    assert np.abs(own - image * [-1, 1, 1]).max() <= 1e-13
    found = planish.fit(mesh, 3e-3, family, symmetry="found").report
    assert np.abs(np.abs(found.plane[1]) - [1, 0, 0]).max() < 1e-2
    with pytest.raises(planish.InvalidError, match="not symmetric"):
        planish.fit(mesh, 1e-3, family, symmetry="about", plane=[0, 0.5, 0, 1, 1, 0])


def test_noise_is_made_fair():
    uv, values = wave(3000)
    noisy = values + np.random.default_rng(2).uniform(-0.01, 0.01, values.shape)
    rough = planish.fit_points(uv, noisy, 0.03, absolute=True, grid_u=24, grid_v=24, smoothing=1e-9)
    fair = rough.fair(0.03, uv=uv, values=noisy, absolute=True)
    assert fair.report.energy_after < 0.1 * fair.report.energy_before and fair.report.max_deviation <= 0.03
    near = rough.fair(0.01, absolute=True, energy="curvature_variation", border="position")
    assert np.abs(near.eval(uv) - rough.eval(uv)).max() <= near.report.max_movement <= 0.01
    with pytest.raises(planish.InvalidError, match="misses datum"):
        rough.fair(1e-3, uv=uv, values=noisy, absolute=True)
