"""Models as BREP text, the format in which OpenCASCADE keeps shapes ("BREP Format", version 1).

A file lists curves in parameter planes, curves in space and surfaces, then shapes from vertices up to the whole; each
shape names those below it, counted from the end of the list. Nothing is sewn and no tolerance grows: edges are the
model's own, with a p-curve for each side.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ._curve import Curve
from ._parts import Edge, Face, Parts
from ._surface import Surface

#: The least tolerance that OpenCASCADE works with.
_PRECISION = 1e-7

#: The measured distance of curves from surfaces may miss the largest between its samples: the tolerance of edges is this much
#: above it. OpenCASCADE looks at other places, and one that is farther off makes the whole face invalid.
_MARGIN = 2.0

#: Flags: free, modified, checked, orientable, closed, infinite, convex.
_VERTEX, _PLAIN, _CLOSED, _ROOT = "0101101", "0101000", "0101100", "1101000"


def _row(numbers: Iterable[float]) -> str:
    return " ".join(repr(float(number)) for number in numbers)


def _knots(knots: np.ndarray) -> str:
    values, counts = np.unique(knots, return_counts=True)
    return "".join(f"{float(value)!r} {count}\n" for value, count in zip(values, counts))


def _curve(curve: Curve) -> str:
    """A polynomial B-spline curve (kind 7) in the plane or in space."""
    points, knots = curve.control_points, curve.knots
    count = len(np.unique(knots))
    return f"7 0 0 {curve.degree} {len(points)} {count} {_row(points.ravel())}\n{_knots(knots)}"


def _surface(surface: Surface) -> str:
    """A B-spline surface (kind 9)."""
    points, weights = surface.control_points, surface.weights
    (knots_u, knots_v), (degree_u, degree_v) = surface.knots, surface.degrees
    rational = "0 0" if weights is None else "1 1"
    rows = points.reshape(-1, 3) if weights is None else np.c_[points.reshape(-1, 3), weights.ravel()]
    counts = f"{points.shape[0]} {points.shape[1]} {len(np.unique(knots_u))} {len(np.unique(knots_v))}"
    return (
        f"9 {rational} 0 0 {degree_u} {degree_v} {counts} {_row(rows.ravel())}\n{_knots(knots_u)}{_knots(knots_v)}"
    )


def _plane(face: Face) -> str:
    """A plane (kind 1): a point, the normal, and the directions of u and v."""
    across = np.cross(face.axis, face.x_axis)
    return f"1 {_row(face.origin)} {_row(face.axis)} {_row(face.x_axis)} {_row(across)}\n"


def _cylinder(face: Face) -> str:
    """A cylinder (kind 2): a point of the axis, its direction, those of the angles 0 and a quarter, the radius."""
    across = np.cross(face.axis, face.x_axis)
    return f"2 {_row(face.origin)} {_row(face.axis)} {_row(face.x_axis)} {_row(across)} {face.radius!r}\n"


def _edge_curve(edge: Edge) -> str:
    """A line (kind 1) over its length, a circle (kind 2) or ellipse (kind 3) over its angles, or a spline."""
    if edge.shape == "line":
        (start, end), (first, last) = edge.curve.control_points, edge.curve.domain
        along = (end - start) / np.linalg.norm(end - start)
        if abs(np.linalg.norm(end - start) - (last - first)) <= 1e-12 * (last - first):
            return f"1 {_row(start - first * along)} {_row(along)}\n"
    if edge.shape not in ("circle", "ellipse"):
        return _curve(edge.curve)
    frame = f"{_row(edge.origin)} {_row(edge.axis)} {_row(edge.x_axis)} {_row(np.cross(edge.axis, edge.x_axis))}"
    if edge.shape == "circle":
        return f"2 {frame} {edge.radii[0]!r}\n"
    return f"3 {frame} {_row(edge.radii)}\n"


class _Writer:
    def __init__(self, parts: Parts):
        self.parts = parts
        self.faces = parts.faces
        self.tolerance = max(_PRECISION, _MARGIN * parts.curve_deviation)
        self.pcurves: list[str] = []
        self.curves: list[str] = []
        self.surfaces: list[str] = []
        self.shapes: list[str] = []
        #: for each edge, what its geometry says of each face beside it
        self.sides: list[dict[int, list[tuple[bool, int]]]] = [{} for _ in parts.edges]

    def text(self) -> str:
        self._add_geometry()
        root = self._add_shapes()
        count = len(self.shapes)
        # shapes name each other by their place in the list, which the format counts from the end
        shapes = "".join(shape.format(*(count - place for place in range(count))) for shape in self.shapes)
        return (
            "DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\nLocations 0\n"
            f"Curve2ds {len(self.pcurves)}\n{''.join(self.pcurves)}"
            f"Curves {len(self.curves)}\n{''.join(self.curves)}"
            "Polygon3D 0\nPolygonOnTriangulations 0\n"
            f"Surfaces {len(self.surfaces)}\n{''.join(self.surfaces)}"
            f"Triangulations 0\n\nTShapes {count}\n{shapes}\n+{count - root} 0\n"
        )

    def _add_geometry(self) -> None:
        for index, face in enumerate(self.faces):
            if face.carrier == "plane":
                self.surfaces.append(_plane(face))
                continue  # OpenCASCADE finds where curves lie in planes by itself
            is_cylinder = face.carrier == "cylinder"
            self.surfaces.append(_cylinder(face) if is_cylinder else _surface(self.parts.surface(index)))
            coedges = [coedge for loop in face.loops for coedge in loop]
            for place, (edge, is_forward) in enumerate(coedges):
                self.pcurves.append(_curve(self.parts.pcurve(index, place)))
                self.sides[edge].setdefault(index, []).append((is_forward, len(self.pcurves)))

    def _add(self, kind: str, geometry: str, flags: str, below: Iterable[str] = ()) -> int:
        """A shape and those below it, which are `+{place}` or `-{place}`; returns its place in the list."""
        listed = "".join(f"{shape} 0 " for shape in below)
        self.shapes.append(f"{kind}\n{geometry}\n{flags}\n{listed}*\n")
        return len(self.shapes) - 1

    def _add_shapes(self) -> int:
        vertices = [
            self._add("Ve", f"{self.tolerance!r}\n{_row(point)}\n0 0\n", _VERTEX) for point in self.parts.vertices
        ]
        edges = [self._add_edge(index, edge, vertices) for index, edge in enumerate(self.parts.edges)]
        faces = [self._add_face(index, face, edges) for index, face in enumerate(self.faces)]
        return self._add_bodies(faces)

    def _add_edge(self, index: int, edge: Edge, vertices: list[int]) -> int:
        self.curves.append(_edge_curve(edge))
        ends = _row(edge.curve.domain)
        told = f" {self.tolerance!r} 1 1 0\n1  {len(self.curves)} 0 {ends}\n"
        for face, uses in self.sides[index].items():
            if len(uses) == 2:  # a seam: first where the loop runs along it, seen from the surface's own side
                first, second = (number for _, number in sorted(uses, reverse=self.faces[face].is_forward))
                told += f"3  {first} {second} CN {face + 1} 0 {ends}\n"
            else:
                told += f"2  {uses[0][1]} {face + 1} 0 {ends}\n"
        start, end = (vertices[vertex] for vertex in edge.vertices)
        return self._add("Ed", told + "0\n", _PLAIN, (f"+{{{start}}}", f"-{{{end}}}"))

    def _add_face(self, index: int, face: Face, edges: list[int]) -> int:
        # the list below a face is that of its surface's own side: where the front is the other one, loops turn round
        turned = "+" if face.is_forward else "-"
        wires = []
        for loop in face.loops:
            below = (f"{'+' if is_forward else '-'}{{{edges[edge]}}}" for edge, is_forward in loop)
            wires.append(f"{turned}{{{self._add('Wi', '', _CLOSED, below)}}}")
        return self._add("Fa", f"0  {self.tolerance!r} {index + 1} 0\n", _PLAIN, wires)

    def _add_bodies(self, faces: list[int]) -> int:
        shells = self.parts.shells
        places = []
        for shell in shells:
            below = (f"{'+' if self.faces[face].is_forward else '-'}{{{faces[face]}}}" for face in shell.faces)
            places.append(self._add("Sh", "", _PLAIN if shell.role == "open" else _CLOSED, below))
        bodies = []
        for index, shell in enumerate(shells):
            if shell.role == "open":
                bodies.append(places[index])
            elif shell.role == "solid":
                inside = [places[other] for other, void in enumerate(shells) if void.void_in == index]
                bodies.append(self._add("So", "", _PLAIN, (f"+{{{place}}}" for place in [places[index], *inside])))
        if len(bodies) == 1:
            return bodies[0]
        return self._add("Co", "", _ROOT, (f"+{{{body}}}" for body in bodies))


def text(parts: Parts) -> str:
    """The BREP text of a model."""
    return _Writer(parts).text()
