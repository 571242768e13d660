"""What a user writes, for `mypy --strict`: each result has the type that the manual tells, and what is wrong is found.

Never run. An `ignore` that nothing needs is an error to the checker, so each marks a mistake that it finds.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from typing_extensions import assert_type

import planish


def told(fraction: float, error: float, stage: str) -> bool:
    return fraction < 0.5 or stage != "solve"


def scan(path: str) -> float:
    with planish.read_mesh(path, weld_distance=1e-6) as mesh:
        assert_type(mesh, planish.Mesh)
        assert_type(mesh.n_points, int)
        assert_type(mesh.loops, list[np.ndarray])
        assert_type(mesh.repaired.unused_node_count, int)
        coarse = mesh.decimate(500)
        assert_type(coarse.report.status, str)
        surface = planish.fit(mesh, tolerance=1e-3, family="pht", progress=told)
    assert_type(surface, planish.Surface)
    assert_type(surface.domain, tuple[float, float, float, float])
    assert_type(surface.curvatures([[0.5, 0.5]]).k1, np.ndarray)
    assert_type(surface.tessellate(chord_tolerance=0.1), planish.Mesh)
    distances, report = surface.deviation(mesh)
    assert_type(report, planish.Report)
    assert_type(report.signed, np.ndarray)
    assert_type(distances, np.ndarray)
    fitted = surface.report
    assert fitted is not None
    assert_type(fitted.remarks, frozenset[str])
    assert_type(fitted.coefficient_count, int)
    return fitted.max_error


def solid(points: Any, triangles: Any) -> planish.Model:
    model = planish.model(planish.Mesh(points, triangles), tolerance=0.1, absolute=True)
    faces, uv = model.locate_nodes()
    assert_type(model.eval(faces, uv), np.ndarray)
    assert_type(model.face(0).carrier, str)
    assert_type(model.edge(0).curve, planish.Curve)
    assert_type(model.measure().volume, float)
    return model


def mistakes(mesh: planish.Mesh, surface: planish.Surface) -> None:
    planish.fit(mesh, tolerance="1e-3")  # type: ignore[arg-type]
    mesh.points()  # type: ignore[operator]
    surface.eval()  # type: ignore[call-arg]
    surface.tesselate()  # type: ignore[attr-defined]
    surface.report.max_error  # type: ignore[union-attr]
    if surface.report is not None:
        surface.report.max_eror  # type: ignore[attr-defined]


def refused(path: str) -> int | None:
    try:
        planish.load(path)
    except planish.FileError as error:
        return error.index
    return None
