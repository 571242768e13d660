"""Shapes that the tests fit: seeded, small, made here."""

import numpy as np
import pytest

import planish


def grid_triangles(n, m):
    """Two triangles for each cell of an n x m grid of nodes."""
    node = np.arange(n * m).reshape(n, m)
    a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]))
    return np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]).astype(np.uint32)


def sheet(n=20, m=15):
    """A wavy sheet of n x m nodes over [0,2] x [0,1]."""
    x, y = np.meshgrid(np.linspace(0, 2, n), np.linspace(0, 1, m), indexing="ij")
    points = np.stack([x, y, 0.2 * np.sin(3 * x) * np.cos(4 * y)], axis=-1).reshape(-1, 3)
    return points, grid_triangles(n, m)


def ball(n=24, m=13, radius=1.0):
    """A closed ball of latitude circles and two poles."""
    angle = np.linspace(0, np.pi, m)[1:-1]
    turn = np.linspace(0, 2 * np.pi, n, endpoint=False)
    ring = np.stack(
        [np.outer(np.sin(angle), np.cos(turn)), np.outer(np.sin(angle), np.sin(turn)), np.outer(np.cos(angle), np.ones(n))],
        axis=-1,
    ).reshape(-1, 3)
    points = radius * np.concatenate([ring, [[0, 0, 1], [0, 0, -1]]])
    node = np.arange((m - 2) * n).reshape(m - 2, n)
    right = np.roll(node, -1, axis=1)
    a, b, c, d = node[:-1].ravel(), node[1:].ravel(), right[1:].ravel(), right[:-1].ravel()
    top, bottom = (m - 2) * n, (m - 2) * n + 1
    triangles = np.concatenate(
        [
            np.stack([a, b, c], 1),
            np.stack([a, c, d], 1),
            np.stack([np.full(n, top), node[0], right[0]], 1),
            np.stack([np.full(n, bottom), right[-1], node[-1]], 1),
        ]
    )
    return points, triangles.astype(np.uint32)


@pytest.fixture(scope="session")
def mesh():
    return planish.Mesh(*sheet())


@pytest.fixture(scope="session")
def surface(mesh):
    """A tensor fit of the sheet."""
    return planish.fit(mesh, 1e-3, "tensor")


@pytest.fixture
def spline():
    """A bicubic surface with random control points."""
    knots = np.r_[[0.0] * 3, np.linspace(0, 1, 20), [1.0] * 3]
    n = len(knots) - 4
    return planish.tensor(knots, knots, np.random.default_rng(1).random((n, n, 3)))
