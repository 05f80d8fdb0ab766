#!/usr/bin/env python3
"""Holds the files that questions make to those that commands write: ask_files.py PROGRAM TARTAN [SCHEMA]

PROGRAM asks through the C interface (ask_interface.c). Each answer's files have the bytes of those that the command writes by the same engines,
and what the command refuses, the question does, with the same sentence. With SCHEMA, answers follow it, too."""
import base64
import json
import os
import re
import subprocess
import sys
import tempfile

# Question: file, request, and the command's words behind the file's name. -o names a file in an empty folder; what is written to a folder (a / at
# its end) has the names that the answer says.
ASKED = {
    "draw": [
        ("stdlib/terrace.plan", {"sample": 4, "seed": 3, "diverse": True}, "--sample 4 --seed 3 --diverse -o a.svg"),
        ("stdlib/terrace.plan", {"per_length": 1, "format": "png", "dpi": 40, "columns": 2}, "--per-length 1 --dpi 40 --columns 2 -o a.png"),
        ("stdlib/terrace.plan", {"rules": ["step", "unhanded"], "format": "pdf"}, "--rule step --rule unhanded -o a.pdf"),
        ("stdlib/terrace.plan", {"rules": ["stp"]}, "--rule stp -o a.svg"),
        ("stdlib/terrace.plan", {"seed": 3}, "--seed 3 -o a.svg"),
        ("stdlib/terrace.plan", {"plans": [{"plan": "4m one end left eaves - none"}], "from": "tests/cli/files/one-house"},
         "tests/cli/files/one-house -o a.svg"),
        ("stdlib/lahave-houses.plan", {"best": 3, "by": [{"measure": "cost"}, {"measure": "area", "most": True}], "trays": {"from": 4, "to": 4}},
         "--best 3 --least cost --then-most area --trays 4..4 -o a.svg"),
        ("tests/cli/files/cabins.plan", {"library": "cottages", "sample": 2, "title": "Huts"}, "--library cottages --sample 2 --title Huts -o a.svg"),
        ("tests/cli/files/cabins.plan", {"library": "cottages", "sample": 2, "paper": "a3"}, "--library cottages --sample 2 --paper a3 -o a.svg"),
        ("stdlib/table.solid", {"show": "sheet"}, "--sheet -o a.svg"),
        ("stdlib/table.solid", {"sample": 2}, "--sample 2 -o a.svg"),
        ("tests/cli/files/ball.field", {"format": "png", "dpi": 50, "sharp": True, "width": 200, "azimuth": 3}, "--dpi 50 --sharp --width 200 --azimuth 3 -o a.png"),
        ("tests/cli/files/ball.field", {"surface": "bal"}, "--surface bal -o a.svg"),
        ("stdlib/bricks.kit", {"sample": 1}, "--sample 1 -o a.svg"),
    ],
    "count": [
        ("stdlib/lahave-houses.plan", {"by": "cost", "trays": {"from": 4, "to": 5}, "picture": "svg"}, "--by cost --trays 4..5 -o a.svg"),
        ("tests/cli/files/cabins.plan", {"library": "cottages", "plan": "#10", "by": "floor-area", "picture": "pdf"}, "--library cottages --plan #10 --by floor-area -o a.pdf"),
    ],
    "explain": [
        ("stdlib/terrace.plan", {"plan": "#1000", "picture": "svg"}, "#1000 -o a.svg"),
        ("stdlib/terrace.plan", {"plan": "#1000", "rules": ["step"], "picture": "png", "dpi": 60, "full": True}, "#1000 --rule step --dpi 60 --full -o a.png"),
        ("tests/cli/files/cabins.plan", {"house": "#10:3", "picture": "svg"}, "#10:3 -o a.svg"),
        ("tests/cli/files/cabins.plan", {"house": "#10:3", "picture": "pdf", "full": True}, "#10:3 --full -o a.pdf"),
        ("tests/cli/files/cabins.plan", {"house": "#10:3", "rules": ["far-bed"], "picture": "png", "dpi": 50}, "#10:3 --rule far-bed --dpi 50 -o a.png"),
        ("tests/cli/files/cabins.plan", {"plan": "#10:", "library": "cottages", "picture": "svg"}, "#10: --library cottages -o a.svg"),
    ],
    "complete": [
        ("stdlib/terrace.plan", {"pattern": "? | ... | ?", "picture": "png"}, "?_|_..._|_? -o a.png"),
        ("stdlib/lahave-houses.plan", {"pattern": "? | great | ... | ?", "by": [{"measure": "cost"}], "trays": {"from": 4, "to": 4}, "picture": "svg"},
         "?_|_great_|_..._|_? --least cost --trays 4..4 -o a.svg"),
        ("tests/cli/files/cabins.plan", {"pattern": "... | ?", "library": "cottages", "picture": "svg"}, "..._|_? --library cottages -o a.svg"),
    ],
    "rule_draw": [
        ("stdlib/lahave.plan", {"rule": "stranded"}, "stranded -o a.svg"),
        ("stdlib/lahave.plan", {"rule": "dense-end", "format": "png", "dpi": 40}, "dense-end -o a.png --dpi 40"),
        ("tests/cli/files/cabins.plan", {"rule": "far-bed", "format": "pdf"}, "far-bed -o a.pdf"),
        ("stdlib/terrace.plan", {"rule": "stp"}, "stp -o a.svg"),
    ],
    "best": [("stdlib/lahave-houses.plan", {"best": 4, "by": [{"measure": "cost"}], "trays": {"from": 4, "to": 4}}, "4 --least cost --trays 4..4 -o a.svg")],
    "pareto": [
        ("stdlib/lahave-houses.plan", {"front": True, "by": [{"measure": "cost"}, {"measure": "area", "most": True}], "trays": {"from": 4, "to": 4}},
         "--least cost --most area --trays 4..4 -o a.svg"),
        ("tests/cli/files/cabins.plan", {"front": True, "plan": "#3", "by": [{"measure": "floor-area"}, {"measure": "bedrooms", "most": True}]},
         "--plan #3 --least floor-area --most bedrooms -o a.svg"),
    ],
    "house": [
        ("tests/cli/files/cabins.plan", {"house": "#10:77", "files": ["json", "parts.csv", "glb", "ifc", "svg"]}, "#10:77 -o a.json -o a.parts.csv -o a.glb -o a.ifc -o a.svg"),
        ("tests/cli/files/cabins.plan", {"house": "#10:77", "files": ["obj", "mtl"], "mtl": ["a.mtl"]}, "#10:77 -o a.obj -o a.mtl"),
        ("tests/cli/files/cabins.plan", {"house": "#10:77", "files": ["png"], "dpi": 40, "bare": True, "cut": "ground", "views": ["axonometric"], "azimuth": 20, "elevation": 70},
         "#10:77 -o a.png --dpi 40 --furnish no --cut ground --view axonometric --azimuth 20 --elevation 70"),
        ("tests/cli/files/cabins.plan", {"house": "14' room:14' none ; 1 gable(9:12) 1 flat ; living ; window wall window", "files": ["dxf"], "views": ["plan:ground"]},
         "14'_room:14'_none_;_1_gable(9:12)_1_flat_;_living_;_window_wall_window --view plan:ground -o a.dxf"),
        ("tests/cli/files/cabins.plan", {"house": "#10:77", "files": ["pdf"], "views": ["plan:grund"]}, "#10:77 -o a.pdf --view plan:grund"),
        ("tests/cli/files/cabins.plan", {"house": "#10:77", "files": ["ifc"], "scale": 20}, "#10:77 -o a.ifc --scale 20"),
        ("tests/cli/files/cabins.plan", {"house": "a; b"}, "a;_b"),
        ("tests/cli/files/cabins.plan", {"house": "#10:77", "library": "cottag"}, "#10:77 --library cottag"),
        ("stdlib/terrace.plan", {"house": ""}, "_"),
    ],
    "report": [
        ("stdlib/terrace.plan", {"sample": 3, "seed": 7}, "--sample 3 --seed 7 -o a.html"),
        ("stdlib/terrace.plan", {"library": "street", "where": ["trays = 2"], "sample": 1}, "--library street --where trays_=_2 --sample 1 -o a.html"),
        ("stdlib/terrace.plan", {"library": "streets"}, "--library streets -o a.html"),
        ("stdlib/terrace.plan", {"pictures": 3}, "--pictures 3 -o a.html"),
        ("stdlib/cottage.plan", {"library": "cottages", "sample": 2}, "--library cottages --sample 2 -o a.html"),
        ("stdlib/bricks.kit", {"pictures": 3, "seed": 3}, "--pictures 3 --seed 3 -o a.html"),
        ("stdlib/bricks.kit", {"seed": 99999999999}, "--seed 99999999999 -o a.html"),
        ("stdlib/koch.hemls", {}, "-o a.html"),
    ],
    "slice": [
        ("stdlib/table.solid", {"layer": 3}, "--layer 3 -o a.svg"),
        ("stdlib/table.solid", {"layer": 0.5, "format": "cli", "each": True}, "--layer 0.5 --format cli -o layers/"),
        ("stdlib/table.solid", {"layer": 30}, "--layer 30 -o a.svg"),
        ("stdlib/table.solid", {"layer": 3, "grid": 8}, "--layer 3 --grid 8 -o a.svg"),
        ("stdlib/table.solid", {"layer": 3, "solid": "tble"}, "--layer 3 --solid tble -o a.svg"),
        ("tests/cli/files/ball.field", {"layer": 1.5, "format": "dxf", "grid": 9, "threads": 1}, "--layer 1.5 --grid 9 --threads 1 -o a.dxf"),
        ("tests/cli/files/ball.field", {"layer": 1.5, "engine": "vm"}, "--layer 1.5 --engine vm -o a.svg"),
        ("tests/cli/files/ball.field", {"layer": 1.5, "surface": "bal"}, "--layer 1.5 --surface bal -o a.svg"),
        ("stdlib/terrace.plan", {"layer": 1}, "--layer 1 -o a.svg"),
    ],
    "grow": [
        *(("stdlib/square.hemls", {"format": format, "steps": 3}, f"-n 3 -o a.{format}") for format in ("obj", "ply", "stl", "off", "om", "glb", "dxf")),
        ("stdlib/square.hemls", {"format": "obj", "steps": 2, "each_step": True, "lines": True, "groups": True}, "-n 2 --each-step --lines --groups -o step.obj"),
        ("stdlib/square.hemls", {"format": "ply", "until_faces": 60, "normals": True, "up": "y", "triangulate": True},
         "--until faces=60 --normals --up y --triangulate -o a.ply"),
        ("stdlib/square.hemls", {"format": "obj", "subdivide": 1, "smooth": 2, "decimate": 90}, "--subdivide 1 --smooth 2 --decimate 90 -o a.obj"),
        ("stdlib/square.hemls", {"format": "svg", "scale": "1.2 1.3 1", "seed": "4", "attractor": ["at 2 2 2 strength 0.5"], "fixed_centre": True, "stats": True,
                                 "boundary": ["plane at 0 0 -0.1 normal 0 0 1 stop"], "gravity": ["0 0 -0.1"], "explain": True},
         "--scale 1.2_1.3_1 --seed 4 --attractor at_2_2_2_strength_0.5 --fixed-centre --boundary plane_at_0_0_-0.1_normal_0_0_1_stop --gravity 0_0_-0.1 -o a.svg"),
        ("examples/growing-surfaces/draped.study", {"format": "svg", "steps": 3, "sheet": True, "columns": 2}, "-n 3 --sheet --columns 2 -o a.svg"),
        ("examples/growing-surfaces/draped.study", {"format": "png", "azimuth": 10, "elevation": 20, "width": 200, "dpi": 40, "title": "A", "surroundings": "no"},
         "--azimuth 10 --elevation 20 --width 200 --dpi 40 --title A --surroundings no -o a.png"),
        ("examples/growing-surfaces/draped.study", {"format": "pdf", "overlay": [0, 2], "engine": "vm", "threads": 1}, "--overlay 0,2 --engine vm --threads 1 -o a.pdf"),
        ("stdlib/square.hemls", {"format": "png", "steps": 2, "turn": 3, "width": 100}, "-n 2 --turn 3 --width 100 -o round/"),
        ("stdlib/square.hemls", {"format": "png", "steps": 2, "turn": 3, "width": 100, "moving": True}, "-n 2 --turn 3 --width 100 -o a.png"),
        ("stdlib/square.hemls", {"format": "obj", "width": 100}, "--width 100 -o a.obj"),
        ("stdlib/square.hemls", {"format": "stl", "lines": True}, "--lines -o a.stl"),
        ("stdlib/square.hemls", {"format": "obj", "lines": True, "decimate": 3}, "--lines --decimate 3 -o a.obj"),
        ("stdlib/square.hemls", {"format": "png", "turn": 3, "sheet": True}, "--turn 3 --sheet -o round/"),
        ("stdlib/square.hemls", {"format": "svg", "overlay": [9]}, "--overlay 9 -o a.svg"),
        ("stdlib/square.hemls", {"format": "svg", "overlay": [1], "each_step": True}, "--overlay 1 --each-step -o a.svg"),
        ("stdlib/square.hemls", {"format": "svg", "sheet": True, "each_step": True}, "--sheet --each-step -o a.svg"),
        ("stdlib/square.hemls", {"format": "obj", "statements": ["scale 1.2"]}, "--scale 1.2 -o a.obj"),
        ("stdlib/square.hemls", {"format": "obj", "scale": "0"}, "--scale 0 -o a.obj"),
        ("stdlib/square.hemls", {"format": "obj", "distance_to": "no\"such.obj"}, "--distance-to no\"such.obj -o a.obj"),
        ("stdlib/terrace.plan", {"format": "obj", "scale": "2"}, "--scale 2 -o a.obj"),
    ],
    "mesh": [
        ("stdlib/table.solid", {"format": "obj"}, "-o a.obj"),
        ("stdlib/table.solid", {"format": "stl"}, "-o a.stl"),
        ("stdlib/table.solid", {"format": "stl", "exact": True, "stats": True}, "--exact --stats -o a.stl"),
        ("stdlib/table.solid", {"format": "3mf", "cells": True}, "--cells -o a.3mf"),
        ("stdlib/table.solid", {"format": "scad"}, "-o a.scad"),
        ("stdlib/table.solid", {"format": "dxf", "up": "y"}, "--up y -o a.dxf"),
        ("stdlib/table.solid", {"format": "obj", "subdivide": 1, "smooth": 2, "decimate": 100}, "--subdivide 1 --smooth 2 --decimate 100 -o a.obj"),
        ("stdlib/table.solid", {"format": "obj", "grid": 9}, "--grid 9 -o a.obj"),
        ("stdlib/table.solid", {"format": "obj", "solid": "tble"}, "--solid tble -o a.obj"),
        ("stdlib/table.solid", {"format": "obj", "max_boxes": 2}, "--max-boxes 2 -o a.obj"),
        ("tests/cli/files/ball.field", {"format": "ply", "grid": 9, "normals": True}, "--grid 9 --normals -o a.ply"),
        ("tests/cli/files/ball.field", {"format": "glb", "grid": 9, "sharp": True, "stats": True}, "--grid 9 --sharp --stats -o a.glb"),
        ("tests/cli/files/ball.field", {"format": "off", "grid": 9, "open": True, "engine": "vm"}, "--grid 9 --open --engine vm -o a.off"),
        ("tests/cli/files/ball.field", {"format": "om", "grid": 9, "threads": 1, "thickness": True}, "--grid 9 --threads 1 --thickness -o a.om"),
        ("tests/cli/files/ball.field", {"format": "stl", "normals": True}, "--normals -o a.stl"),
        ("tests/cli/files/ball.field", {"format": "glb", "up": "y"}, "--up y -o a.glb"),
        ("tests/cli/files/ball.field", {"format": "obj", "exact": True}, "--exact -o a.obj"),
        ("tests/cli/files/ball.field", {"format": "obj", "cells": True}, "--cells -o a.obj"),
        ("tests/cli/files/ball.field", {"format": "obj", "open": True, "thickness": True}, "--open --thickness -o a.obj"),
        ("tests/cli/files/ball.field", {"format": "obj", "jumps": "open", "thickness": True}, "--jumps open --thickness -o a.obj"),
        ("tests/cli/files/ball.field", {"format": "obj", "points": [[0, 0, 0]]}, "--points places -o a.obj"),
        ("tests/cli/files/ball.field", {"format": "obj", "surface": "bal"}, "--surface bal -o a.obj"),
        ("tests/cli/files/ball.field", {"format": "obj", "max_samples": 9}, "--max-samples 9 -o a.obj"),
        ("tests/cli/files/ball.field", {"format": "obj", "max_triangles": 9}, "--max-triangles 9 -o a.obj"),
        ("stdlib/terrace.plan", {"format": "obj"}, "-o a.obj"),
    ],
    "place": [
        ("examples/gatehouse/gatehouse.kit", {"formats": ["ldr", "mpd", "csv", "svg", "png", "pdf"], "seed": 3},
         "--seed 3 -o a.ldr -o a.mpd -o a.csv -o a.svg -o a.png -o a.pdf"),
        ("examples/gatehouse/gatehouse.kit", {"formats": ["obj", "ply", "stl", "off", "om", "glb", "3mf", "dxf"]},
         "-o a.obj -o a.ply -o a.stl -o a.off -o a.om -o a.glb -o a.3mf -o a.dxf"),
        ("examples/gatehouse/gatehouse.kit", {"formats": ["svg"], "steps": "layer", "sheet": True, "model": "gatehouse"}, "--model gatehouse --steps layer --sheet -o a.svg"),
        ("examples/gatehouse/gatehouse.kit", {"formats": ["ldr"], "part_limit": 9, "keep_partial": True}, "--part-limit 9 --keep-partial -o a.ldr"),
        ("examples/gatehouse/gatehouse.kit", {"formats": ["ldr"], "part_limit": 9}, "--part-limit 9 -o a.ldr"),
        ("examples/gatehouse/gatehouse.kit", {"formats": ["ldr"], "threads": 2}, "--threads 2 -o a.ldr"),
        ("examples/gatehouse/gatehouse.kit", {"formats": ["ldr"], "model": "gate"}, "--model gate -o a.ldr"),
        ("examples/gatehouse/gatehouse.kit", {"formats": ["ldr"], "steps": "0"}, "--steps 0 -o a.ldr"),
        ("examples/gatehouse/gatehouse.kit", {"formats": ["ldr"], "sheet": True}, "--sheet -o a.ldr"),
        ("tests/cli/files/stack.pcfg", {"formats": ["ldr", "csv"], "seed": 4, "header": True}, "--seed 4 --header -o a.ldr -o a.csv"),
        ("tests/cli/files/stack.pcfg", {"formats": ["ldr"], "fitness": "elements <= 6", "engine": "vm", "step_limit": 1000}, "--fitness elements_<=_6 --engine vm --step-limit 1000 -o a.ldr"),
        ("tests/cli/files/stack.pcfg", {"formats": ["ldr"], "fitness": "elements <"}, "--fitness elements_< -o a.ldr"),
        ("tests/cli/files/stack.pcfg", {"formats": ["ldr"], "fitness": "fill"}, "--fitness fill -o a.ldr"),
        ("tests/cli/files/stack.pcfg", {"formats": ["ldr"], "fitness": "elements", "trace": True}, "--fitness elements --trace -o a.ldr"),
        ("tests/cli/files/stack.pcfg", {"formats": ["svg"]}, "-o a.svg"),
        ("tests/cli/files/stack.pcfg", {"formats": ["csv"], "header": True}, "--header -o a.csv"),
        ("tests/cli/files/stack.pcfg", {"formats": ["ldr"], "model": "a"}, "--model a -o a.ldr"),
        ("stdlib/terrace.plan", {"formats": ["ldr"]}, "-o a.ldr"),
    ],
    "export": [
        ("stdlib/terrace.plan", {}, "--prolog -o a.pl"),
        ("stdlib/terrace.plan", {"as": "prolog", "library": "streets", "where": ["trays = 3"]}, "--prolog --library streets --where trays_=_3 -o a.pl"),
        ("stdlib/terrace.plan", {"as": "prolog", "library": "street-houses"}, "--prolog --library street-houses -o a.pl"),
        ("tests/cli/files/sheds.plan", {"as": "regex", "rule": "wide-end"}, "--regex --rule wide-end -o a.txt"),
        ("tests/cli/files/sheds.plan", {"as": "regex", "rule": "wide-end", "max_states": 1}, "--regex --rule wide-end --max-states 1 -o a.txt"),
        ("tests/cli/files/sheds.plan", {"as": "regex", "rule": "wide-ends"}, "--regex --rule wide-ends -o a.txt"),
        ("tests/cli/files/sheds.plan", {"as": "regex"}, "--regex -o a.txt"),
        ("tests/cli/files/sheds.plan", {"as": "prolog", "rule": "wide-end"}, "--prolog --rule wide-end -o a.pl"),
        ("tests/cli/files/sheds.plan", {"as": "prolog", "model": "a"}, "--prolog --model a -o a.pl"),
        ("tests/cli/files/sheds.plan", {"as": "pcfg"}, "--pcfg -o a.pcfg"),
        ("tests/cli/files/sheds.plan", {"as": "pcfg", "init": "Wall"}, "--pcfg --init Wall -o a.pcfg"),
        ("examples/gatehouse/gatehouse.kit", {"as": "pcfg"}, "--pcfg -o a.pcfg"),
        ("examples/gatehouse/gatehouse.kit", {"as": "pcfg", "model": "gate"}, "--pcfg --model gate -o a.pcfg"),
        ("stdlib/bricks.kit", {"as": "pcfg"}, "--pcfg -o a.pcfg"),
    ],
}


# Questions that are asked by the name of another command.
DRAWN = {"best": "draw", "pareto": "draw"}
# Questions whose command has another name.
COMMANDS = {"rule_draw": "rule"}


def first_error(said):
    """The sentence of the first error that a command says."""
    found = re.search(r"^(?:.*: )?error(?:\[E\d+\])?: (.*)$", said, re.M)
    return "error " + found[1] if found else said


def asked_of(program, question, file, request):
    done = subprocess.run([program, "stdlib", file, question, json.dumps(request)], capture_output=True, text=True, check=False)
    return done.stdout.rstrip("\n")


def written_by(tartan, question, file, words, folder):
    """The bytes of each file that the command writes, by its name there; or what it says is wrong."""
    words = words.split(" ")
    words = [os.path.join(folder, word) if before == "-o" else word.replace("_", " ") for before, word in zip(["", *words], words)]
    done = subprocess.run([tartan, COMMANDS.get(question, question.replace("_", "-")), file, *words], capture_output=True, text=True, check=False)
    if done.returncode and not os.listdir(folder):
        return first_error(done.stderr), []
    found = {}
    for place, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(place, name)
            with open(path, "rb") as opened:
                found[os.path.relpath(path, folder)] = opened.read()
    return found, [os.path.relpath(word, folder) for before, word in zip(["", *words], words) if before == "-o"]


def content(file):
    return file["text"].encode() if "text" in file else base64.b64decode(file["base64"])


def differs(answer, written, names):
    """What is wrong with the files of an answer, or None."""
    if isinstance(written, str) or answer.startswith("error"):
        return None if written == answer else f"the command says {written!r:.300}, the answer is {answer:.300}"
    files = json.loads(answer)["files"]
    if len(files) != len(written):
        return f"{len(files)} files, and the command writes {sorted(written)}"
    for i, file in enumerate(files):
        name = names[i] if len(names) == len(files) else os.path.join(names[0], file["name"])
        if len(names) != len(files) and file["name"] in written:
            name = file["name"]
        if written.get(os.path.normpath(name)) != content(file):
            return f"{name} has other bytes"
    return None


def main():
    program, tartan = sys.argv[1:3]
    validators = None
    if len(sys.argv) > 3:
        import jsonschema

        with open(sys.argv[3], encoding="utf-8") as opened:
            schema = json.load(opened)
        validators = {question: jsonschema.Draft202012Validator({"$defs": schema["$defs"], **schema["answers"][DRAWN.get(question, question)]}) for question in ASKED}
        requests = {question: jsonschema.Draft202012Validator({"$defs": schema["$defs"], **schema["requests"][DRAWN.get(question, question)]}) for question in ASKED}
    wrong = []
    for question, rows in ASKED.items():
        for file, request, words in rows:
            with tempfile.TemporaryDirectory() as folder:
                answer = asked_of(program, DRAWN.get(question, question), file, request)
                found = differs(answer, *written_by(tartan, question, file, words, folder))
            if not found and validators and not answer.startswith("error"):
                found = "; ".join(error.message[:200] for error in validators[question].iter_errors(json.loads(answer)))
                found += "; ".join(error.message[:200] for error in requests[question].iter_errors(request))
            if found:
                wrong.append(f"{question} {file} {request}: {found}")
    print("\n".join(wrong) or "fine")


if __name__ == "__main__":
    main()
