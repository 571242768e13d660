"""Other programs read what the library writes: numpy the save format, by the reader in docs/format.md, and VTK the
Bezier cells. Values are compared with the library's own, called through ctypes.

Usage: test_readers.py libplanish.so docs/format.md SCRATCH
"""

import ctypes
import importlib.util
import re
import sys
from ctypes import POINTER, byref, c_char_p, c_double, c_size_t, c_void_p
from pathlib import Path

import numpy as np

PATCHES, CONTROL_NET = 1, 2

# the records as ctypes has them, generated with the header
_spec = importlib.util.spec_from_file_location("_abi", Path(__file__).parent.parent / "python/planish/_abi.py")
_abi = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(_abi)


def doubles(array):
    return array.ctypes.data_as(POINTER(c_double))


class Surface:
    """A wavy surface of degrees 3 and 2 with uneven knots."""

    def __init__(self, library, is_rational):
        self.library = library
        self.handle = c_void_p()
        self.knots = (
            np.array([0, 0, 0, 0, 0.3, 0.5, 0.5, 1, 1, 1, 1.0]),
            np.array([-2, -1, 0, 0.5, 1.25, 2, 3, 3.5]),
        )
        random = np.random.default_rng(7)
        self.points = random.uniform(-1, 1, (7, 5, 3))
        self.weights = random.uniform(0.5, 2, (7, 5)) if is_rational else None
        weights = doubles(self.weights) if is_rational else None
        status = library.planish_tensor_new(
            c_size_t(3), 3, 2, doubles(self.knots[0]), c_size_t(11), doubles(self.knots[1]), c_size_t(8),
            doubles(self.points), weights, byref(self.handle))
        assert status == 0

    def __del__(self):
        self.library.planish_surface_free(self.handle)

    def eval(self, uv):
        uv = np.ascontiguousarray(uv)
        out = np.empty((len(uv), 3))
        assert self.library.planish_surface_eval(self.handle, doubles(uv), c_size_t(len(uv)), None, doubles(out)) == 0
        return out

    def save(self, path):
        assert self.library.planish_surface_save_file(self.handle, c_char_p(str(path).encode())) == 0

    def write_vtk(self, path, content):
        options = _abi.planish_vtk_options()
        assert self.library.planish_vtk_options_init(byref(options), c_size_t(ctypes.sizeof(options))) == 0
        options.content = content
        assert self.library.planish_surface_write_vtk(self.handle, c_char_p(str(path).encode()), byref(options)) == 0


def check_numpy(surface, page, scratch):
    reader = re.search(r"```python\n(.*?)```", page.read_text(), re.DOTALL).group(1)
    namespace = {}
    exec(reader, namespace)
    path = scratch / "surface.planish"
    surface.save(path)
    loaded = namespace["load"](path)
    assert loaded["degree"] == (3, 2) and loaded["trims"] == [] and loaded["box"] is None
    assert all(np.array_equal(a, b) for a, b in zip(loaded["knots"], surface.knots))
    assert np.array_equal(loaded["points"], surface.points)
    if surface.weights is None:
        assert loaded["weights"] is None
    else:
        assert np.array_equal(loaded["weights"], surface.weights)
    path.write_bytes(path.read_bytes()[:-9] + b"x" + path.read_bytes()[-8:])
    try:
        namespace["load"](path)
    except AssertionError:
        return
    raise AssertionError("the reader of the page took a damaged file")


def check_vtk(surface, scratch):
    import vtk

    def read(name):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(scratch / name))
        reader.Update()
        return reader.GetOutput()

    surface.write_vtk(scratch / "patches.vtu", PATCHES)
    grid = read("patches.vtu")
    assert grid.GetNumberOfCells() == 3 * 3, grid.GetNumberOfCells()
    parameters = grid.GetCellData().GetArray("parameters")
    random = np.random.default_rng(3)
    largest = 0.0
    for index in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(index)
        assert cell.GetCellType() == vtk.VTK_BEZIER_QUADRILATERAL
        u0, u1, v0, v1 = parameters.GetTuple(index)
        for r, s in random.uniform(0, 1, (20, 2)):
            point, weights, sub = [0.0] * 3, [0.0] * cell.GetNumberOfPoints(), vtk.reference(0)
            cell.EvaluateLocation(sub, [r, s, 0.0], point, weights)
            expected = surface.eval(np.array([[u0 + r * (u1 - u0), v0 + s * (v1 - v0)]]))[0]
            largest = max(largest, np.abs(expected - point).max())
    # sums of twelve products of numbers below 2 on either side
    assert largest <= 1e-14, largest
    surface.write_vtk(scratch / "net.vtu", CONTROL_NET)
    net = read("net.vtu")
    assert net.GetNumberOfPoints() == 35 and net.GetNumberOfCells() == 7 + 5
    assert {net.GetCellType(k) for k in range(12)} == {vtk.VTK_POLY_LINE}


def main():
    library, page, scratch = ctypes.CDLL(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3])
    scratch.mkdir(parents=True, exist_ok=True)
    for is_rational in (False, True):
        surface = Surface(library, is_rational)
        check_numpy(surface, page, scratch)
        check_vtk(surface, scratch)
    print("numpy and VTK read what was written")


main()
