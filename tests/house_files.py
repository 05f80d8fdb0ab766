#!/usr/bin/env python3
"""Reads a house's files with programs of its own, and holds them to each other: house_files.py FOLDER [READER] [--title TEXT] [--form FILE] (FOLDER as
`tartan house -o FOLDER/` writes it). READER is ifc_read.cc, made: it has to find the same products with the same volumes in the IFC. TEXT is
what the house is called, FILE the one that its form is in: for the codes of classifications.

The IFC is held to the rules of ifc_file.py. Volumes and numbers of parts are those of the JSON, and so are names, letter by letter; walls meet
where their faces do, and take up what the JSON has as posts there; spaces are bounded by what is around them; every door hangs and swings as the
plans in the DXF draw it. The DXF is read as groups, and by ezdxf where that is installed; the IFC is validated by IfcOpenShell where that is
installed."""
import argparse
import csv
import importlib.util
import json
import math
import re
import subprocess
import sys
from collections import Counter, defaultdict
from fractions import Fraction as F

import house_prisms
from ifc_file import ELEMENTS, PRODUCTS, box_of, boxes_of, check, check_file, findings, in_millimetres, is_in_feet, numbers_of, of_kind, placed, points_of, read, references, related, rings_of, sets_of, solids_of, spelt, volume_of


def has_leaf(kind):
    """The forms of these tests call openings that are leafless arches."""
    return not kind.endswith("arch")


WALLS = ("outside", "party", "partition")


def free_posts(house):
    """Those that no wall takes: none that ends there is as thick; or all, if the form makes posts of something of which it makes no wall."""
    materials = {p["part"]: p.get("material") for p in house["parts"]}
    apart = materials.get("post") and materials["post"] not in {materials.get(part) for part in ("wall", "party", "partition")}
    layered = any("layers" in s for s in house["solids"])
    walls = [s["box"] for s in house["solids"] if s["kind"] in WALLS]

    def ends_at(wall, post, k):
        """Along x (k = 0) or y."""
        across = slice(2, 4) if k == 0 else slice(0, 2)
        return wall[across] == post[across] and (wall[2 * k] == post[2 * k + 1] or wall[2 * k + 1] == post[2 * k]) and wall[4] < post[5] and post[4] < wall[5]

    posts = [s["box"] for s in house["solids"] if s["kind"] == "post"]
    return [p for p in posts if (apart and not layered) or not any(ends_at(w, p, k) for w in walls for k in (0, 1))]


def compare(made, house):
    of = lambda name: of_kind(made, name)
    box = lambda s: F((s["box"][1] - s["box"][0]) * (s["box"][3] - s["box"][2]) * (s["box"][5] - s["box"][4]), 10**18)
    kinds = Counter(s["kind"] for s in house["solids"])
    walls = {(s["kind"], s["of"]) for s in house["solids"] if s["kind"] in WALLS}
    plain = {"wall", "party", "open", "floor", "stair"}
    wedges = house.get("wedges", [])
    flights = {s["of"] for s in house["solids"] if s["kind"] == "flight"} | {w["of"] for w in wedges}
    openings = [f for i, f in enumerate(house["faces"]) if f["kind"] not in plain and i not in flights]
    gables = {(r["of"], r.get("face")) for r in house["roofs"] if r["kind"] == "gable"}
    check("as many walls", len(of("IFCWALL")) == len(walls) + len(gables))
    beams = [s for s in house["solids"] if s["kind"] == "beam"]
    if not beams:  # which cut posts
        check("posts that stand free", len(of("IFCCOLUMN")) == len(free_posts(house)))
    slabs = {(r["of"], house_prisms.plane_of(house_prisms.corners_of(r), 3)) for r in house["roofs"] if r["kind"] == "roof"}
    decks = {s["of"] for s in house["solids"] if s["kind"] == "deck"}
    tops = {house["cells"][s["of"]]["storey"] for s in house["solids"] if s["kind"] == "roofdeck"}
    by_kind = Counter(made[n][1][8].strip(".") for n in of("IFCSLAB"))
    check("a slab for each deck and each plane of the roof", by_kind["FLOOR"] + by_kind["BASESLAB"] == len(decks) + len(tops) and by_kind["ROOF"] == len(slabs))
    check("as many guards", len(of("IFCRAILING")) == kinds["guard"])
    check("as many things", len(of("IFCFURNITURE")) == kinds["item"])
    check("one roof", len(of("IFCROOF")) == bool(slabs))
    pockets = [n for n in of("IFCOPENINGELEMENT") if made[n][1][-1] == ".RECESS."]
    check("pockets are of beams", beams or not pockets)
    check("as many openings", len(of("IFCOPENINGELEMENT")) == len(openings) + len(pockets))
    check("as many beams, by their names", Counter(spelt(made[n][1][2]) for n in of("IFCBEAM")) == Counter(s["name"] for s in beams))
    check("as many doors and windows", len(of("IFCDOOR")) + len(of("IFCWINDOW")) == sum(has_leaf(f["kind"]) for f in openings))
    check("as many stairs", len(of("IFCSTAIR")) == sum(f["kind"] == "stair" for f in house["faces"]) + len(flights))
    check("as many rooms", len(of("IFCSPACE")) == len(house["rooms"]))
    check("a zone for each function", Counter(made[n][1][2] for n in of("IFCZONE")) == Counter({f"'{r['function']}'": 1 for r in house["rooms"]}) or not all(r["function"].isascii() for r in house["rooms"]))
    named_as = lambda kind, name: [n for n in of(kind) if spelt(made[n][1][2]) == name]
    below = sum(volume_of(made, n) for n in named_as("IFCWALL", "gable"))
    over = sum(volume_of(made, n) for n in named_as("IFCSLAB", "roof"))
    standing = sum(volume_of(made, n) for n in of("IFCWALL") + of("IFCCOLUMN")) - below - sum(volume_of(made, n) for n in of("IFCOPENINGELEMENT"))
    check("walls less openings, and posts", standing == sum(box(s) for s in house["solids"] if s["kind"] in WALLS + ("post",)))
    for entity, set_name in (("IFCWALL", "Pset_WallCommon"), ("IFCDOOR", "Pset_DoorCommon"), ("IFCWINDOW", "Pset_WindowCommon")):
        said = {product: ".T." in values["IsExternal"] for product, name, values in sets_of(made, "IFCPROPERTYSET") if name == set_name and "IsExternal" in values}
        asked = [n for n in of(entity) if entity != "IFCWALL" or spelt(made[n][1][2]) in WALLS]  # not gables
        check(f"of each {entity} is said whether it is external", set(asked) <= set(said) <= set(of(entity)))
        if entity == "IFCWALL":
            outer = {n for n in asked if spelt(made[n][1][2]) == "outside"}
            check("walls that are external", {n for n in asked if said[n]} == outer and len(outer) == len([w for w in walls if w[0] == "outside"]))
            bears = {product for product, name, values in sets_of(made, "IFCPROPERTYSET") if name == set_name and ".T." in values.get("LoadBearing", "")}
            check("walls that bear", bears == {n for n in asked if spelt(made[n][1][2]) != "partition"})
    rest = sum(volume_of(made, n) for name in ("IFCBEAM", "IFCSLAB", "IFCFURNITURE", "IFCSTAIRFLIGHT", "IFCRAILING") for n in of(name)) - over
    winding = F(sum(map(house_prisms.volume_of, wedges))) / 10**18
    check("other boxes", rest == winding + sum(box(s) for s in house["solids"] if s["kind"] not in WALLS + ("post",)))
    materials = [spelt(made[n][1][0]) for n in of("IFCMATERIAL")]
    check("each material once", len(materials) == len(set(materials)))
    wanted = {p["material"] for p in house["parts"] if p.get("material") and int(p["number"])}
    if not free_posts(house):
        wanted -= {p.get("material") for p in house["parts"] if p["part"] == "post"} - {p.get("material") for p in house["parts"] if p["part"] != "post" and int(p["number"])}
    check(f"materials {wanted - set(materials)}", wanted <= set(materials))
    named = lambda *names: Counter(spelt(made[n][1][2]) for name in names for n in of(name))
    long_names = Counter(spelt(made[n][1][7]) for n in of("IFCSPACE"))
    check("rooms have their names", long_names == Counter(re.sub("[-_]", " ", r["function"]) for r in house["rooms"]))
    check("and numbers", all(n == 1 and re.fullmatch(r"\d+(\.\d\d+)?", name) for name, n in named("IFCSPACE").items()))
    check("doors and windows have theirs", named("IFCDOOR", "IFCWINDOW") == Counter(f["kind"] for f in openings if has_leaf(f["kind"])))
    check("things have theirs", named("IFCFURNITURE") == Counter(s["name"] for s in house["solids"] if s["kind"] == "item"))
    check("the project says the house", spelt(made[of("IFCPROJECT")[0]][1][3]) == house["house"])
    for kind, said in (("roof", over), ("gable", below)):  # mm3: points are rounded to 1e-6 nm
        wanted = sum(house_prisms.volume_of(r) for r in house["roofs"] if r["kind"] == kind)
        check(f"volume of {kind}s", abs(said - wanted / 10**18) < 1)


# ---- quantities, walls, stairs and spaces


def check_quantities(made, house):
    """What sets of quantities say is what solids have; areas are those of the rooms."""
    voids = defaultdict(list)
    for wall, opening in related(made, "IFCRELVOIDSELEMENT", 4, 5):
        voids[wall].append(opening)
    decks = [s for s in house["solids"] if s["kind"] in ("deck", "roofdeck")]
    near = lambda said, is_so: abs(F(said) - is_so) <= F(1, 10**6) + is_so / 10**6
    for product, name, values in sets_of(made, "IFCELEMENTQUANTITY"):
        args = made[product][1]
        if "NetVolume" in values:
            volume = volume_of(made, product) - sum(volume_of(made, n) for n in voids[product])
            check(f"{name} says {values['NetVolume']} m3 of {float(volume / 10**9)}", near(values["NetVolume"], volume / 10**9))
        if made[product][0] in ("IFCDOOR", "IFCWINDOW"):
            check("sizes of what fills an opening", (F(values["Height"]), F(values["Width"])) == (F(args[8]), F(args[9])))
            check("its area", near(values["Area"], F(args[8]) * F(args[9]) / 10**6))
        if made[product][0] == "IFCWALL" and "Length" in values:
            low, high, x, _, _ = box_of(made, product)
            along = 0 if x[0] else 1
            sizes = [high[along] - low[along], high[1 - along] - low[1 - along], high[2] - low[2]]
            check("sizes of a wall", [F(values[n]) for n in ("Length", "Width", "Height")] == sizes)
            check("net side of a wall", near(F(values["NetSideArea"]) * sizes[1] / 1000, F(values["NetVolume"])))
        if made[product][0] == "IFCSLAB" and made[product][1][8] in (".FLOOR.", ".BASESLAB."):
            boxes = list(boxes_of(made, product))
            solid = [s for s in decks if F(s["box"][5], 10**6) == boxes[0][1][2]]
            check("area of a deck", near(values["NetArea"], sum((high[0] - low[0]) * (high[1] - low[1]) for low, high in boxes) / 10**6))
            meets = lambda s, low, high: math.prod(max(min(high[k], F(s["box"][2 * k + 1], 10**6)) - max(low[k], F(s["box"][2 * k], 10**6)), 0) for k in range(3))
            check("a deck is where its rectangles are", all(sum(meets(s, low, high) for s in solid) == math.prod(h - l for l, h in zip(low, high)) for low, high in boxes))
            profiles = [references(made[n][1][0])[0] for n in solids_of(made, product)]
            if all(made[n][0] != "IFCRECTANGLEPROFILEDEF" for n in profiles):
                around = sum(abs(a[0] - b[0]) + abs(a[1] - b[1]) for n in profiles for ring in rings_of(made, n)[:1] for a, b in zip(ring, ring[1:] + ring[:1]))
                check("its outline", near(values["Perimeter"], around))
                check("of one hole at most", all(len(rings_of(made, n)) <= 2 for n in profiles))
    said = Counter(round(float(F(values["NetFloorArea"])), 4) for _, name, values in sets_of(made, "IFCELEMENTQUANTITY") if name == "Qto_SpaceBaseQuantities")
    check("net areas of rooms", said == Counter(round(float(F(r["net"]) / 10**18), 4) for r in house["rooms"]))
    slopes = [F(values["NetArea"]) for product, _, values in sets_of(made, "IFCELEMENTQUANTITY") if made[product][1][8] == ".ROOF."]
    whole = [F(values["NetArea"]) for _, name, values in sets_of(made, "IFCELEMENTQUANTITY") if name == "Qto_RoofBaseQuantities"]
    check("the roof is as large as its slabs", not whole or near(whole[0], sum(slopes)))


def check_walls(made, house):
    """Boxes of walls and posts are apart, and hold those of the JSON; x axes are along them; those that end at one place are connected there."""
    walls = [n for n in of_kind(made, "IFCWALL") if spelt(made[n][1][2]) != "gable"]
    boxes = [box_of(made, n)[:2] for n in walls + of_kind(made, "IFCCOLUMN")]
    overlap = lambda a, b: all(min(a[1][k], b[1][k]) > max(a[0][k], b[0][k]) for k in range(3))
    if not any(s["kind"] == "beam" for s in house["solids"]):
        check("walls and posts are apart", not any(overlap(a, b) for i, a in enumerate(boxes) for b in boxes[:i]))
    solids = [[F(c, 10**6) for c in s["box"]] for s in house["solids"] if s["kind"] in WALLS + ("post",)]
    within = lambda s, b: all(b[0][k] <= s[2 * k] and s[2 * k + 1] <= b[1][k] for k in range(3))
    check("each solid is in a wall or post", all(any(within(s, b) for b in boxes) for s in solids))
    ends = {}
    for wall in walls:
        at, x, _ = placed(made, references(made[wall][1][5])[0])
        shape = made[references(made[wall][1][6])[0]][1][2]
        line, = (r for r in references(shape) if made[r][1][1] == "'Axis'")
        points = points_of(made, references(made[references(made[line][1][3])[0]][1][0])[0])
        ends[wall] = [tuple(a + p[0] * d for a, d in zip(at, x)) for p in points]
        check("an axis is along x", all(p[1] == 0 for p in points))
    faces = Counter(tuple(sorted((F(x, 10**6), F(y, 10**6)) for x, y in ((f["at"][0], f["at"][2]), (f["at"][1], f["at"][3])))) for f in house["faces"] if f["at"][0] == f["at"][1] or f["at"][2] == f["at"][3])
    check("axes are those of faces", all(faces[tuple(sorted(p[:2] for p in pair))] for pair in ends.values()))
    meets, joined = defaultdict(set), defaultdict(set)
    for wall, pair in ends.items():
        for place in pair:
            meets[place].add(wall)
    for args in (args for name, args in made.values() if name == "IFCRELCONNECTSPATHELEMENTS"):
        first, second = references(args[5])[0], references(args[6])[0]
        places = [ends[wall][0 if how == ".ATSTART." else 1] for wall, how in ((first, args[10]), (second, args[9]))]
        check("walls are connected where they end", places[0] == places[1] and first != second)
        joined[places[0]].add((first, second))
    for place, group in meets.items():
        reached, left = set(), [min(group)]
        while left:
            wall = left.pop()
            reached.add(wall)
            left += [b for pair in joined[place] for a, b in (pair, pair[::-1]) if a == wall and b not in reached]
        check(f"walls that meet at {[float(c) for c in place]} are connected", reached == group and len(joined[place]) == len(group) - 1)
    for wall, opening in related(made, "IFCRELVOIDSELEMENT", 4, 5):
        check("an opening is turned as its wall, and as wide along x as in it", box_of(made, opening)[2:4] == box_of(made, wall)[2:4])


def check_stairs(made, house):
    """A flight climbs a storey, its landings included, by risers that are alike."""
    parts = defaultdict(list)
    for whole, part in related(made, "IFCRELAGGREGATES", 4, 5):
        parts[whole].append(part)
    said = {product: values for product, name, values in sets_of(made, "IFCPROPERTYSET") if name.startswith("Pset_Stair")}
    number = lambda product, name: F(re.search(r"\(([^)]*)\)", said[product][name]).group(1))
    levels = sorted(F(made[n][1][9]) for n in of_kind(made, "IFCBUILDINGSTOREY"))
    for stair in of_kind(made, "IFCSTAIR"):
        runs = [n for n in parts[stair] if made[n][0] == "IFCSTAIRFLIGHT"]
        landings = [n for n in parts[stair] if made[n][1][8] == ".LANDING."]
        if not parts[stair]:
            check("a stair without a shape has its outline", made[stair][1][6] != "$" and list(said[stair]) == ["Reference"])
            continue
        check("a stair's shape is that of its parts", runs and made[stair][1][6] == "$")
        turns = made[stair][1][8] in (".QUARTER_TURN_STAIR.", ".HALF_TURN_STAIR.")
        check("stairs that turn without winders have a landing", len(landings) == turns)
        check("runs are between landings", len(runs) <= len(landings) + 1)
        risers = number(stair, "NumberOfRiser")
        check("risers are those of the runs", sum(number(run, "NumberOfRiser") for run in runs) + (len(landings) + 1 - len(runs)) == risers)
        check("and one more than treads", number(stair, "NumberOfTreads") == risers - 1)
        check("risers make a storey", any(abs(number(stair, "RiserHeight") * risers - (b - a)) < F(1, 1000) for a, b in zip(levels, levels[1:])))


def surface_of(made, boundary):
    """The corners of a boundary's surface in the house, and the way out of the space."""
    args = made[boundary][1]
    surface = made[references(made[references(args[6])[0]][1][0])[0]][1]
    point, axis, along = made[references(made[references(surface[0])[0]][1][0])[0]][1]
    at, z, x = (numbers_of(made, references(a)[0]) for a in (point, axis, along))
    y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]]
    space = placed(made, references(made[references(args[4])[0]][1][5])[0])[0]
    corners = points_of(made, references(made[references(surface[1])[0]][1][0])[0])
    return [tuple(space[k] + at[k] + u * x[k] + v * y[k] for k in range(3)) for u, v in corners], z


def check_boundaries(made, house):
    """Each lies on its element, and faces the space; walls, doors and windows of rooms bound them; floors are as large as rooms, but for holes."""
    bounded, floors = defaultdict(set), Counter()
    for number in of_kind(made, "IFCRELSPACEBOUNDARY"):
        space, element = (references(made[number][1][i])[0] for i in (4, 5))
        corners, out = surface_of(made, number)
        low, high = ([f(c[k] for c in corners) for k in range(3)] for f in (min, max))
        axis = next(k for k in range(3) if out[k])
        bounded[space].add(element)
        spans = list(boxes_of(made, element))
        fills = made[element][0] in ("IFCDOOR", "IFCWINDOW")
        sides = [k for k in range(3) if k != axis]
        size = lambda least, most: max(most[sides[0]] - least[sides[0]], 0) * max(most[sides[1]] - least[sides[1]], 0)
        on = [b for b in spans if fills or low[axis] == (b[0] if out[axis] > 0 else b[1])[axis]]
        covered = sum(size([max(c) for c in zip(low, b[0])], [min(c) for c in zip(high, b[1])]) for b in on)
        check(f"a boundary is on its {made[element][0]}", low[axis] == high[axis] and covered == size(low, high) > 0)
        if made[element][0] == "IFCSLAB" and out[2] < 0:
            floors[space] += (high[sides[0]] - low[sides[0]]) * (high[sides[1]] - low[sides[1]])
    check("all rooms are bounded", set(bounded) == set(of_kind(made, "IFCSPACE")))
    net = {product: F(values["NetFloorArea"]) * 10**6 for product, name, values in sets_of(made, "IFCELEMENTQUANTITY") if name == "Qto_SpaceBaseQuantities"}
    check("floors are not larger than their rooms", all(floors[space] <= net[space] + 1 for space in net))
    holes = any(f["kind"] == "stair" for f in house["faces"]) or any(s["kind"] == "flight" for s in house["solids"]) or house.get("wedges")
    check("and as large", holes or all(abs(floors[space] - net[space]) < 1 for space in net))
    seen = {element for elements in bounded.values() for element in elements}
    check("doors and windows bound rooms", seen >= set(of_kind(made, "IFCDOOR") + of_kind(made, "IFCWINDOW")))


def read_again(reader, path, made, unit):
    """By another program: as many products of each kind, and the same volumes to a millionth, which it says in the unit of the file."""
    lines = subprocess.run([reader, path], capture_output=True, text=True, check=True).stdout.splitlines()
    found = {kind.upper(): (int(number), F(volume) * unit**3) for kind, number, volume in map(str.split, lines)}
    for name in PRODUCTS:
        own = [n for n, (entity, _) in made.items() if entity == name]
        number, volume = found.get(name, (0, F(0)))
        check(f"{reader}: {number} {name}, not {len(own)}", number == len(own))
        wanted = F(0) if name in ("IFCSITE", "IFCBUILDING", "IFCBUILDINGSTOREY") else sum(volume_of(made, n) for n in own)
        check(f"{reader}: {name} hold {float(volume)}, not {float(wanted)}", abs(volume - wanted) <= wanted / 10**6 + F(1, 10**3))


# ---- layers


def layers_of(made, part, usage):
    """Where each layer of a wall or slab lies in the house: its name, the axis across it, and its two sides, in millimetres. IFC has them along the
    y axis of a wall's placement, or upwards in a slab, from an offset on, in the direction that is said."""
    layer_set, along, sense, offset, _ = made[usage][1]
    low, high = ([pick(side[k] for side in sides) for k in range(3)] for pick, sides in zip((min, max), zip(*boxes_of(made, part))))
    at, _, y = placed(made, references(made[part][1][5])[0])
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
    wanted, alone, parts, free = Counter(), Counter(), set(), free_posts(house)  # parts: a wall, or the decks of a storey
    for solid in (s for s in house["solids"] if "layers" in s):
        names, axis = tuple(layer["name"] for layer in solid["layers"]), axis_of(solid)
        wall = solid["kind"] in ("outside", "party", "partition")
        if solid["kind"] == "post":
            if solid["box"] in free:
                alone["IFCCOLUMN", names] += 1
        elif (key := (wall, solid["of"] if wall else solid["kind"], None if wall else solid["of"] if solid["kind"] == "deck" else house["cells"][solid["of"]]["storey"])) not in parts:
            sides = (tuple(F(n, 10**6) for n in layer["box"][2 * axis:2 * axis + 2]) for layer in solid["layers"])
            wanted[tuple((name, axis, side) for name, side in zip(names, sides))] += 1
            parts.add(key)
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
    check("layers of walls below roofs", below.total() == len(gables) and {l["name"] for r in house["roofs"] if "face" in r for l in r.get("layers", [])} <= {n for _, names in below for n in names})


# ---- codes

PARTS_OF = {"wall": {("IFCWALL", "outside"), ("IFCWALL", "gable")}, "party": {("IFCWALL", "party")}, "partition": {("IFCWALL", "partition")}, "post": {("IFCCOLUMN", "post")},
            "floor": {("IFCSLAB", "deck"), ("IFCSLAB", "roofdeck")}, "roof": {("IFCROOF", "roof"), ("IFCSLAB", "roof")}, "guard": {("IFCRAILING", "guard")}}


def codes_of(form):
    """What the lines `classification` of a file say: the system, the part, its code and title or None."""
    for system, classes in re.findall(r'^  classification "([^"]*)" for (.*(?:\n {6}.*)*)$', open(form, encoding="utf-8").read(), re.M):
        for part, code, title in re.findall(r'([\w-]+) "([^"]*)"(?: "([^"]*)")?', classes):
            yield system, part, code, title or None


def check_codes(made, form):
    """Each element and room has the codes of what it is in the form, and no other; a code is there once."""
    named, kinds = defaultdict(set), defaultdict(set)
    for number, (entity, args) in made.items():
        if entity == "IFCSPACE":
            named[spelt(args[7]).replace(" ", "-")].add(number)
        elif entity in ELEMENTS:
            named[spelt(args[2])].add(number)
            kinds[entity, spelt(args[2])].add(number)
    wanted, found, said = defaultdict(set), defaultdict(set), Counter()
    for system, part, code, title in codes_of(form):
        wanted[system, code, title] |= set().union(*(kinds[kind] for kind in PARTS_OF[part])) if part in PARTS_OF else named[part]
    for entity, args in made.values():
        if entity != "IFCRELASSOCIATESCLASSIFICATION":
            continue
        reference = made[references(args[5])[0]][1]
        system = made[references(reference[3])[0]][1]
        key = spelt(system[3]), spelt(reference[1]), None if reference[2] == "$" else spelt(reference[2])
        said[key] += 1
        found[key] |= set(references(args[4]))
    for key in {*wanted, *found}:
        check(f"the code {key}", wanted[key] == found[key])
    check("some codes", any(found.values()))
    check("each code once", set(said.values()) == {1})
    check("each system once", len([n for n, (entity, _) in made.items() if entity == "IFCCLASSIFICATION"]) == len({key[0] for key in said}))


# ---- where doors hang


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
    names = {text for text in said if not re.fullmatch(r"[\d.]+( (SF|m\u00b2))?", text)}
    net = [float(F(r["net"]) / F(10) ** 18) for r in house["rooms"]]
    written = {f"{area:.1f} m\u00b2" for area in net} | {f"{area / 0.3048 ** 2:.0f} SF" for area in net}
    check("areas are net", {text for text in said if text.endswith(("SF", "\u00b2"))} <= written)
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
    kind_of = {"outside": "wall", "party": "party", "partition": "partition", "post": "post", "deck": "floor", "roofdeck": "floor", "guard": "guard"}
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
parser.add_argument("--form")
options = parser.parse_args()
folder = options.folder
written = read(folder + "/house.ifc")
check_file(written)
made = in_millimetres(written)
house = json.load(open(folder + "/house.json"))
compare(made, house)
for part in (check_quantities, check_walls, check_stairs, check_boundaries):
    part(made, house)
check_parts(folder + "/house.parts.csv", house)
groups = read_dxf(folder + "/house.dxf")
check_dxf(folder + "/house.dxf", groups, house)
check_doors(made, house, groups)
check_layers(made, house)
if options.form:
    check_codes(made, options.form)
title = [spelt(args[2]) for name, args in made.values() if name in ("IFCPROJECT", "IFCBUILDING")]
check(f"the house is called {title[0]}", options.title is None or title == [options.title] * 2)
validate(folder + "/house.ifc")
if options.reader:
    read_again(options.reader, folder + "/house.ifc", made, F("304.8") if is_in_feet(written) else F(1))
print("\n".join(findings[:20]) or "fine")
