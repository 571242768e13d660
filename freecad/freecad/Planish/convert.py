"""Between FreeCAD's meshes, sections and shapes and Planish's. No window is needed."""

import FreeCAD
import numpy as np
import Part
import planish


def points_and_triangles(mesh):
    """Nodes (n, 3) and triangles (m, 3) of a Mesh.MeshObject, in global millimetres."""
    points, triangles = mesh.Topology
    return np.array([(p.x, p.y, p.z) for p in points]).reshape(-1, 3), np.array(triangles, np.uint32).reshape(-1, 3)


def is_source(obj):
    """Whether an object has triangles: a mesh, or points in rows and columns as scanners give them."""
    return obj.isDerivedFrom("Mesh::Feature") or obj.isDerivedFrom("Points::Structured")


def nodes_of(obj):
    """Nodes and triangles of a mesh object, or of structured points: each four neighbours are two triangles; places where the
    scanner saw nothing (not a number) have none."""
    if not obj.isDerivedFrom("Points::Feature"):
        return points_and_triangles(obj.Mesh)
    if not obj.isDerivedFrom("Points::Structured"):
        raise ValueError("these points have no triangles: make a mesh of them first")
    points = np.array([tuple(point) for point in obj.Points.Points]).reshape(-1, 3)
    node = np.arange(obj.Width * obj.Height).reshape(obj.Height, obj.Width)
    a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]))
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    seen = np.isfinite(points).all(axis=1)
    triangles = triangles[seen[triangles].all(axis=1)]
    used, numbers = np.unique(triangles, return_inverse=True)
    return points[used], numbers.reshape(-1, 3).astype(np.uint32)


def mesh_of(obj):
    """A mesh object, or structured points, as a planish.Mesh; turned consistently where that can be done."""
    return planish.Mesh(*nodes_of(obj), orient=True)


def to_mesh(mesh):
    """A planish.Mesh as a Mesh.MeshObject."""
    import Mesh

    return Mesh.Mesh(mesh.points[mesh.triangles.astype(np.int64)].tolist())


def to_shape(thing):
    """A planish.Surface becomes a face or a shell, a planish.Model a shell or a solid: by memory, without a file."""
    model = thing if isinstance(thing, planish.Model) else planish.Model.from_surface(thing)
    shape = Part.Shape()
    shape.importBrepFromString(model.to_brep())
    return _unwrapped(shape)


def _unwrapped(shape):
    """The one face of a shell of one face, the one shape of a compound of one."""
    while shape.ShapeType == "Compound" and len(shape.SubShapes) == 1:
        shape = shape.SubShapes[0]
    if shape.ShapeType == "Shell" and len(shape.Faces) == 1:
        return shape.Faces[0]
    return shape


#: Nodes of a smoothed border for each wave of its shortest wave length: a polyline this fine turns by little at each.
_NODES_A_WAVE = 12


def smooth_border(surface, distance):
    """Makes each border of a surface as smooth as it can be within a distance: the fewest waves along its length that leave no
    node farther off. Borders that would cross each other stay as they are; returns whether they do not."""
    try:
        surface.trims = [_smoothed(surface, np.asarray(border), distance) for border in surface.trims]
    except planish.Error:
        return False
    return True


def _smoothed(surface, border, distance):
    points = surface.eval(border)
    steps = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    at = np.concatenate([[0.0], np.cumsum(steps)])
    length, count = at[-1], len(border)
    if length == 0:
        return border
    # equal steps along the border, so that waves have lengths in space
    even = np.arange(4 * count) * length / (4 * count)
    around = np.concatenate([border, border[:1]])
    waves = np.fft.rfft(np.stack([np.interp(even, at, around[:, axis]) for axis in (0, 1)], axis=1), axis=0)
    u0, u1, v0, v1 = surface.domain

    def curve(kept, places):
        few = waves[: kept + 1] / (4 * count)
        few[1:] *= 2
        turns = np.exp(2j * np.pi * np.outer(places / length, np.arange(kept + 1)))
        return np.clip((turns @ few).real, [u0, v0], [u1, v1])

    low, high = 1, count // 2  # the fewest waves by halving: more waves come closer
    while low < high:
        kept = (low + high) // 2
        off = np.linalg.norm(surface.eval(curve(kept, at[:-1])) - points, axis=1).max()
        low, high = (low, kept) if off <= distance else (kept + 1, high)
    if np.linalg.norm(surface.eval(curve(low, at[:-1])) - points, axis=1).max() > distance:
        return border
    nodes = max(_NODES_A_WAVE * low, 48)
    return curve(low, np.arange(nodes) * length / nodes)


def to_spline(surface):
    """A surface as one Part.BSplineSurface without trims."""
    tensor = surface if surface.kind == "tensor" else surface.to_tensor()
    knots, multiplicities = zip(*(np.unique(knots, return_counts=True) for knots in tensor.knots))
    points = [[FreeCAD.Vector(*point) for point in row] for row in tensor.control_points.tolist()]
    weights = [] if tensor.weights is None else [tensor.weights.tolist()]
    spline = Part.BSplineSurface()
    spline.buildFromPolesMultsKnots(
        points, *(m.tolist() for m in multiplicities), *(k.tolist() for k in knots), False, False, *tensor.degrees, *weights
    )
    return spline


#: Points on a curved edge of a section, where the user gives no spacing: 30 degrees of a circle each.
POINTS_AN_EDGE = 12


def rows_of(objects, spacing=0.0):
    """Rows of points of wires, sketches, edges, Draft points and point clouds, in order, and whether they are closed."""
    rows, closed = [], []
    for thing in objects:
        if thing.isDerivedFrom("Points::Feature"):
            rows.append(np.array([tuple(point) for point in thing.Points.Points]))
            closed.append(False)
            continue
        for row, is_closed in _rows_of_shape(thing.Shape, spacing):
            rows.append(row)
            closed.append(is_closed)
    if len(set(closed)) > 1:
        raise ValueError("closed and open sections cannot be mixed")
    return rows, bool(closed and closed[0])


def _rows_of_shape(shape, spacing):
    wires = shape.Wires
    if not wires and shape.Edges:
        wires = [Part.Wire(edges) for edges in Part.sortEdges(shape.Edges)]
    if not wires:
        return [(np.array([tuple(vertex.Point) for vertex in shape.Vertexes]), False)]
    return [_row_of_wire(wire, spacing) for wire in wires]


def _row_of_wire(wire, spacing):
    is_polygon = all(isinstance(edge.Curve, (Part.Line, Part.LineSegment)) for edge in wire.Edges)
    if is_polygon and not spacing:
        points = [vertex.Point for vertex in wire.OrderedVertexes]
    else:
        count = int(np.ceil(wire.Length / spacing)) if spacing else POINTS_AN_EDGE * len(wire.Edges)
        points = wire.discretize(Number=max(count, 3) + 1)
    row = np.array([tuple(point) for point in points])
    if wire.isClosed() and np.allclose(row[0], row[-1], atol=1e-9 * max(wire.Length, 1.0)):
        row = row[:-1]
    return row, wire.isClosed()
