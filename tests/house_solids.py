#!/usr/bin/env python3
"""Holds the solids of a house to its meshes: house_solids.py FOLDER, with house.json, house.parts.csv and house.obj (and house.glb).

No two solids overlap: points of every prism of a roof are inside of it alone. The volume of all solids, with the leaves of doors and the panes of
windows, is that of the mesh; each of its edges is between two faces that turn opposite ways. Where assimp is installed, it reads the
.obj and .glb, and finds the same volume and area."""
import json
import math
import os
import random
import shutil
import subprocess
import sys
from fractions import Fraction as F

import house_prisms

failures = []


def check(what, holds):
    if not holds:
        failures.append(what)


def check_apart(house):
    chance = random.Random(1)
    boxes = [s["box"] for s in house["solids"]]
    prisms = house["roofs"] + house.get("wedges", [])
    known = [house_prisms.Known(prism) for prism in prisms]
    for prism, own in zip(prisms, known):
        check(f"a prism of cell {prism['of']} is sound", house_prisms.is_sound(prism))
        for _ in range(4):
            parts = [F(chance.randrange(1, 1000)) for _ in own.corners]
            x, y = (sum(p * c[k] for p, c in zip(parts, own.corners)) / sum(parts) for k in (0, 1))
            low, high = own.ends(x, y)
            z = low + (high - low) * F(chance.randrange(1, 1000), 1000)
            inside = sum(other.is_inside(x, y, z) for other in known)
            inside += sum(b[0] < x < b[1] and b[2] < y < b[3] and b[4] < z < b[5] for b in boxes)
            check(f"a point of a {prism['kind']} of cell {prism['of']} is in {inside} solids", inside == 1)


def check_boxes(house):
    boxes = [s["box"] for s in house["solids"]]
    for i, a in enumerate(boxes):
        check(f"box {i} has a size", a[0] < a[1] and a[2] < a[3] and a[4] < a[5])
        for b in boxes[:i]:
            check("boxes are apart", not (a[0] < b[1] and b[0] < a[1] and a[2] < b[3] and b[2] < a[3] and a[4] < b[5] and b[4] < a[5]))


def volume_of(house):
    """Cubic metres."""
    total = F(0)
    for b in (s["box"] for s in house["solids"]):
        total += F((b[1] - b[0]) * (b[3] - b[2]) * (b[5] - b[4]))
    total += sum(map(house_prisms.volume_of, house["roofs"] + house.get("wedges", [])))
    steps = [s for s in house["solids"] if s["kind"] == "flight"] + house.get("wedges", [])
    flights = {house["faces"][s["of"]]["kind"] for s in steps}
    openings = {f["kind"] for f in house["faces"]} - {"wall", "party", "open", "floor", "stair"} - flights
    total += sum(F(p["volume"]) for p in house["parts"] if p["part"] in openings)
    return total / 10**27


def read_obj(path):
    at, faces = [], []
    for words in map(str.split, open(path)):
        if words and words[0] == "v":
            at.append(tuple(map(float, words[1:4])))
        elif words and words[0] == "f":
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return at, faces


def measure(at, faces):
    volume = area = 0.0
    for face in faces:
        for k in range(1, len(face) - 1):
            a, b, c = (at[face[i]] for i in (0, k, k + 1))
            n = [(b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]) for i, j in ((1, 2), (2, 0), (0, 1))]
            area += math.sqrt(sum(x * x for x in n)) / 2
            volume += sum(p * q for p, q in zip(a, n)) / 6
    return volume, area


def check_closed(faces):
    edges = {}
    for face in faces:
        for a, b in zip(face, face[1:] + face[:1]):
            edges[a, b] = edges.get((a, b), 0) + 1
    check("each edge is between two faces", all(n == 1 and edges.get((b, a)) == 1 for (a, b), n in edges.items()))


def is_near(a, b, part):
    return abs(a - b) <= part * abs(b)


folder = sys.argv[1]
house = json.load(open(folder + "/house.json"))
check_boxes(house)
check_apart(house)
at, faces = read_obj(folder + "/house.obj")
check_closed(faces)
volume, area = measure(at, faces)
check(f"the mesh holds {volume}, the solids {float(volume_of(house))}", is_near(volume, float(volume_of(house)), 1e-9))
if shutil.which("assimp"):
    for kind in ("obj", "glb"):
        if not os.path.exists(f"{folder}/house.{kind}"):
            continue
        subprocess.run(["assimp", "export", f"{folder}/house.{kind}", f"{folder}/read-{kind}.obj"], check=True, stdout=subprocess.DEVNULL)
        read = measure(*read_obj(f"{folder}/read-{kind}.obj"))
        check(f"assimp reads .{kind}: {read}, not {(volume, area)}", is_near(read[0], volume, 1e-5) and is_near(read[1], area, 1e-5))
print("\n".join(failures[:20]) or "fine")
