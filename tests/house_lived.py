#!/usr/bin/env python3
"""Houses of the standard library drawn by chance, lived in: house_lived.py TARTAN MODEL.py STDLIB SEED COUNT [FILE]

COUNT houses of each library below, or of that of FILE alone. An independent slow model goes about in each: its cells can be crossed between
all doors past what stands in them, what is to be kept free is reached, leaves have room, flights stand. Then one comes in from outside, by the
doors and open sides of the house as it is written, and goes from room to room: every cell is reached, and none of them only through a bath, a
bedroom or a store; each dwelling has a kitchen, a bath and a bed; there is a flight to each storey, and a door to every store."""
import importlib.util
import json
import os
import subprocess
import sys
import tempfile

# File, library, of which trays half of the houses are, so that small ones are among them, and the others where few are drawn, which takes
# less time; what all who live there share.
LIBRARIES = [
    ("cottage.plan", "cottages", "2", "2..3", set()),
    ("row-houses.plan", "row-houses", "2", "2..6", set()),
    ("lahave-complete.plan", "lahave-complete", "3..4", "4", set()),
    ("apartments.plan", "apartments", "6", "6..9", {"way-through", "lobby", "landing", "stair", "lounge", "laundry"}),
]
PRIVATE = {"bath", "bedroom", "store", "larder"}  # nobody goes through them
BEHIND_BEDS = {"store", "seat"}  # but to what a bedroom may have for itself
FEW = 40
tartan, stdlib = sys.argv[1], sys.argv[3]
seed, count = int(sys.argv[4]), int(sys.argv[5])
failures = []


def load(path):
    spec = importlib.util.spec_from_file_location("model", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def run(*words):
    done = subprocess.run([tartan, *words], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(words)[:300]}\nexit {done.returncode}: {done.stderr[:2000]}")
    return done.stdout


def ways_of(form, house):
    """Of each cell the cells that one comes to from it; and the cells that one comes into from outside."""
    ways, entered = {cell["id"]: set() for cell in house["cells"]}, set()
    for face in house["faces"]:
        opening = form["openings"].get(face["kind"])
        passage = face["kind"] == "open" or face["kind"] in form["flights"] or opening and "passage" in opening["flags"]
        outside = "b" not in face or face["b"] is None
        storey = next(cell["storey"] for cell in house["cells"] if cell["id"] == face["a"])
        if not passage or face["rel"] == "above" and face["kind"] == "open":
            continue
        if outside:
            entered |= {face["a"]} if storey == 0 else set()
        else:
            ways[face["a"]].add(face["b"])
            ways[face["b"]].add(face["a"])
    return ways, entered


def reached(ways, entered, shut):
    """The cells that one comes to, out of none of those that are shut."""
    found, todo = set(entered), [cell for cell in entered if cell not in shut]
    while todo:
        for cell in ways[todo.pop()] - found:
            found.add(cell)
            todo += [cell] if cell not in shut else []
    return found


def dwellings(ways, cells):
    """The cells in groups, each with all that one comes to within it."""
    left, groups = set(cells), []
    while left:
        first = min(left)
        inside = {cell: ways[cell] & cells for cell in cells}
        groups.append(reached(inside, {first}, set()))
        left -= groups[-1]
    return groups


def lacks(form, house, shared):
    """What a family misses in the house."""
    functions = {cell["id"]: cell.get("function") or "void" for cell in house["cells"]}
    storeys = {cell["id"]: cell["storey"] for cell in house["cells"]}
    ways, entered = ways_of(form, house)
    lived = {cell for cell, function in functions.items() if function != "void"}
    private = {cell for cell in lived if functions[cell] in PRIVATE}
    missing = []
    for group in dwellings(ways, {cell for cell in lived if functions[cell] not in shared}):
        rooms = {room for cell in group for room in functions[cell].split("-")}
        doors = sum(cell in ways[other] for cell in group for other in lived - group)
        missing += [f"{doors} doors of the dwelling of cell {min(group)}"] if shared and doors != 1 else []
        missing += [f"no {room} in the dwelling of cell {min(group)}" for room in ("kitchen", "bath", "bedroom") if room not in rooms]
    missing += [f"no way from outside to {functions[cell]} {cell}" for cell in sorted(lived - reached(ways, entered, set()))]
    beds = {cell for cell in lived if functions[cell] == "bedroom"}
    passed = reached(ways, entered, private)
    passed |= {cell for cell in reached(ways, entered, private - beds) if functions[cell] in BEHIND_BEDS}
    missing += [f"no way to {functions[cell]} {cell} but through private rooms" for cell in sorted(lived - passed)]
    climbed = {storeys[face["b"]] for face in house["faces"] if face["kind"] in form["flights"]}
    missing += [f"no flight to storey {storey}" for storey in range(1, max(storeys.values()) + 1) if storey not in climbed]
    return missing


def live_in(model, form, path, line, shared, scratch):
    out = os.path.join(scratch, "house.json")
    run("house", path, line, "-o", out)
    with open(out) as file:
        house = json.load(file)
    functions = {cell["id"]: cell.get("function") for cell in house["cells"]}
    faults = [f"{functions.get(cell)} {cell}: {what}" for cell, what in model.house(form, house)]
    for fault in faults + lacks(form, house, shared):
        failures.append(f"{os.path.basename(path)}: {fault}: {line}")


def main():
    model, lived = load(sys.argv[2]), 0
    with tempfile.TemporaryDirectory() as scratch:
        for name, library, small, quick, shared in LIBRARIES:
            if len(sys.argv) > 6 and name != sys.argv[6]:
                continue
            path = os.path.join(stdlib, name)
            form = model.form_of(path)
            for many, words in ((count - count // 2, ["--trays", quick] if count <= FEW else []), (count // 2, ["--trays", small])):
                lines = run("sample", path, str(many), "--library", library, "--seed", str(seed), *words).splitlines() if many else []
                lived += len(lines)
                if len(lines) != many:
                    failures.append(f"{name}: {len(lines)} houses of {many}")
                for line in lines:
                    live_in(model, form, path, line, shared, scratch)
    print("\n".join(failures[:20]))
    print(lived, "houses,", len(failures), "faults")
    return bool(failures) or not lived


sys.exit(main())
