"""What connection grammars are about, beside their grammar: steps that stay in a small space, and symbols that end."""
from dataclasses import dataclass, replace

from kind import Kind
from maker import Notation
from pcfg_questions import OF_GRAMMARS, QUICK, GrammarSubject
from tree import listed

SYMBOLS = ["Wall", "brick", "A1", "x/y", "Top-out", "S^", "größe"]
BOUNDS = ["'PlaceBoundingBox(4,4,4)'", "'PlaceBoundingBox(6,3,5)'", '"PlaceBoundingSphere(6)"', "'PlaceBoundingBox(3,6,3)'"]


@dataclass(frozen=True)
class Place:
    """`symbols` are those of the file; `head` is the one that a line is of; `drawn`: alternatives have probabilities."""
    symbols: tuple
    head: str = None
    share: str = None                # the probability of an alternative
    last: bool = False               # does its line end with it?

    def but(self, **changes):
        return replace(self, **changes)


def terminal(maker, place):
    random, quote = maker.random, maker.random.choice("''\"")
    kind = random.randrange(12)
    if kind < 4:
        text = "Move(%d,%d,%d)" % tuple(random.randint(-3, 3) for _ in range(3))
    elif kind < 6:
        text = "FillRect(%d,%d,%d)" % (random.choice([1, 2, 2, 4]), random.randint(1, 3), random.choice([2, 2, 3, 4]))
    elif kind == 6:
        text = "FillRectNoCheck(%d,%d,%d)" % (random.randint(-2, 4), random.randint(0, 3), random.randint(1, 4))
    elif kind == 7:
        text = "Rotate(%d)" % (90 * random.randint(-4, 8) + random.choice((0, 0, 45)))
    elif kind == 8:
        text = random.choice(("AssertFilled()", "SetColor(%d)" % random.randint(-2, 300)))
    else:
        text = random.choice(["PlaceBoundingBox(2,3,2)", "PlaceBoundingSphere(5)"]) if kind == 9 and maker.chance(.1) else "Place(%s)" % random.choice(PARTS)
    return quote + text + quote


PARTS = ["3001", "3005", "post", "brick", "7b"]


def alternative(maker, depth, place):
    """Steps with a symbol behind some of them, perhaps in parentheses; the published program fails where two symbols follow each other."""
    if place.last and place.share is None and maker.chance(.3):
        return maker.node("alternative: %empty")
    node = maker.node("alternative: %empty")
    for token, text in items(maker, place, depth):
        node = maker.node(f"alternative: alternative {token}", node, maker.word(token, text))
    if place.share is not None:
        node = maker.node("alternative: alternative PROBABILITY", node, maker.word("PROBABILITY", place.share))
    return node


def items(maker, place, depth):
    made = []
    for _ in range(maker.random.randint(1, 3)):
        made.append(("TERMINAL", terminal(maker, place)))
        if maker.chance(.45):
            made.append(("NAME", maker.random.choice(place.symbols)))
    if depth > 0 and maker.chance(.5):
        made = [("TERMINAL", "'('"), *made, ("TERMINAL", "')'")]
        if maker.chance(.4):
            made += items(maker, place, depth - 1)
    return made


def alternatives(maker, depth, place):
    """Tried in their order; or drawn, where their probabilities sum to 1."""
    count = maker.random.choice([1, 1, 2, 3])
    shares = [None] * count
    if maker.chance(.25):
        shares = {1: ["[1]"], 2: maker.random.choice([["[.25]", "[.75]"], ["[0.5]", "[.5]"], ["[0]", "[1]"], ["[.5]", "[.4]"]]), 3: ["[.5]", "[.25]", "[.25]"]}[count]
    made = [maker.make("alternative", depth - 1, place.but(share=share, last=i == count - 1)) for i, share in enumerate(shares)]
    return listed(maker.grammar, "alternatives", made)


class Grammars(Notation):
    start = "lines"
    remade = ("alternative", "alternatives", "line")
    hooks = {"alternative": alternative, "alternatives": alternatives}

    def token(self, maker, token, context):
        return context.head or context.symbols[0]


class GrammarKind(Kind):
    name, grammar_file, suffix, notation = "pcfg", "pcfg.y", ".pcfg", Grammars()
    literals = {"ARROW": "->", "BAR": "|", "LINE": "\n"}

    def make_file(self, maker):
        random = maker.random
        symbols = tuple(random.sample(SYMBOLS, random.randint(1, 4)))
        place = Place(symbols)
        lines = [first(maker, place)]
        for symbol in symbols:
            lines.append(maker.make_of("line: NAME ARROW alternatives", random.choice([1, 2, 3]), place.but(head=symbol)))
            if maker.chance(.3):
                lines.append(maker.make_of("line: NAME ARROW alternatives", 2, place.but(head=symbol)))
            if maker.chance(.5):
                lines.append(maker.node("line: NAME ARROW alternatives", maker.word("NAME", symbol), empty(maker)))
            if maker.chance(.1):
                lines.append(maker.node("line: %empty"))
        return lines_of(maker, lines)

    def subject(self, path, folder, part, tree):
        return GrammarSubject(path, folder, part, tree)

    def questions(self, path):
        return [(q, None) for q in QUICK], [(q, None) for q in OF_GRAMMARS]


def empty(maker):
    return listed(maker.grammar, "alternatives", [maker.node("alternative: %empty")])


def first(maker, place):
    """What the grammar begins with: a bound, mostly, and some symbols."""
    node = maker.node("alternative: %empty")
    texts = [("TERMINAL", maker.random.choice(BOUNDS))] * maker.chance(.85)
    for symbol in maker.random.choices(place.symbols, k=maker.random.randint(1, 3)):
        texts += [("TERMINAL", terminal(maker, place)), ("NAME", symbol)]
    for token, text in texts:
        node = maker.node(f"alternative: alternative {token}", node, maker.word(token, text))
    return maker.node("line: NAME ARROW alternatives", maker.word("NAME", "Start"), listed(maker.grammar, "alternatives", [node]))


def lines_of(maker, lines):
    node = maker.node("lines: line", lines[0])
    for line in lines[1:]:
        node = maker.node("lines: lines LINE line", node, line)
    return node


PCFG = GrammarKind()
