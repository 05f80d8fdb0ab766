#!/usr/bin/env python3
"""Nobody falls in houses that ask for ways: house_guards.py TARTAN SOLIDS.py FIRST COUNT

Draws houses of forms that are made at random, and looks at their solids alone. From wherever a person may stand on a floor above the lowest
storey, one walks on over decks, not through walls and guards, and never steps over an edge from which one falls deeper than 600 mm; but for an
edge less than 100 mm in front of a wall. Guards stand on no floor of a room, and lie along edges that one could fall from. All solids of these
houses are apart, and their mesh is closed and has their volume (house_solids.py)."""
import json
import os
import random
import subprocess
import sys
import tempfile
from fractions import Fraction as F

MM = 1000000
DROP, GAP = 600 * MM, 100 * MM


class Form:
    def __init__(self, seed):
        r = random.Random(seed)
        self.storeys = r.choice((2, 2, 3))
        self.high = r.choice((2400, 2600, 2800))
        self.guard = r.choice((900, 1000, 1100))
        self.deck = r.choice((200, 260))
        wall, partition = r.choice((200, 280, 360)), r.choice((80, 110, 140))
        widths = r.sample((2400, 3000, 3600, 4200), 2)
        deep, wing, more = r.choice((3600, 4200, 5400)), r.choice((1800, 3000)), r.choice((0, 0, 2400))
        flights = [f"wide {r.choice((1600, 1700) if 'spiral' in turn else (800, 900))}mm rise 140mm..{r.choice((190, 220))}mm "
                   f"{'' if 'spiral' in turn else f'going {r.choice((200, 240, 260))}mm'}{turn}" for turn in r.sample(TURNS, 2)]
        between = lambda: " | ".join(r.choice((["open"], ["door"], ["open", "door"], ["wall", "open"], ["slide", "wall"])))
        front = r.choice(("open", "door", "open | door", "window", "slide | open"))
        lines = ["schema hut { width role length = " + " | ".join(f"{w}mm" for w in widths),
                 f"  zone body role band = space({deep}mm) | deep({deep + 600}mm)",
                 f"  zone wing role band = none role absent | porch({wing}mm)" + (f" | bay({more}mm)" if more else "") + " }",
                 "form huts of hut {", *(f"  storey s{k} {self.high}mm" for k in range(self.storeys)), "  spine body", f"  wall {wall}mm",
                 f"  partition {partition}mm", f"  floor {self.deck}mm", "  roof 150mm", f"  way {r.choice((500, 600, 700))}mm", f"  guard {self.guard}mm",
                 f"  headroom {r.choice((1900, 2000, 2100))}mm"]
        top = f"s{self.storeys - 1}"
        if r.random() < .7:
            lines.append(f"  void cell(wing, {r.choice(('s1', top))})" + (f" and cell({widths[0]}mm)" if r.random() < .5 else ""))
        if r.random() < .4:
            lines.append(f"  void cell(body, s1) and cell({widths[0]}mm)")
        if r.random() < .4:
            lines.append(f"  no cell(wing, {top}) and cell({widths[1]}mm)")
        lines += [f"  function stair at cell(body, {widths[1]}mm)", f"  function hall at cell(any) and not cell(body, {widths[1]}mm)",
                  "  opening door wide 800mm high 2m passage", "  opening slide wide 900mm high 2m passage sliding", "  opening window wide 1m high 1m sill 900mm glazed",
                  "  opening hatch wide 400mm high 1.8m passage leafless near back 200mm",
                  *(f"  flight steps{i} {flight}" for i, flight in enumerate(flights)), "  face cell(stair) under cell(stair) = steps0 | steps1",
                  f"  face cell(hall) across cell(stair) = {between()}", f"  face cell(stair) along cell(hall) = {between()}",
                  f"  face cell(stair) along cell(stair) = {r.choice(('wall', 'hatch', 'door', 'open'))}", f"  face cell(hall) along cell(stair) = {between()}",
                  f"  face cell(any) beside cell(any) = {between()}", f"  face cell(hall) outside front = {front}",
                  f"  face cell(any) outside left = {r.choice(('wall', 'window', 'door', 'open'))}", f"  face cell(any) outside = {r.choice(('wall', 'window', 'hatch'))}", "}",
                  "library rows using hut { trays 1..2 }", "library all from rows in huts { }"]
        self.text = "\n".join(lines) + "\n"


def run(*words):
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(" ".join(words)[:300] + f"\nexit {done.returncode}: " + done.stderr[:2000])
    return done.stdout


class Storey:
    """A storey as a grid cut by all edges of what matters there: where one stands, what stops one, how deep it goes down."""

    def __init__(self, house, level, clear):
        self.solids = [(s["box"], s["kind"]) for s in house["solids"]]
        self.solids += [(around(prism), prism["kind"]) for prism in house["roofs"] + house.get("wedges", [])]
        self.level = level
        stops = [b for b, kind in self.solids if b[4] < level + clear and b[5] > level + MM]
        panes = [pane_of(house, f) for f in house["faces"] if f["kind"] == "window"]
        panes = [b for b in panes if b[4] == level]
        boxes = [b for b, _ in self.solids] + panes
        self.xs = sorted({v for b in boxes for v in b[:2]} | {min(b[0] for b in boxes) - GAP, max(b[1] for b in boxes) + GAP})
        self.ys = sorted({v for b in boxes for v in b[2:4]} | {min(b[2] for b in boxes) - GAP, max(b[3] for b in boxes) + GAP})
        self.col, self.row = ({v: i for i, v in enumerate(vs)} for vs in (self.xs, self.ys))
        wide, deep = len(self.xs) - 1, len(self.ys) - 1
        self.top = [[-10**12] * deep for _ in range(wide)]    # of what lies at the floor or below
        self.stop = [[None] * deep for _ in range(wide)]
        for box, kind in self.solids:
            if box[5] <= level:
                for i, j in self.cover(box):
                    self.top[i][j] = max(self.top[i][j], box[5])
        for box, kind in [(b, kind) for b, kind in self.solids if b in stops] + [(b, "pane") for b in panes]:
            for i, j in self.cover(box):
                self.stop[i][j] = kind
        self.wide, self.deep = wide, deep

    def cover(self, box):
        return ((i, j) for i in range(self.col[box[0]], self.col[box[1]]) for j in range(self.row[box[2]], self.row[box[3]]))

    def stands(self, i, j):
        return self.top[i][j] == self.level and self.stop[i][j] is None

    def reach(self, rooms):
        todo = []
        for room in rooms:
            todo += [(i, j) for i in range(self.wide) for j in range(self.deep) if self.stands(i, j) and
                     room[0] <= self.xs[i] and self.xs[i + 1] <= room[1] and room[2] <= self.ys[j] and self.ys[j + 1] <= room[3]]
        seen = set(todo)
        while todo:
            i, j = todo.pop()
            for di, dj in ((1, 0), (-1, 0), (0, 1), (0, -1)):
                k, l = i + di, j + dj
                if 0 <= k < self.wide and 0 <= l < self.deep and (k, l) not in seen and self.stands(k, l):
                    seen.add((k, l))
                    todo.append((k, l))
        return seen

    def is_ledge(self, i, j, di, dj):
        """Is a wall behind, nearer than 100 mm to the edge?"""
        edge = (self.xs[i + (di > 0)] if di else self.ys[j + (dj > 0)])
        while 0 <= i < self.wide and 0 <= j < self.deep:
            if self.stop[i][j] not in (None, "guard"):
                near = (self.xs[i + 1] if di > 0 else self.xs[i]) if di else (self.ys[j + 1] if dj > 0 else self.ys[j])
                return abs(edge - near) < GAP
            i, j = i - di, j - dj
        return False


def around(prism):
    """Of a wedge, what a box around it has: one falls at least so deep onto it as from its top."""
    x, y, low, high = ([F(corner[k]) for corner in prism["corners"]] for k in range(4))
    return [int(v) for v in (min(x), max(x), min(y), max(y), min(low), max(high))]


def pane_of(house, face):
    level = next(c for c in house["cells"] if c["id"] == face["a"])["level"]
    at = face["at"]
    return [at[0] - (at[0] == at[1]) * MM, at[1] + (at[0] == at[1]) * MM, at[2] - (at[2] == at[3]) * MM, at[3] + (at[2] == at[3]) * MM, level, level]


def faults_of(form, house):
    faults, counts = [], [0, 0]
    voids = {f["b"] for f in house["faces"] if f["rel"] == "above" and f["kind"] == "open"}
    for cell in house["cells"]:
        cell["level"] = cell["storey"] * form.high * MM
    for storey in range(1, form.storeys):
        cells = [c for c in house["cells"] if c["storey"] == storey]
        rooms = [c["inner"] for c in cells if c["function"] not in (None, "void") and c["id"] not in voids]
        if not cells:
            continue
        s = Storey(house, storey * form.high * MM, (form.high - form.deck) * MM)
        for i, j in s.reach(rooms):
            for di, dj in ((1, 0), (-1, 0), (0, 1), (0, -1)):
                k, l = i + di, j + dj
                if s.stop[k][l] == "guard":
                    counts[0] += 1
                if s.stop[k][l] is not None or s.top[k][l] >= s.level - DROP:
                    continue
                counts[1] += 1
                if not s.is_ledge(i, j, di, dj):
                    faults.append(f"storey {storey}: one falls {(s.level - s.top[k][l]) / MM} mm from {[v / MM for v in (s.xs[i], s.xs[i + 1], s.ys[j], s.ys[j + 1])]}, by ({di}, {dj})")
        for box, kind in s.solids:
            if kind != "guard" or box[4] < s.level or box[4] >= s.level + form.high * MM:
                continue
            if box[5] - box[4] > form.guard * MM or box[4] != s.level:
                faults.append(f"a guard from {box[4] / MM} to {box[5] / MM}")
            if any(room[0] < box[1] and box[0] < room[1] and room[2] < box[3] and box[2] < room[3] and s.top[i][j] == s.level for room in rooms for i, j in s.cover(box)):
                faults.append(f"a guard on the floor at {[v / MM for v in box]}")
    return faults, counts


TURNS = ("", " turn half", " turn quarter", " turn half winders 2", " turn half winders 3", " turn quarter winders 2", " turn quarter winders 3", " turn spiral")
tartan, solids, first, count = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
bad, houses, guarded, forms, kinds = 0, 0, 0, 0, {}
with tempfile.TemporaryDirectory() as scratch:
    path = os.path.join(scratch, "form.plan")
    for seed in range(first, first + count):
        form = Form(seed)
        with open(path, "w") as file:
            file.write(form.text)
        done = subprocess.run([tartan, "sample", path, "4", "--library", "all", "--seed", str(seed)], capture_output=True, text=True)
        if done.returncode != 0:
            if "no houses" in done.stderr or "keeps no" in done.stderr:
                continue
            raise RuntimeError(done.stderr[:2000])
        forms += 1
        for line in sorted(set(done.stdout.splitlines())):
            run(tartan, "house", path, line, *(word for name in ("json", "parts.csv", "obj") for word in ("-o", os.path.join(scratch, "house." + name))))
            with open(os.path.join(scratch, "house.json")) as file:
                house = json.load(file)
            faults, counts = faults_of(form, house)
            said = run(sys.executable, "-B", solids, scratch).strip()
            faults += [] if said == "fine" else [said]
            houses, guarded = houses + 1, guarded + counts[0]
            for s in house["solids"]:
                if s["kind"] == "guard":
                    face = house["faces"][s["of"]]
                    kind = face["rel"] if face["rel"] in ("above", "outside") else "beside"
                    kinds[kind, face["kind"] == "open"] = kinds.get((kind, face["kind"] == "open"), 0) + 1
            if faults:
                bad += 1
                print(f"form {seed}: {line}\n  " + "\n  ".join(faults[:5]))
print(houses, "houses of", forms, "forms,", guarded, "edges with a guard,", bad, "bad;", *(f"{n} {kind}{' open' if open_ else ''}" for (kind, open_), n in sorted(kinds.items())))
sys.exit(bad > 0 or len(kinds) < 5)
