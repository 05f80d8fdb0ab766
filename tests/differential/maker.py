"""Random derivation trees of a grammar. What the grammar does not know (names, lengths, which kinds go together) a notation says."""
from tree import Node


class Notation:
    """What is known of a notation beside its grammar; each notation has a class of its own below this one.

    A context is handed down from a node to its children. `hooks` has, for a nonterminal, a function (maker, depth, context) that gives
    a node or None; what has no hook is made by the grammar alone. A production that no table knows has the weight 1."""
    start = None                     # the symbol of a whole file
    indents = {}                     # nonterminals that begin a line, and how far that is indented
    depths = {}                      # nonterminals that are made at least so deep, however deep they stand
    remade = ()                      # nonterminals that are made anew where the program finds a mistake in them
    hooks = {}
    never = ()                       # productions that no file has, wherever they could stand

    def weight(self, production, context):
        return 1

    def contexts(self, maker, production, context):
        return [context] * len(production.symbols)

    def token(self, maker, token, context):
        raise NotImplementedError(token)


LEFT_OUT = 8


class Maker:
    def __init__(self, grammar, notation, random):
        self.grammar, self.notation, self.random = grammar, notation, random

    def make(self, symbol, depth, context):
        if self.grammar.is_token(symbol):
            text = self.grammar.literals[symbol]
            return Node(symbol, text=self.notation.token(self, symbol, context) if text is None else text, context=context)
        depth = max(depth, self.notation.depths.get(symbol, depth))
        hook = self.notation.hooks.get(symbol)
        node = hook(self, depth, context) if hook else None
        return node or self.by_grammar(symbol, depth, context)

    def by_grammar(self, symbol, depth, context):
        return self.by_production(self.choose(symbol, depth, context), depth, context)

    def by_production(self, production, depth, context):
        contexts = self.notation.contexts(self, production, context)
        depth -= len(production.symbols) > 1
        children = [self.make(s, depth, c) for s, c in zip(production.symbols, contexts)]
        return Node(production.head, production, children, context=context)

    def make_of(self, name, depth, context):
        return self.by_production(self.grammar.production(name), depth, context)

    def choose(self, symbol, depth, context):
        """One of the productions that fit into the depth, by their weights; the shortest where none does. Far below that weights
        do not count, so that every derivation ends."""
        rules, cost = self.grammar.rules[symbol], self.grammar.production_cost
        weighed = [(p, self.notation.weight(p, context) if depth > -LEFT_OUT else 0) for p in rules]
        allowed = [(p, w) for p, w in weighed if w > 0] or [(p, 1) for p in rules if p.name not in self.notation.never]
        fitting = [(p, w) for p, w in allowed if cost(p) <= depth]
        if not fitting:
            least = min(cost(p) for p, _ in allowed)
            fitting = [(p, w) for p, w in allowed if cost(p) == least]
        return self.random.choices([p for p, _ in fitting], [w for _, w in fitting])[0]

    def chance(self, share):
        return self.random.random() < share

    def node(self, name, *children):
        """A node of a production that is named, where a hook builds one."""
        production = self.grammar.production(name)
        given = iter(children)
        made = [Node(s, text=self.grammar.literals[s]) if self.grammar.literals.get(s) else next(given) for s in production.symbols]
        return Node(production.head, production, made)

    def word(self, token, text):
        return Node(token, text=text)
