#!/usr/bin/env python3
"""Reads a house's files with programs of its own, and holds them to each other: house_files.py FOLDER [READER] [--title TEXT] (FOLDER as
`tartan house -o FOLDER/` writes it). READER is ifc_read.cc, made: it has to find the same products with the same volumes in the IFC. TEXT is
what the house is called.

The IFC is parsed as STEP; each instance has to have as many attributes as IFC4 gives its entity, of their types (ISO 16739-1:2018, inherited ones
included), each reference has to lead to an instance of an entity that may stand there, and identifiers are unique. Volumes and numbers
of parts are those of the JSON, and so are names, letter by letter; every door hangs and swings as the plans in the DXF draw it. The DXF is
read as groups, and by ezdxf where that is installed; the IFC is validated by IfcOpenShell where that is installed."""
import argparse
import csv
import importlib.util
import json
import math
import re
import subprocess
import sys
from collections import Counter
from fractions import Fraction as F

import house_prisms

# The attributes of each entity, inherited ones first: S text, E enumeration, R real, I integer, N instance, A list of instances, V list of
# numbers, L list of such lists, D derived (*), B a value that is true or false. Small letters: it may be left out ($).
ROOT, PRODUCT = "Snss", "Snsssnn"
ELEMENT, SPATIAL = PRODUCT + "s", PRODUCT + "se"
TYPES = {
    "IFCAXIS2PLACEMENT2D": "Nn", "IFCAXIS2PLACEMENT3D": "Nnn", "IFCBUILDING": SPATIAL + "rrn",
    "IFCBUILDINGSTOREY": SPATIAL + "r", "IFCCARTESIANPOINT": "V", "IFCCARTESIANPOINTLIST3D": "L", "IFCCOLUMN": ELEMENT + "e", "IFCBEAM": ELEMENT + "e", "IFCDIRECTION": "V", "IFCDOOR": ELEMENT + "rrees",
    "IFCELEMENTQUANTITY": ROOT + "sA", "IFCEXTRUDEDAREASOLID": "NnNR", "IFCFURNITURE": ELEMENT + "e",
    "IFCGEOMETRICREPRESENTATIONCONTEXT": "ssIrNn", "IFCGEOMETRICREPRESENTATIONSUBCONTEXT": "ssDDDDNrEs", "IFCLOCALPLACEMENT": "nN",
    "IFCINDEXEDPOLYGONALFACE": "V", "IFCMATERIAL": "Sss", "IFCMATERIALLAYER": "nResssi", "IFCMATERIALLAYERSET": "Ass",
    "IFCMATERIALLAYERSETUSAGE": "NEERr", "IFCOPENINGELEMENT": ELEMENT + "e", "IFCPOLYGONALFACESET": "NEAv", "IFCPROPERTYSET": ROOT + "A", "IFCPROPERTYSINGLEVALUE": "SsBn", "IFCPRODUCTDEFINITIONSHAPE": "ssA", "IFCPROJECT": ROOT + "sssan",
    "IFCQUANTITYAREA": "SsnRs", "IFCQUANTITYVOLUME": "SsnRs", "IFCRAILING": ELEMENT + "e", "IFCRECTANGLEPROFILEDEF": "EsnRR", "IFCRELAGGREGATES": ROOT + "NA",
    "IFCRELASSOCIATESMATERIAL": ROOT + "AN", "IFCRELCONTAINEDINSPATIALSTRUCTURE": ROOT + "AN", "IFCRELDEFINESBYPROPERTIES": ROOT + "AN",
    "IFCRELFILLSELEMENT": ROOT + "NN", "IFCRELSPACEBOUNDARY": ROOT + "NNnEE", "IFCRELVOIDSELEMENT": ROOT + "NN", "IFCROOF": ELEMENT + "e",
    "IFCSHAPEREPRESENTATION": "NssA", "IFCSITE": SPATIAL + "vvrsn", "IFCSIUNIT": "DEeE", "IFCSLAB": ELEMENT + "e", "IFCSPACE": SPATIAL + "er",
    "IFCSTAIR": ELEMENT + "e", "IFCUNITASSIGNMENT": "A", "IFCWALL": ELEMENT + "e", "IFCWINDOW": ELEMENT + "rrees",
}
NUMBER = r"-?\d+(\.\d*(E[+-]?\d+)?)?"
WRITTEN = {
    "S": r"'([ -&(-\[\]-~]|''|\\\\|\\X2\\([0-9A-F]{4})+\\X0\\|\\X4\\([0-9A-F]{8})+\\X0\\)*'",
    "E": r"\.[A-Z0-9_]+\.", "R": r"-?\d+\.\d*(E[+-]?\d+)?", "I": r"-?\d+", "N": r"#\d+", "A": r"\(#\d+(,#\d+)*\)",
    "B": r"IFCBOOLEAN\(\.[TF]\.\)", "V": rf"\({NUMBER}(,{NUMBER})*\)", "L": rf"\(\({NUMBER}(,{NUMBER})*\)(,\({NUMBER}(,{NUMBER})*\))*\)", "D": r"\*",
}
# (entity, attribute) -> the values of its enumeration that houses have
VALUES = {
    ("IFCWALL", 8): "SOLIDWALL PARTITIONING", ("IFCSLAB", 8): "FLOOR BASESLAB ROOF", ("IFCRAILING", 8): "GUARDRAIL", ("IFCDOOR", 10): "DOOR", ("IFCWINDOW", 10): "WINDOW",
    ("IFCROOF", 8): "FLAT_ROOF SHED_ROOF GABLE_ROOF BARREL_ROOF HIP_ROOF NOTDEFINED",
    ("IFCMATERIALLAYERSETUSAGE", 1): "AXIS2 AXIS3", ("IFCMATERIALLAYERSETUSAGE", 2): "POSITIVE NEGATIVE", ("IFCRELSPACEBOUNDARY", 7): "PHYSICAL", ("IFCRELSPACEBOUNDARY", 8): "INTERNAL EXTERNAL", ("IFCSPACE", 8): "ELEMENT", ("IFCSPACE", 9): "INTERNAL EXTERNAL",
}
ELEMENTS = "IFCWALL IFCBEAM IFCCOLUMN IFCSLAB IFCROOF IFCSTAIR IFCRAILING IFCFURNITURE IFCDOOR IFCWINDOW".split()
PRODUCTS = ELEMENTS + ["IFCOPENINGELEMENT", "IFCSPACE", "IFCSITE", "IFCBUILDING", "IFCBUILDINGSTOREY"]
# attribute -> what it may refer to
REFERENCES = {
    ("IFCLOCALPLACEMENT", 0): ["IFCLOCALPLACEMENT"], ("IFCLOCALPLACEMENT", 1): ["IFCAXIS2PLACEMENT3D"],
    ("IFCEXTRUDEDAREASOLID", 0): ["IFCRECTANGLEPROFILEDEF"],
    ("IFCEXTRUDEDAREASOLID", 1): ["IFCAXIS2PLACEMENT3D"], ("IFCEXTRUDEDAREASOLID", 2): ["IFCDIRECTION"],
    ("IFCPOLYGONALFACESET", 0): ["IFCCARTESIANPOINTLIST3D"], ("IFCPOLYGONALFACESET", 2): ["IFCINDEXEDPOLYGONALFACE"],
    ("IFCSHAPEREPRESENTATION", 3): ["IFCEXTRUDEDAREASOLID", "IFCPOLYGONALFACESET"], ("IFCPRODUCTDEFINITIONSHAPE", 2): ["IFCSHAPEREPRESENTATION"],
    ("IFCRELVOIDSELEMENT", 4): ["IFCWALL"], ("IFCRELVOIDSELEMENT", 5): ["IFCOPENINGELEMENT"],
    ("IFCRELFILLSELEMENT", 4): ["IFCOPENINGELEMENT"], ("IFCRELFILLSELEMENT", 5): ["IFCDOOR", "IFCWINDOW"],
    ("IFCRELCONTAINEDINSPATIALSTRUCTURE", 4): ELEMENTS, ("IFCRELCONTAINEDINSPATIALSTRUCTURE", 5): ["IFCBUILDINGSTOREY"],
    ("IFCMATERIALLAYER", 0): ["IFCMATERIAL"], ("IFCMATERIALLAYERSET", 0): ["IFCMATERIALLAYER"], ("IFCMATERIALLAYERSETUSAGE", 0): ["IFCMATERIALLAYERSET"],
    ("IFCRELAGGREGATES", 4): ["IFCPROJECT", "IFCSITE", "IFCBUILDING", "IFCBUILDINGSTOREY", "IFCROOF"],
    ("IFCRELAGGREGATES", 5): ["IFCSITE", "IFCBUILDING", "IFCBUILDINGSTOREY", "IFCSPACE", "IFCSLAB"],
    ("IFCRELSPACEBOUNDARY", 4): ["IFCSPACE"], ("IFCRELSPACEBOUNDARY", 5): ["IFCWALL"],
    ("IFCRELDEFINESBYPROPERTIES", 5): ["IFCELEMENTQUANTITY", "IFCPROPERTYSET"], ("IFCPROPERTYSET", 4): ["IFCPROPERTYSINGLEVALUE"], ("IFCRELASSOCIATESMATERIAL", 5): ["IFCMATERIAL", "IFCMATERIALLAYERSET", "IFCMATERIALLAYERSETUSAGE"],
    ("IFCPROJECT", 8): ["IFCUNITASSIGNMENT"],
    **{(p, 5): ["IFCLOCALPLACEMENT"] for p in PRODUCTS}, **{(p, 6): ["IFCPRODUCTDEFINITIONSHAPE"] for p in PRODUCTS},
}
failures = []


def check(what, holds):
    if not holds:
        failures.append(what)


def arguments(text):
    """The attributes of an instance: split at commas outside of brackets and quotes."""
    parts, depth, quoted, start = [], 0, False, 0
    for i, c in enumerate(text):
        if c == "'":
            quoted = not quoted
        elif not quoted and c in "()":
            depth += 1 if c == "(" else -1
        elif not quoted and c == "," and depth == 0:
            parts.append(text[start:i])
            start = i + 1
    return parts + [text[start:]]


def read_ifc(path):
    text = open(path, encoding="ascii").read()
    check("a STEP file", text.startswith("ISO-10303-21;\nHEADER;\n") and text.endswith("ENDSEC;\nEND-ISO-10303-21;\n"))
    made = {}
    for line in text.split("DATA;\n")[1].split("ENDSEC;")[0].splitlines():
        number, name, inside = re.fullmatch(r"#(\d+)=(\w+)\((.*)\);", line).groups()
        check(f"#{number} once", int(number) not in made)
        made[int(number)] = (name, arguments(inside))
    return made


def references(argument):
    return [int(n) for n in re.findall(r"#(\d+)", re.sub(r"'[^']*'", "", argument))]


def spelt(argument):
    """What an IFC string says. A surrogate is no character of its own there (ISO 10303-21, 6.4.3)."""
    def written(found):
        digits, width = found.group(2), 4 if found.group(1) == "2" else 8
        numbers = [int(digits[i:i + width], 16) for i in range(0, len(digits), width)]
        check(f"{argument}: characters of Unicode", not any(0xD800 <= n < 0xE000 for n in numbers))
        check(f"{argument}: no shorter run does", width == 4 or all(n > 0xFFFF for n in numbers))
        return "".join(map(chr, numbers))

    check(f"{argument} is a string", re.fullmatch(WRITTEN["S"], argument))
    parts = re.split(r"\\X([24])\\([0-9A-F]+)\\X0\\", argument[1:-1])
    for i in range(0, len(parts), 3):
        parts[i] = parts[i].replace("''", "'").replace("\\\\", "\\")
    for i in range(1, len(parts), 3):
        parts[i + 1] = written(re.match(r"(.)(.*)", parts[i] + parts[i + 1]))
        parts[i] = ""
    return "".join(parts)


def check_ifc(made):
    ids = Counter()
    for number, (name, args) in made.items():
        check(f"{name}, known", name in TYPES)
        check(f"#{number}={name} has {len(args)} attributes", len(args) == len(TYPES.get(name, "")))
        for i, (argument, wanted) in enumerate(zip(args, TYPES.get(name, ""))):
            left_out = argument == "$" and wanted.islower()
            check(f"#{number}={name}: attribute {i} is {argument}", left_out or re.fullmatch(WRITTEN[wanted.upper()], argument))
            values = VALUES.get((name, i))
            check(f"#{number}={name}: {argument}", values is None or argument.strip(".") in values.split())
        for i, argument in enumerate(args):
            for to in references(argument):
                check(f"#{number} refers to #{to}", to in made)
                wanted = REFERENCES.get((name, i))
                check(f"#{number}={name}: {made[to][0]} as attribute {i}", wanted is None or made[to][0] in wanted)
        if name.startswith("IFCREL") or name in PRODUCTS or name in ("IFCPROJECT", "IFCELEMENTQUANTITY", "IFCPROPERTYSET"):
            check(f"#{number}: an identifier", re.fullmatch(r"'[0-3][0-9A-Za-z_$]{21}'", args[0]))
            ids[args[0]] += 1
    check("identifiers are unique", all(n == 1 for n in ids.values()))
    inside = Counter(to for name, args in made.values() if name == "IFCRELCONTAINEDINSPATIALSTRUCTURE" for to in references(args[4]))
    roofs = [args for name, args in made.values() if name == "IFCRELAGGREGATES" and made[references(args[4])[0]][0] == "IFCROOF"]
    inside += Counter(to for args in roofs for to in references(args[5]))
    for number, (name, _) in made.items():
        check(f"#{number}={name} is in one storey, or of a roof there", name not in ELEMENTS or inside[number] == 1)


def volume_of_faces(made, args):
    """Of a solid of flat faces: each of its edges is between two of them."""
    points = [tuple(F(c) for c in point.split(",")) for point in made[references(args[0])[0]][1][0].strip("()").split("),(")]
    rings = [[points[int(n) - 1] for n in made[face][1][0].strip("()").split(",")] for face in references(args[2])]
    edges = Counter((a, b) for ring in rings for a, b in zip(ring, ring[1:] + ring[:1]))
    check("a solid is closed", all(n == 1 and edges[b, a] == 1 for (a, b), n in edges.items()))
    total = F(0)
    for ring in rings:
        for b, c in zip(ring[1:], ring[2:]):
            u, v, w = ([p[k] - points[0][k] for k in range(3)] for p in (ring[0], b, c))
            total += sum(u[k] * (v[k - 2] * w[k - 1] - v[k - 1] * w[k - 2]) for k in range(3)) / 6
    check("and has a volume", total > 0)
    return total


def volume_of(made, product):
    """Cubic millimetres, of all solids of its shape."""
    total = F(0)
    if made[product][1][6] == "$":
        return total
    shape = made[references(made[product][1][6])[0]]
    for representation in references(shape[1][2]):
        for solid in references(made[representation][1][3]):
            if made[solid][0] == "IFCPOLYGONALFACESET":
                total += volume_of_faces(made, made[solid][1])
                continue
            profile, _, _, depth = made[solid][1]
            name, args = made[references(profile)[0]]
            area = F(args[3]) * F(args[4])
            check("a solid has a volume", area > 0 and F(depth) > 0)
            total += area * F(depth)
    return total


def has_leaf(kind):
    """The forms of these tests call openings that are leafless arches."""
    return not kind.endswith("arch")


def compare(made, house):
    of = lambda name: [n for n, (entity, _) in made.items() if entity == name]
    box = lambda s: F((s["box"][1] - s["box"][0]) * (s["box"][3] - s["box"][2]) * (s["box"][5] - s["box"][4]), 10**18)
    kinds = Counter(s["kind"] for s in house["solids"])
    walls = {(s["kind"], s["of"]) for s in house["solids"] if s["kind"] in ("outside", "party", "partition")}
    plain = {"wall", "party", "open", "floor", "stair"}
    wedges = house.get("wedges", [])
    flights = {s["of"] for s in house["solids"] if s["kind"] == "flight"} | {w["of"] for w in wedges}
    openings = [f for i, f in enumerate(house["faces"]) if f["kind"] not in plain and i not in flights]
    gables = {(r["of"], r.get("face")) for r in house["roofs"] if r["kind"] == "gable"}
    check("as many walls", len(of("IFCWALL")) == len(walls) + len(gables))
    check("as many posts", len(of("IFCCOLUMN")) == kinds["post"])
    slabs = {(r["of"], house_prisms.plane_of(house_prisms.corners_of(r), 3)) for r in house["roofs"] if r["kind"] == "roof"}
    check("as many slabs", len(of("IFCSLAB")) == kinds["deck"] + kinds["roofdeck"] + len(slabs))
    check("as many guards", len(of("IFCRAILING")) == kinds["guard"])
    check("as many things", len(of("IFCFURNITURE")) == kinds["item"])
    tops = {(house["cells"][of]["zone"], house["cells"][of]["storey"]) for of, _ in slabs}
    check("a roof for each zone and storey", len(of("IFCROOF")) == len(tops))
    beams = [s for s in house["solids"] if s["kind"] == "beam"]
    pockets = [n for n in of("IFCOPENINGELEMENT") if made[n][1][-1] == ".RECESS."]
    check("pockets are of beams", beams or not pockets)
    check("as many openings", len(of("IFCOPENINGELEMENT")) == len(openings) + len(pockets))
    check("as many beams, by their names", Counter(spelt(made[n][1][2]) for n in of("IFCBEAM")) == Counter(s["name"] for s in beams))
    check("as many doors and windows", len(of("IFCDOOR")) + len(of("IFCWINDOW")) == sum(has_leaf(f["kind"]) for f in openings))
    check("as many stairs", len(of("IFCSTAIR")) == sum(f["kind"] == "stair" for f in house["faces"]) + len(flights))
    check("as many rooms", len(of("IFCSPACE")) == len(house["rooms"]))
    named_as = lambda kind, name: [n for n in of(kind) if spelt(made[n][1][2]) == name]
    below = sum(volume_of(made, n) for n in named_as("IFCWALL", "gable"))
    over = sum(volume_of(made, n) for n in named_as("IFCSLAB", "roof"))
    solid = sum(volume_of(made, n) for n in of("IFCWALL")) - below - sum(volume_of(made, n) for n in of("IFCOPENINGELEMENT"))
    check("walls less openings", solid == sum(box(s) for s in house["solids"] if s["kind"] in ("outside", "party", "partition")))
    for entity, set_name in (("IFCWALL", "Pset_WallCommon"), ("IFCDOOR", "Pset_DoorCommon"), ("IFCWINDOW", "Pset_WindowCommon")):
        said = {to: made[references(made[references(args[5])[0]][1][4])[0]][1][2][-4:-2] == ".T" for name, args in made.values() if name == "IFCRELDEFINESBYPROPERTIES"
                and made[references(args[5])[0]][0] == "IFCPROPERTYSET" and spelt(made[references(args[5])[0]][1][2]) == set_name for to in references(args[4])}
        asked = [n for n in of(entity) if entity != "IFCWALL" or spelt(made[n][1][2]) in ("outside", "party", "partition")]  # not gables
        check(f"of each {entity} is said whether it is external", sorted(said) == sorted(asked))
        if entity == "IFCWALL":
            outer = {n for n in of(entity) if spelt(made[n][1][2]) == "outside"}
            check("walls that are external", {n for n in said if said[n]} == outer and len(outer) == len([w for w in walls if w[0] == "outside"]))
    rest = sum(volume_of(made, n) for name in ("IFCCOLUMN", "IFCBEAM", "IFCSLAB", "IFCFURNITURE", "IFCSTAIR", "IFCRAILING") for n in of(name)) - over
    winding = F(sum(map(house_prisms.volume_of, wedges))) / 10**18
    check("other boxes", rest == winding + sum(box(s) for s in house["solids"] if s["kind"] not in ("outside", "party", "partition")))
    materials = [spelt(made[n][1][0]) for n in of("IFCMATERIAL")]
    check("each material once", len(materials) == len(set(materials)))
    wanted = {p["material"] for p in house["parts"] if p.get("material") and int(p["number"])}
    check(f"materials {wanted - set(materials)}", wanted <= set(materials))
    named = lambda *names: Counter(spelt(made[n][1][2]) for name in names for n in of(name))
    check("rooms have their names", named("IFCSPACE") == Counter(r["function"] for r in house["rooms"]))
    check("doors and windows have theirs", named("IFCDOOR", "IFCWINDOW") == Counter(f["kind"] for f in openings if has_leaf(f["kind"])))
    check("things have theirs", named("IFCFURNITURE") == Counter(s["name"] for s in house["solids"] if s["kind"] == "item"))
    check("the project says the house", spelt(made[of("IFCPROJECT")[0]][1][3]) == house["house"])
    for kind, said in (("roof", over), ("gable", below)):  # mm3: points are rounded to 1e-6 nm
        wanted = sum(house_prisms.volume_of(r) for r in house["roofs"] if r["kind"] == kind)
        check(f"volume of {kind}s", abs(said - wanted / 10**18) < 1)


def read_again(reader, path, made):
    """By another program: as many products of each kind, and the same volumes to a millionth."""
    lines = subprocess.run([reader, path], capture_output=True, text=True, check=True).stdout.splitlines()
    read = {kind.upper(): (int(number), F(volume)) for kind, number, volume in map(str.split, lines)}
    for name in PRODUCTS:
        own = [n for n, (entity, _) in made.items() if entity == name]
        number, volume = read.get(name, (0, F(0)))
        check(f"{reader}: {number} {name}, not {len(own)}", number == len(own))
        wanted = F(0) if name in ("IFCSITE", "IFCBUILDING", "IFCBUILDINGSTOREY") else sum(volume_of(made, n) for n in own)
        check(f"{reader}: {name} hold {float(volume)}, not {float(wanted)}", abs(volume - wanted) <= wanted / 10**6 + F(1, 10**3))


# ---- layers


def layers_of(made, part, usage):
    """Where each layer of a wall or slab lies in the house: its name, the axis across it, and its two sides, in millimetres. IFC has them along the
    y axis of a wall's placement, or upwards in a slab, from an offset on, in the direction that is said."""
    layer_set, along, sense, offset, _ = made[usage][1]
    low, high, x, y, at = box_of(made, part)
    sign, place = (1 if sense == ".POSITIVE." else -1), F(offset)
    axis, step = (2, 1) if along == ".AXIS3." else (0, y[0]) if y[0] else (1, y[1])
    for layer in references(made[references(layer_set)[0]][1][0]):
        end = place + sign * F(made[layer][1][1])
        sides = sorted(at[axis] + step * p if axis < 2 else low[2] + p for p in (place, end))
        check("a layer is in its part", low[axis] <= sides[0] < sides[1] <= high[axis])
        yield spelt(made[layer][1][3]), axis, tuple(sides)
        place = end


def axis_of(solid):
    """Across which axis a solid is cut into layers: of these there are two or more in the forms of these tests."""
    first, second = (layer["box"] for layer in solid["layers"][:2])
    return next(k for k in range(3) if first[2 * k] != second[2 * k])


def check_layers(made, house):
    """Those of each wall and slab are those of the solids in the JSON; posts, roofs and walls below these have theirs as a set alone."""
    wanted, alone, walls = Counter(), Counter(), set()
    for solid in (s for s in house["solids"] if "layers" in s):
        names, axis = tuple(layer["name"] for layer in solid["layers"]), axis_of(solid)
        wall = solid["kind"] in ("outside", "party", "partition")
        if solid["kind"] == "post":
            alone["IFCCOLUMN", names] += 1
        elif not wall or solid["of"] not in walls:
            sides = (tuple(F(n, 10**6) for n in layer["box"][2 * axis:2 * axis + 2]) for layer in solid["layers"])
            wanted[tuple((name, axis, side) for name, side in zip(names, sides))] += 1
        walls |= {solid["of"]} if wall else set()
    found, sets, below = Counter(), Counter(), Counter()
    slabs = {(r["of"], house_prisms.plane_of(house_prisms.corners_of(r), 3), tuple(l["name"] for l in r["layers"])) for r in house["roofs"] if r["kind"] == "roof" and "layers" in r}
    alone += Counter(("IFCSLAB", names) for _, _, names in slabs)
    gables = {(r["of"], r["face"]) for r in house["roofs"] if r["kind"] == "gable" and "layers" in r}
    for name, args in made.values():
        usage = references(args[5])[0] if name == "IFCRELASSOCIATESMATERIAL" else None
        of = made[usage][0] if usage else None
        for part in references(args[4]) if of in ("IFCMATERIALLAYERSET", "IFCMATERIALLAYERSETUSAGE") else []:
            below_it = made[part][0] == "IFCWALL" and spelt(made[part][1][2]) == "gable"
            lone = made[part][0] == "IFCCOLUMN" or below_it or spelt(made[part][1][2]) == "roof"
            check(f"{made[part][0]} has {of}", (of == "IFCMATERIALLAYERSET") == lone)
            if lone:
                names = tuple(spelt(made[n][1][3]) for n in references(made[usage][1][0]))
                (below if below_it else sets)[made[part][0], names] += 1
            else:
                found[tuple(layers_of(made, part, usage))] += 1
    check("layers of walls and slabs", found == wanted)
    check("layers of posts and roofs", sets == alone)
    check("layers of walls below roofs", below.total() == len(gables) and {l["name"] for r in house["roofs"] if "face" in r for l in r["layers"]} <= {n for _, names in below for n in names})


# ---- where doors hang


def box_of(made, product):
    """The box of a product in the house: its two corners, and the directions of its x and y axes. Its shape is one extruded rectangle."""
    args = made[product][1]
    solid = made[references(made[references(made[references(args[6])[0]][1][2])[0]][1][3])[0]][1]
    profile = made[references(solid[0])[0]][1]
    middle = numbers_of(made, references(made[references(profile[2])[0]][1][0])[0])
    wide, deep, high = F(profile[3]), F(profile[4]), F(solid[3])
    low = [middle[0] - wide / 2, middle[1] - deep / 2, F(0)]
    at, x, y = placed(made, references(args[5])[0])
    ends = [[at[k] + (low[0] + i * wide) * x[k] + (low[1] + i * deep) * y[k] + (k == 2) * (low[2] + i * high) for k in range(3)] for i in (0, 1)]
    return [min(a, b) for a, b in zip(*ends)], [max(a, b) for a, b in zip(*ends)], x, y, at


def numbers_of(made, instance):
    return [F(n) for n in made[instance][1][0].strip("()").split(",")]


def placed(made, placement):
    """The origin, x and y of a placement in the house; z is up."""
    within, axes = made[placement][1]
    point, _, along = made[references(axes)[0]][1]
    at, x = numbers_of(made, references(point)[0]), numbers_of(made, references(along)[0]) if along != "$" else [F(1), F(0), F(0)]
    y = [-x[1], x[0], F(0)]
    if within == "$":
        return at, x, y
    origin, u, v = placed(made, references(within)[0])
    turned = lambda d: [d[0] * u[k] + d[1] * v[k] + (k == 2) * d[2] for k in range(3)]
    return [o + t for o, t in zip(origin, turned(at))], turned(x), turned(y)


def leaves_of(made, door, opening):
    """The leaves of a door: hinge, tip where it is open, and tip where it is shut, on the side of the wall to which it swings. By IFC, hinges
    are at the left or right of who looks along the y axis of the door, which opens to there."""
    low, high, x, y, at = box_of(made, door)
    wide, kind = F(made[door][1][9]), made[door][1][11].strip(".")
    ends = {"SINGLE_SWING_LEFT": [(F(0), wide)], "SINGLE_SWING_RIGHT": [(wide, F(0))],
            "DOUBLE_DOOR_SINGLE_SWING": [(F(0), wide / 2), (wide, wide / 2)]}.get(kind, [])
    slides = kind in ("SLIDING_TO_LEFT", "SLIDING_TO_RIGHT", "DOUBLE_DOOR_SLIDING")
    check(f"{kind} is how a door opens", ends or slides)
    hole = box_of(made, opening)
    axis = 0 if y[0] else 1
    check("what fills an opening is as wide and high as it", all(low[k] == hole[0][k] and high[k] == hole[1][k] for k in range(3) if k != axis))
    check("and in its wall", hole[0][axis] <= low[axis] < high[axis] <= hole[1][axis])
    side = (hole[1] if y[axis] > 0 else hole[0])[axis]
    for hinge, shut in ends:
        foot = [side if k == axis else at[k] + hinge * x[k] for k in range(2)]
        yield tuple(foot), tuple(c + abs(shut - hinge) * d for c, d in zip(foot, y)), tuple(c + (shut - hinge) * d for c, d in zip(foot, x))


def blocks_of(groups):
    """The widths of doors, by the names of their blocks: a line from the hinge, and a quarter of a circle about it."""
    widths, block, kind = {}, None, None
    for code, value in groups:
        kind = value if code == "0" else kind
        if kind == "BLOCK" and code == "2":
            block = value
        elif kind == "LINE" and code == "21" and block and block.startswith("DOOR-"):
            widths[block] = F(value)
        elif kind == "ENDBLK":
            block = None
    return widths


def drawn_leaves(groups, drawing):
    """The same of a plan, whose front is below: a symbol at the hinge, open upwards and shut to its right before it is mirrored and turned."""
    quarter, widths = [(1, 0), (0, 1), (-1, 0), (0, -1)], blocks_of(groups)
    for door in (e for e in drawing if e["0"] == "INSERT" and e["2"].startswith("DOOR-")):
        turn, wide = int(float(door["50"])) // 90, widths[door["2"]] * scale_of(groups)
        along, up = quarter[turn], quarter[(turn + 1) % 4]
        hinge = tuple(-c for c in door["points"][0])
        tips = [tuple(c - wide * d for c, d in zip(hinge, way)) for way in (up, tuple(F(door["41"]) * d for d in along))]
        yield hinge, tips[0], tips[1]


def near(a, b):
    return all(abs(c - d) < F(1, 1000) for c, d in zip(a, b))                     # a micrometre


def scale_of(groups):
    """Millimetres a unit."""
    at = groups.index(("9", "$INSUNITS"))
    return {"1": F(254, 10), "4": F(1)}[groups[at + 1][1].strip()]


def drawings_of(groups):
    """The drawings in model space of a DXF file, by their titles: each is a list of entities, group by group, with their points in millimetres."""
    begin = next(i for i, group in enumerate(groups) if group == ("2", "ENTITIES"))
    found, drawing, scale = {}, [], scale_of(groups)
    for code, value in groups[begin + 1:]:
        if code == "0" and drawing and drawing[-1]["8"] == "A-ANNO-TTLB":
            found[unescaped(drawing[-1]["1"])] = drawing
            drawing = []
        if code == "67" or (code == "0" and value == "ENDSEC"):               # what follows is on the sheet
            break
        if code == "0":
            drawing.append({"8": None, "points": []})
        if code in ("10", "11"):
            drawing[-1]["points"].append((F(value) * scale,))
        elif code in ("20", "21"):
            drawing[-1]["points"][-1] += (F(value) * scale,)
        drawing[-1][code] = value
    return found


def check_doors(made, house, groups):
    """On the plan of each storey, as the model says. The plans are moved to where the house stands by the ends of its walls."""
    plans = drawings_of(groups)
    contained = {to: references(args[5])[0] for name, args in made.values() if name == "IFCRELCONTAINEDINSPATIALSTRUCTURE" for to in references(args[4])}
    filled = {references(args[5])[0]: references(args[4])[0] for name, args in made.values() if name == "IFCRELFILLSELEMENT"}
    for storey, (name, args) in made.items():
        if name != "IFCBUILDINGSTOREY":
            continue
        inside = [n for n in contained if contained[n] == storey and made[n][0] in ("IFCWALL", "IFCCOLUMN") and spelt(made[n][1][2]) != "gable"]
        plan = plans.get("plan, " + spelt(args[2]))
        check(f"a plan of {args[2]}", plan)
        if not inside or not plan:
            continue
        corner = [min(-point[k] for e in plan if e["8"] == "A-WALL" for point in e["points"]) for k in (0, 1)]
        moved = [min(box_of(made, n)[0][k] for n in inside) - corner[k] for k in range(2)]
        drawn = [tuple(tuple(c + m for c, m in zip(point, moved)) for point in leaf) for leaf in drawn_leaves(groups, plan)]
        doors = [n for n in contained if contained[n] == storey and made[n][0] == "IFCDOOR"]
        hung = [leaf for n in doors for leaf in leaves_of(made, n, filled[n])]
        check(f"{len(hung)} leaves in {args[2]}, and {len(drawn)} drawn", len(hung) == len(drawn))
        for leaf in hung:
            same = [other for other in drawn if all(map(near, leaf, other))]
            check(f"a leaf in {args[2]} at {[float(c) for c in leaf[0]]} hangs as it is drawn", len(same) == 1)
    for window in (n for n, (name, _) in made.items() if name == "IFCWINDOW"):
        low, high, x, _, _ = box_of(made, window)
        check("a window is as wide as it says, along its x axis", high[0 if x[0] else 1] - low[0 if x[0] else 1] == F(made[window][1][9]))


def unescaped(text):
    """What a DXF text says."""
    check(f"{text} has numbers for backslashes, and blanks after carets", re.fullmatch(r"([^\\^]|\^ |\\U\+005C)*", text))
    return text.replace("\\U+005C", "\\").replace("^ ", "^")


def read_dxf(path):
    lines = open(path, encoding="utf-8").read().split("\n")
    return list(zip(lines[0:-1:2], lines[1::2]))


def check_whole(title, drawing):
    """No two lines of a layer lie in one line and touch: an edge is one line. (Not those of doors, stairs and furniture, which are symbols.)"""
    by_line = {}
    for e in (e for e in drawing if e["0"] == "LINE" and e["8"] not in ("A-DOOR", "A-FLOR-STRS", "A-WALL-PATT", "A-FURN", "P-FIXT", "A-FLOR-OVHD")):
        (a, b), (c, d) = (tuple(map(float, point)) for point in e["points"])
        for along, across, low, high in ((0, b, a, c), (1, a, b, d)):
            if abs((d - b) if along == 0 else (c - a)) < 1e-6:
                by_line.setdefault((e["8"], along, round(across, 3)), []).append((min(low, high), max(low, high)))
    for key, pieces in by_line.items():
        pieces.sort()
        touching = [(p, q) for p, q in zip(pieces, pieces[1:]) if q[0] < p[1] + 9e-4]
        check(f"{title}: {key} is one line, not {touching[:1]}", not touching)


def check_dxf(path, groups, house):
    check("codes are numbers", all(code.strip().isdigit() for code, _ in groups))
    check("ends", groups[-1] == ("0", "EOF"))
    layers, at, known, used = [], None, set(), Counter()
    for code, value in groups:
        if code == "0":
            at = value
        elif code == "2" and at == "LAYER":
            known.add(value)
        elif code == "8":
            used[value] += 1
    check(f"layers {set(used) - known}", set(used) <= known)
    said = {unescaped(e["1"]) for drawing in drawings_of(groups).values() for e in drawing if e.get("8") == "A-AREA-IDEN"}
    names = {text for text in said if not re.fullmatch(r"[\d.]+( (sf|m\u00b2))?", text)}
    net = [float(F(r["net"]) / F(10) ** 18) for r in house["rooms"]]
    written = {f"{area:.1f} m\u00b2" for area in net} | {f"{area / 0.3048 ** 2:.0f} sf" for area in net}
    check("areas are net", {text for text in said if text.endswith(("sf", "\u00b2"))} <= written)
    check("as many numbers as rooms", len([text for text in said if re.fullmatch(r"[\d.]+", text)]) >= len(net))
    for title, drawing in drawings_of(groups).items():
        check_whole(title, drawing)
    rooms = {re.sub("[-_]", " ", r["function"]) for r in house["rooms"]}
    # Small rooms have their number alone: its name is in a table.
    check(f"names {names} are of the rooms {rooms}", (names or max(net) < 5) and all(any(room.startswith(name) for room in rooms) for name in names))
    for layer in ("A-WALL", "A-WALL-BYND", "A-FLOR-SECT", "A-WALL-PATT", "A-ANNO-DIMS", "A-AREA-IDEN", "A-ANNO-TTLB"):
        check(f"something is on {layer}", used[layer])
    try:
        import ezdxf
    except ImportError:
        return
    document = ezdxf.readfile(path)
    auditor = document.audit()
    check("ezdxf finds nothing", not auditor.errors and not auditor.fixes)
    read = {unescaped(entity.dxf.text) for entity in document.modelspace().query("TEXT")}
    check("ezdxf reads the same names", said <= read)


def validate(path):
    """By the validator of IfcOpenShell, with the rules of the schema, where that is installed."""
    if importlib.util.find_spec("ifcopenshell") is None:
        return
    command = [sys.executable, "-m", "ifcopenshell.validate", "--rules", "--json", path]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    said = [json.loads(line) for line in ran.stdout.splitlines() if line.startswith("{")]
    for entry in said:
        check(f"IfcOpenShell: {entry.get('message')}", str(entry.get("level")).lower() not in ("error", "critical"))
    check(f"IfcOpenShell ends with {ran.returncode}: {ran.stderr[-200:]}", ran.returncode == 0 or said)


def slope(rise, way):
    """How much longer a slope is than its plan, rounded down to a billionth."""
    square = 1 + (rise / way) ** 2
    return F(math.isqrt(square.numerator * 10**18 // square.denominator), 10**9)


def below_roofs(house):
    """The area of the walls below roofs: an outside wall is as thick as a wall."""
    thick = {min(s["box"][1] - s["box"][0], s["box"][3] - s["box"][2]) for s in house["solids"] if s["kind"] == "outside"}
    volume = sum(house_prisms.volume_of(r) for r in house["roofs"] if r["kind"] == "gable" and "layers" not in r)
    return volume / max(thick) if volume else 0


def check_parts(path, house):
    """The table of parts, worked out again from the boxes and the lines of the roofs; money to the cent."""
    kind_of = {"outside": "wall", "party": "party", "partition": "partition", "post": "post", "deck": "deck", "roofdeck": "deck", "guard": "guard"}
    area, volume, number = Counter(), Counter(), Counter()
    walls, guards = set(), set()
    for s in house["solids"]:
        part = house["faces"][s["of"]]["kind"] if s["kind"] == "flight" else kind_of.get(s["kind"]) or s["name"]
        x, y, z = (s["box"][i + 1] - s["box"][i] for i in (0, 2, 4))
        for layer in s.get("layers", []):
            sides = [layer["box"][i + 1] - layer["box"][i] for i in (0, 2, 4)]
            area[layer["name"]] += math.prod(sides) // sides[axis_of(s)]
            volume[layer["name"]] += math.prod(sides)
            number[layer["name"]] += part not in ("wall", "party", "partition") or s["of"] not in walls
        if "layers" in s:
            walls |= {s["of"]} if part in ("wall", "party", "partition") else set()
        elif part in ("wall", "party", "partition"):
            at = house["faces"][s["of"]]["at"]
            area[part] += (y if at[0] == at[1] else x) * z
            number[part] += s["of"] not in walls
            walls.add(s["of"])
        else:
            area[part] += x * y if s["kind"] in ("deck", "roofdeck", "item", "flight") else max(x, y) * z
            number[part] += s["kind"] != "flight" and not (s["kind"] == "guard" and s["of"] in guards)
            guards |= {s["of"]} if s["kind"] == "guard" else set()
        volume[part] += 0 if "layers" in s else x * y * z
    roofed = set()
    for r in house["roofs"]:
        for name, piece in [(l["name"], l) for l in r.get("layers", [])] or [("wall" if r["kind"] == "gable" else "roof", r)]:
            held = house_prisms.volume_of(piece)
            volume[name] += held
            if r["kind"] == "roof":
                p, q, _ = house_prisms.plane_of(house_prisms.corners_of(r), 3)
                area[name] += house_prisms.plan_of(r) * slope(abs(p + q), 1)
                number[name] += r["of"] not in roofed
            elif "layers" in r:
                area[name] += held / piece["thick"]
        roofed |= {r["of"]} if r["kind"] == "roof" else set()
    steps = {(w["of"], tuple(map(tuple, (c[:2] for c in w["corners"])))): w for w in house.get("wedges", [])}  # each has two pieces
    for w in steps.values():
        area[house["faces"][w["of"]]["kind"]] += house_prisms.plan_of(w)
    for w in house.get("wedges", []):
        volume[house["faces"][w["of"]]["kind"]] += house_prisms.volume_of(w)
    for f in house["faces"]:
        number[f["kind"]] += f["kind"] not in ("wall", "party", "open", "floor", "stair") and has_leaf(f["kind"])
    unit = {"each": 1, "sf": 304800000**2, "m2": 10**18, "cf": 304800000**3, "m3": 10**27}
    total = F(0)
    rows = list(csv.DictReader(open(path, newline="")))
    given = {p["part"]: p for p in house["parts"]}
    for row in rows:
        part = row["part"]
        if part == "total":
            check("the total is the sum of the lines", F(row["cost"]) == total == F(house["cost"]))
            continue
        check(f"{part}: as many", int(row["number"]) == number[part] == given[part]["number"])
        if part in area:
            if part == "wall":  # what stands below roofs is as wide and high as if it were as thick as a wall all over
                area[part] += below_roofs(house)
            check(f"{part}: as large", F(given[part]["area"]) == area[part] and F(given[part]["volume"]) == volume[part])
            for column, size in (("area", area[part]), ("volume", volume[part])):
                in_unit, at = next((u, f"{column}_{u}") for u in ("sf", "m2", "cf", "m3") if f"{column}_{u}" in row)
                check(f"{part}: {at}", abs(F(row[at]) - F(size) / unit[in_unit]) <= F(1, 2000000))
        if row["cost"]:
            size = {"each": number[part], "sf": F(given[part]["area"]), "m2": F(given[part]["area"])}.get(row["per"], F(given[part]["volume"]))
            cents = math.floor(F(row["price"]) * size / unit[row["per"]] * 100 + F(1, 2))
            check(f"{part}: {row['cost']}", F(row["cost"]) * 100 == cents)
            total += F(row["cost"])
    check("every part is in the table", {p for p in number if number[p]} | {p for p in volume if volume[p]} == {r["part"] for r in rows} - {"total"})


parser = argparse.ArgumentParser()
parser.add_argument("folder")
parser.add_argument("reader", nargs="?")
parser.add_argument("--title")
options = parser.parse_args()
folder = options.folder
made = read_ifc(folder + "/house.ifc")
check_ifc(made)
house = json.load(open(folder + "/house.json"))
compare(made, house)
check_parts(folder + "/house.parts.csv", house)
groups = read_dxf(folder + "/house.dxf")
check_dxf(folder + "/house.dxf", groups, house)
check_doors(made, house, groups)
check_layers(made, house)
title = [spelt(args[2]) for name, args in made.values() if name in ("IFCPROJECT", "IFCBUILDING")]
check(f"the house is called {title[0]}", options.title is None or title == [options.title] * 2)
validate(folder + "/house.ifc")
if options.reader:
    read_again(options.reader, folder + "/house.ifc", made)
print("\n".join(failures[:20]) or "fine")
