"""What a model is made of, as records."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ._curve import Curve
from ._surface import Surface


class Face(NamedTuple):
    """A bounded part of a surface.

    carrier: "spline", "plane" or "cylinder"; `origin`, `axis`, `x_axis` and `radius` say which.
    label: what the maker of the model calls it. is_forward: whether its front is where the surface's normal points.
    loops: the outer one first; each a list of (edge, is_forward) in order, the face on the left.
    max_error, rms_error: of the `n_nodes` nodes of the fitted mesh on it; NaN without any.
    """

    carrier: str
    origin: tuple[float, float, float]
    axis: tuple[float, float, float]
    x_axis: tuple[float, float, float]
    radius: float
    label: int
    shell: int
    is_forward: bool
    loops: list[list[tuple[int, bool]]]
    max_error: float
    rms_error: float
    n_nodes: int


class Edge(NamedTuple):
    """A curve in space between two vertices, which one or two faces share.

    faces: the face whose loop runs along it and the one whose loop runs against it; None where there is none.
    shape: "spline", "line", "circle" or "ellipse"; the curve of the last two is a spline over their angles.
    origin, axis, x_axis, radii: those of a circle or ellipse, which turns counter-clockwise about its axis.
    """

    curve: Curve
    vertices: tuple[int, int]
    faces: tuple[int | None, int | None]
    is_sharp: bool
    angle: float
    gap: float
    shape: str
    origin: tuple[float, float, float]
    axis: tuple[float, float, float]
    x_axis: tuple[float, float, float]
    radii: tuple[float, float]


class Shell(NamedTuple):
    """Faces that hang together. role: "open", "solid" or "void"; a void is inside the shell `void_in`."""

    faces: list[int]
    role: str
    void_in: int | None


class Parts(NamedTuple):
    """A whole model.

    vertices: their places (n, 3). surface: that under a face, by number. pcurve: that of a face's coedge, both by number.
    curve_deviation: the largest measured distance of a p-curve from its edge.
    """

    faces: list[Face]
    edges: list[Edge]
    shells: list[Shell]
    vertices: np.ndarray
    surface: Callable[[int], Surface]
    pcurve: Callable[[int, int], Curve]
    curve_deviation: float
