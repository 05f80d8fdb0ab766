#!/usr/bin/env python3
"""A LaHave plan, stood up in every section of lahave-form, as facts for house.pl: house_facts.py PLAN >FACTS.pl

cell(S, Id, Zone, Storey, Wide, Deep, Dense, Great, Public, Double), above(S, Low, High), beside(S, A, B, Relation, Long),
outside(S, A, Side, Long); a relation is along or across;
lengths in inches. S is a section: section(S, MachineStoreys, BodyStoreys, MachineRoof, BodyRoof). double(yes): some tray is."""
import itertools
import re
import sys

ZONES = ["machine", "body", "bay"]


def inches(text):
    feet, rest = re.fullmatch(r"(\d+)'(?:(\d+)\")?", text).groups()
    return 12 * int(feet) + int(rest or 0)


def read_plan(line):
    trays, x = [], 0
    for text in line.split("|"):
        width, height, public, great, *zones = text.split()
        tray = {"x": (x, x + inches(width)), "double": height == "double", "public": public == "public", "great": great == "great", "zones": {}}
        for name, value in zip(ZONES, zones):
            if value != "empty":
                dense, depth = value.split(":")
                tray["zones"][name] = (dense == "dense", inches(depth))
        x = tray["x"][1]
        trays.append(tray)
    return trays


def depths(tray):
    """y of each zone: the body begins at 0, the machine is behind it, the bay before it."""
    made, y = {}, 0
    for name in ("body", "bay"):
        if name in tray["zones"]:
            made[name] = (y, y + tray["zones"][name][1])
            y = made[name][1]
    if "machine" in tray["zones"]:
        made["machine"] = (-tray["zones"]["machine"][1], 0)
    return made


def stand(trays, storeys):
    cells = []
    for t, tray in enumerate(trays):
        y = depths(tray)
        for zone in ZONES:
            for storey in range(storeys[zone] if zone in y else 0):
                cells.append({"tray": t, "zone": zone, "storey": storey, "x": tray["x"], "y": y[zone], "dense": tray["zones"][zone][0]})
    return cells


def less(of, taken):
    """What of a stretch is left."""
    left, at = [], of[0]
    for low, high in sorted(taken):
        if low > at:
            left.append((at, low))
        at = max(at, high)
    return left + ([(at, of[1])] if at < of[1] else [])


def overlap(a, b):
    return max(a[0], b[0]), min(a[1], b[1])


def faces(cells):
    beside, outside, above = [], [], []
    taken = {(i, side): [] for i in range(len(cells)) for side in ("left", "right", "back", "front")}
    for (i, a), (k, b) in itertools.permutations(enumerate(cells), 2):
        if a["storey"] == b["storey"] and a["x"][1] == b["x"][0] and overlap(a["y"], b["y"])[0] < overlap(a["y"], b["y"])[1]:
            part, sides = overlap(a["y"], b["y"]), ("right", "left")
        elif a["storey"] == b["storey"] and a["tray"] == b["tray"] and a["y"][1] == b["y"][0]:
            part, sides = a["x"], ("front", "back")
        else:
            if a["tray"] == b["tray"] and a["zone"] == b["zone"] and a["storey"] + 1 == b["storey"]:
                above.append((i, k))
            continue
        beside.append((i, k, "along" if a["tray"] != b["tray"] else "across", part[1] - part[0]))
        taken[i, sides[0]].append(part)
        taken[k, sides[1]].append(part)
    for i, c in enumerate(cells):
        for side, of in (("left", c["y"]), ("right", c["y"]), ("back", c["x"]), ("front", c["x"])):
            outside += [(i, side, high - low) for low, high in less(of, taken[i, side])]
    return beside, outside, above


def main():
    trays = read_plan(sys.argv[1])
    yes = lambda b: "yes" if b else "no"
    print(":- discontiguous section/5, cell/10, above/3, beside/5, outside/4.")
    print(f"double({yes(any(tray['double'] for tray in trays))}).")
    number = 0
    for machine, machine_roof, body, body_roof in itertools.product((1, 2), ("flat", "shed"), (1, 2), ("gable", "shed", "vault")):
        if machine > body or (machine_roof == "shed" and body_roof == "shed"):
            continue
        cells = stand(trays, {"machine": machine, "body": body, "bay": 1})
        for copy in range(4):  # the roof of bays and the cladding: no clause asks for them
            print(f"section({number}, {machine}, {body}, {machine_roof}, {body_roof}).")
            for i, c in enumerate(cells):
                tray = trays[c["tray"]]
                wide, deep = c["x"][1] - c["x"][0], c["y"][1] - c["y"][0]
                print(f"cell({number}, {i}, {c['zone']}, {c['storey']}, {wide}, {deep}, {yes(c['dense'])}, {yes(tray['great'])}, {yes(tray['public'])}, {yes(tray['double'])}).")
            beside, outside, above = faces(cells)
            for a, b, relation, long in beside:
                print(f"beside({number}, {a}, {b}, {relation}, {long}).")
            for a, side, long in outside:
                print(f"outside({number}, {a}, {side}, {long}).")
            for a, b in above:
                print(f"above({number}, {a}, {b}).")
            number += 1


main()
