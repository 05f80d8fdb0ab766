#!/usr/bin/env python3
"""Measures, questions and open plans against an independent brute force.

usage: measures.py TARTAN ORACLES FIRST LAST     runs the random cases of the seeds FIRST to LAST - 1

Every plan of a case is listed, judged and measured by ORACLES/plan/measures.py; every answer of TARTAN has to be exactly
that. Three slips of the reference are mended here: its memory of rules by their address, which a later rule may reuse, the
bare value `dense`, which two zones of its schema have, and quartiles of no plans, which are null. An answer that would pass
the limit of work (exit 4) is counted apart: there may be few of them, and none that is wrong.
"""
import json, os, re, subprocess, sys, tempfile
from fractions import Fraction

tartan, oracles, first, last = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
sys.path.insert(0, os.path.join(oracles, "plan"))
import measures, oracle


def remembering(judge, number):
    def answer(self, r, i, j):
        key = (number, id(r), i, j)
        if key not in self.memo:
            self.memo[key] = judge(self, r, i, j)
            self.memo.setdefault("rules", []).append(r)
        return self.memo[key]
    return answer


oracle.Oracle.M = remembering(lambda o, r, i, j: o._M(r, i, j), 0)
oracle.Oracle.H = remembering(lambda o, r, i, j: o._H(r, i, j), 1)
faults = []
unanswered = []
asked_count = 0
pruned = 0  # plans of open plans that nothing completes


def mended(text):
    """The reference's words in those that the language settled on."""
    text = text.replace("filled(dense)", "tray(body dense)")
    text = text.replace("some v, u in width where v < u (", "some v, u in width (v < u and ")
    return text.replace("every v, u in width where v < u (", "every v, u in width (v < u implies ")


def run(*arguments):
    done = subprocess.run([tartan, *arguments], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def same(seed, what, found, wanted):
    if found != wanted:
        faults.append("seed %d: %s: %s instead of %s" % (seed, what, str(found)[:300], str(wanted)[:300]))


def asked(seed, what, *arguments):
    """What TARTAN prints, or None where it fails or the question passes its limit of work."""
    global asked_count
    asked_count += 1
    code, out, err = run(*arguments)
    if code == 4 and "--max-states" in err:  # the limit is a choice of the default, and the answer must be right past it too
        code, out, err = run(*arguments, "--max-states", "4000000")
    if code == 4 and any(limit in err for limit in ("steps to build", "MB to build", "transitions at", "limit of 4000000 states")):
        unanswered.append("seed %d: %s" % (seed, what))
        return None
    if code != 0:
        faults.append("seed %d: %s: exit %d: %s" % (seed, what, code, err[:500]))
        return None
    return out


def check_kept(seed, case, wanted, *arguments):
    out = asked(seed, "count " + " ".join(arguments), "count", case, "--json", *arguments)
    if out is None:
        return None
    found = json.loads(out)
    same(seed, "kept of " + " ".join(arguments), int(found["kept"]), wanted)
    return found


def check_distribution(seed, case, name, wanted):
    out = asked(seed, "count --by " + name, "count", case, "--library", "kept", "--by", name, "--json")
    if out is None:
        return
    found = json.loads(out)
    same(seed, name + " values", [[d["value"], int(d["plans"])] for d in found["distribution"]], wanted["distribution"])
    for key in ("mean", "variance"):
        same(seed, name + " " + key, found[key], wanted[key])
    same(seed, name + " dimension", found["dimension"], wanted["dimension"])
    out = asked(seed, "diff", "diff", case, case, "--library", "kept", "--sample", "0", "--json")
    changes = {m["name"]: m for m in json.loads(out)["measures"]} if out else {}
    for side in ("before", "after"):
        if name in changes and found["distribution"]:
            same(seed, name + " " + side, [changes[name][side][k] for k in ("least", "mean", "most")],
                 [found["distribution"][0]["value"], wanted["mean"], found["distribution"][-1]["value"]])
    if "quartiles" in wanted:
        same(seed, name + " quartiles", found["quartiles"], wanted["quartiles"] if found["distribution"] else None)


def lines_of(out, values):
    """Of JSON lines: the value (or values) and the plan line."""
    rows = []
    for line in out.splitlines():
        row = json.loads(line)
        trays = []
        for t in row["trays"]:
            cells = []
            for field in measures.VALUES:
                cell = t[field]
                if isinstance(cell, bool):
                    cells.append(field if cell else "-")
                elif isinstance(cell, dict):
                    cells.append(cell["fill"] + (":" + cell["depth"] if cell.get("depth") else ""))
                else:
                    cells.append(cell)
            trays.append(" ".join(cells))
        value = row["values"] if values else row["value"]
        rows.append((value if isinstance(value, list) else [value]) + [" | ".join(trays)])
    return rows


def check_best(seed, case, arguments, wanted, library="kept", values=False):
    if not wanted:
        return
    out = asked(seed, "best " + " ".join(arguments), "best", case, str(len(wanted)), "--library", library, "--format", "json", *arguments)
    if out is not None:
        same(seed, "best " + " ".join(arguments), lines_of(out, values), [list(w) for w in wanted])


def check_pareto(seed, case, arguments, wanted):
    out = asked(seed, "pareto", "pareto", case, "--library", "kept", "--json", *arguments)
    if out is None:
        return
    found = [p["values"] + [int(p["plans"]), p["plan"]] for p in json.loads(out)["points"]]
    same(seed, "pareto " + " ".join(arguments), found, wanted)


def check_complete(seed, case, pattern, wanted):
    out = asked(seed, "complete " + pattern, "complete", case, pattern, "--library", "kept", "--json")
    if out is None:
        return
    found = json.loads(out)
    same(seed, "complete " + pattern, int(found["plans"]), wanted["plans"])
    trays = [{f: {v: int(n) for v, n in values.items()} for f, values in t.items()} for t in found["trays"]]
    same(seed, "choices of " + pattern, trays, wanted["trays"])
    if "least_x0" in wanted and wanted["least_x0"]:
        check_best(seed, case, ["--least", "x0", "--where", "plan [%s]" % pattern], wanted["least_x0"])


def check_pruned(seed, case, pattern):
    """A plan that is named as pruned fits the pattern, and the interpreter drops it by the clauses that are named."""
    out = asked(seed, "complete, as text, " + pattern, "complete", case, pattern, "--library", "kept")
    found = re.search(r"pruned[^`]*`([^`]*)` by (.*)\n", out or "")
    if not found:
        return 0
    plan, names = found.groups()
    with tempfile.TemporaryDirectory() as folder:
        plans, dropped = os.path.join(folder, "plans"), os.path.join(folder, "dropped")
        with open(plans, "w") as out:
            out.write(plan + "\n")
        same(seed, "kept of " + plan, asked(seed, "prune " + plan, "prune", case, plans, "-l", "kept", "--engine", "vm", "-d", dropped,
                                           "--where", "plan [%s]" % pattern), "")
        with open(dropped) as text:
            same(seed, "what drops " + plan, text.readline(), "# dropped by %s\n" % names)
    return 1


def check_choices(seed, case, pattern):
    """The least x0 that each choice leaves, against the list of all completions: for the trays before the first gap,
    whose places are known; for the others the least of all values of a field."""
    out = asked(seed, "complete --least " + pattern, "complete", case, pattern, "--library", "kept", "--json", "--least", "x0")
    plans = asked(seed, "best of " + pattern, "best", case, "100000", "--library", "kept", "--least", "x0", "--where",
                  "plan [%s]" % pattern, "--format", "json")
    if not out or not plans:
        return
    listed = [(Fraction(v), p.split(" | ")) for v, p in lines_of(plans, False)]
    known = pattern.split(" | ").index("...") if "..." in pattern.split(" | ") else 100
    for k, tray in enumerate(json.loads(out)["trays"]):
        for column, (field, values) in enumerate(tray.items()):
            found = {v: Fraction(c["best"]) for v, c in values.items() if c["best"] is not None}
            same(seed, "best of the choices of " + pattern, min(found.values(), default=None), min((v for v, p in listed), default=None))
            if k >= known:
                continue
            wanted = {}
            for v, p in listed:
                cell = p[k].split(" ")[column]
                wanted[cell] = min(v, wanted.get(cell, v))
            same(seed, "best of each %s of %s" % (field, pattern), found, wanted)


def check(seed, folder):
    global pruned
    measures.main(seed, folder)
    case = os.path.join(folder, "case.plan")
    text = mended(open(case).read())
    open(case, "w").write(text)
    expect = json.load(open(os.path.join(folder, "expect.json")))
    check_kept(seed, case, expect["kept"], "--library", "kept")
    check_kept(seed, case, expect["where"]["kept"], "--library", "kept", "--where", mended(expect["where"]["text"]))
    small = check_kept(seed, case, expect["small"]["kept"], "--library", "small-kept")
    if small:
        same(seed, "small-kept by trays", [int(l["kept"]) for l in small["by_length"]], expect["small"]["by_trays"])
    for c in expect["cases"]:
        where = mended(c["text"])
        check_kept(seed, case, c["kept"], "--library", "kept", "--where", where)
        if c["kept"]:
            out = asked(seed, "enumerate", "enumerate", case, "--library", "kept", "--where", where, "--to", "1")
            if out is not None:
                same(seed, "first of " + where, [l for l in out.splitlines() if not l.startswith("#")], [c["first"]])
    for name, wanted in expect["measures"].items():
        check_distribution(seed, case, name, wanted)
        check_best(seed, case, ["--least", name], wanted["least"])
        check_best(seed, case, ["--most", name], wanted["most"])
    for name, wanted in expect["measures2"].items():
        check_distribution(seed, case, name, wanted)
    check_best(seed, case, ["--least", "x0"], expect["small"]["least_x0"], "small-kept")
    check_best(seed, case, ["--least", "x0", "--then-most", "x1"], expect["then_least_x0_most_x1"], values=True)
    check_pareto(seed, case, ["--least", "m0", "--most", "m1"], expect["pareto_least_m0_most_m1"])
    if expect["pareto3_least_x0_most_x1_least_x2"] is not None:
        check_pareto(seed, case, ["--least", "x0", "--most", "x1", "--least", "x2"], expect["pareto3_least_x0_most_x1_least_x2"])
    for pattern, wanted in list(expect["complete"].items()) + list(expect["complete_best"].items()):
        check_complete(seed, case, pattern, wanted)
        check_choices(seed, case, pattern)
        pruned += check_pruned(seed, case, pattern) if wanted["plans"] == 0 else 0


with tempfile.TemporaryDirectory() as folder:
    for seed in range(first, last):
        check(seed, folder)
for fault in faults:
    print(fault)
for question in unanswered:
    print("not answered, past the limit of work: " + question)
print("%d seeds, %d questions, %d not answered, %d open plans all pruned, %d faults" %
      (last - first, asked_count, len(unanswered), pruned, len(faults)))
sys.exit(1 if faults or len(unanswered) * 50 > asked_count else 0)
