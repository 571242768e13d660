"""How few coefficients fits with local cells take, with one continuous derivative and with two.

Functions on a jittered grid of 101 x 101 places, values (x, y, f), tolerance in model units; with the shared data also samples
of a surface with two ridges, and Igea's head over the map that the fit with one continuous derivative leaves. `before` are
the coefficients before cells were merged again; errors are shares of the tolerance, the last one at places not given.
Beside them LR B-splines and THB-splines of other libraries, all bicubic and on one thread, where there are programs for them.

Usage: coefficients.py libplanish.so PROGRAMS [DATA]   (the folders with lr/lr and thb/thb, and with igea_disk_43k.ply and
synthetic/)
"""

import subprocess
import sys
import time
from ctypes import byref, c_void_p
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from fits import franke, peaks, read, row
from library import STOPS, Library, Surface, abi, doubles

FUNCTIONS = {
    "peaks": lambda x, y: 0.05 * peaks(6 * x - 3, 6 * y - 3),
    "Franke": franke,
    "ridge": lambda x, y: 0.2 * np.tanh(40 * (np.hypot(x - 0.5, y - 0.5) - 0.3)),
}
CASES = [("peaks", 1e-3), ("peaks", 1e-4), ("Franke", 1e-3), ("Franke", 1e-4), ("ridge", 1e-3)]
# what is asked of a fit, with the words for the table
KINDS = {
    "C1": {},
    "C1, coarsened": {"coarsening": 1},
    "C2": {"continuity": 2},
}

PEERS = {"lr": "GoTools, LR", "thb": "G+Smo, THB"}
# Seconds after which a peer is not waited for.
PATIENCE = 300


def on_graph(function, places):
    return np.column_stack([places, FUNCTIONS[function](*places.T)])


def jittered():
    line = np.linspace(0, 1, 101)
    places = np.stack(np.meshgrid(line, line, indexing="ij"), axis=-1).reshape(-1, 2)
    offsets = np.random.default_rng(7).uniform(-0.3, 0.3, places.shape) * 0.01
    return np.clip(places + offsets, 0, 1)


def told(name, kind, report, seconds, held_out=""):
    row(name, kind, f"{report.refined_coefficient_count:,}", f"{report.coefficient_count:,}", f"{report.cell_count:,}",
        f"{report.max_error / report.tolerance:.2f}", held_out, f"{seconds:.2g}", STOPS[report.stop_reason])


def fitted(library, call, *arguments, **changes):
    """The surface, the report and processor seconds."""
    options = library.options(abi.planish_pht_options, thread_count=1, **changes)
    made, report = c_void_p(), library.report()
    start = time.process_time()
    status = call(*arguments, byref(options), byref(made), byref(report))
    seconds = time.process_time() - start
    assert status >= 0, status
    return Surface(library, made), report, seconds


def scattered(library, programs, name, data, held_out, **changes):
    (uv, values), (places, exact) = data, held_out
    for kind, asked in KINDS.items():
        surface, report, seconds = fitted(
            library, library.planish.planish_pht_fit_points, doubles(uv), doubles(values), len(uv), values.shape[1],
            **asked, **changes)
        out = np.empty_like(exact)
        surface.eval(places, out)
        worst = np.linalg.norm(out - exact, axis=1).max() / report.tolerance
        told(name, kind, report, seconds, f"{worst:.2f}")
    # as smooth as theirs
    beside(programs, name, data, held_out, report, seconds)


def beside(programs, name, data, held_out, report, seconds):
    """The peers, and how many times as much they take as the fit that is reported."""
    with TemporaryDirectory() as folder:
        files = [f"{folder}/data", f"{folder}/held_out"]
        for path, columns in zip(files, (data, held_out)):
            np.column_stack(columns).tofile(path)
        for program, who in PEERS.items():
            if not (path := Path(programs, program, program)).exists():
                continue
            command = [path, repr(report.tolerance), *files]
            try:
                done = subprocess.run(command, capture_output=True, check=True, text=True, timeout=PATIENCE)
            except (subprocess.CalledProcessError, subprocess.TimeoutExpired) as failure:
                print(f"line\t{who}, {name}: {type(failure).__name__}", flush=True)
                continue
            count, cells, *errors, taken, stop = done.stdout.split("\t")
            row(name, who, "", f"{int(count):,}", f"{int(cells):,}", *errors, taken, stop.strip())
            shares = {"seconds": float(taken) / seconds, "coefficients": int(count) / report.coefficient_count}
            for what, share in shares.items():
                print(f"ratio\tfit of {name}, C2: {what}\t{who}\t{share}", flush=True)


def head(library, path, tolerance):
    """Over the parameters that the fit with one continuous derivative has corrected."""
    planish, mesh = library.planish, c_void_p()
    assert planish.planish_mesh_read(path.encode(), None, byref(mesh)) >= 0
    count = planish.planish_mesh_point_count(mesh)
    uv = np.empty((count, 2))
    _, report, seconds = fitted(library, planish.planish_pht_fit, mesh, tolerance=tolerance, out_parameters=doubles(uv))
    told("Igea's head", "C1", report, seconds)
    assert planish.planish_mesh_set_parameters(mesh, doubles(uv), count) >= 0
    for kind in ("C1, coarsened", "C2"):
        _, report, seconds = fitted(
            library, planish.planish_pht_fit, mesh, tolerance=tolerance, regularize=1, correction_sweeps=0, **KINDS[kind])
        told("Igea's head", kind, report, seconds)
    planish.planish_mesh_free(mesh)


def main(path, programs, folder=None):
    library = Library(path)
    print("table\tCoefficients of fits with local cells")
    row("data", "kind", "before", "coefficients", "cells", "max", "max held-out", "seconds", "stop")
    uv, others = jittered(), np.random.default_rng(3).uniform(0, 1, (100_000, 2))
    for name, tolerance in CASES:
        held_out = others, on_graph(name, others)
        scattered(library, programs, f"{name} {tolerance:g}", (uv, on_graph(name, uv)), held_out, tolerance=tolerance,
                  tolerance_scale=1)
    if folder:
        data = [read(f"{folder}/synthetic/{name}.f64") for name in ("ridges_45k", "ridges_held_100k")]
        scattered(library, programs, "ridges 0.001", *data, tolerance=1e-3)
        head(library, f"{folder}/igea_disk_43k.ply", 1e-3)


if __name__ == "__main__":
    main(*sys.argv[1:])
