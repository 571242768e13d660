"""Beside other packages: each test runs where the package is there."""

import copy
import functools
import pickle

import numpy as np
import pytest
from conftest import ball, sheet

import planish


def test_trimesh():
    trimesh = pytest.importorskip("trimesh")
    points, triangles = ball()
    mesh = planish.Mesh.from_trimesh(trimesh.Trimesh(points, triangles, process=False))
    assert np.array_equal(mesh.points, points) and np.array_equal(mesh.triangles, triangles)
    assert mesh.to_trimesh().is_watertight


def test_meshio(tmp_path):
    meshio = pytest.importorskip("meshio")
    points, triangles = sheet()
    other = meshio.Mesh(points, {"triangle": triangles}, point_data={"height": points[:, 2], "place": points})
    mesh = planish.Mesh.from_meshio(other)
    assert list(mesh) == ["height"] and np.array_equal(mesh["height"], points[:, 2])
    mesh.to_meshio().write(tmp_path / "sheet.ply")
    assert meshio.read(tmp_path / "sheet.ply").points.shape == points.shape
    quads = meshio.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], {"quad": [[0, 1, 2, 3]]})
    assert planish.Mesh.from_meshio(quads).n_triangles == 2
    with pytest.raises(ValueError, match="no triangles"):
        planish.Mesh.from_meshio(meshio.Mesh(points, {"line": [[0, 1]]}))


def test_pyvista(surface):
    pyvista = pytest.importorskip("pyvista")
    plane = pyvista.Plane(i_resolution=4, j_resolution=5)
    plane.point_data["x"] = np.asarray(plane.points[:, 0], float)
    mesh = planish.Mesh.from_pyvista(plane)
    assert (mesh.n_points, mesh.n_triangles, list(mesh)) == (30, 40, ["x"])
    tessellation = surface.tessellate()
    assert tessellation.to_pyvista().n_cells == tessellation.n_triangles


def test_matplotlib(surface, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    surface.plot().figure.savefig(tmp_path / "surface.png")
    assert (tmp_path / "surface.png").read_bytes().startswith(b"\x89PNG")


def test_xarray(spline):
    xarray = pytest.importorskip("xarray")
    u, v = np.linspace(0, 1, 5), np.linspace(0, 1, 4)
    grid = xarray.DataArray(spline.grid(u, v), coords={"u": u, "v": v, "c": list("xyz")}, dims=("u", "v", "c"))
    assert np.allclose(grid.sel(u=0.25, v=0, c="z"), spline(0.25, 0.0)[2])


def test_geomdl(spline):
    pytest.importorskip("geomdl")
    other = spline.to_geomdl()
    # two evaluations of the same cubics with numbers below 1
    assert np.abs(np.array(other.evaluate_single((0.4, 0.6))) - spline(0.4, 0.6)).max() <= 1e-13


def test_scipy_both_ways():
    interpolate = pytest.importorskip("scipy.interpolate")
    x, y = np.linspace(0, 2, 12), np.linspace(0, 1, 9)
    values = np.sin(3 * x)[:, None] * np.cos(4 * y)
    theirs = interpolate.RectBivariateSpline(x, y, values)
    ours = planish.TensorSurface.from_scipy(theirs)
    u, v = np.random.default_rng(0).random((2, 200)) * [[2], [1]]
    assert np.abs(ours.ev(u, v) - theirs.ev(u, v)).max() <= 1e-13
    assert np.abs(ours.ev(u, v, 1, 0) - theirs.ev(u, v, 1, 0)).max() <= 1e-11
    assert np.abs(ours.to_scipy().ev(u, v) - theirs.ev(u, v)).max() <= 1e-13


def test_scipy_agrees_in_space(spline):
    interpolate = pytest.importorskip("scipy.interpolate")
    theirs = interpolate.NdBSpline(spline.knots, np.array(spline.control_points), 3)
    uv = np.random.default_rng(0).random((500, 2))
    assert np.abs(spline.eval(uv) - theirs(uv)).max() <= 1e-13


def _faces(count):
    """Small sheets, each bent otherwise."""
    points, triangles = sheet(12, 9)
    for number in range(count):
        bent = points.copy()
        bent[:, 2] += 0.05 * np.sin((2 + number) * points[:, 0])
        yield planish.Mesh(bent, triangles)


def test_dask_gives_the_serial_result_to_the_bit():
    distributed = pytest.importorskip("dask.distributed")
    meshes = list(_faces(12))
    # of the package alone: workers cannot import a function of this file
    fit = functools.partial(planish.fit, tolerance=1e-2, family="tensor", thread_count=1)
    serial = [fit(mesh).tobytes() for mesh in meshes]
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            spread = client.gather(client.map(fit, meshes))
    assert [surface.tobytes() for surface in spread] == serial


def test_processes_take_surfaces_and_fitters(mesh, surface):
    fitter = planish.FieldFitter(mesh)
    again = pickle.loads(pickle.dumps(fitter))
    values = mesh.points[:, 2]
    assert again.fit(values).tobytes() == fitter.fit(values).tobytes()
    assert copy.copy(surface).report is surface.report


def test_build123d_reads_our_step(surface, tmp_path):
    build123d = pytest.importorskip("build123d")
    surface.write_step(tmp_path / "s.step")
    shape = build123d.import_step(str(tmp_path / "s.step"))
    valid = shape.is_valid() if callable(shape.is_valid) else shape.is_valid
    assert valid and len(shape.faces()) == 1
