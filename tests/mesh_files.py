#!/usr/bin/env python3
"""Holds the files of one form to each other: mesh_files.py METRES FORM ENDING...

FORM.obj has the numbers of the rules, of which one is METRES long. FORM.glb is in metres, y up, with linear colours; FORM.3mf says its unit, has one
object (or as many as --objects says), each closed, and its colours; FORM.ply has the colours of faces in sRGB. All have the same size, and those with
colours the same colours on as much of the surface."""
import argparse
import json
import struct
import sys
import xml.etree.ElementTree as xml
import zipfile
from collections import Counter
from itertools import groupby

failures = []


def check(what, holds):
    if not holds:
        failures.append(what)


def area(a, b, c):
    u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
    return sum((u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2]) ** 2 for i in range(3)) ** 0.5 / 2


def scaled(points, factor):
    return [tuple(factor * c for c in p) for p in points]


def extent(points):
    return [min(p[k] for p in points) for k in range(3)] + [max(p[k] for p in points) for k in range(3)]


def coloured(points, faces):
    """How much of the surface has which colour. A face is its corners and a colour."""
    areas = Counter()
    for corners, colour in faces:
        for i in range(1, len(corners) - 1):
            areas[colour] += area(*(points[corners[k]] for k in (0, i, i + 1)))
    return areas


def read_obj(path):
    points = [tuple(map(float, line.split()[1:4])) for line in open(path, encoding="utf-8") if line.startswith("v ")]
    faces = [([int(word.split("/")[0]) - 1 for word in line.split()[1:]], None) for line in open(path, encoding="utf-8") if line.startswith("f ")]
    return points, faces


def srgb(linear):
    """The byte of sRGB (IEC 61966-2-1) that an amount of light is."""
    return round(255 * (12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055))


def read_glb(path):
    data = open(path, "rb").read()
    magic, version, size, length, kind = struct.unpack("<IIIII", data[:20])
    check("a binary glTF 2", (magic, version, size, kind) == (0x46546C67, 2, len(data), 0x4E4F534A))
    tree, binary = json.loads(data[20:20 + length]), data[28 + length:]

    def values(index, kind, count):
        accessor = tree["accessors"][index]
        view = tree["bufferViews"][accessor["bufferView"]]
        at = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        return struct.unpack_from(f"<{accessor['count'] * count}{kind}", binary, at)

    points, faces = [], []
    for position, primitives in groupby((p for mesh in tree["meshes"] for p in mesh["primitives"]), lambda p: p["attributes"]["POSITION"]):
        numbers = values(position, "f", 3)
        first, bounds = len(points), tree["accessors"][position]
        points += [(x, -z, y) for x, y, z in zip(numbers[::3], numbers[1::3], numbers[2::3])]
        ends = extent(list(zip(numbers[::3], numbers[1::3], numbers[2::3])))
        check("bounds are those of the points", all(abs(a - b) <= 1e-6 * abs(a) for a, b in zip(ends, bounds["min"] + bounds["max"])))
        for primitive in primitives:
            red, green, blue, alpha = tree["materials"][primitive["material"]]["pbrMetallicRoughness"]["baseColorFactor"]
            check("colours are between 0 and 1", all(0 <= c <= 1 for c in (red, green, blue, alpha)) and alpha > 0)
            corners = [first + corner for corner in values(primitive["indices"], "I", 1)]
            faces += [(corners[i:i + 3], (srgb(red), srgb(green), srgb(blue))) for i in range(0, len(corners), 3)]
    return points, faces


def read_3mf(path, objects):
    core = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
    with zipfile.ZipFile(path) as archive:
        check("the archive is whole", archive.testzip() is None)
        root = xml.fromstring(archive.read("3D/3dmodel.model"))
    metres = {"millimeter": 0.001, "centimeter": 0.01, "meter": 1, "inch": 0.0254, "foot": 0.3048}[root.get("unit")]
    materials = {m.get("id"): [b.get("displaycolor") for b in m.findall(core + "base")] for m in root.iter(core + "basematerials")}
    ids = [resource.get("id") for resource in root.find(core + "resources")]
    check("ids are unique", len(set(ids)) == len(ids))
    made = {o.get("id"): o for o in root.iter(core + "object")}
    placed = [item.get("objectid") for item in root.iter(core + "item")]
    check(f"{len(made)} objects, each placed once", len(made) == objects and sorted(placed) == sorted(made))
    points, faces = [], []
    for each in made.values():
        first, edges = len(points), Counter()
        points += [tuple(metres * float(v.get(k)) for k in "xyz") for v in each.iter(core + "vertex")]
        for triangle in each.iter(core + "triangle"):
            corners = [int(triangle.get(k)) for k in ("v1", "v2", "v3")]
            group, index = triangle.get("pid", each.get("pid")), triangle.get("p1", each.get("pindex"))
            colour = None
            if group is not None:
                shown = materials[group][int(index)]
                colour = tuple(int(shown[i:i + 2], 16) for i in (1, 3, 5))
            check("a triangle has three corners", len(set(corners)) == 3)
            edges.update((corners[i - 1], corners[i]) for i in range(3))
            faces.append(([first + c for c in corners], colour))
        check("each edge is between two triangles that turn alike", all(n == 1 and edges[b, a] == 1 for (a, b), n in edges.items()))
    return points, faces


def read_ply(path):
    """Of those that we write: little-endian doubles, faces with a list of corners and perhaps a colour."""
    data = open(path, "rb").read()
    header, _, body = data.partition(b"end_header\n")
    counts, lines, at, element = {}, header.decode().splitlines(), 0, None
    properties = {}
    for line in lines:
        words = line.split()
        if words[0] == "element":
            element = words[1]
            counts[element], properties[element] = int(words[2]), []
        elif words[0] == "property":
            properties[element].append(words[1:])
    sizes = {"double": "d", "float": "f", "uchar": "B", "int": "i", "uint": "I"}
    form = "<" + "".join(sizes[p[0]] for p in properties["vertex"])
    points = [struct.unpack_from(form, body, i * struct.calcsize(form))[:3] for i in range(counts["vertex"])]
    at, faces = counts["vertex"] * struct.calcsize(form), []
    for _ in range(counts["face"]):
        corners, colour = None, []
        for words in properties["face"]:
            if words[0] == "list":
                [n] = struct.unpack_from("<" + sizes[words[1]], body, at)
                at += struct.calcsize(sizes[words[1]])
                corners = struct.unpack_from(f"<{n}{sizes[words[2]]}", body, at)
                at += n * struct.calcsize(sizes[words[2]])
            else:
                colour += struct.unpack_from("<" + sizes[words[0]], body, at)
                at += struct.calcsize(sizes[words[0]])
        faces.append((corners, tuple(colour[:3]) if colour else None))
    return points, faces


def alike(a, b, most):
    return all(abs(x - y) <= most for x, y in zip(a, b))


parser = argparse.ArgumentParser()
parser.add_argument("metres", type=float)
parser.add_argument("form")
parser.add_argument("endings", nargs="+")
parser.add_argument("--objects", type=int, default=1)
parser.add_argument("--colours", type=int, help="how many there are, where formats have them")
options = parser.parse_args()
points, faces = read_obj(options.form + ".obj")
points = scaled(points, options.metres)
size = max(abs(c) for c in extent(points))
whole = sum(coloured(points, faces).values())
shown = {}
for ending in options.endings:
    if ending == "glb":
        other, surface = read_glb(options.form + ".glb")
    elif ending == "3mf":
        other, surface = read_3mf(options.form + ".3mf", options.objects)
    else:
        other, surface = read_ply(options.form + ".ply")
        other = scaled(other, options.metres)
    check(f".{ending} is as large: {extent(other)}, not {extent(points)}", alike(extent(other), extent(points), 1e-6 * size))
    areas = coloured(other, surface)
    check(f".{ending} has as much surface", abs(sum(areas.values()) - whole) <= 1e-4 * whole)
    if None not in areas:
        shown[ending] = areas
for ending, areas in shown.items():
    check(f".{ending} has {len(areas)} colours", options.colours is None or len(areas) == options.colours)
    if options.colours is None or options.colours > 1:
        for other, same in shown.items():
            check(f".{ending} has the colours of .{other}: {areas}, {same}", areas.keys() == same.keys() and all(abs(areas[c] - same[c]) <= 1e-4 * whole for c in areas))
print("\n".join(failures[:20]) or "fine")
sys.exit(bool(failures))
