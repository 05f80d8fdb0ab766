#!/usr/bin/env python3
"""Walls, partitions, decks and roofs in layers, against an independent slow sum: house_layers.py TARTAN FIRST COUNT

Makes so many forms at random, with layers of some walls and decks and prices for some of them, and houses of each. Of every solid that has layers
it is worked out here, from the cells and faces alone, which layers it is cut into: from the outside or from the first cell of a face inwards, from
the top of a deck or a roof down, a post as the thicker of the walls that end there. Their boxes have to be those of the JSON, and to fill the solid; the
numbers, areas, volumes and costs of the bill are sums over them. A form of one line of thickness each has the same solids. The houses that cost at
most so much are as many, counted together, as are found one by one."""
import collections
import csv
import json
import os
import random
import subprocess
import sys
import tempfile
from fractions import Fraction as F

import house_prisms
import house_roof_layers

INCH = 25400000
WALLS = ("outside", "party", "partition")
FOOT = 12 * INCH


def quarters(n):
    """A length of so many quarters of an inch."""
    whole, rest = divmod(n, 4)
    part = {0: "", 1: "1/4", 2: "1/2", 3: "3/4"}[rest]
    return f'{whole} {part}"'.replace(' "', '"') if whole else f'{part}"'


class Roof:
    SHAPES = ("flat", "shed(back, 4:12)", "gable(9:12)", "gable(6:12, open)", "vault(2', across)", "cross-gable(8:12)", "gable(7:12, across, open)", "gable(9:12, eaves 1')", "hip(6:12)")

    def __init__(self, text):
        self.text, self.open, self.across = text, "open" in text, "across" in text


class Form:
    def __init__(self, seed):
        r = self.chance = random.Random(seed)
        self.thick = {"outside": 8 * r.randint(2, 4), "partition": 8 * r.randint(1, 2), "floor": r.randint(24, 48), "roof": r.randint(16, 40)}
        self.thick["party"] = self.thick["outside"]
        self.layers = {of: self.cut(self.thick[of]) for of in ("outside", "party", "partition", "floor", "roof") if r.random() < 0.8}
        self.together = "outside" in self.layers and r.random() < 0.3  # of all walls in one line
        if self.together:
            self.layers["party"] = self.layers["outside"]
        names = sorted({name for layers in self.layers.values() for name, _ in layers})
        self.prices = {name: (r.randint(1, 900), r.choice(("sf", "cf", "m2", "m3", "each"))) for name in names if r.random() < 0.8}
        self.roofs = {"body": Roof(r.choice(Roof.SHAPES)), "shed": Roof(r.choice(("flat", "shed(back, 4:12)", "shed(front, 2:12, open)"))), "bay": Roof("flat")}
        for part in ("wall", "party", "partition", "post", "floor", "roof"):
            if r.random() < 0.6:
                self.prices[part] = (r.randint(1, 900), r.choice(("sf", "cf")))

    def roof_of(self, zone):
        return self.roofs[zone]

    def inches(self, of):
        """In nanometres."""
        return F(self.thick[of] * INCH, 4)

    def cut(self, thick):
        r = self.chance
        ends = sorted(r.sample(range(1, thick), min(thick - 1, r.randint(0, 3)))) + [thick]
        return [(r.choice(("boards", "studs", "plaster", "felt", "stone")), b - a) for a, b in zip([0] + ends, ends)]

    def line(self, of, words, layered):
        said = f"  {words} {quarters(self.thick[of])}"
        if layered and of in self.layers:
            said += " { " + ", ".join(f"{name} {quarters(n)}" for name, n in self.layers[of]) + " }"
        return said

    def text(self, layered=True):
        r = random.Random(repr(self.thick))
        if self.together:
            walls = [self.line("outside", "wall", layered)]
        else:
            walls = [self.line("outside", "wall outside", layered), self.line("party", "wall party", layered)]
        kinds = [r.choice(("wall | party", "party | open", "wall | door", "door | party | open")) for _ in range(2)]
        lines = [f"schema hut {{ width role length = {r.randint(6, 8)}' | {r.randint(9, 12)}'",
                 f"  zone shed role band = none role absent | space({r.randint(5, 7)}')", f"  zone body role band = space({r.randint(8, 12)}', {r.randint(13, 15)}')",
                 "  zone bay role band = none role absent | space(5') }", "form huts of hut {", "  storey low 8'", "  storey high 8'", "  spine body",
                 *walls, self.line("partition", "partition", layered), self.line("floor", "floor", layered), self.line("roof", "roof", layered),
                 *(f"  option {zone} roof = {roof.text}" for zone, roof in self.roofs.items()),
                 "  option body storeys = 1 | 2", "  option shed storeys = 1 | 2", "  option bay storeys = 1",
                 "  function hall at cell(any)", "  opening door wide 3' high 6'8\" passage", "  opening sash wide 2' high 3' sill 2'",
                 f"  face cell(hall) along cell(hall) = {kinds[0]}", f"  face cell(hall) across cell(hall) = {kinds[1]}",
                 f"  face cell(bay) outside = {r.choice(('open', 'sash'))}", "  face cell(any) outside back = sash | wall", "  face cell(any) outside = wall",
                 f"  face cell(any) under cell(any) = {r.choice(('floor', 'stair', 'open | floor'))}"]
        for name, (price, per) in self.prices.items():
            if layered:
                lines.append(f'  material of-{name} "#a0b0c0" price {price / 100} per {per} for {name}')
        ends = "tray(width > 8.5', shed none, bay none, body depth > 12.5')", f"tray(width < 8.5', {r.choice(('shed none, bay none', 'bay none'))}, body depth < 12.5')"
        few = f"library few-rows using hut {{ trays 2  require neighbour({', '.join(r.sample(ends, 2))}) }}"
        return "\n".join(lines + ["}", "library rows using hut { trays 1..3 }", "library all from rows in huts { }", few, "library few from few-rows in huts { require option(body storeys 1), option(shed storeys 1) }", ""])


# ---- what a solid is cut into


def wall_of(face):
    return "outside" if face["rel"] == "outside" else "party" if face["kind"] == "party" else "partition"


def stands(face):
    return face["rel"] != "above" and face["kind"] != "open"


def is_along_y(face):
    return face["at"][0] == face["at"][1]


def whole(form, of):
    return form.thick[of] * INCH // 4


def cut_wall(form, face, box):
    """Layers from the side that is outside, or where the first cell is. None: the wall is of one piece."""
    of = wall_of(face)
    if of not in form.layers:
        return None
    low = face["side"] in ("back", "left")  # of the first cell
    return cut(form.layers[of], box, 0 if is_along_y(face) else 2, low if of == "outside" else not low)


def cut(layers, box, axis, from_low):
    at, boxes = (box[axis] if from_low else box[axis + 1]), []
    for name, quarter in layers:
        end = at + quarter * INCH // 4 * (1 if from_low else -1)
        piece = list(box)
        piece[axis], piece[axis + 1] = min(at, end), max(at, end)
        boxes.append((name, piece))
        at = end
    return boxes


def wall_at_post(form, house, solid):
    """The thicker of the walls that end at the middle of the post; of equal ones one along x; of several the first."""
    x0, x1, y0, y1 = solid["box"][:4]
    middle = ((x0 + x1) // 2, (y0 + y1) // 2)
    here = [f for f in house["faces"] if stands(f) and storey_of(house, f) == solid["of"] and middle in ((f["at"][0], f["at"][2]), (f["at"][1], f["at"][3]))]
    fitting = [f for f in here if whole(form, wall_of(f)) == (x1 - x0 if is_along_y(f) else y1 - y0)]
    fitting.sort(key=lambda f: (-whole(form, wall_of(f)), is_along_y(f), f["id"]))
    return fitting[0] if fitting and whole(form, wall_of(fitting[0])) == max(x1 - x0, y1 - y0) else None


def storey_of(house, face):
    return house["cells"][face["a"]]["storey"]


def layers_of(form, house, solid):
    if solid["kind"] in WALLS:
        return cut_wall(form, house["faces"][solid["of"]], solid["box"])
    if solid["kind"] in ("deck", "roofdeck"):
        return cut(form.layers["floor"], solid["box"], 4, False) if "floor" in form.layers else None
    wall = wall_at_post(form, house, solid) if solid["kind"] == "post" else None
    return cut_wall(form, wall, solid["box"]) if wall else None


# ---- the bill


def volume(box):
    return (box[1] - box[0]) * (box[3] - box[2]) * (box[5] - box[4])


def area_of(house, form, solid, box):
    """Upright, along the wall, of what stands; in its plane of what lies."""
    wide, deep, high = box[1] - box[0], box[3] - box[2], box[5] - box[4]
    if solid["kind"] in ("deck", "roofdeck"):
        return wide * deep
    face = house["faces"][solid["of"]] if solid["kind"] in WALLS else wall_at_post(form, house, solid)
    if solid["kind"] == "post" and layers_of(form, house, solid) is None:
        return max(wide, deep) * high
    return (deep if is_along_y(face) else wide) * high


PARTS = {"outside": "wall", "party": "party", "partition": "partition", "post": "post", "deck": "floor", "roofdeck": "floor"}


def bill_of(form, house):
    """part -> [number, area, volume]: of what may have layers."""
    bill, before = collections.defaultdict(lambda: [0, 0, 0]), None
    for solid in house["solids"]:
        if solid["kind"] not in PARTS:
            continue
        new = solid["kind"] not in WALLS or solid["of"] != before
        before = solid["of"] if solid["kind"] in WALLS else None
        for name, box in layers_of(form, house, solid) or [(PARTS[solid["kind"]], solid["box"])]:
            line = bill[name]
            line[0] += new
            line[1] += area_of(house, form, solid, box)
            line[2] += volume(box)
    house_roof_layers.add_to_bill(form, house, bill)
    return bill


UNIT = {"sf": (1, FOOT**2), "cf": (2, FOOT**3), "m2": (1, 10**18), "m3": (2, 10**27), "each": (0, 1)}


def cost_of(form, part, line):
    price, per = form.prices.get(part, (0, "each"))
    which, unit = UNIT[per]
    return F(price, 100) * F(line[which], unit)


def cents(cost):
    return (cost * 200 + 1) // 2


# ---- walls over nothing


def unborne(form, house, face):
    """The longest stretch of a wall, an inch at a time, without a wall as thick or a post below; None: it is borne. Planes are whole inches apart."""
    thick = whole(form, wall_of(face)) if stands(face) else 0
    if thick <= whole(form, "partition") or storey_of(house, face) == 0:
        return None
    k, plane = (2, face["at"][0]) if is_along_y(face) else (0, face["at"][2])
    below = [f for f in house["faces"] if f["rel"] != "above" and storey_of(house, f) + 1 == storey_of(house, face)]
    strong = [f for f in below if stands(f) and whole(form, wall_of(f)) >= thick]
    posts = {point for f in below if f["rel"] == "outside" and f["kind"] == "open" for point in ((f["at"][0], f["at"][2]), (f["at"][1], f["at"][3]))}

    def has(f, point):
        return f["at"][0] <= point[0] <= f["at"][1] and f["at"][2] <= point[1] <= f["at"][3]

    longest = run = 0
    for at in range(face["at"][k], face["at"][k + 1], INCH):
        ends = [(plane, at + d) if k == 2 else (at + d, plane) for d in (0, INCH)]
        borne = any(has(f, ends[0]) and has(f, ends[1]) for f in strong)
        if borne or ends[0] in posts or any(has(f, ends[0]) for f in strong):
            run = 0
        run = 0 if borne else run + 1
        longest = max(longest, run)
    return longest or None


def feet(inches):
    whole_feet, rest = divmod(inches, 12)
    return f"{whole_feet}'" if rest == 0 else f'{rest}"' if whole_feet == 0 else f"{whole_feet}'{rest}\""


def place(house, face):
    cell = house["cells"][face["a"]]
    name = lambda c: f"{c['tray'] + 1}.{c['zone']}.{('low', 'high')[c['storey']]}"
    return f"{name(cell)}, {face['side']}" if face["b"] is None else f"{name(cell)} to {name(house['cells'][face['b']])}"


class Checker:
    def __init__(self, tartan):
        self.tartan, self.failures, self.counted, self.hanging = tartan, [], 0, 0

    def run(self, *words):
        made = subprocess.run([self.tartan, *words], capture_output=True, text=True)
        if made.returncode != 0:
            self.failures.append(f"{' '.join(words)}: {made.stderr}")
        return made.stdout

    def check(self, what, holds):
        if not holds:
            self.failures.append(what)

    def house(self, path, line, folder):
        self.run("house", path, line, "-o", folder + "/h.json", "-o", folder + "/h.parts.csv")
        return json.load(open(folder + "/h.json"))

    def check_solids(self, form, house, where):
        for i, solid in enumerate(house["solids"]):
            want = layers_of(form, house, solid)
            said = [(layer["name"], layer["box"]) for layer in solid["layers"]] if "layers" in solid else None
            self.check(f"{where}: the layers of solid {i} are {said}, not {want}", said == want)
            if want:
                self.check(f"{where}: layers fill solid {i}", sum(volume(b) for _, b in want) == volume(solid["box"]) and all(volume(b) > 0 for _, b in want))

    def check_bill(self, form, house, folder, where):
        want, other = bill_of(form, house), {"door", "sash"}
        parts = {p["part"]: p for p in house["parts"] if p["part"] not in other}
        self.check(f"{where}: the bill has {sorted(parts)}, not {sorted(want)}", set(parts) == set(want))
        rows = {row["part"]: row for row in csv.DictReader(open(folder + "/h.parts.csv"))}
        total = 0
        for name in set(parts) & set(want):
            said = [parts[name]["number"], F(parts[name]["area"]), F(parts[name]["volume"])]
            self.check(f"{where}: of {name} there are {said}, not {want[name]}", said == want[name])
            cost = cents(cost_of(form, name, want[name]))
            total += cost
            self.check(f"{where}: {name} costs {rows[name]['cost']}, not {cost}", name not in form.prices or round(float(rows[name]["cost"]) * 100) == cost)
        self.check(f"{where}: the house costs {house.get('cost')}, not {total}", not form.prices or round(float(house["cost"]) * 100) == total)

    def check_count(self, form, path, folder):
        """Of the houses of one tray, those that cost no more than the one in the middle."""
        if not form.prices or form.roofs["body"].text.startswith("hip") or not 1 < self.count(path, "few") <= 40:
            return
        lines = self.run("enumerate", path, "--library", "few").splitlines()
        costs = []
        for line in lines:
            bill = bill_of(form, self.house(path, line, folder))
            costs.append(sum(cost_of(form, name, bill[name]) for name in bill))
        self.counted += 1
        middle = cents(sorted(costs)[len(costs) // 2]) / 100
        most = F(str(middle))
        with open(path, "a") as out:
            out.write(f"library cheap from few in huts {{ require cost-of-all <= {middle} }}\nmeasure cost-of-all = sum(cost)\n")
        said, want = self.count(path, "cheap"), sum(cost <= most for cost in costs)
        self.check(f"{path}: {said} houses cost at most {middle}, not {want} of {len(costs)}", said == want)

    def count(self, path, library):
        houses = [line for line in self.run("count", path, "--library", library).splitlines() if line.startswith("houses ")]
        return int(houses[0].split()[1]) if houses else 0

    def check_hanging(self, form, house, path, line, where):
        want = [f"{place(house, f)}, along {feet(n)}" for f in house["faces"] for n in [unborne(form, house, f)] if n]
        said = subprocess.run([self.tartan, "house", path, line], capture_output=True, text=True).stderr
        notes = [text.strip() for text in said.split("W217")[1].splitlines() if text.strip().startswith("note: ")] if "W217" in said else []
        notes = [text.removeprefix("note: ") for text in notes]
        more = [f"and {len(want) - 8} more"] if len(want) > 8 else []
        self.check(f"{where}: walls over nothing are {notes}, not {want}", notes == want[:8] + more)
        self.hanging += len(want)
        explained = json.loads(self.run("explain", path, line, "--library", "all", "--json"))
        self.check(f"{where}: they are explained", [w["wall"] for w in explained.get("hanging", [])] == want)

    def check_form(self, seed, folder):
        form, path, plain = Form(seed), f"{folder}/{seed}.plan", f"{folder}/{seed}-plain.plan"
        open(path, "w").write(form.text())
        open(plain, "w").write(form.text(layered=False))
        for line in self.run("sample", path, "3", "--library", "all", "--seed", str(seed)).splitlines():
            house, same = self.house(path, line, folder), None
            where = f"form {seed}, {line}"
            self.check_solids(form, house, where)
            house_roof_layers.check_roofs(form, house, self.check, where)
            self.check_bill(form, house, folder, where)
            self.check_hanging(form, house, path, line, where)
            same = self.house(plain, line, folder)
            self.check(f"{where}: the solids are those without layers", [(s["kind"], s["of"], s["box"]) for s in house["solids"]] == [(s["kind"], s["of"], s["box"]) for s in same["solids"]])
            held = lambda h: {kind: sum(house_prisms.volume_of(p) for p in h["roofs"] if p["kind"] == kind) for kind in ("roof", "gable")}
            self.check(f"{where}: roofs hold as much as those without layers", held(house) == held(same))
        self.check_count(form, path, folder)


def main():
    tartan, first, count = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    checker = Checker(tartan)
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + count):
            checker.check_form(seed, folder)
    if count > 3:
        checker.check("no wall stands over nothing", checker.hanging > 0)
        checker.check("no form had few enough houses to be gone through", checker.counted > 0)
    print("\n".join(checker.failures[:20]) or "fine")
    sys.exit(1 if checker.failures else 0)


main()
