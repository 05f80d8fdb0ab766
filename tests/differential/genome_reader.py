"""Reads .bnf files of both dialects by a reader of its own, maps genomes, and counts derivations, in the plainest way."""
import functools
import re

NAME = re.compile(r"<[^>| \t\r\n]+>")
HEAD = re.compile(r"(<[^>| \t\r\n]+>)[ \t]*::=")
PIECE = re.compile(r"""(?P<name><[^>| \t\r\n]+>)|(?P<quoted>'[^'\r\n]*'|"[^"\r\n]*")|(?P<bar>\|)|(?P<comment>\#[^\n]*)|(?P<line>\ *\n+\ *)
                       |(?P<text><+|[^'"<|\#\r\n]+)""", re.X)
ESCAPES = {"a": "\a", "b": "\b", "f": "\f", "n": "\n", "r": "\r", "t": "\t", "v": "\v", "\\": "\\", "'": "'", '"': '"'}


class Grammar:
    """Alternatives are lists of (kind, ...): ("name", N), ("text", T); in genr8 also ("edge",), ("same", letter), ("repeat" or "maybe", items)."""

    def __init__(self, text):
        self.settings = dict(re.findall(r"^%([\w-]+)[ \t]+(\S+)", text, re.M))
        self.genr8 = self.settings.get("dialect") == "genr8"
        self.depth = int(self.settings.get("max-depth", 10 if self.genr8 else 0))
        self.wraps = int(self.settings.get("wraps", 2 if self.genr8 else 0))
        self.skips = self.settings.get("single-choice") == "skip"
        heads = list(HEAD.finditer(text))
        self.start, self.rules = heads[0][1], {}
        for head, end in zip(heads, [h.start() for h in heads[1:]] + [len(text)]):
            body = text[head.end():end]
            self.rules[head[1]] = self.words(body) if self.genr8 else self.pieces(body)

    # ---- ge

    def pieces(self, body):
        alternatives, items = [], []
        for found in PIECE.finditer(body):
            kind = found.lastgroup
            if kind in ("bar", "comment"):
                alternatives.append(items)
                items = []
            else:
                items.append((kind, found[0]))
        return [made for items in alternatives + [items] for made in self.alternative(items)]

    def alternative(self, items):
        items = trimmed(items)
        written = "".join(text for _, text in items)
        counted = re.match(r"GE_RANGE:(\w+)", written) if items else None
        if counted:                              # and what follows it is dropped
            return [[("text", str(i))] for i in range(self.range_of(counted[1]))]
        made = []
        for kind, text in items:
            if kind == "name":
                made.append(("name", text))
                continue
            text = "\n" * text.count("\n") if kind == "line" else unescaped(text[1:-1] if kind == "quoted" else text)
            if made and made[-1][0] == "text":
                made[-1] = ("text", made[-1][1] + text)
            else:
                made.append(("text", text))
        return [made] if items else []

    def range_of(self, word):
        names = {"dataset_n_vars": "dataset-vars", "dataset_n_is": "dataset-inputs", "dataset_n_os": "dataset-outputs"}
        return int(word if word.isdigit() else self.settings[names[word]])

    # ---- genr8

    def words(self, body):
        self.tokens = re.sub(r"(?m)(^|\s)#.*$", " ", body).split()
        made = [self.group(None)]
        while self.tokens:
            self.tokens.pop(0)
            made.append(self.group(None))
        return [items for items in made if items]

    def group(self, closing):
        items = []
        while self.tokens and self.tokens[0] != "|":
            word = self.tokens.pop(0)
            if word == closing:
                break
            if word in "{[":
                items.append(("repeat", self.group("}")) if word == "{" else ("maybe", self.group("]")))
            elif NAME.fullmatch(word):
                items.append(("name", word))
            elif word == "Edge" or re.fullmatch("Edge[XYZ]", word):
                items.append(("same", word[4]) if word[4:] else ("edge",))
            else:
                items.append(("text", word[1:-1] if len(word) > 2 and word[0] in "'\"" and word[-1] == word[0] else word))
        return items


def trimmed(items):
    """Without white space at the ends, where it is not in quotes."""
    items = list(items)
    while items and items[0][0] in ("text", "line") and not items[0][1].lstrip():
        items.pop(0)
    while items and items[-1][0] in ("text", "line") and not items[-1][1].rstrip():
        items.pop()
    if items and items[0][0] == "text":
        items[0] = ("text", items[0][1].lstrip())
    if items and items[-1][0] == "text":
        items[-1] = ("text", items[-1][1].rstrip())
    return items


def unescaped(text):
    def one(found):
        if found["letter"]:
            return ESCAPES[found["letter"]]
        return chr(int(found["hex"][1:], 16)) if found["hex"] else chr(int(found["octal"], 8))
    return re.sub(r"""\\(?:(?P<letter>[abfnrtv\\'"])|(?P<hex>x[0-9a-fA-F]{2}|u[0-9a-fA-F]{4}|U[0-9a-fA-F]{8})|(?P<octal>[0-7]{1,3}))""", one, text)


class NotValid(Exception):
    pass


class Mapped:
    """A genome mapped: the sentence and its figures; raises NotValid."""

    def __init__(self, grammar, genome, wraps=None, depth=None, anywhere=False):
        self.grammar, self.genome = grammar, genome
        self.wraps, self.most = grammar.wraps if wraps is None else wraps, grammar.depth if depth is None else depth
        self.used, self.nodes, self.depth, self.types, self.out = 0, 0, 1, 2, []
        (self.anywhere if anywhere else self.leftmost)()
        self.sentence = (" " if grammar.genr8 else "").join(self.out)

    def codon(self):
        if not self.genome or self.used >= len(self.genome) * (self.wraps + 1):
            raise NotValid
        self.used += 1
        return self.genome[(self.used - 1) % len(self.genome)]

    def choose(self, name, depth):
        """The alternative that the next codon says; in genr8 one that ends at the greatest depth, where there is one."""
        alternatives = self.grammar.rules[name]
        if self.grammar.genr8 and self.most and depth >= self.most:
            alternatives = [a for a in alternatives if not has_name(a)] or alternatives
        if len(alternatives) == 1 and self.grammar.skips and not self.grammar.genr8:
            return alternatives[0]
        return alternatives[self.codon() % len(alternatives)]

    def count(self, items, depth):
        """PonyGE2 counts non-terminals, and one where there is none; terminals are a level deeper."""
        self.nodes += max(1, sum(item[0] == "name" for item in items))
        self.depth = max(self.depth, depth + 1)
        if self.most and depth + 1 > self.most:
            raise NotValid

    def leftmost(self):
        waiting = [(("name", self.grammar.start), 1, {})]
        self.nodes = 0 if self.grammar.genr8 else 1
        while waiting:
            item, depth, same = waiting.pop()
            kind = item[0]
            if kind == "text":
                self.out.append(item[1])
            elif kind == "name":
                items = self.choose(item[1], depth)
                if self.grammar.genr8:
                    self.nodes, self.depth = self.nodes + 1, max(self.depth, depth)
                else:
                    self.count(items, depth)
                same = {}
                waiting += [(inner, depth + 1, same) for inner in reversed(items)]
            elif kind == "edge" or kind == "same":
                if kind == "edge" or item[1] not in same:
                    same[item[-1]] = self.edge()
                self.out.append(f"Edge{same[item[-1]]}")
            elif kind == "maybe":
                waiting += [(inner, depth, same) for inner in reversed(item[1])] if self.codon() % 2 else []
            else:
                repeated = item[2] if len(item) > 2 else 0
                if self.codon() % (repeated + 2) > repeated:
                    waiting.append((("repeat", item[1], repeated + 1), depth, same))
                    waiting += [(inner, depth, same) for inner in reversed(item[1])]

    def edge(self):
        number = self.codon() % (self.types + 1)
        self.types += number == self.types
        return number

    def anywhere(self):
        """Codons in pairs: which non-terminal, and by which alternative."""
        form, self.nodes = [("name", self.grammar.start, 1)], 1
        while any(item[0] == "name" for item in form):
            places = [i for i, item in enumerate(form) if item[0] == "name"]
            at = places[self.codon() % len(places)]
            _, name, depth = form[at]
            items = self.choose(name, depth)
            self.count(items, depth)
            form[at:at + 1] = [(*item[:2], depth + 1) for item in items]
        self.out = [item[1] for item in form]


def has_name(items):
    return any(item[0] == "name" or item[0] in ("repeat", "maybe") and has_name(item[1]) for item in items)


def derivations(grammar, levels):
    """How many derivations have at most so many levels, of a grammar without groups."""
    @functools.lru_cache(maxsize=None)
    def of(name, left):
        if left < 2:
            return 0
        total = 0
        for items in grammar.rules[name]:
            ways = 1
            for item in items:
                ways *= of(item[1], left - 1) if item[0] == "name" else 1
            total += ways
        return total
    return of(grammar.start, levels)


def sentences(grammar, levels, most):
    """All sentences of at most so many levels; None where there are more than `most`, of a name or of a part of an alternative."""
    @functools.lru_cache(maxsize=None)
    def of(name, left):
        found = set()
        for items in grammar.rules[name] if left >= 2 else ():
            made = {""}
            for item in items:
                more = of(item[1], left - 1) if item[0] == "name" else {item[1]}
                if more is None or len(made) * len(more) > most:
                    return None
                made = {a + b for a in made for b in more}
            found |= made
        return found if len(found) <= most else None
    return of(grammar.start, levels)
