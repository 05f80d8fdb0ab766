"""A brute force of the plan language: the table of docs/plan-language.md word for word, over the derivation tree of a file.

It knows productions by their names. What it does not know (a production that came later, a rule of a file that is used,
houses) raises Unknown, and that is then not asked of it."""
import itertools
from collections import Counter
import math
import operator
import re
from fractions import Fraction

from tree import find_all, words

FOOT, METRE = Fraction(3048, 10), Fraction(1000)          # millimetres
UNITS = {"ft": FOOT, "m": METRE}
OPERATORS = {"<": operator.lt, "<=": operator.le, "=": operator.eq, "!=": operator.ne, ">=": operator.ge, ">": operator.gt}
PLANS = 1200                                              # no more plans than this are gone through


class Unknown(Exception):
    """What the reference has no answer to."""


def length(text):
    metric = re.fullmatch(r"(\d+(?:\.\d+)?)(mm|cm|m)", text)
    if metric:
        return Fraction(metric[1]) * {"mm": 1, "cm": 10, "m": 1000}[metric[2]]
    feet = re.fullmatch(r"""(?:(\d+)')?[ -]*(?:(\d+)(?:[ -](\d+)/(\d+))?")?""", text)
    if not feet:
        raise Unknown(text)
    inches = Fraction(feet[2] or 0) + (Fraction(int(feet[3]), int(feet[4])) if feet[3] else 0)
    return int(feet[1] or 0) * FOOT + inches * FOOT / 12


def constant(text):
    area = re.fullmatch(r"(\d+(?:\.\d+)?)(sf|ft2|m2|cf|ft3|m3)", text)
    if area:
        return Fraction(area[1]) * {"sf": FOOT**2, "ft2": FOOT**2, "m2": METRE**2, "cf": FOOT**3, "ft3": FOOT**3, "m3": METRE**3}[area[2]]
    if re.fullmatch(r"\d+(\.\d+)?%?", text):
        return Fraction(text.rstrip("%")) / (100 if text.endswith("%") else 1)
    return length(text)


def signed(node):
    """A constant, which may have a minus before it."""
    texts = words(node)
    return -constant(texts[1]) if texts[0] == "-" else constant(texts[0])


# ---- schemas: a tray is a tuple with a value for each field; a zone's value is (fill, depth)

class Schema:
    """Of the items of a file: a schema has the fields, numbers and forbidden trays of the one that it is made from first."""

    def __init__(self, item, schemas):
        self.name = item.children[1].text
        older = words(item.child("from"))
        if older and older[1] not in schemas:
            raise Unknown(f"schema {older[1]}")
        before = Schema(schemas[older[1]], schemas) if older else None
        body = item.child("body")
        self.fields = merged(before.fields if before else [], [self._field(f) for f in find_all(body, "field")])
        self.numbers = {words(n)[1]: [self._case(c) for c in find_all(n, "number_case")] for n in find_all(body, "number_item")}
        if before and set(before.numbers) & set(self.numbers):
            raise Unknown("a number with more cases")
        self.numbers.update(before.numbers if before else {})
        self.limits = (before.limits if before else []) + find_all(body, "forbid")
        every = itertools.product(*[values for _, _, values in self.fields])
        self.trays = [t for t in every if all(self.lets_in(limit, t) for limit in self.limits)]

    def lets_in(self, limit, tray):
        """`only E`: E is so of the tray; `forbid E`: it is not."""
        return Plan(None, self, (tray,)).M(limit.child("expression"), Env(), 0, 1) == (limit.child("only_word") is not None)

    def _field(self, node):
        name = words(node.child("field_head"))[0]
        if node.child("FLAG"):
            return name, "flag", [False, True]
        values = find_all(node, "value")
        if node.child("zone"):
            return name, "zone", [v for value in values if words(value)[0] != "..." for v in fills(value)]
        texts = [words(v)[0] for v in values if words(v)[0] != "..."]
        if texts and texts[0][0].isdigit():
            return name, "length", [length(t) for t in texts]
        return name, "order" if node.child("ordered") else "choice", texts

    def _case(self, node):
        return node.child("tray_sum"), node.child("specifier")

    def index(self, name):
        found = [i for i, (n, _, _) in enumerate(self.fields) if n == name]
        if not found:
            raise Unknown(f"field {name}")
        return found[0]

    def number(self, name, tray):
        for figure, specifier in self.numbers[name]:
            if specifier is None or self.meets(specifier, tray, {}):
                return self.figure(figure, tray)
        raise Unknown("no case of a number")

    # arithmetic over one tray

    def figure(self, node, tray):
        known = FIGURES.get(node.name)
        if known:
            return known(self, node, tray)
        if len(node.children) == 1 and node.children[0].production:
            return self.figure(node.children[0], tray)
        raise Unknown(node.name)

    def named_figure(self, name, tray):
        if name in self.numbers:
            return self.number(name, tray)
        i = self.index(name)
        value = tray[i]
        if self.fields[i][1] == "order":
            return Fraction(self.fields[i][2].index(value) + 1)
        if self.fields[i][1] not in ("length", "zone"):
            raise Unknown(name)
        return value[1] if isinstance(value, tuple) else value

    # specifiers

    def meets(self, specifier, tray, values):
        return all(self.meets_item(item, tray, values) for item in find_all(specifier, "spec_item"))

    def meets_item(self, item, tray, values):
        return Item(self, tray, values).holds(item)


def merged(older, newer):
    """A field that an older schema has too keeps its kind and place, and has its values first."""
    added = {name: values for name, _, values in newer}
    known = [name for name, _, _ in older]
    return [(name, kind, values + [v for v in added.get(name, []) if v not in values]) for name, kind, values in older] + \
        [field for field in newer if field[0] not in known]


def fills(value):
    depths = value.child("depths")
    name = words(value)[0]
    return [(name, length(words(d)[0])) for d in find_all(depths, "spec_word")] if depths else [(name, Fraction(0))]


def divided(value, by):
    if by == 0:
        raise Unknown("division by zero")
    return value / by


def two(how):
    return lambda schema, node, tray: how(schema.figure(node.children[0], tray), schema.figure(node.children[2], tray))


def pair(how):
    return lambda schema, node, tray: how(schema.figure(node.children[2], tray), schema.figure(node.children[4], tray))


FIGURES = {
    "tray_sum: tray_sum PLUS tray_term": two(operator.add), "tray_sum: tray_sum DASH tray_term": two(operator.sub),
    "tray_term: tray_term STAR tray_signed": two(operator.mul), "tray_term: tray_term SLASH tray_signed": two(divided),
    "tray_signed: DASH tray_signed": lambda schema, node, tray: -schema.figure(node.children[1], tray),
    "tray_atom: NAME": lambda schema, node, tray: schema.named_figure(node.children[0].text, tray),
    "tray_atom: NAME NAME": lambda schema, node, tray: schema.named_figure(node.children[0].text, tray),
    "tray_atom: OPEN tray_sum CLOSE": lambda schema, node, tray: schema.figure(node.children[1], tray),
    "tray_atom: MIN OPEN tray_sum COMMA tray_sum CLOSE": pair(min), "tray_atom: MAX OPEN tray_sum COMMA tray_sum CLOSE": pair(max),
    "tray_atom: head_number": lambda schema, node, tray: constant(words(node)[0]),
}


def spec_words(node):
    """The words and signs of a list of them."""
    return (spec_words(node.children[0]) if len(node.children) > 1 else []) + [node.children[-1]]


def is_group(node):
    return node.name.startswith("spec_word: OPEN")


def compares_sums(item, nodes):
    """Is it a comparison of numbers of the tray, by arithmetic, or of one with another?"""
    kinds = {name: kind for name, kind, _ in item.schema.fields} | {name: "number" for name in item.schema.numbers}
    texts = [" ".join(words(n)) for n in nodes]
    signs = [n for n in nodes if n.symbol == "spec_sign"] + [s for n in nodes if is_group(n) for s in find_all(n, "spec_sign")]
    at = next((k for k, text in enumerate(texts) if text in OPERATORS), 0)
    if signs or not at:
        return bool(signs)
    values = next((values for name, kind, values in item.schema.fields if name == texts[0] and kind in ("choice", "order")), [])
    right = texts[at + 1]
    number = kinds.get(right) in ("length", "zone", "order", "number") and right not in values
    return texts[0][0].isdigit() or number or kinds.get(texts[0]) == "order" and right.isdigit()


class Comparison:
    """SUM sign SUM, read from left to right."""

    def __init__(self, item, nodes):
        self.item, self.nodes = item, list(nodes)

    def text(self):
        return " ".join(words(self.nodes[0])) if self.nodes else None

    def holds(self):
        left = self.sum()
        how = OPERATORS[" ".join(words(self.nodes.pop(0)))]
        return how(left, self.sum())

    def sum(self):
        value = self.term()
        while self.text() in ("+", "-"):
            value = operator.add(value, self.term()) if words(self.nodes.pop(0)) == ["+"] else operator.sub(value, self.term())
        return value

    def term(self):
        value = self.atom()
        while self.text() in ("*", "/"):
            value = value * self.atom() if words(self.nodes.pop(0)) == ["*"] else divided(value, self.atom())
        return value

    def atom(self):
        node = self.nodes.pop(0)
        text = " ".join(words(node))
        if text == "-":
            return -self.atom()
        if is_group(node):
            inner = spec_words(node.child("spec_alternatives").child("spec_alternative").child("spec_words"))
            return Comparison(self.item, inner).sum()
        if text[0].isdigit():
            return constant(text)
        given = self.item.values.get(text)
        if given and given[0] == AS_WRITTEN and given[1][0].isdigit():
            return constant(given[1])
        if given and given[0] != AS_WRITTEN:
            raise Unknown("a bound value in a sum")
        if self.text() == "depth":
            self.nodes.pop(0)
        return self.item.schema.named_figure(given[1] if given else text, self.item.tray)


class Item:
    """One item of `tray(...)`: alternatives of words, which are about one field."""

    def __init__(self, schema, tray, values):
        self.schema, self.tray, self.values, self.field = schema, tray, values, None

    def holds(self, item):
        return self.any_of(item.child("spec_alternatives"))

    def any_of(self, alternatives):
        return any([self.one(spec_words(a.child("spec_words"))) for a in find_all(alternatives, "spec_alternative")])

    def one(self, nodes):
        """[field] [depth] [not] value, or a comparison"""
        texts = [" ".join(words(n)) for n in nodes]
        if texts[0] == "not" and compares_sums(self, nodes[1:]) or compares_sums(self, nodes):
            return not Comparison(self, nodes[1:]).holds() if texts[0] == "not" else Comparison(self, nodes).holds()
        if texts[0] in [n for n, kind, _ in self.schema.fields if kind != "flag"] + list(self.schema.numbers):
            self.field, nodes, texts = texts[0], nodes[1:], texts[1:]
        if texts and texts[0] == "not":
            return not self.one(nodes[1:])
        if texts and texts[0] == "depth":
            nodes, texts = nodes[1:], texts[1:]
        if not nodes:
            raise Unknown("a field alone")
        if nodes[0].name.startswith("spec_word: OPEN"):
            return self.any_of(nodes[0].child("spec_alternatives"))
        if self.order() and texts[0] in OPERATORS and len(texts) == 2:
            return OPERATORS[texts[0]](self.place(self.tray[self.schema.index(self.field)]), self.place(texts[1]))
        if texts[0] in OPERATORS and len(texts) == 2:
            given = self.values.get(texts[1])
            text = given[1] if given and given[0] == AS_WRITTEN else texts[1]
            return OPERATORS[texts[0]](self.measured(), constant(text) if text[0].isdigit() else given[1])
        return all([self.word(node, text) for node, text in zip(nodes, texts)])

    def order(self):
        """The values of the field that the item is about, if they have an order."""
        return next((values for name, kind, values in self.schema.fields if kind == "order" and name == self.field), None)

    def place(self, value):
        return self.order().index(value)

    def measured(self):
        if self.field in self.schema.numbers:
            return self.schema.number(self.field, self.tray)
        value = self.value("length")
        return value[1] if isinstance(value, tuple) else value

    def value(self, kind):
        """The tray's value in the field that the item is about: the first of that kind where none is named."""
        if self.field is None:
            named = [n for n, k, _ in self.schema.fields if k == kind]
            if not named:
                raise Unknown(kind)
            self.field = named[0]
        return self.tray[self.schema.index(self.field)]

    def word(self, node, text):
        if text in self.values:
            field, value = self.values[text]
            if field == AS_WRITTEN:
                return self.measured() == length(value) if value[0].isdigit() else self.named(value)
            self.field = field
            return self.tray[self.schema.index(field)] == value
        if "DOTS" in node.name and self.order():
            low, high = [self.place(t) for t in words(node) if t != ".."]
            return low <= self.place(self.tray[self.schema.index(self.field)]) <= high
        if "DOTS" in node.name:
            low, high = [constant(t) for t in words(node) if t != ".."]
            return low <= self.measured() <= high
        if text[0].isdigit():
            return self.measured() == length(text)
        return self.named(text)

    def named(self, text):
        for i, (name, kind, values) in enumerate(self.schema.fields):
            if self.field not in (None, name):
                continue
            if kind == "flag" and name == text:
                return self.tray[i]
            if kind in ("choice", "order") and text in values or kind == "zone" and text in [fill for fill, _ in values]:
                self.field = name
                return (self.tray[i][0] if kind == "zone" else self.tray[i]) == text
        raise Unknown(text)


# ---- expressions of one plan

class Plan:
    """M(e, i, j): is the stretch a match? H(e, i, j): is there a match in it? `env` has what parameters and bound names stand for."""

    def __init__(self, file, schema, trays):
        self.file, self.schema, self.trays, self.n, self.memo, self._back = file, schema, trays, len(trays), {}, None
        self.least = {}                                   # of circles of rules: (which, name, i, j) that are true

    def holds(self, e):
        return self.H(e, Env(), 0, self.n)

    def meets(self, name):
        """Does a match of the rule lie in the plan?"""
        return rule_holds(self, name, "H", 0, self.n)

    def remember(self, how, which, e, env, i, j):
        key = (which, id(e), env, i, j)
        if key not in self.memo:
            self.memo[key] = how(self, e, env, i, j)
        return self.memo[key]

    def M(self, e, env, i, j):
        e = core(e)
        if e.name not in WHOLE:
            raise Unknown(e.name)
        return self.remember(WHOLE[e.name], "M", e, env, i, j)

    def H(self, e, env, i, j):
        e = core(e)
        return self.remember(SOMEWHERE.get(e.name, somewhere), "H", e, env, i, j)

    def D(self, e, env, i, j):
        """In how many ways the stretch is derived."""
        e = core(e)
        if not self.M(e, env, i, j):
            return 0
        return self.remember(WAYS[e.name], "D", e, env, i, j) if e.name in WAYS else 1

    def one(self, e, env, t):
        return self.M(e, env, t, t + 1)

    def in_circle(self, which, name, i, j):
        """Of rules that use themselves: the least that they say of one another. At first all are false, then what they say with that is
        true, for as long as more becomes so."""
        circle = self.file.circles[name]
        if circle not in self.least:
            known, self.least[circle] = self.memo, frozenset()
            every = [(w, n, a, b) for w in "MH" for n in circle for a in range(self.n + 1) for b in range(a, self.n + 1)]
            try:
                while True:
                    self.memo = {}
                    found = frozenset(k for k in every if getattr(self, k[0])(self.file.rules[k[1]][1], Env(), k[2], k[3]))
                    if found == self.least[circle]:
                        break
                    self.least[circle] = found
            except Unknown:
                del self.least[circle]
                raise
            finally:
                self.memo = known
        return (which, name, i, j) in self.least[circle]

    @property
    def back(self):
        if self._back is None:
            self._back = Plan(self.file, self.schema, self.trays[::-1])
        return self._back

    # sums

    def value(self, e, env=None, i=0, j=None):
        e, env, j = core(e), env or Env(), self.n if j is None else j
        if e.name not in SUMS:
            raise Unknown(e.name)
        return SUMS[e.name](self, e, env, i, j)

    def figures(self, node, of, env, i, j):
        return sum((self.schema.figure(node, self.trays[t]) for t in range(i, j) if of is None or self.one(of, env, t)), Fraction(0))


AS_WRITTEN = " "          # in place of a field: the value is a text, which means what it would where the name stands


class Env(tuple):
    """(name, what it stands for) pairs: an (expression, Env), a number, a (field, value), or (AS_WRITTEN, text)."""

    def get(self, name):
        return next((what for known, what in reversed(self) if known == name), None)

    def with_names(self, pairs):
        return Env(tuple(self) + tuple(pairs))

    def values(self):
        return {name: what for name, what in self if isinstance(what, tuple) and isinstance(what[0], str)}


PARENTHESES = {"primary: OPEN expression CLOSE", "cond_atom: OPEN condition CLOSE"}


def core(node):
    """Without productions of one symbol and without parentheses."""
    while True:
        if node.name in PARENTHESES:
            node = node.children[1]
        elif node.production and len(node.children) == 1 and node.children[0].production:
            node = node.children[0]
        else:
            return node


def somewhere(plan, e, env, i, j):
    return any(plan.M(e, env, a, b) for a in range(i, j) for b in range(a + 1, j + 1))


def kids(*places):
    return lambda e: [e.children[p] for p in places]


def tray(plan, e, env, i, j):
    return j == i + 1 and plan.schema.meets(e.child("specifier"), plan.trays[i], env.values())


def implies(plan, e, env, i, j):
    return not plan.H(e.children[0], env, i, j) or plan.M(e.children[2], env, i, j)


def neighbour(plan, e, env, i, j):
    """Cuts from i to j; the pairs say where a part may begin and whether one stood before it."""
    cuts = {(i, False)}
    for part in find_all(e.child("parts"), "part"):
        x = core(part)
        if x.name == "primary: BEGINNING":
            cuts = cuts if i == 0 else set()
        elif x.name == "primary: END":
            cuts = {c for c in cuts if c[0] == plan.n}
        elif x.name == "part: ELLIPSIS":
            cuts |= {(b, True) for a, _ in cuts for b in range(a + 1, j + 1)}
        else:
            optional = x.name == "primary: OPTIONAL OPEN expression CLOSE"
            inner = x.children[2] if optional else x
            optional = optional or is_repeat(plan, x) and times(plan, x, env)[0] == 0
            cuts = {(b, True) for a, _ in cuts for b in range(a + 1, j + 1) if plan.M(inner, env, a, b)} | (cuts if optional else set())
    return (j, True) in cuts


def symmetric(plan, e, env, i, j):
    inner = e.children[1]
    return plan.M(inner, env, i, j) or plan.back.M(inner, env, plan.n - j, plan.n - i)


def looked_at(plan, e, i, j):
    """Where a count looks: at the stretch, or at what lies before it or behind it."""
    word = words(e.child("region"))
    return (0, i) if word == ["before"] else (j, plan.n) if word == ["after"] else (i, j)


def quantity(plan, e, env, i, j):
    i, j = looked_at(plan, e, i, j)
    return sum(plan.one(e.children[2], env, t) for t in range(i, j))


def occurrences(plan, e, env, i, j):
    i, j = looked_at(plan, e, i, j)
    return sum(any(plan.M(e.children[2], env, t, b) for b in range(t + 1, j + 1)) for t in range(i, j))


def asked(number):
    return lambda plan, e, env, i, j: meets_condition(e.children[-2], env, number(plan, e, env, i, j))


def sum_of(plan, e, env, i, j):
    of = e.child("expression")
    return plan.figures(e.child("tray_sum"), of, env, *looked_at(plan, e, i, j))


def many(plan, e, env, i, j):
    return i < j and all(plan.one(e.children[2], env, t) for t in range(i, j))


def is_repeat(plan, e):
    return e.name == "primary: NAME OPEN call_args CLOSE" and e.children[0].text == "repeat" and not plan.file.has_params("repeat")


def times(plan, e, env):
    """(at least, at most or None) of a `repeat`."""
    often = core(find_all(e.child("call_args"), "call_arg")[1])
    ends = [c for c in often.children if c.symbol == "additive"] if "DOTS" in often.name else [often, often]
    numbers = [plan.value(end, env) for end in ends]
    return numbers[0], numbers[1] if len(numbers) == 2 else None


def repeat(plan, e, env, i, j):
    """Stretches side by side: after each further one these may end there."""
    inner = find_all(e.child("call_args"), "call_arg")[0]
    low, high = times(plan, e, env)
    ends, number = {i}, 0
    while ends and (high is None or number < high):
        ends, number = {b for a in ends for b in range(a + 1, j + 1) if plan.M(inner, env, a, b)}, number + 1
        if number >= low and j in ends:
            return True
    return False


def distance(plan, e, env, i, j):
    source, to, by = e.children[3], e.children[6], e.children[9]
    if not (i < j and plan.M(source, env, i, j)):
        return False
    stretches = [(a, b) for a in range(plan.n) for b in range(a + 1, plan.n + 1) if plan.M(to, env, a, b)]
    return all(plan.M(by, env, *((b, i) if b <= i else (j, a) if j <= a else (i, i))) for a, b in stretches)


def around(plan, e, env, i, j):
    """The gaps to all stretches that are an `e` and share no tray with this one."""
    found = [(a, b) for a in range(plan.n) for b in range(a + 1, plan.n + 1) if (b <= i or j <= a) and plan.M(e, env, a, b)]
    return [(b, i) if b <= i else (j, a) for a, b in found]


def power(plan, e, env):
    """Of a constant: 0 a number, 1 a length."""
    e = core(e)
    if e.name in ("term: term STAR signed", "term: term SLASH signed"):
        return power(plan, e.children[0], env) + (1 if "STAR" in e.name else -1) * power(plan, e.children[2], env)
    if e.name.startswith("head_number"):
        return {"LENGTH": 1, "AREA": 2}.get(e.children[0].symbol, 0)
    if e.name == "primary: NAME":
        name = e.children[0].text
        return 0 if isinstance(env.get(name), Fraction) else power(plan, plan.file.sum(name), Env())
    return power(plan, e.children[1 if e.name == "signed: DASH signed" else 0], env)


def gap(plan, e, env, trays):
    """What a gap measures, and the distance that it is compared with: trays, or the first field of lengths."""
    value = plan.value(e, env)
    lengths = [k for k, (_, kind, _) in enumerate(plan.schema.fields) if kind == "length"]
    if power(plan, e, env) == 1 and value != 0:
        if not lengths:
            raise Unknown("no lengths")
        return sum((plan.trays[t][lengths[0]] for t in range(*trays)), Fraction(0)), value
    return Fraction(trays[1] - trays[0]), value


def near(distance, how):
    def matches(plan, e, env, i, j):
        if not (i < j and plan.M(e.children[0], env, i, j)):
            return False
        gaps = around(plan, e.children[-1], env, i, j)
        if distance is None:
            return any(a == b for a, b in gaps)
        return (any if how == operator.le else all)(how(*gap(plan, e.children[distance], env, g)) for g in gaps)
    return matches


def every_near(plan, e, env, i, j):
    relation = core(e.children[1])
    return all(plan.M(relation, env, a, b) for a in range(i, j) for b in range(a + 1, j + 1) if plan.M(relation.children[0], env, a, b))


def where(plan, e, env, i, j):
    return i < j and plan.M(e.children[0], env, i, j) and plan.M(e.children[2], env, i, j)


def divided_compared(plan, e, env, i, j):
    value, by, rest = [plan.value(e.children[k], env, i, j) for k in (0, 2, 4)]
    return OPERATORS[words(e.children[3])[0]](value % by, rest)


def every_tray(plan, e, env, i, j):
    return all(not plan.one(e.children[2], env, t) or plan.one(e.children[4], env, t) for t in range(i, j))


def bindings(plan, e, env):
    """What a quantifier's names stand for, one after another."""
    names = words(e.children[1])[::2]
    field = e.children[3].text
    values = plan.schema.fields[plan.schema.index(field)][2]
    return [env.with_names((n, (field, v)) for n, v in zip(names, chosen)) for chosen in itertools.product(values, repeat=len(names))]


def quantified(joined, which):
    return lambda plan, e, env, i, j: joined(getattr(plan, which)(e.children[5], b, i, j) for b in bindings(plan, e, env))


def compared(plan, e, env, i, j):
    side = side_compared(plan, e)
    if side is not None:
        return side
    bound = bound_sides(plan, e, env)
    if bound:
        return OPERATORS[words(e.children[1])[0]](*bound)
    left, right = plan.value(e.children[0], env, i, j), plan.value(e.children[2], env, i, j)
    return left is not None and right is not None and OPERATORS[words(e.children[1])[0]](left, right)


def side_compared(plan, e):
    """Of a param of words and one of them; None where neither side is such a param."""
    texts = [words(e.children[k]) for k in (0, 2)]
    for one, other in (texts, texts[::-1]):
        if len(one) == len(other) == 1 and one[0] in plan.file.sides:
            return OPERATORS[words(e.children[1])[0]](plan.file.sides[one[0]], other[0])
    return None


def bound_sides(plan, e, env):
    """The values of `v < w`, where a side is a name that a quantifier binds."""
    texts = [words(e.children[k]) for k in (0, 2)]
    sides = [env.get(t[0]) if len(t) == 1 else None for t in texts]
    sides = [s if isinstance(s, tuple) and isinstance(s[0], str) else None for s in sides]
    if not any(sides):
        return None
    texts = [[s[1]] if s and s[0] == AS_WRITTEN else t for s, t in zip(sides, texts)]
    return [s[1] if s and s[0] != AS_WRITTEN else (length(t[0]) if t[0][0].isdigit() else t[0]) for s, t in zip(sides, texts)]


def within(plan, e, env, i, j):
    low, value, high = [plan.value(e.children[k], env, i, j) for k in (2, 0, 4)]
    return value is not None and low <= value <= high


def open_plan(plan, e, env, i, j):
    if (i, j) != (0, plan.n):
        return False
    pattern = find_all(e.child("pattern"), "pattern_tray")

    def fits(k, t):
        if k == len(pattern):
            return t == plan.n
        if words(pattern[k]) == ["..."]:
            return any(fits(k + 1, b) for b in range(t, plan.n + 1))
        if t == plan.n or words(pattern[k]) != ["?"] and not plan.schema.meets(pattern[k], plan.trays[t], env.values()):
            return False
        return fits(k + 1, t + 1)
    return fits(0, 0)


def named(which):
    def matches(plan, e, env, i, j):
        name = e.children[0].text
        given = env.get(name)
        if given is not None:
            return getattr(plan, which)(given[0], given[1], i, j)
        return rule_holds(plan, name, which, i, j)
    return matches


def rule_holds(plan, name, which, i, j):
    if name in plan.file.circles:
        return plan.in_circle(which, name, i, j)
    return getattr(plan, which)(plan.file.rule(name)[1], Env(), i, j)


def own_fields(plan, e, env):
    """The fields that `values` or `mirrored` is about; None where the file has a rule of that name."""
    if e.children[0].text not in ("values", "mirrored") or plan.file.has_params(e.children[0].text):
        return None
    named = [words(a)[0] for a in find_all(e.child("call_args"), "call_arg")]
    named = [env.get(n)[1] if env.get(n) else n for n in named]
    return [plan.schema.index(n) for n in named]


def called(which):
    def matches(plan, e, env, i, j):
        if is_repeat(plan, e):
            return (repeat if which == "M" else somewhere)(plan, e, env, i, j)
        fields = own_fields(plan, e, env)
        if fields is not None:
            return all(plan.trays[i + t][f] == plan.trays[j - 1 - t][f] for t in range(j - i) for f in fields)
        params, body = plan.file.rule(e.children[0].text)
        arguments = find_all(e.child("call_args"), "call_arg")
        inner = Env((name, plan.file.argument(plan, a, kind, env)) for (name, kind), a in zip(params, arguments))
        return getattr(plan, which)(body, inner, i, j)
    return matches


def join(which, how, *places):
    return lambda plan, e, env, i, j: how(getattr(plan, which)(e.children[p], env, i, j) for p in places)


def negated(place):
    return lambda plan, e, env, i, j: not plan.H(e.children[place], env, i, j)


P = "primary: "
WHOLE = {
    P + "TRAY OPEN specifier CLOSE": tray, P + "ANY": lambda plan, e, env, i, j: j == i + 1,
    "ors: and OR and": join("M", any, 0, 2), "ors: ors OR and": join("M", any, 0, 2),
    "ands: not AND not": join("M", all, 0, 2), "ands: ands AND not": join("M", all, 0, 2), "not: NOT not": negated(1),
    "implied: disjunction IMPLIES disjunction": implies, P + "NEIGHBOUR OPEN parts CLOSE": neighbour, P + "SYMMETRIC primary": symmetric,
    P + "QUANTITY OPEN expression region COMMA condition CLOSE": asked(quantity), P + "OCCURRENCES OPEN expression region COMMA condition CLOSE": asked(occurrences),
    P + "SUM OPEN tray_sum region COMMA condition CLOSE": asked(sum_of), P + "SUM OPEN tray_sum OF expression region COMMA condition CLOSE": asked(sum_of),
    P + "MANY OPEN expression CLOSE": many, P + "EVERY OPEN expression COMMA expression CLOSE": every_tray,
    P + "DISTANCE OPEN FROM expression COMMA TO expression COMMA BY expression CLOSE": distance,
    P + "SOME names IN NAME OPEN expression CLOSE": quantified(any, "M"), P + "EVERY names IN NAME OPEN expression CLOSE": quantified(all, "M"),
    "nearness: additive BESIDE additive": near(None, None), "nearness: additive WITHIN additive OF additive": near(2, operator.le),
    "nearness: additive AT LEAST additive FROM EVERY additive": near(3, operator.ge), "compared: EVERY nearness": every_near,
    "qualified: disjunction WHERE disjunction": where, "compared: additive MOD additive comparison additive": divided_compared,
    "comparable: additive comparison additive": compared, "compared: additive IN additive DOTS additive": within,
    P + "PLAN OPEN_BRACKET pattern CLOSE_BRACKET": open_plan, P + "NAME": named("M"), P + "NAME OPEN call_args CLOSE": called("M"),
}
SOMEWHERE = {
    "ors: and OR and": join("H", any, 0, 2), "ors: ors OR and": join("H", any, 0, 2),
    "ands: not AND not": join("H", all, 0, 2), "ands: ands AND not": join("H", all, 0, 2),
    "implied: disjunction IMPLIES disjunction": lambda plan, e, env, i, j: not plan.H(e.children[0], env, i, j) or plan.H(e.children[2], env, i, j),
    P + "SOME names IN NAME OPEN expression CLOSE": quantified(any, "H"), P + "EVERY names IN NAME OPEN expression CLOSE": quantified(all, "H"),
    P + "NAME": named("H"), P + "NAME OPEN call_args CLOSE": called("H"),
}
for same in ("not: NOT not", P + "QUANTITY OPEN expression region COMMA condition CLOSE", P + "OCCURRENCES OPEN expression region COMMA condition CLOSE",
             P + "SUM OPEN tray_sum region COMMA condition CLOSE", P + "SUM OPEN tray_sum OF expression region COMMA condition CLOSE",
             P + "EVERY OPEN expression COMMA expression CLOSE", "comparable: additive comparison additive",
             "compared: additive IN additive DOTS additive", "compared: EVERY nearness", "compared: additive MOD additive comparison additive"):
    SOMEWHERE[same] = WHOLE[same]
WHOLE_PLAN = P + "PLAN OPEN_BRACKET pattern CLOSE_BRACKET"
SOMEWHERE[WHOLE_PLAN] = lambda plan, e, env, i, j: (i, j) == (0, plan.n) and plan.M(e, env, i, j)


# ---- in how many ways

def is_decided(plan, e, env):
    """Before there is a plan, by what names are bound to and by params."""
    e = core(e)
    if e.name == "comparable: additive comparison additive":
        return side_compared(plan, e) is not None or bool(bound_sides(plan, e, env))
    if e.name == "implied: disjunction IMPLIES disjunction" or e.name.startswith(("ors: ", "ands: ", "not: ")):
        return all(is_decided(plan, c, env) for c in e.children if c.children)
    return False


def sum_of_ways(plan, sides, i, j):
    """What is decided to hold is all of an `or`."""
    if any(is_decided(plan, e, env) and plan.M(e, env, i, j) for e, env in sides):
        return 1
    return sum(plan.D(e, env, i, j) for e, env in sides)


def product_of_ways(plan, sides, i, j):
    return math.prod(plan.D(e, env, i, j) for e, env in sides)


def sides_of(e):
    """Of an `or` or `and` of several, which the grammar nests to the left."""
    e = core(e)
    kind = e.name.split(":")[0]
    if kind not in ("ors", "ands"):
        return [e]
    first = core(e.children[0])
    return (sides_of(first) if first.name.split(":")[0] == kind and e.name.startswith(f"{kind}: {kind}") else [first]) + [e.children[2]]


def joined_ways(how):
    return lambda plan, e, env, i, j: how(plan, [(side, env) for side in sides_of(e)], i, j)


def quantified_ways(how):
    return lambda plan, e, env, i, j: how(plan, [(e.children[5], bound) for bound in bindings(plan, e, env)], i, j)


def neighbour_ways(plan, e, env, i, j):
    """Each part from the first on takes a stretch, and what is behind it the rest: that is looked at first, so that no rule is asked of
    all of the stretch again."""
    parts = [core(part) for part in find_all(e.child("parts"), "part")]
    parts = [x for x in parts if x.name not in ("primary: BEGINNING", "primary: END")]        # M has seen to them

    def rest(k, a, any_before):
        if k == len(parts):
            return int(a == j and any_before)
        x = parts[k]
        gap, optional = x.name == "part: ELLIPSIS", x.name == "primary: OPTIONAL OPEN expression CLOSE"
        inner = x.children[2] if optional else x
        absent = gap or optional or is_repeat(plan, x) and times(plan, x, env)[0] == 0
        found = rest(k + 1, a, any_before) if absent else 0
        for b in range(a + 1, j + 1):
            behind = rest(k + 1, b, True)
            found += behind and behind * (1 if gap else plan.D(inner, env, a, b))
        return found
    return rest(0, i, False)


def repeat_ways(plan, e, env, i, j):
    inner = find_all(e.child("call_args"), "call_arg")[0]
    low, high = times(plan, e, env)

    def rest(a, done):
        if a == j:
            return int(done >= max(low, 1))
        if done == high:
            return 0
        found = 0
        for b in range(a + 1, j + 1):
            behind = rest(b, done + 1)
            found += behind and behind * plan.D(inner, env, a, b)
        return found
    return rest(i, 0)


def symmetric_ways(plan, e, env, i, j):
    return plan.D(e.children[1], env, i, j) + plan.back.D(e.children[1], env, plan.n - j, plan.n - i)


def named_ways(plan, e, env, i, j):
    given = env.get(e.children[0].text)
    body, inner = given if given is not None else (plan.file.rule(e.children[0].text)[1], Env())
    return plan.D(body, inner, i, j)


def called_ways(plan, e, env, i, j):
    if is_repeat(plan, e):
        return repeat_ways(plan, e, env, i, j)
    if own_fields(plan, e, env) is not None:
        return 1
    params, body = plan.file.rule(e.children[0].text)
    arguments = find_all(e.child("call_args"), "call_arg")
    return plan.D(body, Env((name, plan.file.argument(plan, a, kind, env)) for (name, kind), a in zip(params, arguments)), i, j)


WAYS = {
    "ors: and OR and": joined_ways(sum_of_ways), "ors: ors OR and": joined_ways(sum_of_ways),
    "ands: not AND not": joined_ways(product_of_ways), "ands: ands AND not": joined_ways(product_of_ways),
    P + "NEIGHBOUR OPEN parts CLOSE": neighbour_ways, P + "SYMMETRIC primary": symmetric_ways,
    P + "SOME names IN NAME OPEN expression CLOSE": quantified_ways(sum_of_ways),
    P + "EVERY names IN NAME OPEN expression CLOSE": quantified_ways(product_of_ways),
    P + "NAME": named_ways, P + "NAME OPEN call_args CLOSE": called_ways,
}


# ---- sums

def arithmetic(how, left=0, right=2):
    def value(plan, e, env, i, j):
        sides = [plan.value(e.children[k], env, i, j) for k in (left, right)]
        return None if None in sides else Fraction(0) if how is operator.mul and 0 in sides else how(*sides)
    return value


# A number that is none: None, divided by 0. INFINITE, or less that, is the least or the greatest of nothing.
INFINITE = float("inf")


def best_of(e, numbers):
    """The greatest, or the least, of numbers."""
    least = words(e.child("extreme"))[0].lower() == "min"
    return min(numbers, default=INFINITE) if least else max(numbers, default=-INFINITE)


def extreme(plan, e, env, i, j):
    of = e.child("expression")
    return best_of(e, [plan.schema.figure(e.child("tray_sum"), plan.trays[t]) for t in range(i, j) if of is None or plan.one(of, env, t)])


def extreme_gap(plan, e, env, i, j):
    source, destination = find_all_expressions(e)
    by = e.children[8].text if "BY" in e.name else None
    each = []
    for a in range(i, j):
        for b in range(a + 1, j + 1):
            if plan.M(source, env, a, b):
                each.append(min((between(plan, by, a, b, c, d) for c in range(plan.n) for d in range(c + 1, plan.n + 1)
                                 if (d <= a or b <= c) and plan.M(destination, env, c, d)), default=INFINITE))
    return best_of(e, each)


def find_all_expressions(e):
    return [c for c in e.children if c.symbol == "expression"]


def between(plan, by, a, b, c, d):
    first, last = (d, a) if d <= a else (b, c)
    return Fraction(last - first) if by is None else sum((plan.schema.named_figure(by, plan.trays[t]) for t in range(first, last)), Fraction(0))


def named_sum(plan, e, env, i, j):
    name = e.children[0].text
    given = env.get(name)
    if isinstance(given, Fraction):
        return given
    return plan.value(plan.file.sum(name), Env(), i, j)


def different_values(plan, e, env, i, j):
    fields = own_fields(plan, e, env)
    if fields is None:
        raise Unknown("a number that is a call")
    return Fraction(len({plan.trays[t][fields[0]] for t in range(i, j)}))


def over(plan, e, env, i, j):
    """Of two numbers that depend on the plan it may have no value."""
    value, by = plan.value(e.children[0], env, i, j), plan.value(e.children[2], env, i, j)
    return None if value is None or by in (None, 0) else value / by


def negative(value):
    return None if value is None else -value


SUMS = {
    "additive: additive PLUS term": arithmetic(operator.add), "additive: additive DASH term": arithmetic(operator.sub),
    "term: term STAR signed": arithmetic(operator.mul), "term: term SLASH signed": over,
    "signed: DASH signed": lambda plan, e, env, i, j: negative(plan.value(e.children[1], env, i, j)),
    P + "extreme OPEN tray_sum CLOSE": extreme, P + "extreme OPEN tray_sum OF expression CLOSE": extreme,
    P + "extreme OPEN GAP FROM expression TO expression CLOSE": extreme_gap, P + "extreme OPEN GAP FROM expression TO expression BY NAME CLOSE": extreme_gap,
    P + "NAME OPEN call_args CLOSE": different_values,
    P + "TRAYS": lambda plan, e, env, i, j: Fraction(j - i), P + "NAME": named_sum,
    P + "MATCHES OPEN expression CLOSE": lambda plan, e, env, i, j: Fraction(plan.H(e.children[2], env, 0, plan.n)),
    P + "QUANTITY OPEN expression region CLOSE": lambda plan, e, env, i, j: Fraction(quantity(plan, e, env, i, j)),
    P + "OCCURRENCES OPEN expression region CLOSE": lambda plan, e, env, i, j: Fraction(occurrences(plan, e, env, i, j)),
    P + "SUM OPEN tray_sum region CLOSE": sum_of, P + "SUM OPEN tray_sum OF expression region CLOSE": sum_of,
}
for token in ("NUMBER", "LENGTH", "AREA", "DECIMAL"):
    SUMS["head_number: " + token] = lambda plan, e, env, i, j: constant(words(e)[0])


# ---- conditions on a number

def meets_condition(node, env, n):
    c = core(node)
    if c.name in CONDITIONS:
        return CONDITIONS[c.name](c, env, n)
    raise Unknown(c.name)


def operand(node, env, n):
    texts = words(node)
    if texts[0][0].isdigit():
        return constant(texts[0])
    if texts[0] == "-":
        return -constant(texts[1])
    given = env.get(texts[0])
    return n if given is None else given


def condition_range(c, env, n):
    ends = [signed(n) for n in find_all(c.child("range"), "constant")]
    return ends[0] <= operand(c.children[0], env, n) <= ends[-1]


def remainder(c, env, n):
    value, by, to = operand(c.children[0], env, n), operand(c.children[2], env, n), operand(c.children[4], env, n)
    return OPERATORS[words(c.children[3])[0]](value % by, to)


CONDITIONS = {
    "cond_ors: cond_and OR cond_and": lambda c, env, n: meets_condition(c.children[0], env, n) or meets_condition(c.children[2], env, n),
    "cond_ands: cond_not AND cond_not": lambda c, env, n: meets_condition(c.children[0], env, n) and meets_condition(c.children[2], env, n),
    "cond_not: NOT cond_not": lambda c, env, n: not meets_condition(c.children[1], env, n),
    "compare: operand comparison operand":
        lambda c, env, n: OPERATORS[words(c.children[1])[0]](operand(c.children[0], env, n), operand(c.children[2], env, n)),
    "cond_atom: operand IN range": condition_range, "cond_atom: operand MOD constant comparison operand": remainder,
}
CONDITIONS["cond_ors: cond_ors OR cond_and"] = CONDITIONS["cond_ors: cond_and OR cond_and"]
CONDITIONS["cond_ands: cond_ands AND cond_not"] = CONDITIONS["cond_ands: cond_not AND cond_not"]


# ---- a file

def names_used(node):
    """The names that may be rules."""
    if node.name in ("primary: NAME", "primary: NAME OPEN call_args CLOSE"):
        return {node.children[0].text}.union(*map(names_used, node.children))
    return set().union(*map(names_used, node.children))


def of_rules(items):
    """{name: (names of its parameters, expression)}"""
    heads = [(item.child("rule_head"), item.child("expression")) for item in items if item.production.symbols[0] == "rule_head"]
    return {head.child("NAME").text: (words(head.child("params"))[1:-1:2], body) for head, body in heads}


def circles(uses):
    """{name: the names of its circle} of those that use themselves, also by way of others."""
    reached = {name: used & set(uses) for name, used in uses.items()}
    for _ in uses:
        reached = {name: used.union(*(reached[n] for n in used)) for name, used in reached.items()}
    return {name: frozenset(n for n in used if name in reached[n]) for name, used in reached.items() if name in used}


class File:
    """What a file says about one of its schemas."""

    def __init__(self, root, schema):
        self.root, self.images = root, {}
        self.items = find_all(root, "item")
        schemas = {i.child("NAME").text: i for i in self.items if i.production.symbols[0] == "schema"}
        if schema not in schemas:
            raise Unknown(f"schema {schema}")
        self.schema = Schema(schemas[schema], schemas)
        self.rules, self.sums, self.libraries, self.sides = {}, {}, {}, {}
        for item in self.items:
            self._declare(item)
        self.rules.update(of_rules(self.items))
        self.circles = circles({name: used for name, (params, body) in self.rules.items() for used in [names_used(body) - set(params)]})

    def has_params(self, name):
        """Is it a rule that has parameters? Such a one hides what the language has itself."""
        return bool(self.rules.get(name, ([],))[0])

    def _declare(self, item):
        kind = item.production.symbols[0]
        if kind == "param" and item.child("param_words"):
            self.sides[item.child("NAME").text] = words(item.child("param_words"))[0]
        elif kind in ("measure", "let", "param"):
            self.sums[item.child("NAME").text] = item.child("additive") or item.child("expression")
        elif kind == "library_head":
            self.libraries[item.child("library_head").child("NAME").text] = item

    def rule(self, name):
        if name not in self.rules:
            raise Unknown(name)
        params, body = self.rules[name]
        return [(p, None) for p in params], body

    def sum(self, name):
        if name not in self.sums:
            raise Unknown(name)
        return self.sums[name]

    def argument(self, plan, node, kind, env):
        """A number, a value of a field, or an expression: what it is written as decides."""
        inner = core(node)
        texts = words(inner)
        known = env.get(texts[0]) if texts else None
        if len(texts) != 1 or known is not None and not isinstance(known, (Fraction, tuple)):
            return node, env
        if isinstance(known, Fraction) or known is not None and isinstance(known[0], str):
            return known
        if re.fullmatch(r"\d+", texts[0]):
            return Fraction(texts[0])
        if inner.name.startswith("head_number"):
            return AS_WRITTEN, texts[0]
        if inner.name != "primary: NAME" or texts[0] in self.rules or known is not None:
            return node, env
        if texts[0] in self.sums:
            raise Unknown("a name for a parameter")
        return AS_WRITTEN, texts[0]

    def named(self, name, word):
        """What stands behind the word in the head of the library, else None."""
        texts = words(self.libraries[name].child("library_head"))
        return texts[texts.index(word) + 1] if word in texts else None

    def clauses(self, name):
        """Those of the library that it is made from first; one that is projected has none of them."""
        older = self.named(name, "from") if not self.named(name, "onto") else None
        return (self.clauses(older) if older else []) + find_all(self.libraries[name].child("clauses"), "clause")

    def lengths(self, name):
        own = find_all(self.libraries[name].child("clauses"), "clause")
        ranges = [c for c in own if c.production.symbols[0] == "trays_word"]
        if not ranges:
            return self.lengths(self.named(name, "from"))
        ends = [int(t) for t in words(ranges[-1].child("range")) if t != ".."]
        return range(ends[0], ends[-1] + 1)

    def schema_of(self, name):
        known = self.named(name, "onto") or self.named(name, "using")
        older = self.named(name, "from")
        return known or (self.schema_of(older) if older else self.schema.name)

    def projection(self, name):
        """(the library whose plans lie above those of this one, the fields of the schema onto which it is projected), or None."""
        older, onto = self.named(name, "from"), self.named(name, "onto")
        if onto:
            return older, File(self.root, onto).schema.fields
        return self.projection(older) if older else None

    def bare(self, plan, fields):
        """The plan without all other fields; None where it has a value that these do not have."""
        trays = tuple(tray[:len(fields)] for tray in plan.trays)
        return trays if all(v in values for tray in trays for v, (_, _, values) in zip(tray, fields)) else None

    def images_above(self, plan, above, fields, lengths):
        """How many plans of the library above, of these lengths, are the same in these fields?"""
        key = above, len(fields), lengths
        if key not in self.images:
            self.images[key] = Counter(self.bare(p, fields) for p in File(self.root, self.schema_of(above)).kept(above, lengths))
        bare = self.bare(plan, fields)
        return self.images[key][bare] if bare is not None else 0

    def plans(self, name, lengths=None):
        lengths, each = lengths or self.lengths(name), len(self.schema.trays)
        if sum(each**n for n in lengths) > PLANS:
            raise Unknown("too many plans")
        for n in lengths:
            for trays in itertools.product(self.schema.trays, repeat=n):
                yield Plan(self, self.schema, trays)

    def kept(self, name, lengths=None):
        clauses, projection, lengths = self.clauses(name), self.projection(name), lengths or self.lengths(name)
        return [p for p in self.plans(name, lengths) if (not projection or self.images_above(p, *projection, lengths)) and all(self.keeps(p, c) for c in clauses)]

    def keeps(self, plan, clause):
        kind = clause.production.symbols[0]
        if kind == "require_word":
            return all(plan.holds(r.children[0]) for r in find_all(clause, "require"))
        if kind == "generate_word":
            return self.generates(plan, clause)
        if kind == "prune_word":
            return not any(plan.holds(p.children[0]) for p in find_all(clause, "prune"))
        if kind == "total_word":
            return self.total(plan, clause)
        return True

    def generates(self, plan, clause):
        return plan.M(clause.child("require").children[0], Env(), 0, plan.n)

    def ways(self, plan, name):
        """In how many ways the library makes the plan, which it keeps."""
        clause, projection = self.generate(name), self.projection(name)
        if projection:
            return self.images_above(plan, *projection, self.lengths(name))
        return plan.D(clause.child("require").children[0], Env(), 0, plan.n) if clause else 1

    def generate(self, name):
        """The clause that says what plans are made of, or None."""
        return next((c for c in self.clauses(name) if c.production.symbols[0] == "generate_word"), None)

    def preferences(self, name):
        """(expression, worth) of those of the library."""
        found = [p for c in self.clauses(name) if c.production.symbols[0] == "prefer_word" for p in find_all(c, "preference")]
        return [(p.child("expression"), constant(words(p.child("worth"))[1]) if words(p.child("worth")) else Fraction(1)) for p in found]

    def preference(self, plan, name):
        """What the preferences that the plan meets are worth together."""
        return sum((worth for expression, worth in self.preferences(name) if plan.holds(expression)), Fraction(0))

    def weight(self, plan, name):
        """How many times as likely the plan is as one without weights."""
        product = Fraction(1)
        for clause in self.clauses(name):
            if clause.production.symbols[0] == "weight_word":
                trays = sum(plan.one(clause.child("expression"), Env(), t) for t in range(plan.n))
                product *= constant(words(clause.child("positive"))[0]) ** trays
        return product

    def total(self, plan, clause):
        named_field = words(clause.child("total_field"))
        lengths = [n for n, kind, _ in self.schema.fields if kind == "length"]
        name = named_field[0] if named_field else lengths[0]
        value = sum((self.schema.named_figure(name, t) for t in plan.trays), Fraction(0))
        if clause.child("range"):
            ends = [signed(n) for n in find_all(clause.child("range"), "constant")]
            return ends[0] <= value <= ends[-1]
        return OPERATORS[words(clause.child("comparison"))[0]](value, signed(clause.child("constant")))
