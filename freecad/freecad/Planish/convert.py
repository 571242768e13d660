"""Between FreeCAD's meshes, sections and shapes and Planish's. No window is needed."""

import FreeCAD
import numpy as np
import Part
import planish


def points_and_triangles(mesh):
    """Nodes (n, 3) and triangles (m, 3) of a Mesh.MeshObject, in global millimetres."""
    points, triangles = mesh.Topology
    return np.array([(p.x, p.y, p.z) for p in points]).reshape(-1, 3), np.array(triangles, np.uint32).reshape(-1, 3)


def mesh_of(mesh):
    """A Mesh.MeshObject as a planish.Mesh; turned consistently where that can be done."""
    return planish.Mesh(*points_and_triangles(mesh), orient=True)


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


def signed_distances(thing, points):
    """The distances of points from a planish.Surface or planish.Model: positive on the side of the normals."""
    if isinstance(thing, planish.Model):
        faces, uv, distances = thing.project(points)
        places = thing.eval(faces, uv, outside="extrapolate")
        normals = thing.normals(faces, uv, outside="extrapolate")
    else:
        uv, distances = thing.project(points)
        places = thing.eval(uv, outside="extrapolate")
        normals = thing.normals(uv, outside="extrapolate")
    return np.where(np.einsum("ij,ij->i", points - places, normals) < 0, -distances, distances)


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
