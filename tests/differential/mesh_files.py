"""Meshes as files hold them, and what can be measured of their triangles."""
import io
import math
import os
import re
import struct
import xml.etree.ElementTree as xml
import zipfile
from collections import Counter, defaultdict

from program import Wrong, read_json, same


class Mesh:
    def __init__(self, vertices, triangles):
        self.vertices, self.triangles = vertices, triangles

    def corners(self, triangle):
        return [self.vertices[i] for i in triangle]


def read_mesh(path):
    """Of each format that is read here. OBJ, PLY and OFF have all digits, the others have floats."""
    with open(path, "rb") as file:
        return READERS[os.path.splitext(path)[1]](file.read())


def read_obj(data):
    lines = [line.split() for line in data.decode().splitlines()]
    vertices = [tuple(map(float, words[1:4])) for words in lines if words[:1] == ["v"]]
    return Mesh(vertices, [tuple(int(word.split("/")[0]) - 1 for word in words[1:]) for words in lines if words[:1] == ["f"]])


def read_ply(data):
    head, _, body = data.partition(b"end_header\n")
    count, faces = (int(found) for found in re.findall(r"^element \w+ (\d+)$", head.decode(), re.M))
    width = 24 + 24 * (b"property double nx" in head)
    vertices = [struct.unpack_from("<3d", body, width * i) for i in range(count)]
    return Mesh(vertices, [struct.unpack_from("<3I", body, width * count + 1 + 13 * i) for i in range(faces)])


def read_off(data):
    lines = [line.split() for line in data.decode().splitlines() if line and not line.startswith("#")][1:]
    count, faces = map(int, lines[0][:2])
    vertices = [tuple(map(float, words[:3])) for words in lines[1:1 + count]]
    return Mesh(vertices, [tuple(map(int, words[1:4])) for words in lines[1 + count:1 + count + faces]])


def read_stl(data):
    """Without indices: what lies at one place is one vertex."""
    numbers, triangles = {}, []
    for i in range(struct.unpack_from("<I", data, 80)[0]):
        values = struct.unpack_from("<9f", data, 84 + 50 * i + 12)
        triangles.append(tuple(numbers.setdefault(values[k:k + 3], len(numbers)) for k in (0, 3, 6)))
    return Mesh(list(numbers), triangles)


def read_glb(data):
    length = struct.unpack_from("<I", data, 12)[0]
    said, body = read_json("glb", data[20:20 + length].decode()), data[28 + length:]
    vertices, triangles = [], []
    for part in (p for mesh in said.get("meshes", []) for p in mesh["primitives"]):
        base = len(vertices)
        vertices += list(zip(*[iter(accessor(said, body, part["attributes"]["POSITION"], 3, "f"))] * 3))
        indices = accessor(said, body, part["indices"], 1, None)
        triangles += [tuple(base + i for i in triangle) for triangle in zip(*[iter(indices)] * 3)]
    return Mesh(vertices, triangles)


def accessor(said, body, which, width, code):
    wanted = said["accessors"][which]
    view = said["bufferViews"][wanted["bufferView"]]
    code = code or {5121: "B", 5123: "H", 5125: "I"}[wanted["componentType"]]
    return struct.unpack_from(f"<{wanted['count'] * width}{code}", body, view.get("byteOffset", 0) + wanted.get("byteOffset", 0))


def read_3mf(data):
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        root = xml.fromstring(archive.read("3D/3dmodel.model"))
    tag = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
    vertices, triangles = [], []
    for mesh in root.iter(tag + "mesh"):
        base = len(vertices)
        vertices += [tuple(float(v.get(a)) for a in "xyz") for v in mesh.iter(tag + "vertex")]
        triangles += [tuple(base + int(t.get(a)) for a in ("v1", "v2", "v3")) for t in mesh.iter(tag + "triangle")]
    return Mesh(vertices, triangles)


READERS = {".obj": read_obj, ".ply": read_ply, ".off": read_off, ".stl": read_stl, ".glb": read_glb, ".3mf": read_3mf}


def same_mesh(question, got, want, change=lambda vertex: vertex):
    """The same triangles in the same order, with corners that are those of the other, changed, but for the digits of floats."""
    same(f"triangles of {question}", len(got.triangles), len(want.triangles))
    beside = 1e-6 * max((abs(c) for vertex in want.vertices for c in vertex), default=0)
    for one, other in zip(got.triangles, want.triangles):
        for a, b in zip(got.corners(one), map(change, want.corners(other))):
            if max(abs(p - q) for p, q in zip(a, b)) > beside:
                raise Wrong(f"corners of {question}", a, b)


# ---- what is true of a closed mesh

def directed_edges(mesh):
    return Counter((t[k], t[k - 2]) for t in mesh.triangles for k in range(3))


def is_closed(question, mesh):
    """Each edge has two triangles, which run along it in turn; each vertex has one ring of them."""
    edges = directed_edges(mesh)
    wrong = [edge for edge, count in edges.items() if count != 1 or edges[edge[::-1]] != 1]
    same(f"{question}: edges without two triangles", wrong[:3], [])
    wrong = [v for v, pairs in rings(mesh).items() if not one_ring(pairs)]
    same(f"{question}: vertices with more than one ring", wrong[:3], [])
    used = {v for t in mesh.triangles for v in t}
    same(f"{question}: vertices of no triangle", len(mesh.vertices) - len(used), 0)


def rings(mesh):
    made = defaultdict(dict)
    for t in mesh.triangles:
        for k in range(3):
            made[t[k]][t[k - 2]] = t[k - 1]
    return made


def one_ring(following):
    begin = at = next(iter(following))
    for steps in range(1, len(following) + 1):
        at = following.get(at)
        if at == begin:
            return steps == len(following)
    return False


def parts(mesh):
    """How many pieces hang together by vertices."""
    parent = list(range(len(mesh.vertices)))

    def root(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i
    for a, b, c in mesh.triangles:
        parent[root(a)] = parent[root(b)] = root(c)
    return len({root(t[0]) for t in mesh.triangles})


def cross(u, v):
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def minus(u, v):
    return (u[0] - v[0], u[1] - v[1], u[2] - v[2])


def volume(mesh):
    return sum(dot(a, cross(b, c)) for a, b, c in map(mesh.corners, mesh.triangles)) / 6


def area(mesh):
    return math.fsum(math.sqrt(dot(n, n)) for n in (cross(minus(b, a), minus(c, a)) for a, b, c in map(mesh.corners, mesh.triangles))) / 2


def centroid(mesh):
    whole, moment = 0, [0, 0, 0]
    for a, b, c in map(mesh.corners, mesh.triangles):
        six = dot(a, cross(b, c))
        whole += six
        for i in range(3):
            moment[i] += six * (a[i] + b[i] + c[i])
    return [m / (4 * whole) for m in moment] if whole else None


def bounds(mesh):
    return [min(v[i] for v in mesh.vertices) for i in range(3)], [max(v[i] for v in mesh.vertices) for i in range(3)]


def close(question, got, want, tolerance):
    """Numbers that agree but for so much."""
    if not abs(got - want) <= tolerance:
        raise Wrong(question, got, want)


def measured(question, stats, mesh):
    """What the program measures of a mesh is what Python measures of its triangles."""
    same(f"{question}: vertices, triangles", (stats["vertices"], stats["triangles"]), (len(mesh.vertices), len(mesh.triangles)))
    if not mesh.triangles:
        return
    edges = len({tuple(sorted(edge)) for edge in directed_edges(mesh)})
    same(f"{question}: Euler number", stats["euler"], len(mesh.vertices) - edges + len(mesh.triangles))
    same(f"{question}: parts", stats["parts"], parts(mesh))
    low, high = bounds(mesh)
    size = max(h - l for l, h in zip(low, high))
    reach = max(map(abs, low + high))
    close(f"{question}: volume", stats["volume"], volume(mesh), 1e-9 * max(reach * size * size, 1e-300))
    close(f"{question}: area", stats["area"], area(mesh), 1e-9 * size * size)
    for got, want in zip(sum(stats["bounds"], []), low + high):
        close(f"{question}: bounds", got, want, 1e-9 * reach)
