#!/usr/bin/env python3
"""Compares houses with an independent reference: house_oracle.py TARTAN ORACLES [SHARE]

Every SHAREth of the decisions and houses is compared (1, all, if none is given).

When the rules' answers were written down, the reference did not know that openings do not fit behind lower roofs. It is asked again, with
that rule (house_lower_roofs.py).

For each house of the reference's files: its line is read and written again, and its cells, faces, rooms and boxes are held against
the reference's; its roofs are slabs, which house_slabs.py holds to what they mean. Its rules are matched with its houses, and its libraries keep and drop what they should."""
import glob
import json
import os
import subprocess
import sys
import tempfile

import house_lower_roofs

tartan, oracles = sys.argv[1], os.path.join(sys.argv[2], "house")
share = int(sys.argv[3]) if len(sys.argv) > 3 else 1
failures = []


reference = house_lower_roofs.use(sys.argv[2])


def asked_again(path, wanted):
    """What the reference says of the same lines with the rule about lower roofs: openings without a choice may be others."""
    form = reference.parse(path)
    library = reference.File()  # houses are read as those of a library in the only form
    (library.form,) = form.forms
    solids = [reference.report2(form, *reference.read_house(form, library, one["house"])) for one in wanted["solids"]]
    tiles, reference.tile_variants = reference.tile_variants, lambda house, cell: None  # the lines have no tiles
    houses = [reference.read_house(form, library, line)[0] for line in wanted["lines"]]
    reference.tile_variants = tiles
    rules = {name: "".join("01"[bool(house.matches(form.rules[name]))] for house in houses) for name in wanted["rules"]}
    return {**wanted, "rules": rules, "solids": solids}


def house(path, line):
    run = subprocess.run([tartan, "house", path, line, "-o", "house.json"], capture_output=True, text=True)
    if run.returncode != 0:
        return run.stderr
    with open("house.json") as file:
        return json.load(file)


def boxes(solids):
    return sorted((s["kind"], s.get("name", ""), *s["box"]) for s in solids)


def rooms(found):
    return sorted((r["function"], tuple(r["cells"]), int(r["area"]), int(r["net"])) for r in found)


def compare(name, path, wanted):
    got = house(path, wanted["house"])
    if isinstance(got, str):
        failures.append(f"{name}: {got}")
        return
    same = {
        "house": (got["house"], wanted["house"]),
        "cells": (got["cells"], wanted["cells"]),
        "faces": (got["faces"], wanted["faces"]),
        "rooms": (rooms(got["rooms"]), rooms(wanted["rooms"])),
        "solids": (boxes(got["solids"]), boxes(wanted["solids"])),
    }
    for part, (mine, theirs) in same.items():
        if mine != theirs:
            first = next((f"{a} and {b}" for a, b in zip(mine, theirs) if a != b), f"{len(mine)} and {len(theirs)}")
            failures.append(f"{name}: {part} differ: {first}")


def compare_rules(path, wanted):
    """Every rule on every house of the file: a row of bits a house."""
    with open("houses.txt", "w") as file:
        file.write("".join(line + "\n" for line in wanted["lines"]))
    names = list(wanted["rules"])
    command = [tartan, "match", path, "houses.txt", "--format", "bits"]
    run = subprocess.run(command + [word for name in names for word in ("--rule", name)], capture_output=True, text=True)
    rows = run.stdout.splitlines()
    for i, name in enumerate(names):
        got = "".join(row[i] for row in rows)
        if got != wanted["rules"][name]:
            failures.append(f"{os.path.basename(path)}: {name} says {got or run.stderr}, not {wanted['rules'][name]}")
    return len(names) * len(rows)


def compare_decision(path, wanted):
    """Which clauses drop a house: the reference calls them by their number among the library's."""
    run = subprocess.run([tartan, "explain", path, wanted["line"], "--json"], capture_output=True, text=True)
    if run.returncode != 0:
        failures.append(f"{os.path.basename(path)}: {run.stderr}")
        return
    clauses = [clause for clause in json.loads(run.stdout)["clauses"] if clause["of"] == "house"]
    numbered = [(clause["name"], f"{clause['kind']}@{i + 1}") for i, clause in enumerate(clauses) if clause["drops"]]
    got = sorted(number if "@" in name else name for name, number in numbered)
    if got != sorted(wanted["dropped_by"]):
        failures.append(f"{os.path.basename(path)}: {wanted['line']} is dropped by {got}, not {wanted['dropped_by']}")


def run(*words):
    """What tartan prints, or what is wrong."""
    done = subprocess.run([tartan, *words], capture_output=True, text=True)
    return done.stdout.strip() if done.returncode == 0 else done.stderr


def counts(*words):
    try:
        return json.loads(run("count", *words, "--json"))
    except json.JSONDecodeError:
        return {}


def same(name, got, wanted):
    if got != wanted:
        failures.append(f"{name}: {got}, not {wanted}")


def compare_counts(path, wanted):
    """All houses of a form's library counted, and houses by their ranks, both ways."""
    name = os.path.basename(path)
    library = ["--library", "h"]
    got = counts(path, *library)
    for part in ("plans", "plans_with_houses", "zoned", "faced", "houses"):
        same(f"{name}: {part}", got.get(part), str(wanted["count"][part]))
    same(name, got.get("by_length"), {n: str(houses) for n, houses in wanted["count"]["by_length"].items() if houses})
    for rank, line in wanted["at_rank"].items():
        same(f"{name}: house {rank}", run("unrank", path, rank, *library), line)
        number = run("rank", path, line, *library)
        same(f"{name}: house {number}", run("unrank", path, number, *library), line)


def compare_variants():
    """Houses on one plan: of the LaHave House in one section, and of rows of two trays."""
    with open(oracles + "/lahave-variants.json") as file:
        wanted = json.load(file)
    for section, parts in wanted["sections"].items():
        values = section.split()
        names = ["machine storeys", "machine roof", "body storeys", "body roof", "bay storeys", "bay roof", "cladding"]
        names = names[: 2 * len([v for v in values if v.isdigit()])] + names[6:]
        where = "option(" + ", ".join(f"{n} {v}" for n, v in zip(names, values)) + ")"
        got = counts(oracles + "/stdlib/lahave-form.plan", "--library", wanted["library"], "--plan", wanted["plan"], "--where", where)
        same(f"LaHave, {section}", [got.get(part) for part in parts], [str(number) for number in parts.values()])
    source = [oracles + "/stdlib/row-houses.plan", "--library", "row-houses"]
    with open(oracles + "/row-variants.json") as file:
        plans = json.load(file)["plans"]
    for plan in plans:
        got = counts(*source, "--plan", plan["plan"])
        for part in ("zoned", "faced", "houses"):
            same(f"row {plan['plan_rank']}: {part}", got.get(part), str(plan[part]))
        same(f"row {plan['plan_rank']}", run("unrank", source[0], f"#{plan['plan_rank']}:0", *source[1:]), plan["first"])


def main():
    count = decided = 0
    os.chdir(tempfile.mkdtemp())
    for path in sorted(glob.glob(oracles + "/forms/*.json") + glob.glob(oracles + "/rules/*.json")):
        with open(path) as file:
            wanted = json.load(file)
        source = path[:-5] + ".plan"
        if "count" in wanted:
            compare_counts(source, wanted)
        if "rules" in wanted:
            wanted = asked_again(source, wanted)
            decided += compare_rules(source, wanted)
        for one in wanted.get("decisions", [])[::share]:
            compare_decision(source, one)
            decided += 1
        for i, one in enumerate(wanted["solids"][::share]):
            compare(f"{os.path.basename(path)}, house {i * share}", source, one)
            count += 1
        for i, line in enumerate(list(wanted.get("at_rank", {}).values())[::share]):
            got = subprocess.run([tartan, "house", source, line], capture_output=True, text=True)
            if got.stdout != line + "\n":
                failures.append(f"{os.path.basename(path)}: {line} becomes {got.stdout or got.stderr}")
            count += 1
    compare_variants()
    with open(oracles + "/lahave-walk.json") as file:
        walk = json.load(file)
    compare("lahave-walk.json", oracles + "/stdlib/lahave-form.plan", walk)
    print(f"{count + 1} houses and {decided} decisions, {len(failures)} differ")
    for failure in failures[:10]:
        print(failure)
    sys.exit(1 if failures else 0)


main()
