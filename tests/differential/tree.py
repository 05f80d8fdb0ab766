"""Derivation trees: what a file is made of, how it is written as text, and where each part of it stands there."""


class Node:
    """A nonterminal with its production and children, or a token with its text. Nodes are never changed.
    `context` is what the maker knew where it made the node, so that the node can be made anew."""
    __slots__ = ("symbol", "production", "children", "text", "context", "size")

    def __init__(self, symbol, production=None, children=(), text=None, context=None):
        self.symbol, self.production, self.children, self.text, self.context = symbol, production, tuple(children), text, context
        self.size = 1 if production is None else sum(child.size for child in self.children)

    @property
    def name(self):
        """The name of its production: what tables are keyed by."""
        return self.production.name if self.production else self.symbol

    def child(self, symbol):
        return next((c for c in self.children if c.symbol == symbol), None)


def walk(node, path=()):
    """(path, node) of all nodes, parents before their children."""
    yield path, node
    for i, child in enumerate(node.children):
        yield from walk(child, path + (i,))


def find_all(node, symbol):
    """The outermost nodes of that symbol, from left to right."""
    if node.symbol == symbol:
        return [node]
    return [found for child in node.children for found in find_all(child, symbol)]


def words(node):
    """The texts of a node's tokens."""
    if node.production is None:
        return [node.text]
    return [text for child in node.children for text in words(child)]


def at(node, path):
    for i in path:
        node = node.children[i]
    return node


def replaced(node, path, new):
    if not path:
        return new
    children = list(node.children)
    children[path[0]] = replaced(children[path[0]], path[1:], new)
    return Node(node.symbol, node.production, children, context=node.context)


def wrapped(grammar, symbol, node):
    """The node as one of `symbol`, by productions of one symbol; None where there are none."""
    chain = grammar.chain(symbol, node.symbol)
    if chain is None:
        return None
    for production in reversed(chain):
        node = Node(production.head, production, [node], context=node.context)
    return node


def listed(grammar, symbol, elements):
    """The elements as a left-recursive list: `L: E | L E`, `L: %empty | L E` or `L: E | L COMMA E`, for whatever nonterminals E may be."""
    first, more = sorted(list_productions(grammar, symbol), key=lambda p: symbol in p.symbols)[:2]
    elements = list(elements)
    node = Node(symbol, first, [elements.pop(0)] if first.symbols else [])
    for element in elements:
        production = next((p for p in grammar.rules[symbol] if p.symbols[:1] == (symbol,) and p.symbols[-1] == element.symbol), more)
        between = [Node(s, text=grammar.literals[s]) for s in production.symbols[1:-1]]
        node = Node(symbol, production, [node, *between, element])
    return node


def list_productions(grammar, symbol):
    return [p for p in grammar.rules[symbol] if not p.symbols or symbol in p.symbols or len(p.symbols) == 1]


# ---- as text

CLOSE_UP_BEFORE, CLOSE_UP_AFTER = set("),]\n"), set("([")


class Text:
    """A tree as text, with the place of every node: `spans` has (begin, end) by path."""

    def __init__(self, node, indents):
        self.indents, self.parts, self.size, self.last, self.spans = indents, [], 0, "", {}
        self._write(node, (), False)
        self._add("\n")
        self.text = "".join(self.parts)

    def _write(self, node, path, close_up):
        if node.symbol in self.indents and node.size and self.size:
            self._break(self.indents[node.symbol])
        begin = None
        if node.production is None:
            begin = self._token(node.text, close_up)
        for i, child in enumerate(node.children):
            self._write(child, path + (i,), calls(node, i))
            inner = self.spans[path + (i,)]
            begin = inner[0] if begin is None and inner[0] != inner[1] else begin
        self.spans[path] = (self.size if begin is None else begin, self.size)

    def _token(self, text, close_up):
        joined = close_up or text in CLOSE_UP_BEFORE or self.last in CLOSE_UP_AFTER or self.last in ("", "\n")
        if not joined:
            self._add(" ")
        begin = self.size
        self._add(text)
        self.last = text
        return begin

    def _break(self, indent):
        self._add("\n" + " " * indent)
        self.last = "\n"

    def _add(self, text):
        self.parts.append(text)
        self.size += len(text)


def calls(node, i):
    """Is the i-th child the bracket of a call, which stands close to its word?"""
    before = node.children[i - 1] if i else None
    return before is not None and node.children[i].text == "(" and before.production is None


def offset_of(text, line, column):
    """Of a place as the program says it: lines from 1, columns of characters from 1."""
    lines = text.split("\n")
    return sum(len(passed) + 1 for passed in lines[:line - 1]) + column - 1


def nodes_at(text, begin, end):
    """The paths of the nodes that hold this stretch, the smallest first."""
    found = [(span[1] - span[0], -len(path), path) for path, span in text.spans.items() if span[0] <= begin and end <= span[1]]
    return [path for _, _, path in sorted(found)]
