"""What the comparisons call of libplanish, through ctypes, and how runs are timed."""

import ctypes
import time
from ctypes import POINTER, byref, c_double, c_size_t, c_uint32, c_uint64, c_void_p

import numpy as np

# Runs of which the median is printed.
RUNS = 5

STOPS = ["tolerance met", "fixed grid", "limit", "data exhausted", "stagnated"]


class EvalOptions(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("uv_stride", c_size_t),
        ("out_stride", c_size_t),
        ("out_flags", c_void_p),
        ("outside", c_uint32),
        ("thread_count", c_uint32),
    ]


class TensorOptions(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("tolerance", c_double),
        ("smoothing", c_double),
        ("buffer", c_double),
        ("parameterize", c_void_p),
        ("weights", c_void_p),
        ("progress", c_void_p),
        ("user", c_void_p),
        ("out_parameters", c_void_p),
        ("out_errors", c_void_p),
        ("max_coefficients", c_size_t),
        ("tolerance_scale", c_uint32),
        ("method", c_uint32),
        ("ends", c_uint32),
        ("energy", c_uint32),
        ("regularize", c_uint32),
        ("max_grid", c_uint32),
        ("grid_u", c_uint32),
        ("grid_v", c_uint32),
        ("correction_sweeps", c_uint32),
        ("measure_distance", c_uint32),
        ("thread_count", c_uint32),
        ("reserved", c_uint32),
    ]


class FitReport(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("max_error", c_double),
        ("rms_error", c_double),
        ("mean_error", c_double),
        ("tolerance", c_double),
        ("diagonal", c_double),
        ("max_interior_error", c_double),
        ("facet_sagitta", c_double),
        ("max_distance", c_double),
        ("smoothing", c_double),
        ("stretch", c_double),
        ("parameterize_seconds", c_double),
        ("seconds", c_double),
        ("worst_index", c_size_t),
        ("grid_u", c_size_t),
        ("grid_v", c_size_t),
        ("coefficient_count", c_size_t),
        ("empty_cell_count", c_size_t),
        ("flipped_count", c_size_t),
        ("remarks", c_uint64),
        ("pass_count", c_uint32),
        ("stop_reason", c_uint32),
    ]


def doubles(array):
    assert array.dtype == np.float64 and array.flags.c_contiguous
    return array.ctypes.data_as(POINTER(c_double))


class Library:
    def __init__(self, path):
        self.planish = ctypes.CDLL(path)

    def options(self, record, init, **changes):
        options = record()
        assert getattr(self.planish, init)(byref(options), c_size_t(ctypes.sizeof(record))) == 0
        for name, value in changes.items():
            assert hasattr(options, name), name
            setattr(options, name, value)
        return options

    def tensor_options(self, **changes):
        return self.options(TensorOptions, "planish_tensor_options_init", **changes)

    def tensor(self, knots, points):
        """A bicubic surface: control points of shape (u, v, 3)."""
        made = c_void_p()
        status = self.planish.planish_tensor_new(
            c_size_t(3), 3, 3, doubles(knots[0]), c_size_t(len(knots[0])), doubles(knots[1]),
            c_size_t(len(knots[1])), doubles(points), None, byref(made))
        assert status == 0, status
        return Surface(self, made)

    def fit_points(self, uv, values, **changes):
        """The status, the surface and the report."""
        options, made, report = self.tensor_options(**changes), c_void_p(), self.report()
        status = self.planish.planish_tensor_fit_points(
            doubles(uv), doubles(values), c_size_t(len(uv)), c_size_t(values.shape[1]), byref(options),
            byref(made), byref(report))
        assert status >= 0, status
        return status, Surface(self, made), report

    def fit_mesh(self, points, triangles, **changes):
        """The status, the surface and the report. The mesh has no parameters."""
        options, made, report, mesh = self.tensor_options(**changes), c_void_p(), self.report(), c_void_p()
        indices = np.ascontiguousarray(triangles, np.uint32)
        status = self.planish.planish_mesh_new(
            doubles(points), c_size_t(len(points)), indices.ctypes.data_as(POINTER(c_uint32)),
            c_size_t(len(indices)), None, byref(mesh))
        assert status == 0, status
        status = self.planish.planish_tensor_fit(mesh, byref(options), byref(made), byref(report))
        self.planish.planish_mesh_free(mesh)
        assert status >= 0, status
        return status, Surface(self, made), report

    def report(self):
        report = FitReport()
        report.struct_size = ctypes.sizeof(FitReport)
        return report


class Surface:
    def __init__(self, library, handle):
        self.library = library
        self.handle = handle
        self.options = library.options(EvalOptions, "planish_eval_options_init", thread_count=1)

    def __del__(self):
        self.library.planish.planish_surface_free(self.handle)

    def eval(self, uv, out):
        status = self.library.planish.planish_surface_eval(
            self.handle, doubles(uv), c_size_t(len(uv)), byref(self.options), doubles(out))
        assert status == 0, status

    def eval_grid(self, u, v, out):
        status = self.library.planish.planish_surface_eval_grid(
            self.handle, doubles(u), c_size_t(len(u)), doubles(v), c_size_t(len(v)), byref(self.options),
            doubles(out))
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
