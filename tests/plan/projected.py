#!/usr/bin/env python3
"""Libraries projected onto older schemas, against a brute force.

usage: projected.py TARTAN FIRST LAST     runs the random cases of the seeds FIRST to LAST - 1

A case is a schema, one made from it, and often one made from that; a library of the newest with requirements, prunes, totals or what it
generates; its projections, one of another or one past a schema; libraries made from them; and one of a schema that is made from the oldest
in another way. All plans of each schema are listed here, and judged by what the words mean: a plan is in a projection if some plan of the
library is that plan without its newer fields. Both engines of TARTAN, and everything else that it is asked, have to agree.
"""
import itertools
import json
import os
import random
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from extend import Schema, json_tray, metres, random_items, random_rule, random_tray, spelled

PROGRAM, FIRST, LAST = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
PLANS_MAX = 4000


class Failed(Exception):
    pass


def newer_schema(r, name, older):
    """Has a field more, or values more, or both; fields so named that no other has the name."""
    added = {}
    if r.random() < 0.7:
        added["f" + name] = [name + "-one", name + "-two"]
    if r.random() < (0.4 if added else 1):
        field = r.choice(["a", "w"])
        added[field] = [name + "-more"] if field == "a" else ["3m" if "3m" not in older.fields["w"] else "4m"]
    return Schema(name, older, added)


def made_of(r, schema):
    """(text, judgement) of what each plan as a whole is."""
    (one, is_one), (other, is_other) = random_tray(r, schema, True), random_tray(r, schema, True)
    return r.choice([
        ("many(%s)" % one, lambda p: len(p) > 0 and all(map(is_one, p))),
        ("repeat(%s, 1..2)" % one, lambda p: 0 < len(p) < 3 and all(map(is_one, p))),
        ("neighbour(%s, optional(many(%s)), %s)" % (one, other, one), lambda p: len(p) > 1 and is_one(p[0]) and is_one(p[-1]) and all(map(is_other, p[1:-1]))),
        ("neighbour(beginning, repeat(neighbour(%s, %s), 1..), end)" % (one, other),
         lambda p: len(p) > 0 and len(p) % 2 == 0 and all((is_other if i % 2 else is_one)(t) for i, t in enumerate(p)))])


def clauses(r, schema, most, generates=False):
    """[(text, does it keep the plan)]"""
    made = []
    for _ in range(r.randint(0, most)):
        body, judge = random_rule(r, schema, True, [])
        kind = r.choice(["prune", "require", "total"])
        if kind == "total":
            n = r.randint(1, 5)
            made.append(("total w <= %dm" % n, lambda p, n=n: sum(metres(t["w"]) for t in p) <= n))
        elif kind == "prune":
            made.append(("prune %s" % body, lambda p, judge=judge: not judge(p)))
        else:
            made.append(("require %s" % body, judge))
    if generates and r.random() < 0.4:
        body, judge = made_of(r, schema)
        made.append(("generate %s" % body, judge))
    return made


class Library:
    def __init__(self, name, schema, head, kept, above=None):
        self.name, self.schema, self.head, self.kept, self.above = name, schema, head, kept, above

    def text(self, lines):
        return "library %s %s {\n%s}\n" % (self.name, self.head, "".join("  %s\n" % line for line in lines))


class Case:
    def __init__(self, seed):
        self.r = r = random.Random("projected %d" % seed)
        base = Schema("bone", None, {"a": ["p", "q"], "w": ["1m", "2m"][:r.randint(1, 2)]})
        self.schemas = [base, newer_schema(r, "flesh", base)]
        if r.random() < 0.6:
            self.schemas.append(newer_schema(r, "skin", self.schemas[-1]))
        self.other = newer_schema(r, "coat", base)
        self.forbidden, self.text, self.libraries = {}, "", []
        for schema in self.schemas + [self.other]:
            older = self.forbidden[schema.older.name] if schema.older else []
            forbids = [random_items(r, schema, True)] if r.random() < 0.3 else []
            self.forbidden[schema.name] = older + forbids
            self.text += schema.text(forbids)
        self.text += "rule beside(first, second) using bone = symmetric neighbour(first, second)\n"
        self.trays = {s.name: s.trays(self.forbidden[s.name]) for s in self.schemas + [self.other]}
        self.legal = all(self.trays.values())
        if self.legal:
            self.make_libraries()

    def bare(self, schema, plan):
        """The plan without what is newer than the schema; None: it has a value that the schema does not have."""
        trays = [{f: t[f] for f in schema.fields} for t in plan]
        return trays if all(t[f] in schema.fields[f] for t in trays for f in schema.fields) else None

    def plans(self, schema):
        return [list(p) for n in range(self.longest + 1) for p in itertools.product(self.trays[schema.name], repeat=n)]

    def add(self, name, schema, head, plans, lines, above=None):
        kept = [p for p in plans if all(keeps(p) for _, keeps in lines)]
        library = Library(name, schema, head, kept, above)
        self.text += library.text(([] if " from " in " " + head else ["trays 0..%d" % self.longest]) + [text for text, _ in lines])
        self.libraries.append(library)
        return library

    def project(self, name, above, schema, most):
        images = {str(self.bare(schema, p)) for p in above.kept if self.bare(schema, p) is not None}
        plans = [p for p in self.plans(schema) if str(p) in images]
        return self.add(name, schema, "from %s onto %s" % (above.name, schema.name), plans, clauses(self.r, schema, most), above)

    def make_libraries(self):
        r, newest = self.r, self.schemas[-1]
        widest = max(map(len, self.trays.values()))
        self.longest = max(n for n in range(6) if widest ** n <= PLANS_MAX)
        whole = self.add("whole", newest, "using %s" % newest.name, self.plans(newest), clauses(r, newest, 2, True))
        bare = self.project("bare", whole, self.schemas[-2], r.randint(0, 1))
        self.add("less", bare.schema, "from bare", bare.kept, clauses(r, bare.schema, 2))
        lowest = bare
        if len(self.schemas) > 2:
            lowest = self.project("barest", self.libraries[-1] if r.random() < 0.5 else bare, self.schemas[0], r.randint(0, 1))
            self.project("at-once", whole, self.schemas[0], 0)
        held = {str(p) for p in lowest.kept}
        dressed = [p for p in self.plans(self.other) if str(self.bare(lowest.schema, p)) in held]
        self.add("dressed", self.other, "using %s from %s" % (self.other.name, lowest.name), dressed, clauses(r, self.other, 1))


def run(*words, text=None):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, input=text)


def ask(*words, text=None):
    done = run(*words, text=text)
    if done.returncode != 0:
        raise Failed("%s: %d %s" % (" ".join(words), done.returncode, done.stderr[:800]))
    return done.stdout


def same(what, found, wanted):
    if found != wanted:
        raise Failed("%s: %s instead of %s" % (what, str(found)[:400], str(wanted)[:400]))


def as_json(plan):
    return json.dumps({"trays": [json_tray(t) for t in plan]}, separators=(",", ":"))


def as_line(plan):
    return " | ".join(" ".join(spelled(t).values()) for t in plan)


def listed(case, path, library):
    """In the order of ranks, which is that of the lists here."""
    same("plans", [said["trays"] for said in map(json.loads, ask("enumerate", path, "-l", library.name, "--format", "json").splitlines())],
         [json.loads(as_json(p))["trays"] for p in library.kept])


def counted(case, path, library):
    said = json.loads(ask("count", path, "-l", library.name, "--json"))
    same("count", [int(said["kept"])] + [int(n["kept"]) for n in said["by_length"]],
         [len(library.kept)] + [sum(len(p) == n for p in library.kept) for n in range(case.longest + 1)])


def decided(case, path, library):
    """One plan after another, by both engines."""
    every = case.plans(library.schema)
    for engine in ("vm", "dfa"):
        found = ask("prune", path, "-l", library.name, "--engine", engine, "--format", "json", "-", text="".join(as_json(p) + "\n" for p in every))
        same("kept by " + engine, [json.loads(line)["trays"] for line in found.splitlines()], [json.loads(as_json(p))["trays"] for p in library.kept])


def some(case, library, count):
    plans = case.plans(library.schema)
    return case.r.sample(plans, min(count, len(plans)))


def in_ways(case, path, library):
    """How many plans of the other library each plan is without their newer fields: in all, of the most, and of each."""
    if not library.above:
        return
    plans = [case.bare(library.schema, p) for p in library.above.kept]
    numbers = [plans.count(p) for p in library.kept]
    said = json.loads(ask("count", path, "-l", library.name, "--ways", "--json"))
    same("ways", (int(said["plans"]), int(said["ways"]), said["projected"]), (len(numbers), sum(numbers), library.above.name))
    same("plans by their ways", [[int(n) for n in row] for row in said["distribution"]], sorted([n, numbers.count(n)] for n in set(numbers)))
    if numbers:
        most = max(numbers)
        same("most", (int(said["most"]), said["first"]), (most, as_line(library.kept[numbers.index(most)])))
    listed = ask("enumerate", path, "-l", library.name, "--ways").split("\n")[:-1]
    same("ways of each", [int(line.split("\t")[0]) for line in listed], numbers)


def explained(case, path, library):
    """The first plan above one that is kept; of one that is not, which clause drops it, and the nearest plans."""
    held = {str(p): n for n, p in enumerate(library.kept)}
    for plan in some(case, library, 5) + library.kept[-2:]:
        said = json.loads(ask("explain", path, "-l", library.name, "--json", as_line(plan)))
        same("explain keeps `%s`" % as_line(plan), said["kept"], str(plan) in held)
        if str(plan) in held:
            same("rank", int(said["rank"]), held[str(plan)])
        elif library.kept:
            near = min(distance(plan, other, len(library.schema.fields)) for other in library.kept)
            same("distance of `%s`" % as_line(plan), said["distance"], near)
        above = [p for p in library.above.kept if case.bare(library.schema, p) == plan] if library.above else []
        clause = next((c for c in said["clauses"] if c["kind"] == "onto" and library.above and c["name"] == library.above.name), None)
        if clause:
            same("a plan above `%s`" % as_line(plan), (clause["matches"], clause.get("above"), clause.get("ways")),
                 (bool(above), as_line(above[0]) if above else None, str(len(above)) if above else None))


def distance(plan, other, fields):
    """A field that differs costs 1, a tray more or fewer as many as there are fields."""
    row = [fields * j for j in range(len(other) + 1)]
    for tray in plan:
        last, row = row, [row[0] + fields]
        for j, at in enumerate(other):
            row.append(min(last[j] + sum(tray[f] != at[f] for f in tray), last[j + 1] + fields, row[j] + fields))
    return row[-1]


def longer(case, path, library):
    """Of plans so long that the newer ones are too many to be listed: what explain follows, and the automaton; and that the plan above is one of
    the library."""
    if not library.above:
        return
    long_path = path[:-5] + "-long.plan"
    with open(long_path, "w") as out:
        out.write(case.text.replace("trays 0..%d" % case.longest, "trays 0..16"))
    trays = case.trays[library.schema.name]
    plans = [as_line(case.r.choice(trays) for _ in range(case.r.randint(10, 16))) for _ in range(4)]
    plans += ask("sample", long_path, "4", "-l", library.name, "--seed", "7").splitlines()
    kept = ask("prune", long_path, "-l", library.name, "-", text="".join(p + "\n" for p in plans)).splitlines()
    for plan in plans:
        said = json.loads(ask("explain", long_path, "-l", library.name, "--json", plan))
        same("explain keeps the long plan `%s`" % plan, said["kept"], plan in kept)
        above = next(c for c in said["clauses"] if c["kind"] == "onto" and c["name"] == library.above.name).get("above")
        if above:
            same("the library keeps the plan above", json.loads(ask("explain", long_path, "-l", library.above.name, "--json", above))["kept"], True)


def tested(case, path, library):
    """A file with tests, which all pass."""
    held = [str(p) for p in library.kept]
    cases = "".join("  %s [%s]\n" % ("keep" if str(p) in held else "drop", as_line(p)) for p in some(case, library, 6) if p)
    if cases:
        with open(path[:-5] + "-tests.plan", "w") as out:
            out.write(case.text + "test %s {\n%s}\n" % (library.name, cases))
        ask("test", path[:-5] + "-tests.plan")


def compared(case, path, library):
    """With what it is when it prunes more."""
    if not library.above:
        return
    head = "library %s %s {\n" % (library.name, library.head)
    with open(path[:-5] + "-after.plan", "w") as out:
        out.write(case.text.replace(head, head + "  prune tray(a p)\n"))
    said = json.loads(ask("diff", path, path[:-5] + "-after.plan", "-l", library.name, "--json"))["total"]
    left = sum(not any(t["a"] == "p" for t in p) for p in library.kept)
    same("diff", (int(said["removed"]), int(said["added"]), int(said["kept"])), (len(library.kept) - left, 0, left))


def built(case, path, library):
    """The module means the same."""
    ask("build", path, "-o", path[:-5] + ".tnb")
    same("the module", ask("count", path[:-5] + ".tnb", "-l", library.name, "--no-effects"), ask("count", path, "-l", library.name, "--no-effects"))


def laid_out(case, path, library):
    once = ask("fmt", "-", text=case.text)
    same("layout", ask("fmt", "-", text=once), once)
    same("words", "".join(once.split()), "".join(case.text.split()))


QUESTIONS = (listed, counted, in_ways, decided, explained, longer, tested, compared, built)


def check(seed, folder):
    case = Case(seed)
    if not case.legal:          # a schema forbids every tray, which is an error
        return 0, False
    path = os.path.join(folder, "%d.plan" % seed)
    with open(path, "w") as out:
        out.write(case.text)
    for library in case.libraries:
        for question in QUESTIONS + ((laid_out,) if library is case.libraries[0] else ()):
            try:
                question(case, path, library)
            except Failed as failed:
                print("seed %d, %s of %s: %s\n%s" % (seed, question.__name__, library.name, failed, case.text))
                return 1, True
    bare = case.libraries[1]
    return 0, 0 < len(bare.kept) < len(case.plans(bare.schema))


def main():
    wrong = undecided = 0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(FIRST, LAST):
            faults, means = check(seed, folder)
            wrong, undecided = wrong + faults, undecided + means
    print("%d cases, %d of them neither all nor nothing, %d wrong" % (LAST - FIRST, undecided, wrong))
    sys.exit(wrong > 0 or undecided < (LAST - FIRST) // 4)


main()
