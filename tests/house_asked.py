#!/usr/bin/env python3
"""Small random forms whose clauses and measures ask for walks, ways out, steps, costs, areas and rows in every mixture, and every question about
them against every other: what `match` says of single houses decides which a library keeps; lists, counts, names, samples, the best, trade-offs,
completions, comparisons and houses typed in part follow from that by brute force.

usage: house_asked.py TARTAN SEED COUNT"""
import csv
import json
import os
import random
import subprocess
import sys
import tempfile
from fractions import Fraction

HOUSES = 3000         # files with more are made smaller
CLOSE = Fraction(1, 10**5)


class Fault(Exception):
    pass


def same(what, got, want):
    if got != want:
        raise Fault(f"{what}: got {str(got)[:600]}, not {str(want)[:600]}")


# ---- files

def cell(r, kinds):
    words = [r.choice(kinds["functions"] + ["any"])]
    if r.random() < .2:
        words.append(r.choice(kinds["storeys"]))
    if r.random() < .15:
        words.append(r.choice(kinds["widths"]))
    return f"cell({', '.join(words)})"


def by(r, kinds):
    ways = [k for k in kinds["ways"] if r.random() < .6] or [kinds["ways"][0]]
    text = r.choice([" or ".join(ways), "step-free", "open or step-free", "step-free or " + ways[-1]])
    return f", by {text}"


def walk(r, kinds):
    to = r.choice(["outside", "outside", cell(r, kinds)])
    more = [by(r, kinds)] * (r.random() < .3) + [f", through {cell(r, kinds)}"] * (r.random() < .25)
    r.shuffle(more)
    return f"{r.choice(['', '', 'least '])}walk({cell(r, kinds)}, to {to}{''.join(more)})"


def bound(r):
    return r.choice(["0m", "2.85m", "3m", "4m", "5.5m", "7m", "9.999999m", "12m"])


def sign(r):
    return r.choice(["<=", "<=", "<", ">=", ">", "=", "!="])


def compared(r, kinds):
    c = cell(r, kinds)
    return r.choice([
        lambda: f"{walk(r, kinds)} {sign(r)} {bound(r)}",
        lambda: f"{walk(r, kinds)} {sign(r)} {bound(r)}",
        lambda: f"{walk(r, kinds)} in 2m..{r.choice([3, 6, 9])}m",
        lambda: f"exits({c}) {sign(r)} {r.choice([0, 1, 1, 2])}",
        lambda: f"{walk(r, kinds)} + 1m * quantity({c}) {sign(r)} {bound(r)}",
        lambda: f"{walk(r, kinds)} <= {walk(r, kinds)} + {bound(r)}",
        lambda: f"exits({c}) <= quantity({cell(r, kinds)})",
        lambda: f"{walk(r, kinds)} / 1m + sum(cost) / 100 {sign(r)} {r.choice([4, 6, 9])}",
        lambda: f"sum(area of {c}) / 1m <= 4 * {walk(r, kinds)}",
    ])()


def plain(r, kinds):
    c, d = cell(r, kinds), cell(r, kinds)
    through = r.choice(["", f", through {cell(r, kinds)}"])
    return r.choice([
        lambda: c,
        lambda: f"quantity({c}, n {sign(r)} {r.choice([0, 1, 2])})",
        lambda: f"touch({c}, {d} by {r.choice(kinds['ways'] + ['wall'])})",
        lambda: f"apart({c}, from {d}{through}{by(r, kinds) if r.random() < .6 else ''})",
        lambda: f"sum(cost) {sign(r)} {r.choice([0, 60, 150, 200])}",
        lambda: f"sum(area of {c}) {sign(r)} {r.choice([0, 12, 20, 30])}m2",
        lambda: f"quantity({c}) < {r.choice([40, 50, 75])}% * trays",
        lambda: f"quantity({c}) >= 1",
        lambda: f"some w in width (neighbour(tray(w), {c}) or quantity(tray(w), n = 1))",
        lambda: f"every {c} within 1 of {d}",
        lambda: f"neighbour({c}, {d})",
        lambda: f"symmetric neighbour(beginning, {c})",
        lambda: f"room({r.choice(kinds['functions'])}, area {sign(r)} {r.choice([12, 15, 20])}m2)",
    ])()


def condition(r, kinds, depth=0):
    draw = r.random()
    if depth < 2 and draw < .2:
        return f"({condition(r, kinds, depth + 1)} and {condition(r, kinds, depth + 1)})"
    if depth < 2 and draw < .4:
        return f"({condition(r, kinds, depth + 1)} or {condition(r, kinds, depth + 1)})"
    if depth < 2 and draw < .5:
        return f"not {condition(r, kinds, depth + 1)}" if depth else f"not ({condition(r, kinds, depth + 1)})"
    return (compared if r.random() < .6 else plain)(r, kinds)


def measures(r, kinds):
    return [f"measure m0 using f = {walk(r, kinds)}", f"measure m1 using f = exits({cell(r, kinds)})",
            f"measure m2 using f = {walk(r, kinds)} * 1/3 - m0 + sum(width) / 7", "measure m3 using f = sum(cost)",
            f"measure m4 using f = sum(area of {cell(r, kinds)}) / 1m + {walk(r, kinds)}"]


def form(r):
    """The text, and what clauses may name."""
    upper, widths = r.random() < .45, r.choice([["3m"], ["3m", "4m"], ["4m"]])
    functions = ["hall"] + r.sample(["bed", "store", "porch"], r.choice([1, 1, 2]))
    kinds = {"functions": functions, "storeys": ["ground"] + ["upper"] * upper, "widths": widths, "ways": ["door"]}
    lines = [f"schema row {{ width role length = {' | '.join(widths)}  zone house role band = {r.choice(['space(4m)', 'space(5m)', 'space(4m, 5m)'])} }}",
             "form f of row {", "  storey ground 2.7m"] + ["  storey upper 2.7m"] * upper
    lines += ["  wall 200mm", "  partition 100mm", "  deck 300mm", "  roof 200mm", f"  way {r.choice([600, 700, 800])}mm"]
    if r.random() < .2:
        lines.append("  section cladding = board | brick")
    for name in functions:
        where = "any" if name == "hall" else r.choice(widths + ["ground"])
        lines.append(f"  function {name}{' outdoor' * (name == 'porch')} at cell({'ground' if name == 'porch' else where})")
    lines.append(f"  opening door wide 900mm high 2m passage {r.choice(['sliding', '', 'sliding near front 300mm'])}")
    if r.random() < .5:
        lines.append(f"  opening hatch wide {r.choice(['900mm', '1.2m'])} high 2m passage {r.choice(['sliding', 'leafless'])}")
        kinds["ways"].append("hatch")
    if upper:
        lines.append(f"  flight steps wide 800mm rise 160mm..200mm going 250mm {r.choice(['', 'turn half', 'turn half'])}")
        lines += ["  allow W212", f"  face cell({r.choice(functions[:2])}) under cell(any) = {r.choice(['steps | floor', 'steps', 'floor | steps'])}"]
    inner = r.choice(["door | wall", "door", "door | open", "open | wall"] + ["door | hatch", "hatch | wall | open"] * ("hatch" in kinds["ways"]))
    lines += [f"  face cell(any) beside cell(any) = {inner}", f"  face cell({r.choice(functions[:1] + ['any', 'any'])}, ground) outside {r.choice(['left', 'left', 'right', 'front'])} = {r.choice(['door', 'door | wall'])}"]
    if r.random() < .4:
        lines.append(f"  face cell({r.choice(functions)}, ground) outside right = door")
    lines.append("  face cell(any) outside = wall")
    if r.random() < .6:
        name = r.choice(functions[-1:] * 2 + functions[:1])
        lines += [f"  tile table for {name} {{ item table left 1m..1.8m, back 1.2m..2m }}"]
        lines += [f"  tile bench for {name} {{ against wall  item bench left 300mm..2m, back 0..400mm{r.choice(['', ', up 0..450mm'])} keep seat left 300mm..2m, back 400mm..900mm }}"]
        lines += ['  material pine "#c0a080" price 100 per m2 for table', '  material oak "#806040" price 75.50 per each for bench']
    return lines + ["}"], kinds


def file_of(seed):
    r = random.Random(seed)
    lines, kinds = form(r)
    clauses = [condition(r, kinds) for _ in range(4)]
    libraries = {"all": [], "one": [("require", 0)], "two": [("prune", 1), ("require", 2)], "three": [("require", 3), ("prune", 0)]}
    lines += [f"rule c{i} = {text}" for i, text in enumerate(clauses)]
    lines.append(f"library rows using row {{ trays {r.choice(['1..2', '2', '1..3'] if 'tile' not in ' '.join(lines) else ['1..2', '2'])} }}")
    for name, said in libraries.items():
        lines.append(f"library {name} from rows in f {{ {' '.join(f'{kind} c{i}' for kind, i in said)} }}")
    return "\n".join(lines + measures(r, kinds)) + "\n", libraries


# ---- asking

class Program:
    def __init__(self, tartan, folder, text):
        self.tartan, self.path, self.folder = tartan, os.path.join(folder, "asked.plan"), folder
        with open(self.path, "w", encoding="utf-8") as file:
            file.write(text)

    def run(self, command, *words, given=None):
        done = subprocess.run([self.tartan, command, self.path, *map(str, words)], capture_output=True, text=True, input=given, timeout=120)
        if done.returncode not in (0, 1, 4):
            raise Fault(f"{command} {' '.join(map(str, words))}: exit code {done.returncode}: {done.stderr}")
        return done

    def lines(self, command, *words, given=None):
        done = self.run(command, *words, given=given)
        if done.returncode:
            raise Fault(f"{command} {' '.join(map(str, words))}: {done.stderr}")
        return done.stdout.splitlines()

    def json(self, command, *words):
        """An object a line."""
        return [json.loads(line) for line in self.lines(command, *words)]

    def document(self, command, *words):
        return json.loads("\n".join(self.lines(command, *words, "--json")))


def columns(p, library, plan=None):
    """Each house with the values of the measures, by its line."""
    path = os.path.join(p.folder, "houses.csv")
    p.lines("enumerate", "--library", library, "--columns", "-o", path, *(["--plan", plan] if plan else []))
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    names = {f"m{k}": next(n for n in rows[0] if n == f"m{k}" or n.startswith(f"m{k}_")) for k in range(5)} if rows else {}
    return {row["line"]: {m: Fraction(row[n]) if row[n] else None for m, n in names.items()} for row in rows}


def walks(text, clauses):
    """Does one of the clauses ask for walks?"""
    return any(word in line for i in clauses for line in text.splitlines() if line.startswith(f"rule c{i} =") for word in ("walk(", "exits("))


class Library:
    def __init__(self, p, text, name, clauses, houses, bits, plans):
        self.p, self.name, self.plans, self.walks = p, name, plans, walks(text, [i for _, i in clauses])
        self.kept = [house for house, b in zip(houses, bits) if all((b[i] == "1") == (kind == "require") for kind, i in clauses)]
        self.said = ("--library", name)

    def on(self, plan):
        return [house for house in self.kept if house.split(" ; ")[0] == plan]


def ask_lists(l):
    p = l.p
    same(f"{l.name}: listed", p.lines("enumerate", *l.said), l.kept)
    if l.kept:
        k = len(l.kept) // 2
        same(f"{l.name}: listed from {k}", p.lines("enumerate", *l.said, "--from", k, "--limit", 3), l.kept[k:k + 3])
    drawn = p.lines("sample", 5, *l.said, "--seed", 3)
    same(f"{l.name}: drawn", (len(drawn), len(set(drawn) - set(l.kept)), drawn), (min(5, len(l.kept)), 0, sorted(set(drawn), key=drawn.index)))
    for threads in 1, 4:
        same(f"{l.name}: drawn, threads", p.lines("sample", 5, *l.said, "--seed", 3, "--threads", threads), drawn)
    same(f"{l.name}: drawn, all", p.lines("sample", len(l.kept) + 1, *l.said), l.kept)
    counted = p.run("count", *l.said, "--json")
    same(f"{l.name}: counted", "E1687" in counted.stderr if l.walks else json.loads(counted.stdout)["houses"], True if l.walks else str(len(l.kept)))


def ask_names(l):
    p, places = l.p, {}
    for house in l.kept:
        plan = house.split(" ; ")[0]
        places[house] = f"#{l.plans.index(plan)}:{sum(h.split(' ; ')[0] == plan for h in list(places))}"
    for house in l.kept[:: max(1, len(l.kept) // 4)]:
        same(f"{l.name}: the name of {house}", p.lines("rank", house, *l.said), [places[house]])
        same(f"{l.name}: the house of {places[house]}", p.lines("house", places[house], *l.said), [house])


def ask_plan(l, plan, values, r):
    p, kept = l.p, l.on(plan)
    on = (*l.said, "--plan", plan)
    same(f"{l.name} on {plan}: counted", p.document("count", *on)["houses"], str(len(kept)))
    same(f"{l.name} on {plan}: listed", p.lines("enumerate", *on), kept)
    for threads in 1, 4:
        same(f"{l.name} on {plan}: threads", p.lines("enumerate", *on, "--threads", threads), kept)
    if not kept:
        return
    for measure in r.sample(["m0", "m1", "m2", "m3", "m4"], 2):
        spread = p.document("count", *on, "--by", measure)
        want = {}
        for house in kept:
            if values[house][measure] is not None:
                want[values[house][measure]] = want.get(values[house][measure], 0) + 1
        same(f"{l.name} on {plan}: by {measure}", [int(d["houses"]) for d in spread["distribution"]], merged(want))
    ask_best(l, on, kept, values, r)
    ask_typed(l, kept, r)


def merged(counts):
    """The table has six decimals: values that differ by less than they say are one there, and the counts of both together cannot be told."""
    return [counts[value] for value in sorted(counts)]


def ask_best(l, on, kept, values, r):
    p, wishes = l.p, [(m, r.random() < .5) for m in r.sample(["m0", "m1", "m2", "m3", "m4"], r.choice([1, 2]))]
    words = [word for i, (m, most) in enumerate(wishes) for word in (f"--{'then-' * (i > 0)}{'most' if most else 'least'}", m)]
    valued = [h for h in kept if all(values[h][m] is not None for m, _ in wishes)]
    ordered = sorted(valued, key=lambda h: [-values[h][m] if most else values[h][m] for m, most in wishes])
    same(f"{l.name}: best {words}", [h["house"] for h in p.json("best", len(kept) + 1, *on, *words, "--format", "json")], ordered)
    if len(wishes) == 2 and valued:
        front = p.document("pareto", *on, *[w.replace("then-", "") for w in words])["points"]
        points = {tuple(values[h][m] * (1 if most else -1) for m, most in wishes) for h in valued}
        better = [q for q in points if not any(all(a >= b for a, b in zip(o, q)) and o != q for o in points)]
        same(f"{l.name}: front {words}", len(front), len(better))


def ask_typed(l, kept, r):
    """The first house that has some words of one."""
    house = r.choice(kept)
    parts = [part.split() for part in house.split(" ; ")]
    typed = [parts[0]] + [[word if word in "|-" or r.random() < .5 else "_" for word in part] for part in parts[1:]]
    line = " ; ".join(" ".join(part) for part in typed)
    if "_" not in line:
        return

    def has(other):
        return all(set(a) <= {"-", "_", "|"} or len(a) == len(b) and all(x in ("_", y) for x, y in zip(a, b)) for a, b in zip(typed[1:], [part.split() for part in other.split(" ; ")][1:]))
    want = next(h for h in kept if has(h))
    same(f"{l.name}: the name of {line}", l.p.lines("rank", line, *l.said), l.p.lines("rank", want, *l.said))


def ask_completions(l, values, r):
    width = r.choice(["3m", "4m"])
    pattern = r.choice([f"{width} | ...", f"... | {width}"])
    if not any(plan.startswith(width) for plan in l.plans):
        return
    fits = [h for h in l.kept if (h.split(" | ")[0].split(" ; ")[0] if pattern.endswith("...") else h.split(" ; ")[0].split(" | ")[-1]).startswith(width)]
    done = l.p.document("complete", pattern, *l.said)
    same(f"{l.name}: {pattern}", done["houses"], str(len(fits)))
    measure, most = r.choice(["m0", "m1", "m3"]), r.random() < .5
    done = l.p.document("complete", pattern, *l.said, "--most" if most else "--least", measure)
    valued = [values[h][measure] for h in fits if values[h][measure] is not None]
    best = done["trays"][0]["width"][width].get("best")
    same(f"{l.name}: {pattern}, {measure}", best is None, not valued)
    if valued and abs(Fraction(best) - (max if most else min)(valued)) > CLOSE:
        raise Fault(f"{l.name}: {pattern}, the {'most' if most else 'least'} {measure}: {best}, not {(max if most else min)(valued)}")


def ask_comparison(p, text, libraries):
    """A library before and after: what the one keeps and the other does not."""
    before, after = libraries[1], libraries[2]
    other = os.path.join(p.folder, "after.plan")
    with open(other, "w", encoding="utf-8") as file:
        file.write(text.replace("library one from", "library other from").replace("library two from", "library one from"))
    done = p.run("diff", other, "--library", "one", "--json")
    if done.returncode:
        raise Fault(f"diff: {done.stderr}")
    total = json.loads(done.stdout)
    old, new = set(before.kept), set(after.kept)
    got = {key: sum(int(row[key]) for row in total["by_length"]) for key in ("removed", "added", "kept")}
    same("compared", got, {"removed": len(old - new), "added": len(new - old), "kept": len(old & new)})


def check(tartan, seed, folder):
    for smaller in range(20):
        text, libraries = file_of(seed * 1000 + smaller)
        p = Program(tartan, folder, text)
        done = p.run("check")
        if done.returncode:
            raise Fault(f"check: {done.stderr}")
        houses = p.lines("enumerate", "--library", "all", "--limit", HOUSES + 1)
        if 2 <= len(houses) <= HOUSES:
            break
    else:
        return 0
    plans = p.lines("enumerate", "--library", "rows")
    bits = p.lines("match", "--format", "bits", given="".join(h + "\n" for h in houses))
    values = columns(p, "all")
    same("houses with their values", list(values), houses)
    r = random.Random(seed)
    made = [Library(p, text, name, clauses, houses, bits, plans) for name, clauses in libraries.items()]
    for l in made:
        ask_lists(l)
        ask_names(l)
        ask_plan(l, r.choice(plans), values, r)
        ask_completions(l, values, r)
    ask_comparison(p, text, made)
    return len(houses)


def main():
    tartan, first, count = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    asked = 0
    for seed in range(first, first + count):
        with tempfile.TemporaryDirectory() as folder:
            try:
                asked += check(tartan, seed, folder) > 0
            except Fault as fault:
                with open(os.path.join(folder, "asked.plan"), encoding="utf-8") as file:
                    print(file.read())
                sys.exit(f"seed {seed}: {fault}")
    print(f"{asked} of {count} files were asked")
    return 0 if asked * 2 >= count else 1


if __name__ == "__main__":
    sys.exit(main())
