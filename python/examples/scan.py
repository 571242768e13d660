"""A scan becomes a smooth surface, a STEP file and a list of its worst places.

Output: tolerance met
"""

import tempfile
from pathlib import Path

import numpy as np

import planish


def scan():
    """What a scanner gives: a noisy dome of 50 x 50 places."""
    x, y = np.meshgrid(np.linspace(-1, 1, 50), np.linspace(-1, 1, 50), indexing="ij")
    noise = np.random.default_rng(0).normal(scale=2e-4, size=x.shape)
    points = np.stack([x, y, 0.5 * np.exp(-(x**2 + y**2)) + noise], axis=-1).reshape(-1, 3)
    node = np.arange(2500).reshape(50, 50)
    a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]))
    return planish.Mesh(points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]))


mesh = scan()
surface = planish.fit(mesh, tolerance=1e-3)
worst = np.argsort(-surface.report.errors)[:3]
print(surface)
print("worst nodes:", worst, surface.report.errors[worst])
with tempfile.TemporaryDirectory() as folder:
    surface.write_step(Path(folder) / "dome.step")
print("tolerance met" if surface.report.ok else surface.report.status)
