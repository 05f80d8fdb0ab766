#!/usr/bin/env python3
"""Daylight, step-free ways and flights, worked out again from house lines: house_brute.py TARTAN FORMS

Makes so many forms at random, with libraries of all their houses and of those that rules keep. From the numbers of the form alone it stands
up every plan, gives it all functions and faces that it may have, and finds the glazed area of each room, and who can walk where.

It holds against tartan: the list of all houses, in its order, which is brute force too; every rule on every house; the houses that the
rules keep, their number and ranks both ways. A plan seen in a mirror has as many of them: forms treat both sides alike."""
import itertools
import json
import random
import subprocess
import sys
from collections import Counter

tartan, forms = sys.argv[1], int(sys.argv[2])
failures = []
seen = {"houses": 0, "decisions": 0}

OPENINGS = {"gap": (48, 84, 0, "passage"), "hatch": (30, 80, 0, "passage"), "sash": (36, 48, 32, "glazed"), "slot": (24, 18, 60, "glazed"), "shutter": (30, 48, 30, "")}
RULES = ("dim", "far", "level", "climbed", "round", "stepped")


def same(what, got, wanted):
    if got != wanted:
        failures.append(f"{what}: {got}, not {wanted}")


def run(*words, lines=None):
    done = subprocess.run([tartan, *words], input=lines, capture_output=True, text=True)
    return done.stdout if done.returncode == 0 else "failed: " + done.stderr


# ---- a form, in inches


class Form:
    def __init__(self, seed):
        chance = random.Random(seed)
        self.widths = [chance.choice((84, 96)), chance.choice((120, 144))]
        self.deep = chance.choice((120, 156, 180))
        self.wing = chance.choice((60, 72))
        self.high = [108, chance.choice((90, 96))]
        self.wall, self.partition, self.deck = chance.choice((6, 8)), 4, 12
        self.daylight = chance.choice((8, 12, 16, 24))
        self.rise, self.going, self.turn = chance.choice((8, 9)), chance.choice((8, 9, 10)), chance.choice(("", " turn half"))
        self.across = chance.choice((["gap", "hatch"], ["open", "hatch"], ["gap", "wall"], ["hatch"]))
        self.front, self.back = chance.choice((["sash"], ["slot"])), chance.choice((["shutter"], ["slot", "wall"]))
        self.near = chance.choice((0, 4, 40, 90))  # how far hatches between trays are from the front; 0: they are in the middle
        self.outdoor = chance.random() < 0.5  # seats are in the open
        self.shallow = self.deep - chance.choice((24, 36)) if self.outdoor else 0  # a body of which seats beside it stand at the left or right
        self.porch = chance.choice(([], ["gap", "wall"], ["shutter"])) if self.outdoor else []  # between a bed and a seat
        self.text = f'''schema hut {{
  width role length = {" | ".join(f'{w}"' for w in self.widths)}
  zone body role band = room({self.deep}"){f' | cut({self.shallow}")' if self.shallow else ""}
  zone wing role band = empty role absent | porch({self.wing}")
}}
form huts of hut {{
  storey ground {self.high[0]}"
  storey loft {self.high[1]}"
  spine body
  wall {self.wall}" partition {self.partition}" floor {self.deck}" roof 6"
  option body storeys = 1 | 2
  option wing storeys = 1
  function living at cell(body, ground)
  function bed at cell(body)
  function well at cell(body, {self.widths[0]}")
  function seat{" outdoor" if self.outdoor else ""} at cell(wing)
{"".join(f'  opening {n} wide {o[0]}" high {o[1]}" sill {o[2]}" {o[3]}{self.begins(n)}{chr(10)}' for n, o in OPENINGS.items())}
  flight steps wide 30" rise 5"..{self.rise}" going {self.going}"{self.turn}
  face cell(well) under cell(well) = steps | floor
  {f'face cell(bed) beside cell(seat) = {" | ".join(self.porch)}' if self.porch else ""}
  face cell(seat) beside cell(any) = hatch | wall
  face cell(bed) beside cell(bed) = wall
  face cell(living) beside cell(living) = open
  face cell(any) beside cell(any) = {" | ".join(self.across)}
  face cell(any) outside front = {" | ".join(self.front)}
  face cell(any, ground) outside back = {" | ".join(self.back)}
  face cell(any) outside back = sash
}}
library rows using hut {{ trays 1..2 }}
rule dim = room(living or bed, glazing < 1:{self.daylight})
rule far = apart(cell(bed), from cell(living))
rule level = apart(cell(bed or well, ground), from cell(living), by open or gap)
rule climbed = apart(cell(bed, loft), from cell(living), through cell(well or living), by gap or hatch or open or steps)
rule round = apart(cell(seat), from cell(bed), through cell(not living), by hatch)
rule stepped = apart(cell(bed), from cell(living), by step-free)
library all from rows in huts {{ }}
library kept from rows in huts {{ prune dim, level, climbed }}
'''

    def steps_fit(self, storey, x, y):
        """Does the flight fit into a cell between planes so far apart?"""
        risers = -(-self.high[storey] // self.rise)
        if risers < 4 or self.high[storey] < 5 * risers:
            return False
        clear, treads = (x - self.wall, y - self.wall), risers - 1
        for deep, wide in (clear, clear[::-1]):
            if self.turn:  # one tread is the landing; the longer half comes first
                fits = deep >= 2 * 30 + (treads - 1 + 1) // 2 * self.going and wide >= 2 * 30
            else:
                fits = deep >= 2 * 30 + treads * self.going and wide >= 30
            if fits:
                return True
        return False

    def begins(self, kind):
        return f' near front {self.near}"' if kind == "hatch" and self.near else ""

    def fits(self, kind, storey, long, between_trays=False):
        if kind not in OPENINGS:
            return True
        wide, high, sill, _ = OPENINGS[kind]
        ends = self.near + self.wall / 2 if between_trays and self.begins(kind) else self.wall
        return wide + ends <= long and sill + high <= self.high[storey] - self.deck


# ---- a plan that stands up


class Cell:
    def __init__(self, tray, zone, storey, x, y):
        self.tray, self.zone, self.storey, self.x, self.y = tray, zone, storey, x, y
        self.area = (x[1] - x[0]) * (y[1] - y[0])


def rest_of(of, taken):
    left, at = [], of[0]
    for low, high in sorted(taken):
        if low > at:
            left.append((at, low))
        at = max(at, high)
    return left + ([(at, of[1])] if at < of[1] else [])


def stand(form, plan, storeys):
    """The cells, and the faces as (first cell, second or side, length) in the order of house lines."""
    cells, x = [], 0
    for t, (wide, deep, wing) in enumerate(plan):
        for zone, y in (("body", (0, deep)), ("wing", (deep, deep + wing))):
            for storey in range((storeys if zone == "body" else 1) if y[0] < y[1] else 0):
                cells.append(Cell(t, zone, storey, (x, x + wide), y))
        x += wide
    faces = []
    for i, a in enumerate(cells):
        level = [(k, b) for k, b in enumerate(cells) if b.storey == a.storey]
        meet = lambda b: (max(a.y[0], b.y[0]), min(a.y[1], b.y[1]))
        left = [meet(b) for _, b in level if b.tray == a.tray - 1 and meet(b)[0] < meet(b)[1]]
        right = [(meet(b), k) for k, b in level if b.tray == a.tray + 1 and meet(b)[0] < meet(b)[1]]
        wide = a.x[1] - a.x[0]
        faces += [(i, "left", high - low) for low, high in rest_of(a.y, left)]
        if not any(b.tray == a.tray and b.y[1] == a.y[0] for _, b in level):
            faces.append((i, "back", wide))
        front = [k for k, b in level if b.tray == a.tray and b.y[0] == a.y[1]]
        faces.append((i, front[0] if front else "front", wide))
        sides = [(part[0], k, part[1] - part[0]) for part, k in right]
        sides += [(low, "right", high - low) for low, high in rest_of(a.y, [part for part, _ in right])]
        faces += [(i, other, long) for _, other, long in sorted(sides, key=lambda s: s[0])]
        faces += [(i, k, 0) for k, b in enumerate(cells) if (b.tray, b.zone, b.storey) == (a.tray, a.zone, a.storey + 1)]
    return cells, faces


def functions_of(form, cell):
    if cell.zone == "wing":
        return ["seat"]
    return (["living"] if cell.storey == 0 else []) + ["bed"] + (["well"] if cell.x[1] - cell.x[0] == form.widths[0] else [])


def outside(form, storey, side, long, in_y=False):
    if side in ("left", "right"):
        return ["wall"]
    lines = [form.front] if side == "front" else [form.back, ["sash"]] if storey == 0 else [["sash"]]
    fitting = ([k for k in kinds if form.fits(k, storey, long, in_y)] for kinds in lines)
    return next(filter(None, fitting), ["wall"])


def beside_porch(form, cells, functions, face):
    """What may be beside a seat in the open: what is said of both, then what is said of the outside of the other cell."""
    first, other, long = face
    in_y = cells[first].tray != cells[other].tray
    fitting = [k for k in form.porch if form.fits(k, 0, long, in_y)] if {functions[first], functions[other]} == {"bed", "seat"} else []
    inner = sheltered(form, functions, face)
    if fitting or inner is None:
        return fitting or ["open"]
    side = "left" if in_y and inner == other else "right" if in_y else "front"
    return outside(form, 0, side, long, in_y)


def sheltered(form, functions, face):
    """The cell that is not in the open, of a face whose other side is; None: there is none."""
    first, other, _ = face
    if isinstance(other, str):
        return first
    open_ones = [form.outdoor and functions[i] == "seat" for i in (first, other)]
    return other if open_ones == [True, False] else first if open_ones == [False, True] else None


def kinds_of(form, cells, functions, face):
    first, other, long = face
    a, f = cells[first], functions[first]
    if isinstance(other, str):
        return outside(form, a.storey, other, long)
    g = functions[other]
    if form.outdoor and "seat" in (f, g) and cells[other].storey == a.storey:
        return beside_porch(form, cells, functions, face)
    if cells[other].storey > a.storey:
        if f == g == "well":
            return (["steps"] if form.steps_fit(a.storey, a.x[1] - a.x[0], a.y[1] - a.y[0]) else []) + ["floor"]
        return ["floor"]
    lines = [(("seat" in (f, g)), ["hatch", "wall"]), (f == g == "bed", ["wall"]), (f == g == "living", ["open"]), (True, form.across)]
    for applies, kinds in lines:
        fitting = [k for k in kinds if form.fits(k, a.storey, long, a.tray != cells[other].tray)] if applies else []
        if fitting:
            return fitting
    return ["wall"]


# ---- rules


def glazed(kind):
    return OPENINGS[kind][0] * OPENINGS[kind][1] if kind in OPENINGS and OPENINGS[kind][3] == "glazed" else 0


def is_dim(form, cells, functions, faces, kinds):
    room = list(range(len(cells)))
    for (first, other, _), kind in zip(faces, kinds):
        if kind == "open" and functions[first] == functions[other]:
            room = [room[first] if r == room[other] else r for r in room]
    for r in set(room):
        inside = [i for i in range(len(cells)) if room[i] == r]
        light = sum(glazed(kind) for face, kind in zip(faces, kinds) if sheltered(form, functions, face) in inside)
        if functions[inside[0]] in ("living", "bed") and light * form.daylight < sum(cells[i].area for i in inside):
            return True
    return False


def is_apart(count, faces, kinds, source, goal, through, steps):
    """Is there a source from which no walk leads to a goal?"""
    ways = [set() for _ in range(count)]
    for (first, other, _), kind in zip(faces, kinds):
        if not isinstance(other, str) and kind in steps:
            ways[first].add(other)
            ways[other].add(first)
    for start in filter(source, range(count)):
        reached, waiting = {start}, [start]
        while waiting:
            at = waiting.pop()
            if at == start or through(at):
                waiting += ways[at] - reached
                reached |= ways[at]
        if not any(map(goal, reached)):
            return True
    return False


def decide(form, cells, functions, faces, kinds):
    of = lambda *names: lambda i: functions[i] in names
    apart = lambda *asked: is_apart(len(cells), faces, kinds, *asked)
    anywhere = lambda i: True
    ground = lambda i: functions[i] in ("bed", "well") and cells[i].storey == 0
    above = lambda i: functions[i] == "bed" and cells[i].storey == 1
    return (
        is_dim(form, cells, functions, faces, kinds),
        apart(of("bed"), of("living"), anywhere, {"open", "gap", "hatch", "steps"}),
        apart(ground, of("living"), anywhere, {"open", "gap"}),
        apart(above, of("living"), of("well", "living"), {"gap", "hatch", "open", "steps"}),
        apart(of("seat"), of("bed"), lambda i: functions[i] != "living", {"hatch"}),
        apart(of("bed"), of("living"), anywhere, {"open", "gap", "hatch"}),
    )


# ---- all houses of a form


def read_plan(line):
    inches = lambda text: sum(int(n) * (12 if mark == "'" else 1) for n, mark in split_length(text))
    trays = []
    for tray in line.split("|"):
        width, body, wing = tray.split()
        trays.append((inches(width), inches(body.split(":")[1]), inches(wing.split(":")[1]) if ":" in wing else 0))
    return trays


def split_length(text):
    found, digits = [], ""
    for c in text:
        if c.isdigit():
            digits += c
        elif c in "'\"":
            found.append((digits, c))
            digits = ""
    return found


def by_tray(cells, functions):
    rows = itertools.groupby(zip(cells, functions), key=lambda pair: pair[0].tray)
    return " | ".join(" ".join(f for _, f in row) for _, row in rows)


def houses_on(form, line):
    """House lines, and what the rules say of each."""
    plan = read_plan(line)
    for storeys in (1, 2):
        cells, faces = stand(form, plan, storeys)
        for functions in itertools.product(*(functions_of(form, c) for c in cells)):
            kinds = [kinds_of(form, cells, functions, face) for face in faces]
            for chosen in itertools.product(*kinds):
                text = " ".join(k for k, of in zip(chosen, kinds) if len(of) > 1) or "-"
                yield f"{line} ; {storeys} 1 ; {by_tray(cells, functions)} ; {text} ; -", (functions, cells, faces, chosen)


def check(seed):
    form = Form(seed)
    path = f"form-{seed}.plan"
    with open(path, "w") as file:
        file.write(form.text)
    listed = run("enumerate", path, "--library", "all").splitlines()
    plans = run("enumerate", path, "--library", "rows").splitlines()
    lines, decisions = [], []
    for plan in plans:
        memo = {}
        for line, (functions, cells, faces, chosen) in houses_on(form, plan):
            key = (len(cells), functions, chosen)
            if key not in memo:
                memo[key] = decide(form, cells, functions, faces, chosen)
            lines.append(line)
            decisions.append(memo[key])
    same(f"form {seed}: number of houses", len(listed), len(lines))
    for n, (mine, theirs) in enumerate(zip(lines, listed)):
        if mine != theirs:
            same(f"form {seed}: house {n}", theirs, mine)
            break
    rows = run("match", path, "-", "--format", "bits", *(w for r in RULES for w in ("--rule", r)), lines="\n".join(lines) + "\n").splitlines()
    wanted = ["".join("01"[d] for d in decision) for decision in decisions]
    for line, row, bits in zip(lines, rows, wanted):
        if row != bits:
            same(f"form {seed}: {line}: {' '.join(RULES)}", row, bits)
            break
    same(f"form {seed}: decisions", len(rows), len(wanted))
    kept = [line for line, (dim, _, level, climbed, _, _) in zip(lines, decisions) if not (dim or level or climbed)]
    same(f"form {seed}: houses that are kept", run("enumerate", path, "--library", "kept").splitlines(), kept)
    counted = json.loads(run("count", path, "--library", "kept", "--json"))
    same(f"form {seed}: count", counted["houses"], str(len(kept)))
    on_plan = Counter(line.split(" ; ")[0] for line in kept)
    for plan, number in on_plan.items():
        same(f"form {seed}: houses on {plan}, and in a mirror", on_plan[" | ".join(plan.split(" | ")[::-1])], number)
    for rank in {0, len(kept) // 2, len(kept) - 1} - {-1} if kept else ():
        house = run("unrank", path, str(rank), "--library", "kept").strip()
        same(f"form {seed}: house {rank}", house, kept[rank])
        same(f"form {seed}: its rank", run("rank", path, house, "--of-all", "--library", "kept").strip(), f"#{rank}")
    seen["houses"] += len(lines)
    seen["decisions"] += len(RULES) * len(lines)
    return [tuple(any(d[i] for d in decisions) for i in range(len(RULES))), tuple(all(d[i] for d in decisions) for i in range(len(RULES)))]


def main():
    extremes = [check(seed) for seed in range(1, forms + 1)]
    for i, rule in enumerate(RULES):
        same(f"{rule} matches some house of some form, and not all", any(some[i] and not every[i] for some, every in extremes), True)
    print(f"{seen['houses']} houses of {forms} forms, {seen['decisions']} decisions, {len(failures)} differ")
    print("\n".join(f[:600] for f in failures[:6]))
    sys.exit(bool(failures))


main()
