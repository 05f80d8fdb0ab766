#!/usr/bin/env python3
"""Holds what is said of single trays to a slow reference: trays.py TARTAN ORACLES FIRST LAST

ORACLES/plan/third.py makes schemas with `only`, `forbid`, sums that are compared and values in an order. Here more is said of their trays,
one inside another: and, or, not, implies, `any`, sums with parentheses, numbers of the schema, divisions. Which trays there are, and which
plans rules match that ask trays so, is found by trying all; a division by 0 in a legal tray has to be refused. Of some seeds the schema has
fields more, so that there are millions of combinations of which as many are legal as before.
"""
import json
import os
import random
import re
import subprocess
import sys
import tempfile
from fractions import Fraction

PROGRAM, ORACLES, FIRST, LAST = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
sys.path.insert(0, os.path.join(ORACLES, "plan"))
import third
from third import OPS, Compare, Const, Count, EveryTray, Implies, Join, Judge, Many, Neighbour, Not, Symmetric, Tray

FOLDER = tempfile.mkdtemp()


def both(parts):
    """All of them: True, False, or None where that depends on what a division by 0 comes to."""
    return False if False in parts else None if None in parts else True


def opposite(truth):
    return None if truth is None else not truth


class Items:
    """Items of tray(...), each as its text and what it says of a tray."""

    def __init__(self, S, R, divides):
        self.S, self.R, self.divides = S, R, divides

    def figure(self, depth=2):
        """(text, function, is it a length, how strongly it binds): None is a division by 0."""
        R, fields = self.R, self.S.fields
        kind = min(R.randrange(9 if self.divides else 5), 5) if depth else 0
        if kind < 2:
            f = R.choice([f for f in fields if fields[f][0] in ("length", "order", "zone")] + ["load"] * bool(self.S.number))
            if f == "load":
                return "load", lambda t: Fraction(self.S.number[1](t)), 0, 3
            if fields[f][0] == "order":
                return f, lambda t: Fraction(t[f]), 0, 3
            if fields[f][0] == "zone":
                return R.choice([f, f + " depth"]), lambda t: Fraction(t[f][1]), 1, 3
            return f, lambda t: Fraction(t[f]), 1, 3
        if kind == 2:
            n, length = R.randint(0, 4), R.random() < .6
            return f"{n}m" if length else str(n), lambda t: Fraction(n), int(length), 3
        a = self.figure(depth - 1)
        if kind == 3:
            for _ in range(20):
                b = self.figure(depth - 1)
                if b[2] == a[2]:
                    sign = R.choice("+-")
                    return (f"{a[0]} {sign} {inside(b, 2)}", lambda t: apply(a, b, t, lambda x, y: x + y if sign == "+" else x - y), a[2], 1)
            return a
        for _ in range(20):
            b = self.figure(depth - 1)
            if kind == 4 and a[2] + b[2] <= 1:
                return (f"{inside(a, 2)} * {inside(b, 3)}", lambda t: apply(a, b, t, lambda x, y: x * y), a[2] + b[2], 2)
            if kind == 5 and a[2] == b[2] and not re.fullmatch(r"[0-9m()+* -]*", b[0]):
                return (f"{inside(a, 2)} / {inside(b, 3)}", lambda t: apply(a, b, t, lambda x, y: None if y == 0 else x / y), 0, 2)
        return a

    def compared(self):
        R = self.R
        while True:
            a, b = self.figure(), self.figure()
            if a[2] != b[2] or re.fullmatch(r"[0-9m()+*/ -]*", a[0] + b[0]):
                continue
            op = R.choice(list(OPS))
            test = lambda t: apply(a, b, t, lambda x, y: OPS[op](x, y))
            plain = re.fullmatch(r"[a-z]+( depth)?|[0-9]+m?", a[0]) and re.fullmatch(r"[0-9]+m?", b[0])
            if plain and not (a[0] == "load" or self.S.fields.get(a[0], [""])[0] == "order" and not b[0].endswith("m")):
                continue                    # an item as there have always been: it has to name a value
            return f"{a[0]} {op} {b[0]}", test

    def item(self):
        R, kind = self.R, self.R.randrange(10)
        if kind < 4:
            text, test = self.S.item(R)
            return text, lambda t: bool(test(t))
        if kind == 4:
            text, test = self.compared()
            return "not " + text, lambda t: opposite(test(t))
        if kind == 5:
            a, b = self.compared(), self.compared()
            return f"{a[0]} or {b[0]}", lambda t: opposite(both([opposite(a[1](t)), opposite(b[1](t))]))
        if kind == 6:
            a = self.figure()
            low, high = sorted([R.randint(0, 4), R.randint(0, 4)])
            unit = "m" * a[2]
            if not re.search(r"[-+*/]", a[0]) or re.fullmatch(r"[0-9m()+*/ -]*", a[0]):
                return self.item()
            test = lambda t: None if a[1](t) is None else low <= a[1](t) <= high
            return f"{a[0]} in {low}{unit}..{high}{unit}", test
        return self.compared()

    def tray(self, trays):
        """One that some of the trays are and some are not, if that is found soon."""
        for _ in range(30):
            items = [self.item() for _ in range(self.R.choice([1, 1, 2, 3]))]
            test = lambda t, items=items: both([x(t) for _, x in items])
            met = [test(t) for t in trays]
            if True in met and (False in met or None in met):
                break
        else:
            v = self.R.choice(trays)["width"]
            items, test = [(f"{v}m", None)], lambda t: t["width"] == v
        return "tray(" + ", ".join(x for x, _ in items) + ")", test

    def limit(self, trays, depth=2):
        R, kind = self.R, self.R.randrange(9)
        if depth == 0 or kind < 3:
            return self.tray(trays)
        if kind == 3:
            return "any", lambda t: True
        a = self.limit(trays, depth - 1)
        if kind < 5:
            return f"not ({a[0]})", lambda t: opposite(a[1](t))
        b = self.limit(trays, depth - 1)
        if kind == 5:
            return f"(({a[0]}) implies ({b[0]}))", lambda t: opposite(both([a[1](t), opposite(b[1](t))]))
        if kind == 6:
            return f"({a[0]} and {b[0]})", lambda t: both([a[1](t), b[1](t)])
        return f"({a[0]} or {b[0]})", lambda t: opposite(both([opposite(a[1](t)), opposite(b[1](t))]))


def inside(figure, needs):
    return figure[0] if figure[3] >= needs else f"({figure[0]})"


def apply(a, b, t, operation):
    x, y = a[1](t), b[1](t)
    return None if x is None or y is None else operation(x, y)


class Maker(third.Maker):
    def __init__(self, R, S, longest, items):
        super().__init__(R, S, longest)
        self.items = items

    def spec(self):
        while True:
            text, test = self.items.tray(self.S.trays)
            if not any(test(t) is None for t in self.S.trays):
                return Tray(text, test, None)

    def rule(self, depth=2):
        R, kind = self.R, self.R.randrange(12)
        if depth == 0 or kind == 0:
            return self.spec()
        if kind == 1:
            return Neighbour([self.spec(), self.spec()], R.random() < .3, R.random() < .3)
        if kind == 2:
            return Compare(Count(self.spec()), R.choice([">=", "=", "<"]), Const(R.randint(0, 2)))
        if kind == 3:
            return EveryTray(self.spec(), self.spec())
        if kind == 4:
            return Neighbour([self.spec(), Many(self.spec())])
        if kind == 5:
            return self.near()
        if kind == 6:
            return self.pairs()
        if kind == 7:
            return self.called()
        a = self.rule(depth - 1)
        if kind == 8:
            return Not(a)
        if kind == 9:
            return Symmetric(Neighbour([self.spec(), a]))
        if kind == 10:
            return Implies(a, self.rule(depth - 1))
        return Join(R.choice(["and", "or"]), [a, self.rule(depth - 1)])

    def short(self):
        return self.spec() if self.R.random() < .7 else Neighbour([self.spec(), self.spec()])

    def pairs(self):
        """some v in width (neighbour(tray(width > v), tray(...))): bound values in sums"""
        R = self.R
        f = R.choice([f for f in self.S.fields if self.S.fields[f][0] in ("length", "order")])
        kind, values = self.S.fields[f]
        op, once = R.choice(list(OPS)), "1m" if kind == "length" else "1"
        cases = [Tray("", lambda t, v=v: OPS[op](t[f], v + 1), None) for v in values]
        made = Join("or", [Neighbour([Tray("", lambda t, v=v: t[f] == v, None), case]) for v, case in zip(values, cases)])
        made.text = f"(some v in {f} (neighbour(tray({f} v), tray({f} {op} v + {once}))))"
        return made

    def called(self):
        """A rule whose parameters are fields."""
        R = self.R
        lengths = [f for f in self.S.fields if self.S.fields[f][0] in ("length", "zone")]
        if len(lengths) < 2:
            return self.spec()
        f, g = R.sample(lengths, 2)
        size = lambda t, f: t[f][1] if isinstance(t[f], tuple) else t[f]
        return Tray(f"above({f}, {g})", lambda t: size(t, f) > 2 * size(t, g) - 1, None)


class Case:
    def __init__(self, seed):
        self.R = R = random.Random(f"trays {seed}")
        self.S = S = third.Schema("row", R)
        self.large = seed % 3 == 0
        items = Items(S, R, seed % 4 == 1)
        lines, undecided = [], []
        for _ in range(R.randint(1, 3)):
            text, test = items.limit(S.trays)
            word = R.choice(["only", "forbid"])
            keep = [t for t in S.trays if test(t) is not (word == "forbid")]
            if word == "only":
                keep = [t for t in S.trays if test(t) is not False]
            if keep:
                S.trays = keep
                lines.append(f"  {word} {text}\n")
                undecided.append(test)
        self.wrong = [t for t in S.trays if any(test(t) is None for test in undecided)]
        head = S.head[:-2] + "".join(lines)
        if self.large:                      # each has 16 values, and one of them
            head += "".join(f"  {q} = " + " < ".join(f"{q}-{k}" for k in range(16)) + "\n" for q in ("qa", "qb", "qc", "qd"))
            head += "  only tray(qa = 2, qb = qa + 1) and tray(qc = qb, qd + qa > 17)\n"
        self.head = head + "}\n"
        self.tail = " qa-1 qb-2 qc-2 qd-15" if self.large else ""
        self.longest = 3 if len(S.trays) <= 5 else 2
        self.K = Maker(R, S, self.longest, items)
        self.rules = {} if self.wrong else {f"w{k}": self.K.rule() for k in range(8)}
        every = [list(p) for n in range(self.longest + 1) for p in third.itertools.product(S.trays, repeat=n)]
        self.judges = [Judge(plan, S) for plan in every]

    def line(self, plan):
        return " | ".join(self.S.line([t]) + self.tail for t in plan)

    def text(self):
        text = self.head + "rule above(f, g) = tray(f > 2 * g - 1m)\n"
        text += "library one using row { trays 1..1 }\n"
        return text + "".join(f"rule {n} = {x.text}\nlibrary L{n} using row {{ trays 0..{self.longest} prune {n} }}\n" for n, x in self.rules.items())


class Failed(Exception):
    pass


def run(*words):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True)


def ask(*words):
    done = run(*words)
    if done.returncode != 0:
        raise Failed(f"{' '.join(words)}: {done.returncode} {done.stderr[:600]}")
    return done.stdout


def same(what, got, wanted):
    if got != wanted:
        raise Failed(f"{what}: {got} instead of {wanted}")


def said_by_zero(case, path, text, trays):
    """What is wrong with the text is a division by 0 in one of the trays, which is shown."""
    with open(path[:-5] + "-zero.plan", "w") as out:
        out.write(text)
    done = run("check", path[:-5] + "-zero.plan")
    said = re.search(r"error\[E0419\]: this divides by 0 in the tray `([^`]*)`", done.stderr)
    if done.returncode != 1 or not said:
        raise Failed(f"a division by 0 was not said: {done.stderr[:300]} {text}")
    plain = lambda t: [w for w in case.line([t]).split(" ") if w != "-"]
    if said[1].split(" ") not in [plain(t) for t in trays]:
        raise Failed(f"{said[1]} is no tray that divides by 0 in {text}")


def legal(case, path):
    if case.wrong:
        said_by_zero(case, path, case.text(), case.wrong)
        return
    same("trays", ask("enumerate", path, "--library", "one")[:-1].split("\n"), [case.line([t]) for t in case.S.trays])


def matched(case, path):
    """Each rule, of each plan, by both engines."""
    plans = path + "s"
    with open(plans, "w") as out:
        out.write("\n".join(case.line(judge.w) for judge in case.judges) + "\n")
    asked = [word for name in case.rules for word in ("--rule", name)]
    for engine in ("vm", "auto") if case.rules else ():
        rows = [set(line.split()) for line in ask("match", path, plans, *asked, "--format", "names", "--engine", engine)[:-1].split("\n")]
        same("plans", len(rows), len(case.judges))
        for name, rule in case.rules.items():
            for row, judge in zip(rows, case.judges):
                same(f"{engine}: {rule.text} of `{case.line(judge.w)}`", name in row, judge.matched(rule))


def counted(case, path):
    for name, rule in case.rules.items():
        wanted = sum(not judge.matched(rule) for judge in case.judges)
        same(f"kept without {rule.text}", int(json.loads(ask("count", path, "--library", "L" + name, "--json", "--no-effects"))["kept"]), wanted)


def by_zero(case, path):
    """A rule that divides by a legal tray's 0 is refused."""
    if case.wrong:
        return
    items = Items(case.S, case.R, True)
    for _ in range(30):
        text, test = items.tray(case.S.trays)
        if any(test(t) is None for t in case.S.trays):
            said_by_zero(case, path, case.text() + f"rule zero = {text}\n", [t for t in case.S.trays if test(t) is None])
            return


def laid_out(case, path):
    """The formatter says the same, and says it of what it has laid out."""
    text = case.text()
    once = subprocess.run([PROGRAM, "fmt", "-"], input=text, capture_output=True, text=True)
    twice = subprocess.run([PROGRAM, "fmt", "-"], input=once.stdout, capture_output=True, text=True)
    same("layout", (once.returncode, twice.stdout), (0, once.stdout))
    same("words", re.sub(r"\s+", "", once.stdout), re.sub(r"\s+", "", text))


def added():
    """Six fields of sixteen values, 16,777,216 combinations: those of some sums are counted by how many ways there are to each."""
    weights, numbers = (1, 1, 2, 1, 3, 1), range(1, 17)
    for bound, op in ((17, "<="), (16, "="), (140, ">=")):
        ways = {0: 1}
        for weight in weights:
            longer = {}
            for total, count in ways.items():
                for number in numbers:
                    longer[total + weight * number] = longer.get(total + weight * number, 0) + count
            ways = longer
        fields = "\n".join(f"  {name} = {' | '.join(f'{n}m' for n in numbers)}" for name in "abcdef")
        terms = " + ".join(f"{weight} * {name}" for weight, name in zip(weights, "abcdef"))
        path = os.path.join(FOLDER, "added.plan")
        with open(path, "w") as out:
            out.write(f"schema added {{\n{fields}\n  only tray({terms} {op} {bound}m)\n}}\nlibrary one {{ trays 1 }}\n")
        done = subprocess.run([PROGRAM, "count", path, "--json"], capture_output=True, text=True)
        same("added up", (done.stderr, json.loads(done.stdout or "{}").get("kept")),
             ("", str(sum(count for total, count in ways.items() if OPS[op](total, bound)))))


def main():
    wrong = divided = 0
    added()
    for seed in range(FIRST, LAST):
        case = Case(seed)
        divided += bool(case.wrong)
        path = os.path.join(FOLDER, f"{seed}.plan")
        with open(path, "w") as out:
            out.write(case.text())
        for question in (legal, matched, counted, by_zero, laid_out):
            try:
                question(case, path)
            except Failed as failed:
                print(f"seed {seed}, {question.__name__}: {failed}")
                wrong += 1
                break
    print(f"{LAST - FIRST} cases, {divided} that divide by 0, {wrong} wrong")
    sys.exit(wrong > 0)


main()
