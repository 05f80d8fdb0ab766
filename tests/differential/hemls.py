"""What rewrite systems are about, beside their grammar: paths that end as they began, and branches that may join."""
from dataclasses import dataclass, replace

from growth_questions import OF_SYSTEMS, QUICK, SystemSubject
from kind import Kind
from maker import Notation
from tree import listed

BACK = {"+": "-", "-": "+", "&": "^", "^": "&", "\\": "/", "/": "\\"}
SYMBOLS = {"+": "PLUS", "-": "MINUS", "~": "TILDE", "[": "OPEN", "]": "CLOSE", "<": "LESS", ">": "GREATER"}
MISTAKE = .03


@dataclass(frozen=True)
class Place:
    """`want`: "seed", "predecessor" or "successor" of symbols, "angle" or "weight" of numbers."""
    labels: tuple
    timed: bool                      # do edges have ages?
    weighted: bool = None            # has a rule's choice weights, or conditions?
    want: str = None
    sound: bool = False              # is the file to be in order at once?

    def but(self, **changes):
        return replace(self, **changes)


def edge(maker, place, aged=True):
    age = maker.random.choice(["", "_i", "_i+1", "_i-1"]) if aged and place.timed else ""
    return maker.random.choice(place.labels) + age


def seed(maker, place):
    words = []
    for _ in range(maker.random.choice([3, 3, 4, 4, 5, 6])):
        words += ["+"] * bool(words) + ["~"] * maker.chance(.15) + [edge(maker, place, aged=False)]
    return words


def predecessor(maker, place):
    form = maker.random.choice([["E"]] * 7 + [["E", "E"], ["E", "E", "E"], ["E", "<", "E"], ["E", ">", "E"], ["E", "<", "E", ">", "E"]])
    return [edge(maker, place, aged=False) if word == "E" else word for word in form]


def branches(maker, place):
    """One, or two that point away from each other."""
    random = maker.random
    if maker.chance(.3):
        turns = random.randint(1, 3)
        left, right = ["+"] * turns + [edge(maker, place)], ["-"] * turns + [edge(maker, place)]
        return random.choice([["[", "[", *left, "]", *right, "]"], ["[", *left, "]", "[", *right, "]"]])
    return ["[", *random.choices("+++---&^\\/", k=random.randint(1, 2)), *["~"] * maker.chance(.2), edge(maker, place), "]"]


def successor(maker, place):
    random, words = maker.random, []
    for _ in range(random.choice([1, 2, 2, 3])):
        for _ in range(random.choice([0, 0, 1, 1, 2])):
            words += branches(maker, place)
        way = random.choices("+-&^\\/", k=random.randint(1, 2)) if maker.chance(.25) else []
        words += [*way, *["~"] * maker.chance(.1), edge(maker, place), *[BACK[turn] for turn in reversed(way)]]
    if not place.sound and maker.chance(MISTAKE):
        words.insert(random.randrange(len(words) + 1), random.choice(["+", "~", "]", "<"]))
    return words


def symbols(maker, depth, place):
    words = {"seed": seed, "predecessor": predecessor, "successor": successor}[place.want or "successor"](maker, place)
    return listed(maker.grammar, "symbols", [symbol(maker, word) for word in words])


def symbol(maker, word):
    if word in SYMBOLS:
        return maker.node(f"symbol: {SYMBOLS[word]}")
    token = "OTHER_TURN" if word in BACK else "EDGE"
    return maker.node(f"symbol: {token}", maker.word(token, word))


CONTEXTS = {
    "line: symbols": {0: "seed"}, "line: symbols alternatives": {0: "predecessor"}, "alternative: ARROW symbols choice": {1: "successor"},
    "line: ANGLE NUMBER": {1: "angle"}, "line: BRANCH_ANGLE NUMBER": {1: "branch angle"}, "choice: WEIGHT NUMBER": {1: "weight"},
    "bound: NUMBER": {0: "age"}, "bound: MINUS NUMBER": {1: "age"},
}
NUMBERS = {"angle": ["90", "90", "60", "45", "30", "22.5", "36"], "branch angle": ["30", "60", "90", "120", "180"], "weight": ["1", "2", "0.5", "3"],
           "age": ["0", "1", "2"]}


class Systems(Notation):
    start = "file"
    depths = {"bound": 1}
    remade = ("line", "symbols", "alternative")
    hooks = {"symbols": symbols}

    def weight(self, production, context):
        if production.head == "choice":
            return float((production.name == "choice: %empty") if context.weighted is None else ("WEIGHT" in production.symbols) == context.weighted and bool(production.symbols))
        return {"bound: MINUS NUMBER": .5, "alternatives: alternatives alternative": 1 if context.weighted is not None else MISTAKE}.get(production.name, 1)

    def contexts(self, maker, production, context):
        return [context.but(want=CONTEXTS.get(production.name, {}).get(i)) for i in range(len(production.symbols))]

    def token(self, maker, token, context):
        return edge(maker, context) if token == "EDGE" else maker.random.choice(NUMBERS[context.want or "age"])


class SystemKind(Kind):
    name, grammar_file, suffix, notation = "hemls", "hemls.y", ".hemls", Systems()
    literals = {"END_OF_LINE": "\n"}

    def make_file(self, maker):
        return system(maker)

    def subject(self, path, folder, part, tree):
        return SystemSubject(path, folder, part, tree)

    def questions(self, path):
        return [(q, None) for q in QUICK], [(q, None) for q in OF_SYSTEMS]


def system(maker, sound=False):
    random = maker.random
    labels = tuple(random.choice([["A", "B", "C"], ["Edge0", "Edge1", "Edge2"]])[:random.randint(1, 3)])
    place = Place(labels, maker.chance(.3), sound=sound)
    lines = [maker.make_of("line: symbols", 1, place)]
    for _ in range(random.choice([1, 2, 2, 3])):
        weighted = random.choice([None, None, True, False] if place.timed else [None, None, None, True])
        lines.append(maker.make_of("line: symbols alternatives", 3, place.but(weighted=weighted)))
    lines += [maker.make_of(f"line: {word} NUMBER", 1, place) for word, share in (("ANGLE", 1 if sound else .9), ("BRANCH_ANGLE", .8)) if maker.chance(share)]
    lines += [maker.node(f"line: {word}") for word, share in (("SYNC", .4), ("EVEN", .2)) if maker.chance(share)]
    node = maker.node("lines: %empty")
    if maker.chance(.1):
        node = maker.node("lines: lines END_OF_LINE", node)
    for line in lines[:-1]:
        node = maker.node("lines: lines line END_OF_LINE", node, line)
    if maker.chance(.5):
        return maker.node("file: lines line", node, lines[-1])
    return maker.node("file: lines", maker.node("lines: lines line END_OF_LINE", node, lines[-1]))


HEMLS = SystemKind()
