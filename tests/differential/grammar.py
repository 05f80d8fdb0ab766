"""The productions of a bison file, as it stands in grammar/: what can be written is read from there and said nowhere else."""
import re

PIECE = re.compile(r"""\s+|/\*.*?\*/|//[^\n]*|(?P<word>%?[A-Za-z_][\w-]*)|(?P<sign>[:|;{}])|(?P<string>"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*')|.""",
                   re.S | re.X)


class Production:
    """`head: SYMBOL ...`; its name is that text, which tables use as their key."""

    def __init__(self, head, symbols):
        self.head, self.symbols = head, tuple(symbols)
        self.name = f"{head}: {' '.join(symbols) or '%empty'}"

    def __repr__(self):
        return self.name


class Grammar:
    """`rules` has the productions of each nonterminal; `literals` the text of each token that is always written the same, else None.
    `cost` says how deep the shortest derivation of a symbol is; productions with one symbol add nothing to it."""

    def __init__(self, text):
        head, body = text.split("\n%%\n")[:2]
        self.literals = dict(tokens(head))
        self.rules = productions(body)
        self.cost = self._costs()
        self._chains = {}

    def is_token(self, symbol):
        return symbol not in self.rules

    def production(self, name):
        return next(p for p in self.rules[name.partition(":")[0]] if p.name == name)

    def production_cost(self, production):
        return (len(production.symbols) > 1) + max((self.cost[s] for s in production.symbols), default=0)

    def _costs(self):
        cost = {s: 0 if s not in self.rules else float("inf") for p in self.every_production() for s in (p.head, *p.symbols)}
        changed = True
        while changed:
            changed = False
            for p in self.every_production():
                least = (len(p.symbols) > 1) + max((cost[s] for s in p.symbols), default=0)
                if least < cost[p.head]:
                    cost[p.head], changed = least, True
        return cost

    def every_production(self):
        return [p for listed in self.rules.values() for p in listed]

    def reachable(self, start):
        """The productions that a text that begins with `start` may use."""
        seen, waiting = [], [start]
        while waiting:
            for p in self.rules.get(waiting.pop(), ()):
                if p not in seen:
                    seen.append(p)
                    waiting += p.symbols
        return seen

    def chain(self, outer, inner):
        """The productions of one symbol each that lead from `outer` to `inner`, or None: where a node may stand for another."""
        if (outer, inner) not in self._chains:
            self._chains[outer, inner] = self._find_chain(outer, inner)
        return self._chains[outer, inner]

    def _find_chain(self, outer, inner):
        waiting, seen = [(outer, [])], {outer}
        for symbol, path in waiting:
            if symbol == inner:
                return path
            for p in self.rules.get(symbol, ()):
                if len(p.symbols) == 1 and p.symbols[0] not in seen:
                    seen.add(p.symbols[0])
                    waiting.append((p.symbols[0], path + [p]))
        return None


def read_grammar(path):
    with open(path, encoding="utf-8") as file:
        return Grammar(file.read())


def tokens(head):
    """(token, literal text or None) of the %token lines: the text stands in backquotes in the token's alias."""
    for line in re.findall(r"^%token\s+(.*)$", head, re.M):
        for name, alias in re.findall(r'([A-Z_]+)(?:\s+\d+)?\s+"([^"]*)"', line):
            literal = re.match(r"`([^`]*)`", alias)
            yield name, literal[1] if literal else None


def pieces(body):
    """Words and signs of the rules, without comments and actions."""
    depth = 0
    for found in PIECE.finditer(body):
        sign = found["sign"]
        depth += (sign == "{") - (sign == "}")
        if depth == 0 and (found["word"] or sign and sign in ":|;"):
            yield found[0]


def productions(body):
    rules, head, symbols, words = {}, None, [], list(pieces(body)) + [";"]
    for at, piece in enumerate(words):
        if piece in "|;":
            if head and "error" not in symbols:
                rules[head].append(Production(head, symbols))
            symbols = []
            head = head if piece == "|" else None
        elif piece == ":":
            continue
        elif words[at + 1] == ":":
            head, symbols = piece, []
            rules.setdefault(head, [])
        elif piece[0] != "%" and words[at - 1] != "%prec":
            symbols.append(piece)
    return rules
