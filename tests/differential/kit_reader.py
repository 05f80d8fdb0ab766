"""Reads .kit files, by a parser of its own. Lengths come out as cells; y points down, as in LDraw files."""
import functools
import math
import os
import re
from fractions import Fraction

from conditions import Conditions
from kind import ROOT

TOKEN = re.compile(r"""(?:\s|\#[^\n]*)*(?:(?P<code>\d+[A-Za-z][A-Za-z0-9]*)|(?P<number>\d+(?:\.\d+)?)
                       |(?P<word>[A-Za-z_]\w*(?:-+\w+)*)|(?P<text>"(?:\\.|[^"\\])*")|(?P<sign>\.\.|<=|>=|!=|[-+*/,;(){}\[\]|=<>]))""", re.X)
AXES = {"up": (0, -1, 0), "down": (0, 1, 0), "left": (-1, 0, 0), "right": (1, 0, 0), "front": (0, 0, -1), "back": (0, 0, 1)}
FIRST = ("use", "unit", "length", "connector", "part", "space", "rule", "model", "test")      # what later ones use, wherever it stands
SIZES = {"box": 3, "sphere": 1, "cylinder": 2, "mesh": 1, "heightmap": 3}


def beside(axis):
    """What points the same way in two connectors that are not turned against each other."""
    return AXES["up"] if axis[1] == 0 else AXES["right"]


class Part:
    def __init__(self):
        self.boxes, self.joints, self.mass, self.price, self.title = [], [], 0, 0, ""      # joints: (kind, place, axis)

    def volume(self):
        """In cells."""
        return sum(math.prod(h - l for l, h in zip(low, high)) for low, high in self.boxes)


class Placed:
    """A part of an alternative; the second and later ones have their place and turn from the first."""

    def __init__(self, name):
        self.name, self.colour, self.rules, self.stops, self.at, self.turn = name, None, [], False, (0, 0, 0), 0


class Model:
    def __init__(self, name):
        self.name, self.inside, self.starts, self.colour, self.requires = name, None, [], 1, []
        self.goal = self.search = self.symmetry = self.order = self.steps = None
        self.stock, self.lines = {}, []


class Kit(Conditions):
    """Of `laid_on`, the cells of a kit that uses this one, its parts and rules are in these."""

    def __init__(self, path, laid_on=None):
        self.laid_on, self.used = laid_on, []
        self.unit, self.turns, self.lengths, self.joins, self.kinds = None, 4, {}, set(), {}
        self.parts, self.spaces, self.rules, self.models, self.tests, self.statements = {}, {}, {}, {}, [], []
        with open(path, encoding="utf-8") as file:
            self.text = file.read()
        self.folder, self.tokens, self.at = os.path.dirname(path), list(found(self.text)), 0
        begins = list(self.begins())
        for begin in sorted(begins, key=lambda begin: FIRST.index(self.tokens[begin][1].lower())):
            self.at = begin + 1
            getattr(self, "read_" + self.tokens[begin][1].lower())()
        for begin, end in zip(begins, begins[1:] + [len(self.tokens)]):
            self.statements.append((self.tokens[begin][1].lower(), self.text[self.tokens[begin][2]:self.tokens[end - 1][3]]))

    def begins(self):
        """The first token of each statement: what follows a `;` that is in no brace, or the brace that closes a block."""
        depth, ended, block = 0, True, False
        for i, (_, text, _, _) in enumerate(self.tokens):
            if ended:
                block = text.lower() in ("part", "model", "test")
                yield i
            depth += (text == "{") - (text == "}")
            ended = depth == 0 and (text == ";" or text == "}" and block)

    # ---- tokens

    def ended(self):
        return self.at == len(self.tokens)

    def peek(self):
        return self.tokens[self.at][1] if not self.ended() else ""

    def is_text(self):
        return self.tokens[self.at][0] == "text"

    def next(self):
        self.at += 1
        return self.tokens[self.at - 1][1]

    def take(self, *words):
        if self.peek().lower() in words:
            return self.next().lower()
        return None

    def name(self):
        text = self.next()
        return unquoted(text) if text[0] == '"' else text

    def doc(self):
        return unquoted(self.next()) if self.is_text() else ""

    def whole(self):
        return int(self.next())

    # ---- statements

    def read_use(self):
        name = unquoted(self.next())
        own = os.path.join(self.folder, name)
        path = own if os.path.exists(own) else os.path.join(ROOT, "stdlib", name + ".kit")
        self.used.append(path)
        self.take_over(kit_that_is_used(path, self.laid_on))
        self.take(";")

    def take_over(self, used):
        self.unit, self.turns = used.unit or self.unit, used.turns if used.unit else self.turns
        for mine, theirs in ((self.lengths, used.lengths), (self.kinds, used.kinds), (self.parts, used.parts), (self.spaces, used.spaces), (self.rules, used.rules)):
            mine.update(theirs)
        self.joins |= used.joins

    def read_unit(self):
        """The cells also of the kits that are used."""
        own = self.laid_on or tuple(self.sizes())
        while self.peek() not in ("turns", ";"):
            self.next()
        turns = self.whole() if self.take("turns") else 4
        for path in self.used:
            self.take_over(kit_that_is_used(path, own))
        self.unit, self.turns = own, turns
        self.take(";")

    def sizes(self):
        """In LDU, with an x between them."""
        made = [self.ldu()]
        while self.take("x"):
            made.append(self.ldu())
        return made

    def ldu(self):
        sign = -1 if self.take("-") else 1
        value = sign * Fraction(self.next())
        if not self.ended() and self.tokens[self.at][0] == "word" and self.peek().lower() != "x" and self.length_of(self.peek()) is not None:
            value *= self.length_of(self.next())
        return value

    def length_of(self, word):
        known = {**self.lengths, "mm": Fraction(5, 2), "LDU": Fraction(1), "ldu": Fraction(1)}
        return known.get(word, known.get(word[:-1]) if word.endswith("s") else None)

    def vector(self):
        """In LDU; y up, as it is written."""
        self.next()
        made = [self.ldu()]
        while self.take(","):
            made.append(self.ldu())
        self.next()
        return made

    def cell(self):
        """A vector in cells, y down."""
        x, y, z = self.vector()
        return x / self.unit[0], -y / self.unit[1], z / self.unit[2]

    def read_length(self):
        name = self.next()
        self.next()
        self.lengths[name] = self.ldu()
        self.take(";")

    def read_connector(self):
        name = self.next()
        self.next()
        other, turns, every = self.next(), 4, None
        while word := self.take("turns", "every"):
            if word == "turns":
                turns = self.whole()
            else:
                every = self.ldu()
        self.kinds[name] = (turns, every)
        self.joins |= {(name, other), (other, name)}
        self.take(";")

    def read_part(self):
        name, part = self.name(), Part()
        part.title = self.doc()
        if self.take("from"):
            self.next()
            self.from_file(part, unquoted(self.next()))
        filled = False
        if self.take("{"):
            while not self.take("}"):
                filled = self.feature(part, filled)
                self.take(";")
        self.take(";")
        self.parts[name] = part

    def from_file(self, part, name):
        """Of the one file that lies beside: a box of 40 x 24 x 20 with two studs."""
        unit = self.unit
        part.boxes = [(tuple(int(v / u) for v, u in zip((-20, 0, -10), unit)), tuple(int(v / u) for v, u in zip((20, 24, 10), unit)))]
        part.joints = [("stud", (x / unit[0], Fraction(0), Fraction(0)), AXES["up"]) for x in (Fraction(-10), Fraction(10))]

    def feature(self, part, filled):
        word = self.next()
        if word.lower() in ("mass", "price"):
            setattr(part, word.lower(), float(self.next()))
        elif word.lower() in ("fill", "slope"):
            if not filled:
                part.boxes = []
            self.box(part, [] if word.lower() == "fill" else [AXES[self.next().lower()], AXES[self.next().lower()]])
            return True
        else:
            self.connectors(part, word)
        return filled

    def box(self, part, sides):
        size, at = [s / u for s, u in zip(self.sizes(), self.unit)], (0, 0, 0)
        while self.take("at"):
            at = self.cell()
        low = (at[0] - size[0] / 2, at[1], at[2] - size[2] / 2)
        corners = tuple(map(int, low)), tuple(int(l + s) for l, s in zip(low, size))
        part.boxes += [corners] if not sides else [(cell, tuple(c + 1 for c in cell)) for cell in left_of(corners, sides)]

    def connectors(self, part, word):
        kind = word if word in self.kinds else word[:-1]
        axis, counts, at = AXES[self.next().lower()], (1, 1), (Fraction(0),) * 3
        while self.peek() != ";":
            if self.take("at"):
                at = self.cell()
            else:
                counts = self.whole(), (self.take("x"), self.whole())[1]
        part.joints += [(kind, place, axis) for place in self.grid(kind, axis, counts, at)]

    def grid(self, kind, axis, counts, at):
        """Places from the low corner on, or from the high one; the first side goes on first. Rows lie across the axis."""
        across = (2 if axis[0] else 0, 1 if axis[1] == 0 else 2)
        every = self.kinds[kind][1] or 0
        way = 1 if axis in (AXES["up"], AXES["right"], AXES["back"]) else -1
        for j in range(counts[1]):
            for i in range(counts[0]):
                place = list(at)
                for k, n, count in ((across[0], i, counts[0]), (across[1], j, counts[1])):
                    upward = -1 if k == 1 else 1
                    place[k] += upward * way * (n - Fraction(count - 1, 2)) * every / self.unit[k]
                yield tuple(place)

    def read_space(self):
        name = self.next()
        self.next()
        self.spaces[name] = self.space()
        self.take(";")

    # ---- spaces: (kind, ...) in LDU, y up

    def space(self, least=0):
        """`or` binds least, then `and`, `not`, and what moves a space."""
        if self.take("not"):
            made = ("not", self.space(2))
        elif self.take("("):
            made = self.space()
            self.next()
        else:
            made = self.shape()
        while True:
            if least <= 3 and self.take("turn"):
                made = ("turn", made, self.whole())
            elif least <= 3 and self.take("repeat"):
                count = self.whole()
                self.next()
                made = ("repeat", made, count, self.vector())
            elif least <= 3 and self.take("at"):
                made = ("at", made, self.vector())
            elif least <= 1 and self.take("and"):
                made = ("and", made, self.space(2))
            elif least <= 0 and self.take("or"):
                made = ("or", made, self.space(1))
            else:
                return made

    def shape(self):
        name = self.next()
        if self.peek() != "(":
            return "named", self.spaces, name
        self.next()
        file, sizes = self.doc(), []
        if file and self.take("x", "y", "z"):
            self.next()
        while not self.take(")"):
            if self.take(","):
                continue
            if self.tokens[self.at][0] == "word":
                self.next()
            sizes.append(self.ldu())
        return (name.lower(), file, *sizes) if file else (name.lower(), *sizes)

    # ---- rules

    def read_rule(self):
        name = self.next()
        self.next()
        kinds = [self.next()]
        while self.take(","):
            kinds.append(self.next())
        self.next()
        alternatives = [self.alternative()]
        while self.take("|"):
            alternatives.append(self.alternative())
        self.rules[name] = (kinds, alternatives)
        self.take(";")

    def alternative(self):
        """("places", [Placed ...]) or ("drawn", [(Placed, weight) ...])"""
        if self.take("{"):
            made = []
            while not self.take("}"):
                self.take(",")
                if self.peek() != "}":
                    made.append(self.placed())
            return "places", made
        if self.take("("):
            drawn = []
            while not self.take(")"):
                self.take("|")
                one = self.placed()
                self.next()
                drawn.append((one, float(self.next())))
                self.next()
            return "drawn", drawn
        return "places", [self.placed()]

    def placed(self):
        made = Placed(self.name())
        while word := self.take("in", "with", "stop", "at", "turn"):
            if word == "in":
                made.colour = self.whole()
            elif word == "with":
                made.rules.append(self.next())
            elif word == "stop":
                made.stops = True
            elif word == "at":
                made.at = self.cell()
            else:
                made.turn = self.whole()
        return made

    # ---- models

    def read_model(self):
        model = Model(self.next())
        self.doc()
        self.next()
        while not self.take("}"):
            begin, word = self.tokens[self.at][2], self.next().lower()
            getattr(self, "line_" + word)(model)
            model.lines.append((word, self.text[begin:self.tokens[self.at - 1][3]]))
            self.take(";")
        self.models[model.name] = model

    def line_inside(self, model):
        model.inside = self.space()

    def line_start(self, model):
        if self.is_text():
            start = (unquoted(self.next()),)
        else:
            kind = self.next()
            axis = AXES["up"] if self.peek().lower() == "at" else AXES[self.next().lower()]
            self.next()
            start = (kind, axis, self.cell(), self.whole() if self.take("turn") else 0)
        self.next()
        model.starts.append((*start, self.next()))

    def line_colour(self, model):
        model.colour = self.whole()

    def line_require(self, model):
        model.requires += self.conditions()

    def line_minimize(self, model):
        model.goal = (-1, self.expression())

    def line_maximize(self, model):
        model.goal = (1, self.expression())

    def line_search(self, model):
        model.search = self.next().lower()
        if self.peek() != ";":
            self.next()

    def line_symmetry(self, model):
        model.symmetry = self.next().lower(), self.next().lower()

    def line_order(self, model):
        model.order = self.next().lower()

    def line_steps(self, model):
        model.steps = self.next().lower()

    def line_stock(self, model):
        while self.peek() != ";":
            name = self.name()
            self.next()
            model.stock[name] = min(self.whole(), model.stock.get(name, 1 << 60))
            self.take(",")

    def read_test(self):
        name = self.next()
        self.next()
        self.next()
        self.tests.append((name, self.conditions()))
        self.take(";")
        self.take("}")

    # ---- conditions: (sign, operands...), a number, or a term's name

    def conditions(self):
        made = [self.expression()]
        while self.take(","):
            made.append(self.expression())
        return made

    def signed(self):
        if self.take("-"):
            return ("negative", self.signed())
        if self.take("("):
            inner = self.expression()
            self.next()
            return inner
        if self.tokens[self.at][0] == "number":
            return float(self.next())
        name = self.next()
        if not self.take("("):
            return name.lower()
        if name.lower() == "count":
            counted = ("count", self.name())
            self.next()
            return counted
        parts = []
        while not self.take(")"):
            self.take(",")
            parts.append(self.expression())
        return (name.lower(), *parts)


@functools.lru_cache(maxsize=32)
def read_from_library(path, laid_on):
    return Kit(path, laid_on)


def kit_that_is_used(path, laid_on):
    return (read_from_library if path.startswith(ROOT) else Kit)(path, laid_on)


def left_of(corners, sides):
    """The cells of a box of which more than half is left where the corner between two sides is cut off."""
    low, high = corners
    for x in range(low[0], high[0]):
        for y in range(low[1], high[1]):
            for z in range(low[2], high[2]):
                shares = [[Fraction(2 * (c - l) + 1, 2 * (h - l)) for c, l, h in zip((x, y, z), low, high)] for _ in sides]
                toward = [share[k] if side[k] > 0 else 1 - share[k] for share, side in zip(shares, sides) for k in range(3) if side[k]]
                if sum(toward) < 1:
                    yield x, y, z


def unquoted(text):
    return re.sub(r"\\(.)", r"\1", text[1:-1])


def found(text):
    """(kind, text, begin, end) of each token."""
    at = 0
    while match := TOKEN.match(text, at):
        yield match.lastgroup, match[match.lastgroup], match.start(match.lastgroup), match.end()
        at = match.end()
