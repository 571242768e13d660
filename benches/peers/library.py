"""What the comparisons call of libplanish, through ctypes, and how runs are timed."""

import ctypes
import importlib.util
import time
from ctypes import byref, c_void_p
from pathlib import Path

import numpy as np

# Runs of which the median is printed.
RUNS = 5

STOPS = ["tolerance met", "fixed grid", "limit", "data exhausted", "stagnated"]


def _raw_module():
    """The records and functions of planish.h. The package is not imported: it would load a library of its own."""
    path = Path(__file__).resolve().parents[2] / "python" / "planish" / "_abi.py"
    spec = importlib.util.spec_from_file_location("planish_abi", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


abi = _raw_module()


def doubles(array):
    assert array.dtype == np.float64 and array.flags.c_contiguous
    return array.ctypes.data


class Library:
    def __init__(self, path):
        self.planish = ctypes.CDLL(path)
        abi.declare(self.planish)

    def options(self, record, **changes):
        options = record()
        assert getattr(self.planish, f"{record.__name__}_init")(ctypes.addressof(options), ctypes.sizeof(record)) == 0
        for name, value in changes.items():
            assert hasattr(options, name), name
            setattr(options, name, value)
        return options

    def tensor_options(self, **changes):
        return self.options(abi.planish_tensor_options, **changes)

    def tensor(self, knots, points):
        """A bicubic surface: control points of shape (u, v, 3)."""
        made = c_void_p()
        status = self.planish.planish_tensor_new(
            3, 3, 3, doubles(knots[0]), len(knots[0]), doubles(knots[1]), len(knots[1]), doubles(points), None,
            byref(made))
        assert status == 0, status
        return Surface(self, made)

    def fit_points(self, uv, values, **changes):
        """The status, the surface and the report."""
        options, made, report = self.tensor_options(**changes), c_void_p(), self.report()
        status = self.planish.planish_tensor_fit_points(
            doubles(uv), doubles(values), len(uv), values.shape[1], byref(options), byref(made), byref(report))
        assert status >= 0, status
        return status, Surface(self, made), report

    def fit_mesh(self, points, triangles, **changes):
        """The status, the surface and the report. The mesh has no parameters."""
        options, made, report, mesh = self.tensor_options(**changes), c_void_p(), self.report(), c_void_p()
        indices = np.ascontiguousarray(triangles, np.uint32)
        status = self.planish.planish_mesh_new(
            doubles(points), len(points), indices.ctypes.data, len(indices), None, byref(mesh))
        assert status == 0, status
        status = self.planish.planish_tensor_fit(mesh, byref(options), byref(made), byref(report))
        self.planish.planish_mesh_free(mesh)
        assert status >= 0, status
        return status, Surface(self, made), report

    def report(self):
        report = abi.planish_fit_report()
        report.struct_size = ctypes.sizeof(report)
        return report


class Surface:
    def __init__(self, library, handle):
        self.library = library
        self.handle = handle
        self.options = library.options(abi.planish_eval_options, thread_count=1)

    def __del__(self):
        self.library.planish.planish_surface_free(self.handle)

    def eval(self, uv, out):
        status = self.library.planish.planish_surface_eval(
            self.handle, doubles(uv), len(uv), byref(self.options), doubles(out))
        assert status == 0, status

    def eval_grid(self, u, v, out):
        status = self.library.planish.planish_surface_eval_grid(
            self.handle, doubles(u), len(u), doubles(v), len(v), byref(self.options), doubles(out))
        assert status == 0, status


def race(contenders, clock=time.process_time):
    """Seconds of each contender, sorted. Each round lets everyone run once: a slow minute is everyone's."""
    seconds = [[] for _ in contenders]
    for _ in range(RUNS):
        for run, list_of in zip(contenders, seconds):
            start = clock()
            run()
            list_of.append(clock() - start)
    return [sorted(list_of) for list_of in seconds]
