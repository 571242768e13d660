"""Writes the inputs that fuzzing starts from into fuzz/corpus: meshes in all formats, what each family saves, and for the
targets that take values the bytes that mean well-formed ones.

Usage: PLANISH_LIBRARY=target/release/libplanish.so PYTHONPATH=python python3 fuzz/seeds.py
"""

import os
import struct
import tempfile
from pathlib import Path

import numpy as np

import planish

CORPUS = Path(__file__).parent / "corpus"


def write(target, name, data):
    folder = CORPUS / target
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(data)


# shapes


def sheet(n, lift=0.2):
    """A wavy square of n x n nodes, and its triangles."""
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n), indexing="ij")
    points = np.stack([x, y, lift * np.sin(3 * x) * np.cos(4 * y)], axis=-1).reshape(-1, 3)
    node = np.arange(n * n).reshape(n, n)
    a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]))
    return points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]).astype(np.uint32)


def octahedron():
    points = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]], float)
    corners = [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]]
    return points, np.array(corners, np.uint32)


# readers: two bytes that choose format and repairs, then a file


def readers():
    points, triangles = sheet(4)
    mapped = planish.Mesh(points, triangles, uv=points[:, :2], fields={"f": points[:, 2]})
    closed = planish.Mesh(*octahedron())
    apart = planish.Mesh(
        np.concatenate([closed.points, closed.points + 4]), np.concatenate([closed.triangles, closed.triangles + 6])
    )
    with tempfile.TemporaryDirectory() as folder:
        for name, mesh in [("sheet", mapped), ("closed", closed), ("apart", apart)]:
            for number, ending in enumerate(["off", "obj", "ply", "stl"]):
                path = os.path.join(folder, f"{name}.{ending}")
                mesh.write(path)
                content = Path(path).read_bytes()
                write("readers", f"{name}.{ending}", bytes([number | (8 if name == "apart" else 0), 0]) + content)
    # text beside the binary forms, and what repairs are for
    rows = "\n".join("v " + " ".join(f"{x:g}" for x in row) for row in closed.points)
    faces = "\n".join("f " + " ".join(f"{k + 1}" for k in row) for row in closed.triangles)
    write("readers", "text.obj", b"\x01\x3f" + f"{rows}\n{faces}\nf 1 2 3\nf 3 3 1\nf 1 2 3 4\n".encode())
    ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    ply += "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n4 0 1 2 3\n"
    write("readers", "strip.ply", b"\x02\x00" + ply.encode())
    stl = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"
    write("readers", "text.stl", b"\x03\x00" + stl.encode())
    write("readers", "colours.off", b"\x00\x00COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 0 1 0 1\n0 1 0 0 0 1 1\n3 0 1 2 255 0 0\n")


# saved: a file of each kind


def saved():
    knots = [0, 0, 0, 0.5, 1, 1, 1]
    x, y = np.meshgrid(np.linspace(0, 1, 4), np.linspace(0, 1, 4), indexing="ij")
    control = np.stack([x, y, x * y], axis=-1)
    rational = planish.tensor(knots, knots, control, 1 + 0.5 * x)
    rational.trims = [np.array([[0.1, 0.1], [0.9, 0.1], [0.5, 0.9]])]
    rational.name = "part"
    write("saved", "tensor", planish.tensor(knots, knots, control).tobytes())
    write("saved", "rational", rational.tobytes())
    rows = [np.stack([np.linspace(0, 1, k), np.full(k, v), np.sin(np.linspace(0, 3, k))], 1) for k, v in [(6, 0), (9, 1), (7, 2), (8, 3)]]
    write("saved", "tspline", planish.skin(rows, 1e-2).tobytes())
    mesh = planish.Mesh(*sheet(9))
    write("saved", "pht", planish.fit(mesh, 2e-2, "pht").tobytes())
    write("saved", "d1rc", planish.smooth_creased(planish.Mesh(*sheet(4))).tobytes())
    u = np.linspace(0, 1, 9)
    write("saved", "curve", planish.fit_curve(u, np.stack([u, np.sin(3 * u)], 1), 1e-2).tobytes())
    write("saved", "model", planish.Model.from_surface(rational).tobytes())


# values, as the crate `arbitrary` reads them: each element of a list behind an odd byte, the list's end an even one


def listed(elements):
    return b"".join(b"\x01" + element for element in elements) + b"\x00"


def trims():
    square = [(2, 2), (30, 2), (30, 30), (2, 30)]
    hole = [(10, 10), (10, 20), (20, 20), (20, 10)]
    shapes = {
        "square": [square],
        "hole": [square, hole],
        "islands": [square, hole, [(12, 12), (16, 12), (16, 16), (12, 16)]],
        "touching": [square, [(2, 10), (2, 20), (20, 20), (20, 10)]],
        "eight": [[(2, 2), (30, 30), (30, 2), (2, 30)]],
        "border": [[(0, 0), (32, 0), (32, 32), (0, 32)]],
        "sliver": [[(0, 0), (32, 0), (32, 1), (16, 1), (0, 1)]],
    }
    heights = bytes(16 * (k % 4) + 8 * (k // 4) for k in range(16))
    for name, loops in shapes.items():
        write("trims", name, heights + listed(listed(struct.pack("<HH", *node) for node in nodes) for nodes in loops))


def tmesh():
    def edit(merges, level, i, j):
        return struct.pack("<BBHH", merges, level, i, j)

    split = [edit(0, 0, 0, 0), edit(0, 1, 0, 0), edit(0, 1, 1, 1), edit(0, 2, 3, 3)]
    write("tmesh", "split", bytes([0, 0, 0, 0]) + listed(split))
    write("tmesh", "grid", bytes([2, 1, 0, 0]) + listed(split + [edit(0, 0, 1, 1), edit(0, 0, 2, 0), edit(0, 1, 2, 2)]))
    undone = [edit(1, 2, 3, 3), edit(1, 1, 1, 1), edit(1, 1, 0, 0), edit(1, 0, 0, 0)]
    write("tmesh", "undone", bytes([0, 0, 0, 0]) + listed(split + undone))
    deep = [edit(0, level, 0, 0) for level in range(7)]
    write("tmesh", "deep", bytes([1, 1, 0, 0]) + listed(deep))


def projection():
    def net(height):
        rows = [(16 * (k // 4), 16 * (k % 4), int(height(k // 4, k % 4))) for k in range(16)]
        return b"".join(struct.pack("<bbb", *row) for row in rows)

    points = [struct.pack("<bbb", *row) for row in [(24, 24, 40), (-30, 0, 0), (48, 48, 0), (24, 24, 0), (100, -100, 100)]]
    write("projection", "plane", net(lambda i, j: 0) + listed(points))
    write("projection", "saddle", net(lambda i, j: 8 * (i - 1.5) * (j - 1.5)) + listed(points))
    write("projection", "bowl", net(lambda i, j: 20 * ((i - 1.5) ** 2 + (j - 1.5) ** 2)) + listed(points))
    write("projection", "fold", net(lambda i, j: 100 * (-1) ** i) + listed(points))
    write("projection", "line", bytes(3) * 8 + b"\x10\x00\x00" * 8 + listed(points))


CALLS = (
    "New Read Clone Free SetParameters SetPoints SetField RemoveField Parameterize Cut RemoveTriangles Fit Eval Save "
    "Tessellate FreeSurface"
).split()


def call(name, content=b""):
    """An enumeration is chosen by the upper bits of a word."""
    return struct.pack("<I", -(-(CALLS.index(name) << 32) // len(CALLS))) + content


def calls():
    points, triangles = sheet(5)
    nodes = listed(struct.pack("<bbb", *np.rint(16 * row).astype(int)) for row in points)
    corners = listed(bytes(row.tolist()) for row in triangles)
    new = call("New", b"\x00" + nodes + corners + bytes([0, 0, 0]))
    fit = call("Fit", bytes([0, 0, 4]))
    evaluate = call("Eval", b"\x00" + listed(bytes(pair) for pair in [(0, 0), (64, 64), (128, 128), (200, 10)]) + b"\x01")
    save = call("Save", bytes([0, 1, 0]))
    write("calls", "fit", listed([new, call("Parameterize", b"\x00"), fit, evaluate, save, call("Tessellate", bytes([1, 1]))]))
    field = call("SetField", b"\x00" + listed(bytes([k]) for k in range(25)))
    cut = call("Cut", bytes([0, 1]) + listed(bytes([k]) for k in (10, 11, 12)))
    less = call("RemoveTriangles", bytes([1, 2]) + listed(bytes([k]) for k in (0, 1)))
    free = call("Free", b"\x00")
    write("calls", "mesh", listed([new, field, call("Clone", bytes([0, 2])), cut, less, call("RemoveField", b"\x00"), free]))
    given = call("SetParameters", b"\x00" + listed(struct.pack("<bb", k // 5, k % 5) for k in range(25)))
    moved = call("SetPoints", b"\x00" + listed(struct.pack("<bbb", k, k // 5, k % 5) for k in range(25)))
    flipped = call("Save", bytes([0, 1, 1]) + struct.pack("<HB", 40, 255))
    write("calls", "given", listed([new, given, fit, flipped, moved, fit, call("FreeSurface", b"\x00")]))
    file = b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
    read = call("Read", b"\x00\x01" + listed(bytes([byte]) for byte in file))
    write("calls", "read", listed([read, call("Parameterize", b"\x00"), fit, evaluate]))


for make in (readers, saved, trims, tmesh, projection, calls):
    make()
