"""A coarse control mesh becomes smooth, but for its sharp edges; moving a vertex moves the surface around it.

Output: sharp edges: 8
"""

import numpy as np

import planish

cube = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
faces = [(0, 2, 3), (0, 3, 1), (0, 1, 5), (0, 5, 4), (1, 3, 7), (1, 7, 5), (3, 2, 6), (3, 6, 7), (2, 0, 4), (2, 4, 6)]
surface = planish.smooth_creased(planish.Mesh(cube, faces), sharp_angle=0.7)
before = surface.tessellate().points
surface.set_control_points([3], [[1.2, 1.2, 0.0]])
after = surface.tessellate().points
print("the surface moved by up to", np.abs(after - before).max() if after.shape == before.shape else "a new tessellation")
print("sharp edges:", len(surface.sharp_edges))
