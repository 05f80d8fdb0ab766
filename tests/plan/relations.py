#!/usr/bin/env python3
"""Holds rules, measures and libraries to a slow reference: relations.py TARTAN ORACLES FIRST LAST

ORACLES/plan/third.py has the definitions: relations to what lies around, `where`, `mirrored`, `values`, remainders, the greatest and the
least, gaps, quotients, what is repeated, rules that use themselves, alone and in one another. Of each seed random rules are asked of all short plans, by both engines and in a library;
measures are spread and their best plans listed; a library has params, preferences and weights. What the reference has and the language
does not (trays by sums) is left out of the cases.
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
from third import INF, Compare, Const, Count, EveryNear, EveryTray, Extreme, Gap, Implies, Join, Judge, Many, Mirrored, Name, Neighbour, Not, Ratio, Repeat, Symmetric, Values, Where

FOLDER = tempfile.mkdtemp()


class Maker(third.Maker):
    """Random rules of one schema, in the words that there are."""

    names = ()  # rules that use themselves

    def spec(self):
        made = super().spec()
        made.text = made.old or made.text
        return made

    def short(self):
        share = self.R.random()
        return self.spec() if share < .6 else Neighbour([self.spec(), self.spec()]) if share < .8 else Many(self.spec())

    def extreme(self):
        if self.R.random() < .5:
            return Extreme(self.R.choice(["max", "min"]), self.S.figure(self.R), self.spec() if self.R.random() < .7 else self.rule(0))
        return Gap(self.R.choice(["max", "min"]), self.short(), self.short(), self.R.choice([None, "width"]))

    def quotient(self):
        return Ratio(self.total(), self.total())

    def compare(self, left):
        while True:
            made = super().compare(left)
            if not made.modulus or (made.op in ("=", "!=") and 0 <= made.r.v < made.modulus):
                unit = {2: "m2", -1: " / 1m"}.get(made.r.dim)
                if unit:
                    made.text = f"{left.text} {made.op} {made.r.v}{unit}"
                return made

    def after_where(self):
        R = self.R
        return self.about() if R.random() < .7 else Join(R.choice(["and", "or"]), [self.about(), Not(self.about())])

    def repeated(self, depth=0):
        low = self.R.randint(0, 3)
        inner = self.short() if depth == 0 or self.R.random() < .5 else self.rule(depth - 1)
        made = Repeat(inner, max(low, 1), self.R.choice([None, max(low, 1) + self.R.randint(0, 2)]), self.longest)
        if low > 0:
            return made
        return Neighbour(self.R.sample([self.spec(), Repeat(inner, 0, made.high, self.longest)], 2))

    def circles(self):
        """Rules that use themselves and one another: at one end, at both, in the middle, below `optional` and `repeat`."""
        R = self.R
        names = [Name(f"g{k}") for k in range(R.randint(1, 3))]
        self.names = []
        for name in names:
            name.parts = [self.rule(1) if R.random() < .3 else self.short()]
            kind = R.randrange(7)
            other = R.choice(names)
            beside = [self.short() for _ in range(2)]
            name.parts.append(
                Neighbour([beside[0], other]) if kind < 2 else
                Neighbour([other, beside[0]]) if kind == 2 else
                Neighbour([beside[0], other, beside[1]]) if kind == 3 else
                Neighbour([beside[0], ("optional", other), beside[1], ("optional", R.choice(names))]) if kind == 4 else
                Neighbour([Join("or", [beside[0], beside[1]]), Join("or", [other, beside[1]])]) if kind == 5 else
                Neighbour([beside[0], Repeat(other, R.randint(0, 1), R.choice([None, 2]), self.longest)]))
            if R.random() < .3:
                name.parts.append(Neighbour([self.short(), R.choice(names)], begin=R.random() < .3))
            name.body = Join("or", name.parts)
        for early, late in zip(names, names[1:]):  # without a tray between, but not round
            if R.random() < .3:
                early.body = Join("or", [*early.parts, late])
        self.names = names
        return {name.text: name.body for name in names}

    def rule(self, depth=2):
        R, kind = self.R, self.R.randrange(21)
        if kind == 18:
            return self.repeated(depth)
        if kind > 18 and self.names:
            return R.choice(self.names)
        if kind < 2:
            return self.near()
        if kind < 4:
            return EveryNear(self.near())
        if kind < 7:
            return Where(self.short() if R.random() < .7 else self.rule(0), self.after_where())
        if kind == 7:
            return Mirrored(R.sample(list(self.S.fields), R.randint(1, 2)), self.S, self.longest)
        if kind == 8:
            return self.compare(Values(R.choice(list(self.S.fields)), self.S))
        if kind == 9:
            return self.compare(self.total())
        if kind < 12:
            return self.compare(self.extreme())
        if kind < 14:
            return self.compare(self.quotient())
        if depth == 0:
            return self.spec()
        inner, kind = self.rule(depth - 1), R.randrange(7)
        if kind == 0:
            return Not(inner)
        if kind == 1:
            return Compare(Count(inner), R.choice([">=", "=", "<"]), Const(R.randint(0, 2)))
        if kind == 2:
            return EveryTray(self.spec(), inner)
        if kind == 3:
            return Neighbour([inner, self.spec()])
        if kind == 4:
            return Symmetric(Neighbour([self.spec(), inner], begin=R.random() < .5))
        if kind == 5:
            return Implies(inner, self.rule(depth - 1))
        return Join(R.choice(["and", "or"]), [inner, self.rule(depth - 1)])


class Case:
    def __init__(self, seed):
        self.R = random.Random(f"relations {seed}")
        self.S = third.Schema("row", self.R)
        self.longest = {3: 5, 4: 4, 5: 4}[len(self.S.trays)]
        self.K = Maker(self.R, self.S, self.longest)
        every = ([t for t in trays] for n in range(self.longest + 1) for trays in third.itertools.product(self.S.trays, repeat=n))
        self.judges = [Judge(plan, self.S) for plan in every]
        self.lines = [self.S.line(judge.w) for judge in self.judges]
        self.rules = self.K.circles()
        self.rules |= {f"w{k}": self.K.rule() for k in range(8)}
        self.wish = self.K.spec()
        self.kept = [k for k, judge in enumerate(self.judges) if judge.N > 0 and judge.matched(self.wish)]
        self.measures = [self.K.extreme(), self.K.extreme(), self.K.quotient(), Values(self.R.choice(list(self.S.fields)), self.S)]
        self.side, self.heavy = self.K.spec(), self.K.spec()
        self.number = self.R.choice([Fraction(7), Fraction(1, 2), Fraction(5, 2)])
        self.K.names = ()  # two preferences of one name are an error
        self.likes = [(self.K.rule(1), self.R.choice([None, Fraction(3), Fraction(1, 2)])) for _ in range(2)]

    def text(self):
        ordered = re.sub(r"(?m)^(  height = .*)$", lambda m: m[1].replace(" | ", " < "), self.S.today)
        text = ordered + "".join(f"rule {n} = {x.text}\nlibrary L{n} using row {{ trays 0..{self.longest} prune {n} }}\n" for n, x in self.rules.items())
        text += f"library kept using row {{ trays 1..{self.longest} require {self.wish.text} }}\n"
        text += "".join(f"measure m{k} = {m.text}\n" for k, m in enumerate(self.measures))
        text += "param lot = 4m in 1m..9m\nparam side = left | right\n"
        text += f"library fitting from kept {{ require sum(width) <= lot, side = right implies {self.side.text} }}\n"
        text += "library liked from kept { prefer " + ", ".join(x.text + worth(w) for x, w in self.likes) + " }\n"
        return text + f"library likely from kept {{ weight {self.heavy.text} {decimal(self.number)} }}\n"


def worth(number):
    return "" if number is None else f" worth {decimal(number)}"


def decimal(number):
    return str(number) if number.denominator == 1 else str(float(number))


class Failed(Exception):
    pass


class Limit(Exception):
    """An automaton that is too large: a smaller question has an answer."""


def run(*words):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True)
    if done.returncode == 4:
        raise Limit
    if done.returncode != 0:
        raise Failed(f"{' '.join(words)}: {done.returncode} {done.stderr[:600]}")
    return done


def ask(*words):
    return run(*words).stdout


def same(what, got, wanted):
    if got != wanted:
        raise Failed(f"{what}: {got} instead of {wanted}")


def matched(case, path):
    """Each rule, of each plan, by both engines."""
    plans = path + "s"
    with open(plans, "w") as out:
        out.write("\n".join(case.lines) + "\n")
    asked = [word for name in case.rules for word in ("--rule", name)]
    for engine in ("vm", "auto"):
        rows = [set(line.split()) for line in ask("match", path, plans, *asked, "--format", "names", "--engine", engine)[:-1].split("\n")]
        for name, rule in case.rules.items():
            for line, row, judge in zip(case.lines, rows, case.judges):
                same(f"{engine}: {rule.text} of `{line}`", name in row, judge.matched(rule))


def counted(case, path):
    for name, rule in case.rules.items():
        wanted = sum(not judge.matched(rule) for judge in case.judges)
        same(f"kept without {rule.text}", int(json.loads(ask("count", path, "--library", "L" + name, "--json", "--no-effects"))["kept"]), wanted)


def spread(case, path, library, name, values):
    """How plans are spread, and the best ten either way. values: (value, plan) of those that have one."""
    many = {}
    for value, _ in values:
        many[value] = many.get(value, 0) + 1
    answer = json.loads(ask("count", path, "--library", library, "--by", name, "--json"))
    if all("value" in row for row in answer["distribution"]):
        same(f"spread of {name}", [(Fraction(row["value"]), int(row["plans"])) for row in answer["distribution"]], sorted(many.items()))
    same(f"plans without {name}", int(answer.get("none", 0)), len(case.kept) - len(values))
    rank = {plan: k for k, plan in enumerate(case.kept)}
    for end, sign in (("least", 1), ("most", -1)):
        found = [json.loads(line) for line in ask("best", path, "10", "--library", library, "--" + end, name, "--format", "json").split("\n") if line]
        wanted = sorted(values, key=lambda pair: (sign * pair[0], pair[1]))[:10]
        same(f"{end} {name}", [(Fraction(row["value"]), int(row["rank"])) for row in found], [(value, rank[plan]) for value, plan in wanted])


def measured(case, path):
    for k, measure in enumerate(case.measures):
        values = [(measure.value(case.judges[plan], 0, case.judges[plan].N), plan) for plan in case.kept]
        spread(case, path, "kept", f"m{k}", [(v, plan) for v, plan in values if v is not None and v not in (INF, -INF)])


def set_to(case, path):
    for lot in case.R.sample(range(1, 10), 2):
        for side in ("left", "right"):
            wanted = [plan for plan in case.kept if sum(t["width"] for t in case.judges[plan].w) <= lot and (side == "left" or case.judges[plan].matched(case.side))]
            found = ask("count", path, "--library", "fitting", "--json", "--no-effects", "--set", f"lot={lot}m", "--set", f"side={side}")
            same(f"lot {lot}m, side {side}", int(json.loads(found)["kept"]), len(wanted))


def preferred(case, path):
    value = lambda plan: sum(((1 if w is None else w) * int(case.judges[plan].matched(x)) for x, w in case.likes), Fraction(0))
    spread(case, path, "liked", "preference", [(value(plan), plan) for plan in case.kept])


def weighed(case, path):
    if not case.kept:
        return
    weights = [case.number ** int(Count(case.heavy).value(case.judges[plan], 0, case.judges[plan].N)) for plan in case.kept]
    said = re.search(r"add up to ([0-9,./]*[0-9])", run("sample", path, "1", "--library", "likely").stderr)
    same("weights of all plans", said and Fraction(said[1].replace(",", "")), sum(weights, Fraction(0)))


def main():
    wrong = limits = 0
    for seed in range(FIRST, LAST):
        case = Case(seed)
        path = os.path.join(FOLDER, f"{seed}.plan")
        with open(path, "w") as out:
            out.write(case.text())
        for question in (matched, counted, measured, set_to, preferred, weighed):
            try:
                question(case, path)
            except Limit:
                limits += 1
            except Failed as failed:
                print(f"seed {seed}, {question.__name__}: {failed}")
                wrong += 1
    print(f"{LAST - FIRST} cases, {limits} questions past a limit, {wrong} wrong")
    sys.exit(wrong > 0)


main()
