#!/usr/bin/env python3
"""What `tartan check` says of libraries of houses, held to the houses themselves: house_clauses.py TARTAN FIRST LIBRARIES

A small form has a few thousand houses, which are listed, and so are those that match each of some rules. Libraries of chosen rules are
drawn by chance. Which of their clauses change nothing, which leave no house together and what is left without each, which values of the
section no house has, and which rules match the same houses follows from these sets."""
import itertools
import json
import random
import re
import subprocess
import sys
import tempfile
from collections import Counter

tartan, first, wanted = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
failures, seen = [], Counter()

FORM = """schema row {
  width role length = 3m | 4m
  zone house role band = room(4m)
}
form two of row {
  storey floor 3m
  wall 300mm partition 100mm floor 300mm roof 200mm
  option house roof = flat | shed(back, 1:4) | gable(1:1)
  option cladding = brick | render
  forbid option(cladding brick) and option(house roof shed)
  function living at cell(house)
  function store at cell(house)
  function bath at cell(width 3m)
  opening door wide 1m high 2m passage
  opening pane wide 1m high 1m sill 1m glazed
  face cell(bath) beside cell(bath) = wall
  face cell(any) beside cell(any) = door | wall
  face cell(living) outside front = pane | door
}
library rows using row { trays 1..3 }
"""
RULES = {
    "baths": "quantity(cell(bath), n >= 2)", "bath": "cell(bath)", "store": "cell(store)", "no-living": "not cell(living)", "one-store": "quantity(cell(store), n = 1)",
    "lone-store": "cell(store) and not quantity(cell(store), n > 1)", "brick": "option(cladding brick)", "flat": "option(house roof flat)", "shed": "option(house roof shed)",
    "cut-off": "apart(cell(store), from cell(living), through cell(any), by door)", "baths-side": "touch(cell(bath), cell(bath))",
    "bath-pair": "touch(cell(bath), cell(bath) by wall)", "dark": "room(living, not by pane)", "wide": "tray(width 4m)", "three": "quantity(any, n = 3)", "four": "quantity(cell(any), n > 3)", "homeless": "quantity(cell(living), n = 0)",
    "any-room": "cell(bath or store or living)", "far": "apart(cell(bath), from cell(living), by door)", "big": "sum(area of cell(any), a > 30m2)",
}
EQUAL = (("one-store", "lone-store"), ("baths-side", "bath-pair"), ("no-living", "homeless"))


def run(*words):
    done = subprocess.run([tartan, *words], capture_output=True, text=True)
    return done.stdout


def houses(scratch, clauses):
    path = f"{scratch}/list.plan"
    with open(path, "w") as file:
        file.write(FORM + "library listed from rows in two { " + clauses + " }\n")
    return frozenset(run("enumerate", path, "--library", "listed").splitlines())


def values(line):
    roof, cladding = line.split(" ; ")[1].split()
    return {f"house roof {roof}", f"cladding {cladding}"}


class Library:
    """Rules that are required or pruned."""

    def __init__(self, chance):
        names = chance.sample(sorted(RULES), chance.randint(1, 6))
        if chance.random() < 0.4:
            names = list(dict.fromkeys(names + list(chance.choice(EQUAL))))
        self.clauses = [(name, chance.random() < 0.4) for name in names]
        self.text = FORM + "".join(f"rule {name} allow W019 = {RULES[name]}\n" for name in names)
        self.text += "library drawn from rows in two {\n" + "".join(f"  {'require' if required else 'prune'} {name}\n" for name, required in self.clauses) + "}\n"

    def kept(self, every, matched, without=(), only=None):
        left = every
        for i, (name, required) in enumerate(self.clauses):
            if i not in without and (only is None or i in only):
                left = left & matched[name] if required else left - matched[name]
        return left


def note_of(finding, start):
    return [note["message"] for note in finding["notes"] if note["message"].startswith(start)]


def check_empty(library, every, matched, findings):
    found = findings.get("W006", [])
    if len(found) != 1 or "W005" in findings or "W008" in findings or "W213" in findings:
        return "an empty library is not reported alone"
    reasons = [re.match(r"(?:without )?`([^`]*)` (?:the others|keeps)", note["message"]) for note in found[0]["notes"]]
    names = [name for name, _ in library.clauses]
    chosen = [names.index(reason[1]) for reason in reasons if reason]
    if library.kept(every, matched, only=chosen):
        return f"{chosen} leave houses"
    for i, note in zip(chosen, found[0]["notes"]):
        left = library.kept(every, matched, only=[k for k in chosen if k != i])
        example = note["message"].split(": ", 1)[1]
        if example not in left:
            return f"without {names[i]} there is no {example}"
        seen["reasons"] += 1
    return None


def check_idle(library, every, matched, findings):
    kept = library.kept(every, matched)
    generated = every
    for name, required in library.clauses:
        generated = generated & matched[name] if required else generated
    told = {finding["message"].split("`")[1 if code == "W005" else 3]: finding for code in ("W005", "W008") for finding in findings.get(code, [])}
    for i, (name, required) in enumerate(library.clauses):
        idle = library.kept(every, matched, without=[i]) == kept
        if idle != (name in told):
            return f"{name} is {'' if idle else 'not '}idle"
        if not idle:
            continue
        seen["idle"] += 1
        finding = told[name]
        if finding["code"] != ("W008" if required else "W005"):
            return f"{name} has {finding['code']}"
        examples = note_of(finding, "for example")
        if required:
            continue
        if bool(examples) != bool(generated & matched[name]):
            return f"{name} has {len(examples)} examples"
        if examples:
            names, example = examples[0].split(" too: ")
            droppers = set(re.findall(r"`([^`]*)`", names))
            if example not in generated & matched[name] or droppers != {other for other, needed in library.clauses if not needed and other != name and example in matched[other]}:
                return f"{name}: {examples[0]}"
    return None


def check_values(kept, every, findings):
    told = {re.search(r"option\((.*)\)`", finding["message"])[1] for finding in findings.get("W213", [])}
    has = set().union(*(values(line) for line in kept))
    seen["values"] += len(told)
    return None if told == set().union(*(values(line) for line in every)) - has else f"values {sorted(told)}"


def check_rules(library, every, matched, findings):
    names = [name for name, _ in library.clauses]
    wanted_pairs = set()
    for k, name in enumerate(names):
        equal = [other for other in names[:k] if matched[other] == matched[name]]
        if equal and matched[name] and matched[name] != every:
            wanted_pairs.add((name, equal[0]))
    told = {tuple(re.findall(r"`([^`]*)`", finding["message"])[:2]) for finding in findings.get("W004", [])}
    seen["equal"] += len(told)
    if told != wanted_pairs:
        return f"equal rules {sorted(told)}, not {sorted(wanted_pairs)}"
    return None


def check(library, scratch, every, matched):
    path = f"{scratch}/drawn.plan"
    with open(path, "w") as file:
        file.write(library.text)
    findings = {}
    done = subprocess.run([tartan, "check", path, "--diagnostics", "json"], capture_output=True, text=True)
    for finding in json.loads(done.stderr):
        findings.setdefault(finding.get("code"), []).append(finding)
    kept = library.kept(every, matched)
    if not kept:
        seen["empty"] += 1
        return check_empty(library, every, matched, findings)
    if "W006" in findings:
        return "a library with houses is said to be empty"
    return check_idle(library, every, matched, findings) or check_values(kept, every, findings) or check_rules(library, every, matched, findings)


with tempfile.TemporaryDirectory() as scratch:
    every = houses(scratch, "")
    matched = {name: houses(scratch, "require " + text) for name, text in RULES.items()}
    for seed in range(first, first + wanted):
        library = Library(random.Random(seed))
        wrong = check(library, scratch, every, matched)
        if wrong:
            failures.append(f"library {seed}: {wrong}\n{library.text[len(FORM):]}")
    for a, b in itertools.combinations(RULES, 2):
        seen["equal rules"] += matched[a] == matched[b]

if wanted >= 100 and not all(seen[what] for what in ("reasons", "idle", "values", "equal", "empty")):
    failures.append(f"hardly anything was asked: {dict(seen)}")
print(f"{wanted} libraries of {len(every)} houses: {dict(seen)}, {len(failures)} fail")
print(*failures[:5], sep="\n")
sys.exit(bool(failures))
