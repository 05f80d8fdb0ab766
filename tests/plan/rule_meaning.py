"""Which short plans a rule matches, by the table of docs/plan-language.md ("Semantics") word for word, over the tree of a rule (rule_model.py).

Plans of N trays of six are numbered, and a set of them is the bits of a number: so a judgement is made of all plans at once."""
import itertools
import operator

from rule_model import Part, bare

SCHEMA = "schema row {\n  width = 1m | 2m | 3m\n  lit = flag\n}\n"
WIDTHS = (1, 2, 3)
TRAYS = list(itertools.product(WIDTHS, (False, True)))
LONGEST = 4

OPERATORS = {"<": operator.lt, "<=": operator.le, "=": operator.eq, "!=": operator.ne, ">=": operator.ge, ">": operator.gt}

# What rules of this schema are made of: words and what they mean.
ITEMS = {text: lambda t, w=w: t[0] == w for w in WIDTHS for text in (f"{w}m", f"width {w}m")}
ITEMS.update({f"width {op} 2m": lambda t, op=op: OPERATORS[op](t[0], 2) for op in OPERATORS})
ITEMS.update({"lit": lambda t: t[1], "not lit": lambda t: not t[1], "1m..2m": lambda t: t[0] < 3, "1m or 3m": lambda t: t[0] != 2,
              "width in 2m..3m": lambda t: t[0] > 1, "width not 1m": lambda t: t[0] != 1})
CONDITIONS = {f"n {op} {k}": lambda n, op=op, k=k: OPERATORS[op](n, k) for op in OPERATORS for k in (1, 2)}
CONDITIONS.update({"n in 1..2": lambda n: 1 <= n <= 2, "k mod 2 = 1": lambda n: n % 2 == 1, "not n = 1": lambda n: n != 1,
                   "1 <= n and n < 3": lambda n: 1 <= n < 3, "(n = 1 or n > 2)": lambda n: n == 1 or n > 2})
SUM_CONDITIONS = {"w > 3m": lambda n: n > 3, "(w = 2m)": lambda n: n == 2, "(w < 2m) or w in 4m..5m": lambda n: n < 2 or 4 <= n <= 5}
RELATIONS = {"beside": ("within", 0, False), "within 1 of": ("within", 1, False), "within 2m of": ("within", 2, True),
             "at least 1 from every": ("far", 1, False), "at least 3m from every": ("far", 3, True)}
# Numbers of a stretch, each with how it is worked out of its trays.
NUMBERS = {"trays": lambda trays: len(trays), "sum(width)": lambda trays: sum(w for w, _ in trays), "quantity(tray(lit))": lambda trays: sum(lit for _, lit in trays),
           "2 * quantity(tray(1m))": lambda trays: 2 * sum(w == 1 for w, _ in trays), "sum(width of tray(not lit))": lambda trays: sum(w for w, lit in trays if not lit)}


def texts():
    """What is one part, such as comparisons: each with what it is of the trays of a stretch, and those before and behind it."""
    found = {}
    for (text, number), (op, holds) in itertools.product(NUMBERS.items(), OPERATORS.items()):
        unit = "m" if "sum" in text else ""
        found[f"{text} {op} 2{unit}"] = lambda trays, before, behind, number=number, holds=holds: holds(number(trays), 2)
    found["trays mod 2 = 1"] = lambda trays, before, behind: len(trays) % 2 == 1
    found["sum(width) in 2m..4m"] = lambda trays, before, behind: 2 <= sum(w for w, _ in trays) <= 4
    found["quantity(tray(lit)) < quantity(tray(1m))"] = lambda trays, before, behind: sum(lit for _, lit in trays) < sum(w == 1 for w, _ in trays)
    found["sum(width, w > 3m)"] = lambda trays, before, behind: sum(w for w, _ in trays) > 3
    return found


TEXTS = texts()
REGIONS = {"quantity(any before) = 1": lambda trays, before, behind: len(before) == 1,
           "quantity(tray(lit) after) > 0": lambda trays, before, behind: any(lit for _, lit in behind),
           "sum(width before) <= sum(width after)": lambda trays, before, behind: sum(w for w, _ in before) <= sum(w for w, _ in behind)}
KNOWN = {kind: {bare(text): what for text, what in known.items()} for kind, known in
         (("item", ITEMS), ("condition", {**CONDITIONS, **SUM_CONDITIONS}), ("relation", RELATIONS), ("text", {**TEXTS, **REGIONS}))}


class Unknown(Exception):
    """A word that the brute force has no meaning for."""


def known(kind, text):
    if bare(text) not in KNOWN[kind]:
        raise Unknown(text)
    return KNOWN[kind][bare(text)]


# ---- calls, names and quantifiers are written out first

def expanded(part, rules, words):
    """rules: name -> (names of its parameters, its body); words: what a name stands for, a part or a width."""
    if part.kind in ("name", "call") and part.name in words and not part.parts:
        return words[part.name].copy()
    if part.kind in ("name", "call"):
        if part.name not in rules:
            raise Unknown(part.name)
        names, body = rules[part.name]
        return expanded(body, rules, dict(zip(names, (expanded(inside, rules, words) for inside in part.parts))))
    if part.kind in ("some", "each"):
        every = [dict(zip(part.binds, values)) for values in itertools.product([f"{w}m" for w in WIDTHS], repeat=len(part.binds))]
        return Part("or" if part.kind == "some" else "and", [expanded(part.parts[0], rules, {**words, **values}) for values in every])
    made = Part(part.kind, [expanded(inside, rules, words) for inside in part.parts], None, part.condition, part.region, part.relation,
                items=[word_in(item, words) for item in part.items], text=part.text)
    if part.condition and isinstance(words.get(part.condition.split()[-1]), Part):
        made.condition = " ".join(part.condition.split()[:-1] + [words[part.condition.split()[-1]].text])
    return made


def word_in(item, words):
    last = item.split()[-1]
    return item[:-len(last)] + words[last] if isinstance(words.get(last), str) else item


# ---- plans of one length

class Plans:
    """All plans of n trays, each as it is, and as it is from its end: `back` says which."""

    def __init__(self, n):
        self.n, self.plans = n, list(itertools.product(TRAYS, repeat=n))
        self.all, self.seen, self.tests = (1 << len(self.plans)) - 1, {}, {}

    def where(self, key, test, back):
        """The plans with a test."""
        if (key, back) not in self.tests:
            bits = "".join("1" if test(plan[::-1] if back else plan) else "0" for plan in reversed(self.plans))
            self.tests[key, back] = int(bits, 2)
        return self.tests[key, back]

    def matched(self, part):
        self.seen = {}
        return self.H(part, 0, self.n, False)

    def lines(self):
        return [" | ".join(f"{w}m {'lit' if lit else '-'}" for w, lit in plan) for plan in self.plans]

    def M(self, part, i, j, back):
        key = (id(part), "M", i, j, back)
        if key not in self.seen:
            self.seen[key] = MATCHES[part.kind](self, part, i, j, back)
        return self.seen[key]

    def H(self, part, i, j, back):
        key = (id(part), "H", i, j, back)
        if key not in self.seen:
            self.seen[key] = HOLDS[part.kind](self, part, i, j, back) if part.kind in HOLDS else self.inside(part, i, j, back)
        return self.seen[key]

    def inside(self, part, i, j, back):
        return self.either(self.M(part, a, b, back) for a, b in stretches(i, j))

    def either(self, sets):
        found = 0
        for some in sets:
            found |= some
        return found

    def both(self, sets):
        found = self.all
        for some in sets:
            found &= some
        return found

    def counted(self, sets, holds):
        """The plans for which the number of the sets that they are in is as wanted."""
        return self.added([{1: some} for some in sets], holds)

    def added(self, sets, holds):
        """The same of the sum of numbers; each of the sets says for some plans, apart from one another, what is added."""
        numbers = {0: self.all}
        for some in sets:
            after = {}
            for n, plans in numbers.items():
                rest = plans
                for more, those in some.items():
                    after[n + more] = after.get(n + more, 0) | plans & those
                    rest &= ~those
                after[n] = after.get(n, 0) | rest
            numbers = after
        return self.either(plans for n, plans in numbers.items() if holds(n))


def stretches(i, j):
    return [(a, b) for a in range(i, j) for b in range(a + 1, j + 1)]


# ---- is the whole stretch a match?

def tray(p, part, i, j, back):
    if j != i + 1:
        return 0
    return p.both(p.where((bare(item), i), lambda plan, test=known("item", item): test(plan[i]), back) for item in part.items)


def joined(judge):
    def made(p, part, i, j, back):
        return (p.both if part.kind == "and" else p.either)(getattr(p, judge)(inside, i, j, back) for inside in part.parts)
    return made


def denied(p, part, i, j, back):
    return p.all & ~p.H(part.parts[0], i, j, back)


def implied(judge):
    def made(p, part, i, j, back):
        return p.all & ~p.H(part.parts[0], i, j, back) | getattr(p, judge)(part.parts[1], i, j, back)
    return made


def where(p, part, i, j, back):
    return p.M(part.parts[0], i, j, back) & p.M(part.parts[1], i, j, back) if i < j else 0


def neighbour(p, part, i, j, back):
    parts = list(part.parts)
    if parts and parts[0].kind == "beginning":
        if i != 0:
            return 0
        parts = parts[1:]
    if parts and parts[-1].kind == "end":
        if j != p.n:
            return 0
        parts = parts[:-1]
    return row(p, parts, i, j, back) if i < j else 0


def row(p, parts, i, j, back):
    if not parts:
        return p.all if i == j else 0
    first, rest = parts[0], parts[1:]
    if first.kind == "gap":
        return p.either(row(p, rest, c, j, back) for c in range(i, j + 1))
    absent = row(p, rest, i, j, back) if first.kind == "optional" else 0
    inner = first.parts[0] if first.kind == "optional" else first
    return p.either([absent] + [p.M(inner, i, c, back) & row(p, rest, c, j, back) for c in range(i + 1, j + 1)])


def symmetric(p, part, i, j, back):
    return p.M(part.parts[0], i, j, back) | p.M(part.parts[0], p.n - j, p.n - i, not back)


def region(p, part, i, j):
    return (0, i) if part.region == "before" else (j, p.n) if part.region == "after" else (i, j)


def quantity(p, part, i, j, back):
    i, j = region(p, part, i, j)
    return p.counted([p.M(part.parts[0], k, k + 1, back) for k in range(i, j)], known("condition", part.condition))


def occurrences(p, part, i, j, back):
    i, j = region(p, part, i, j)
    starts = [p.either(p.M(part.parts[0], k, b, back) for b in range(k + 1, j + 1)) for k in range(i, j)]
    return p.counted(starts, known("condition", part.condition))


def added(p, part, i, j, back):
    if part.relation != "width":
        raise Unknown(part.relation)
    i, j = region(p, part, i, j)
    is_wide = lambda k, w: p.where(("wide", k, w), lambda plan: plan[k][0] == w, back)
    sets = [{w: p.M(part.parts[0], k, k + 1, back) & is_wide(k, w) for w in WIDTHS} for k in range(i, j)]
    return p.added(sets, known("condition", part.condition))


def many(p, part, i, j, back):
    return p.both(p.M(part.parts[0], k, k + 1, back) for k in range(i, j)) if i < j else 0


def every(p, part, i, j, back):
    return p.both(p.all & ~p.M(part.parts[0], k, k + 1, back) | p.M(part.parts[1], k, k + 1, back) for k in range(i, j))


def gap(i, j, c, d):
    """Between two stretches; empty if they overlap or touch."""
    return (d, i) if d <= i else (j, c) if j <= c else (i, i)


def near(p, part, i, j, back):
    kind, most, by_width = known("relation", part.relation)
    if i >= j:
        return 0
    found = []
    for c, d in stretches(0, p.n):
        if c < j and i < d:
            continue
        lo, hi = gap(i, j, c, d)
        wide = (lambda plan, lo=lo, hi=hi: sum(w for w, _ in plan[lo:hi])) if by_width else (lambda plan, lo=lo, hi=hi: hi - lo)
        good = (lambda plan, wide=wide: wide(plan) <= most) if kind == "within" else (lambda plan, wide=wide: wide(plan) >= most)
        as_far = p.where((kind, most, by_width, lo, hi), good, back)
        there = p.M(part.parts[1], c, d, back)
        found.append(there & as_far if kind == "within" else p.all & ~there | as_far)
    return p.M(part.parts[0], i, j, back) & (p.either(found) if kind == "within" else p.both(found))


def every_near(p, part, i, j, back):
    return p.both(p.all & ~p.M(part.parts[0], a, b, back) | near(p, part, a, b, back) for a, b in stretches(i, j))


def distance(p, part, i, j, back):
    if i >= j:
        return 0
    origin, to, by = part.parts
    return p.M(origin, i, j, back) & p.both(p.all & ~p.M(to, c, d, back) | p.M(by, *gap(i, j, c, d), back) for c, d in stretches(0, p.n))


def text(p, part, i, j, back):
    test = known("text", part.text)
    return p.where((bare(part.text), i, j), lambda plan: test(plan[i:j], plan[:i], plan[j:]), back)


def unknown(p, part, i, j, back):
    raise Unknown(part.kind)


MATCHES = {
    "tray": tray, "any": tray, "and": joined("M"), "or": joined("M"), "not": denied, "implies": implied("M"), "where": where, "neighbour": neighbour,
    "symmetric": symmetric, "quantity": quantity, "occurrences": occurrences, "sum": added, "many": many, "every": every, "near": near, "every near": every_near,
    "distance": distance, "text": text, "optional": unknown, "beginning": unknown, "end": unknown, "gap": unknown,
}
HOLDS = {"and": joined("H"), "or": joined("H"), "not": denied, "implies": implied("H"), "quantity": quantity, "occurrences": occurrences, "sum": added,
         "every": every, "every near": every_near, "text": text}
