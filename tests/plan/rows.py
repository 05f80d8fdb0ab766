#!/usr/bin/env python3
"""Holds schemas of libraries to trying every plan: rows.py TARTAN FIRST LAST [ORACLES]

Of each seed a library of houses is listed; what measures and rules say of each house is worked out here, and so for how many houses each
tray of `lots` stands. All rows of up to four trays are tried: which trays there are, how many rows of trays and of houses a street has, in
which order, what both engines say of each row, and how likely rows are drawn; and rows of houses, one by one. With ORACLES the rows of its plan/third.py are asked, too.
"""
import itertools
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile
from decimal import Decimal
from fractions import Fraction

PROGRAM, FIRST, LAST = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
ORACLES = sys.argv[4] if len(sys.argv) > 4 else None
FOLDER = tempfile.mkdtemp()
faults = []


def run(*arguments, text=None):
    done = subprocess.run([PROGRAM, *arguments], input=text, capture_output=True, text=True)
    if done.returncode not in (0, 1) or (done.returncode == 1 and "error" in done.stderr):
        raise SystemExit(f"{arguments}: {done.returncode}\n{done.stdout[:500]}\n{done.stderr[:2000]}")
    return done.stdout


def same(seed, what, got, wanted):
    if got != wanted:
        faults.append(f"seed {seed}, {what}: got {str(got)[:400]}, not {str(wanted)[:400]}")
        print(faults[-1], flush=True)


def write(seed, name, text):
    path = os.path.join(FOLDER, f"{seed}-{name}")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


# ---- houses, and what is said of them

# Lamps that no two neighbours have, and each home has: what is left of them is a projected library.
LIT = "schema lit from house { lamp = none | bright }\nrule unlit using lit = tray(home, lamp none) or neighbour(tray(bright), tray(bright))\n"


def can_be_lit(house):
    return not any(a[1] == b[1] == "home" for a, b in zip(house, house[1:]))


USES = ("home", "shop", "yard")
HOUSE = "schema house {\n  width = 2m | 3m | 5m\n  use = home | shop | yard\n  number floor = 3m * width\n}\n"
TRAYS = [(w, u) for w in (2, 3, 5) for u in USES]


def line(house):
    return " | ".join(f"{w}m {u}" for w, u in house)


def widths_of(use):
    return lambda house: sum(w for w, u in house if u == use)


MEASURES = [("sum(width)", lambda h: sum(w for w, _ in h)),
            *[(f"sum(width of tray({u}))", widths_of(u)) for u in USES],
            ("2 * sum(width) + 1m * quantity(tray(shop))", lambda h: 2 * sum(w for w, _ in h) + sum(u == "shop" for _, u in h))]
def of_use(house, use):
    return sum(w for w, u in house if u == use)


# Measures that are no lengths: what a house has of them, and their unit.
NUMBERS = [("quantity(tray(shop))", lambda h: sum(u == "shop" for _, u in h), ""),
           ("quantity(any) - 2 * quantity(tray(yard))", lambda h: len(h) - 2 * sum(u == "yard" for _, u in h), ""),
           ("(sum(width of tray(home)) + 1m) / (sum(width) + 2m)", lambda h: Fraction(of_use(h, "home") + 1, sum(w for w, _ in h) + 2), ""),
           ("sum(floor of tray(home))", lambda h: 3 * of_use(h, "home"), "m2"),
           ("sum(floor) / 4", lambda h: Fraction(3 * sum(w for w, _ in h), 4), "m2")]
RULES = [("neighbour(beginning, tray(shop))", lambda h: bool(h) and h[0][1] == "shop"),
         ("symmetric neighbour(tray(home), tray(yard))", lambda h: any({a[1], b[1]} == {"home", "yard"} for a, b in zip(h, h[1:]))),
         ("quantity(tray(5m)) >= 1", lambda h: any(w == 5 for w, _ in h)),
         ("quantity(any) = 2", lambda h: len(h) == 2),
         ("not tray(yard)", lambda h: all(u != "yard" for _, u in h)),
         ("sum(width) > 6m", lambda h: sum(w for w, _ in h) > 6)]
PRUNES = [("tray(home) beside tray(yard)", lambda h: any({a[1], b[1]} == {"home", "yard"} for a, b in zip(h, h[1:]))),
          ("quantity(tray(2m)) > 1", lambda h: sum(w == 2 for w, _ in h) > 1), ("sum(width) > 9m", lambda h: sum(w for w, _ in h) > 9)]


# ---- rows of lots: a tray has the values of its fields, each with its spelling

def alike(field):
    return (f"some v in {field} (neighbour(tray({field} v), tray({field} v)))" if field != "side" and not field.startswith("is") else
            f"some v in {field} (neighbour(tray(v), tray(v)))", lambda row: any(a[field] == b[field] for a, b in zip(row, row[1:])))


def pair_of(flag):
    return (f"neighbour(tray({flag}), tray({flag}))", lambda row: any(a[flag] != "-" and b[flag] != "-" for a, b in zip(row, row[1:])))


def lone(flag):
    return (f"every(tray({flag}), tray({flag})) and quantity(tray({flag})) > 1", lambda row: sum(t[flag] != "-" for t in row) > 1)


def wide(field, limit):
    return (f"sum({field}) > {limit}m", lambda row: sum(int(t[field][:-1]) for t in row) > limit)


def word(number, unit):
    """A value as plans have it: a decimal if it ends soon."""
    number = Fraction(number)
    text = str(number) if 10 ** 12 % number.denominator else format(Decimal(number.numerator) / number.denominator, "f")
    return text + unit


def number_of(text):
    return Fraction(text.removesuffix("m2"))


def asked_of_numbers(field, R):
    """What is asked of such a field: as numbers are, in each spelling."""
    low, unit = R.choice([0, 1, 2]), "m2" if field.endswith("m2") else ""
    high = low + R.choice([1, 3])
    sums = lambda row: sum(number_of(t[field]) for t in row)
    return [(f"quantity(tray({field} >= {low}.5{unit})) = 1", lambda row: sum(number_of(t[field]) >= Fraction(2 * low + 1, 2) for t in row) == 1),
            (f"tray({field} in {low}{unit}..{high}{unit})", lambda row: any(low <= number_of(t[field]) <= high for t in row)),
            (f"sum({field}) > {high}{unit}", lambda row: sums(row) > high),
            (f"tray({field} > {low}{unit}) beside tray({field} <= {low}{unit})",
             lambda row: any((number_of(a[field]) > low) != (number_of(b[field]) > low) for a, b in zip(row, row[1:]))),
            (f"every v, u in {field} (neighbour(tray({field} v), tray({field} u)) implies u - v <= {low}{unit})",
             lambda row: all(number_of(b[field]) - number_of(a[field]) <= low for a, b in zip(row, row[1:])))]


def fields_of(R):
    """name -> (what the schema says, what a house has, None of an ordinary field), in an order."""
    measures, rules = R.sample(MEASURES, R.randint(0, 2)), R.sample(RULES, R.randint(0, 2))
    made = [(f"len{i}", f"measure m{i}", lambda h, f=f: f"{f(h)}m") for i, (_, f) in enumerate(measures)]
    for words, f, unit in R.sample(NUMBERS, R.choice([0, 0, 1, 1, 2])):
        made.append((f"n{len(made)}{unit}", f"measure m{len(measures)}", lambda h, f=f, unit=unit: word(f(h), unit)))
        measures = measures + [(words, f)]
    made += [(f"is{i}", f"rule r{i}", lambda h, i=i, f=f: f"is{i}" if f(h) else "-") for i, (_, f) in enumerate(rules)]
    if not made or R.random() < .4:
        made.insert(R.randint(0, len(made)), ("side", "sunny | shady", None))
    return measures, rules, made


def key_of(values):
    return [number_of(v) if re.fullmatch(r"-?[0-9./]+(m2)?", v) else (int(v[:-1]) if re.fullmatch(r"\d+m", v) else v != "-" if v == "-" or v.startswith("is") else v == "shady") for v in values]


def trays_of(houses, fields):
    """Each tray, its fields' values, with the houses that it stands for: in the order of ranks."""
    found = {}
    for house in houses:
        for values in itertools.product(*[[say(house)] if say else ["sunny", "shady"] for _, _, say in fields]):
            found.setdefault(values, []).append(house)
    return sorted(found.items(), key=lambda item: key_of(item[0]))


def check(seed):
    R = random.Random(seed)
    prune, drops = R.choice(PRUNES)
    shortest, longest = R.choice([0, 1, 1]), R.randint(1, 3)
    houses = [h for n in range(shortest, longest + 1) for h in itertools.product(TRAYS, repeat=n) if not drops(h)]
    projected = R.random() < .2
    if projected:
        houses = [h for h in houses if can_be_lit(h)]
    measures, rules, fields = fields_of(R)
    trays = trays_of(houses, fields)
    names = [name for name, _, _ in fields]
    clauses = [alike(n) for n in names] + [wide(n, R.randint(5, 20)) for n in names if n.startswith("len")]
    clauses += [c for n in names if re.match(r"n\d", n) for c in asked_of_numbers(n, R)]
    clauses += [f(n) for n in names if n.startswith("is") for f in (pair_of, lone)]
    if "side" not in names and R.random() < .3:
        fields = fields + [("side", "sunny | shady", None)]
        names, trays = names + ["side"], trays_of(houses, fields)
    most = next(n for n in (4, 3, 2, 1) if len(trays) ** n <= 6000 or n == 1)
    text = HOUSE
    if projected:
        text += LIT + f"library lit-houses using lit {{ trays {shortest}..{longest}  prune unlit }}\nlibrary houses from lit-houses onto house {{ prune {prune} }}\n"
    else:
        text += f"library houses using house {{ trays {shortest}..{longest}  prune {prune} }}\n"
    text += "".join(f"measure m{i} using house = {words}\n" for i, (words, _) in enumerate(measures))
    text += "".join(f"rule r{i} using house = {words}\n" for i, (words, _) in enumerate(rules))
    text += "schema lots of houses {\n" + "".join(f"  {name} = {said}\n" for name, said, _ in fields) + "}\n"
    for street, wrong in R.sample(clauses, len(clauses)):       # one that some tray can meet
        path = write(seed, "rows.plan", text + f"rule bad using lots = {street}\nlibrary street using lots {{ trays 0..{most}  prune bad }}\n")
        if "error[E0309]" not in subprocess.run([PROGRAM, "check", path], capture_output=True, text=True).stderr:
            break
    else:
        return
    rows = [row for n in range(most + 1) for row in itertools.product(trays, repeat=n)]
    met = [wrong([dict(zip(names, values)) for values, _ in row]) for row in rows]
    kept = [row for row, bad in zip(rows, met) if not bad]

    def plans_of(row):
        product = 1
        for _, stands in row:
            product *= len(stands)
        return product

    def row_line(row):
        return " | ".join(" ".join(values) for values, _ in row)

    # ---- what trays there are
    shown = {s["name"]: s for s in json.loads(run("schema", path, "--json"))["schemas"]}["lots"]
    same(seed, "trays", shown["trays"], len(trays))
    said = [i for i, (_, _, say) in enumerate(fields) if say]
    wanted = {}
    for values, stands in trays:
        wanted[" ".join(values[i] for i in said)] = len(stands)
    same(seed, "for how many", {t["tray"]: int(t["plans"]) for t in shown["tray_plans"]}, wanted)
    # ---- counted, listed, ranked
    counted = json.loads(run("count", path, "--library", "street", "--json"))
    same(seed, "rows of trays", [int(c["kept"]) for c in counted["by_length"]], [sum(len(r) == n for r in kept) for n in range(most + 1)])
    same(seed, "rows of houses", [int(c["rows_of_plans"]) for c in counted["by_length"]],
         [sum(plans_of(r) for r in kept if len(r) == n) for n in range(most + 1)])
    same(seed, "all rows of houses", int(counted["rows_of_plans"]), sum(map(plans_of, kept)))
    listed = run("enumerate", path, "--library", "street")
    same(seed, "listed", [x for x in listed.split("\n") if not x.startswith("#")][:-1], [row_line(r) for r in kept])
    # ---- matched
    lines = write(seed, "rows.txt", "".join(row_line(r) + "\n" for r in rows))
    for engine in ("vm", "auto"):
        matched = run("match", path, lines, "--rule", "bad", "--format", "names", "--engine", engine)
        same(seed, f"matched by {engine}", ["bad" in x.split() for x in matched.split("\n")[:-1]], met)
    # ---- a module alone says the same
    module = write(seed, "rows.tnb", "")
    run("build", path, "-o", module)
    again = json.loads(run("count", module, "--library", "street", "--json"))
    same(seed, "by the module", again, counted)
    # ---- drawn: all of them, and one in proportion
    drawn = run("sample", path, "--library", "street", str(len(kept) + 1)).split("\n")[:-1]
    same(seed, "all drawn", sorted(drawn), sorted(row_line(r) for r in kept))
    single = [r for r in kept if len(r) == 1]
    if seed % 5 == 0 and len(single) > 1:
        draws, first = 300, row_line(max(single, key=plans_of))
        hits = sum(run("sample", path, "1", "--library", "street", "--length", "1", "--seed", str(k)).strip("\n") == first for k in range(draws))
        chance = max(map(plans_of, single)) / sum(map(plans_of, single))
        if abs(hits / draws - chance) > 5 * (chance * (1 - chance) / draws) ** .5:
            same(seed, "drawn in proportion", hits / draws, chance)
    check_houses(seed, R, path, module, kept, trays)
    if kept:
        check_blocks(seed, path, names, kept)


# ---- rows of houses, one by one

def with_houses(row, chosen):
    return " | ".join(f"{' '.join(values)} [{line(house)}]" for (values, _), house in zip(row, chosen))


def all_with_houses(kept):
    """In the order of ranks: rows of trays, then houses, the first counting most."""
    for row in kept:
        for chosen in itertools.product(*[stands for _, stands in row]):
            yield with_houses(row, chosen)


def check_houses(seed, R, path, module, kept, trays):
    """Lists, ranks and draws rows of houses: `kept` has the rows of trays, in their order."""
    total = sum(math.prod(len(stands) for _, stands in row) for row in kept)
    asked = ["--library", "street", "--plans"]
    first = list(itertools.islice(all_with_houses(kept), 3000))
    listed = run("enumerate", path, *asked, "--limit", "3000")
    same(seed, "rows of houses listed", listed.split("\n")[:-1], first)
    same(seed, "the module lists", run("enumerate", module, *asked, "--limit", "3000"), listed)
    if total <= len(first):
        drawn = run("sample", path, *asked, str(total + 1), "--seed", str(seed)).split("\n")[:-1]
        same(seed, "all rows of houses drawn", drawn, first)
    for k in {0, total - 1, *(R.randrange(total) for _ in range(4))} if total else ():
        row = run("unrank", path, *asked, str(k)).strip("\n")
        if k < len(first):
            same(seed, f"row of houses {k}", row, first[k])
        same(seed, f"rank of row of houses {k}", run("rank", path, *asked, "--", row).strip(), str(k))
        found = json.loads(run("enumerate", path, *asked, "--from", str(k), "--limit", "1", "-f", "json"))
        same(seed, f"JSON of row of houses {k}", (found["rank"], found["row"]), (str(k), row))
        same(seed, f"houses of row of houses {k}",
             [" | ".join(f"{t['width']} {t['use']}" for t in house["trays"]) for house in found["plans"]], re.findall(r"\[(.*?)\]", row))
    refused = subprocess.run([PROGRAM, "unrank", path, *asked, str(total)], capture_output=True, text=True)
    same(seed, "a rank that is none", (refused.returncode, "E0906" in refused.stderr), (1, True))
    row = next((r for r in kept if r), None)
    others = [stands[0] for _, stands in trays if row and stands[0] not in row[0][1]]
    if others:
        wrong = with_houses(row, [others[0], *(stands[0] for _, stands in row[1:])])
        refused = subprocess.run([PROGRAM, "rank", path, *asked, "--", wrong], capture_output=True, text=True)
        same(seed, "a house of another tray", (refused.returncode, "E0906" in refused.stderr), (1, True))
    if seed % 5 == 0 and 1 < total <= 40:
        draws = [run("sample", path, "1", *asked, "--seed", str(k)).strip("\n") for k in range(300)]
        for row in first:
            chance = 1 / total
            if abs(draws.count(row) / 300 - chance) > 5 * (chance * (1 - chance) / 300) ** .5:
                same(seed, "rows of houses drawn evenly", draws.count(row) / 300, chance)


# ---- rows of rows: a tray stands for a row of trays

def check_blocks(seed, path, names, kept):
    """Blocks of the street: how many lots a row has, and whether its first two are alike in their first field."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    field = names[0]
    value = "v" if field.startswith("is") else f"{field} v"
    alike_too = text + (f"measure lots-of using lots = quantity(any)\nrule twins using lots = some v in {field} (neighbour(beginning, tray({value}), tray({value})))\n"
                        "schema blocks of street { many_lots = measure lots-of  twins = rule twins }\n"
                        "library town using blocks { trays 0..2  require sum(many_lots) <= 5 }\n")
    path = write(seed, "blocks.plan", alike_too)
    stands = {}
    for row in kept:
        twins = len(row) > 1 and row[0][0][0] == row[1][0][0]
        stands.setdefault((len(row), twins), []).append(" | ".join(" ".join(values) for values, _ in row))
    blocks = sorted(stands.items())
    shown = {s["name"]: s for s in json.loads(run("schema", path, "--json"))["schemas"]}["blocks"]
    same(seed, "blocks", [(t["tray"], int(t["plans"])) for t in shown["tray_plans"]],
         [(f"{many} {'twins' if twins else '-'}", len(rows)) for (many, twins), rows in blocks])
    towns = [t for n in range(3) for t in itertools.product(blocks, repeat=n) if sum(b[0][0] for b in t) <= 5]
    first = list(itertools.islice((" | ".join(f"{b[0][0]} {'twins' if b[0][1] else '-'} [{row}]" for b, row in zip(t, chosen))
                                   for t in towns for chosen in itertools.product(*[b[1] for b in t])), 500))
    asked = ["--library", "town", "--plans"]
    same(seed, "rows of rows", run("enumerate", path, *asked, "--limit", "500").split("\n")[:-1], first)
    for k in {0, len(first) - 1} if first else ():
        same(seed, f"rank of row of rows {k}", run("rank", path, *asked, "--", first[k]).strip(), str(k))


# ---- the reference's own rows

def check_reference(seed):
    import third
    folder = os.path.join(FOLDER, f"third-{seed}")
    third.main(seed, folder)
    with open(os.path.join(folder, "expect.json"), encoding="utf-8") as file:
        expected = json.load(file)
    with open(os.path.join(folder, "case.plan"), encoding="utf-8") as file:
        text = file.read()
    text = re.sub(r"(?ms)^library (?:bare from zoned|fitting from kept).*?^\}\n", "", text)
    text = re.sub(r"(?m)^param .*\n", "", text)
    path = write(seed, "third.plan", text)
    refused = "error[E0410]" in subprocess.run([PROGRAM, "check", path], capture_output=True, text=True).stderr
    if refused or not expected["letters"]:      # the reference also asks for remainders that are none
        return
    shown = {s["name"]: s for s in json.loads(run("schema", path, "--json"))["schemas"]}["lots"]
    same(seed, "letters of the reference", [[t["tray"], int(t["plans"])] for t in shown["tray_plans"]], expected["letters"])
    counted = json.loads(run("count", path, "--library", "street", "--json", "--no-effects"))["by_length"]
    same(seed, "rows of the reference", {"by_trays": [int(c["rows_of_plans"]) for c in counted], "letters": [int(c["kept"]) for c in counted]},
         expected["rows"])


if ORACLES:
    sys.path.insert(0, os.path.join(ORACLES, "plan"))
for seed in range(FIRST, LAST):
    (check_reference if ORACLES else check)(seed)
print(f"{LAST - FIRST} files, {len(faults)} faults")
sys.exit(1 if faults else 0)
