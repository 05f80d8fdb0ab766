#!/usr/bin/env python3
"""Walls beside cells in the open, worked out again for the form of tests/cli/files/porch.plan: house_outdoor.py TARTAN FILE.plan HOUSES

From the JSON of each house (a line of HOUSES): what is in each upright face, which walls are thick, where posts stand; no two
solids meet."""
import json
import os
import subprocess
import sys
import tempfile

MM = 10**6
OUTDOOR = ("porch", "yard")
OPPOSITE = {"back": "front", "front": "back", "left": "right", "right": "left"}
OPENINGS = {"entrance": (900, 2000, 0), "window": (1000, 1200, 900), "hatch": (600, 600, 1000), "door": (900, 2000, 0)}
CLEAR = (2400, 2300)  # the height of the storeys' rooms


def outdoor(house, index):
    """A void is as the cell below it."""
    cell = house["cells"][index]
    if cell["function"] == "void":
        below = [i for i, c in enumerate(house["cells"]) if (c["tray"], c["zone"], c["storey"]) == (cell["tray"], cell["zone"], cell["storey"] - 1)]
        return outdoor(house, below[0])
    return cell["function"] in OUTDOOR


def fits(kind, face, storey):
    if kind not in OPENINGS:
        return True
    wide, high, sill = OPENINGS[kind]
    at = face["at"]
    return wide + 280 <= max(at[1] - at[0], at[3] - at[2]) / MM and sill + high <= CLEAR[storey]


def outside(house, cell, side, face):
    c = house["cells"][cell]
    wanted = [["open"]] if c["function"] in OUTDOOR else []
    wanted += [["window"]] if side == "back" else [["hatch"]] if side == "left" else []
    return next((kinds[0] for kinds in wanted if fits(kinds[0], face, c["storey"])), "wall")


def kind_of(house, face):
    a, b = face["a"], face["b"]
    first = house["cells"][a]
    if b is None:
        return outside(house, a, face["side"], face)
    second, open_ones = house["cells"][b], [outdoor(house, a), outdoor(house, b)]
    names = first["function"], second["function"]
    if not any(open_ones):
        return "door" if fits("door", face, first["storey"]) else "wall"
    across = face["side"] in ("back", "front")
    if across and sorted(names) == ["living", "porch"] and first["storey"] == 0 and fits("entrance", face, 0):
        return "entrance"
    wide = second["rect"][1] - second["rect"][0]
    if not across and names == ("porch", "porch") and wide == 4000 * MM and fits("hatch", face, first["storey"]):
        return "hatch"
    if all(open_ones):
        return "open"
    inner = b if open_ones[0] else a
    return outside(house, inner, face["side"] if inner == a else OPPOSITE[face["side"]], face)


def meet(a, b):
    return all(a[i] < b[i + 1] and b[i] < a[i + 1] for i in (0, 2, 4))


def check(line, scratch):
    out = os.path.join(scratch, "house.json")
    subprocess.run([tartan, "house", path, line, "-o", out], check=True, stdout=subprocess.DEVNULL)
    with open(out) as file:
        house = json.load(file)
    corners = {(s["box"][0] + s["box"][1], s["box"][2] + s["box"][3], s["of"]) for s in house["solids"] if s["kind"] == "post"}
    walls = {}
    for solid in house["solids"]:
        if solid["kind"] in ("outside", "party", "partition"):
            in_y = house["faces"][solid["of"]]["at"][0] == house["faces"][solid["of"]]["at"][1]
            walls[solid["of"]] = solid["kind"], solid["box"][1] - solid["box"][0] if in_y else solid["box"][3] - solid["box"][2]
    for face in house["faces"]:
        if face["rel"] == "above":
            continue
        storey = house["cells"][face["a"]]["storey"]
        seen["faces"] += 1
        outer = face["b"] is None or outdoor(house, face["a"]) or outdoor(house, face["b"])
        wanted = kind_of(house, face)
        roofed = face["b"] is None and storey > 0  # a lower roof may keep an opening out: no matter of this test
        if face["kind"] != wanted and not roofed:
            return f"face {face['id']}: {face['kind']}, not {wanted}"
        beside = outer and face["b"] is not None
        seen["beside"] += beside
        if face["kind"] == "open":
            at = face["at"]
            ends = [(2 * at[0], 2 * at[2], storey), (2 * at[1], 2 * at[3], storey)]
            if not all(end in corners for end in ends):
                return f"face {face['id']} is open without posts"
            continue
        if walls[face["id"]] != (("outside", 280 * MM) if outer else ("partition", 110 * MM)):
            return f"face {face['id']} is {walls[face['id']]}"
    boxes = [s["box"] for s in house["solids"]]
    return next((f"{a} and {b} meet" for i, a in enumerate(boxes) for b in boxes[i + 1:] if meet(a, b)), None)


tartan, path, lines = sys.argv[1:4]
seen, bad = {"faces": 0, "beside": 0}, 0
with open(lines) as file, tempfile.TemporaryDirectory() as scratch:
    houses = file.read().splitlines()
    for line in houses:
        found = check(line, scratch)
        if found:
            bad += 1
            print(line, found, sep=": ")
print(len(houses), "houses,", bad, "differ")
sys.exit(bad > 0 or seen["beside"] < len(houses))
