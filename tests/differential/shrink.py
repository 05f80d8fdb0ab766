"""Makes a case smaller: on its derivation tree, so that every smaller text is one of the grammar, whatever the notation."""
from tree import Node, Text, replaced, walk, wrapped

TRIES = 300


class Shortest:
    """The smallest trees whose tokens are always written the same, by symbol."""

    def __init__(self, grammar):
        self.trees = {token: Node(token, text=text) for token, text in grammar.literals.items() if text is not None}
        changed = True
        while changed:
            changed = False
            for production in grammar.every_production():
                if all(s in self.trees for s in production.symbols):
                    made = Node(production.head, production, [self.trees[s] for s in production.symbols])
                    if production.head not in self.trees or made.size < self.trees[production.head].size:
                        self.trees[production.head], changed = made, True


def shrunk(grammar, tree, wrong, still, indents):
    """(tree, how its answers differ). `still` says of a tree how it differs by the same question, or None."""
    shortest, tried, smaller = Shortest(grammar), set(), True
    while smaller and len(tried) < TRIES:
        smaller = False
        for candidate in candidates(grammar, shortest, tree):
            text = Text(candidate, indents).text
            if text in tried:
                continue
            tried.add(text)
            found = still(candidate)
            if found:
                tree, wrong, smaller = candidate, found, True
                break
            if len(tried) >= TRIES:
                break
    return tree, wrong


def candidates(grammar, shortest, tree):
    """Smaller trees, those first that leave most out."""
    nodes = sorted(((path, node) for path, node in walk(tree) if node.production), key=lambda found: -found[1].size)
    for path, node in nodes:
        for new in replacements(grammar, shortest, node):
            yield replaced(tree, path, new)


def replacements(grammar, shortest, node):
    """What may stand for a node: nothing of it, a part of it of the same kind, a list without one of its elements."""
    least = shortest.trees.get(node.symbol)
    if least and least.size < node.size:
        yield least
    yield from shorter_lists(grammar, node)
    inner = sorted((d for _, d in walk(node) if d is not node and d.production and d.size < node.size), key=lambda d: d.size)
    for descendant in inner:
        made = wrapped(grammar, node.symbol, descendant)
        if made and made.children != node.children:
            yield made


def shorter_lists(grammar, node):
    if not node.children or node.children[0].symbol != node.symbol:
        return
    yield node.children[0]
    if len(node.children[0].children) == 1:              # its first element, of which it is not made
        single = [p for p in grammar.rules[node.symbol] if p.symbols == (node.children[-1].symbol,)]
        if single:
            yield Node(node.symbol, single[0], [node.children[-1]])
