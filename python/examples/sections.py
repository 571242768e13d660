"""Sections of unlike counts become one surface without an explosion of knots.

Output: tolerance met
"""

import numpy as np

import planish

rng = np.random.default_rng(1)
rows = []
for height in np.linspace(0, 3, 8):
    count = int(rng.integers(18, 45))
    turn = np.linspace(0, 2 * np.pi, count, endpoint=False)
    radius = 1 + 0.2 * np.sin(height) + 0.1 * np.cos(3 * turn)
    rows.append(np.stack([radius * np.cos(turn), radius * np.sin(turn), np.full(count, height)], axis=1))

surface = planish.skin(rows, 1e-3, closed=True)
print([len(row) for row in rows], "points in a row:", surface)
print("tolerance met" if surface.report.max_error <= surface.report.tolerance else surface.report.status)
