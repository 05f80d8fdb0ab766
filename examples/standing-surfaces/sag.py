#!/usr/bin/env python3
"""Scores surfaces by how far they sag under their own weight, which CalculiX (ccx) computes with shell elements.

A unit is a metre. The shell is of concrete and 8 cm thick. It is held where it stands: clamped, at the vertices no higher than a tenth of
its height above the lowest. The score is the largest movement, in millimetres; what moves by more than a metre
does not hold, and has none.
"""
import json, math, os, subprocess, sys

THICKNESS, STIFFNESS, POISSON, DENSITY, GRAVITY = 0.08, 30e9, 0.2, 2400, 9.81


def read_mesh(path):
    """The vertices, and the faces as triangles around their first corners; faces without area are left out."""
    points, triangles = [], []
    for line in open(path):
        words = line.split()
        if words[:1] == ["v"]:
            points.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) - 1 for word in words[1:]]
            triangles += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:]) if area(points, corners[0], b, c) > 1e-6]
    return points, triangles


def area(points, a, b, c):
    u = [points[b][i] - points[a][i] for i in range(3)]
    v = [points[c][i] - points[a][i] for i in range(3)]
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return math.hypot(*n) / 2


def standing(points, triangles):
    """The triangles that are joined to the ground by common vertices, and the vertices that stand on it."""
    used = {corner for triangle in triangles for corner in triangle}
    low, high = (f(points[corner][2] for corner in used) for f in (min, max))
    ground = {corner for corner in used if points[corner][2] <= low + (high - low) / 10}
    held, joined = set(ground), []
    while True:
        more = [t for t in triangles if not held.isdisjoint(t)]
        if len(more) == len(joined):
            return joined, ground
        joined = more
        held.update(corner for triangle in joined for corner in triangle)


def write_input(points, triangles, ground, out):
    """Triangles with six nodes: the corners, and the middles of the sides."""
    nodes, middles = {}, {}

    def node(place):
        return nodes.setdefault(place, len(nodes) + 1)

    def middle(a, b):
        place = tuple((points[a][i] + points[b][i]) / 2 for i in range(3))
        return middles.setdefault((min(a, b), max(a, b)), node(("middle", min(a, b), max(a, b), place)))

    rows = []
    for a, b, c in triangles:
        rows.append([node(("corner", corner, tuple(points[corner]))) for corner in (a, b, c)] + [middle(a, b), middle(b, c), middle(c, a)])
    print("*NODE, NSET=ALL", file=out)
    for place, number in nodes.items():
        print("%d, %.9g, %.9g, %.9g" % (number, *place[-1]), file=out)
    print("*ELEMENT, TYPE=S6, ELSET=SHELL", file=out)
    for number, row in enumerate(rows, 1):
        print(number, *row, sep=", ", file=out)
    print("*MATERIAL, NAME=CONCRETE\n*ELASTIC\n%g, %g\n*DENSITY\n%g" % (STIFFNESS, POISSON, DENSITY), file=out)
    print("*SHELL SECTION, ELSET=SHELL, MATERIAL=CONCRETE\n%g\n*BOUNDARY" % THICKNESS, file=out)
    for place, number in nodes.items():
        if place[0] == "corner" and place[1] in ground:
            print("%d, 1, 6" % number, file=out)
    print("*STEP\n*STATIC\n*DLOAD\nSHELL, GRAV, %g, 0, 0, -1\n*NODE PRINT, NSET=ALL\nU\n*END STEP" % GRAVITY, file=out)


def largest_movement(path):
    largest = None
    for line in open(path):
        words = line.split()
        if len(words) == 4 and words[0].isdigit():
            moved = math.hypot(*(float(word) for word in words[1:]))
            largest = moved if largest is None else max(largest, moved)
    return largest


def sag(mesh):
    points, triangles = read_mesh(mesh)
    if not triangles:
        raise ValueError("it has no faces")
    joined, ground = standing(points, triangles)
    if len(ground) > len(points) / 2:
        raise ValueError("most of it lies on the ground")
    if len(joined) < len(triangles):
        raise ValueError("some faces do not stand on anything")
    folder = os.path.dirname(mesh)
    with open(os.path.join(folder, "shell.inp"), "w") as out:
        write_input(points, triangles, ground, out)
    subprocess.run(["ccx", "shell"], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   env=dict(os.environ, OMP_NUM_THREADS="1"), check=False)
    moved = largest_movement(os.path.join(folder, "shell.dat"))
    if moved is None or not moved < 1:
        raise ValueError("it does not hold")
    return 1000 * moved


for line in sys.stdin:
    asked = json.loads(line)
    try:
        answer = {"id": asked["id"], "score": round(sag(asked["mesh"]), 6)}
    except (ValueError, OSError) as why:
        answer = {"id": asked["id"], "error": str(why)}
    print(json.dumps(answer), flush=True)
