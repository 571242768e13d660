"""Fits: scattered samples beside FITPACK, called through scipy, and meshes without parameters.

The ridges surface is warped in x and y; its z has two ridges, waves and twelve bumps. It is sampled at uniform
random (u,v). Errors are distances at the given (u,v) over the diagonal of the samples' box; held-out ones are at
samples that the fit has not seen. Seconds are wall time, median of five with least and largest.

Usage: fits.py libplanish.so [RIDGES HELD_OUT]   (files of u v x y z, little-endian doubles)
"""

import sys
import time

import numpy as np
from scipy.interpolate import LSQBivariateSpline
from scipy.spatial import Delaunay

from library import RUNS, STOPS, Library, race

TOLERANCE = 1e-3
THREADS = 2
# FITPACK is given its knots, for this many coefficients along u and along v: its time grows fast with them.
FITPACK_COUNT = 40

# center u, center v, width, height
BUMPS = np.array([
    (0.6126, 0.8575, 0.0251, -0.0330), (0.3201, 0.8362, 0.0081, 0.0385), (0.7674, 0.4711, 0.0147, -0.0266),
    (0.2794, 0.4506, 0.0191, 0.0064), (0.9460, 0.7634, 0.0217, 0.0587), (0.2438, 0.1942, 0.0215, -0.0547),
    (0.0821, 0.5134, 0.0183, 0.0501), (0.6163, 0.5127, 0.0189, -0.0303), (0.0606, 0.2232, 0.0232, -0.0359),
    (0.3826, 0.0534, 0.0263, -0.0415), (0.2908, 0.8423, 0.0192, 0.0417), (0.6257, 0.7176, 0.0100, 0.0049),
])


def ridges(u, v):
    x = u + 0.16 * u * (1 - u) * np.sin(2 * np.pi * v)
    y = v + 0.04 * np.sin(2 * np.pi * u)
    z = (0.15 * np.sin(2 * np.pi * u) * np.cos(1.5 * np.pi * v) + 0.10 * u * v
         + 0.08 * np.cos(3 * np.pi * (u - 0.3 * v))
         + 0.10 / np.cosh((v - 0.30 - 0.15 * np.sin(2.5 * u)) / 0.02)
         + 0.06 * np.tanh((u - 0.65 - 0.10 * v**2) / 0.015))
    for cu, cv, width, height in BUMPS:
        z += height * np.exp(-((u - cu)**2 + (v - cv)**2) / (2 * width**2))
    return np.stack([x, y, z], axis=-1)


def sampled(count, seed):
    uv = np.random.default_rng(seed).uniform(0, 1, (count, 2))
    return uv, ridges(*uv.T)


def read(path):
    rows = np.fromfile(path, "<f8").reshape(-1, 5)
    return np.ascontiguousarray(rows[:, :2]), np.ascontiguousarray(rows[:, 2:])


def peaks(x, y):
    return (3 * (1 - x)**2 * np.exp(-(x**2) - (y + 1)**2)
            - 10 * (x / 5 - x**3 - y**5) * np.exp(-(x**2) - y**2)
            - np.exp(-((x + 1)**2) - y**2) / 3)


def franke(x, y):
    return (0.75 * np.exp(-((9 * x - 2)**2 + (9 * y - 2)**2) / 4)
            + 0.75 * np.exp(-((9 * x + 1)**2) / 49 - (9 * y + 1) / 10)
            + 0.5 * np.exp(-((9 * x - 7)**2 + (9 * y - 3)**2) / 4)
            - 0.2 * np.exp(-((9 * x - 4)**2) - (9 * y - 7)**2))


def row(*cells):
    print("row\t" + "\t".join(cells), flush=True)


def spread(seconds):
    return f"{seconds[RUNS // 2]:.3g} ({seconds[0]:.3g} to {seconds[-1]:.3g})"


def largest(values, exact, diagonal):
    return f"{np.linalg.norm(values - exact, axis=1).max() / diagonal:.2e}"


class Ours:
    def __init__(self, library, uv, values, **changes):
        changes = {"tolerance": TOLERANCE, "thread_count": THREADS, **changes}
        self.call = lambda: library.fit_points(uv, values, **changes)

    def __call__(self):
        _, self.surface, self.report = self.call()

    def coefficient_count(self):
        return self.report.coefficient_count

    def eval(self, uv):
        out = np.empty((len(uv), 3))
        self.surface.eval(np.ascontiguousarray(uv), out)
        return out


class Fitpack:
    def __init__(self, uv, values):
        self.uv, self.values = uv, values

    def __call__(self):
        knots = np.linspace(0, 1, FITPACK_COUNT - 2)[1:-1]
        self.splines = [
            LSQBivariateSpline(*self.uv.T, z, knots, knots, bbox=[0, 1, 0, 1]) for z in self.values.T
        ]

    def coefficient_count(self):
        return FITPACK_COUNT**2

    def eval(self, uv):
        return np.stack([spline.ev(*uv.T) for spline in self.splines], axis=-1)


def scattered(library, name, data, held_out):
    uv, values = data
    diagonal = np.linalg.norm(np.ptp(values, axis=0))
    print(f"table\t{name}: {len(uv):,} scattered samples, tolerance {TOLERANCE:g}, {THREADS} threads for us")
    row("who", "coefficients", "seconds", "max at data", "max held-out", "met")
    contenders = {
        "planish, adaptive": Ours(library, uv, values),
        "planish, 65x65 knots given": Ours(library, uv, values, grid_u=65, grid_v=65, smoothing=1e-6),
        f"FITPACK {FITPACK_COUNT}x{FITPACK_COUNT}, one component at a time": Fitpack(uv, values),
    }
    seconds = race(contenders.values(), time.perf_counter)
    for (who, fit), runs in zip(contenders.items(), seconds):
        at_data = largest(fit.eval(uv), values, diagonal)
        at_others = largest(fit.eval(held_out[0]), held_out[1], diagonal)
        met = "yes" if float(at_data) <= TOLERANCE else "no"
        row(who, f"{fit.coefficient_count():,}", spread(runs), at_data, at_others, met)


def meshes(library):
    print(f"table\tMesh in, no parameters, 10,000 nodes, tolerance {TOLERANCE:g}, {THREADS} threads. "
          "Goal: met, under 1,000 coefficients, under 0.5 s")
    row("shape", "nodes", "met", "grid", "coefficients", "max", "between", "facets", "seconds", "map", "stop")
    side = np.linspace(0, 1, 100)
    regular = np.stack(np.meshgrid(side, side, indexing="ij"), axis=-1).reshape(-1, 2)
    corners = np.array([(0, 0), (0, 1), (1, 0), (1, 1)], float)
    border = np.linspace(0, 1, 100)[1:-1]
    edges = [np.stack([border, np.full_like(border, end)][::turn], axis=-1) for end in (0, 1) for turn in (1, -1)]
    inside = np.random.default_rng(7).uniform(0.005, 0.995, (10_000 - 4 - 4 * len(border), 2))
    scattered = np.concatenate([corners, *edges, inside])
    for shape, function, low, high in ("peaks", peaks, -3, 3), ("Franke", franke, 0, 1):
        for layout, nodes in ("100 x 100", regular), ("random, Delaunay", scattered):
            xy = low + (high - low) * nodes
            points = np.column_stack([xy, function(*xy.T)])
            triangles = Delaunay(nodes).simplices if nodes is scattered else grid_triangles(100)
            results = []

            def fit():
                results.append(library.fit_mesh(points, triangles, tolerance=TOLERANCE, thread_count=THREADS))

            (seconds,) = race([fit], time.perf_counter)
            _, _, report = results[-1]
            d = report.diagonal
            errors = (report.max_error, report.max_interior_error, report.facet_sagitta)
            row(shape, layout, "yes" if report.max_error <= report.tolerance else "no",
                f"{report.grid_u} x {report.grid_v}", f"{report.coefficient_count:,}",
                *(f"{error / d:.2e}" for error in errors), spread(seconds), f"{report.parameterize_seconds:.2g}",
                STOPS[report.stop_reason])


def grid_triangles(side):
    first = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    lower = np.stack([first, first + side, first + side + 1], axis=-1)
    upper = np.stack([first, first + side + 1, first + 1], axis=-1)
    return np.concatenate([lower, upper])


def main(path, *files):
    library = Library(path)
    scattered(library, "Ridges", sampled(45_000, 45), sampled(100_000, 100))
    if files:
        scattered(library, "Ridges, from files", read(files[0]), read(files[1]))
    meshes(library)


if __name__ == "__main__":
    main(*sys.argv[1:])
