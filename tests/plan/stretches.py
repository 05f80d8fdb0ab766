#!/usr/bin/env python3
"""Rules of every kind nested in one another, against a brute force.

usage: stretches.py TARTAN FIRST LAST     runs the random cases of the seeds FIRST to LAST - 1

The judgements M and H are those of docs/plan-language.md, "Semantics", written down once more: comparisons of sums, `number`,
`every`, `implies`, quantifiers and rules with parameters stand inside `neighbour`, `many`, `quantity`, `occurrences` and
`symmetric`. A case has several rules over one schema, and one that uses itself; both engines of TARTAN have to match
exactly the plans that are matched here. So have automata that may have few states, which are then made for the library's
lengths alone, or not made.
"""
import itertools, json, os, random, subprocess, sys, tempfile
from fractions import Fraction

tartan, first, last = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
OPERATORS = {"<": lambda a, b: a < b, "<=": lambda a, b: a <= b, "=": lambda a, b: a == b, ">=": lambda a, b: a >= b,
             ">": lambda a, b: a > b, "!=": lambda a, b: a != b}
WIDTHS, USES = (1, 2, 4), ("a", "b", "c")
SCHEMA = """schema row {
  width = 1m | 2m | 4m
  use = a | b | c
  number load = 5/2 where tray(c, width > 1m) | width / 2m where tray(not b) | 0
}
rule beside(p, q) = symmetric neighbour(p, q)
rule most(p, k) = quantity(p, n <= k)
rule both(p, q) = p and q
"""


def load(tray):
    width, use = tray
    return Fraction(5, 2) if use == "c" and width > 1 else Fraction(width, 2) if use != "b" else Fraction(0)


class Rule:
    """text; M(plan, i, j): is the stretch a match; H: is there one in it, where that is not some M inside."""

    def __init__(self, text, M, H=None):
        self.text, self.M = text, M
        self.H = H or (lambda p, i, j: any(M(p, a, b) for a in range(i, j) for b in range(a + 1, j + 1)))


def whole(text, M):
    """A rule whose two judgements are the same."""
    return Rule(text, M, M)


def random_tray(r):
    kind = r.randrange(4)
    if kind == 0:
        op, width = r.choice(list(OPERATORS)), r.choice(WIDTHS[1:2] if r.random() < 0.5 else WIDTHS)
        if not 0 < sum(OPERATORS[op](w, width) for w in WIDTHS) < 3:
            op = "="
        text, test = "width %s %dm" % (op, width), lambda t: OPERATORS[op](t[0], width)
    elif kind == 1:
        op, least = r.choice([">=", "<"]), r.choice(["0.5", "1", "2"])
        text, test = "load %s %s" % (op, least), lambda t: OPERATORS[op](load(t), Fraction(least))
    elif kind == 2:
        use = r.choice(USES)
        text, test = "not " + use, lambda t: t[1] != use
    else:
        use, width = r.choice(USES), r.choice(WIDTHS)
        text, test = "%s, %dm" % (use, width), lambda t: t == (width, use)
    return Rule("tray(%s)" % text, lambda p, i, j: j == i + 1 and test(p[i]))


def mirrored(rule):
    """M of the rule on the mirrored stretch of the mirrored plan."""
    return lambda p, i, j: rule.M(p[::-1], len(p) - j, len(p) - i)


def symmetric(text, rule):
    other = mirrored(rule)
    return Rule(text, lambda p, i, j: rule.M(p, i, j) or other(p, i, j))


def neighbour(text, parts):
    def fits(p, i, j, k):
        if k == len(parts):
            return i == j
        return any(parts[k].M(p, i, c) and fits(p, c, j, k + 1) for c in range(i + 1, j + 1))

    return Rule(text, lambda p, i, j: fits(p, i, j, 0))


def counted(rule, p, i, j):
    return [k for k in range(i, j) if rule.M(p, k, k + 1)]


def random_sum(r, deep):
    """(text, value of a stretch, is it a length?)"""
    kind = r.choice(["trays", "quantity", "load", "occurrences", "width"])
    factor = r.choice([1, 1, 2, 3])
    if kind == "trays":
        return "%d * trays" % factor, lambda p, i, j: factor * (j - i), False
    a = random_rule(r, deep + 1)
    if kind == "quantity":
        return "%d * quantity(%s)" % (factor, a.text), lambda p, i, j: factor * len(counted(a, p, i, j)), False
    if kind == "occurrences":
        starts = lambda p, i, j: sum(any(a.M(p, k, b) for b in range(k + 1, j + 1)) for k in range(i, j))
        return "%d * occurrences(%s)" % (factor, a.text), lambda p, i, j: factor * starts(p, i, j), False
    if kind == "load":
        return "%d * sum(load of %s)" % (factor, a.text), lambda p, i, j: factor * sum(load(p[k]) for k in counted(a, p, i, j)), False
    return "%d * sum(width of %s)" % (factor, a.text), lambda p, i, j: factor * sum(p[k][0] for k in counted(a, p, i, j)), True


def random_comparison(r, deep):
    left = random_sum(r, deep)
    op, k = r.choice(list(OPERATORS)), r.randint(0, 5) if r.random() < 0.7 else r.randint(6, 30)
    unit = "m" if left[2] else ""
    if r.random() < 0.25:
        return whole("(%s) in %d%s..%d%s" % (left[0], k, unit, k + 2, unit), lambda p, i, j: k <= left[1](p, i, j) <= k + 2)
    if r.random() < 0.4:
        right = random_sum(r, deep)
        if right[2] == left[2]:
            return whole("(%s) %s %s" % (left[0], op, right[0]), lambda p, i, j: OPERATORS[op](left[1](p, i, j), right[1](p, i, j)))
    return whole("(%s) %s %d%s" % (left[0], op, k, unit), lambda p, i, j: OPERATORS[op](left[1](p, i, j), k))


def random_rule(r, deep=0):
    leaves = ["tray"] * (3 * deep)
    kind = r.choice(["compare", "every", "implies", "and", "or", "not", "neighbour", "many", "quantity", "symmetric", "beside",
                     "most", "both", "some", "all"] + leaves) if deep < 3 else "tray"
    if kind == "tray":
        return random_tray(r)
    if kind == "compare":
        return random_comparison(r, deep)
    a = random_rule(r, deep + 1)
    if kind == "not":
        return whole("not (%s)" % a.text, lambda p, i, j: not a.H(p, i, j))
    if kind == "many":
        return Rule("many(%s)" % a.text, lambda p, i, j: i < j and len(counted(a, p, i, j)) == j - i)
    n, op = r.randint(0, 3), r.choice(list(OPERATORS))
    if kind == "quantity":
        return whole("quantity(%s) %s %d" % (a.text, op, n), lambda p, i, j: OPERATORS[op](len(counted(a, p, i, j)), n))
    if kind == "most":
        return whole("most(%s, %d)" % (a.text, n), lambda p, i, j: len(counted(a, p, i, j)) <= n)
    if kind == "some":
        return joined("some v%d in width (v%d > 1m and (%s) and tray(v%d))" % (deep, deep, a.text, deep), "or",
                      [joined("", "and", [a, Rule("", lambda p, i, j, v=v: j == i + 1 and p[i][0] == v)]) for v in WIDTHS if v > 1])
    if kind == "all":
        if r.random() < 0.5:
            return joined("every u%d in use (u%d = b or (%s) or tray(u%d))" % (deep, deep, a.text, deep), "and",
                          [joined("", "or", [a, Rule("", lambda p, i, j, u=u: j == i + 1 and p[i][1] == u)]) for u in USES if u != "b"])
        names = {"v": "v%d" % deep, "u": "u%d" % deep, "a": a.text}
        return joined("every %(v)s, %(u)s in use (%(v)s = %(u)s or (%(a)s) or tray(%(u)s))" % names, "and",
                      [joined("", "or", [a, Rule("", lambda p, i, j, u=u: j == i + 1 and p[i][1] == u)]) for u in USES])
    b = random_rule(r, deep + 1)
    if kind == "every":
        each = lambda p, i, j: all(b.M(p, k, k + 1) for k in counted(a, p, i, j))
        return whole("every(%s, %s)" % (a.text, b.text), each)
    if kind == "implies":
        return Rule("((%s) implies (%s))" % (a.text, b.text), lambda p, i, j: not a.H(p, i, j) or b.M(p, i, j),
                    lambda p, i, j: not a.H(p, i, j) or b.H(p, i, j))
    if kind in ("and", "or"):
        return joined("((%s) %s (%s))" % (a.text, kind, b.text), kind, [a, b])
    if kind == "both":
        return joined("both(%s, %s)" % (a.text, b.text), "and", [a, b])
    if kind == "beside":
        return symmetric("beside(%s, %s)" % (a.text, b.text), neighbour("", [a, b]))
    parts = [a, b] + [random_rule(r, deep + 1) for _ in range(r.randrange(2))]
    row = neighbour("neighbour(%s)" % ", ".join(part.text for part in parts), parts)
    return symmetric("symmetric " + row.text, row) if kind == "symmetric" else row


def joined(text, word, parts):
    every = all if word == "and" else any
    return Rule(text, lambda p, i, j: every([part.M(p, i, j) for part in parts]), lambda p, i, j: every([part.H(p, i, j) for part in parts]))


def circle(r, name, rule):
    """The rule, or a row of trays with it at the right end, at the left end or in the middle."""
    step, end = random_tray(r), random_tray(r)
    kind = r.choice(["right", "left", "middle"])
    around = {"right": (step, None), "left": (None, end), "middle": (step, end)}[kind]
    text = "(%s) or neighbour(%s)" % (rule.text, ", ".join(([step.text] if around[0] else []) + [name] + ([end.text] if around[1] else [])))

    def longer(p, i, j):
        first, last = i + bool(around[0]), j - bool(around[1])
        fits = (not around[0] or step.M(p, i, i + 1)) and (not around[1] or end.M(p, j - 1, j))
        return first < last and fits and M(p, first, last)

    def M(p, i, j):
        return rule.M(p, i, j) or longer(p, i, j)

    return Rule(text, M, lambda p, i, j: rule.H(p, i, j) or any(longer(p, a, b) for a in range(i, j) for b in range(a + 1, j + 1)))


def fractions(folder):
    """Sums of fractions, of which there are some hundred thousand in plans of every length, and few in short ones."""
    trays = [(1, 97), (1, 101), (1, 103), (100, 97)]
    path = os.path.join(folder, "fractions.plan")
    with open(path, "w") as out:
        out.write("""schema part { a = 1m | 100m  b = 97m | 101m | 103m  only tray(1m) or tray(b 97m) }
rule few = neighbour(many(any)) where sum(a / b) in 0.015..2.05
rule middle = few or neighbour(tray(1m), middle, few)
rule left = few or neighbour(left, tray(100m))
library few-only { trays 0..5 require few }
library middles { trays 0..5 generate middle }
library lefts { trays 0..5 require neighbour(tray(1m), left) prune neighbour(few, tray(1m), few) }
""")

    def few(p, i, j):
        return i < j and Fraction("0.015") <= sum(Fraction(a, b) for a, b in p[i:j]) <= Fraction("2.05")

    def middle(p, i, j):
        return few(p, i, j) or (i < j and p[i][0] == 1 and any(middle(p, i + 1, c) and few(p, c, j) for c in range(i + 2, j)))

    def left(p, i, j):
        return few(p, i, j) or (i + 1 < j and p[j - 1][0] == 100 and left(p, i, j - 1))

    def somewhere(M, p):
        return any(M(p, i, j) for i in range(len(p)) for j in range(i + 1, len(p) + 1))

    def parted(p, i, j):
        return any(p[c][0] == 1 and few(p, i, c) and few(p, c + 1, j) for c in range(i + 1, j - 1))

    kept = {"few-only": lambda p: somewhere(few, p), "middles": lambda p: middle(p, 0, len(p)),
            "lefts": lambda p: somewhere(lambda p, i, j: p[i][0] == 1 and left(p, i + 1, j), p) and not somewhere(parted, p)}
    for library, keeps in kept.items():
        wanted = [sum(keeps(p) for p in itertools.product(trays, repeat=n)) for n in range(6)]
        done = subprocess.run([tartan, "count", path, "-l", library, "--json", "--no-effects"], capture_output=True, text=True)
        found = [int(row["kept"]) for row in json.loads(done.stdout or '{"by_length": []}')["by_length"]]
        if found != wanted:
            faults.append("fractions, %s: %s, and not %s: %s" % (library, found, wanted, done.stderr[-1500:]))


def remainders(folder):
    """Stretches that end and begin by remainders of counts, in one order or the other: sets of guesses about both orders are very many."""
    trays = list(itertools.product((1, 2), "abc", (False, True)))
    path = os.path.join(folder, "remainders.plan")
    with open(path, "w") as out:
        out.write("""schema part { width = 1m | 2m  use = a | b | c  lit = flag }
rule pair = symmetric neighbour(tray(lit), tray(lit, 2m))
rule parted = symmetric neighbour(pair, quantity(tray(2m), n mod 3 = 1), optional(quantity(tray(c), n mod 3 = 1)))
library short { trays 0..3 require parted }
library long { trays 0..14 require parted }
""")

    def pair(p, i, j):
        return j - i == 2 and p[i][2] and p[i + 1][2] and (p[i][0] == 2 or p[i + 1][0] == 2)

    def counted(p, i, j, chosen):
        return i < j and sum(map(chosen, p[i:j])) % 3 == 1

    def ordered(p, i, j):
        return any(pair(p, i, c) and counted(p, c, d, lambda t: t[0] == 2) and (d == j or counted(p, d, j, lambda t: t[1] == "c"))
                   for c in range(i + 1, j) for d in range(c + 1, j + 1))

    def parted(p):
        return any(ordered(q, i, j) for q in (p, p[::-1]) for i in range(len(p)) for j in range(i + 1, len(p) + 1))

    wanted = [sum(map(parted, itertools.product(trays, repeat=n))) for n in range(4)]
    done = subprocess.run([tartan, "count", path, "-l", "short", "--json", "--no-effects"], capture_output=True, text=True)
    found = [int(row["kept"]) for row in json.loads(done.stdout or '{"by_length": []}')["by_length"]]
    if found != wanted:
        faults.append("remainders: %s, and not %s: %s" % (found, wanted, done.stderr[-1500:]))
    chance = random.Random(3)
    longer = [[chance.choice(trays[:chance.choice((4, 12))]) for _ in range(chance.randint(4, 14))] for _ in range(400)]
    lines = [" | ".join("%dm %s %s" % (width, use, "lit" if lit else "-") for width, use, lit in p) + "\n" for p in longer]
    wanted = [line for line, p in zip(lines, longer) if parted(p)]
    done = subprocess.run([tartan, "prune", path, "-", "-l", "long", "--engine", "dfa"], input="".join(lines), capture_output=True, text=True)
    if done.stdout.splitlines(keepends=True) != wanted or not 40 < len(wanted) < 360:
        faults.append("remainders of longer plans: %d, and not %d: %s" % (done.stdout.count("\n"), len(wanted), done.stderr[-1500:]))


RULES = 3  # a case, and one that uses itself
STATES = 10, 16, 24, 40  # few, so that automata for every length often have more
faults, between, unanswered, short, made = [], 0, 0, 0, 0


def check(seed, folder, plans, lines):
    """How many rules match some plans and not others. Libraries ask for one rule each: then lengths bound the automata."""
    r = random.Random(seed)
    rules = [random_rule(r) for _ in range(RULES)]
    rules.append(circle(r, "r%d" % RULES, rules[0]))
    path = os.path.join(folder, "case.plan")
    with open(path, "w") as out:
        out.write(SCHEMA + "".join("rule r%d = %s\n" % (k, rule.text) for k, rule in enumerate(rules)))
        out.write("".join("library l%d { trays 1..4 require r%d }\n" % (k, k) for k in range(RULES + 1)))
        out.write("".join("library s%d { trays 1..2 require r%d }\n" % (k, k) for k in range(RULES + 1)))
    return sum(check_rule(seed, path, k, rule, plans, lines) for k, rule in enumerate(rules))


def check_rule(seed, path, k, rule, plans, lines):
    global unanswered, short, made
    wanted = [line for line, p in zip(lines, plans) if rule.H(p, 0, len(p))]
    for engine in "vm", "dfa":
        done = subprocess.run([tartan, "prune", path, "-", "-l", "l%d" % k, "--engine", engine], input="".join(lines),
                              capture_output=True, text=True)
        found = done.stdout.splitlines(keepends=True)
        if done.returncode == 4:
            unanswered += k < RULES  # a rule that uses itself in the middle is made for a library's lengths alone
        elif done.returncode != 0:
            faults.append("seed %d, %s: exit %d: %s" % (seed, engine, done.returncode, done.stderr[-1500:]))
        elif found != wanted:
            other = sorted(set(found) ^ set(wanted))[0]
            faults.append("seed %d, %s: %s %s: %s" % (seed, engine, "matches" if other in found else "does not match", other, rule.text))
    wanted = sorted(line for line in wanted if line.count("|") < 2)
    for states in STATES:
        done = subprocess.run([tartan, "enumerate", path, "-l", "s%d" % k, "--max-states", str(states)], capture_output=True, text=True)
        short += done.returncode == 4
        made += done.returncode == 0
        if done.returncode not in (0, 4) or done.returncode == 0 and sorted(done.stdout.splitlines(keepends=True)) != wanted:
            faults.append("seed %d, r%d, %d states: exit %d: %s" % (seed, k, states, done.returncode, done.stderr[-1500:]))
    return 0 < len(wanted) < len(plans)


def run():
    trays = list(itertools.product(WIDTHS, USES))
    chance = random.Random(1)
    plans = [p for n in range(1, 3) for p in itertools.product(trays, repeat=n)]
    plans += [tuple(chance.choice(trays) for _ in range(chance.choice((3, 4)))) for _ in range(60)]
    lines = [" | ".join("%dm %s" % t for t in p) + "\n" for p in plans]
    global between
    with tempfile.TemporaryDirectory() as folder:
        fractions(folder)
        remainders(folder)
        for seed in range(first, last):
            between += check(seed, folder, plans, lines)


run()
print("%d rules, %d of them match some plans and not others; %d answers past a limit; with few states %d made, %d not"
      % ((RULES + 1) * (last - first), between, unanswered, made, short))
for fault in faults[:5]:
    print(fault)
if between < last - first or unanswered > RULES * (last - first) // 10:
    print("too few rules mean something, or too few are answered")
    faults.append("")
sys.exit(1 if faults else 0)
