#!/usr/bin/env python3
"""Holds the roofs of a house to what they mean: house_slabs.py HOUSE.json FORM.plan [POINTS]. FORM has one form, whose roofs are of shapes that
this file knows; nothing of the engines is shared.

A roof has a height h over each point of the plan. Over what the highest cells of a storey cover, with half a wall around, its slab is from
F + h to F + h + roof; below it is wall up to F + h, from F or, above a room that is open to it, from F - deck; or nothing. What each cell
covers, h, and where walls are is worked out point by point on a grid. Volumes are those of the grid's columns, and of all slabs exactly
`roof` times their area in plan, which is that of what is covered, and of eaves."""
import itertools
import json
import re
import sys
from fractions import Fraction as F

import house_prisms

failures = set()


def check(what, holds):
    if not holds:
        failures.add(what)


# ---- the form


def length(text):
    """Nanometres of 1'6", 1'6-3/4", 1' 6 3/4", 5m, 2.5m, 250mm."""
    metric = re.fullmatch(r"([\d.]+)(mm|cm|m)", text)
    if metric:
        return int(F(metric[1]) * {"mm": 10**6, "cm": 10**7, "m": 10**9}[metric[2]])
    feet, inches = re.fullmatch(r"(?:([\d.]+)')?-?(?:([\d/ -]+)\")?", text.strip()).groups()
    parts = sum(F(part) for part in re.split(r"[ -]+", inches.strip())) if inches else 0
    return int((F(feet or 0) * 12 + parts) * 25400000)


def read_form(path):
    text = re.sub(r"#.*", "", open(path).read())
    text = text[re.search(r'\bform \S+ (?:"[^"]*" )?of ', text).start():]
    size = {word: length(re.search(rf"^\s*{word} (\S+(?: [\d/]+\")?)", text, re.M)[1]) for word in ("wall", "partition", "floor", "roof")}
    levels = [0]
    for high in re.findall(r"^\s*storey \S+ (\S+(?: [\d/]+\")?)", text, re.M):
        levels.append(levels[-1] + length(high))
    choices = re.findall(r"^\s*option (\S+)(?: (roof|storeys))? =", text, re.M)
    return size, levels, choices


class Roof:
    """`gable(9:12,eaves-1'6",open)`, as a house line has it."""

    def __init__(self, text):
        self.kind, inside = re.fullmatch(r"([a-z-]+)(?:\((.*)\))?", text).groups()
        words = inside.split(",") if inside else []
        self.open, self.across = "open" in words, "across" in words
        self.eaves = next((length(w[6:]) for w in words if w.startswith("eaves")), 0)
        self.side = next((w for w in words if w in ("back", "front")), None)
        slope = next((w for w in words if ":" in w), None)
        self.slope = F(*map(int, slope.split(":"))) if slope else 0
        self.high = length(words[0]) if self.kind == "vault" else 0


# ---- the house


class House:
    def __init__(self, json_path, form_path):
        self.json = json.load(open(json_path))
        self.size, self.levels, choices = read_form(form_path)
        self.cells = self.json["cells"]
        values = re.sub(r"\(.*?\)", lambda m: m[0].replace(" ", "-"), self.json["house"].split(" ; ")[1]).split()
        self.roofs = {zone: Roof(value) for (zone, what), value in zip(choices, values) if what == "roof"}
        self.half = self.size["wall"] // 2
        self.tops = [i for i, c in enumerate(self.cells) if not any(
            d["tray"] == c["tray"] and d["zone"] == c["zone"] and d["storey"] > c["storey"] for d in self.cells)]
        self.feet, self.ridges = {}, {}
        for s in self.json["solids"]:
            if s["kind"] in ("outside", "party", "partition", "post"):
                storey = s["of"] if s["kind"] == "post" else self.cells[self.json["faces"][s["of"]]["a"]]["storey"]
                self.feet.setdefault(storey, []).append(s["box"])

    def roof(self, cell):
        return self.roofs.get(self.cells[cell]["zone"], Roof("flat"))

    def grown(self, cell, by=None):
        x0, x1, y0, y1 = self.cells[cell]["rect"]
        by = self.half if by is None else by
        return x0 - by, x1 + by, y0 - by, y1 + by

    def foot(self, cell):
        return self.levels[self.cells[cell]["storey"] + 1]

    def neighbour(self, cell, step):
        """The cell that goes on with its roof in the next tray."""
        c = self.cells[cell]
        for i in self.tops:
            d = self.cells[i]
            if (d["tray"], d["zone"], d["storey"], d["rect"][2:]) == (c["tray"] + step, c["zone"], c["storey"], c["rect"][2:]):
                return i
        return None

    def run(self, cell):
        ends = []
        for step in (-1, 1):
            last = cell
            while self.neighbour(last, step) is not None:
                last = self.neighbour(last, step)
            ends.append(last)
        return ends

    def height(self, cell, x, y):
        """h of the cell's roof."""
        roof = self.roof(cell)
        x0, x1, y0, y1 = self.grown(cell)
        along, low, high = (x, x0, x1) if roof.across else (y, y0, y1)
        if roof.kind == "flat":
            return 0
        if roof.kind == "shed":
            return roof.slope * (y - y0 if roof.side == "back" else y1 - y)
        if roof.kind == "vault":
            part = F(along - low, high - low) * 16
            i = min(max(part.__floor__(), 0), 15)
            bow = lambda k: F(4 * roof.high * k * (16 - k), 256)
            return bow(i) + (bow(i + 1) - bow(i)) * (part - i)
        gable = roof.slope * min(along - low, high - along)
        if roof.kind == "hip":
            first, last = self.run(cell)
            return min([gable] + [roof.slope * (x - self.grown(first)[0])] * self.is_free(first, -1)
                       + [roof.slope * (self.grown(last)[1] - x)] * self.is_free(last, 1))
        if roof.kind == "cross-gable":
            x0, x1 = self.cells[cell]["rect"][:2]
            return max(gable, roof.slope * min(x - x0, x1 - x))
        return gable

    def is_free(self, cell, step):
        """Does no higher wall stand against all of the end of its roof?"""
        c = self.cells[cell]
        x = c["rect"][0 if step < 0 else 1]
        higher = [d["rect"] for d in self.cells if d["storey"] == c["storey"] + 1 and d["tray"] == c["tray"] + step and x in d["rect"][:2]]
        at = c["rect"][2]
        for r in sorted(higher, key=lambda r: r[2]):
            at = max(at, r[3]) if r[2] <= at else at
        return at < c["rect"][3]


def within(r, x, y):
    return r[0] <= x <= r[1] and r[2] <= y <= r[3]


def covering(house, storey, x, y):
    """The highest cell of that storey that covers a point: whose rectangle it is in; that has it beside one of its sides; at a corner."""
    above = [i for i, c in enumerate(house.cells) if c["storey"] == storey + 1]
    if any(within(house.grown(i), x, y) for i in above):
        return None
    tops = [i for i in house.tops if house.cells[i]["storey"] == storey]
    for i in tops:
        if within(house.cells[i]["rect"], x, y):
            return i
    for i in tops:
        x0, x1, y0, y1 = house.cells[i]["rect"]
        if within(house.grown(i), x, y) and (x0 <= x <= x1 or y0 <= y <= y1):
            return i
    return next((i for i in tops if within(house.grown(i), x, y)), None)


def meet_at_ridge(house, face):
    """Is each roof nowhere higher than all along the face, and neither there as much higher as a slab is thick?"""
    parts, tops = [F(i, 32) for i in range(33)], []
    between = lambda r, p, q: (r[0] + (r[1] - r[0]) * p, r[2] + (r[3] - r[2]) * q)
    for cell in (face["a"], face["b"]):
        tops.append({house.height(cell, *between(face["at"], p, p)) for p in parts})
        if len(tops[-1]) > 1 or any(house.height(cell, *between(house.cells[cell]["rect"], p, q)) > min(tops[-1]) for p in parts for q in parts):
            return False
    return house.roof(face["a"]).open == house.roof(face["b"]).open and abs(min(tops[0]) - min(tops[1])) < house.size["roof"]


def goes_on(house, face):
    """Is below the roof nothing between the two cells of a face?"""
    if id(face) not in house.ridges:
        house.ridges[id(face)] = find_whether_goes_on(house, face)
    return house.ridges[id(face)]


def find_whether_goes_on(house, face):
    if face["b"] is None or not {face["a"], face["b"]} <= set(house.tops):
        return False
    a, b = house.cells[face["a"]], house.cells[face["b"]]
    one = a["zone"] == b["zone"] and a["rect"][2:] == b["rect"][2:] and not house.roof(face["a"]).across
    return (one or meet_at_ridge(house, face)) and face["kind"] != "party" and (not house.roof(face["a"]).open or face["kind"] == "open")


def is_wall(house, cell, x, y):
    half = max(house.size["wall"], house.size["partition"]) // 2
    for face in house.json["faces"]:
        if face["rel"] != "above" and cell in (face["a"], face["b"]) and not goes_on(house, face):
            x0, x1, y0, y1 = face["at"]
            if within((x0 - half, x1 + half, y0 - half, y1 + half), x, y):
                return True
    if not house.roof(cell).open:
        return False
    feet = house.feet.get(house.cells[cell]["storey"], [])
    return not within(house.cells[cell]["rect"], x, y) or any(within(box, x, y) for box in feet)


def wanted_at(house, storey, x, y):
    cell = covering(house, storey, x, y)
    if cell is None:
        return None
    foot, h = house.foot(cell), house.height(cell, x, y)
    found = {("roof", cell, foot + h, foot + h + house.size["roof"])}
    base = foot - (house.size["floor"] if house.roof(cell).open else 0)
    if is_wall(house, cell, x, y) and foot + h > base:
        found.add(("gable", cell, base, foot + h))
    return found


def check_eaves(house, storey, x, y, found):
    """Outside of what is covered there is a slab at most, of a roof whose eaves reach there; and there is one if no lower roof is near."""
    check(f"{len(found)} prisms over a point outside", len(found) <= 1)
    near = [i for i in house.tops if house.cells[i]["storey"] == storey and house.roof(i).eaves
            and within(house.grown(i, house.half + house.roof(i).eaves), x, y)]
    for kind, cell, low, high in found:
        h = house.foot(cell) + house.height(cell, x, y)
        check(f"eaves of cell {cell}", kind == "roof" and cell in near and (low, high) == (h, h + house.size["roof"]))
    higher = any(c["storey"] == storey + 1 and within(house.grown(i), x, y) for i, c in enumerate(house.cells))
    reach = 2 * max([house.roof(i).eaves for i in house.tops]) + house.size["wall"]
    lower = any(house.cells[i]["storey"] < storey and within(house.grown(i, reach), x, y) for i in house.tops)
    check(f"eaves over {float(x), float(y)}", bool(found) or not near or higher or lower)


def check_points(house, count):
    prisms = [(p, house_prisms.Known(p)) for p in house.json["roofs"]]
    ends = [house.grown(i, house.half + house.roof(i).eaves) for i in house.tops]
    low = [min(e[k] for e in ends) for k in (0, 2)]
    size = [max(e[k] for e in ends) - l for k, l in zip((1, 3), low)]
    column = {"roof": F(0), "gable": F(0)}
    for i, k in itertools.product(range(count), repeat=2):
        x, y = (l + F(2 * n + 1, 2 * count) * s + F(1, 7) for l, n, s in zip(low, (i, k), size))
        over = [(p["kind"], p["of"], *known.ends(x, y)) for p, known in prisms if known.is_over(x, y)]
        for storey in range(len(house.levels) - 1):
            found = [p for p in over if house.cells[p[1]]["storey"] == storey]
            wanted = wanted_at(house, storey, x, y)
            if wanted is None:
                check_eaves(house, storey, x, y, found)
            else:
                check(f"over {float(x), float(y)} above storey {storey}: {found}, not {wanted}", len(found) == len(wanted) and set(found) == wanted)
            for kind, _, bottom, top in found:
                column[kind] += top - bottom
    cell = F(size[0] * size[1], count * count)
    for kind, high in column.items():
        exact = sum(house_prisms.volume_of(p) for p, _ in prisms if p["kind"] == kind)
        off = abs(high * cell - exact) / max(exact, 1)
        check(f"{kind}s hold {float(exact)}, by the grid {float(high * cell)}", off < (F(1, 10) if kind == "roof" else 1) or count < 20)


def check_slabs(house):
    """A slab is as thick as the form says, and slabs cover what is covered, and eaves."""
    slabs = [p for p in house.json["roofs"] if p["kind"] == "roof"]
    plan = sum(map(house_prisms.plan_of, slabs))
    check("slabs are so thick", sum(map(house_prisms.volume_of, slabs)) == house.size["roof"] * plan)
    covered = F(0)
    for storey in range(len(house.levels) - 1):
        tops = [house.grown(i) for i in house.tops if house.cells[i]["storey"] == storey]
        above = [house.grown(i) for i, c in enumerate(house.cells) if c["storey"] == storey + 1]
        xs, ys = (sorted({r[k] for r in tops + above for k in pair}) for pair in ((0, 1), (2, 3)))
        for (x0, x1), (y0, y1) in itertools.product(zip(xs, xs[1:]), zip(ys, ys[1:])):
            middle = F(x0 + x1, 2), F(y0 + y1, 2)
            if any(within(r, *middle) for r in tops) and not any(within(r, *middle) for r in above):
                covered += (x1 - x0) * (y1 - y0)
    eaves = any(house.roof(i).eaves for i in house.tops)
    check(f"slabs over {float(plan)}, covered are {float(covered)}", plan >= covered if eaves else plan == covered)


def main():
    house = House(*sys.argv[1:3])
    check_slabs(house)
    check_points(house, int(sys.argv[3]) if len(sys.argv) > 3 else 24)
    print("\n".join(sorted(failures)[:10]) or "fine")


main()
