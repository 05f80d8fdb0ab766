"""What studies of growth are about, beside their grammar: small surfaces, and forces and boundaries near them."""
import random
from dataclasses import dataclass, field as default, replace

from hemls import HEMLS, system
from kind import Kind
from maker import Maker, Notation
from study_questions import OF_STUDIES, QUICK, StudySubject
from tree import Text

TERMS = ["size", "smoothness", "soft-boundary", "subdivisions", "symmetry", "undulation", "vertices", "edges", "faces", "width", "depth", "height", "area",
         "volume", "planarity", "worst-planarity", "edge-spread", "smallest-angle", "span", "crossed-faces", "turned-faces", "crossings", "sunlit"]
FUNCTIONS = {"abs": 1, "sqrt": 1, "square": 1, "min": 2, "max": 2, "exp": 1, "log": 1, "sin": 1, "cos": 1, "tanh": 1}
SHELL = "v -2 -2 -0.75\nv 2 -2 -0.75\nv 2 2 -0.75\nv -2 2 -0.75\nv 0 0 -2\nf 1 2 3 4\nf 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1\n"


@dataclass
class Scope:
    goals: set = default(default_factory=set)


@dataclass(frozen=True)
class Place:
    scope: Scope
    want: str = None
    text: str = None
    sort: str = None                 # "truth" or "number", of an expression
    function: str = None

    def but(self, **changes):
        return replace(self, **changes)


NUMBERS = {
    "steps": ["2", "3", "1", "0"], "scale": ["1", "1.5", "1.25", "0.8", "2"], "length": ["1", "2", "0.5", "1.5"], "seed": ["1", "7", "123456789"],
    "angle": ["30", "60", "90", "120"], "limit": ["1000", "800"], "place": ["0", "0", "1", "-1", "0.5", "-0.5", "2", "-1.25", "1e-1"],
    "strength": ["0.25", "0.5", "1", "-0.5"], "exponent": ["1", "2", "3", "2.5", "0"], "radius": ["0.5", "1", "2", "3.5"], "target": ["1", "0", "8", "0.25", "-2"],
    "weight": ["1", "2", "0.5"], "number": ["0", "1", "2", "10", "0.5", "100", "1e2"], "far": ["4", "3.5"], "near": ["-4", "-3"],
}


def vector(maker, depth, place):
    kind = {"radius": "place"}.get(place.want, place.want) or "place"
    numbers = [maker.word("NUMBER", maker.random.choice(NUMBERS.get(kind, NUMBERS["place"]))) for _ in range(3)]
    if kind == "normal" or kind == "sun":
        numbers[2] = maker.word("NUMBER", maker.random.choice(["1", "0.5", "2"]))
    name = maker.random.choice(["three: NUMBER NUMBER NUMBER", "three: NUMBER NUMBER NUMBER", "three: NUMBER COMMA NUMBER COMMA NUMBER"])
    three = maker.node(name, *numbers)
    return maker.node("vector: OPEN three CLOSE", three) if maker.chance(.2) else maker.node("vector: three", three)


def call(maker, depth, place):
    """A function with as many arguments as it takes."""
    if place.want == "call":
        return None
    name = maker.random.choice(list(FUNCTIONS))
    arguments = [maker.make("expression", depth - 2, place.but(sort="number")) for _ in range(FUNCTIONS[name])]
    node = maker.node("call: NAME OPEN expression", maker.word("NAME", name), arguments[0])
    for argument in arguments[1:]:
        node = maker.node("call: call COMMA expression", node, argument)
    return node


def fixed(contexts):
    return lambda maker, place: {i: place.but(**changes) for i, changes in contexts.items()}


def own_goal(maker, place):
    name = maker.random.choice(["slope", "near", "overhang", "Cells"])
    while name in place.scope.goals:
        name += "-2"
    place.scope.goals.add(name)
    return {1: place.but(want="exact", text=name), 3: place.but(sort=maker.random.choice(["number", "number", "truth"]))}


def goal(maker, place):
    names = [name for name in TERMS if name not in place.scope.goals] or TERMS
    name = maker.random.choice(names)
    place.scope.goals.add(name)
    return {1: place.but(want="exact", text=name)}


def number(kind):
    return fixed({1: {"want": kind}})


CONTEXTS = {
    "statement: use STRING": fixed({1: {"want": "exact", "text": '"other.study"'}}), "statement: rules STRING": fixed({1: {"want": "exact", "text": '"a.hemls"'}}),
    "statement: distance_to STRING": fixed({1: {"want": "exact", "text": '"shell.obj"'}}), "statement: steps NUMBER": number("steps"),
    "statement: scale NUMBER": number("scale"), "statement: scale vector": number("scale"), "statement: start vector": number("place"),
    "statement: start_length NUMBER": number("length"), "statement: seed NUMBER": number("seed"), "statement: branch_angle NUMBER": number("angle"),
    "statement: branch_length NUMBER": number("length"), "statement: edge_limit NUMBER": number("limit"), "statement: sun vector": number("sun"),
    "force_part: STRENGTH NUMBER": number("strength"), "force_part: EXPONENT NUMBER": number("exponent"), "goal_part: TARGET NUMBER": number("target"),
    "goal_part: WEIGHT NUMBER": number("weight"), "shape: SPHERE AT vector RADIUS NUMBER": fixed({4: {"want": "radius"}}),
    "shape: PLANE AT vector NORMAL vector": fixed({4: {"want": "normal"}}), "shape: BOX FROM vector TO vector": fixed({2: {"want": "near"}, 4: {"want": "far"}}),
    "shape: MESH STRING": fixed({1: {"want": "exact", "text": '"shell.obj"'}}), "statement: fitness NAME EQUALS expression goal_parts": own_goal,
    "statement: fitness NAME goal_parts": goal, "statement: require expression": fixed({1: {"sort": "truth"}}), "expression: NAME": fixed({0: {"want": "term"}}),
    "expression: NUMBER": fixed({0: {"want": "number"}}),
}
TRUTHS = {f"expression: expression {sign} expression" for sign in ("BELOW", "AT_MOST", "EQUALS", "UNEQUAL", "AT_LEAST", "ABOVE")} | \
    {"expression: expression IN expression TO_DOTS expression"}
OF_TRUTHS = {"expression: expression AND expression", "expression: expression OR expression", "expression: NOT expression"}
WEIGHTS = {"force_parts: force_parts force_part": 1.5, "goal_parts: goal_parts goal_part": .8, "boundary_parts: boundary_parts boundary_part": .7,
           "shape: MESH STRING": .4, "expression: call CLOSE": .6}


class Studies(Notation):
    start = "file"
    indents = {"statement": 0}
    remade = ("statement", "expression", "force_part", "boundary_part", "goal_part", "vector")
    hooks = {"vector": vector, "call": call}

    def weight(self, production, context):
        if production.head == "expression" and context.sort and production.name != "expression: OPEN expression CLOSE" and \
                (production.name in TRUTHS | OF_TRUTHS) != (context.sort == "truth"):
            return 0
        return WEIGHTS.get(production.name, 1)

    def contexts(self, maker, production, context):
        made = CONTEXTS[production.name](maker, context) if production.name in CONTEXTS else {}
        plain = context.but(want=None, text=None, sort="number" if production.name in TRUTHS else context.sort)
        return [made.get(i, plain) for i in range(len(production.symbols))]

    def token(self, maker, token, context):
        if context.want == "exact":
            return context.text
        if token == "STRING":
            return maker.random.choice(['"a title"', '"größer \\"quoted\\""'])
        if token == "NAME":
            return maker.random.choice(TERMS)
        return maker.random.choice(NUMBERS.get(context.want, NUMBERS["place"]))


STATEMENTS = {
    "title": .15, "start": .3, "start_length": .2, "seed": .2, "branch_angle": .15, "branch_length": .15, "edge_limit": .1, "fixed_centre": .15, "fixed_perimeter": .15,
    "facing": .15, "mirror": .1, "gravity": .2, "sun": .2, "distance_to": .15,
}


class StudyKind(Kind):
    name, grammar_file, suffix, notation = "studies", "study.y", ".study", Studies()

    def make_file(self, maker):
        place = Place(Scope())
        made = [maker.make_of("statement: rules STRING", 1, place), maker.make_of("statement: steps NUMBER", 1, place)]
        by_head = {name: [p.name for p in maker.grammar.rules["statement"] if p.symbols[0] == name] for name in STATEMENTS}
        made += [maker.make_of(by_head[name][0], 2, place) for name, share in STATEMENTS.items() if maker.chance(share)]
        several = [("statement: force AT vector force_parts", [0, 0, 0, 1, 2]), ("statement: boundary shape boundary_parts", [0, 0, 0, 1, 2]),
                   ("statement: fitness NAME goal_parts", [0, 0, 1, 2]), ("statement: fitness NAME EQUALS expression goal_parts", [0, 1, 1, 2]),
                   ("statement: require expression", [0, 0, 1]), ("statement: fitness RAW", [0] * 9 + [1]), ("statement: use STRING", [0] * 7 + [1])]
        for name, counts in several:
            made += [maker.make_of(name, maker.random.choice([2, 3, 4]), place) for _ in range(maker.random.choice(counts))]
        if maker.chance(.6):
            made.append(maker.make_of(maker.random.choice(["statement: scale NUMBER", "statement: scale vector"]), 2, place))
        maker.random.shuffle(made)
        node = maker.node("file: %empty")
        for statement in made:
            node = maker.node("file: file statement", node, statement)
        return node

    def beside(self, random_):
        """A rewrite system that is in order, a mesh, and another study."""
        maker = Maker(HEMLS.grammar, HEMLS.notation, random.Random(random_.random()))
        return {"a.hemls": Text(system(maker, sound=True), {}).text, "shell.obj": SHELL, "other.study": 'rules "a.hemls"\nscale 1.25\ngravity 0 0 0.125\n'}

    def subject(self, path, folder, part, tree):
        return StudySubject(path, folder, part, tree)

    def questions(self, path):
        return [(q, None) for q in QUICK], [(q, None) for q in OF_STUDIES]


STUDIES = StudyKind()
