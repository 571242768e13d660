"""Shapes that the tests fit: made here, in millimetres."""

import Mesh
import numpy as np


def of_arrays(points, triangles):
    """A Mesh.MeshObject."""
    return Mesh.Mesh(np.asarray(points)[np.asarray(triangles)].tolist())


def sheet(n=30, m=20):
    """A wavy sheet of 100 x 60 mm."""
    x, y = np.meshgrid(np.linspace(0, 100, n), np.linspace(0, 60, m), indexing="ij")
    points = np.stack([x, y, 6 * np.sin(x / 20) * np.cos(y / 15)], axis=-1).reshape(-1, 3)
    node = np.arange(n * m).reshape(n, m)
    a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]))
    return of_arrays(points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]))


def jagged(n=60):
    """A dome of 90 mm whose border follows the edges of a grid, as borders of scans do."""
    x, y = np.meshgrid(np.linspace(-50, 50, n), np.linspace(-50, 50, n), indexing="ij")
    points = np.stack([x, y, 8 * np.cos(x / 25) * np.cos(y / 33)], axis=-1).reshape(-1, 3)
    node = np.arange(n * n).reshape(n, n)
    a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]))
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    inside = np.hypot(*points[triangles].mean(axis=1)[:, :2].T) < 45
    return of_arrays(points, triangles[inside])


def ball():
    """A closed ball, radius 20 mm."""
    return Mesh.createSphere(20.0, 40)


def open_box():
    """A coarse box of 20 mm without its lid: a control mesh with sharp edges."""
    points = 20.0 * np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)])
    faces = [(0, 2, 3), (0, 3, 1), (0, 1, 5), (0, 5, 4), (1, 3, 7), (1, 7, 5), (3, 2, 6), (3, 6, 7), (2, 0, 4), (2, 4, 6)]
    return of_arrays(points, faces)


def bar():
    """A round bar of radius 10 and length 30, 60 facets around."""
    return Mesh.createCylinder(10.0, 30.0, True, 2.0, 60)
