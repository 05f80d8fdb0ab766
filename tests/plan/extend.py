#!/usr/bin/env python3
"""Schemas made from others, against a brute force.

usage: extend.py TARTAN FIRST LAST     runs the random cases of the seeds FIRST to LAST - 1

A case is a pack of rules over one schema, with a library; a schema made from it, perhaps by way of another; and a library
of the newer schema with more rules. New values often have the names of older values of other fields. All plans of the
newest schema are listed and judged here; both engines of TARTAN have to keep exactly those that are kept here.
"""
import itertools, json, os, random, subprocess, sys, tempfile

tartan, first, last = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
OPERATORS = {"<": lambda a, b: a < b, "<=": lambda a, b: a <= b, "=": lambda a, b: a == b, ">=": lambda a, b: a >= b,
             ">": lambda a, b: a > b, "!=": lambda a, b: a != b}
faults = []


def metres(length):
    return int(length[:-1])


class Schema:
    """fields: {name: [value]}; of `w` lengths, of `z` (fill, depth or None)."""

    def __init__(self, name, older, added):
        self.name, self.older, self.added = name, older, added
        self.fields = {f: list(v) for f, v in older.fields.items()} if older else {}
        for field, values in added.items():
            self.fields[field] = self.fields.get(field, []) + values

    def text(self, forbids):
        lines = []
        for field, values in self.added.items():
            spelled = [v if field != "z" else v[0] + ("(%s)" % v[1] if v[1] else "") for v in values]
            more = ["..."] if self.older and field in self.older.fields else []
            lines.append("  %s%s = %s" % ("zone " if field == "z" else "", field, " | ".join(more + spelled)))
        lines += ["  forbid tray(%s)" % ", ".join(text for text, _ in items) for items in forbids]
        return "schema %s%s {\n%s\n}\n" % (self.name, " from " + self.older.name if self.older else "", "\n".join(lines))

    def trays(self, forbidden):
        trays = [dict(zip(self.fields, values)) for values in itertools.product(*self.fields.values())]
        return [t for t in trays if not any(all(test(t) for _, test in items) for items in forbidden)]

    def owners(self, word):
        return [f for f, values in self.fields.items() if f != "w" and any((v[0] if f == "z" else v) == word for v in values)]


def random_item(r, schema, qualify):
    """(text, test of a tray {field: value})."""
    field = r.choice(list(schema.fields))
    if field == "w":
        op, value = r.choice([(o, v) for o in OPERATORS for v in schema.fields["w"] if any(OPERATORS[o](metres(x), metres(v)) for x in schema.fields["w"])])
        return "w %s %s" % (op, value), lambda t: OPERATORS[op](metres(t["w"]), metres(value))
    value = r.choice(schema.fields[field])
    word = value[0] if field == "z" else value
    named = field + " " if qualify or len(schema.owners(word)) > 1 or r.random() < 0.2 else ""
    negated = r.random() < 0.4
    if field == "z" and value[1] and r.random() < 0.5:
        test, text = (lambda t: t["z"] == value), "%s%s %s" % (named, word, value[1])
    elif field == "z":
        test, text = (lambda t: t["z"][0] == word), named + word
    else:
        test, text = (lambda t: t[field] == word), named + word
    return ("not " + text, lambda t: not test(t)) if negated else (text, test)


def random_items(r, schema, qualify):
    return [random_item(r, schema, qualify) for _ in range(r.randint(1, 2))]


def random_tray(r, schema, qualify):
    items = random_items(r, schema, qualify)
    return "tray(%s)" % ", ".join(text for text, _ in items), lambda t: all(test(t) for _, test in items)


def random_rule(r, schema, qualify, named, deep=0):
    """(text, judgement of a plan, a list of trays of the newest schema)."""
    kind = r.choice(["tray", "quantity", "neighbour", "sum", "some", "each", "call", "not", "or", "and", "name"])
    one, other = random_tray(r, schema, qualify), random_tray(r, schema, qualify)
    n, op = r.randint(0, 2), r.choice(list(OPERATORS))
    if kind in ("not", "or", "and") and deep < 2:
        a = random_rule(r, schema, qualify, named, deep + 1)
        b = random_rule(r, schema, qualify, named, deep + 1)
        if kind == "not":
            return "not (%s)" % a[0], lambda p: not a[1](p)
        joined = any if kind == "or" else all
        return "((%s) %s (%s))" % (a[0], kind, b[0]), lambda p: joined([a[1](p), b[1](p)])
    if kind == "name" and named:
        return r.choice(named)
    if kind == "quantity":
        return "quantity(%s) %s %d" % (one[0], op, n), lambda p: OPERATORS[op](sum(map(one[1], p)), n)
    if kind == "sum":
        return "sum(w of %s) %s %dm" % (one[0], op, n + 2), lambda p: OPERATORS[op](sum(metres(t["w"]) for t in p if one[1](t)), n + 2)
    if kind == "neighbour":
        return "neighbour(%s, %s)" % (one[0], other[0]), lambda p: any(one[1](a) and other[1](b) for a, b in zip(p, p[1:]))
    if kind == "call":
        return "beside(%s, %s)" % (one[0], other[0]), lambda p: any((one[1](a) and other[1](b)) or (other[1](a) and one[1](b)) for a, b in zip(p, p[1:]))
    field = r.choice([f for f in schema.fields if f != "z"])
    if kind == "some":
        return "some v in %s (quantity(tray(%s v)) > 1)" % (field, field), lambda p: len({t[field] for t in p}) < len(p)
    if kind == "each":
        return "every v, u in %s (v = u or not neighbour(tray(%s v), tray(%s u)))" % (field, field, field), lambda p: all(a[field] == b[field] for a, b in zip(p, p[1:]))
    return one[0], lambda p: any(map(one[1], p))


def chain(r):
    words = ["p", "q", "s", "t", "k", "l"]
    fields = {"a": r.sample(words, 2), "w": ["1m", "2m"]}
    rest = [x for x in words if x not in fields["a"]]
    if r.random() < 0.5:
        fields["b"] = rest[:2]
    if r.random() < 0.5:
        fields["z"] = [("full", "1m"), ("none", None)]
    schemas = [Schema("base", None, fields)]
    for name in ["mid", "big"][r.randint(0, 1):]:
        older, added = schemas[-1], {}
        if r.random() < 0.6:
            added["w"] = [r.choice([x for x in ["3m", "4m"] if x not in older.fields["w"]] or ["5m"])]
        field = r.choice(["a", "b"])
        if field in older.fields:
            added[field] = [r.choice([x for x in words if x not in older.fields[field]])]
        if "z" in older.fields and r.random() < 0.5:
            new = r.choice([("full", "2m"), ("wet", "1m")])
            if new not in older.fields["z"]:
                added["z"] = [new]
        if "c%d" % len(schemas) not in older.fields and (not added or r.random() < 0.4):
            added["c%d" % len(schemas)] = r.sample(words, 2)
        schemas.append(Schema(name, older, added))
    return schemas


def case(seed):
    r = random.Random(seed)
    schemas = chain(r)
    newest, judged, files, named = schemas[-1], [], {}, []
    forbidden = []
    for depth, schema in enumerate(schemas):
        text = "" if depth == 0 else 'use "%s.plan"\n' % schemas[depth - 1].name
        forbids = [random_items(r, schema, False)] if r.random() < 0.3 else []
        forbidden += forbids
        text += schema.text(forbids)
        if not schema.trays(forbidden):
            return None
        using = " using " + schema.name if depth else ""
        if depth == 0:
            text += "rule beside(first, second) = symmetric neighbour(first, second)\n"
        new = []
        for i in range(2):
            body, judge = random_rule(r, schema, depth > 0, named)
            name = "%s-%d" % (schema.name, i)
            text += "rule %s%s = %s\n" % (name, using, body)
            new.append((name, judge))
        named = named + new
        require, demanded = random_rule(r, schema, depth > 0, [])  # not a rule's name: the library may have that clause
        judged.append((new[0][1], demanded))
        origin = " using %s from lib-%s" % (schema.name, schemas[depth - 1].name) if depth else ""
        text += "library lib-%s%s { %s prune %s require %s }\n" % (schema.name, origin, "" if depth else "trays 1..2", new[0][0], require)
        files[schema.name] = text
    trays = newest.trays(forbidden)
    plans = [list(p) for n in (1, 2) for p in itertools.product(trays, repeat=n)]
    kept = [p for p in plans if all(not pruned(p) and demanded(p) for pruned, demanded in judged)]
    return newest, files, plans, kept


def spelled(tray):
    return {f: v if isinstance(v, str) else v[0] if not v[1] else v[0] + ":" + v[1] for f, v in tray.items()}


def line(plan):
    return json.dumps({"trays": [spelled(t) for t in plan]}, sort_keys=True)


def run(seed, *arguments, text=None):
    done = subprocess.run([tartan, *arguments], capture_output=True, text=True, input=text)
    if done.returncode not in (0,):
        faults.append("seed %d: %s: exit %d: %s" % (seed, " ".join(arguments[:1]), done.returncode, done.stderr[:1500]))
        return None
    return sorted(json.dumps({"trays": [{f: v if isinstance(v, str) else v["fill"] + (":" + v["depth"] if v.get("depth") else "") for f, v in t.items()}
                                        for t in json.loads(x)["trays"]]}, sort_keys=True) for x in done.stdout.splitlines())


def check(seed, folder):
    made = case(seed)
    if not made:  # a schema forbids every tray, which is an error
        return 0
    newest, files, plans, kept = made
    for name, text in files.items():
        open(os.path.join(folder, name + ".plan"), "w").write(text)
    path = os.path.join(folder, newest.name + ".plan")
    wanted = sorted(map(line, kept))
    library = "lib-" + newest.name
    every = "".join(json.dumps({"trays": [json_tray(t) for t in p]}) + "\n" for p in plans)
    answers = {"enumerate": run(seed, "enumerate", path, "-l", library, "--format", "json")}
    for engine in ("vm", "dfa"):
        answers[engine] = run(seed, "prune", path, "-l", library, "--engine", engine, "--format", "json", "-", text=every)
    for what, found in answers.items():
        if found is not None and found != wanted:
            more, less = [x for x in found if x not in wanted], [x for x in wanted if x not in found]
            faults.append("seed %d: %s keeps %d plans instead of %d; too many: %s; too few: %s\n%s" %
                          (seed, what, len(found), len(wanted), more[:2], less[:2], "".join(files.values())))
    return 0 < len(kept) < len(plans)


def json_tray(tray):
    return {f: v if isinstance(v, str) else {"fill": v[0], **({"depth": v[1]} if v[1] else {})} for f, v in tray.items()}


def main():
    undecided = 0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, last):
            undecided += check(seed, folder)
    print("%d cases, %d of them neither all nor nothing" % (last - first, undecided))
    for fault in faults[:5]:
        print(fault)
    if undecided < (last - first) // 4:
        faults.append("too few cases mean something")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
