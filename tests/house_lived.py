#!/usr/bin/env python3
"""Houses of the standard library drawn by chance, lived in: house_lived.py TARTAN MODEL.py STDLIB SEED COUNT [FILE]

COUNT houses of each library below, or of that of FILE alone. An independent slow model goes about in each: its cells can be crossed between
all doors past what stands in them, what is to be kept free is reached, leaves have room, flights stand. Then one comes in from outside, by the
doors and open sides of the house as it is written, and goes from room to room: every cell is reached, and none of them only through a bath, a
bedroom or a store; each dwelling has a kitchen, a bath and a bed; there is a flight to each storey, and a door to every store.

In the first house of each library everything that could stand in some of its rooms is set up there, one after another, as the form's text says
it and the model finds ways past it: that is what `tartan vary` says could stand there."""
import importlib.util
import json
import os
import random
import re
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
    read = module.text_of
    module.text_of = lambda *of: re.sub(r"^( *)floor (?=\d)", r"\1deck ", read(*of), flags=re.M)  # it knows the word of before
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


def tiles_of(model, path):
    """Of each tile: its functions, what it stands against (None: anything), how wide and deep the room may be, its boxes."""
    tiles = {}
    for name, functions, body in re.findall(r'\n  tile ([\w-]+)(?:\s+"[^"]*")? for ([\w, -]+?) \{(.*?)\n  \}', model.text_of(path), re.S):
        against = re.search(r"\n\s+against ([\w -]+)", body)
        sizes = {word: tuple(map(model.L, bounds)) for word, *bounds in re.findall(rf"\n\s+(wide|deep) ({model.LEN})\.\.({model.LEN})", body)}
        boxes = re.findall(r'\n\s+(item|keep) ([\w-]+)(?: "[^"]*")? ?([^\n]*)', body)
        tiles[name] = (set(re.split(r",\s*", functions)), against and set(against[1].split(" or ")), sizes, boxes)
    return tiles


def upright(model, text, floor, ceiling):
    found = re.search(rf"up ({model.LEN})\.\.({model.LEN})", text)
    return (floor + model.L(found[1]), floor + model.L(found[2])) if found else (floor, ceiling)


def stands(boxes, posts, inner):
    """Whether all boxes lie within the room, and items meet neither one another nor a kept space or a post."""
    def apart(a, b):
        return any(a[k + 1] <= b[k] or b[k + 1] <= a[k] for k in (0, 2, 4))
    x0, x1, y0, y1 = inner
    if any(not (x0 <= b[0] < b[1] <= x1 and y0 <= b[2] < b[3] <= y1) for _, _, b in boxes):
        return False
    items = [b for kind, _, b in boxes if kind == "item"]
    kept = [b for kind, _, b in boxes if kind == "keep"]
    return all(apart(a, b) for i, a in enumerate(items) for b in items[:i] + kept + posts)


def layouts(model, form, tiles, house, cell):
    """The names of all that could stand in the cell; of layouts with the same things in the same places the first."""
    i, inner, floor = cell["id"], cell["inner"], sum(form["storeys"][:cell["storey"]])
    ceiling = floor + form["storeys"][cell["storey"]] - form["deck"]
    sides = {side: set() for side in model.SIDES}
    for face in house["faces"]:
        if i in (face["a"], face["b"]) and face["rel"] != "above":
            sides[face["side"] if face["a"] == i else model.OPPOSITE[face["side"]]].add(face["kind"])
    posts = [solid["box"] for solid in house["solids"] if solid["kind"] == "post"]
    others = [solid for solid in house["solids"] if solid["kind"] != "item" or solid["of"] != i]
    head, now = house["house"].rsplit(" ; ", 1)
    now = now.split()
    at = sum(c.get("function") in form["tiled"] for c in house["cells"] if c["id"] < i)
    seen, found = set(), []
    for name, (functions, against, sizes, texts) in tiles.items():
        for side in model.SIDES if cell["function"] in functions else ():
            across = (inner[1] - inner[0], inner[3] - inner[2])
            wide, deep = across if side in ("back", "front") else across[::-1]
            fits = all(low <= size <= high for word, size in (("wide", wide), ("deep", deep)) for low, high in [sizes.get(word, (0, size))])
            for mirrored in (False, True) if fits and (against is None or sides[side] <= against) else ():
                boxes = [(kind, item, (*model.placed(text, inner, side, mirrored), *upright(model, text, floor, ceiling))) for kind, item, text in texts]
                things = frozenset((item, box) for kind, item, box in boxes if kind == "item")
                if things in seen or not stands(boxes, posts, inner):
                    continue
                seen.add(things)
                label = f"{name}.{side}" + (".m" if mirrored else "")
                new = [{"kind": "item", "of": i, "box": list(box)} for kind, _, box in boxes if kind == "item"]
                line = head + " ; " + " ".join(now[:at] + [label] + now[at + 1:])
                if not model.house(form, {**house, "solids": others + new, "house": line}):
                    found.append(label)
    return found


def furnish(model, form, path, library, line, scratch):
    """Rooms of the house, chosen by chance, are furnished in all ways there are."""
    out, names = os.path.join(scratch, "house.json"), re.findall(r"\n\s*storey ([\w-]+)", model.text_of(path))
    run("house", path, line, "-o", out)
    with open(out) as file:
        house = json.load(file)
    tiles, tiled = tiles_of(model, path), [cell for cell in house["cells"] if cell.get("function") in form["tiled"]]
    for cell in random.Random(seed).sample(tiled, min(len(tiled), 4)):
        place = f"{cell['tray'] + 1}.{cell['zone']}.{names[cell['storey']]}"
        said = re.findall(rf"  {re.escape(place)}: (\S+\.\S+) for (\S+\.[^\s,]+)", run("vary", path, line, "--library", library, "--at", place))
        now = house["house"].rsplit(" ; ", 1)[1].split()[sum(c.get("function") in form["tiled"] for c in house["cells"] if c["id"] < cell["id"])]
        got, wanted = {new for new, _ in said} | {now}, set(layouts(model, form, tiles, house, cell))
        if got != wanted:
            failures.append(f"{os.path.basename(path)}: {place}: {sorted(got)}, and not {sorted(wanted)}: {line}")


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
                for line in lines[:1]:
                    furnish(model, form, path, library, line, scratch)
                for line in lines:
                    live_in(model, form, path, line, shared, scratch)
    print("\n".join(failures[:20]))
    print(lived, "houses,", len(failures), "faults")
    return bool(failures) or not lived


sys.exit(main())
