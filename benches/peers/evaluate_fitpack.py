"""Evaluation of bicubic surfaces on one thread beside FITPACK, called through scipy.

Nets and points are made as evaluate.cpp makes them. FITPACK knows scalars only: a point is three calls. Both
sides must agree to 1e-12 before anything is timed.

Usage: evaluate_fitpack.py libplanish.so
"""

import sys

import numpy as np
from scipy.interpolate import BivariateSpline

from library import RUNS, Library, race

SIDE = 1000
AGREEMENT = 1e-12


def knots(count, is_uniform, random):
    steps = np.ones(count - 3) if is_uniform else random.uniform(0.1, 1.1, count - 3)
    breaks = np.concatenate([[0], np.cumsum(steps)])
    return np.concatenate([breaks[:1].repeat(3), breaks, breaks[-1:].repeat(3)])


def compete(what, ours, theirs, out, contenders):
    """Contenders fill `out[0]` (planish) and `out[1]` (FITPACK)."""
    for run in contenders:
        run()
    apart = np.abs(out[0] - out[1]).max() / np.abs(out[0]).max()
    print(f"agree\t{what}\t{theirs}\t{apart:.1e}")
    if not apart <= AGREEMENT:
        sys.exit(f"evaluate_fitpack: {what}: {theirs} differs")
    for name, seconds in zip((ours, theirs), race(contenders)):
        slowest, median, fastest = (SIDE**2 / seconds[k] / 1e6 for k in (-1, RUNS // 2, 0))
        print(f"rate\t{what}\t{name}\t{median:.4g}\t{slowest:.4g}\t{fastest:.4g}", flush=True)


def main(path):
    library = Library(path)
    for counts in (65, 17), (200, 200), (1000, 1000):
        for is_uniform in True, False:
            random = np.random.default_rng(1)
            t = [knots(count, is_uniform, random) for count in counts]
            points = random.uniform(-1, 1, (*counts, 3))
            surface = library.tensor(t, points)
            splines = [
                BivariateSpline._from_tck((*t, np.ascontiguousarray(points[..., k]).ravel(), 3, 3))
                for k in range(3)
            ]
            line = np.arange(SIDE) / SIDE
            u, v = (line * axis[-1] for axis in t)
            name = f"{counts[0]}x{counts[1]}\t{'uniform' if is_uniform else 'arbitrary'}"
            out = np.zeros((2, SIDE**2, 3))
            ordered = np.stack(np.meshgrid(u, v, indexing="ij"), axis=-1).reshape(-1, 2)
            scattered = random.uniform(0, 1, (SIDE**2, 2)) * (t[0][-1], t[1][-1])
            for order, uv in ("random", scattered), ("ordered", ordered):
                columns = np.ascontiguousarray(uv.T)

                def ours():
                    surface.eval(uv, out[0])

                def theirs():
                    for k, spline in enumerate(splines):
                        out[1, :, k] = spline.ev(*columns)

                compete(f"{name}\tS {order}", "planish", "FITPACK .ev", out, (ours, theirs))

            def ours():
                surface.eval_grid(u, v, out[0])

            def theirs():
                for k, spline in enumerate(splines):
                    out[1, :, k] = spline(u, v).ravel()

            compete(f"{name}\tgrid", "planish", "FITPACK bispev", out, (ours, theirs))


if __name__ == "__main__":
    main(sys.argv[1])
