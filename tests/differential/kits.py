"""What kits are about, beside their grammar: parts whose faces fall on cells, connectors that find each other, and models that are small."""
from dataclasses import dataclass, field as default, replace
from fractions import Fraction

from kind import Kind
from kit_questions import OF_KITS, OF_MODELS, QUICK, KitSubject, read_kit
from maker import Notation
from tree import listed

DOCS = ['"a doc"', '"it\'s \\"quoted\\""', '"größer"', '""']
MISTAKE = .02
UNITS = [((10, 8, 10), 4), ((20, 24, 20), 4), ((20, 8, 20), 4), ((10, 10, 10), 24), ((20, 20, 20), 24), ((1, 1, 1), 4)]

# What lies beside: a block, a hill, a part of an LDraw library with its studs, another kit, and a model of its parts.
BLOCK = "".join(f"v {x} {y} {z}\n" for z in (0, 2) for y in (-1, 1) for x in (-2, 2)) + \
    "".join(f"f {face}\n" for face in ("1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"))
HILL = "P2\n4 3\n9\n1 2 2 1\n3 9 7 2\n2 5 4 1\n"
BOX = "0 Box\n4 16 -1 0 -1 1 0 -1 1 0 1 -1 0 1\n4 16 -1 1 -1 1 1 -1 1 1 1 -1 1 1\n"
STUD = "0 Stud\n4 16 -6 0 -6 6 0 -6 6 -4 6 -6 -4 6\n"
OWN = "0 Own\n1 16 0 0 0 20 0 0 0 24 0 0 0 10 box.dat\n1 16 -10 0 0 1 0 0 0 1 0 0 0 1 stud.dat\n1 16 10 0 0 1 0 0 0 1 0 0 0 1 stud.dat\n"
PARTS = """unit 10 x 8 x 10;
connector stud joins tube every 20;
connector tube joins stud turns 4 every 20;
part base "a base" { fill 40 x 24 x 40; studs up 2 x 2; tubes down 2 x 2 at (0, -24, 0); mass 2; }
space plinth = box(40, 24, 40);
rule basic at stud = base;
"""
STANDS = "0 stands\n1 4 0 -24 0 1 0 0 0 1 0 0 0 1 base.dat\n"


@dataclass
class Scope:
    """What the file has said so far."""
    unit: tuple = None
    turns: int = 4
    lengths: dict = default(default_factory=dict)        # in LDU
    joins: dict = default(default_factory=dict)          # which kind each connector joins
    parts: dict = default(default_factory=dict)          # which connectors each has
    spaces: list = default(default_factory=list)
    rules: dict = default(default_factory=dict)          # at which connectors each is
    models: list = default(default_factory=list)
    names: set = default(default_factory=set)

    def fresh(self, random, choices):
        name = random.choice(choices)
        while name in self.names:
            name += "_2" if name[-1].isalpha() else "1"
        self.names.add(name)
        return name


@dataclass(frozen=True)
class Place:
    """The context of a node. `want` is what a NAME, NUMBER, STRING or a length is here; `text` itself; `cells` how many a length has."""
    scope: Scope
    want: str = None
    text: str = None
    axis: int = 0
    cells: Fraction = None
    size: tuple = None               # of the part that features are of
    sort: str = None                 # "truth" or "number", of an expression
    kinds: tuple = ()                # connectors of a rule

    def but(self, **changes):
        return replace(self, **changes)


def exact(place, text):
    return place.but(want="exact", text=text)


# ---- lengths

def length(maker, depth, place):
    """So many cells, in LDU, millimetres, or lengths of the file."""
    if place.want == "whole":
        return None
    cells = Fraction(maker.random.choice([1, 2, 2, 3, 4])) if place.cells is None else place.cells
    value = cells * (place.scope.unit or (10, 8, 10))[place.axis]
    names = [(n, f) for n, f in {**place.scope.lengths, "mm": Fraction(5, 2), "LDU": Fraction(1)}.items() if is_short(value / f)]
    sign = "MINUS " if value < 0 else ""
    if names and maker.chance(.4):
        name, factor = maker.random.choice(names)
        plural = "s" * (abs(value / factor) != 1 and name not in ("mm", "LDU") and maker.chance(.7))
        return maker.node(f"length: {sign}NUMBER NAME", maker.word("NUMBER", decimal(abs(value / factor))), maker.word("NAME", name + plural))
    return maker.node(f"length: {sign}NUMBER", maker.word("NUMBER", decimal(abs(value))))


def is_short(value):
    return (value * 1000).denominator == 1


def decimal(value):
    text = f"{float(value):.6f}".rstrip("0").rstrip(".")
    return text


def vector(maker, depth, place):
    """A place in cells: what `cells` says for each axis, or some near the origin."""
    at = place.size if place.want == "at" else [maker.random.choice([0, 0, 1, -1, 2, -2, 3]) for _ in range(3)]
    parts = [length(maker, 1, place.but(want=None, axis=k, cells=Fraction(c))) for k, c in enumerate(at)]
    return maker.node("vector: OPEN length COMMA length COMMA length CLOSE", *parts)


def sizes(place, cells, at=(1, 3, 5)):
    return {i: place.but(want=None, axis=k, cells=Fraction(cells[k])) for k, i in enumerate(at)}


# ---- parts

def features(maker, depth, place):
    """A box with connectors above and below, perhaps at its sides; sometimes whatever the grammar makes."""
    random, scope = maker.random, place.scope
    size = place.size
    made = [body(maker, place)]
    for kind in scope.joins:
        made += connectors(maker, place, kind)
    if maker.chance(.25):
        made.append(maker.by_grammar("feature", depth, place))
    made += [maker.make_of(f"feature: {word} NUMBER", 1, place) for word in ("MASS", "PRICE") if maker.chance(.4)]
    if maker.chance(.15):                # a second box beside it
        made.append(maker.make_of("feature: fill", 1, place.but(want="second", size=size)))
    random.shuffle(made)
    node = maker.node("features: %empty")
    for feature in made:
        node = maker.node("features: features feature END", node, feature)
    return node


def feature(maker, node):
    return maker.node("feature: fill" if node.symbol == "fill" else "feature: has", node)


def body(maker, place):
    return feature(maker, fill(maker, 1, place.but(want="body")))


def fill(maker, depth, place):
    """A box of the part's size whose top is at its place; a second one beside it."""
    size = place.size or (2, 1, 2)
    at = [Fraction(size[0] % 2, 2), 0, Fraction(size[2] % 2, 2)]
    if place.want == "second":
        size, at = (2, 1, 2), [Fraction(size[0] // 2 + 1), 0, 0]
    if maker.chance(.12):
        ways = maker.random.sample(["up", "down", "left", "right", "front", "back"], 2)
        node = maker.node("fill: NAME NAME NAME length X length X length", maker.word("NAME", "slope"), *(maker.word("NAME", w) for w in ways),
                          *lengths_of(maker, place, size))
    else:
        node = maker.node("fill: FILL length X length X length", *lengths_of(maker, place, size))
    if any(at) or maker.chance(.1):
        node = maker.node("fill: fill AT vector", node, vector(maker, 1, place.but(want="at", size=tuple(at))))
    return node


def lengths_of(maker, place, size):
    return [length(maker, 1, place.but(want=None, axis=k, cells=Fraction(c))) for k, c in enumerate(size)]


def connectors(maker, place, kind):
    """None, one, or a grid, above, below or at a side."""
    scope, size = place.scope, place.size
    below = is_below(scope, kind)
    aside = scope.joins[kind] == kind
    if maker.chance(.35 if aside else .08):
        return []
    ways = ["left", "right", "front", "back"] if aside or maker.chance(.1) else ["down" if below else "up"] * 5 + ["up"] * (scope.turns == 24)
    way = maker.random.choice(ways)
    at = {"up": (0, 0, 0), "down": (0, -size[1], 0), "left": (-Fraction(size[0], 2), 0, 0), "right": (Fraction(size[0], 2), 0, 0),
          "front": (0, 0, -Fraction(size[2], 2)), "back": (0, 0, Fraction(size[2], 2))}[way]
    node = maker.node("has: NAME NAME", maker.word("NAME", kind + "s" * maker.chance(.3)), maker.word("NAME", way))
    across = (Fraction(size[0], 2), Fraction(size[2], 2))
    if way in ("up", "down") and all(c == int(c) and c > 0 for c in across) and max(across) > 1 and maker.chance(.8):
        node = maker.node("has: has NUMBER X NUMBER", node, *(maker.word("NUMBER", str(int(c))) for c in across))
    elif any(c != int(c) for c in at):
        at = tuple(Fraction(int(c)) for c in at)
    if any(at) or maker.chance(.1):
        node = maker.node("has: has AT vector", node, vector(maker, 1, place.but(want="at", size=at)))
    return [feature(maker, node)]


# ---- spaces

SHAPES = {"box": 3, "cylinder": 2, "sphere": 1}
NAMED = {"box": ("width", "height", "depth"), "cylinder": ("radius", "height"), "sphere": ("radius",), "mesh": ("height",),
         "heightmap": ("width", "height", "depth")}


def space(maker, depth, place):
    """Of a model mostly a box in which its parts have room."""
    if place.want == "room" and maker.chance(.7):
        return shape(maker, "box", place, [maker.random.choice(c) for c in ([4, 6, 6, 8, 8], [3, 4, 6, 6], [4, 6, 6, 8, 8])])
    return None


def shape(maker, name, place, cells):
    parts = [extent(maker, name, i, place.but(want=None, axis=k, cells=Fraction(cells[k]))) for i, k in enumerate(axes_of(name))]
    return maker.node("space: NAME OPEN extents CLOSE", maker.word("NAME", name), listed(maker.grammar, "extents", parts))


def axes_of(name):
    return {"box": (0, 1, 2), "cylinder": (0, 1), "sphere": (0,), "mesh": (1,), "heightmap": (0, 1, 2)}[name]


def extent(maker, name, i, place):
    made = length(maker, 1, place)
    return maker.node("extent: NAME length", maker.word("NAME", NAMED[name][i]), made) if maker.chance(.2) else maker.node("extent: length", made)


def extents(maker, depth, place):
    name = place.text or "box"
    cells = [maker.random.choice([1, 2, 3, 4]) for _ in range(3)]
    return listed(maker.grammar, "extents", [extent(maker, name, i, place.but(want=None, axis=k, cells=Fraction(cells[k]))) for i, k in enumerate(axes_of(name))])


def any_shape(maker, place):
    name = maker.random.choice(list(SHAPES))
    return {0: exact(place, name), 2: place.but(text=name)}


def filed(maker, place):
    name = "mesh" if maker.chance(.5) else "heightmap"
    return {0: exact(place, name), 2: exact(place, '"block.obj"' if name == "mesh" else '"hill.pgm"'), 3: place.but(want=name), 5: place.but(text=name)}


# ---- rules

def names(maker, depth, place):
    return listed(maker.grammar, "names", [maker.word("NAME", kind) for kind in place.kinds])


def part_name(maker, depth, place):
    """A new part's name, or one that fits where it is."""
    scope = place.scope
    name = place.text if place.want == "new" else None
    if name is None:
        wanted = {scope.joins.get(kind) for kind in place.kinds}
        fit = [part for part, kinds in scope.parts.items() if wanted & kinds] or list(scope.parts) or ["base"]
        name = maker.random.choice(fit)
    if name.isdigit():
        return maker.node("part_name: NUMBER", maker.word("NUMBER", name))
    if name[0].isdigit():
        return maker.node("part_name: CODE", maker.word("CODE", name))
    if " " in name or maker.chance(.1):
        return maker.node("part_name: STRING", maker.word("STRING", f'"{name}"'))
    return maker.node("part_name: NAME", maker.word("NAME", name))


def placed(maker, depth, place):
    """Later parts of braces have a place, above the first or beside it."""
    if place.want != "later":
        return None
    at = maker.random.choice([(0, 1, 0), (0, 1, 0), (0, 2, 0), (2, 0, 0), (0, 0, 4), (0, -3, 0)])
    node = maker.node("placed: placed AT vector", maker.make("placed", depth, place.but(want=None)), vector(maker, 1, place.but(want="at", size=at)))
    return maker.node("placed: placed TURN NUMBER", node, maker.word("NUMBER", maker.random.choice("0123"))) if maker.chance(.3) else node


# ---- what stands where

def fixed(contexts):
    """Changes of the i-th symbols' contexts."""
    return lambda maker, place: {i: place.but(**changes) for i, changes in contexts.items()}


def new(maker, place, choices):
    return exact(place, place.scope.fresh(maker.random, choices))


def kinds_of(maker, place):
    """Where a rule is: a connector or several."""
    known = list(place.scope.joins) or ["stud"]
    return tuple(maker.random.sample(known, maker.random.choice([1, min(2, len(known)), len(known), len(known)])))


def rule(maker, place):
    kinds = kinds_of(maker, place)
    return {1: new(maker, place, ["any", "wall", "go-on", "Up"]), 3: place.but(kinds=kinds), 5: place.but(kinds=kinds)}


def start(maker, place):
    """A rule, and a connector that it is at: mostly one that stands up."""
    scope = place.scope
    name = maker.random.choice(list(scope.rules) or ["any"])
    kinds = list(scope.rules.get(name) or scope.joins) or ["stud"]
    upward = [kind for kind in kinds if kind in scope.joins and not is_below(scope, kind)]
    return name, maker.random.choice(upward if upward and maker.chance(.8) else kinds)


def is_below(scope, kind):
    """Of the connectors of a pair the second stands below its part."""
    return list(scope.joins).index(kind) % 2 == 1 and scope.joins[kind] != kind


def starts(by):
    """A start: its connector is one that its rule is at, and its place is in the middle."""
    def contexts(maker, place):
        name, kind = start(maker, place)
        below = kind in place.scope.joins and is_below(place.scope, kind)
        at = tuple(Fraction(maker.random.choice(c)) for c in ([0, 0, 0, 1, -1], [3, 4, 2] if below else [0, 0, 0, 0, 1], [0, 0, 0, 1, -1]))
        made = {1: exact(place, kind), 2: place.but(want="axis", text="down" if below else "up"), 4: place.but(want="at", size=at), by: exact(place, name)}
        if by == 8:
            made[6] = place.but(want="turn")
        return made
    return contexts


def axis(maker, depth, place):
    if place.want != "axis" or maker.chance(.15):
        return None
    return maker.node("axis: %empty") if place.text == "up" and maker.chance(.7) else maker.node("axis: NAME", maker.word("NAME", place.text))


def stands(maker, place):
    return {1: exact(place, '"stands.ldr"'), 3: exact(place, start(maker, place)[0])}


def truths(maker, place):
    return {i: place.but(sort="truth") for i in (0, 1, 2)}


CONTEXTS = {
    "statements: statements USE STRING END": fixed({2: {"want": "use"}}),
    "statements: statements PART part_name doc NAME NAME STRING END": lambda m, p: {4: exact(p, "from"), 5: exact(p, "ldraw"), 6: exact(p, '"own.dat"')},
    "statements: statements PART part_name doc NAME NAME STRING OPEN_BRACE features CLOSE_BRACE":
        lambda m, p: {4: exact(p, "from"), 5: exact(p, "ldraw"), 6: exact(p, '"own.dat"')},
    "statement: LENGTH NAME EQUALS length": lambda m, p: {1: new(m, p, ["stud", "brick", "step"])},
    "statement: SPACE NAME EQUALS space": lambda m, p: {1: new(m, p, ["room", "hall", "Room"])},
    "statement: RULE NAME AT names EQUALS alternatives": rule,
    "connector: connector TURNS NUMBER": fixed({2: {"want": "turns"}}), "connector: connector EVERY length": fixed({2: {"cells": Fraction(2)}}),
    "feature: MASS NUMBER": fixed({1: {"want": "weight"}}), "feature: PRICE NUMBER": fixed({1: {"want": "weight"}}),
    "has: NAME NAME": fixed({0: {"want": "connector"}, 1: {"want": "axis"}}), "has: has NUMBER X NUMBER": fixed({1: {"want": "side"}, 3: {"want": "side"}}),
    "space: NAME": fixed({0: {"want": "space"}}), "space: NAME OPEN extents CLOSE": any_shape,
    "space: NAME OPEN STRING upright CLOSE": lambda m, p: {0: exact(p, "mesh"), 2: exact(p, '"block.obj"'), 3: p.but(want="mesh")},
    "space: NAME OPEN STRING upright COMMA extents CLOSE": filed, "space: MODEL OPEN STRING CLOSE": lambda m, p: {2: exact(p, '"stands.ldr"')},
    "space: space TURN NUMBER": fixed({2: {"want": "turn"}}), "space: space REPEAT NUMBER BY vector": fixed({2: {"want": "side"}}),
    "axis: NAME": fixed({0: {"want": "axis"}}), "axis_word: NAME": lambda m, p: {0: p},
    "upright: axis_word NAME": fixed({0: {"want": "up axis"}, 1: {"want": "exact", "text": "up"}}),
    "drawn_one: placed OPEN_BRACKET NUMBER CLOSE_BRACKET": fixed({2: {"want": "share"}}),
    "several: several COMMA placed": fixed({2: {"want": "later"}}), "placed: placed IN NUMBER": fixed({2: {"want": "colour"}}), "placed: placed WITH NAME": fixed({2: {"want": "rule"}}),
    "placed: placed TURN NUMBER": fixed({2: {"want": "turn"}}),
    "line: INSIDE space": fixed({1: {"want": "room"}}), "line: START NAME axis AT vector BY NAME": starts(6),
    "line: START NAME axis AT vector TURN NUMBER BY NAME": starts(8), "line: START STRING BY NAME": stands,
    "line: COLOUR NUMBER": fixed({1: {"want": "colour"}}), "line: REQUIRE conditions": truths, "line: MINIMIZE condition": fixed({1: {"sort": "number"}}),
    "line: MAXIMIZE condition": fixed({1: {"sort": "number"}}),
    "line: SEARCH NAME": lambda m, p: {1: exact(p, m.random.choice(["greedy", "exact"]))},
    "line: SEARCH NAME NUMBER": lambda m, p: {1: exact(p, m.random.choice(["beam", "beam", "anneal"])), 2: p.but(want="amount")},
    "line: SYMMETRY TURN NUMBER": lambda m, p: {2: exact(p, m.random.choice(["2", "4"]))},
    "line: SYMMETRY NAME axis_word": lambda m, p: {1: exact(p, "mirror"), 2: p.but(want="side axis")},
    "line: ORDER NAME": lambda m, p: {1: exact(p, m.random.choice(["breadth", "breadth", "depth"]))},
    "line: STEPS NAME": lambda m, p: {1: exact(p, "layer")}, "line: STEPS NUMBER": fixed({1: {"want": "side"}}),
    "stocks: part_name AT_MOST NUMBER": fixed({2: {"want": "stock"}}), "stocks: stocks COMMA part_name AT_MOST NUMBER": fixed({4: {"want": "stock"}}),
    "expression: NAME": fixed({0: {"want": "term"}}), "expression: NUMBER": fixed({0: {"want": "number"}}),
    "call: NAME OPEN expression": lambda m, p: {0: exact(p, m.random.choice(["abs", "min", "max", "sqrt", "floor"]))},
}
WEIGHTS = {
    "doc: STRING": .2, "placed: placed AT vector": MISTAKE, "placed: placed TURN NUMBER": MISTAKE, "placed: placed WITH NAME": .15, "placed: placed STOP": .07,
    "placed: placed IN NUMBER": .2, "placed: part_name": 2, "alternative: OPEN_BRACE CLOSE_BRACE": .06, "alternative: OPEN_BRACE several CLOSE_BRACE": .2,
    "alternative: OPEN drawn CLOSE": .12, "alternatives: alternatives BAR alternative": 1.3, "expression: call CLOSE": .6, "space: NAME OPEN extents CLOSE": 4,
    "space: NAME OPEN STRING upright CLOSE": .15, "space: NAME OPEN STRING upright COMMA extents CLOSE": .25, "space: MODEL OPEN STRING CLOSE": .15,
    "space: NOT space": .5, "space: space AT vector": 1.5, "length: MINUS NUMBER": MISTAKE, "length: MINUS NUMBER NAME": MISTAKE, "space: NAME": 1.5,
    "space: OPEN space CLOSE": .5, "upright: axis_word NAME": .6, "has: has NUMBER X NUMBER": .3,
}
TRUTHS = {f"expression: expression {sign} expression" for sign in ("BELOW", "AT_MOST", "EQUALS", "UNEQUAL", "AT_LEAST", "ABOVE")} | \
    {"expression: expression IN expression TO_DOTS expression"}
OF_TRUTHS = {"expression: expression AND expression", "expression: expression OR expression", "expression: NOT expression"}


def of_sort(production, place):
    """Conditions compare numbers; `and`, `or` and `not` are of conditions."""
    if production.head != "expression" or place.sort is None or production.name == "expression: OPEN expression CLOSE":
        return True
    return (production.name in TRUTHS | OF_TRUTHS) == (place.sort == "truth")


TERMS = ["elements", "colours", "cells", "fill", "joints", "open", "components", "cuts", "floating", "overlaps", "width", "depth", "height", "mass", "price",
         "balance"]
NUMBERS = {
    "turns": ["1", "2", "4"], "weight": ["1", "0.5", "2.25", "0"], "side": ["1", "2", "2", "3"], "turn": ["0", "1", "2", "3"], "share": ["0.5", "0.25", "1", "0"],
    "colour": ["4", "0", "71", "15"], "amount": ["1", "2", "5", "20"], "stock": ["0", "1", "2", "4", "9"], "number": ["0", "1", "2", "10", "0.5", "100", "3"],
}
NAMES = {
    "connector": lambda scope: list(scope.joins), "axis": lambda scope: ["up", "up", "down", "left", "right", "front", "back"], "space": lambda scope: scope.spaces,
    "rule": lambda scope: list(scope.rules), "term": lambda scope: TERMS, "up axis": lambda scope: ["y", "z"], "side axis": lambda scope: ["z"],
}


class Kits(Notation):
    start = "file"
    indents = {"statement": 0, "feature": 2, "line": 2}
    depths = {"conditions": 4, "condition": 3}
    remade = ("expression", "condition", "space", "alternative", "feature", "line", "statement", "placed", "part_name", "length", "vector")
    hooks = {"length": length, "axis": axis, "vector": vector, "features": features, "fill": fill, "space": space, "extents": extents, "placed": placed, "names": names, "part_name": part_name}

    def weight(self, production, context):
        if not of_sort(production, context) or production.name == "space: NAME" and not context.scope.spaces:
            return 0
        if context.want == "mesh" and production.head == "upright":
            return 1
        if context.want == "heightmap" and production.name == "upright: axis_word NAME":
            return 0
        return WEIGHTS.get(production.name, 1)

    def contexts(self, maker, production, context):
        made = CONTEXTS[production.name](maker, context) if production.name in CONTEXTS else {}
        plain = context.but(want=None, text=None, cells=None, size=context.size if production.head in ("features", "feature") else None,
                            sort=inner_sort(production, context))
        return [made.get(i, plain) for i in range(len(production.symbols))]

    def token(self, maker, token, context):
        if context.want == "exact" or context.want == "new":
            return context.text
        if token == "STRING":
            return maker.random.choice({"use": ['"parts.kit"', '"bricks"', '"parts.kit"']}.get(context.want, DOCS))
        if token == "NUMBER":
            return maker.random.choice(NUMBERS.get(context.want, ["1", "2", "4"]))
        return maker.random.choice(NAMES.get(context.want, lambda scope: [])(context.scope) or ["stud"])


def inner_sort(production, context):
    if production.name in TRUTHS:
        return "number"
    return context.sort


# ---- a file

class KitKind(Kind):
    name, grammar_file, suffix, notation = "kits", "kit.y", ".kit", Kits()
    not_reached = {"file: ASKED conditions": "the command line's, not a file's"}

    def make_file(self, maker):
        return maker.node("file: statements", statements(maker))

    def beside(self, random):
        return {"block.obj": BLOCK, "hill.pgm": HILL, "own.dat": OWN, "box.dat": BOX, "stud.dat": STUD, "parts.kit": PARTS, "stands.ldr": STANDS}

    def subject(self, path, folder, part, tree):
        return KitSubject(path, folder, part, tree)

    def questions(self, path):
        models = list(read_kit(path).models)
        return [(q, name) for q in QUICK for name in models], [(q, None) for q in OF_KITS] + [(q, name) for name in models for q in OF_MODELS]


def statements(maker):
    random, scope = maker.random, Scope()
    made = maker.node("statements: %empty")
    for word in order_of(maker):
        made = STATEMENTS[word](maker, Place(scope), made)
    return made


def order_of(maker):
    random = maker.random
    used = maker.chance(.3)
    return ["use"] * used + ["unit"] * (not used or maker.chance(.1)) + ["length"] * random.choice([0, 1, 2]) + ["connectors"] * (not used or maker.chance(.3)) + \
        ["part"] * random.choice([1, 1, 2, 3]) + ["space"] * random.choice([0, 0, 1, 2]) + ["rule"] * random.choice([1, 1, 2]) + \
        ["model"] * random.choice([1, 1, 1, 2]) + ["test"] * maker.chance(.4)


def ended(maker, before, node):
    return maker.node("statements: statements statement END", before, node)


def use(maker, place, before):
    file = maker.random.choice(["parts.kit", "parts.kit", "bricks"])
    bricks = file == "bricks"
    place.scope.unit, place.scope.turns = (10, 8, 10), 4
    place.scope.joins.update(stud="tube", tube="stud")
    if bricks:
        place.scope.lengths.update(stud=Fraction(20), plate=Fraction(8), brick=Fraction(24))
        place.scope.parts.update({name: {"stud", "tube"} for name in ("3005", "3004", "3003", "3023")} | {"3070b": {"tube"}})
    else:
        place.scope.parts["base"] = {"stud", "tube"}
        place.scope.spaces.append("plinth")
        place.scope.rules["basic"] = ("stud",)
    place.scope.names |= {"stud", "plate", "brick", "plinth", "basic", "base"}
    return maker.node("statements: statements USE STRING END", before, maker.word("STRING", f'"{file}"'))


def unit(maker, place, before):
    sizes, turns = maker.random.choice(UNITS)
    texts = [maker.node("length: NUMBER", maker.word("NUMBER", str(s))) for s in sizes]
    place.scope.unit, place.scope.turns = sizes, turns
    if turns == 4:
        return ended(maker, before, maker.node("statement: UNIT length X length X length", *texts))
    return ended(maker, before, maker.node("statement: UNIT length X length X length TURNS NUMBER", *texts, maker.word("NUMBER", str(turns))))


def a_length(maker, place, before):
    cells, axis = Fraction(maker.random.choice([1, 2, 3])), maker.random.choice([0, 1])
    name = place.scope.fresh(maker.random, ["stud", "brick", "step"])
    made = maker.node("statement: LENGTH NAME EQUALS length", maker.word("NAME", name), length(maker, 1, place.but(cells=cells, axis=axis)))
    place.scope.lengths[name] = cells * place.scope.unit[axis]
    return ended(maker, before, made)


def connectors_of(maker, place, before):
    """A pair, and perhaps one that joins its like."""
    pairs = maker.random.choice([[("stud", "tube")], [("stud", "tube"), ("side", "side")], [("plug", "hole")], [("side", "side"), ("peg", "hole")]])
    for one, other in pairs:
        for kind, joined in [(one, other), (other, one)][:1 + (one != other)]:
            before = ended(maker, before, maker.node("statement: connector", connector(maker, place, kind, joined)))
            place.scope.joins[kind] = joined
            place.scope.names.add(kind)
    return before


def connector(maker, place, kind, joined):
    node = maker.node("connector: CONNECTOR NAME JOINS NAME", maker.word("NAME", kind), maker.word("NAME", joined))
    if maker.chance(.4):
        node = maker.node("connector: connector TURNS NUMBER", node, maker.word("NUMBER", maker.random.choice(["1", "2", "4"])))
    if maker.chance(.9):
        node = maker.node("connector: connector EVERY length", node, length(maker, 1, place.but(axis=0, cells=Fraction(2))))
    return node


def part(maker, place, before):
    name = place.scope.fresh(maker.random, ["post", "7", "3070b", "Beam", "a part", "long-one"])
    size = tuple(maker.random.choice(c) for c in ([2, 2, 2, 4, 4, 6, 1], [1, 1, 2, 3], [2, 2, 2, 4, 1]))
    inner = place.but(size=size)
    named, doc = part_name(maker, 1, place.but(want="new", text=name)), maker.make("doc", 1, place)
    head, file = [named, doc], [maker.word("NAME", "from"), maker.word("NAME", "ldraw"), maker.word("STRING", '"own.dat"')]
    if maker.chance(.08):
        node = maker.node("statements: statements PART part_name doc NAME NAME STRING END", before, *head, *file)
    elif maker.chance(.08):
        node = maker.node("statements: statements PART part_name doc NAME NAME STRING OPEN_BRACE features CLOSE_BRACE", before, *head, *file,
                          features(maker, 2, inner))
    else:
        node = maker.node("statements: statements PART part_name doc OPEN_BRACE features CLOSE_BRACE", before, *head, features(maker, 2, inner))
    place.scope.parts[name] = set(place.scope.joins)
    return node


def a_space(maker, place, before):
    node = maker.make_of("statement: SPACE NAME EQUALS space", 3, place)
    place.scope.spaces.append(node.child("NAME").text)
    return ended(maker, before, node)


def a_rule(maker, place, before):
    node = maker.make_of("statement: RULE NAME AT names EQUALS alternatives", maker.random.choice([2, 3, 4]), place)
    names_ = node.child("names")
    place.scope.rules[node.child("NAME").text] = tuple(kind for kind in place.scope.joins if kind in texts(names_))
    return ended(maker, before, node)


def texts(node):
    return [node.text] if node.production is None else [t for child in node.children for t in texts(child)]


LINES = {
    "colour": ["line: COLOUR NUMBER"], "require": ["line: REQUIRE conditions"], "order": ["line: ORDER NAME"],
    "steps": ["line: STEPS NAME", "line: STEPS PART", "line: STEPS NUMBER"], "stock": ["line: STOCK stocks"],
    "symmetry": ["line: SYMMETRY TURN NUMBER", "line: SYMMETRY NAME axis_word"], "search": ["line: SEARCH NAME", "line: SEARCH NAME NUMBER", "line: SEARCH NAME NUMBER"],
    "goal": ["line: MINIMIZE condition", "line: MAXIMIZE condition"],
}
STARTS = ["line: START NAME axis AT vector BY NAME"] * 4 + ["line: START NAME axis AT vector TURN NUMBER BY NAME", "line: START STRING BY NAME"]


def model(maker, place, before):
    name = place.scope.fresh(maker.random, ["one", "hut", "Tower"])
    place.scope.models.append(name)
    searched = maker.chance(.25)
    wanted = ["line: INSIDE space"] + [maker.random.choice(STARTS)] * maker.random.choice([1, 1, 1, 2])
    wanted += [maker.random.choice(LINES[word]) for word, share in (("colour", .3), ("require", .3), ("order", .3), ("steps", .25), ("stock", .12),
                                                                      ("symmetry", .1)) if maker.chance(share)]
    wanted += [maker.random.choice(LINES[word]) for word in ("search", "goal")] * searched
    made = [maker.make_of(line, maker.random.choice([1, 2, 3]), place) for line in wanted]
    maker.random.shuffle(made)
    lines = maker.node("lines: %empty")
    for line in made:
        lines = maker.node("lines: lines line END", lines, line)
    return maker.node("statements: statements MODEL NAME doc OPEN_BRACE lines CLOSE_BRACE", before, maker.word("NAME", name), maker.make("doc", 1, place), lines)


def test(maker, place, before):
    name = maker.random.choice(place.scope.models)
    conditions = maker.make("conditions", 2, place.but(sort="truth"))
    return maker.node("statements: statements TEST NAME OPEN_BRACE EXPECT conditions END CLOSE_BRACE", before, maker.word("NAME", name), conditions)


STATEMENTS = {"use": use, "unit": unit, "length": a_length, "connectors": connectors_of, "part": part, "space": a_space, "rule": a_rule, "model": model, "test": test}
KITS = KitKind()
