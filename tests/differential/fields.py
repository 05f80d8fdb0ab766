"""What files of implicit surfaces are about, beside their grammar: which names can stand where, and which formulas have a surface."""
from dataclasses import dataclass, field as default, replace

from field_questions import OF_FIELDS, OF_SURFACES, QUICK, FieldSubject
from field_reader import read_fields
from kind import Kind
from maker import Notation
from tree import listed, words

DOCS = ['"a doc"', '"it\'s a \\"quoted\\" word"', '"größer"', '""']
AXES = ("x", "y", "z")
BUILT_IN = {"abs": 1, "sqrt": 1, "square": 1, "floor": 1, "sin": 1, "cos": 1, "tan": 1, "exp": 1, "log": 1, "tanh": 1, "pow": 2, "atan2": 2,
            "min": 2, "max": 2, "clamp": 3, "mix": 3, "blend": 3, "noise": 3}
COMMON = ["abs", "sqrt", "square", "pow", "min", "max", "blend"]         # called more often than others
MISTAKE = .02

# A block with half sides 2, 1.5 and 1, closed.
HULL = "".join(f"v {x} {y} {z}\n" for z in (-1, 1) for y in (-1.5, 1.5) for x in (-2, 2)) + \
    "".join(f"f {face}\n" for face in ("1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"))
PARTS = "let step = 0.75\nfn twice(a) = a*2\nsurface core = x*x + y*y + z*z - 4\n"


@dataclass
class Scope:
    """What the file defines so far."""
    lets: list = default(default_factory=list)
    functions: dict = default(default_factory=dict)      # how many arguments each takes
    surfaces: list = default(default_factory=list)
    names: set = default(default_factory=set)
    settings: set = default(default_factory=set)

    def fresh(self, random, choices):
        name = random.choice(choices)
        while name in self.names:
            name += "_2"
        self.names.add(name)
        return name


@dataclass(frozen=True)
class Place:
    """The context of a node. `sort` is what a formula depends on: "number" on no place, "form" on x, y and z."""
    scope: Scope
    sort: str = "form"
    params: tuple = ()
    want: str = None                 # what a NAME, NUMBER or STRING is here
    text: str = None                 # itself
    call: tuple = None               # (function, how many) of arguments

    def but(self, **changes):
        return replace(self, **changes)


# ---- formulas

def call(maker, place):
    """The name of a function, and so many arguments as it takes."""
    own = dict(place.scope.functions) if place.sort == "form" else {}
    common = [name for name in COMMON if maker.chance(.5)]
    name = maker.random.choice(common + list(own) * 3 + list(BUILT_IN) if maker.chance(.9) else list(BUILT_IN))
    count = own.get(name) or BUILT_IN.get(name)
    count += maker.random.choice([0, 0, 1]) if name in ("min", "max") and name not in own else 0
    return {0: place.but(want="exact", text=name), 2: place.but(call=(name, count))}


def arguments(maker, depth, place):
    """Of a call, each for itself: exponents are mostly written, and radii are mostly above 0."""
    if not place.call:
        return None
    function, count = place.call
    inside, own = place.but(call=None), function in place.scope.functions
    made = [argument(maker, depth - 1, inside, None if own else function, i) for i in range(count)]
    return listed(maker.grammar, "arguments", made)


def argument(maker, depth, place, function, i):
    written = {("pow", 1): ["2", "2", "3", "4", "0", "1", "0.5", "1.5", "64"], ("blend", 2): ["0.5", "1", "2", "0"],
               ("clamp", 1): ["0", "1"], ("clamp", 2): ["2", "3"], ("mix", 2): ["0.5", "0.25", "1"]}.get((function, i))
    if written and maker.chance(.85):
        return negative(maker, number(maker, maker.random.choice(written)), .1)
    return maker.make("expression", max(depth, 0), place)


def number(maker, text):
    return maker.node("expression: NUMBER", maker.word("NUMBER", text))


def name(maker, text):
    return maker.node("expression: NAME", maker.word("NAME", text))


def negative(maker, node, share):
    return maker.node("expression: MINUS expression", node) if maker.chance(share) else node


def of_two(maker, sign, a, b):
    return maker.node(f"expression: expression {sign} expression", a, b)


def called(maker, function, *parts):
    return maker.node("expression: NAME OPEN arguments CLOSE", maker.word("NAME", function), listed(maker.grammar, "arguments", parts))


def closed(maker, node):
    return maker.node("expression: OPEN expression CLOSE", node)


def axis(maker, place, which):
    """A coordinate, moved, stretched, mirrored or repeated."""
    random, node = maker.random, name(maker, AXES[which])
    way = random.choice(["as it is"] * 4 + ["moved", "stretched", "mirrored", "repeated", "any"])
    if way == "moved":
        return closed(maker, of_two(maker, random.choice(["PLUS", "MINUS"]), node, number(maker, random.choice(["1", "0.5", "2"]))))
    if way == "stretched":
        return closed(maker, of_two(maker, random.choice(["STAR", "SLASH"]), node, number(maker, random.choice(["2", "1.5"]))))
    if way == "mirrored":
        return called(maker, "abs", node)
    if way == "repeated":
        return closed(maker, of_two(maker, "MINUS", of_two(maker, "PERCENT", node, number(maker, "4")), number(maker, "2")))
    return closed(maker, maker.make("expression", 1, place)) if way == "any" else node


def ball(maker, depth, place):
    squares = [called(maker, "square", axis(maker, place, which)) for which in range(3)]
    return of_two(maker, "MINUS", of_two(maker, "PLUS", of_two(maker, "PLUS", squares[0], squares[1]), squares[2]),
                  number(maker, maker.random.choice(["4", "2.25", "6", "9"])))


def block(maker, depth, place):
    sides = [of_two(maker, "MINUS", called(maker, "abs", axis(maker, place, which)), number(maker, maker.random.choice(["1", "1.5", "2", "2.75"])))
             for which in range(3)]
    return called(maker, "max", *sides)


def joined(maker, depth, place):
    function = maker.random.choice(["min", "max", "blend", "mix"])
    third = {"blend": ["0.5", "1"], "mix": ["0.5"]}.get(function)
    made = [shape(maker, depth - 1, place), negative(maker, closed(maker, shape(maker, depth - 1, place)), .25)]
    return called(maker, function, *made, *([number(maker, maker.random.choice(third))] if third else []))


def wavy(maker, depth, place):
    return of_two(maker, "PLUS", ball(maker, depth, place), maker.make("expression", 2, place))


def placed(maker, depth, place):
    inner = closed(maker, shape(maker, depth - 1, place))
    there = listed(maker.grammar, "arguments", [axis(maker, place, which) for which in maker.random.choice([(0, 1, 2), (0, 1, 2), (1, 2, 0)])])
    return maker.node("expression: expression AT OPEN arguments CLOSE", inner, there)


def raised(maker, depth, place):
    """Whatever the grammar makes, less a number."""
    formula = closed(maker, maker.make("expression", max(depth, 2), place))
    return of_two(maker, maker.random.choice(["MINUS", "MINUS", "PLUS"]), formula, number(maker, maker.random.choice(["1", "2", "0.5"])))


def known(maker, depth, place):
    surfaces = place.scope.surfaces
    return name(maker, maker.random.choice(surfaces)) if surfaces else block(maker, depth, place)


def hull(maker, depth, place):
    made = maker.make_of("expression: NAME OPEN STRING CLOSE", 1, place)
    return of_two(maker, "MINUS", made, number(maker, maker.random.choice(["0.25", "0.5"])))


SHAPES = [ball, ball, block, block, joined, joined, wavy, placed, raised, raised, raised, raised, known, hull]
FLAT = [ball, ball, block, known, wavy]


def shape(maker, depth, place):
    return maker.random.choice(SHAPES if depth > 0 else FLAT)(maker, depth, place)


def expression(maker, depth, place):
    return shape(maker, depth, place.but(want=None)) if place.want == "shape" else None


# ---- what stands where

def fixed(contexts):
    """Changes of the i-th symbols' contexts."""
    return lambda maker, place: {i: place.but(**changes) for i, changes in contexts.items()}


def defined(place, choices, maker):
    return place.but(want="exact", text=place.scope.fresh(maker.random, choices))


def let(maker, place):
    return {1: defined(place, ["radius", "k", "Size", "size"], maker), 4: place.but(sort="number")}


def function(maker, place):
    count = maker.random.choice([1, 2, 3, 3, 4])
    params = ("x", "y", "z", "r")[:count] if maker.chance(.5) else tuple(maker.random.sample(["a", "b", "r", "x", "t"], count))
    names = place.but(want="params", params=params)
    return {1: defined(place, ["f", "ring", "rod", "Ring"], maker), 3: names, 7: place.but(params=params)}


def surface(maker, place):
    return {1: defined(place, ["one", "two", "stone", "One"], maker), 4: place.but(want="shape" if maker.chance(.9) else None)}


def box(maker, place):
    ends = maker.random.choice([("-4", "4"), ("-3", "3"), ("-4", "4"), ("-2.5", "3"), ("-7", "7"), ("0.5", "9")])
    return {2: place.but(sort="number", want="corner", text=ends[0]), 6: place.but(sort="number", want="corner", text=ends[1])}


CONTEXTS = {
    "statement: use STRING": fixed({1: {"want": "use"}}), "statement: let NAME doc EQUALS expression": let,
    "statement: fn NAME OPEN parameters CLOSE doc EQUALS expression": function, "statement: surface NAME doc EQUALS expression": surface,
    "statement: box OPEN arguments CLOSE TO_DOTS OPEN arguments CLOSE": box, "statement: grid NUMBER": fixed({1: {"want": "grid"}}),
    "statement: unit NAME": fixed({1: {"want": "unit"}}), "expression: NAME OPEN arguments CLOSE": call,
    "expression: NAME OPEN STRING CLOSE": fixed({0: {"want": "exact", "text": "distance"}, 2: {"want": "mesh"}}),
    "expression: expression AT OPEN arguments CLOSE": lambda maker, place: {3: place.but(call=("at", 3))},
}
WEIGHTS = {
    "expression: NUMBER": 1, "expression: NAME": 2, "expression: NAME OPEN arguments CLOSE": 3, "expression: NAME OPEN STRING CLOSE": .1,
    "expression: OPEN expression CLOSE": .8, "expression: expression AT OPEN arguments CLOSE": .4, "expression: expression CARET expression": MISTAKE,
    "expression: MINUS expression": .5, "doc: STRING": .15, "expression: expression PERCENT expression": .4,
}


def parameters(maker, depth, place):
    return listed(maker.grammar, "parameters", [maker.word("NAME", text) for text in place.params])


def corners(maker, depth, place):
    """Of a box: mostly of a cube, else one axis is longer or shorter."""
    if place.want != "corner":
        return arguments(maker, depth, place)
    ends = [place.text] * 3
    if maker.chance(.4):
        ends[maker.random.randrange(3)] = place.text.rstrip("0123456789.") + maker.random.choice(["1", "2.5", "5", "8"])
    made = [maker.node("expression: MINUS expression", number(maker, end[1:])) if end[0] == "-" else number(maker, end) for end in ends]
    return listed(maker.grammar, "arguments", made)


def used_name(maker, place):
    if place.want == "exact":
        return place.text
    if place.want == "unit":
        return maker.random.choice(["mm", "cm", "m", "in", "ft"])
    if place.sort == "number":
        return maker.random.choice(place.scope.lets or ["pi"])
    names = list(place.params) * 3 + list(AXES) * 2 + place.scope.lets * 2 + place.scope.surfaces
    return maker.random.choice(names)


TOKENS = {
    "NAME": used_name,
    "NUMBER": lambda maker, place: maker.random.choice(["9", "9", "12", "17", "7", "14"]) if place.want == "grid"
        else maker.random.choice(["1", "2", "3", "0.5", "1.25", "2", "0", ".5", "2e-1", "10", "0.1", "1e3", "0.7853981633974483", "1e-300", "1e300"]),
    "STRING": lambda maker, place: maker.random.choice({"use": ['"parts.field"', '"shapes"'], "mesh": ['"hull.obj"']}.get(place.want, DOCS)),
}


# Of numbers that depend on no place: what is about forms alone, and what needs another number.
OF_FORMS = {"expression: NAME OPEN STRING CLOSE", "expression: expression AT OPEN arguments CLOSE"}
OF_LETS = {"expression: NAME"}


class Fields(Notation):
    start = "file"
    indents = {"statement": 0}
    remade = ("expression", "statement")
    hooks = {"arguments": corners, "parameters": parameters, "expression": expression}

    def weight(self, production, context):
        if context.sort == "number" and production.name in OF_FORMS | (set() if context.scope.lets else OF_LETS):
            return 0
        return WEIGHTS.get(production.name, 1)

    def contexts(self, maker, production, context):
        made = CONTEXTS[production.name](maker, context) if production.name in CONTEXTS else {}
        return [made.get(i, context.but(want=None, text=None, call=None)) for i in range(len(production.symbols))]

    def token(self, maker, token, context):
        return TOKENS[token](maker, context)


# ---- a file

class FieldKind(Kind):
    name, grammar_file, suffix, notation = "fields", "field.y", ".field", Fields()

    def make_file(self, maker):
        if maker.chance(.1):
            return maker.node("file: expression", shape(maker, 2, Place(Scope())))
        return maker.node("file: statements", listed(maker.grammar, "statements", statements(maker)))

    def beside(self, random):
        return {"hull.obj": HULL, "parts.field": PARTS}

    def subject(self, path, folder, part, tree):
        return FieldSubject(path, folder, part, tree)

    def questions(self, path):
        surfaces = list(read_fields(path).surfaces)
        always = [(q, name) for q in QUICK for name in surfaces]
        return always, [(q, None) for q in OF_FIELDS] + [(q, name) for name in surfaces for q in OF_SURFACES]


def statements(maker):
    random, scope, made = maker.random, Scope(), []
    place = Place(scope)
    wanted = ["use"] * maker.chance(.25) + ["let"] * random.choice([0, 0, 1, 2]) + ["fn"] * random.choice([0, 1, 1, 2]) + \
        ["surface"] * random.choice([1, 1, 2, 2, 3]) + ["box"] * maker.chance(.7) + ["unit"] * maker.chance(.3) + ["grid"]
    for word in wanted:
        node = maker.make_of(STATEMENTS[word], random.choice([2, 3, 4, 5]), place)
        declare(scope, word, node)
        made.append(node)
    if maker.chance(.2):
        random.shuffle(made)                 # their order means nothing, but for which surface is the last
    return made


STATEMENTS = {
    "use": "statement: use STRING", "let": "statement: let NAME doc EQUALS expression",
    "fn": "statement: fn NAME OPEN parameters CLOSE doc EQUALS expression", "surface": "statement: surface NAME doc EQUALS expression",
    "box": "statement: box OPEN arguments CLOSE TO_DOTS OPEN arguments CLOSE", "unit": "statement: unit NAME", "grid": "statement: grid NUMBER",
}


def declare(scope, word, node):
    if word == "use":
        lets, functions, surfaces = USED[words(node)[1]]
        scope.lets.extend(lets)
        scope.functions.update(functions)
        scope.surfaces.extend(surfaces)
        scope.names.update(lets, functions, surfaces)
    elif word == "let":
        scope.lets.append(node.child("NAME").text)
    elif word == "fn":
        scope.functions[node.child("NAME").text] = len(words(node.child("parameters"))[::2])
    elif word == "surface":
        scope.surfaces.append(node.child("NAME").text)


# What other files have: numbers, functions with how many arguments they take, surfaces.
USED = {
    '"parts.field"': (["step"], {"twice": 1}, ["core"]),
    '"shapes"': ([], {"ball": 4, "cone": 5, "cylinder": 5, "turned_x": 3, "rounded_block": 7}, []),
}


FIELDS = FieldKind()
