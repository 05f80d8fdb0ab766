#!/usr/bin/env python3
"""Houses of forms that ask for ways, against an independent slow model: house_ways.py TARTAN MODEL.py FIRST COUNT

Makes so many forms at random, each once with its ways and once without them, with stairs that take their cells in the place of flights. All
houses of the form without ways are gone through; the model says of each whether people can go about in it, by its cells and faces. Those of
which it says so are the houses of the form with ways: in their order, by their number, by their ranks both ways, on all plans and on one.

What the model is told is found here from the form alone: into which cell a door opens, where an opening begins, and whether a flight has room
by its size. Whether a way leads from one cell to another is no matter of forms, so what the model says of that is passed over."""
import importlib.util
import json
import os
import random
import re
import subprocess
import sys
import tempfile

INCH = 25400000
HOUSES = 400  # of a form without ways: a form with more is made smaller


def load(path):
    spec = importlib.util.spec_from_file_location("model", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    read = module.text_of
    module.text_of = lambda *of: re.sub(r"^( *)floor (?=\d)", r"\1deck ", read(*of), flags=re.M)  # it knows the word of before
    return module


def inches(n):
    return f'{n}"'


class Form:
    """A hall that is bare, a room and a bath with tiles, a stair; in inches. The faces are lines (first, relation, second, kinds)."""

    def __init__(self, seed):
        r = self.chance = random.Random(seed)
        self.storeys = r.choice((1, 2, 2, 3))
        self.widths = r.sample((72, 84, 96, 120, 144), 2)
        self.deep, self.wing = r.choice((84, 96, 120, 144, 168)), r.choice((0, 48, 60, 72))
        self.wall, self.partition, self.deck = r.choice((6, 8)), r.choice((2, 4)), 10
        self.high = r.choice((84, 96, 108))
        self.way, self.headroom = r.choice((24, 28, 32, 36)), r.choice((72, 78, 80))
        self.narrow = r.choice((0, 20, 24))  # the way of baths and rooms
        self.openings = {}
        for name, wide in (("door", r.choice((30, 32, 36, 50))), ("gap", r.choice((36, 44))), ("slide", 34)):
            near = {}
            if r.random() < 0.5:
                near[r.choice(("back", "front"))] = r.choice((4, 6, 18))
            if r.random() < 0.5:
                near[r.choice(("left", "right"))] = r.choice((4, 6, 18))
            self.openings[name] = (max(wide, self.way), near, {"door": "passage", "gap": "passage leafless", "slide": "passage sliding"}[name])
        self.openings["pane"] = (30, {}, "glazed sill 30\"")
        turn = r.choice(("", " turn half", " turn half", " turn quarter", " turn half winders 2", " turn half winders 3", " turn quarter winders 2", " turn quarter winders 3", " turn spiral"))
        self.flight = f'wide {inches(max(r.choice((28, 32, 36)), self.way) * (2 if "spiral" in turn else 1))} rise 6"..{r.choice((8, 9))}" going {inches(r.choice((8, 9, 10)))}{turn}'
        between = [["door"], ["gap"], ["slide"], ["open"], ["open", "door"], ["wall", "door"]]
        self.lines = [("stair", "beside", "hall", r.choice((["open"], ["open", "door"], ["gap"]))),
                      ("hall", "beside", "any", r.choice(between)), ("room", "along", "room", r.choice(between)),
                      ("room", "beside", "bath or room", r.choice(between)), ("any", "beside", "any", r.choice(between))]
        if r.random() < 0.5:
            self.lines = [(b, kind, a, k) if kind == "beside" else (a, kind, b, k) for a, kind, b, k in self.lines]
        self.front = r.choice((["pane"], ["door"], ["door", "wall"], ["open"]))
        self.many = r.random() < 0.3
        self.porch = bool(self.wing) and r.random() < 0.4  # a wing may be a terrace, which is in the open
        if self.porch:
            self.lines.insert(0, ("hall", "beside", "terrace", r.choice(between)))

    def text(self, ways):
        r = random.Random(repr(self.widths) + self.flight)
        wing = f"{inches(self.wing)}" if self.wing else ""
        items = r.choice((('item bed left 6"..48", back 0..78", up 0..20"', 'keep side left 50"..70", back 0..60"'),
                          ('item table left 30"..right 30", back 20"..front 30", up 0..30"',),
                          ('item shelf left 0..right 0, back 0..14", up 75"..76"', 'item desk left 0..40", back 20"..44", up 0..30"')))
        bath = r.choice((('item tub left 0..30", back 0..60"', 'item basin right 20"..right 0, front 16"..front 0'),
                         ('item tub left 0..26", back 0..40"', 'keep before left 26"..46", back 10"..30"')))
        lines = [f"schema hut {{ width role length = {' | '.join(map(inches, self.widths))}",
                 f'  zone body role band = space({inches(self.deep)}) zone wing role band = none role absent{f" | porch({wing})" if wing else ""} }}',
                 "form huts of hut {", *(f"  storey s{k} {inches(self.high)}" for k in range(self.storeys)), "  spine body",
                 f"  wall {inches(self.wall)}", f"  partition {inches(self.partition)}", f"  floor {inches(self.deck)}", '  roof 6"',
                 f"  option wing storeys = 1" if wing else ""]
        first = 's0' if self.storeys > 1 else 'body'
        lines += ["  function hall at cell(body) or cell(wing)" if not self.many else f"  function hall at cell(body, {first}) or cell(wing)",
                  f"  function room at cell(body, {inches(self.widths[0])})", "  function bath at cell(body, s0)" if self.storeys == 1 else "  function bath at cell(wing)"]
        if self.porch:
            lines.append("  function terrace outdoor at cell(wing)")
        if self.storeys > 1:
            lines.append(f"  function stair at cell(body, {inches(self.widths[1])})")
        for name, (wide, near, words) in self.openings.items():
            lines.append(f"  opening {name} wide {inches(wide)} high {'40' if name == 'pane' else '70'}\" {words}" + "".join(f" near {side} {inches(n)}" for side, n in near.items()))
        if ways:
            lines += [f"  way {inches(self.way)}", f"  headroom {inches(self.headroom)}"] + ([f"  way {inches(self.narrow)} for bath, room"] if self.narrow else [])
        if self.storeys > 1:
            lines += [f"  flight steps {self.flight}"] if ways else []
            lines.append(f"  face cell(stair) under cell(stair) = {'steps' if ways else 'stair'}")
        lines += [f"  face cell({a}) {kind} cell({b}) = {' | '.join(kinds)}" for a, kind, b, kinds in self.lines if self.storeys > 1 or "stair" not in (a, b)]
        lines += [f"  face cell(any) outside front = {' | '.join(self.front)}", "  face cell(any) outside = pane",
                  "  tile furniture for room {", *("    " + item for item in items), "  }",
                  "  tile bath-things for bath {", *("    " + item for item in bath), "  }", "}",
                  f"library rows using hut {{ trays 1..{2 if self.storeys < 3 else 1} }}", "library all from rows in huts { }"]
        return "\n".join(lines) + "\n"

    def begins(self, kind, at):
        """From where to where an opening is along its face, or None."""
        if kind not in self.openings:
            return None
        wide, near, _ = self.openings[kind]
        in_y = at[0] == at[1]
        low, high = at[2:] if in_y else at[:2]
        for side, n in near.items():
            if (side in ("back", "front")) == in_y:
                return [low + n * INCH, low + (n + wide) * INCH] if side in ("back", "left") else [high - (n + wide) * INCH, high - n * INCH]
        middle = (low + high - wide * INCH) // 2
        return [middle, middle + wide * INCH]

    def leaf(self, face, functions):
        """The cell that a door opens into: the one that its line names first."""
        if face["kind"] != "door":
            return None
        if face["rel"] == "outside":
            return face["a"]
        a, b = functions[face["a"]], functions[face["b"]]
        open_ones = [f == "terrace" for f in (a, b)]
        side_by_side = face["side"] in ("left", "right")
        for first, kind, second, kinds in self.lines:
            meets = lambda one, other: (first == "any" or one in first.split(" or ")) and (second == "any" or other in second.split(" or "))
            if any(open_ones) and "any" in (first, second):
                continue
            if kind == "along" and not side_by_side or not (meets(a, b) or kind == "beside" and meets(b, a)):
                continue
            if any(self.has_room(k, face) for k in kinds):
                return face["a"] if meets(a, b) else face["b"]
        return face["b"] if open_ones == [True, False] else face["a"]  # beside a terrace an outside line decides: inwards

    def has_room(self, kind, face):
        if kind not in self.openings:
            return True
        at = face["at"]
        in_y = at[0] == at[1]
        long = (at[3] - at[2] if in_y else at[1] - at[0])
        wide, near, _ = self.openings[kind]
        ends = [n for side, n in near.items() if (side in ("back", "front")) == in_y]
        return wide * INCH + (ends[0] * INCH if ends else self.wall * INCH // 2) + self.wall * INCH // 2 <= long

    def climbs(self, model, at):
        """Has the flight room by its size?"""
        x, y = at[1] - at[0], at[3] - at[2]
        flight = model.flight_of(self.flight)
        for deep, wide in ((x, y), (y, x)):
            shape = model.shape(flight, self.high * INCH, self.deck * INCH, self.headroom * INCH, deep)
            if shape and shape["L"] <= deep and shape["W"] <= wide:
                return True
        return False


def run(*words, lines=None):
    done = subprocess.run([tartan, *words], input=lines, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(" ".join(words)[:200] + "\n" + f"exit {done.returncode}: " + done.stderr[:2000])
    return done.stdout


def houses_of(path, *words):
    return run("enumerate", path, "--library", "all", "--limit", str(HOUSES + 1), *words).splitlines()


def tell(form, model, house):
    """Adds to the house what the form says."""
    functions = {cell["id"]: cell["function"] for cell in house["cells"]}
    for face in house["faces"]:
        if face["rel"] == "above":
            face["kind"] = face["kind"] if face["kind"] != "stair" or form.climbs(model, face["at"]) else "floor"
            continue
        at = form.begins(face["kind"], face["at"])
        if at:
            face["opening"] = at
        leaf = form.leaf(face, functions)
        if leaf is not None:
            face["leaf"] = leaf
    return house


def livable(form, model, asked, plain, line, scratch):
    out = os.path.join(scratch, "house.json")
    run("house", plain, line, "-o", out)
    with open(out) as file:
        house = tell(form, model, json.load(file))
    faults = model.house(asked, house, [model.flight_of(form.flight)])
    return not [fault for fault in faults if fault[1] != "no way leads to it"], faults


def places_of(model, asked, path, line, scratch):
    """What is said of the house of the form with ways: its faults, and where its flights stand, as it says and as the model has it."""
    out = os.path.join(scratch, "house.json")
    run("house", path, line, "-o", out, "-o", os.path.join(scratch, "house.ifc"))
    with open(out) as file:
        house = json.load(file)
    found, places = [], model.places

    def recorded(*words):
        found.append(None)
        at = len(found) - 1
        for place in places(*words):
            found[at] = [list(place["place"]["foot"]), list(place["place"]["head"])]
            yield place

    model.places = recorded
    faults = model.house(asked, house)
    model.places = places
    own = [[face["foot"], face["head"]] for face in house["faces"] if "foot" in face]
    return [fault for fault in faults if fault[1] != "no way leads to it"], own, found


def check(seed, scratch):
    form = Form(seed)
    plain, ways = (os.path.join(scratch, name) for name in ("plain.plan", "ways.plan"))
    for path, asked in ((plain, False), (ways, True)):
        with open(path, "w") as file:
            file.write(form.text(asked))
    all_houses = houses_of(plain)
    if len(all_houses) > HOUSES:
        return None
    asked = model.form_of(ways)
    asked["headroom"] = form.headroom * INCH
    wanted = [line for line in all_houses if livable(form, model, asked, plain, line, scratch)[0]]
    got = houses_of(ways)
    if got != wanted:
        odd = next((line for line in all_houses if (line in got) != (line in wanted)), "in another order")
        return len(all_houses), f"form {seed}: {len(got)} houses, not {len(wanted)}; the first that differs: {odd}"
    flights = 0
    counted = run("count", ways, "--library", "all")
    if f"houses {len(wanted)}" not in " ".join(counted.split()):
        return len(all_houses), f"form {seed}: counted otherwise than {len(wanted)}:\n{counted}"
    if wanted:
        for k in (0, len(wanted) // 2, len(wanted) - 1):
            rank, line = run("rank", ways, "--library", "all", "--of-all", wanted[k]).strip(), run("unrank", ways, str(k), "--library", "all").strip()
            if (rank, line) != (f"#{k}", wanted[k]):
                return len(all_houses), f"form {seed}: the house {k} has rank {rank}, and of that rank is {line}"
        for line in wanted[:: max(1, len(wanted) // 4)]:
            faults, own, found = places_of(model, asked, ways, line, scratch)
            if faults or form.storeys == 2 and own != found:
                return len(all_houses), f"form {seed}: {line}: {faults}; flights at {own}, not {found}"
            flights += len(own)
    return len(all_houses), None, len(wanted), flights


def main():
    global tartan, model
    tartan, model, first, count = sys.argv[1], load(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    seen, kept, climbed, forms, bad, seed = 0, 0, 0, 0, 0, first
    with tempfile.TemporaryDirectory() as scratch:
        while forms < count:
            found = check(seed, scratch)
            seed += 1
            if found is None:
                continue
            forms, seen = forms + 1, seen + found[0]
            if found[1]:
                bad += 1
                print(found[1])
            else:
                kept, climbed = kept + found[2], climbed + found[3]
    print(seen, "houses of", forms, "forms,", kept, "livable,", climbed, "flights,", bad, "differ")
    sys.exit(bad > 0 or not 0 < kept < seen or climbed == 0)


if __name__ == "__main__":
    main()
