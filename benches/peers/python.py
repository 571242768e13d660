"""The Python package beside the raw C call and beside scipy, geomdl, splipy and ndsplines: points in a batch, and one at a time.

Usage: PLANISH_LIBRARY=... PYTHONPATH=python python3 benches/peers/python.py     one thread; peers that are not installed are left out
Prints rows for tables.py. The same net for everyone: bicubic, 200 x 200 control points, one number a point; all agree to 1e-12.
"""

import importlib.util
import platform
from ctypes import addressof, byref
from importlib import metadata

import library
import numpy as np

import planish
from planish import _abi
from planish._library import lib, pointer

COUNT = 1_000_000  # points of a batch
SLOW_COUNT = 2_000  # those of a peer that takes them one by one, or nearly so
CALLS = 20_000  # scalar calls of a run
PEERS = ("scipy", "ndsplines", "splipy", "geomdl")


def net():
    """Values of a wavy sheet as control points of a cubic over clamped knots."""
    knots = np.concatenate([[0] * 3, np.linspace(0, 1, 198), [1] * 3])
    x, y = np.meshgrid(np.linspace(0, 1, 200), np.linspace(0, 1, 200), indexing="ij")
    return knots, np.sin(9 * x) * np.cos(7 * y)


def peers(knots, control, uv):
    """Name, points in a batch, call of the batch, call of one point."""
    u, v = np.ascontiguousarray(uv[:, 0]), np.ascontiguousarray(uv[:, 1])
    surface = planish.tensor(knots, knots, control[..., None])
    out, one_uv = np.empty((COUNT, 1)), uv[:1].copy()
    one_out = np.empty((1, 1))
    options = _abi.planish_eval_options()
    lib.planish_eval_options_init(addressof(options), _abi.sizeof(options))
    options.thread_count = 1
    given = byref(options)
    handle = surface._as_parameter_
    at, to, one_at, one_to = pointer(uv), pointer(out), pointer(one_uv), pointer(one_out)
    yield (
        "planish, the C function",
        COUNT,
        lambda: lib.planish_surface_eval(handle, at, COUNT, given, to),
        lambda: lib.planish_surface_eval(handle, one_at, 1, given, one_to),
        out[:, 0],
    )
    mine = np.empty((COUNT, 1))
    yield (
        "planish, `.eval(uv, out)`",
        COUNT,
        lambda: surface.eval(uv, mine, thread_count=1),
        lambda: surface.eval(one_uv, one_out),
        mine[:, 0],
    )

    if importlib.util.find_spec("scipy"):
        from scipy.interpolate import BivariateSpline, NdBSpline

        theirs = BivariateSpline._from_tck((knots, knots, control.ravel(), 3, 3))
        found = {}
        yield (
            "scipy, `RectBivariateSpline.ev`",
            COUNT,
            lambda: found.__setitem__("values", theirs.ev(u, v)),
            lambda: theirs.ev(u[0], v[0]),
            found,
        )
        other, again = NdBSpline((knots, knots), control, 3), {}
        yield (
            "scipy, `NdBSpline`",
            COUNT,
            lambda: again.__setitem__("values", other(uv)),
            lambda: other(one_uv),
            again,
        )
    if importlib.util.find_spec("ndsplines"):
        import ndsplines

        spline, nd = ndsplines.NDSpline([knots, knots], control, 3), {}
        yield "ndsplines", COUNT, lambda: nd.__setitem__("values", spline(uv)), lambda: spline(one_uv), nd
    if importlib.util.find_spec("splipy"):
        import splipy

        basis = splipy.BSplineBasis(4, knots)
        sheet = splipy.Surface(basis, basis, control.ravel(order="F")[:, None])
        few_u, few_v, sp = u[:SLOW_COUNT], v[:SLOW_COUNT], {}
        yield (
            "splipy",
            SLOW_COUNT,
            lambda: sp.__setitem__("values", sheet(few_u, few_v, tensor=False).ravel()),
            lambda: sheet(u[0], v[0]),
            sp,
        )
    if importlib.util.find_spec("geomdl"):
        from geomdl import BSpline

        geo = BSpline.Surface(normalize_kv=False)
        geo.degree_u = geo.degree_v = 3
        x, y = np.meshgrid(np.linspace(0, 1, 200), np.linspace(0, 1, 200), indexing="ij")
        geo.set_ctrlpts(np.stack([x, y, control], -1).reshape(-1, 3).tolist(), 200, 200)
        geo.knotvector_u = geo.knotvector_v = knots.tolist()
        places, gd = uv[:SLOW_COUNT].tolist(), {}
        yield (
            "geomdl (three numbers a point)",
            SLOW_COUNT,
            lambda: gd.__setitem__("values", np.array(geo.evaluate_list(places))[:, 2]),
            lambda: geo.evaluate_single(places[0]),
            gd,
        )


def versions():
    """Who is here, with versions."""
    names = [name for name in ("numpy", *PEERS) if importlib.util.find_spec(name)]
    return ", ".join([f"Python {platform.python_version()}", *(f"{name} {metadata.version(name)}" for name in names)])


def calls(one, count):
    def run():
        for _ in range(count):
            one()

    return run


def print_line(kind, *fields):
    print(kind, *fields, sep="\t", flush=True)


def main():
    knots, control = net()
    uv = np.random.default_rng(1).random((COUNT, 2))
    everyone = list(peers(knots, control, uv))
    reference = None
    for name, _, batch, one, values in everyone:
        batch(), one()  # to warm up
        found = values["values"] if isinstance(values, dict) else values
        reference = found if reference is None else reference
        assert np.abs(found - reference[: len(found)]).max() <= 1e-12, f"{name} gives other values"
    batches = library.race([batch for _, _, batch, _, _ in everyone])
    counts = [CALLS if count == COUNT else CALLS // 100 for _, count, *_ in everyone]
    singles = library.race([calls(one, count) for (_, _, _, one, _), count in zip(everyone, counts)])
    print_line("line", versions())
    print_line("table", "From Python: a bicubic scalar field of 200 x 200 control points, one thread")
    print_line("row", "who", "1e6 points in any order, s", "one point, us")
    for (name, count, *_), seconds, one_seconds, called in zip(everyone, batches, singles, counts):
        print_line("row", name, told(seconds, COUNT / count, 3), told(one_seconds, 1e6 / called, 2))


def told(seconds, factor, digits):
    """Median, least and largest of sorted seconds."""
    least, median, largest = (f"{factor * seconds[at]:.{digits}f}" for at in (0, len(seconds) // 2, -1))
    return f"{median} ({least} to {largest})"


main()
