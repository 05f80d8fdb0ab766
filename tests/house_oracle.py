#!/usr/bin/env python3
"""Compares houses with an independent reference: house_oracle.py TARTAN ORACLES [FILE...]

For each house of the reference's files: its line is read and written again, and its cells, faces, rooms, boxes and roofs are held
against the reference's. Rules of libraries in a form are cut out of the files first: they are no part of what is compared."""
import glob
import json
import os
import re
import subprocess
import sys
import tempfile
from fractions import Fraction

tartan, oracles = sys.argv[1], os.path.join(sys.argv[2], "house")
failures = []


def without_rules(text):
    """The schema and the form alone."""
    text = re.sub(r"(?m)^library .*\}\n", "", text)
    text = re.sub(r"(?ms)^library .*?^\}\n", "", text)
    text = re.sub(r"(?m)^rule .*\n(?:[ \t].*\n)*", "", text)
    return re.sub(r"(?ms)^test .*?^\}\n", "", text)


def house(path, line):
    run = subprocess.run([tartan, "house", path, line, "-o", "house.json"], capture_output=True, text=True)
    if run.returncode != 0:
        return run.stderr
    with open("house.json") as file:
        return json.load(file)


def boxes(solids):
    return sorted((s["kind"], s.get("name", ""), *s["box"]) for s in solids)


def roofs(prisms):
    return sorted((*p["x"], p["base"], *((Fraction(y), Fraction(z)) for y, z in p["profile"])) for p in prisms)


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
        "roofs": (roofs(got["roofs"]), roofs(wanted["roofs"])),
    }
    for part, (mine, theirs) in same.items():
        if mine != theirs:
            first = next((f"{a} and {b}" for a, b in zip(mine, theirs) if a != b), f"{len(mine)} and {len(theirs)}")
            failures.append(f"{name}: {part} differ: {first}")


def main():
    count = 0
    os.chdir(tempfile.mkdtemp())
    for path in sorted(glob.glob(oracles + "/forms/*.json") + glob.glob(oracles + "/rules/*.json")):
        with open(path) as file:
            wanted = json.load(file)
        with open(path[:-5] + ".plan") as file:
            text = without_rules(file.read())
        with open("form.plan", "w") as file:
            file.write(text)
        for i, one in enumerate(wanted["solids"]):
            compare(f"{os.path.basename(path)}, house {i}", "form.plan", one)
            count += 1
        for i, line in enumerate(wanted.get("at_rank", {}).values()):
            got = subprocess.run([tartan, "house", "form.plan", line], capture_output=True, text=True)
            if got.stdout != line + "\n":
                failures.append(f"{os.path.basename(path)}: {line} becomes {got.stdout or got.stderr}")
            count += 1
    with open(oracles + "/lahave-walk.json") as file:
        walk = json.load(file)
    with open(oracles + "/stdlib/lahave-form.plan") as file:
        text = without_rules(file.read())
    with open("walk.plan", "w") as file:
        file.write(text.replace('use "lahave-houses"', 'use "lahave"'))
    compare("lahave-walk.json", "walk.plan", walk)
    print(f"{count + 1} houses, {len(failures)} differ")
    for failure in failures[:10]:
        print(failure)
    sys.exit(1 if failures else 0)


main()
