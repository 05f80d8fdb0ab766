"""Rules that use themselves: some at random, and what is wrong with those of a file.

A rule may use itself, also by way of others, through `or`, `neighbour`, `optional` and `repeat` alone; each round takes a tray, and one
of its alternatives ends."""
from reference import circles, core, names_used
from tree import find_all, listed, words, wrapped

NOT_ALLOWED = .12        # of circles are made so that they may be refused


class Shapes:
    """Parts of a circle. `leaf` makes what is no name of the circle, `names` has those that may stand at a place where others take a tray."""

    def __init__(self, maker, leaf, names):
        self.maker, self.random, self.leaf, self.names = maker, maker.random, leaf, names

    def to(self, symbol, node):
        """As one of `symbol`, in parentheses if it needs them."""
        made = wrapped(self.maker.grammar, symbol, node)
        if made:
            return made
        return wrapped(self.maker.grammar, symbol, self.maker.node("primary: OPEN expression CLOSE", wrapped(self.maker.grammar, "expression", node)))

    def either(self, *parts):
        if len(parts) == 1:
            return parts[0]
        node = self.maker.node("ors: and OR and", self.to("and", parts[0]), self.to("and", parts[1]))
        for part in parts[2:]:
            node = self.maker.node("ors: ors OR and", node, self.to("and", part))
        return node

    def beside(self, *parts):
        return self.maker.node("primary: NEIGHBOUR OPEN parts CLOSE", listed(self.maker.grammar, "parts", [self.to("part", p) for p in parts]))

    def optional(self, part):
        return self.maker.node("primary: OPTIONAL OPEN expression CLOSE", self.to("expression", part))

    def repeat(self, part, low, high=None):
        ends = [wrapped(self.maker.grammar, "additive", self.maker.node("head_number: NUMBER", self.maker.word("NUMBER", str(n))))
                for n in (low, high) if n is not None]
        often = self.maker.node("call_arg: additive DOTS" + " additive" * (len(ends) - 1), *ends)
        arguments = listed(self.maker.grammar, "call_args", [self.to("call_arg", part), often])
        return self.maker.node("primary: NAME OPEN call_args CLOSE", self.maker.word("NAME", "repeat"), arguments)

    def word(self, production, *parts):
        return self.maker.node(production, *parts)

    def name(self, name=None):
        return self.maker.node("primary: NAME", self.maker.word("NAME", name or self.random.choice(self.names)))

    # what takes a tray in each round: at the right of it, mirrored at the left, or anywhere

    def gap(self):
        return self.maker.node("part: ELLIPSIS")

    def again(self):
        """A name of the circle, by itself or in more."""
        return self.random.choice([self.name, self.name, self.name, lambda: self.either(self.name(), self.leaf()),
                                   lambda: self.beside(self.leaf(), self.name()), lambda: self.beside(self.name(), self.leaf())])()

    def one_sided(self):
        t, c = self.leaf, self.name
        return self.random.choice([
            lambda: [t(), c()], lambda: [t(), c()], lambda: [t(), t(), c()], lambda: [t(), self.optional(c())], lambda: [t(), self.gap(), c()],
            lambda: [t(), self.either(c(), t())], lambda: [t(), self.beside(t(), c())], lambda: [self.optional(t()), t(), c()],
            lambda: [self.repeat(t(), 1, 2), c()], lambda: [self.repeat(t(), 0, 2), t(), c()], lambda: [self.repeat(t(), 2), self.optional(c())]])()

    def anywhere(self):
        t, c = self.leaf, self.again
        low = self.random.choice([0, 1, 2])
        high = self.random.choice([None, None, max(low, 1), low + 1])
        return self.random.choice([
            lambda: self.beside(t(), c(), t()), lambda: self.beside(t(), c(), t()), lambda: self.beside(c(), c()), lambda: self.beside(c(), t(), c()),
            lambda: self.beside(t(), self.optional(c()), t()), lambda: self.beside(self.optional(c()), t(), self.optional(c())),
            lambda: self.beside(t(), self.repeat(c(), low, high)), lambda: self.beside(self.repeat(c(), low, high), t()),
            lambda: self.beside(t(), self.repeat(c(), low, high), t()), lambda: self.repeat(c(), 2, self.random.choice([None, 2, 3])),
            lambda: self.repeat(self.beside(c(), t()), 1, self.random.choice([None, 2])), lambda: self.beside(self.repeat(c(), 1, 2), self.repeat(c(), 1)),
            lambda: self.repeat(self.either(t(), self.beside(t(), c(), t())), low or 1, high), lambda: self.beside(t(), self.gap(), c(), t()),
            lambda: self.beside(self.word("primary: BEGINNING"), t(), c()), lambda: self.beside(c(), t(), self.word("primary: END"))])()

    def round(self, side):
        if side == "any":
            return self.anywhere()
        parts = self.one_sided()
        return self.beside(*(parts if side == "right" else reversed(parts)))

    def faulty(self):
        """Mostly what a circle may not be."""
        t, c, to, word = self.leaf, self.name, self.to, self.word
        number = wrapped(self.maker.grammar, "condition", word("compare: operand comparison operand", word("operand: NAME", self.maker.word("NAME", "n")),
                                                               word("comparison: GREATER"), self.zero("operand: constant", "constant: NUMBER")))
        return self.random.choice([
            lambda: c(), lambda: self.beside(self.optional(t()), c()), lambda: self.beside(c(), self.repeat(t(), 0, 2)), lambda: self.repeat(c(), 1, 2),
            lambda: self.beside(self.gap(), c()), lambda: self.beside(self.word("primary: BEGINNING"), c()), lambda: self.beside(c()),
            lambda: self.beside(t(), word("not: NOT not", to("not", c()))), lambda: self.beside(t(), word("ands: not AND not", to("not", c()), to("not", t()))),
            lambda: self.beside(t(), word("primary: MANY OPEN expression CLOSE", to("expression", c()))),
            lambda: self.beside(t(), word("primary: SYMMETRIC primary", self.beside(t(), c()))),
            lambda: self.beside(t(), word("implied: disjunction IMPLIES disjunction", to("disjunction", c()), to("disjunction", t()))),
            lambda: self.beside(t(), word("qualified: disjunction WHERE disjunction", to("disjunction", t()), to("disjunction", c()))),
            lambda: self.beside(t(), word("nearness: additive BESIDE additive", to("additive", t()), to("additive", c()))),
            lambda: self.beside(t(), word("primary: EVERY OPEN expression COMMA expression CLOSE", to("expression", t()), to("expression", c()))),
            lambda: self.beside(t(), word("primary: OCCURRENCES OPEN expression region COMMA condition CLOSE", to("expression", c()),
                                          word("region: %empty"), number))])()

    def zero(self, *productions):
        node = self.maker.word("NUMBER", "0")
        for production in reversed(productions):
            node = self.maker.node(production, node)
        return node


def bodies(maker, leaf, names, not_allowed=NOT_ALLOWED):
    """(name, expression) of rules that use themselves and one another."""
    random, made = maker.random, []
    shapes = Shapes(maker, leaf, names)
    side, bad = random.choice(["right", "right", "left", "any", "any"]), random.choice(names) if maker.chance(not_allowed) else None
    endless = bad and maker.chance(.2)
    for i, name in enumerate(names):
        ends = [leaf() for _ in range(random.choice([1, 1, 2] if i == 0 else [0, 1, 1]))] * (not endless)
        more = [shapes.round(side) for _ in range(random.choice([1, 1, 1, 2]))]
        if i + 1 < len(names) and (maker.chance(.3) or i == 0):          # so that all are one circle, mostly
            more.append(random.choice([lambda: shapes.name(names[i + 1]), lambda: shapes.beside(leaf(), shapes.name(names[i + 1]))])())
        if name == bad and not endless:
            more.append(shapes.faulty())
        parts = ends + more
        random.shuffle(parts)
        made.append((name, shapes.to("expression", shapes.either(*parts))))
    return made


def asked(maker, leaf, names):
    """What of the plan is one of these rules as a whole: whether one lies somewhere is mostly whether what ends it does."""
    shapes = Shapes(maker, leaf, names)
    c, beginning, end = shapes.name, maker.node("primary: BEGINNING"), maker.node("primary: END")
    made = maker.random.choice([
        lambda: shapes.beside(beginning, c(), end), lambda: shapes.beside(beginning, c(), end), lambda: shapes.beside(leaf(), c(), end),
        lambda: shapes.beside(beginning, c(), leaf()), lambda: shapes.beside(beginning, c(), shapes.gap(), c(), end),
        lambda: shapes.beside(beginning, shapes.repeat(c(), 2, maker.random.choice([None, 2, 3])), end),
        lambda: shapes.beside(beginning, shapes.optional(leaf()), c(), end),
        lambda: maker.node("primary: SYMMETRIC primary", shapes.beside(beginning, leaf(), c(), end)),
        lambda: maker.node("nearness: additive BESIDE additive", shapes.to("additive", c()), shapes.to("additive", c())),
        lambda: maker.node("qualified: disjunction WHERE disjunction", shapes.to("disjunction", shapes.beside(c(), leaf())), shapes.to("disjunction", c()))])()
    return shapes.to("expression", made)


# ---- what is wrong with the circles of a file

class Body:
    """What a rule's body says of the names of its circle: `uses` are (name, whether another part takes a tray); `through` has the names
    that stand below other words. `unsure` has those that are handed on to rules with parameters."""

    def __init__(self, root, circle, params, templates):
        self.circle, self.params, self.templates, self.uses, self.through, self.unsure = circle, params, templates, [], set(), set()
        self.read(root, False)

    def names(self, node):
        return (names_used(node) & self.circle) - self.params

    def read(self, node, takes):
        node = core(node)
        names = self.names(node)
        if not names:
            return
        if node.name == "primary: NAME":
            self.uses.append((node.children[0].text, takes))
        elif node.name in ("ors: and OR and", "ors: ors OR and"):
            for side in (node.children[0], node.children[2]):
                self.read(side, takes)
        elif node.name == "primary: NEIGHBOUR OPEN parts CLOSE":
            parts = [core(p) for p in find_all(node.child("parts"), "part")]
            for part in parts:
                self.read(part, takes or any(other is not part and is_there(other, self.templates) for other in parts))
        elif node.name == "primary: OPTIONAL OPEN expression CLOSE":
            self.read(node.children[2], takes)
        elif is_repeat(node, self.templates):
            inner, low, _ = repeated(node)
            self.read(inner, takes or low is None or low > 1)
            self.unsure |= {name for name in names if low is None}
        elif node.name == "primary: NAME OPEN call_args CLOSE":
            self.unsure |= names
        else:
            self.through |= names


def is_repeat(node, templates):
    return node.name == "primary: NAME OPEN call_args CLOSE" and node.children[0].text == "repeat" and "repeat" not in templates


def repeated(node):
    """(what, at least, at most) of a `repeat`; None where the number is not written, or there is none."""
    inner, often = find_all(node.child("call_args"), "call_arg")
    ends = [int(text) if text.isdigit() else None for text in words(often) if text != ".."]
    return inner, ends[0] if len(words(often)) < 4 else None, ends[-1]


def is_there(part, templates):
    """Does the part always take a tray?"""
    absent = part.name in ("part: ELLIPSIS", "primary: BEGINNING", "primary: END", "primary: OPTIONAL OPEN expression CLOSE")
    return not absent and not (is_repeat(part, templates) and repeated(part)[1] == 0)


def may_end(node, ends, templates):
    """Can it be made of trays, where of the rules of circles those in `ends` can?"""
    node = core(node)
    if node.name == "primary: NAME":
        return ends.get(node.children[0].text, True)
    if node.name in ("ors: and OR and", "ors: ors OR and"):
        return any(may_end(node.children[k], ends, templates) for k in (0, 2))
    if node.name == "primary: NEIGHBOUR OPEN parts CLOSE":
        return all(may_end(p, ends, templates) for p in find_all(node.child("parts"), "part") if is_there(core(p), templates))
    if is_repeat(node, templates):
        return may_end(repeated(node)[0], ends, templates)
    return True


def faults(rules):
    """{circle: what is wrong with it, "" if nothing is, None if that is not known}. `rules` is {name: (params, expression)}."""
    templates = {name for name, (params, _) in rules.items() if params}
    every = circles({name: names_used(body) - set(params) for name, (params, body) in rules.items()})
    return {circle: fault(circle, rules, templates) for circle in set(every.values())}


def fault(circle, rules, templates):
    read = {name: Body(rules[name][1], circle, set(rules[name][0]), templates) for name in circle}
    ends = {name: False for name in circle}              # other rules can end: if one cannot, that is its own fault
    for _ in circle:
        ends = {name: may_end(rules[name][1], ends, templates) for name in circle}
    if any(body.through for body in read.values()):
        return "through another word"
    if circle & templates:
        return "with parameters"
    if any(body.unsure for body in read.values()):
        return None
    if circles({name: {used for used, takes in body.uses if not takes} for name, body in read.items()}):
        return "takes no tray"
    return "" if all(ends.values()) else "does not end"
