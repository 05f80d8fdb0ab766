"""Reads .field files, by a parser of its own: what precedes what is not taken from the grammar that files are made by."""
import os
import re

from kind import ROOT

TOKEN = re.compile(r"""(?:\s|\#[^\n]*)*(?:(?P<number>(?:\d+(?:\.\d+)?|\.\d+)(?:[eE][-+]?\d+)?)|(?P<word>[A-Za-z_]\w*)
                       |(?P<text>"(?:\\.|[^"\\])*")|(?P<sign>\.\.|[-+*/%^(),=]))""", re.X)
HEADS = {"use", "let", "fn", "surface", "box", "grid", "unit"}


class Formula:
    """`kind` is number, name, call, distance, at, negative, or the sign of an operation; `of` what it is of, or the number or name;
    `parts` its operands, of `at` the three coordinates and then the form; `text` how it is written."""
    __slots__ = ("kind", "of", "parts", "text")

    def __init__(self, kind, of, parts, text):
        self.kind, self.of, self.parts, self.text = kind, of, parts, text

    def all(self):
        yield self
        for part in self.parts:
            yield from part.all()


class Definition:
    def __init__(self, params, body):
        self.params, self.body = params, body


class Fields:
    """What a file defines, and what it uses of others. `statements` has (word, text) of each of its own."""

    def __init__(self, path):
        self.definitions, self.surfaces, self.statements = {}, {}, []
        self.corners, self.grid, self.unit = None, 50, None      # formulas of the box's corners
        with open(path, encoding="utf-8") as file:
            self.reader = Reader(file.read())
        self.folder, self.bare = os.path.dirname(path), self.reader.word() not in HEADS
        if self.bare:
            self.surface(os.path.splitext(os.path.basename(path))[0], Definition((), self.reader.sum()))
        while not self.reader.ended():
            begin, word = self.reader.begin(), self.reader.word()
            getattr(self, "read_" + word)(self.reader)
            self.statements.append((word, self.reader.text_from(begin)))

    def surface(self, name, definition):
        self.definitions[name] = self.surfaces[name] = definition

    def read_use(self, reader):
        reader.next()
        name = reader.next()[1:-1]
        beside = os.path.join(self.folder, name)
        used = Fields(beside if os.path.exists(beside) else os.path.join(ROOT, "stdlib", name + ".field"))
        self.definitions.update(used.definitions)

    def read_let(self, reader):
        name = self.head(reader)
        self.definitions[name] = Definition((), self.body(reader))

    def read_surface(self, reader):
        name = self.head(reader)
        self.surface(name, Definition((), self.body(reader)))

    def read_fn(self, reader):
        name, params = self.head(reader), []
        while reader.next() != ")":
            params.append(reader.next())
        self.definitions[name] = Definition(tuple(params), self.body(reader))

    def read_box(self, reader):
        reader.next()
        low = reader.arguments()
        reader.next()
        self.corners = low, reader.arguments()

    def read_grid(self, reader):
        reader.next()
        self.grid = int(float(reader.next()))

    def read_unit(self, reader):
        reader.next()
        self.unit = reader.next()

    @staticmethod
    def head(reader):
        reader.next()
        return reader.next()

    @staticmethod
    def body(reader):
        while reader.next() != "=":
            pass
        return reader.sum()


class Reader:
    def __init__(self, text):
        self.text, self.at, self.tokens = text, 0, list(found(text))

    def ended(self):
        return self.at == len(self.tokens)

    def peek(self):
        return self.tokens[self.at][1] if not self.ended() else ""

    def word(self):
        return self.peek().lower()

    def next(self):
        self.at += 1
        return self.tokens[self.at - 1][1]

    def begin(self):
        return self.tokens[self.at][2]

    def text_from(self, begin):
        return self.text[begin:self.tokens[self.at - 1][3]]

    def made(self, begin, kind, of, *parts):
        return Formula(kind, of, parts, self.text_from(begin))

    def sum(self):
        return self.chain(self.product, "+-")

    def product(self):
        return self.chain(self.signed, "*/%^")

    def chain(self, operand, signs):
        begin, left = self.begin(), operand()
        while self.peek() and self.peek() in signs:
            sign = self.next()
            left = self.made(begin, sign, None, left, operand())
        return left

    def signed(self):
        begin = self.begin()
        if self.peek() != "-":
            return self.placed()
        self.next()
        inner = self.signed()
        return self.made(begin, "negative", None, inner)

    def placed(self):
        begin, inner = self.begin(), self.primary()
        while self.word() == "at":
            self.next()
            coordinates = self.arguments()
            inner = self.made(begin, "at", None, *coordinates, inner)
        return inner

    def primary(self):
        begin, kind, text = self.begin(), self.tokens[self.at][0], self.next()
        if kind == "number":
            return self.made(begin, "number", float(text))
        if text == "(":
            inner = self.sum()
            self.next()
            return Formula(inner.kind, inner.of, inner.parts, self.text_from(begin))
        if self.peek() != "(":
            return self.made(begin, "name", text)
        if self.tokens[self.at + 1][0] == "text":
            self.next()
            mesh = self.next()[1:-1]
            self.next()
            return self.made(begin, "distance", mesh)
        arguments = self.arguments()
        return self.made(begin, "call", text, *arguments)

    def arguments(self):
        made = []
        while self.next() != ")":
            if self.peek() == ")":
                continue
            made.append(self.sum())
        return made


def found(text):
    """(kind, text, begin, end) of each token."""
    at = 0
    while match := TOKEN.match(text, at):
        yield match.lastgroup, match[match.lastgroup], match.start(match.lastgroup), match.end()
        at = match.end()


def read_fields(path):
    return Fields(path)
