"""Reads .study files, by a parser of its own, and evaluates what they say of measures."""
import math
import re

from conditions import Conditions

TOKEN = re.compile(r"""(?:\s|\#[^\n]*)*(?:(?P<word>[A-Za-z_]\w*(?:-+\w+)*)|(?P<number>[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)|(?P<text>"(?:\\.|[^"\\])*")
                       |(?P<sign>\.\.|<=|>=|!=|[-+*/,()=<>]))""", re.X)


class Study(Conditions):
    """`statements` has (word, text) of each; `settings` numbers by word; forces, boundaries and goals as they are needed."""

    def __init__(self, text):
        self.text, self.at, self.in_expression = text, 0, False
        self.statements, self.settings, self.forces, self.walls, self.goals, self.requirements, self.flags = [], {}, [], [], [], [], set()
        self.kind = self.token = None
        self.advance()
        while self.kind:
            self.statement()

    # ---- tokens; signs of numbers are part of them but in expressions

    def advance(self):
        self.before, self.end = self.at, self.at
        found = TOKEN.match(self.text, self.at)
        if not found:
            self.kind, self.token = None, ""
            return
        self.kind, self.token, self.begin, self.at = found.lastgroup, found[found.lastgroup], found.start(found.lastgroup), found.end()
        if self.in_expression and self.kind == "number" and self.token[0] in "+-":
            self.kind, self.token, self.at = "sign", self.token[0], self.begin + 1

    def next(self):
        token = self.token
        self.advance()
        return token

    def take(self, *words):
        return self.next().lower() if self.token.lower() in words and self.kind in ("word", "sign") else None

    def number(self):
        return float(self.next())

    def vector(self):
        opened, numbers = self.take("("), []
        while len(numbers) < 3:
            self.take(",")
            numbers.append(self.number())
        if opened:
            self.next()
        return numbers

    def statement(self):
        begin, word = self.begin, self.token.lower()
        self.in_expression = word == "require"
        self.advance()
        if word in ("use", "title", "rules", "distance-to"):
            self.settings[word] = self.next()[1:-1]
        elif word == "scale":
            several = self.token == "(" or re.match(r"\s*[-+,.\d]", self.text[self.at:])
            self.settings[word] = self.vector() if several else [self.number()] * 3
        elif word in ("start", "sun"):
            self.settings[word] = self.vector()
        elif word == "gravity":
            self.forces.append(("gravity", self.vector()))
        elif word in ("attractor", "repeller"):
            self.force(word)
        elif word == "boundary":
            self.wall()
        elif word == "fitness":
            self.goal()
        elif word == "require":
            self.requirements.append(self.expression())
        elif word in ("fixed-centre", "fixed-perimeter", "facing", "mirror"):
            self.flags.add(word)
        else:
            self.settings[word] = self.number()
        self.in_expression = False
        self.statements.append((word, self.text[begin:self.before].strip()))

    def force(self, word):
        self.next()
        at, strength, exponent = self.vector(), 1.0, 2.0
        while part := self.take("strength", "exponent"):
            if part == "strength":
                strength = self.number()
            else:
                exponent = self.number()
        self.forces.append((word, at, strength, exponent))

    def wall(self):
        kind = self.next().lower()
        if kind == "mesh":
            shape = [kind, self.next()]
        else:
            self.next()
            first = self.vector()
            self.next()
            shape = [kind, first, self.number() if kind == "sphere" else self.vector()]
        inside, mode = False, "slide"
        while part := self.take("inside", "outside", "slide", "stop", "soft"):
            inside, mode = (part == "inside", mode) if part in ("inside", "outside") else (inside, part)
        self.walls.append((*shape, inside, mode))

    def goal(self):
        if self.take("raw"):
            self.flags.add("raw")
            return
        name, expression, parts = self.next(), None, {"target": 0.0, "weight": 1.0}
        if self.token == "=":
            self.in_expression = True
            self.advance()
            expression = self.expression()
            self.in_expression = False
        while part := self.take("target", "weight"):
            parts[part] = self.number()
        self.goals.append((name, expression, parts["target"], parts["weight"]))

    # ---- expressions

    def signed(self):
        if self.take("-"):
            return ("negative", self.signed())
        if self.take("("):
            inner = self.expression()
            self.next()
            return inner
        if self.kind == "number":
            return self.number()
        name = self.next().lower()
        if not self.take("("):
            return name
        parts = [self.expression()]
        while self.take(","):
            parts.append(self.expression())
        self.next()
        return (name, *parts)


def value_of(expression, terms):
    """A number; NaN where there is none; KeyError of a term that is not known here."""
    if isinstance(expression, float):
        return expression
    if isinstance(expression, str):
        return terms[expression]
    values = [value_of(part, terms) for part in expression[1:]]
    if any(v != v for v in values):
        return math.nan
    try:
        return float(SIGNS[expression[0]](*values))
    except OverflowError:
        return math.inf
    except ValueError:
        return math.nan


def divided(a, b):
    if b:
        return a / b
    return math.nan if a == 0 else math.copysign(math.inf, a) * math.copysign(1, b)


def logarithm(a):
    return math.log(a) if a > 0 else -math.inf if a == 0 else math.nan


SIGNS = {
    "+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b, "/": divided, "negative": lambda a: -a, "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b, "=": lambda a, b: a == b, "!=": lambda a, b: a != b, ">=": lambda a, b: a >= b, ">": lambda a, b: a > b,
    "in": lambda a, b, c: b <= a <= c, "and": lambda a, b: a != 0 and b != 0, "or": lambda a, b: a != 0 or b != 0, "not": lambda a: a == 0,
    "abs": abs, "sqrt": math.sqrt, "square": lambda a: a * a, "min": min, "max": max, "exp": math.exp, "log": logarithm, "sin": math.sin, "cos": math.cos,
    "tanh": math.tanh,
}
