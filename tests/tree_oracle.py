#!/usr/bin/env python3
"""Nodes at which trees are crossed, against an independent reference: tree_oracle.py TREE_PICKS FOLDER

FOLDER has choice.py, which chooses nodes by Python's random numbers. Here it is given the numbers that Tartan draws, and has to choose the
same nodes: of the Klein bottle, the heart and random trees, in all orders of walking, at several probabilities."""
import importlib.util, random, struct, subprocess, sys

PICKS, FOLDER = sys.argv[1:]
MASK = (1 << 64) - 1
spec = importlib.util.spec_from_file_location("choice", FOLDER + "/choice.py")
choice = importlib.util.module_from_spec(spec)
spec.loader.exec_module(choice)

# The symbols of runtime/genome/tree/gene_tree.h, by what they stand for here.
OPERATORS = {"neg": 6, "+": 7, "-": 8, "*": 9, "/": 10, "%": 11}
COMMA, CALL, NUMBER = 5, 12, 0


def mix(x):
    x = (x + 0x9E3779B97F4A7C15) & MASK
    x = ((x ^ (x >> 30)) * 0xBF58476D1CE4E5B9) & MASK
    x = ((x ^ (x >> 27)) * 0x94D049BB133111EB) & MASK
    return x ^ (x >> 31)


class Draws:
    """The draws of tn_chance_for(seed, TN_PURPOSE_BIRTH, 0, 0)."""

    def __init__(self, seed):
        self.seed, self.index = seed, 0

    def random(self):
        bits = mix(mix(mix(self.seed) ^ (2 << 60)) ^ self.index)
        self.index += 1
        return (bits >> 11) * 2.0**-53


def tokens(node):
    if node.kind == "o":
        head = [OPERATORS[node.label]]
    elif node.kind == ",":
        head = [COMMA]
    else:
        head = [CALL] if node.kids else [NUMBER, struct.unpack("<Q", struct.pack("<d", 1.0))[0]]
    return head + [token for kid in node.kids for token in tokens(kid)]


def grow(rng, depth):
    if depth == 0 or rng.random() < 0.2:
        return choice.Node("1", "v", [])
    kind = rng.randrange(4)
    if kind == 0:
        return choice.Node("neg", "o", [grow(rng, depth - 1)])
    if kind == 1:
        return choice.Node("pow", "v", [choice.Node(",", ",", [grow(rng, depth - 1), grow(rng, depth - 1)])])
    return choice.Node(rng.choice("+-*/%"), "o", [grow(rng, depth - 1), grow(rng, depth - 1)])


def main():
    rng = random.Random(1)
    trees = [choice.parse(choice.P[name]) for name in ("KLEIN", "HEART", "SPHERE")]
    while len(trees) < 60:
        tree = grow(rng, rng.randrange(1, 9))
        if tree.kids:
            trees.append(tree)
    lines, wanted, cases = [], [], 0
    for number, root in enumerate(trees):
        nodes = choice.number(root)
        height = max(node.depth for node in nodes)
        for order, reading in enumerate(("fair", "preorder", "level")):
            for maxprob in (0.05, 0.2, 1.0):
                draws = Draws(number)
                choice.random.random = draws.random
                picked = [choice.choose(root, nodes, height, maxprob, reading).at for _ in range(20)]
                lines.append("%d %r %d 20 %s" % (order, maxprob, number, " ".join(map(str, tokens(root)))))
                wanted.append(picked)
                cases += len(picked)
    made = subprocess.run([PICKS], input="\n".join(lines) + "\n", capture_output=True, text=True, check=True).stdout.splitlines()
    for line, picked, found in zip(lines, wanted, made):
        if list(map(int, found.split())) != picked:
            sys.exit("choice.py picks %s, and Tartan %s: %s" % (picked, found, line[:80]))
    if len(made) != len(wanted):
        sys.exit("%d answers to %d questions" % (len(made), len(wanted)))
    print("%d choices are the same" % cases)


main()
