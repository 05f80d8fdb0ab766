#!/usr/bin/env python3
"""Every question of docs/requests.md over the studio's socket: questions.py TARTAN

Right ones have the command's answer, and meshes as bytes are the files that the command writes; a member that no request has is refused, with its name; and each that is ended at once is answered
once, whether it was quicker or not."""
import json
import os
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from client import Server, Window

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# Asked at a terminal alone: they read or write folders of runs, or run programs.
ELSEWHERE = {"runs", "individual", "change_run", "evolve", "breed"}
PLAN = "4m one end left eaves - none | 4m one mid left eaves - none | 6m one mid right eaves - garden:2m"
ROW = PLAN + " | 8m one mid left eaves passage garden:4m | 8m one end right eaves - none"
# Question, file, request, and the words of the command.
RIGHT = [
    ("count", "terrace.plan", {}, ["count"]),
    ("count", "terrace.plan", {"trays": {"from": 2, "to": 4}, "mirror": True}, ["count", "--trays", "2..4", "--mirror"]),
    ("count", "lahave-houses.plan", {"by": "cost", "bins": 6, "trays": {"from": 4, "to": 5}}, ["count", "--by", "cost", "--bins", "6", "--trays", "4..5"]),
    ("count", "cottage.plan", {"library": "cottages"}, ["count", "--library", "cottages"]),
    ("explain", "terrace.plan", {"plan": PLAN}, ["explain", PLAN]),
    ("rank", "terrace.plan", {"plan": ROW}, ["rank", ROW]),
    ("unrank", "terrace.plan", {"rank": "1000"}, ["unrank", "1000"]),
    ("pareto", "lahave-houses.plan", {"by": [{"measure": "cost"}, {"measure": "area", "most": True}], "trays": {"from": 4, "to": 4}},
     ["pareto", "--trays", "4..4", "--least", "cost", "--most", "area"]),
    ("complete", "terrace.plan", {"pattern": "? | ... | ?"}, ["complete", "? | ... | ?"]),
    ("schema", "cottage.plan", {"used": True}, ["schema", "--used"]),
    ("settings", "market.plan", {}, ["settings"]),
    ("settings", "primitives.field", {}, ["settings"]),
    ("relations", "terrace.plan", {}, ["check", "--relations"]),
    ("test", "terrace.plan", {}, ["test"]),
]
# Meshes as bytes, and what the command writes.
MESHES = [
    ("mesh", "primitives.field", {"format": "glb", "normals": True}, "glb", ["mesh", "--normals"]),
    ("mesh", "primitives.field", {"format": "stl", "surface": "torus", "grid": 30}, "stl", ["mesh", "--surface", "torus", "--grid", "30"]),
    ("mesh", "table.solid", {"format": "glb", "cells": True}, "glb", ["mesh", "--cells"]),
    ("mesh", "table.solid", {"format": "ply"}, "ply", ["mesh"]),
    ("grow", "square.hemls", {"format": "glb", "groups": True}, "glb", ["grow", "--groups"]),
    ("place", "gatehouse.kit", {"formats": ["glb"], "seed": 2}, "glb", ["place", "--seed", "2"]),
    ("place", "gatehouse.kit", {"formats": ["ldr", "stl", "3mf"]}, "stl", ["place"]),
    ("house", "cottage.plan", {"house": "#541:77", "files": ["glb"]}, "glb", ["house", "#541:77"]),
]
wrong = []


def check(good, what):
    if not good:
        wrong.append(what)


def without_paths(value):
    """The page's paths begin at its folder."""
    if isinstance(value, dict):
        return {key: without_paths(item) for key, item in value.items()}
    if isinstance(value, list):
        return [without_paths(item) for item in value]
    return value.lstrip("/") if isinstance(value, str) and value.endswith((".plan", ".field")) else value


def ask(window, question, name, request):
    return window.send("tartan/" + question, {"uri": "file:///" + name, "version": 1, "request": request})


def right(window, tartan, folder):
    for question, name, request, (command, *words) in RIGHT:
        message = window.answer(ask(window, question, name, request))
        said = subprocess.run([tartan, command, name, *words, "--json"], cwd=folder, capture_output=True, text=True, check=False).stdout
        answer = message.get("result", {}).get("answer")
        check(said and without_paths(answer) == without_paths(json.loads(said)), "%s %s: %s, not %s" % (question, request, json.dumps(message)[:300], said[:300]))


def pruned(window):
    """What a library's rules prune is drawn if all that it generates is asked for; what it requires holds there, too."""
    def sample(**more):
        request = {"library": "street", "where": ["leap"], "count": 3, "lines": True, **more}
        return window.answer(ask(window, "sample", "terrace.plan", request))["result"]["answer"]["plans"]

    check(sample() == [], "a plan is kept that a rule prunes")
    plans = [found["plan"] for found in sample(generated=True)]
    dropped = window.answer(ask(window, "prune", "terrace.plan", {"library": "street", "plans": plans}))["result"]["answer"]["plans"]
    check(len(plans) == 3 and all("leap" in plan["dropped_by"] for plan in dropped), "pruned plans: %s" % dropped)
    check(sample() == [], "a plan is kept after others were asked for")
    error = window.answer(ask(window, "sample", "cottage.plan", {"library": "cottages", "count": 1, "generated": True})).get("error", {})
    check("houses" in error.get("message", ""), "pruned houses: %s" % error)


def meshes(window, tartan, folder):
    for question, name, request, format, words in MESHES:
        message = window.answer(window.send("tartan/" + question, {"uri": "file:///" + name, "version": 1, "binary": True, "request": request}))
        result = message.get("result", {})
        files = [file for file in result.get("answer", {}).get("files", []) if "text" not in file]
        check(len(files) == len(result.get("bytes", [])) >= 1 and not any("base64" in file for file in files), "%s: %s" % (question, json.dumps(message)[:300]))
        got = {file["format"]: window.parcels.pop(number) for file, number in zip(files, result.get("bytes", []))}
        path = os.path.join(folder, "made." + format)
        subprocess.run([tartan, words[0], name, *words[1:], "-o", path], cwd=folder, capture_output=True, check=True)
        with open(path, "rb") as file:
            check(file.read() == got.get(format), "%s %s is not what the command writes" % (question, request))
        os.remove(path)
    check(not window.parcels, "bytes that no answer names")


def refused_meshes(window):
    """What is wrong or ended has no bytes."""
    ask_mesh = lambda **request: window.send("tartan/mesh", {"uri": "file:///primitives.field", "version": 1, "binary": True, "request": {"format": "glb", **request}})
    error = window.answer(ask_mesh(surface="none")).get("error", {})
    check(error.get("code") == -32803, "a surface that is none: %s" % error)
    ended = ask_mesh(grid=500)
    window.tell("$/cancelRequest", {"id": ended})
    check(window.answer(ended).get("error", {}).get("code") == -32800, "a mesh that was ended")
    check("result" in window.answer(ask_mesh()) and len(window.parcels) == 1, "a mesh behind those")
    window.parcels.clear()


def refused(window, questions):
    for question in questions:
        error = window.answer(ask(window, question, "terrace.plan", {"nonsense": 1})).get("error", {})
        code = -32601 if question in ELSEWHERE else -32602
        check(error.get("code") == code, "%s with a wrong member: %s" % (question, error))
        check(question in ELSEWHERE or "nonsense" in error["message"], "%s does not name it: %s" % (question, error))
        error = window.answer(window.send("tartan/" + question, {"version": 1, "request": {}})).get("error", {})
        check(error.get("code") == code, "%s about no text: %s" % (question, error))


def ended(window, questions):
    numbers = {ask(window, question, "lahave-houses.plan", {}): question for question in questions}
    for number in numbers:
        window.tell("$/cancelRequest", {"id": number})
    last = ask(window, "count", "terrace.plan", {})
    answers = {}
    while last not in answers or len(answers) <= len(numbers):
        message = window.receive()
        if "id" in message:
            check(message["id"] not in answers, "%s is answered twice" % numbers.get(message["id"]))
            answers[message["id"]] = message
    check("result" in answers[last], "what is asked behind them: %s" % answers[last])
    check(sum(answers[n].get("error", {}).get("code") == -32800 for n in numbers) > len(numbers) // 2, "few were ended")


def main():
    tartan = os.path.abspath(sys.argv[1])
    schema = json.loads(subprocess.run([tartan, "help", "--requests", "schema"], capture_output=True, text=True, check=True).stdout)
    questions = sorted(schema["requests"])
    check(ELSEWHERE < set(questions) and {row[0] for row in RIGHT} < set(questions), "questions that are none")
    with tempfile.TemporaryDirectory() as folder:
        for name in ("terrace.plan", "lahave.plan", "lahave-houses.plan", "cottage.plan", "primitives.field", "table.solid", "square.hemls"):
            shutil.copy(os.path.join(ROOT, "stdlib", name), folder)
        shutil.copy(os.path.join(ROOT, "examples", "gatehouse", "gatehouse.kit"), folder)
        shutil.copy(os.path.join(ROOT, "examples", "market-hall", "market.plan"), folder)
        server = Server(tartan, folder, "--no-open")
        window = Window(server)
        window.begin()
        for name in os.listdir(folder):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                window.open(name, file.read())
        right(window, tartan, folder)
        pruned(window)
        meshes(window, tartan, folder)
        refused_meshes(window)
        refused(window, questions)
        ended(window, questions)
        window.close()
        code, _ = server.end()
        check(code == 0, "the server ended with %d" % code)
    for what in wrong:
        print(what)
    sys.exit(bool(wrong))


main()
