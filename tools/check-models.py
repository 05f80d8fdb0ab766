"""Opens models of houses in Blender, and holds what is there against the files: blender --background --python check-models.py -- FILE.glb...

Beside each .glb is an .obj of the same house. Blender has a name once, and adds .001 and so on to others; a name of an .obj, which is that of a whole
path, is cut at 63 bytes."""
import json
import re
import struct
import sys

import bpy
import numpy

numpy.bool = bool  # Blender 3.4's importer of glTF still asks for it, and numpy 1.24, beside it in Debian 12, has it no more

failures = []


def check(what, got, want):
    if got != want:
        failures.append(f"{what}: {got}, not {want}")


def plain(name):
    return re.sub(r"\.\d{3}$", "", name)


def path_of(thing):
    return ((path_of(thing.parent) + "/") if thing.parent else "") + plain(thing.name)


def tree_of(path):
    data = open(path, "rb").read()
    return json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])


def wanted_paths(tree, index, before):
    path = before + tree["nodes"][index]["name"]
    yield path, tree["nodes"][index]
    for child in tree["nodes"][index].get("children", []):
        yield from wanted_paths(tree, child, path + "/")


def check_glass(tree):
    for material in tree["materials"]:
        found = bpy.data.materials[material["name"]]
        alpha = material["pbrMetallicRoughness"]["baseColorFactor"][3]
        check(f"blending of {found.name}", found.blend_method, "BLEND" if alpha < 1 else "OPAQUE")
        check(f"culling of {found.name}", found.use_backface_culling, not material.get("doubleSided", False))


def check_glb(path):
    tree = tree_of(path)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    things = {path_of(thing): thing for thing in bpy.data.objects}
    wanted = dict(wanted_paths(tree, tree["scenes"][0]["nodes"][0], ""))
    check("objects of " + path, sorted(things), sorted(wanted))
    for name in set(things) & set(wanted):
        check(f"{name} has a mesh", things[name].type == "MESH", "mesh" in wanted[name])
        for fact, value in wanted[name].get("extras", {}).items():
            check(f"{fact} of {name}", things[name].get(fact), value)
    check("the house's line", bpy.context.scene.get("house"), tree["scenes"][0]["extras"]["house"])
    check("materials of " + path, sorted(m.name for m in bpy.data.materials), sorted(m["name"] for m in tree["materials"]))
    check_glass(tree)


def check_obj(path):
    names = [line[2:].rstrip("\n") for line in open(path, encoding="utf-8") if line.startswith("o ")]
    materials = sorted({line[7:].rstrip("\n") for line in open(path, encoding="utf-8") if line.startswith("usemtl ")})
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.obj_import(filepath=path)
    check("objects of " + path, sorted(thing.name for thing in bpy.data.objects), sorted(name[:63] for name in names))
    check("materials of " + path, sorted(m.name for m in bpy.data.materials), materials)


paths = sys.argv[sys.argv.index("--") + 1:]
for path in paths:
    check_glb(path)
    check_obj(path[:-3] + "obj")
if failures:
    sys.exit("\n".join(failures[:20]))
print(f"Blender has the names of {len(paths)} houses")
