#!/usr/bin/env python3
"""Schemas of millions of trays, or of few trays among millions of combinations, beside what their definitions say.

usage: many_trays.py TARTAN
"""
import itertools
import json
import os
import subprocess
import sys
import tempfile

tartan = sys.argv[1]
folder = tempfile.TemporaryDirectory()


def run(*arguments, text=None, code=0):
    done = subprocess.run([tartan, *arguments], input=text, capture_output=True, text=True)
    assert done.returncode == code, (arguments, done.returncode, done.stderr)
    return done.stderr if code else done.stdout


def write(name, lines):
    path = os.path.join(folder.name, name)
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n")
    return path


def kept_by_length(path, *more):
    answer = json.loads(run("count", path, "--json", *more))
    return [int(row["kept"]) for row in answer["by_length"]]


# ---- 20 fields of two and three values: 3,538,944 trays, as a product of the fields that rules name
SIZES = [2] * 17 + [3] * 3
TRAYS = 2**17 * 3**3
wide = write("wide.plan", ["schema s {", *("  f%d = %s" % (f, " | ".join("%s%d" % (v, f) for v in "abc"[:size])) for f, size in enumerate(SIZES)), "}",
                           "rule near = neighbour(tray(a0, b3), tray(b17))", "rule three = quantity(tray(a1, c19), n > 2)",
                           "measure m = quantity(tray(a2))", "measure n = sum(weight)", "library L { trays 1..3 prune near, three }"])
text = open(wide).read().replace("}\nrule", "  number weight = 3 where tray(a0, c19) | 1 where tray(b18) | 0\n}\nrule", 1)
open(wide, "w").write(text)


def wide_kinds():
    """What the clauses and measures tell apart of a tray, and how many trays are so."""
    kinds = {}
    named = {0: 2, 1: 2, 2: 2, 3: 2, 17: 3, 18: 3, 19: 3}
    rest = TRAYS
    for size in named.values():
        rest //= size
    for values in itertools.product(*(range(size) for size in named.values())):
        v = dict(zip(named, values))
        weight = 3 if v[0] == 0 and v[19] == 2 else 1 if v[18] == 1 else 0
        kind = (v[0] == 0 and v[3] == 1, v[17] == 1, v[1] == 0 and v[19] == 2, v[2] == 0, weight)
        kinds[kind] = kinds.get(kind, 0) + rest
    return kinds


def wide_counts(longest):
    kinds = wide_kinds()
    states = {(False, 0, 0, 0): 1}  # of the tray before, how many are three's, the measures
    counts = []
    for _ in range(longest):
        following = {}
        for (before, threes, m, n), ways in states.items():
            for (first, second, third, a2, weight), trays in kinds.items():
                if before and second or threes + third > 2:
                    continue
                key = (first, threes + third, m + a2, n + weight)
                following[key] = following.get(key, 0) + ways * trays
        states = following
        counts.append(states)
    return counts


counts = wide_counts(3)
assert kept_by_length(wide) == [sum(states.values()) for states in counts], "plans of the wide schema"
total = sum(sum(states.values()) for states in counts)
for at, measure in ((2, "m"), (3, "n")):
    by = {}
    for states in counts:
        for state, ways in states.items():
            by[state[at]] = by.get(state[at], 0) + ways
    found = json.loads(run("count", wide, "--by", measure, "--json"))
    assert {int(row["value"]): int(row["plans"]) for row in found["distribution"]} == by, measure


def tray(number):
    words = []
    for f in reversed(range(20)):
        number, value = divmod(number, SIZES[f])
        words.append("%s%d" % ("abc"[value], f))
    return " ".join(reversed(words))


# Of one tray all plans are kept, so their ranks are the trays' numbers.
for number in (0, 1, 26, 27, 28, 100000, 3538943):
    assert run("unrank", wide, str(number)).strip() == tray(number), number
    assert run("rank", wide, tray(number)).strip() == str(number), number
lines = run("enumerate", wide, "--from", "26", "--limit", "4").splitlines()
assert lines == [tray(26 + i) for i in range(4)], lines
for rank in (TRAYS, TRAYS + 1000003, total // 3, total - 1):
    assert run("rank", wide, run("unrank", wide, str(rank)).strip()).strip() == str(rank)
drawn = run("sample", wide, "200", "--seed", "7")
assert run("prune", wide, text=drawn) == drawn
assert run("sample", wide, "200", "--seed", "7", "--threads", "4") == drawn
dropped = "%s | %s" % (tray(0).replace("a3", "b3"), tray(0).replace("a17", "b17"))
assert "drops this plan by near" in run("explain", wide, dropped)
best = run("best", wide, "3", "--most", "m", "--then-least", "n").splitlines()
assert best[0].startswith("# 3"), best
packed = os.path.join(folder.name, "plans.bin")
run("sample", wide, "50", "--format", "bin", "-o", packed)
assert run("prune", wide, packed).count("\n") == 50
assert "E0803" in run("complete", wide, "... | " + tray(3), code=4)
module = os.path.join(folder.name, "wide.tnb")
run("build", wide, "-o", module)
assert kept_by_length(module) == kept_by_length(wide)
both = write("both.plan", text.replace("library L { trays 1..3 prune near, three }",
                                       "rule far = not near\nlibrary L { trays 1..3 prune three require far }").splitlines())
hashes = [json.loads(run("count", path, "--json"))["hash"] for path in (wide, both)]
assert hashes[0] == hashes[1], "equal plans, equal hash"
fewer = write("fewer.plan", text.replace("n > 2", "n > 1").splitlines())
assert json.loads(run("count", fewer, "--json"))["hash"] != hashes[0], "other plans, another hash"
changed = json.loads(run("diff", wide, fewer, "--json"))["total"]
assert [int(changed[part]) for part in ("removed", "added")] == [total - sum(kept_by_length(fewer)), 0], changed
turned = write("turned.plan", text.replace("  f0 = a0 | b0\n  f1 = a1 | b1\n", "  f1 = a1 | b1\n  f0 = a0 | b0\n").splitlines())
assert "E0803" in run("diff", wide, turned, code=4)
lacking = write("lacking.plan", text.replace("  number", "  forbid tray(a0, a4)\n  number").splitlines())
assert "E0508" in run("diff", wide, lacking, code=1)

# ---- 12 fields of 4 values: a place is white, black, or the left or right half of a domino. Tilings are Pell's numbers.
PLACES = 12
rows = ["schema s {"]
rows += ["  p%d = w%d | k%d | l%d | r%d" % (i, i, i, i, i) for i in range(PLACES)]
rows += ["  forbid tray(r0)", "  forbid tray(l%d)" % (PLACES - 1)]
for i in range(PLACES - 1):
    rows += ["  forbid tray(l%d, w%d or k%d or l%d)" % (i, i + 1, i + 1, i + 1), "  forbid tray(w%d or k%d or r%d, r%d)" % (i, i, i, i + 1)]
domino = write("domino.plan", rows + ["}", "rule alike = neighbour(tray(w0, l4), tray(k11))", "library L { trays 1..2 prune alike }"])


def tilings(places):
    return ([[]] if places == 0 else
            [[a] + rest for a in "wk" for rest in tilings(places - 1)] +
            ([["l", "r"] + rest for rest in tilings(places - 2)] if places > 1 else []))


legal = sorted(tilings(PLACES), key=lambda tiling: ["wklr".index(half) for half in tiling])
assert len(legal) == 33461
first = sum(t[0] == "w" and t[4] == "l" for t in legal)
second = sum(t[11] == "k" for t in legal)
assert kept_by_length(domino) == [len(legal), len(legal) ** 2 - first * second]
for number in (0, 1, 4711, 33460):
    assert run("unrank", domino, str(number)).split() == ["%s%d" % (half, i) for i, half in enumerate(legal[number])]
