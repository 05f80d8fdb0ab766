#!/usr/bin/env python3
"""Beams under upper walls that nothing as thick bears, against an independent slow search: house_beams.py TARTAN FIRST COUNT

Makes so many forms at random with lines `beam`, and houses of each. From the cells and faces alone it is worked out here, an inch at a time, where
upper walls have no wall as thick and no post below, and which beam is the first that spans that and leaves openings room: those are the beams of the
house, and what is left is what W217 tells. The solids are those of the form without beams, but for what beams take their place of; they are apart,
and house_files.py holds the bill and the IFC file to them. Costs of all houses together are refused (E1685)."""
import json
import os
import random
import subprocess
import sys
import tempfile

INCH = 25400000
WALLS = ("outside", "party", "partition")


class Form:
    def __init__(self, seed):
        r = self.chance = random.Random(seed)
        self.wall, self.partition, self.deck = 2 * r.randint(3, 6), 2 * r.randint(1, 3), r.randint(6, 12)
        self.storey = 12 * r.randint(8, 10)
        self.beams = [(f"beam-{i}", 2 * r.randint(self.partition // 2, self.wall // 2), r.randint(3, 20), r.randint(60, 240)) for i in range(r.randint(1, 3))]
        self.openings = {"door": (0, 12 * r.randint(6, 7)), "sash": (24, 36)}

    def text(self, beams=True):
        r = random.Random(repr(self.beams))
        kinds = [r.choice(("wall | party", "party | open", "door | wall", "door | party | open", "open | sash")) for _ in range(2)]
        lines = [f"schema hut {{ width role length = {r.randint(6, 8)}' | {r.randint(9, 13)}'",
                 f"  zone shed role band = none role absent | space({r.randint(5, 7)}')", f"  zone body role band = space({r.randint(8, 12)}', {r.randint(14, 16)}')",
                 "  zone bay role band = none role absent | space(5') }", "form huts of hut {", f'  storey low {self.storey}"', "  storey high 8'", "  spine body",
                 f'  wall {self.wall}"', f'  partition {self.partition}"', f'  floor {self.deck}"', '  roof 6"']
        lines += [f'  beam {name} wide {wide}" high {high}" span {span}"' for name, wide, high, span in self.beams] if beams else []
        lines += ["  option body storeys = 2", "  option shed storeys = 1 | 2", "  option bay storeys = 1", "  allow W220",
                  "  function hall at cell(any)", f'  opening door wide 3\' high {self.openings["door"][1]}" passage', "  opening sash wide 2' high 3' sill 2'",
                  f"  face cell(hall) along cell(hall) = {kinds[0]}", f"  face cell(hall) across cell(hall) = {kinds[1]}",
                  f"  face cell(bay) outside = {r.choice(('open', 'sash'))}", "  face cell(any) outside back = sash | wall", "  face cell(any) outside = wall",
                  '  material steel "#405060" price 7 per cf for ' + self.beams[0][0] if beams else "", '  material brick "#a05040" price 2 per cf for wall, post',
                  "}", "library rows using hut { trays 1..3 }", "measure cost-of-all = sum(cost)", "library all from rows in huts { }", ""]
        return "\n".join(lines)


# ---- where walls are not borne


class House:
    def __init__(self, form, made):
        self.form, self.made = form, made
        self.faces = [f for f in made["faces"] if f["rel"] != "above"]

    def storey(self, face):
        return self.made["cells"][face["a"]]["storey"]

    def thick(self, face):
        if face["kind"] == "open":
            return 0
        return self.form.wall if face["rel"] == "outside" or face["kind"] == "party" else self.form.partition

    def has(self, face, point):
        return face["at"][0] <= point[0] <= face["at"][1] and face["at"][2] <= point[1] <= face["at"][3]

    def ends(self, face):
        return (face["at"][0], face["at"][2]), (face["at"][1], face["at"][3])

    def is_held(self, point):
        """A place of the lower storey where a wall as thick is, or a post of an open side."""
        below = [f for f in self.faces if self.storey(f) == 0 and self.has(f, point)]
        return any(self.thick(f) == self.form.wall or (f["rel"] == "outside" and f["kind"] == "open" and point in self.ends(f)) for f in below)

    def is_borne(self, one, other):
        return any(self.storey(f) == 0 and self.thick(f) == self.form.wall and self.has(f, one) and self.has(f, other) for f in self.faces)

    def stretches(self):
        """(along y, plane, from, to) of each, in order."""
        steps = set()
        for face in self.faces:
            if self.storey(face) == 0 or self.thick(face) <= self.form.partition:
                continue
            x0, x1, y0, y1 = face["at"]
            k, plane, low, high = (1, x0, y0, y1) if x0 == x1 else (0, y0, x0, x1)
            for at in range(low, high, INCH):
                one, other = ((plane, at), (plane, at + INCH)) if k else ((at, plane), (at + INCH, plane))
                if not self.is_borne(one, other):
                    steps.add((k, plane, at))
        found = []
        for k, plane, at in sorted(steps):
            if found and found[-1][:2] == [k, plane] and found[-1][3] == at and not self.is_held((plane, at) if k else (at, plane)):
                found[-1][3] = at + INCH
            else:
                found.append([k, plane, at, at + INCH])
        return found

    def clear_of_posts(self, k, plane, at):
        """Half of how thick a post there is along the line: the thickest wall across it, or a post of an open side."""
        point, most = ((plane, at) if k else (at, plane)), 0
        for f in self.faces:
            if self.storey(f) != 0 or point not in self.ends(f):
                continue
            along = (f["at"][0] == f["at"][1]) == bool(k)
            post = f["rel"] == "outside" and f["kind"] == "open"
            most = max(most, self.form.wall if post else 0 if along else self.thick(f))
        return most * INCH // 2

    def beam(self, k, plane, low, high, taken):
        """The first beam that spans it and has room."""
        held = all(self.is_held((plane, at) if k else (at, plane)) for at in (low, high))
        top = self.form.storey - self.form.deck
        for name, wide, deep, span in self.form.beams if held else []:
            ends = low + self.clear_of_posts(k, plane, low), high - self.clear_of_posts(k, plane, high)
            sides = plane - wide * INCH // 2, plane + wide * INCH // 2
            box = [*(sides if k else ends), *(ends if k else sides), (top - deep) * INCH, top * INCH]
            over = [f for f in self.faces if self.storey(f) == 0 and (f["at"][0] == f["at"][1]) == bool(k) and f["at"][0 if k else 2] == plane
                    and f["at"][2 if k else 0] < ends[1] and f["at"][3 if k else 1] > ends[0]]
            room = all(sum(self.form.openings.get(f["kind"], (0, 0))) <= top - deep for f in over) and ends[0] < ends[1]
            if span * INCH >= high - low and room and not any(meet(box, other) for _, other in taken):
                return name, box
        return None


def meet(a, b):
    return all(a[i] < b[i + 1] and b[i] < a[i + 1] for i in (0, 2, 4))


def common(a, b):
    size = [min(a[i + 1], b[i + 1]) - max(a[i], b[i]) for i in (0, 2, 4)]
    return size[0] * size[1] * size[2] if min(size) > 0 else 0


def volume(solids):
    return sum(common(s["box"], s["box"]) for s in solids)


# ---- the checks


class Checker:
    def __init__(self, tartan):
        self.tartan, self.failures, self.beams, self.hanging = tartan, [], 0, 0
        self.files = os.path.join(os.path.dirname(os.path.abspath(__file__)), "house_files.py")

    def check(self, what, holds):
        if not holds:
            self.failures.append(what)

    def run(self, *words):
        return subprocess.run([self.tartan, *words], capture_output=True, text=True)

    def made(self, path, line, folder):
        os.makedirs(folder, exist_ok=True)
        made = self.run("house", path, line, *(word for end in ("json", "parts.csv", "ifc", "dxf") for word in ("-o", f"{folder}/house.{end}")))
        self.check(f"{line}: {made.stderr}", made.returncode == 0)
        return json.load(open(f"{folder}/house.json")), made.stderr

    def check_house(self, form, path, plain, line, folder):
        made, said = self.made(path, line, folder + "/built")
        before, _ = self.made(plain, line, folder + "/plain")
        house, want, left = House(form, made), [], []
        for stretch in house.stretches():
            beam = house.beam(*stretch, want)
            (want if beam else left).append(beam or stretch)
        has = [(s["name"], s["box"]) for s in made["solids"] if s["kind"] == "beam"]
        self.check(f"{line}: beams are {sorted(has)}, not {sorted(want)}", sorted(has) == sorted(want))
        self.check(f"{line}: W217 is said of {len(left)} stretches: {said}", ("W217" in said) == bool(left))
        self.beams += len(has)
        self.hanging += len(left)
        stands = lambda h: [s for s in h["solids"] if s["kind"] in (*WALLS, "post")]
        taken = sum(common(box, s["box"]) for _, box in has for s in stands(before))
        self.check(f"{line}: walls and posts hold what beams leave of them", volume(stands(made)) == volume(stands(before)) - taken)
        for i, a in enumerate(made["solids"]):
            for b in made["solids"][:i]:
                self.check(f"{line}: {a} and {b} are apart", not meet(a["box"], b["box"]))
            if a["kind"] in (*WALLS, "post"):
                self.check(f"{line}: {a} is a part of a wall that was there", common(a["box"], a["box"]) == sum(
                    common(a["box"], s["box"]) for s in stands(before) if (s["kind"], s["of"]) == (a["kind"], a["of"])))
        files = subprocess.run([sys.executable, "-B", self.files, folder + "/built"], capture_output=True, text=True)
        self.check(f"{line}: {files.stdout}{files.stderr}", files.stdout.strip() == "fine")

    def check_form(self, seed, folder):
        form, path, plain = Form(seed), f"{folder}/{seed}.plan", f"{folder}/{seed}-plain.plan"
        open(path, "w").write(form.text())
        open(plain, "w").write(form.text(beams=False))
        sampled = self.run("sample", path, "3", "--library", "all", "--seed", str(seed))
        self.check(f"form {seed}: {sampled.stderr}", sampled.returncode == 0)
        for line in sampled.stdout.splitlines():
            self.check_house(form, path, plain, line, folder)
        refused = self.run("best", path, "1", "--library", "all", "--least", "cost-of-all")
        self.check(f"form {seed}: {refused.stderr}", refused.returncode != 0 and "E1685" in refused.stderr and "beams" in refused.stderr)


def main():
    checker, first, count = Checker(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + count):
            checker.check_form(seed, folder)
    checker.check(f"{checker.beams} beams, {checker.hanging} walls without", count < 4 or (checker.beams > 0 and checker.hanging > 0))
    print("\n".join(checker.failures[:20]) or "fine")
    sys.exit(1 if checker.failures else 0)


main()
