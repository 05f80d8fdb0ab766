#!/usr/bin/env python3
"""Holds the models of a house to each other and to its tables: house_models.py FOLDER OPENING..., with house.glb, .obj, .mtl,
.json, .csv and .parts.csv. OPENING: the names of those that have panes, or leaves that are glazed.

The GLB is a tree of nodes by storey, room and part, whose names are those of the OBJ's objects, and each part has the same faces and materials in
both. Glass, and nothing else, is seen through. What is said of the house and of its rooms is what the tables say."""
import csv
import json
import os
import struct
import sys

SQUARE_FOOT = 0.3048**2
failures = []


def check(what, got, want):
    if got != want:
        failures.append(f"{what}: {got}, not {want}")


def is_near(what, got, want, part=1e-6):
    if abs(got - want) > part * max(1, abs(want)):
        failures.append(f"{what}: {got}, not {want}")


def read_glb(path):
    data = open(path, "rb").read()
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + length]), data[28 + length:]


def values(tree, body, index, kind, width):
    accessor = tree["accessors"][index]
    offset = tree["bufferViews"][accessor["bufferView"]].get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return struct.unpack_from(f"<{accessor['count'] * width}{kind}", body, offset)


def paths(tree):
    """Of each node with a mesh: the names on the way to it, below the whole."""
    [root] = tree["scenes"][0]["nodes"]
    found, parents = {}, [0] * len(tree["nodes"])

    def walk(index, path):
        node = tree["nodes"][index]
        children = [tree["nodes"][child]["name"] for child in node.get("children", [])]
        check(f"names below {path} are different", len(set(children)), len(children))
        if "mesh" in node:
            found["/".join(path)] = node["mesh"]
        for child in node.get("children", []):
            parents[child] += 1
            walk(child, path + [tree["nodes"][child]["name"]])

    walk(root, [])
    check("each node is below one other", parents[:root] + parents[root + 1:], [1] * (len(parents) - 1))
    check("each mesh is in one node", sorted(found.values()), list(range(len(tree["meshes"]))))
    return found


def triangles_of(tree, body, mesh):
    """By material: the corners of each triangle, in metres, z up."""
    made = {}
    for primitive in tree["meshes"][mesh]["primitives"]:
        numbers = values(tree, body, primitive["attributes"]["POSITION"], "f", 3)
        bounds = tree["accessors"][primitive["attributes"]["POSITION"]]
        for k in range(3):
            check("bounds", (min(numbers[k::3]), max(numbers[k::3])),
                  tuple(struct.unpack("<f", struct.pack("<f", bounds[end][k]))[0] for end in ("min", "max")))
        corners = values(tree, body, primitive["indices"], "I", 1)
        check("each vertex is used", set(corners) <= set(range(bounds["count"])), True)
        points = [(numbers[3 * c], -numbers[3 * c + 2], numbers[3 * c + 1]) for c in corners]
        made[tree["materials"][primitive["material"]]["name"]] = [points[i:i + 3] for i in range(0, len(points), 3)]
    return made


def read_obj(path):
    """By object and material: the corners of each triangle. The groups of an object are the names of its path."""
    points, made, name, material = [], {}, None, None
    for line in open(path, encoding="utf-8"):
        word, _, rest = line.rstrip("\n").partition(" ")
        if word == "v":
            points.append(tuple(map(float, rest.split())))
        elif word == "o":
            name = rest
            check("an object is there once", name in made, False)
            made[name] = {}
        elif word == "g":
            check("groups of an object", rest.split(" "), name.split("/"))
        elif word == "usemtl":
            material = rest
            made[name].setdefault(material, [])
        elif word == "f":
            made[name][material].append([points[int(corner) - 1] for corner in rest.split()])
    return made


def read_mtl(path):
    made, name = {}, None
    for line in open(path, encoding="utf-8"):
        word, _, rest = line.rstrip("\n").partition(" ")
        if word == "newmtl":
            name = rest
            check("a material is there once", name in made, False)
            made[name] = {}
        elif word in ("Kd", "d"):
            made[name][word] = [float(number) for number in rest.split()]
    return made


def linear(value):
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055)**2.4


def check_materials(tree, mtl, glazed):
    check("materials have different names", len({m["name"] for m in tree["materials"]}), len(tree["materials"]))
    check("materials of both", sorted(m["name"] for m in tree["materials"]), sorted(mtl))
    for material in tree["materials"]:
        *rgb, alpha = material["pbrMetallicRoughness"]["baseColorFactor"]
        other = mtl[material["name"]]
        check(f"{material['name']} is seen through", material.get("alphaMode", "OPAQUE") == "BLEND", material["name"] in glazed)
        check(f"opacity of {material['name']}", (alpha < 1, other["d"]), (material["name"] in glazed, [alpha]))
        for one, two in zip(rgb, other["Kd"]):
            is_near(f"the colour of {material['name']}", one, linear(two), 1e-3)


def glass_of(tree, meshes, openings):
    """The names of the materials of what is glazed, which other parts do not have."""
    glazed, others = set(), set()
    for path, mesh in meshes.items():
        kind = path.split("/")[-1]
        kind = kind if kind in openings else kind.rpartition("-")[0]
        used = {tree["materials"][p["material"]]["name"] for p in tree["meshes"][mesh]["primitives"]}
        (glazed if kind in openings else others).update(used)
    check("what is glazed and what is not have different materials", glazed & others, set())
    return glazed


def check_parts(tree, body, obj, meshes):
    check("parts of both", sorted(meshes), sorted(obj))
    for path, mesh in meshes.items():
        got = triangles_of(tree, body, mesh)
        check(f"materials of {path}", sorted(got), sorted(obj.get(path, {})))
        for material in set(got) & set(obj.get(path, {})):
            one, two = got[material], obj[path][material]
            check(f"triangles of {path}", len(one), len(two))
            apart = max(abs(a - b) for s, t in zip(one, two) for p, q in zip(s, t) for a, b in zip(p, q))
            check(f"{path} is in the same place", apart < 1e-5, True)


def check_facts(folder, house, tree):
    facts = tree["scenes"][0]["extras"]
    check("the house's line", facts["house"], house["house"])
    rows = list(csv.DictReader(open(f"{folder}/house.csv", encoding="utf-8", newline="")))
    square = SQUARE_FOOT if "net_sf" in rows[0] else 1
    unit = "sf" if "net_sf" in rows[0] else "m2"
    storeys = {}
    for storey in (tree["nodes"][child] for child in tree["nodes"][0]["children"]):
        for room in (tree["nodes"][child] for child in storey.get("children", [])):
            if "extras" in room:
                storeys.setdefault(storey["name"], []).append(room)
    for storey in {row["storey"] for row in rows}:
        wanted = [row for row in rows if row["storey"] == storey]
        found = storeys.get(storey, [])
        check(f"functions of rooms in {storey}", [room["extras"]["function"] for room in found], [row["function"] for row in wanted])
        for room, row in zip(found, wanted):
            check("the name of a room", room["name"], f"{room['extras']['number']}-{row['function']}")
            for area in ("gross", "net", "glazed"):
                is_near(f"{area} of {room['name']}", room["extras"][f"{area}_m2"], square * float(row[f"{area}_{unit}"]), 1e-5)
    for area in ("gross", "net"):
        is_near(f"{area} of the house", facts[f"{area}_m2"], square * sum(float(row[f"{area}_{unit}"]) for row in rows), 1e-5)
    lines = list(csv.DictReader(open(f"{folder}/house.parts.csv", encoding="utf-8", newline="")))
    if any(float(line["price"] or 0) > 0 for line in lines):
        check("costs of parts", [(c["part"], c["material"], c["cost"]) for c in facts["costs"]],
              [(line["part"], line["material"], float(line["cost"])) for line in lines if line["material"]])
        check("the cost", facts["cost"], float(lines[-1]["cost"]))
    else:
        check("a house without prices has no costs", "cost" in facts or "costs" in facts, False)


def main(folder, glazed):
    house = json.load(open(f"{folder}/house.json", encoding="utf-8"))
    tree, body = read_glb(f"{folder}/house.glb")
    meshes = paths(tree)
    obj = read_obj(f"{folder}/house.obj")
    check_parts(tree, body, obj, meshes)
    check_materials(tree, read_mtl(f"{folder}/house.mtl"), glass_of(tree, meshes, glazed))
    check_facts(folder, house, tree)
    kinds = {face["kind"] for face in house["faces"]}
    check("openings are parts", {k for k in glazed if k in kinds},
          {k for k in glazed if any(p.split("/")[-1] == k for p in meshes)})
    print("\n".join(failures[:20]) or "fine")


main(sys.argv[1], set(sys.argv[2:]))
