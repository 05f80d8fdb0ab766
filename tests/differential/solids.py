"""What files of designs of boxes are about, beside their grammar: numbers at which boxes touch and overlap, measures, conditions."""
from dataclasses import dataclass, field as default, replace

from kind import Kind
from maker import Notation
from solid_questions import OF_DESIGNS, OF_SOLIDS, QUICK, SolidSubject, designs_of
from tree import Node, listed

DOCS = ['"a doc"', '"it\'s a \\"quoted\\" word"', '"größer"', '""']
MEASURES = ["width", "height", "depth", "volume", "mass", "area", "centre-x", "centre-y", "centre-z", "inertia-x", "inertia-y", "inertia-z", "boxes",
            "voids", "ghosts", "squashed", "inward", "parts", "weakest", "footprint", "support", "overhang", "shadow-x", "shadow-y", "shadow-z",
            "stable"]
FUNCTIONS = {"abs": 1, "sqrt": 1, "square": 1, "exp": 1, "log": 1, "sin": 1, "cos": 1, "tanh": 1, "min": 2, "max": 2}
MISTAKE = .02
SHELF = "solid shelf {\n  box board from (0, 2, 0) to (3, 2.25, 1) rigid;\n  box foot from (0, 0, 0) to (0.25, 2, 1);\n}\n"


@dataclass
class Scope:
    """What the file has so far."""
    designs: list = default(default_factory=list)
    names: set = default(default_factory=set)                # of the design that is made: its boxes, and those that it begins with
    goals: set = default(default_factory=set)


@dataclass(frozen=True)
class Place:
    """The context of a node."""
    scope: Scope
    want: str = None                 # what a NAME or a number is here
    text: str = None
    metric: bool = False             # the design says its unit, so that lengths may stand in it
    lattice: bool = True             # coordinates are quarters, so that boxes touch
    flat: bool = False
    call: tuple = None

    def but(self, **changes):
        return replace(self, **changes)


# ---- numbers

RANGES = {"place": (-2, 2), "size": (0, 5), "distance": (-1, 2), "part": (-1, 1)}


def value(maker, place):
    random = maker.random
    if place.want == "angle":
        return random.choice([-90, -45, 0, 45, 90, 30, 60, round(random.uniform(-180, 180), 1)])
    low, high = RANGES[place.want]
    if place.lattice:
        made = random.randint(4 * low, 4 * high) / 4
    else:
        made = round(random.uniform(low, high), random.choice([1, 2, 3]))
    return made or .5 if place.want == "size" else made


def figure(maker, made, place):
    """`number`: with its sign, now and then as a length."""
    text = f"{abs(made):g}" if not maker.chance(.03) else f"{abs(made) * 1e3:g}e-3"
    as_length = place.metric and place.want not in ("angle", "part") and maker.chance(.2)
    token = maker.word("LENGTH", maker.random.choice([text + "mm", f"{abs(made) / 10:g}cm"])) if as_length and "e" not in text else maker.word("NUMBER", text)
    return maker.node(f"number: MINUS {token.symbol}" if made < 0 else f"number: {token.symbol}", token)


def number(maker, depth, place):
    return figure(maker, value(maker, place), place) if place.want in RANGES or place.want == "angle" else None


def triple(maker, values, place):
    return maker.node("vector: OPEN number COMMA number COMMA number CLOSE", *(figure(maker, v, place) for v in values))


def vector(maker, depth, place):
    values = [value(maker, place) for _ in range(3)]
    return triple(maker, values if any(values) else [1, 1, 0], place)


# ---- boxes

def empty_parts(maker):
    return maker.node("parts: %empty")


def parts(maker, depth, place):
    """A place and a size, or two corners; perhaps a plane, perhaps rigid."""
    made = corners(maker, place) if maker.chance(.5) else maker.node(
        "parts: parts SIZE vector", maker.node("parts: parts AT vector", empty_parts(maker), vector(maker, 0, place.but(want="place"))),
        vector(maker, 0, place.but(want="size")))
    if maker.chance(.3):
        made = clipped(maker, made, place)
    if maker.chance(.2):
        made = maker.node("parts: parts RIGID", made)
    return Node(made.symbol, made.production, made.children, context=place)


def corners(maker, place):
    low = [value(maker, place.but(want="place")) for _ in range(3)]
    high = [l + value(maker, place.but(want="size")) for l in low]
    return maker.node("parts: parts FROM vector TO vector", empty_parts(maker), triple(maker, low, place.but(want="place")),
                      triple(maker, [round(h, 3) for h in high], place.but(want="place")))


def clipped(maker, made, place):
    if maker.chance(.5):
        normal = vector(maker, 0, place.but(want="part"))
        return maker.node("parts: parts CLIP NORMAL vector THROUGH vector", made, normal, vector(maker, 0, place.but(want="place")))
    numbers = [figure(maker, value(maker, place.but(want=want)), place.but(want=want)) for want in ("distance", "angle", "angle")]
    return maker.node("parts: parts CLIP number ANGLES number COMMA number", made, *numbers)


GENES = ("place", "place", "place", "size", "size", "size", "distance", "angle", "angle")


def numbers(maker, depth, place):
    own = [place.but(want=want, metric=False) for want in GENES]
    return listed(maker.grammar, "numbers", [figure(maker, value(maker, p), p) for p in own])


# ---- expressions

def call(maker, depth, place):
    """As many arguments as its function takes."""
    function = maker.random.choice(list(FUNCTIONS))
    made = maker.node("call: NAME OPEN expression", maker.word("NAME", function), maker.make("expression", depth - 1, place))
    for _ in range(FUNCTIONS[function] - 1):
        made = maker.node("call: call COMMA expression", made, maker.make("expression", depth - 1, place))
    return made


def condition(maker, depth, place):
    """What is required is mostly a comparison."""
    if place.want != "required" or maker.chance(.15):
        return None
    sign = maker.random.choice(["BELOW", "AT_MOST", "AT_LEAST", "ABOVE", "UNEQUAL", "EQUALS", "IN"])
    inner = place.but(want=None)
    sides = [maker.make("expression", 1, inner)] + [maker.node("expression: NUMBER", maker.word("NUMBER", text)) for text in
                                                    (maker.random.choice(["0", "1", "2", "8"]), maker.random.choice(["9", "20"]))]
    if sign == "IN":
        return maker.node("condition: expression", maker.node("expression: expression IN expression TO_DOTS expression", *sides))
    return maker.node("condition: expression", maker.node(f"expression: expression {sign} expression", *sides[:2]))


def expressions(maker, depth, place):
    made = [maker.make("condition", 2, place) for _ in range(maker.random.choice([1, 1, 2, 3]))]
    return listed(maker.grammar, "expressions", made)


# ---- statements

def axes(maker, depth, place):
    """In their order, which means nothing; each once."""
    chosen = [a for a in ("xy" if place.flat else "xyz") if maker.chance(.5)] or ["x"]
    if maker.chance(.1):
        chosen.reverse()
    return listed(maker.grammar, "axes", [maker.word("NAME", a) for a in chosen])


def goal_parts(maker, depth, place):
    made = maker.node("goal_parts: %empty")
    for word in ("TARGET", "WEIGHT"):
        if maker.chance(.6):
            made = maker.node(f"goal_parts: goal_parts {word} number", made, figure(maker, maker.random.choice([0, 1, 2.5, 20]), Place(place.scope)))
    return made


def fixed(contexts):
    return lambda maker, place: {i: place.but(**changes) for i, changes in contexts.items()}


def named(taken, choices):
    """A name that is not taken yet."""
    def contexts(maker, place):
        name, names = maker.random.choice(choices), getattr(place.scope, taken)
        while name in names:
            name += "-two"
        names.add(name)
        return {1: place.but(want="exact", text=name)}
    return contexts


CONTEXTS = {
    "file: file USE STRING END": fixed({2: {"want": "use"}}), "statement: FLAT number": fixed({1: {"want": "size"}}),
    "statement: MODEL NAME": fixed({1: {"want": "model"}}), "statement: BOX NAME doc parts": named("names", ["leg", "top", "seat", "back-rest"]),
    "statement: UNIT NUMBER SLASH NUMBER": fixed({1: {"want": "exact", "text": "1"}, 3: {"want": "unit"}}),
    "statement: MEASURE expressions": fixed({1: {"want": "measured"}}), "statement: REQUIRE expressions": fixed({1: {"want": "required"}}),
    "statement: FITNESS NAME EQUALS expression goal_parts": named("goals", ["lightness", "good", "close"]),
    "statement: FITNESS NAME goal_parts": fixed({1: {"want": "goal"}}),
}
WEIGHTS = {
    "end: %empty": MISTAKE, "expression: NUMBER": 1, "expression: NAME": 5, "expression: call CLOSE": .8, "expression: OPEN expression CLOSE": .6,
    "expression: MINUS expression": .3, "doc: STRING": .15, "expression: NOT expression": .3, "file: file USE STRING END": .2,
}


def used_name(maker, place):
    if place.want == "exact":
        return place.text
    if place.want == "model":
        return maker.random.choice(["mm", "cm", "m"])
    if place.want == "base":
        return maker.random.choice(place.scope.designs or ["nothing"])
    return maker.random.choice(MEASURES)


def written_number(maker, place):
    if place.want == "exact":
        return place.text
    return maker.random.choice(["1024", "64", "256"] if place.want == "unit" else ["0", "1", "2", "0.5", "3", "10", "1e2"])


TOKENS = {
    "NAME": used_name, "NUMBER": written_number, "LENGTH": lambda maker, place: maker.random.choice(["2m", "900mm", "3'", "1'6\"", "30cm"]),
    "STRING": lambda maker, place: '"shelf.solid"' if place.want == "use" else maker.random.choice(DOCS),
}


class Solids(Notation):
    start = "file"
    indents = {"SOLID": 0, "USE": 0, "statement": 2, "CLOSE_BRACE": 0}
    remade = ("parts", "expression", "number", "vector", "numbers", "statement")
    hooks = {"number": number, "vector": vector, "parts": parts, "numbers": numbers, "call": call, "condition": condition, "expressions": expressions,
             "axes": axes, "goal_parts": goal_parts}

    def weight(self, production, context):
        return WEIGHTS.get(production.name, 1)

    def contexts(self, maker, production, context):
        made = CONTEXTS[production.name](maker, context) if production.name in CONTEXTS else {}
        return [made.get(i, context.but(text=None)) for i in range(len(production.symbols))]

    def token(self, maker, token, context):
        return TOKENS[token](maker, context)


# ---- a file

SETTINGS = {"SYMMETRY axes": .45, "FLAT number": .1, "NOCLIP": .1, "CORRECT PENETRATION": .2, "UNIT NUMBER SLASH NUMBER": .1, "MODEL NAME": .15}
BOX, GENE, RIGID_GENE = "BOX NAME doc parts", "GENES OPEN numbers CLOSE", "GENES OPEN numbers CLOSE RIGID"


def statements(maker, place):
    random = maker.random
    chosen = [name for name, share in SETTINGS.items() if maker.chance(share)]
    place = place.but(metric="MODEL NAME" in chosen, lattice=maker.chance(.6), flat="FLAT number" in chosen)
    boxes = random.choices([BOX, GENE, RIGID_GENE], [6, 2, 1], k=random.choice([1, 2, 2, 3, 3, 4, 6]))
    asked = random.choices(["MEASURE expressions", "REQUIRE expressions", "FITNESS NAME goal_parts", "FITNESS NAME EQUALS expression goal_parts"],
                           k=random.choice([0, 1, 2, 3]))
    made = maker.node("statements: %empty")
    for name in chosen + boxes + asked:
        statement = maker.make_of("statement: " + name, 2, place)
        made = Node("statements", maker.grammar.production("statements: statements statement end"),
                    [made, statement, maker.make("end", 1, place)])
    return made


def design(maker, file, scope):
    name = maker.random.choice(["table", "Chair", "one"])
    while name in scope.designs:
        name += "-two"
    place = Place(scope)
    base = maker.make_of("base: FROM NAME" if scope.designs and maker.chance(.5) else "base: %empty", 1, place.but(want="base"))
    if not base.children:
        scope.names, scope.goals = set(), set()
    made = maker.node("file: file SOLID NAME doc base OPEN_BRACE statements CLOSE_BRACE", file, maker.word("NAME", name),
                      maker.make("doc", 1, place), base, statements(maker, place))
    scope.designs.append(name)
    return made


class SolidKind(Kind):
    name, grammar_file, suffix, notation = "solids", "solid.y", ".solid", Solids()

    def make_file(self, maker):
        scope = Scope()
        file = maker.node("file: %empty")
        if maker.chance(.15):
            file = maker.node("file: file USE STRING END", file, maker.word("STRING", '"shelf.solid"'))
            scope.designs.append("shelf")
        for _ in range(maker.random.choice([1, 1, 2])):
            file = design(maker, file, scope)
        return file

    def beside(self, random):
        return {"shelf.solid": SHELF}

    def subject(self, path, folder, part, tree):
        return SolidSubject(path, folder, part, tree)

    def questions(self, path):
        designs = designs_of(path)
        always = [(q, name) for q in QUICK for name in designs]
        return always, [(q, None) for q in OF_SOLIDS] + [(q, name) for name in designs for q in OF_DESIGNS]


SOLIDS = SolidKind()
