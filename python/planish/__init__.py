"""Planish: smooth spline surfaces from triangle meshes, rows of points and fields, within a stated tolerance.

>>> import planish
>>> surface = planish.fit("scan.stl", tolerance=1e-3)          # doctest: +SKIP
>>> surface.report.max_error, surface.report.tolerance         # doctest: +SKIP
>>> surface.write_step("scan.step")                            # doctest: +SKIP

Arrays are numpy's, options are keywords, choices are lower-case words. A missed tolerance is no exception: the report
tells it. What cannot be done at all is a `planish.Error`, which is also a ValueError, IndexError, OSError or MemoryError.
"""

from ._abi import VERSION as __version__
from ._curve import Curve, fit_curve, interpolate_curve, load_curve
from ._fields import FieldFitter, Transfer
from ._d1rc import D1rcSurface, smooth_creased
from ._fit import fit, fit_field, fit_points, skin, skin_curves
from ._layout import Layout
from ._library import Cancelled, Error, FileError, InvalidError, OutOfMemoryError, RangeError
from ._mesh import Mesh, read_mesh, read_mesh_bytes
from ._model import Model, load_model, model, smooth_from_patches
from ._parts import Edge, Face, Shell
from ._records import Report
from ._pht import Extraction, PhtSurface, pht, pht_from_surface
from ._surface import BezierPatch, Curvatures, Surface, load, loads
from ._tensor import TensorSurface, combine, tensor
from ._tspline import TSplineSurface, tspline

__all__ = [
    "BezierPatch",
    "Cancelled",
    "Curvatures",
    "Curve",
    "D1rcSurface",
    "Edge",
    "Error",
    "Extraction",
    "Face",
    "FieldFitter",
    "FileError",
    "InvalidError",
    "Layout",
    "Mesh",
    "Model",
    "OutOfMemoryError",
    "PhtSurface",
    "RangeError",
    "Report",
    "Shell",
    "Surface",
    "TSplineSurface",
    "TensorSurface",
    "Transfer",
    "combine",
    "fit",
    "fit_curve",
    "fit_field",
    "fit_points",
    "interpolate_curve",
    "load",
    "load_curve",
    "load_model",
    "loads",
    "model",
    "pht",
    "pht_from_surface",
    "read_mesh",
    "read_mesh_bytes",
    "skin",
    "skin_curves",
    "smooth_creased",
    "smooth_from_patches",
    "tensor",
    "tspline",
]
