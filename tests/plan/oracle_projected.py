#!/usr/bin/env python3
"""Holds projected libraries to a slow reference: oracle_projected.py TARTAN ORACLES FIRST LAST

ORACLES/plan/third.py writes random files with a library `zoned` and its projection `bare`, and finds by trying all which plans they have.
"""
import importlib.util
import json
import os
import subprocess
import sys
import tempfile

PROGRAM, ORACLES, FIRST, LAST = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
spec = importlib.util.spec_from_file_location("third", os.path.join(ORACLES, "plan", "third.py"))
third = importlib.util.module_from_spec(spec)
spec.loader.exec_module(third)


class Failed(Exception):
    pass


def ask(*words, text=None):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, input=text)
    if done.returncode != 0:
        raise Failed(f"{' '.join(words)}: {done.returncode} {done.stderr[:2000]}")
    return done.stdout


def same(what, got, wanted):
    if got != wanted:
        raise Failed(f"{what}: {str(got)[:300]} instead of {str(wanted)[:300]}")


def check(seed, folder):
    third.main(seed, folder)
    path = os.path.join(folder, "case.plan")
    with open(path) as file:
        text = file.read()
    with open(path, "w") as out:        # what comes behind is about rows of plans
        out.write(text[:text.index("library few from kept")].replace("shut-on(side) using row = tray(side shut)", "shut-on(which) using row = tray(which shut)"))
    with open(os.path.join(folder, "expect.json")) as file:
        wanted = json.load(file)["libraries"]
    with open(os.path.join(folder, "plans.txt")) as file:
        plans = file.read()[:-1].split("\n")
    count = lambda library: json.loads(ask("count", path, "-l", library, "--json", "--no-effects"))
    same("plans of zoned", int(count("zoned")["kept"]), wanted["zoned"]["kept"])
    same("plans by trays", [int(n["kept"]) for n in count("bare")["by_length"]], wanted["bare"]["by_trays"])
    kept = ask("enumerate", path, "-l", "bare").split("\n")[:-1]
    same("the first plans", kept[:5], wanted["bare"]["first"])
    ways = [line.split("\t") for line in ask("enumerate", path, "-l", "bare", "--ways", "--limit", "40").split("\n")[:-1]]
    same("plans with their ways", [[plan, int(n)] for n, plan in ways], wanted["bare"]["ways"])
    counted = json.loads(ask("count", path, "-l", "bare", "--ways", "--json"))
    same("ways", (int(counted["ways"]), int(counted["most"] or 0)), (wanted["bare"]["all_ways"], wanted["bare"]["most_ways"]))
    longest = len(wanted["bare"]["by_trays"]) - 1
    asked = [p for p in plans if p.count("|") < longest]
    for engine in ("vm", "auto"):
        same(f"kept by {engine}", ask("prune", path, "-l", "bare", "--engine", engine, "-", text="\n".join(asked) + "\n").split("\n")[:-1], kept)
    for plan, _ in wanted["bare"]["ways"][:3]:
        said = json.loads(ask("explain", path, "-l", "bare", "--json", plan))
        same(f"explain keeps `{plan}`", said["kept"], True)
    return len(kept)


def main():
    wrong = some = refused = 0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(FIRST, LAST):
            try:
                some += check(seed, folder) > 1
            except Failed as failed:
                if "error[E0410]" in str(failed):   # a remainder that no number has: the reference writes such, files may not
                    refused += 1
                    continue
                print(f"seed {seed}: {failed}")
                wrong += 1
    print(f"{LAST - FIRST} cases, {some} of them with plans, {refused} refused, {wrong} wrong")
    sys.exit(wrong > 0 or some == 0 or 10 * refused > LAST - FIRST)


main()
