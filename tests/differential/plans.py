"""What plan files are about, beside their grammar: which kinds of parts go together, and which names can stand where."""
from dataclasses import dataclass, replace

import circles
import specifiers
from maker import Notation
from scope import Field, Rule, Scope, body_fields, merged
from tree import Node, listed, wrapped

DOCS = ['"a doc"', '"it\'s a \\"quoted\\" word"', '"größer \\\\ 5\'"', '""']
CODES = ["W001", "W002", "W003", "W004", "W005", "W008"]
NAMES = ["red", "blue", "lime", "oak", "tall", "wide", "end", "sum"]
FEET, METRES = ["3'", "4'", "5'", "8'6\"", "12'"], ["900mm", "1.2m", "2m", "3.6m"]
DEPTHS_FEET, DEPTHS_METRES = ["2'", "6'", "7'-9\""], ["500mm", "2m", "2.5m"]


@dataclass(frozen=True)
class Place:
    """The context of a node. `sort` is what a part of an expression has to be:
    rule       a question;             part        a rule in a neighbour, where `optional` may stand
    neighbour  what `symmetric` takes; by          what `distance ... by` takes
    number     a sum over the plan;    constant    a number that is the same for every plan
    figure     arithmetic over a tray; field       a field of lengths alone
    values     values of a field;      bound       a name that `some` or `every` binds
    variable   that of a condition"""
    scope: Scope
    metric: bool = False
    item: str = None                 # the word that an item begins with
    schema: str = None
    form: str = None                 # where the item is about houses
    sort: str = "rule"
    dimension: int = 0               # 0 a number, 1 a length, 2 an area, 3 a volume
    variable: str = "n"
    params: tuple = ()               # (name, "rule", "number" or a field's name) of the rule that this is in
    bound: tuple = ()                # (name, field) of quantifiers
    want: str = None                 # what a NAME is here
    text: str = None                 # the NAME itself
    field: object = None             # the field whose values are made
    cells: str = None                # in a specifier of houses: which kind of specifier
    test: str = None                 # what a test is of: rule, library, measure
    counts: str = None               # of a measure of houses: whether it counts parts of plans or of houses, which it cannot both
    around: bool = False             # whether a `where` says of which stretch what lies before and behind is counted
    argument: tuple = ()             # what the parameters of a call are
    several: bool = False            # whether the file has more than one schema
    longer: bool = False             # whether trays are of few kinds and plans longer: what repeats needs them
    before: tuple = None             # of a `let`: those that stand before it, so that few stand for one another in a circle

    def but(self, **changes):
        return replace(self, **changes)

    def fields(self, *kinds):
        return [f for f in self.scope.schemas.get(self.schema, []) if not kinds or f.kind in kinds]

    def about(self):
        return self.form or self.schema

    def rules(self, with_params):
        wanted = {self.schema, self.form} - {None}
        return [n for n, r in self.scope.rules.items() if r.about in wanted and bool(r.params) == with_params]

    def measures(self):
        wanted = {self.schema, self.form} - {None}
        return [n for n, m in self.scope.measures.items() if m.about in wanted and m.dimension == self.dimension]

    def lets(self):
        names = [n for n, (f, d) in self.scope.lets.items() if f is None and d == self.dimension]
        return names if self.before is None else [n for n in names if n in self.before]


# ---- which productions make which sorts; those that are not named make all

PARENTHESES = {"primary: OPEN expression CLOSE"}
QUESTIONS = {"rule", "part"}
LIMIT = {"limit"}           # of single trays: `only`, `forbid`
ONE_FIELD = {"field", "figure"}
SUMS = {"number", "constant"}
SORTS = {
    "expression: implied": QUESTIONS | LIMIT, "expression: qualified": QUESTIONS, "compared: nearness": QUESTIONS, "compared: EVERY nearness": QUESTIONS,
    "compared: additive MOD additive comparison additive": QUESTIONS, "disjunction: ors": QUESTIONS | LIMIT | {"values"}, "and: ands": QUESTIONS | LIMIT, "not: NOT not": QUESTIONS | LIMIT,
    "compared: comparable": QUESTIONS, "compared: comparable comparison additive": QUESTIONS,
    "compared: additive IN additive DOTS additive": QUESTIONS,
    "additive: additive PLUS term": SUMS, "additive: additive DASH term": SUMS, "term: term STAR signed": SUMS,
    "term: term SLASH signed": SUMS, "signed: DASH signed": SUMS,
    "primary: NAME": QUESTIONS | SUMS | {"values", "bound"}, "primary: NAME OPEN call_args CLOSE": QUESTIONS | {"number"},
    "primary: head_number": SUMS | {"values"}, "primary: TRAYS": {"number"}, "primary: OPEN expression CLOSE": QUESTIONS | LIMIT | SUMS,
    "primary: SUM OPEN tray_sum region CLOSE": {"number"}, "primary: SUM OPEN tray_sum OF expression region CLOSE": {"number"},
    "primary: BEGINNING": {"part"}, "primary: END": {"part"}, "primary: OPTIONAL OPEN expression CLOSE": {"part"},
    "primary: NEIGHBOUR OPEN parts CLOSE": QUESTIONS | {"neighbour"},
    "primary: QUANTITY OPEN expression region COMMA condition CLOSE": QUESTIONS | {"by"},
    "primary: SUM OPEN tray_sum region COMMA condition CLOSE": QUESTIONS | {"by"},
    "primary: SUM OPEN tray_sum OF expression region COMMA condition CLOSE": QUESTIONS | {"by"},
    "tray_sum: tray_sum PLUS tray_term": {"figure"}, "tray_sum: tray_sum DASH tray_term": {"figure"},
    "tray_term: tray_term STAR tray_signed": {"figure"}, "tray_term: tray_term SLASH tray_signed": {"figure"},
    "tray_signed: DASH tray_signed": {"figure"}, "tray_atom: head_number": {"figure"}, "tray_atom: OPEN tray_sum CLOSE": {"figure"},
    "tray_atom: MIN OPEN tray_sum COMMA tray_sum CLOSE": {"figure"}, "tray_atom: MAX OPEN tray_sum COMMA tray_sum CLOSE": {"figure"},
    "operand: NAME": {"variable", "constant"}, "operand: constant": {"constant"},
    "value: NAME doc role": {"choice", "order", "zone"}, "value: NAME OPEN depths CLOSE doc role": {"zone"}, "value: LENGTH doc role": {"length"},
    "field: field_head EQUAL values": {"length", "choice"}, "field: field_head EQUAL FLAG": {"flag"}, "field: field_head EQUAL ordered": {"order"},
    "field: zone field_head EQUAL values": {"zone"},
}
SORTS["primary: MATCHES OPEN expression CLOSE"] = {"number"}
EXTREMES = ["primary: extreme OPEN tray_sum CLOSE", "primary: extreme OPEN tray_sum OF expression CLOSE",
            "primary: extreme OPEN GAP FROM expression TO expression CLOSE", "primary: extreme OPEN GAP FROM expression TO expression BY NAME CLOSE"]
for extreme in EXTREMES:                                  # alone on a side: `alone` makes them
    SORTS[extreme] = set()
for word in ("QUANTITY", "OCCURRENCES"):
    SORTS[f"primary: {word} OPEN expression region CLOSE"] = {"number"}
for head in ("TRAY OPEN specifier CLOSE", "ANY", "SYMMETRIC primary", "MANY OPEN expression CLOSE", "PLAN OPEN_BRACKET pattern CLOSE_BRACKET",
             "OCCURRENCES OPEN expression region COMMA condition CLOSE", "SOME names IN NAME OPEN expression CLOSE",
             "EVERY names IN NAME OPEN expression CLOSE", "EVERY OPEN expression COMMA expression CLOSE",
             "DISTANCE OPEN FROM expression COMMA TO expression COMMA BY expression CLOSE"):
    SORTS["primary: " + head] = QUESTIONS
for head in ("TRAY OPEN specifier CLOSE", "ANY"):
    SORTS["primary: " + head] = QUESTIONS | LIMIT

# How often a production is chosen where that is not 1. What the grammar takes only in order to say better what is wrong with it is rare.
MISTAKE = .04
# What trays a schema of a library has is known once its plans are counted; and so which numbers stand in plans of it.
OF_LIBRARIES = ("item: schema NAME doc OF NAME OPEN_BRACE body CLOSE_BRACE", "field: field_head EQUAL BY_MEASURE NAME",
                "field: field_head EQUAL BY_RULE NAME", "literal_word: AREA", "literal_word: DECIMAL")

WEIGHTS = {
    **dict.fromkeys(OF_LIBRARIES, 0),
    "implied: implied IMPLIES disjunction": MISTAKE, "implied: implied WHERE disjunction": MISTAKE,
    "qualified: qualified WHERE disjunction": MISTAKE, "qualified: qualified IMPLIES disjunction": MISTAKE,
    "nearness: nearness BESIDE additive": .1, "nearness: nearness WITHIN additive OF additive": .15,
    "expression: qualified": .2, "compared: nearness": .15, "compared: EVERY nearness": .15, "region: BEFORE": .8, "region: AFTER": .8,
    "compared: additive MOD additive comparison additive": .15, "compared: comparable comparison additive": MISTAKE,
    "cond_atom: compare comparison operand": MISTAKE, "range: constant DASH constant": MISTAKE, "value: NUMBER doc role": MISTAKE,
    "primary: ANY": .4, "primary: BEGINNING": MISTAKE, "primary: END": MISTAKE,
    "doc: STRING": .15, "allow: ALLOW names": .1, "from: FROM NAME": .2, "role: ROLE NAME": .1,
    "expression: implied": .2, "disjunction: ors": .25, "and: ands": .25, "not: NOT not": .3, "compared: comparable": .3,
    "compared: additive IN additive DOTS additive": .2, "signed: DASH signed": .2, "primary: OPEN expression CLOSE": .3,
    "primary: TRAY OPEN specifier CLOSE": 3, "primary: NEIGHBOUR OPEN parts CLOSE": 2, "primary: NAME": .7,
    "primary: head_number": .3, "primary: TRAYS": .4, "additive: additive PLUS term": .3, "additive: additive DASH term": .2,
    "term: term STAR signed": .2, "term: term SLASH signed": .1, "tray_sum: tray_sum PLUS tray_term": .4, "tray_sum: tray_sum DASH tray_term": .4,
    "tray_term: tray_term STAR tray_signed": .5, "tray_term: tray_term SLASH tray_signed": .3, "primary: MATCHES OPEN expression CLOSE": 2, "primary: QUANTITY OPEN expression region CLOSE": 2,
    "primary: OCCURRENCES OPEN expression region CLOSE": 2, "primary: SUM OPEN tray_sum region COMMA condition CLOSE": 2,
    "primary: SUM OPEN tray_sum OF expression region COMMA condition CLOSE": 2, "primary: SUM OPEN tray_sum region CLOSE": 2, "primary: SUM OPEN tray_sum OF expression region CLOSE": 2,
    "primary: OPTIONAL OPEN expression CLOSE": .5, "tray_atom: NAME": 4, "tray_signed: DASH tray_signed": .1,
    "tray_atom: OPEN tray_sum CLOSE": .3, "tray_atom: head_number": .4, "cond_not: NOT cond_not": .2, "condition: cond_ors": .2,
    "cond_and: cond_ands": .3, "cond_atom: OPEN condition CLOSE": .2, "cond_atom: compare": 3,
    "constant: DASH NUMBER": .15, "constant: DASH LENGTH": .05, "constant: DASH AREA": .2, "constant: DASH DECIMAL": .2,
    "range: constant": .3, "part: ELLIPSIS": .2, "item: use STRING": 2, "pattern_tray: spec_items": 2,
    "any_case: todo_word case": .3, "item: param NAME doc EQUAL additive IN additive DOTS additive": .2, "literal_word: ABSENT": .2, "literal_word: OF_DEPTH": MISTAKE, "value: ELLIPSIS": MISTAKE,
    "specifier: %empty": .05, "plan: OPEN_BRACKET HOUSE CLOSE_BRACKET": MISTAKE, "clause: require_word requires": 3, "clause: prune_word prunes": 3,
    "call_arg: additive DOTS additive": MISTAKE, "call_arg: additive DOTS": MISTAKE, "primary: NAME OPEN call_args CLOSE": 1.5,
    "clause: allow_word names": .2, "clause: weight_word expression positive": .5, "clause: prefer_word preferences": .6, "preferences: preferences COMMA preference": .5, "clause: weight_word expression": MISTAKE, "positive: LENGTH": .1, "positive: AREA": .1, "clause: trays_word range": MISTAKE, "clause_name: CLAUSE_NAME": .5,
    "prunes: prunes COMMA prune": .5, "requires: requires COMMA require": .5,
    "case: expectations plan STRING BY clause_names": .3, "case: expectations plan BY clause_names doc": .3,
}
BY_DIMENSION = {"constant: NUMBER": 0, "constant: DECIMAL": 0, "constant: LENGTH": 1, "constant: AREA": 2,
                "head_number: NUMBER": 0, "head_number: DECIMAL": 0, "head_number: LENGTH": 1, "head_number: AREA": 2,
                "constant: DASH NUMBER": 0, "constant: DASH DECIMAL": 0, "constant: DASH LENGTH": 1, "constant: DASH AREA": 2,
                "primary: TRAYS": 0, "primary: MATCHES OPEN expression CLOSE": 0, "primary: QUANTITY OPEN expression region CLOSE": 0,
                "primary: OCCURRENCES OPEN expression region CLOSE": 0}


# ---- what the parts of a production are

def same_dimension(*places):
    """Sums that are compared or added are of one kind."""
    def contexts(maker, place):
        dimension = place.dimension if place.sort in ("number", "constant", "figure") else maker.random.choices([0, 1, 2], [5, 4, 1])[0]
        sort = place.sort if place.sort in ("constant", "figure") else "number"
        if place.bound and place.sort in QUESTIONS and maker.chance(.5):
            name = maker.random.choice(place.bound)
            return {i: place.but(sort="bound", text=None, field=field_named(place, name[1])) for i in places}
        made = {i: place.but(sort=sort, dimension=dimension) for i in places}
        if sort == "number" and not place.form and maker.chance(.2):
            made.update({i: place.but(sort="constant", dimension=dimension) for i in places[1:]})
            made[places[0]] = place.but(sort="number", dimension=dimension, want="alone")
        return made
    return contexts


def product(maker, place):
    sides = [place, place.but(dimension=0, sort="figure" if place.sort == "figure" else "constant")]
    if place.sort == "figure" and place.dimension > 1:
        sides = [place.but(dimension=place.dimension - 1), place.but(dimension=1)]
    maker.random.shuffle(sides)
    return {0: sides[0], 2: sides[1]}


def quotient(maker, place):
    by_length = maker.chance(.2) and place.dimension < 2
    over = place.but(dimension=int(by_length), sort="constant" if place.sort != "figure" else "figure", want="divisor")
    return {0: place.but(dimension=place.dimension + by_length), 2: over}


def counted(*conditions, dimension=0):
    def contexts(maker, place):
        made = place.but(sort="variable", dimension=dimension, variable=maker.random.choice(["n", "w", "count"]))
        return {i: made for i in conditions}
    return contexts


def condition_sides(*sorts):
    def contexts(maker, place):
        return {i: place.but(sort=sort) for i, sort in sorts}
    return contexts


def comparison_sides(maker, place):
    sorts = ["variable", "constant"]
    if maker.chance(.2):
        sorts.reverse()
    return {0: place.but(sort=sorts[0]), 2: place.but(sort=sorts[1])}


def summed(maker, place):
    return {2: place.but(sort="figure", want="figure")}


def asked_sum(index):
    def contexts(maker, place):
        area = place.form is not None
        made = {2: place.but(sort="field", dimension=2 if area else 1, want="area" if area else "figure")}
        made.update(counted(index, dimension=2 if area else 1)(maker, place))
        return made
    return contexts


def near(distance=None, *parts):
    """Two questions, and how far apart: a number of trays, or a length where trays have one."""
    def contexts(maker, place):
        lengths = bool(place.fields("length"))
        made = {i: place.but(sort="rule", around=False) for i in parts}
        if distance is not None:
            made[distance] = place.but(sort="constant", dimension=int(lengths and maker.chance(.4)))
        return made
    return contexts


def divided_sum(maker, place):
    return {0: place.but(sort="number", dimension=0), 2: place.but(sort="constant", dimension=0, want="divisor"),
            3: place.but(want="equal"), 4: place.but(sort="constant", dimension=0, want="rest")}


def own_call(maker, place):
    """`values` of a field, or `mirrored` of some: what the language has itself."""
    number = place.sort == "number"
    fields = maker.random.sample(place.fields("length", "choice", "order", "flag", "zone"), 1)
    if not number and maker.chance(.3):
        fields += maker.random.sample(place.fields("length", "choice", "order", "flag", "zone"), 1)
    return {0: place.but(want="exact", text="values" if number else "mirrored"), 2: place.but(argument=tuple(f"field {f.name}" for f in fields))}


def repeated(maker, place):
    """So many side by side; in a neighbour also none."""
    least = int(place.sort != "part" or maker.chance(.5)) if not maker.chance(MISTAKE) else 0
    return {0: place.but(want="exact", text="repeat"), 2: place.but(argument=("rule", f"times {least}"))}


def quantified(maker, place):
    fields = place.fields("length", "choice")
    if not fields:
        return {}
    field = maker.random.choice(fields)
    names = [maker.random.choice("uvw") + str(len(place.bound))]
    bound = place.bound + tuple((n, field.name) for n in names)
    return {1: place.but(want="exact", text=names[0]), 3: place.but(want="exact", text=field.name), 5: place.but(bound=bound, sort="rule")}


def call(maker, place):
    if place.want == "repeat":
        return repeated(maker, place.but(want=None))
    if place.sort in QUESTIONS and maker.chance(.2 if place.form else .55):
        return repeated(maker, place)
    own = place.fields("length", "choice", "order", "flag", "zone") and (place.sort == "number" or maker.chance(.4) or not place.rules(True))
    if own:
        return own_call(maker, place)
    if not place.rules(True):
        return {}
    name = maker.random.choice(place.rules(True))
    params = tuple(kind for _, kind in place.scope.rules[name].params)
    return {0: place.but(want="exact", text=name), 2: place.but(argument=params)}


def head(word, **changes):
    """The name that an item declares."""
    return lambda maker, place: {1: place.but(want="exact", text=place.scope.fresh(maker.random, word))}


CONTEXTS = {
    "comparable: additive comparison additive": same_dimension(0, 2),
    "compared: comparable comparison additive": same_dimension(0, 2),
    "compared: additive MOD additive comparison additive": divided_sum,
    "qualified: disjunction WHERE disjunction": lambda maker, place: {0: place.but(around=False), 2: place.but(around=True)},
    "nearness: additive BESIDE additive": near(None, 0, 2), "nearness: additive WITHIN additive OF additive": near(2, 0, 4),
    "nearness: additive AT LEAST additive FROM EVERY additive": near(3, 0, 6),
    "nearness: nearness BESIDE additive": near(None, 0, 2), "nearness: nearness WITHIN additive OF additive": near(2, 0, 4),
    "compared: additive IN additive DOTS additive": same_dimension(0, 2, 4),
    "additive: additive PLUS term": same_dimension(0, 2), "additive: additive DASH term": same_dimension(0, 2),
    "term: term STAR signed": product, "term: term SLASH signed": quotient,
    "tray_sum: tray_sum PLUS tray_term": same_dimension(0, 2), "tray_sum: tray_sum DASH tray_term": same_dimension(0, 2),
    "tray_term: tray_term STAR tray_signed": product, "tray_term: tray_term SLASH tray_signed": quotient,
    "primary: QUANTITY OPEN expression region COMMA condition CLOSE": counted(5),
    "primary: OCCURRENCES OPEN expression region COMMA condition CLOSE": counted(5),
    "primary: SUM OPEN tray_sum region CLOSE": summed, "primary: SUM OPEN tray_sum OF expression region CLOSE": summed,
    "primary: SUM OPEN tray_sum region COMMA condition CLOSE": asked_sum(5),
    "primary: SUM OPEN tray_sum OF expression region COMMA condition CLOSE": asked_sum(7),
    "primary: extreme OPEN tray_sum CLOSE": summed, "primary: extreme OPEN tray_sum OF expression CLOSE": summed,
    "primary: extreme OPEN GAP FROM expression TO expression BY NAME CLOSE": lambda maker, place: {8: place.but(want="measured")},
    "primary: SYMMETRIC primary": lambda maker, place: {1: place.but(sort="neighbour")},
    "primary: DISTANCE OPEN FROM expression COMMA TO expression COMMA BY expression CLOSE":
        lambda maker, place: {9: place.but(sort="by")},
    "primary: SOME names IN NAME OPEN expression CLOSE": quantified, "primary: EVERY names IN NAME OPEN expression CLOSE": quantified,
    "primary: NAME OPEN call_args CLOSE": call,
    "compare: operand comparison operand": comparison_sides,
    "cond_atom: compare comparison operand": condition_sides((2, "constant")),
    "cond_atom: operand IN range": condition_sides((0, "variable"), (2, "constant")),
    "cond_atom: operand MOD constant comparison operand": condition_sides((0, "variable"), (2, "divisor"), (4, "constant")),
    "tray_atom: NAME NAME": lambda maker, place: {0: place.but(want="zone"), 1: place.but(want="exact", text="depth")},
    "forbid: forbid_word expression": lambda maker, place: {1: place.but(sort="limit")},
    "forbid: only_word expression": lambda maker, place: {1: place.but(sort="limit")},
    "number_case: tray_sum": lambda maker, place: {0: place.but(sort="figure", want="figure")},
    "number_case: tray_sum WHERE TRAY OPEN specifier CLOSE": lambda maker, place: {0: place.but(sort="figure", want="figure")},
    "total_field: NAME": lambda maker, place: {0: place.but(want="measured")},
    "total_field: NAME NAME": lambda maker, place: {0: place.but(want="zone"), 1: place.but(want="exact", text="depth")},
    "prune: expression AS NAME doc": lambda maker, place: {2: place.but(want="exact", text=place.scope.fresh(maker.random, "clause"))},
    "clause: generate_word require": lambda maker, place: {1: place.but(want="generate")},
    "clause: weight_word expression positive": lambda maker, place: {2: place.but(want="positive", dimension=0)},
    "worth: WORTH positive": lambda maker, place: {1: place.but(want="positive", dimension=0)},
    "preference: expression worth AS NAME doc": lambda maker, place: {3: place.but(want="exact", text=place.scope.fresh(maker.random, "liked"))},
    "allow: ALLOW names": lambda maker, place: {1: place.but(want="code")},
    "clause: allow_word names": lambda maker, place: {1: place.but(want="code")},
    "clause: trays_word range": lambda maker, place: {1: place.but(sort="constant", dimension=0, want="trays")},
    "clause: total_word total_field range doc": lambda maker, place: {2: place.but(sort="constant", dimension=1, want="total")},
    "clause: total_word total_field comparison constant doc":
        lambda maker, place: {3: place.but(sort="constant", dimension=1, want="total")},
    "item: schema NAME doc from OPEN_BRACE body CLOSE_BRACE": head("s"),
    "item: param NAME doc EQUAL additive": lambda maker, place: {**head("lot")(maker, place), 4: place.but(sort="constant")},
    "item: param NAME doc EQUAL additive IN additive DOTS additive":
        lambda maker, place: {**head("lot")(maker, place), **{i: place.but(sort="constant") for i in (4, 6, 8)}},
    "item: param NAME doc EQUAL param_words": head("side"),
    "item: let NAME EQUAL expression": head("const"), "item: measure NAME doc using EQUAL additive": head("m"),
    "rule_head: rule NAME params doc using allow": head("r"), "library_head: library NAME doc using": head("l"),
    "library_head: library NAME doc using FROM NAME":
        lambda maker, place: {**head("l")(maker, place), 3: place.but(want="using-schema"), 5: place.but(want="library")},
    "library_head: library NAME doc using FROM NAME ONTO NAME":
        lambda maker, place: {**head("l")(maker, place), 3: place.but(want="using-schema"), 5: place.but(want="library"), 7: place.but(want="exact", text=place.schema)},
    "library_head: library NAME doc using FROM NAME IN NAME":
        lambda maker, place: {**head("h")(maker, place), 3: place.but(want="using-schema"), 5: place.but(want="plans"),
                              7: place.but(want="exact", text=place.form)},
    "form_head: form NAME doc OF NAME": lambda maker, place: {**head("f")(maker, place), 4: place.but(want="exact", text=place.schema)},
    "item: test names with OPEN_BRACE cases CLOSE_BRACE": lambda maker, place: {1: place.but(want="tested")},
    "case: value_word plan EQUAL additive doc": lambda maker, place: {3: place.but(sort="constant")},
    "role: ROLE NAME": lambda maker, place: {1: place.but(want="role")},
    "number_item: number_word field_head EQUAL number_cases": lambda maker, place: {1: place.but(sort="figure")},
}


ROLES = {"length": ["length", "level"], "flag": ["public-end", "great-hall"], "choice": ["text", "tone", "hatch"], "order": ["text", "level", "tone"], "zone": ["band"],
         "fill": ["solid", "void", "absent"]}


def field_named(place, name):
    return next(f for f in place.fields() if f.name == name)


# ---- names and constants

def pick(place, maker, names, otherwise="nothing"):
    return maker.random.choice(names) if names else otherwise


def operand_name(maker, place):
    numbers = [n for n, kind in place.params if kind == "number"]
    return pick(place, maker, numbers) if place.sort == "constant" and numbers else place.variable


def expression_name(maker, place):
    if place.sort == "bound":
        return pick(place, maker, [n for n, f in place.bound if f == place.field.name])
    if place.sort == "values":
        return pick(place, maker, place.field.values if place.field else [])
    if place.sort in QUESTIONS:
        params = [n for n, kind in place.params if kind == "rule"]
        return pick(place, maker, params if params and maker.chance(.8) else place.rules(False))
    return pick(place, maker, place.lets() if place.sort == "constant" else place.lets() + place.measures())


def figure_name(maker, place):
    if place.want == "area":
        return pick(place, maker, ["cost"] if place.dimension == 0 else ["area"])
    return pick(place, maker, [f.name for f in place.fields(*(("number", "order") if place.dimension == 0 else ("length", "zone")))])


NAMED = {
    "exact": lambda maker, place: place.text or "nothing",
    "code": lambda maker, place: maker.random.choice(CODES),
    "role": lambda maker, place: maker.random.choice(ROLES[place.sort]),
    "zone": lambda maker, place: pick(place, maker, [f.name for f in place.fields("zone")]),
    "measured": lambda maker, place: pick(place, maker, [f.name for f in place.fields("length", "zone")]),
    "library": lambda maker, place: pick(place, maker, [n for n, l in place.scope.libraries.items() if (l.schema, l.form) == (place.schema, place.form)]),
    "plans": lambda maker, place: pick(place, maker, [n for n, l in place.scope.libraries.items() if (l.schema, l.form) == (place.schema, None)]),
    "tested": lambda maker, place: tested(maker, place),
}


def tested(maker, place):
    names = {"rule": place.rules(False), "library": list(place.scope.libraries), "measure": place.measures()}[place.test or "rule"]
    return pick(place, maker, names)


def name(maker, place):
    if place.want in NAMED:
        return NAMED[place.want](maker, place)
    if place.sort in ("figure", "field"):
        return figure_name(maker, place)
    if place.sort in ("variable", "constant") and place.want == "operand":
        return operand_name(maker, place)
    return expression_name(maker, place)


def number(maker, place):
    if place.want == "positive" and not maker.chance(MISTAKE):
        return str(maker.random.choice([1, 2, 3, 7]))
    if place.want == "rest":
        return str(maker.random.randint(0, 1))
    if place.sort == "divisor" or place.want == "divisor":
        return str(maker.random.randint(2, 4))
    return str(maker.random.choice([0, 1, 1, 2, 2, 3, 7]))


def length(maker, place):
    if place.want == "total":
        return maker.random.choice(["6m", "2.4m", "10m"] if place.metric else ["12'", "20'", "8'6\""])
    own = [v for f in place.fields("length") for v in f.values] if place.scope else []
    return maker.random.choice(own + (METRES if place.metric else FEET))


TOKENS = {
    "NAME": name, "NUMBER": number, "LENGTH": length,
    "AREA": lambda maker, place: maker.random.choice(["6m2", "20m2", "3.5m2"] if place.metric else ["48sf", "100sf", "12ft2"]) if place.dimension < 3
        else maker.random.choice(["3m3", "40m3"] if place.metric else ["100cf", "3cf"]),
    "DECIMAL": lambda maker, place: maker.random.choice(["0.5", "1.25", "40%"]),
    "STRING": lambda maker, place: maker.random.choice(DOCS),
    "FIELD_NAME": lambda maker, place: place.text or "width",
    "CLAUSE_NAME": lambda maker, place: maker.random.choice(["require@2", "prune@3", "generate@4"]),
    "HOUSE": lambda maker, place: "- ; -",
}


# ---- parts that are made of what is declared

def alone(maker, depth, place):
    """A quotient of two sums, or the greatest or least of some numbers: what stands on a side by itself."""
    if place.want != "alone":
        return None
    inner = place.but(want=None)
    if place.dimension > 1 or maker.chance(.4):
        by = inner.but(dimension=maker.random.choice([0, 0, 1]))
        made = maker.node("term: term SLASH signed", maker.make("term", depth - 1, inner.but(dimension=min(place.dimension + by.dimension, 3))),
                          maker.make("signed", depth - 1, by))
        return maker.node("additive: term", made)
    fitting = [e for e in EXTREMES if fits_extreme(e, place)]
    if not fitting:
        return None
    primary = maker.make_of(maker.random.choice(fitting), max(depth, 2), inner)
    return maker.node("additive: term", maker.node("term: signed", maker.node("signed: primary", primary)))


def fits_extreme(production, place):
    if "GAP" in production:
        return place.dimension == (1 if "BY" in production else 0) and (place.dimension == 0 or place.fields("length", "zone"))
    return AVAILABLE["tray_atom: NAME"](place)


def small_question(maker, depth, place):
    """Where no depth is left: mostly a tray, which says more than `any` and is as short."""
    if depth > 0 or place.sort not in QUESTIONS or maker.chance(.3):
        return None
    leaves = [leaf for leaf in HOUSE_LEAVES + WALKS if AVAILABLE[leaf](place)]
    if not leaves or place.counts != "houses" and maker.chance(.15):
        leaves = ["primary: TRAY OPEN specifier CLOSE"]
    return maker.make_of(maker.random.choice(leaves), 1, place)


def neighbour_parts(maker, depth, place):
    """`beginning` only as the first part, `end` only as the last."""
    count = maker.random.choice([1, 2, 2, 3])
    parts = [maker.make("part", depth - 1, place.but(sort="part" if count > 1 else "rule")) for _ in range(count)]
    ends = [as_part(maker, maker.node(f"primary: {word}")) for word in ("BEGINNING", "END")]
    parts = [ends[0]] * maker.chance(.15) + parts + [ends[1]] * maker.chance(.15)
    return listed(maker.grammar, "parts", parts)


def as_part(maker, primary):
    node = primary
    for production in reversed(maker.grammar.chain("part", "primary")):
        node = Node(production.head, production, [node])
    return node


def arguments(maker, depth, place):
    """One for each parameter, of its kind."""
    made = [argument(maker, depth - 1, place.but(argument=()), kind) for kind in place.argument]
    return listed(maker.grammar, "call_args", [wrapped(maker.grammar, "call_arg", node) for node in made]) if made else None


def argument(maker, depth, place, kind):
    if kind.startswith("field "):
        node = maker.node("primary: NAME", maker.word("NAME", kind[6:]))
        for production in reversed(maker.grammar.chain("expression", "primary")):
            node = Node(production.head, production, [node])
        return node
    if kind.startswith("times "):
        return times(maker, place.but(sort="constant", dimension=0), int(kind[6:]))
    if kind == "rule":
        return maker.make("expression", depth, place.but(sort="rule"))
    if kind == "number":
        return maker.make("expression", 0, place.but(sort="constant", dimension=0))
    fields = [f for f in place.fields("length", "choice") if f.name == kind]
    return maker.make("expression", 1, place.but(sort="values", dimension=1, field=fields[0] if fields else None))


def times(maker, place, least):
    """How often something is repeated: a number, from one to another, or that and more."""
    low = maker.random.choice([least, least, least + 1, least + 2])
    high = max(low, 1) + maker.random.choice([0, 1, 1, 2])
    way = maker.random.choice(["exactly", "range", "range", "range", "and more", "and more"])
    if way == "exactly":
        return often(maker, place, max(low, 1))
    if way == "range":
        return maker.node("call_arg: additive DOTS additive", often(maker, place, low), often(maker, place, high))
    return maker.node("call_arg: additive DOTS", often(maker, place, low))


def often(maker, place, number):
    """The number; now and then a name that stands for one, or a sum."""
    names = [n for n, kind in place.params if kind == "number"]
    if names and maker.chance(.4):
        return wrapped(maker.grammar, "additive", maker.node("primary: NAME", maker.word("NAME", maker.random.choice(names))))
    if maker.chance(.3 if place.lets() else .1):
        return maker.make("additive", 1, place)
    return constant(maker, place, str(number))


def required(maker, depth, place):
    """What plans are made of: a rule that uses itself, or what is repeated, so that many are."""
    if place.want != "generate":
        return None
    inner = place.but(want=None, sort="rule")
    names = [n for n in place.rules(False) if place.scope.rules[n].circle]
    if names and maker.chance(.6):
        expression = wrapped(maker.grammar, "expression", maker.node("primary: NAME", maker.word("NAME", maker.random.choice(names))))
    elif maker.chance(.5):
        made = maker.by_production(maker.grammar.production("primary: NAME OPEN call_args CLOSE"), max(depth, 2), inner.but(argument=(), want="repeat"))
        expression = wrapped(maker.grammar, "expression", made)
    else:
        expression = maker.make("expression", max(depth, 2), inner)
    return maker.node("require: expression doc", expression, maker.make("doc", 1, inner))


def body(maker, depth, place):
    """One or more fields, then what is about them: numbers of a tray and trays that do not exist."""
    older = place.text and place.scope.schemas[place.text]
    fields = [field(maker, place.but(field=f)) for f in new_fields(maker, place, older)]
    scratch = Scope()
    scratch.__dict__.update(place.scope.__dict__)
    scratch.schemas = dict(place.scope.schemas)
    inside = place.but(scope=scratch, schema="being made", want=None, text=None)
    list_so_far = listed(maker.grammar, "body", fields)
    scratch.schemas["being made"] = merged(older or [], body_fields(list_so_far))
    more = []
    share = .2 if place.item == "schema of houses" else 1        # a file about houses is about other things
    if maker.chance(.5 * share):
        more.append(maker.make("number_item", 3, inside.but(text=place.scope.fresh(maker.random, "beds"), sort="figure", want="figure")))
    for _ in range(maker.random.choice([0, 0, 0, 1, 1, 2]) if maker.chance(share) else 0):
        more.append(maker.make("forbid", 4, inside))
    return listed(maker.grammar, "body", fields + more)


def new_fields(maker, place, older):
    random, taken = maker.random, {f.name for f in older or []}
    if place.item == "schema of houses":
        return house_fields(maker, place)
    kinds = random.choice([["length"], ["length", "flag"], ["length", "choice"], ["length", "zone"], ["length", "zone", "flag"], ["choice", "zone"],
                           ["length", "choice", "flag"], ["length", "order"], ["order", "flag"]])
    if place.longer and not older:
        kinds = random.choice([["length"], ["choice"], ["order"], ["flag"], ["length"], ["choice"], ["length", "flag"]])
    names = {"length": "width", "flag": "open", "choice": "colour", "order": "height", "zone": "yard"}
    made = [Field(f.name, f.kind, f.values) for f in older or [] if f.kind in ("choice", "order", "zone", "length") and maker.chance(.4)][:1]
    for kind in kinds if not older else random.sample(kinds, int(not made or maker.chance(.5))):
        name = names[kind]
        made.append(Field(name if name not in taken else name + "2", kind, []))
    return made


def house_fields(maker, place):
    return [Field("width", "length", []), *([Field("open", "flag", [])] if maker.chance(.3) else []), Field("rear", "zone", []), Field("main", "zone", [])]


def number_cases(maker, depth, place):
    """The last case is that of all other trays."""
    asked = [maker.make_of("number_case: tray_sum WHERE TRAY OPEN specifier CLOSE", 2, place) for _ in range(maker.random.choice([0, 1, 1, 2]))]
    return listed(maker.grammar, "number_cases", asked + [maker.make_of("number_case: tray_sum", 1, place)])


def field(maker, place):
    """A field of the kind that its place says, with different values."""
    random, made = maker.random, place.field
    own = place.but(sort=made.kind, text=made.name, want=None)
    name_node = maker.make_of("field_head: FIELD_NAME doc role", 1, own)
    if made.kind == "flag":
        return maker.node("field: field_head EQUAL FLAG", name_node)
    new = [text for text in chosen_values(maker, place, made) if text not in made.values and (made.kind != "zone" or text[0] not in dict(made.values))]
    before = [maker.node("value: ELLIPSIS")] if made.values else []
    every = before + [value(maker, place, made.kind, text) for text in new]
    if made.kind == "order":
        return maker.node("field: field_head EQUAL ordered", name_node, in_order(maker, every))
    values = listed(maker.grammar, "values", every)
    if made.kind == "zone":
        return maker.node("field: zone field_head EQUAL values", maker.make("zone", 1, own), name_node, values)
    return maker.node("field: field_head EQUAL values", name_node, values)


def in_order(maker, values):
    """From the least to the greatest; now and then with a sign that does not go with the others."""
    mixed = len(values) > 2 and maker.chance(.12)
    if mixed and maker.chance(.5):
        first = listed(maker.grammar, "values", values[:1])
        return maker.node("ordered: values BAR value LESS value", first, values[1], values[2])
    node = maker.node("ordered: value LESS value", values[0], values[1])
    for more in values[2:]:
        node = maker.node(f"ordered: ordered {'BAR' if mixed else 'LESS'} value", node, more)
    return node


def chosen_values(maker, place, made):
    random = maker.random
    if made.kind == "length":
        few = [1, 1, 1, 2] if place.item == "schema of houses" else [2, 2, 3] if place.longer else [1, 2, 2, 3]
        return random.sample(METRES if place.metric else FEET, random.choice(few))
    if made.kind == "choice":
        return random.sample(NAMES, random.choice([2, 2, 3]))
    if made.kind == "order":
        return ["attic"] if made.values else ["low", "middle", "high"][:random.choice([2, 3])]
    depths = DEPTHS_METRES if place.metric else DEPTHS_FEET
    if made.values:
        return [("wet", [depths[1]])]
    if place.item == "schema of houses":
        fills = house_fills(random, place, made.name)
    else:
        fills = [("full", random.sample(depths, random.choice([1, 1, 2]))), ("none", [])] + [("half", [depths[0]])] * maker.chance(.2)
    random.shuffle(fills)
    return fills


def house_fills(random, place, name):
    """Every tray has a main zone; most have another."""
    depths = ["2m", "2.5m", "3m", "4m"] if place.metric else ["6'", "7'-9\"", "9'6\"", "12'6\""]
    if name == "main":
        return [("full", [random.choice(depths)]), ("half", [depths[2]])][:random.choice([1, 1, 2])]
    rear = [("full", [depths[0]]), ("half", ["500mm" if place.metric else "2'"] if random.random() < .1 else [depths[1]]), ("none", [])]
    return random.sample(rear, random.choice([1, 1, 2, 2, 3]))


def value(maker, place, kind, text):
    plain = place.but(sort="fill" if kind == "zone" else "value", want=None)
    doc, role = maker.make("doc", 1, plain), maker.make("role", 1, plain)
    if kind == "length":
        return maker.node("value: LENGTH doc role", maker.word("LENGTH", text), doc, role)
    name, depths = (text, []) if kind in ("choice", "order") else text
    if not depths:
        return maker.node("value: NAME doc role", maker.word("NAME", name), doc, role)
    listed_depths = listed(maker.grammar, "depths", [maker.node("spec_word: LENGTH", maker.word("LENGTH", d)) for d in depths])
    return maker.node("value: NAME OPEN depths CLOSE doc role", maker.word("NAME", name), listed_depths, doc, role)


def clauses(maker, depth, place):
    """Every library of plans says first how many trays its plans have."""
    counts = [0, 0, 0, 1] if place.item == "plans of houses" else [0, 1, 1, 1, 1, 1, 1, 2] if place.form else [0, 1, 1, 2]
    made = [maker.make("clause", depth, place) for _ in range(maker.random.choice(counts))]
    if place.longer and place.text not in ("from", "onto") and maker.chance(.5):
        made.append(maker.make_of("clause: generate_word require", 2, place))
    if not place.form and place.text not in ("from", "onto"):
        made.insert(0, maker.make_of("clause: trays_word range", 3, place))
    return listed(maker.grammar, "clauses", made)


def trays_range(maker, depth, place):
    if place.want != "trays":
        return None
    low = maker.random.choice([0, 1, 1, 1, 2])
    high = max(low, maker.random.choice([1, 2, 2, 2, 3] if place.item == "plans of houses" else [1, 2, 2, 3]))
    if place.longer:
        low, high = maker.random.choice([0, 1, 1, 2, 3]), maker.random.choice([3, 4, 4, 5, 6])
    number_node = lambda n: maker.node("constant: NUMBER", maker.word("NUMBER", str(n)))
    if low == high:
        return maker.node("range: constant", number_node(low))
    return maker.node("range: constant DOTS constant", number_node(low), number_node(high))


def params(maker, depth, place):
    if not place.params:
        return maker.node("params: %empty")
    names = listed(maker.grammar, "names", [maker.word("NAME", n) for n, _ in place.params])
    return maker.node("params: OPEN names CLOSE", names)


def using(maker, depth, place):
    about = place.schema if place.want == "using-schema" else place.about()
    needed = place.several or bool(place.form)
    if place.want == "using-schema" and not maker.chance(.1) or not (needed or maker.chance(.2)):
        return maker.node("using: %empty")
    return maker.node("using: USING NAME", maker.word("NAME", about))


def older(maker, depth, place):
    return maker.node("from: FROM NAME", maker.word("NAME", place.text)) if place.text else maker.node("from: %empty")


SIDES = ["left", "right", "lime"]                # one of which may be a value of a field, too


def constant(maker, place, text):
    """The text as a sum."""
    token = {0: "NUMBER", 1: "LENGTH", 2: "AREA"}[place.dimension]
    return wrapped(maker.grammar, "additive", maker.node(f"head_number: {token}", maker.word(token, text)))


def constants(place):
    """Constants of the place's dimension, from the least to the greatest."""
    return [["0", "1", "2", "3", "7"], METRES if place.metric else ["3'", "4'", "5'", "8'6\"", "12'"],
            ["3.5m2", "6m2", "20m2"] if place.metric else ["12ft2", "48sf", "100sf"]][place.dimension]


def param_words(maker, depth, place):
    names = maker.random.sample(SIDES, maker.random.choice([2, 2, 3]))
    first, second, *more = [maker.word("NAME", n) for n in names]
    node = maker.node("param_words: NAME BAR NAME", first, second)
    for word in more:
        node = maker.node("param_words: param_words BAR NAME", node, word)
    return node


def side_question(maker, depth, place):
    """A param of words, compared with one of them."""
    sides = [n for n, p in place.scope.params.items() if p.words]
    if not sides or place.sort not in QUESTIONS or maker.chance(.5):
        return None
    side = maker.random.choice(sides)
    parts = [side, maker.random.choice(place.scope.params[side].words)]
    maker.random.shuffle(parts)
    one, other = (wrapped(maker.grammar, "additive", maker.node("primary: NAME", maker.word("NAME", n))) for n in parts)
    sign = maker.node("comparison: " + maker.random.choice(["EQUAL", "EQUAL", "UNEQUAL"]))
    return maker.node("comparable: additive comparison additive", one, sign, other)


def given(maker, place, name):
    """`NAME = VALUE` of a param."""
    param = place.scope.params[name]
    if param.words:
        value = wrapped(maker.grammar, "additive", maker.node("primary: NAME", maker.word("NAME", maker.random.choice(param.words))))
    else:
        of = place.but(dimension=min(param.dimension, 2))
        value = constant(maker, of, maker.random.choice(param.range or constants(of)))
    return maker.node("setting: NAME EQUAL additive", maker.word("NAME", name), value)


def settings(maker, depth, place):
    names = list(place.scope.params)
    if not names or maker.chance(.4):
        return maker.node("with: %empty")
    chosen = maker.random.sample(names, min(len(names), maker.random.choice([1, 1, 2])))
    return maker.node("with: WITH settings", listed(maker.grammar, "settings", [given(maker, place, n) for n in chosen]))


HOOKS = {"additive": alone, "comparable": side_question, "param_words": param_words, "with": settings, "primary": small_question, "parts": neighbour_parts, "call_args": arguments, "require": required, "body": body, "clauses": clauses, "range": trays_range, "number_cases": number_cases, "params": params,
         "using": using, "from": older, "spec_items": specifiers.items, "literal_tray": specifiers.literal_tray}


# No houses of all plans are counted by walks, and so no file of these kinds asks for them (plan_kinds.py).
WALKED = ["primary: walk OPEN cells COMMA TO walk_end " + more + "CLOSE" for more in (
    "walk_by ", "COMMA THROUGH cells walk_by ", "COMMA BY or_names COMMA THROUGH cells ")] + ["primary: EXITS OPEN cells CLOSE"]


class Plans(Notation):
    start = "items"
    indents = {"item": 0, "clause": 2, "form_clause": 2, "field": 2, "forbid": 2, "number_item": 2, "any_case": 2, "tile_part": 4, "CLOSE_BRACE": 0}
    depths = {"condition": 3, "part": 1, "cells": 3, "options": 4, "option_items": 1, "by_kinds": 1, "material_where": 3, "opening_parts": 3,
              "tile_parts": 5, "reaches": 3, "cases": 4, "trays": 2, "pattern": 2, "specifier": 1}
    remade = ("primary", "not", "expression", "condition", "tray_sum", "additive", "spec_item", "specifier", "pattern", "call_args", "clause", "any_case",
              "range", "cells", "options", "option_items", "kinds", "tile_part", "number_item", "forbid", "number_case", "doc", "role", "let")
    hooks = HOOKS
    never = WALKED

    def weight(self, production, place):
        if production.name in self.never:
            return 0
        allowed = SORTS.get(production.name)
        if allowed is not None and place.sort not in allowed and not (production.head == "value" and place.sort == "rule"):
            return 0
        if production.head in ("head_number", "constant") and BY_DIMENSION.get(production.name, place.dimension) != min(place.dimension, 2):
            return 0
        if production.name.startswith("primary") and BY_DIMENSION.get(production.name, place.dimension) != place.dimension and place.sort == "number":
            return 0
        return self.available(production, place) * WEIGHTS.get(production.name, 1)

    def available(self, production, place):
        """0 where a production needs names that nothing has."""
        known = AVAILABLE.get(production.name)
        return 1 if known is None or known(place) else 0

    def contexts(self, maker, production, place):
        inner = place
        if len(production.symbols) > 1 and place.sort in ("part", "neighbour", "by"):
            inner = place.but(sort="rule")
        if production.name in ("operand: NAME",):
            inner = place.but(want="operand")
        made = [inner] * len(production.symbols)
        known = CONTEXTS.get(production.name)
        if known:
            for i, context in known(maker, place).items():
                made[i] = context
        if production.head == "primary" and production.name not in PARENTHESES:
            made = [c if s == "region" else c.but(around=False) for s, c in zip(production.symbols, made)]
        if place.sort == "number" and production.head == "primary" and production.name not in PARENTHESES:
            made = [c.but(sort="rule") if s == "expression" and c.sort == "number" else c for s, c in zip(production.symbols, made)]
        return made

    def token(self, maker, token, place):
        return TOKENS[token](maker, place)


def has_names(place):
    if place.sort == "bound":
        return any(f == place.field.name for _, f in place.bound)
    if place.sort == "values":
        return place.field and place.field.kind == "choice"
    if place.sort in QUESTIONS:
        return bool(place.rules(False)) or any(kind == "rule" for _, kind in place.params)
    return bool(place.lets() if place.sort == "constant" else place.lets() + place.measures())


AVAILABLE = {
    "primary: head_number": lambda place: place.sort != "values" or place.field and place.field.kind == "length",
    "primary: NAME": has_names,
    "role: ROLE NAME": lambda place: place.sort in ROLES,
    "primary: NAME OPEN call_args CLOSE":
        lambda place: place.dimension == 0 and not place.form and place.fields() if place.sort == "number" else place.rules(True) or not place.form,
    "region: BEFORE": lambda place: place.around, "region: AFTER": lambda place: place.around,
    "comparison: LESS": lambda place: place.want != "equal", "comparison: AT_MOST": lambda place: place.want != "equal",
    "comparison: AT_LEAST": lambda place: place.want != "equal", "comparison: GREATER": lambda place: place.want != "equal",
    "primary: SOME names IN NAME OPEN expression CLOSE": lambda place: place.fields("length", "choice") and len(place.bound) < 2,
    "primary: EVERY names IN NAME OPEN expression CLOSE": lambda place: place.fields("length", "choice") and len(place.bound) < 2,
    "tray_atom: NAME": lambda place: place.want == "area" or place.dimension < 2 and place.fields(*(("number", "order") if place.dimension == 0 else ("length", "zone"))),
    "tray_atom: NAME NAME": lambda place: place.dimension == 1 and place.fields("zone") and place.want != "area",
    "operand: NAME": lambda place: place.sort == "variable" or any(kind == "number" for _, kind in place.params),
    "total_field: NAME NAME": lambda place: place.fields("zone"),
    "case: value_word plan EQUAL additive doc": lambda place: place.test == "measure",
    "primary: SUM OPEN tray_sum region COMMA condition CLOSE": lambda place: place.form or place.fields("length", "zone"),
    "primary: SUM OPEN tray_sum OF expression region COMMA condition CLOSE": lambda place: place.form or place.fields("length", "zone"),
}
for expectations in ("plan doc", "plan STRING BY clause_names", "plan BY clause_names doc"):
    AVAILABLE["case: expectations " + expectations] = lambda place: place.test != "measure"
HOUSE_LEAVES = ["primary: " + leaf for leaf in (
    "CELL OPEN specifier CLOSE", "ROOM OPEN specifier CLOSE", "OPTION OPEN option_items CLOSE", "TOUCH OPEN cells COMMA cells by_kinds CLOSE",
    "APART OPEN cells COMMA FROM cells walk_by CLOSE", "APART OPEN cells COMMA FROM cells COMMA THROUGH cells walk_by CLOSE",
    "APART OPEN cells COMMA FROM cells COMMA BY or_names COMMA THROUGH cells CLOSE")]
WALKS = ["primary: APART OPEN cells COMMA FROM cells walk_by CLOSE"] * 3     # what is hardest to count: asked more often
for leaf in HOUSE_LEAVES:
    AVAILABLE[leaf] = lambda place: place.form and place.counts != "plans"
    SORTS[leaf] = QUESTIONS
for leaf in ("TRAY OPEN specifier CLOSE", "ANY", "SUM OPEN tray_sum region CLOSE", "MATCHES OPEN expression CLOSE", "OCCURRENCES OPEN expression region CLOSE",
             "PLAN OPEN_BRACKET pattern CLOSE_BRACKET"):
    AVAILABLE["primary: " + leaf] = lambda place: place.counts != "houses"
AVAILABLE["primary: SUM OPEN tray_sum OF expression region CLOSE"] = lambda place: place.counts != "houses" or place.dimension == 2
for clause in ("trays_word range", "total_word total_field range doc", "total_word total_field comparison constant doc", "weight_word expression",
               "weight_word expression positive", "prefer_word preferences", "generate_word require"):
    AVAILABLE["clause: " + clause] = lambda place: not place.form
for clause in ("trays_word range", "generate_word require"):             # a library that is projected says that already
    AVAILABLE["clause: " + clause] = lambda place: not place.form and place.text != "onto"


# ---- a file

def add(maker, items, production, depth, place):
    """One more item; what it declares can be used from then on."""
    item = maker.make_of(production, depth, place)
    place.scope.declare(item)
    items.append(item)
    return item


def random_params(maker, place):
    kinds = ["rule", "rule", "number"] + [f.name for f in place.fields("length", "choice")]
    return tuple((name, maker.random.choice(kinds)) for name in ["a", "b", "k"][:maker.random.choice([1, 2])])


def add_params(maker, items, place):
    random = maker.random
    if maker.chance(.25):
        of = place.but(item="param", dimension=random.choice([0, 0, 1, 1, 2]), sort="constant", before=tuple(place.scope.lets))
        known = constants(of)
        low, default, high = sorted(random.choices(range(len(known)), k=3))
        if maker.chance(.4):
            add(maker, items, "item: param NAME doc EQUAL additive", 1, of)
        else:
            made = maker.node("item: param NAME doc EQUAL additive IN additive DOTS additive", maker.make("param", 1, of),
                              maker.word("NAME", place.scope.fresh(random, "lot")), maker.make("doc", 1, of),
                              *(constant(maker, of, known[i]) for i in (default, low, high)))
            made = Node(made.symbol, made.production, made.children, context=of)
            place.scope.declare(made)
            items.append(made)
    if maker.chance(.25):
        add(maker, items, "item: param NAME doc EQUAL param_words", 1, place.but(item="param"))


def add_rules(maker, items, place, depths=(2, 3, 3, 4, 5)):
    random = maker.random
    rule = "item: rule_head EQUAL expression"
    if maker.chance(.3):
        before = None if maker.chance(.05) else tuple(place.scope.lets)
        let = place.but(item="let", before=before, dimension=random.choice([0, 1, 2]), sort="constant")
        add(maker, items, "item: let NAME EQUAL expression", 1, let)
    add_params(maker, items, place)
    if maker.chance(.2) and place.fields("length", "choice"):
        values = place.but(item="let", before=(), sort="values", dimension=1, field=random.choice(place.fields("length", "choice")))
        add(maker, items, "item: let NAME EQUAL expression", 2, values)
    if maker.chance(.4):
        with_params = place.but(item="rule", params=random_params(maker, place))
        add(maker, items, rule, random.choice([2, 3]), with_params)
    for _ in range(random.choice([1, 2, 3])):
        add(maker, items, rule, random.choice(depths), place.but(item="rule"))
    for _ in range(random.choice([1, 2])):
        counts = random.choice(["houses", "houses", "plans"]) if place.form else None
        dimension = random.choices([0, 2] if counts == "houses" else [0, 1, 2, 3], [5, 2] if counts == "houses" else [5, 3, 2, 1])[0]
        measure = place.but(item="measure", sort="number", counts=counts, dimension=dimension, want="alone" if not place.form and maker.chance(.4) else None)
        add(maker, items, "item: measure NAME doc using EQUAL additive", random.choice([4, 4, 5, 6]), measure)


def add_circle(maker, items, place):
    """Rules that use themselves and one another; what else stands in them knows none of them."""
    names = [place.scope.fresh(maker.random, "c") for _ in range(maker.random.choice([1, 1, 1, 2, 2, 3]))]
    leaf = lambda: maker.make("expression", maker.random.choice([0, 0, 0, 1, 2]), place.but(item="rule", sort="rule"))
    made = circles.bodies(maker, leaf, names)
    if maker.chance(.7):
        made.append((place.scope.fresh(maker.random, "whole"), circles.asked(maker, leaf, names)))
    for name, body in made:
        of = place.but(item="rule", want="exact", text=name)
        parts = [maker.make(symbol, 1, of) for symbol in maker.grammar.production("rule_head: rule NAME params doc using allow").symbols]
        head = Node("rule_head", maker.grammar.production("rule_head: rule NAME params doc using allow"), parts, context=of)
        items.append(maker.node("item: rule_head EQUAL expression", head, body))
    for name, _ in made:                                      # the last asks of them, and is as good to name
        place.scope.rules[name] = Rule(place.about(), circle=True)


LIBRARY = "item: library_head OPEN_BRACE clauses CLOSE_BRACE"


def library(maker, items, head, depth, place):
    made_head = maker.make_of(head, 2, place)
    made = maker.make("clauses", depth, place.but(text="from" if "FROM" in head else None))
    item = maker.node(LIBRARY, made_head, made)
    place.scope.declare(item)
    items.append(Node(item.symbol, item.production, item.children, context=place))


def library_for_newer(maker, items, name, place):
    """A library of plans of a newer schema, with the clauses of one of the older."""
    made_using = maker.node("using: USING NAME", maker.word("NAME", place.schema))
    head = maker.node("library_head: library NAME doc using FROM NAME", maker.make("library", 1, place),
                      maker.word("NAME", place.scope.fresh(maker.random, "l")), maker.make("doc", 1, place), made_using, maker.word("NAME", name))
    head = Node(head.symbol, head.production, head.children, context=place)
    item = maker.node(LIBRARY, head, maker.make("clauses", 2, place.but(text="from")))
    place.scope.declare(item)
    items.append(Node(item.symbol, item.production, item.children, context=place))


def library_onto(maker, items, name, place):
    """A library of plans of a newer schema, projected onto the schema at hand."""
    head = maker.node("library_head: library NAME doc using FROM NAME ONTO NAME", maker.make("library", 1, place),
                      maker.word("NAME", place.scope.fresh(maker.random, "bare")), maker.make("doc", 1, place), maker.node("using: %empty"),
                      maker.word("NAME", name), maker.word("NAME", place.schema))
    head = Node(head.symbol, head.production, head.children, context=place)
    item = maker.node(LIBRARY, head, maker.make("clauses", 2, place.but(text="onto")))
    place.scope.declare(item)
    items.append(Node(item.symbol, item.production, item.children, context=place))


def add_tests(maker, items, place):
    for kind in ("rule", "library", "measure"):
        of = place.but(item="test", test=kind)
        if maker.chance(.25) and tested(maker, of) != "nothing":
            add(maker, items, "item: test names with OPEN_BRACE cases CLOSE_BRACE", 4, of)


def make_file(maker):
    """The items of a file about plans."""
    scope, random, items = Scope(), maker.random, []
    place = Place(scope, metric=maker.chance(.3), several=maker.chance(.25), longer=maker.chance(.4))
    add(maker, items, "item: schema NAME doc from OPEN_BRACE body CLOSE_BRACE", 3, place.but(item="schema"))
    schemas = list(scope.schemas)
    first = place.but(schema=schemas[0])
    if maker.chance(.7 if place.longer else .1):
        add_circle(maker, items, first)
    add_rules(maker, items, first)
    library(maker, items, "library_head: library NAME doc using", random.choice([2, 3]), first.but(item="library"))
    if place.several:
        add(maker, items, "item: schema NAME doc from OPEN_BRACE body CLOSE_BRACE", 3, place.but(item="schema", text=schemas[0]))
        newer = place.but(schema=list(scope.schemas)[-1])
        add_rules(maker, items, newer)
        library(maker, items, "library_head: library NAME doc using", 2, newer.but(item="library"))
        if maker.chance(.4):
            library_for_newer(maker, items, random.choice([n for n, l in scope.libraries.items() if l.schema == schemas[0]]), newer.but(item="library"))
        if maker.chance(.6):
            library_onto(maker, items, random.choice([n for n, l in scope.libraries.items() if l.schema == newer.schema]), first.but(item="library"))
    if maker.chance(.3):
        library(maker, items, "library_head: library NAME doc using FROM NAME", 2, first.but(item="library"))
    add_tests(maker, items, first)
    if maker.chance(.15):
        items.append(maker.make("item", 3, first))        # whatever the grammar has
    return listed(maker.grammar, "items", items)
