#!/usr/bin/env python3
"""Holds in how many ways plans are derived to a slow reference: ways.py TARTAN ORACLES FIRST LAST

ORACLES/plan/third.py makes random files with a library `made` of what rules that use themselves generate, and finds the ways of its plans by
listing all; and a library `bare`, a projection of another. Asked are `count --ways`, and `enumerate --ways` of the first plans. Files that
the reference has and the language refuses (a remainder that is none) are passed over.
"""
import json
import os
import re
import subprocess
import sys
import tempfile

PROGRAM, ORACLES, FIRST, LAST = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
REFUSED = ("E0410",)


class Failed(Exception):
    pass


def ask(*words):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True)
    if done.returncode == 0:
        return done.stdout
    code = re.search(r"error\[(E\d+)\]", done.stderr)
    if code and code[1] in REFUSED:
        return None
    raise Failed(f"{' '.join(words)}: {done.returncode} {done.stderr[:600]}")


def case(seed, folder):
    """(the file's path, what is to be found of its libraries). What else there is in the file is left out."""
    subprocess.run([sys.executable, "-B", os.path.join(ORACLES, "plan", "third.py"), str(seed), folder], check=True)
    with open(os.path.join(folder, "case.plan")) as file:
        text = file.read()
    text = text[:text.index("library kept")] + text[text.index("schema zoned-row"):text.index("library few")]
    text = text.replace("shut-on(side)", "shut-on(edge)").replace("tray(side shut)", "tray(edge shut)")
    path = os.path.join(folder, "made.plan")
    with open(path, "w") as file:
        file.write(text)
    with open(os.path.join(folder, "expect.json")) as file:
        return path, json.load(file)["libraries"]


def same(what, got, wanted):
    if got != wanted:
        raise Failed(f"{what}: {got} instead of {wanted}")


def counted(path, library, wanted):
    """Whether it was answered."""
    found = ask("count", path, "--library", library, "--ways", "--json")
    if found is None:
        return False
    found = json.loads(found)
    rows = [[int(n) for n in row] for row in found["distribution"]]
    same("plans", int(found["plans"]), sum(wanted["by_trays"]))
    same("ways", int(found["ways"]), wanted["all_ways"])
    same("most", int(found["most"] or 0), wanted["most_ways"])
    same("rows", [sum(plans for _, plans in rows), sum(ways * plans for ways, plans in rows)], [sum(wanted["by_trays"]), wanted["all_ways"]])
    lines = ask("enumerate", path, "--library", library, "--ways", "--limit", "40").splitlines()
    same("ways of plans", [[line.split("\t")[1], int(line.split("\t")[0])] for line in lines], wanted["ways"])
    return True


def main():
    wrong = refused = 0
    for seed in range(FIRST, LAST):
        with tempfile.TemporaryDirectory() as folder:
            path, libraries = case(seed, folder)
            for library in ("made", "bare"):
                try:
                    refused += not counted(path, library, libraries[library])
                except Failed as failed:
                    print(f"seed {seed}, {library}: {failed}")
                    wrong += 1
    print(f"{LAST - FIRST} cases, {refused} questions refused, {wrong} wrong")
    sys.exit(wrong > 0 or refused > (LAST - FIRST) * 2 / 5)


main()
