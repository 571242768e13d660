"""A thousand faces are fitted by two processes of dask, as a cluster would do it; each is the one that a single process makes.

Output: the same to the bit: True
"""

import functools

import numpy as np
from dask.distributed import Client, LocalCluster

import planish


def face(number):
    """A small sheet of 20 x 15 places, each bent otherwise."""
    x, y = np.meshgrid(np.linspace(0, 2, 20), np.linspace(0, 1, 15), indexing="ij")
    points = np.stack([x, y, 0.2 * np.sin(3 * x + 0.01 * number) * np.cos(4 * y)], axis=-1).reshape(-1, 3)
    node = np.arange(300).reshape(20, 15)
    a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]))
    return planish.Mesh(points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]))


# one thread each: the processes share the cores. Meshes and surfaces travel pickled.
fit = functools.partial(planish.fit, tolerance=1e-2, family="tensor", thread_count=1)

if __name__ == "__main__":
    meshes = [face(number) for number in range(1000)]
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        surfaces = client.gather(client.map(fit, meshes, batch_size=50))
    missed = [number for number, surface in enumerate(surfaces) if not surface.report.ok]
    print(len(surfaces), "faces, tolerance missed by", len(missed))
    print("the same to the bit:", all(surface.tobytes() == fit(mesh).tobytes() for surface, mesh in zip(surfaces, meshes)))
