"""Reads .solid files: boxes with their faces and planes, settings, and expressions as trees. Its numbers are exact."""
import copy
import math
import os
import re
from fractions import Fraction

from kind import ROOT

TOKEN = re.compile(r"""(?:\s|\#[^\n]*)*(?:(?P<length>\d+(?:\.\d+)?(?:mm|cm|m)\b|\d+'(?:-?\d+(?:\.\d+)?")?|\d+")|(?P<number>\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)
                       |(?P<word>[A-Za-z_]\w*(?:-+\w+)*)|(?P<text>"(?:\\.|[^"\\])*")|(?P<sign>\.\.|<=|>=|!=|[-+*/,;(){}=<>]))""", re.X)
METRES = {"mm": Fraction(1, 1000), "cm": Fraction(1, 100), "m": Fraction(1)}
LEVELS = [{"or"}, {"and"}, {"<", "<=", "=", "!=", ">=", ">", "in"}, {"+", "-"}, {"*", "/"}]


class Box:
    """As it is written. `plane` is None, ("angles", distance, a, b) or ("normal", normal, point)."""

    def __init__(self, name, low, high, plane, rigid, genes):
        self.name, self.low, self.high, self.plane, self.rigid, self.genes = name, low, high, plane, rigid, genes

    def text(self, name=None):
        """As a statement, by its corners."""
        plane = ""
        if self.plane and self.plane[0] == "angles":
            plane = " clip {} angles {}, {}".format(*map(decimal, self.plane[1:]))
        elif self.plane:
            plane = f" clip normal {triple(self.plane[1])} through {triple(self.plane[2])}"
        return f"  box {name or self.name} from {triple(self.low)} to {triple(self.high)}{plane}{' rigid' if self.rigid else ''};\n"


def decimal(number):
    """Exactly: all that files have are decimals and what is a sum or half of them."""
    number = Fraction(number)
    digits = 0
    while (number * 10**digits).denominator != 1:
        digits += 1
    whole = abs(number.numerator * 10**digits // number.denominator)
    text = str(whole).rjust(digits + 1, "0")
    text = text[:-digits] + "." + text[-digits:] if digits else text
    return "-" + text if number < 0 else text


def triple(numbers):
    return "(" + ", ".join(map(decimal, numbers)) + ")"


class Design:
    """Its boxes, and those of the design that it begins with. `settings` has symmetry, flat, noclip, correct, unit and model."""

    def __init__(self, name, base):
        self.name, self.base = name, base
        self.boxes = list(base.boxes) if base else []
        self.settings = dict(base.settings) if base else {}
        self.model, self.depth = (base.model, base.depth) if base else (None, None)
        self.measures, self.requirements = [], list(base.requirements) if base else []

    def settings_text(self, *without):
        return "".join(f"  {text}\n" for word, text in self.settings.items() if word not in without)

    @property
    def axes(self):
        return re.findall(r"\b[xyz]\b", self.settings.get("symmetry", ""))


class Reader:
    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            self.text = file.read()
        self.folder, self.at, self.tokens, self.designs, self.own = os.path.dirname(path), 0, [], {}, []
        at = 0
        while match := TOKEN.match(self.text, at):
            self.tokens.append((match.lastgroup, match[match.lastgroup], match.start(match.lastgroup), match.end()))
            at = match.end()
        while self.at < len(self.tokens):
            self.item()

    def peek(self, ahead=0):
        return self.tokens[self.at + ahead][1] if self.at + ahead < len(self.tokens) else ""

    def next(self):
        self.at += 1
        return self.tokens[self.at - 1][1]

    def take(self, text):
        if self.peek() != text:
            return False
        self.at += 1
        return True

    def item(self):
        if self.next() == "use":
            name = self.next()[1:-1]
            beside = os.path.join(self.folder, name)
            self.designs.update(Reader(beside if os.path.exists(beside) else os.path.join(ROOT, "stdlib", name + ".solid")).designs)
            self.next()
            return
        name = self.next()
        if self.peek().startswith('"'):
            self.next()
        base = None
        if self.take("from"):
            base = self.designs[self.next()]
        design = self.designs[name] = Design(name, base)
        self.own.append(name)
        self.next()
        self.settings(design)
        if base and design.depth != base.depth:
            design.boxes = [flattened(design, copy.copy(box)) for box in base.boxes]
        while not self.take("}"):
            self.statement(design)

    def settings(self, design):
        """Of what kind numbers are, and how deep a flat design is, which its boxes need to know wherever it stands."""
        begin = self.at
        for word in ("model", "flat"):
            self.at = begin
            while self.peek() not in ("}", word):
                self.next()
            if self.take("model"):
                design.model = self.next()
            elif self.take("flat"):
                design.depth = self.number(design)
        self.at = begin

    def statement(self, design):
        begin, word = self.tokens[self.at][2], self.next()
        if word == "box":
            design.boxes.append(self.box(design))
        elif word == "genes":
            design.boxes.append(self.genes(design))
        elif word in ("measure", "require"):
            (design.measures if word == "measure" else design.requirements).extend(self.expressions())
        elif word == "fitness":
            while self.peek() != ";":
                self.next()
        else:
            while self.peek() != ";":
                self.next()
            design.settings[word] = self.text[begin:self.tokens[self.at][3]]
        self.next()

    # ---- boxes

    def box(self, design):
        name = self.next()
        if self.tokens[self.at][0] == "text":
            self.next()
        low = high = centre = size = plane = None
        rigid = False
        while self.peek() != ";":
            word = self.next()
            if word == "from":
                low, _, high = self.vector(design), self.next(), self.vector(design)
            elif word == "at":
                centre = self.vector(design)
            elif word == "size":
                size = self.vector(design)
            elif word == "rigid":
                rigid = True
            elif self.take("normal"):
                plane = "normal", self.vector(design), (self.next(), self.vector(design))[1]
            else:
                distance, _, a, _, b = self.number(design), self.next(), self.number(design), self.next(), self.number(design)
                plane = "angles", distance, a, b
        if centre:
            low, high = [c - s / 2 for c, s in zip(centre, size)], [c + s / 2 for c, s in zip(centre, size)]
        return flattened(design, Box(name, low, high, plane, rigid, False))

    def genes(self, design):
        self.next()
        numbers = []
        while not self.take(")"):
            numbers.append(self.number(design))
            self.take(",")
        low = [c - abs(s) / 2 for c, s in zip(numbers[:3], numbers[3:6])]
        high = [c + abs(s) / 2 for c, s in zip(numbers[:3], numbers[3:6])]
        plane = ("angles", *numbers[6:9])
        return flattened(design, Box(f"gene-{len(design.boxes) + 1}", low, high, plane, self.take("rigid"), True))

    def vector(self, design):
        self.next()
        made = []
        while not self.take(")"):
            made.append(self.number(design))
            self.take(",")
        return made

    def number(self, design):
        sign = -1 if self.take("-") else 1
        kind, text = self.tokens[self.at][:2]
        self.at += 1
        if kind == "number":
            return sign * Fraction(text)
        return sign * metres_of(text) / METRES[design.model]

    # ---- expressions: (operation, operands...), numbers and names

    def expressions(self):
        made = [self.expression(0)]
        while self.take(","):
            made.append(self.expression(0))
        return made

    def expression(self, level):
        """An expression and how it is written."""
        begin = self.tokens[self.at][2]
        tree = self.level(level)
        return tree, self.text[begin:self.tokens[self.at - 1][3]]

    def level(self, level):
        if level == len(LEVELS):
            return self.signed()
        left = self.level(level + 1)
        while self.peek() in LEVELS[level]:
            sign = self.next()
            if sign == "in":                             # what stands between `in` and `..` is whole
                middle, _ = self.level(0), self.next()
                left = (sign, left, middle, self.level(level + 1))
            else:
                left = (sign, left, self.level(level + 1))
        return left

    def signed(self):
        if self.take("-"):
            return "negative", self.signed()
        if self.take("not"):                             # of all behind it that binds more tightly, wherever it stands
            return "not", self.level(2)
        kind, text = self.tokens[self.at][:2]
        self.at += 1
        if kind == "number":
            return float(text)
        if text == "(":
            inner = self.level(0)
            self.next()
            return inner
        if not self.take("("):
            return text
        arguments = [self.level(0)]
        while self.take(","):
            arguments.append(self.level(0))
        self.next()
        return (text, *arguments)


def flattened(design, box):
    """In a flat design, from half its depth below 0 to half its depth above; the planes of genes are upright."""
    if design.depth is not None:
        if box.genes:
            box.plane = ("angles", box.plane[1], 90, box.plane[3])
        box.low, box.high = [*box.low[:2], -design.depth / 2], [*box.high[:2], design.depth / 2]
    return box


def metres_of(text):
    if text[-1] == "m":
        digits = re.match(r"[\d.]+", text)[0]
        return Fraction(digits) * METRES[text[len(digits):]]
    feet, _, inches = text.rpartition("'") if "'" in text else ("0", "", text)
    return (Fraction(feet) * 12 + Fraction(inches.strip('-"') or 0)) * Fraction(254, 10000)


def value_of(tree, measures):
    """Of an expression; what has no value is not a number."""
    if isinstance(tree, float):
        return tree
    if isinstance(tree, str):
        return float(measures[tree])
    operands = [value_of(part, measures) for part in tree[1:]]
    if any(operand != operand for operand in operands):
        return math.nan
    try:
        return float(OPERATIONS[tree[0]](*operands))
    except (ValueError, ZeroDivisionError):
        return math.nan
    except OverflowError:
        return math.inf


def quotient(a, b):
    return a / b if b else math.nan if a == 0 else math.copysign(math.inf, a) * math.copysign(1, b)


OPERATIONS = {
    "negative": lambda a: -a, "not": lambda a: a == 0, "or": lambda a, b: a != 0 or b != 0, "and": lambda a, b: a != 0 and b != 0,
    "+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b, "/": quotient, "<": lambda a, b: a < b, "<=": lambda a, b: a <= b,
    "=": lambda a, b: a == b, "!=": lambda a, b: a != b, ">=": lambda a, b: a >= b, ">": lambda a, b: a > b, "in": lambda a, b, c: b <= a <= c,
    "abs": abs, "sqrt": math.sqrt, "square": lambda a: a * a, "exp": math.exp, "log": lambda a: -math.inf if a == 0 else math.log(a), "sin": math.sin,
    "cos": math.cos, "tanh": math.tanh, "min": min, "max": max,
}


def read_solids(path):
    """(all designs by their names, the names of the file's own)"""
    reader = Reader(path)
    return reader.designs, reader.own
