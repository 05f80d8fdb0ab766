"""Grammatical evolution in plain Python with NumPy, written for this bench from the published algorithm (O'Neill and Ryan, "Grammatical
Evolution", 2001): ge_peer.py PROBLEM GENERATIONS SEED, where PROBLEM is a JSON file of `grammar`, and `match` or `data`.

It is no other tool, and copies none: it stands where none is installed, for what such a program costs in that language. Codons choose
depth-first, leftmost, by their remainder; first genomes are those of random derivations, half of them full and half grown; tournaments of
two, variable one-point crossover (0.75) and one mutated codon a genome on the mean, one elite. A sentence is Python, evaluated for all
lines of the data at once; sentences are not remembered, as is usual there. The last line is the best cost and the evaluations.
"""
import json
import random
import re
import sys
import warnings

POPULATION, DEPTHS, MAX_DEPTH, CODONS_BELOW = 500, range(2, 11), 17, 100000


def read_choice(text):
    """The productions that it stands for: lists of symbols."""
    counted = re.fullmatch(r"GE_RANGE:(\d+)", text)
    if counted:
        return [[str(i)] for i in range(int(counted[1]))]
    quoted = re.fullmatch(r'"([^"]*)"', text)
    return [[quoted[1]] if quoted else re.findall(r"<[^<>\s]+>|[^<]+|<", text)]


def read_grammar(text):
    """{rule: [[symbol, ...], ...]}; symbols in angle brackets are rules."""
    parts = re.split(r"^(<\S+?>)\s*::=", text, flags=re.MULTILINE)[1:]
    return {head: [production for choice in body.split("|") for production in read_choice(choice.strip())]
            for head, body in zip(parts[::2], parts[1::2])}


def least_depths(rules):
    least = {name: 1e9 for name in rules}
    for _ in rules:
        for name, choices in rules.items():
            least[name] = min(1 + max([least.get(symbol, 0) for symbol in choice]) for choice in choices)
    return least


class Grammar:
    def __init__(self, text):
        self.rules = read_grammar(text)
        self.start = next(iter(self.rules))
        self.least = least_depths(self.rules)
        self.recursive = {name: self.reaches(name, name) for name in self.rules}

    def reaches(self, name, goal, seen=None):
        seen = seen or set()
        for symbol in {symbol for choice in self.rules[name] for symbol in choice if symbol in self.rules}:
            if symbol == goal or (symbol not in seen and not seen.add(symbol) and self.reaches(symbol, goal, seen)):
                return True
        return False

    def map(self, genome):
        """The sentence, or None, and how many codons were read."""
        used, out, stack = 0, [], [(self.start, 1)]
        while stack:
            symbol, depth = stack.pop()
            if symbol not in self.rules:
                out.append(symbol)
                continue
            if used == len(genome) or depth > MAX_DEPTH:
                return None, used
            choices = self.rules[symbol]
            chosen = choices[genome[used] % len(choices)]
            used += 1
            stack.extend((s, depth + 1) for s in reversed(chosen))
        return "".join(out), used

    def plant(self, depth, full):
        """The genome of a random derivation, with half as many codons more."""
        genome, stack = [], [(self.start, max(depth, self.least[self.start]))]
        while stack:
            symbol, left = stack.pop()
            choices = self.rules[symbol]
            fitting = [i for i, c in enumerate(choices) if max([self.least.get(s, 0) for s in c]) < left]
            deep = [i for i in fitting if any(self.recursive.get(s, False) for s in choices[i])]
            choice = random.choice(deep if full and deep else fitting)
            genome.append(random.randrange(CODONS_BELOW // len(choices)) * len(choices) + choice)
            stack.extend((s, left - 1) for s in reversed(choices[choice]) if s in self.rules)
        return genome + [random.randrange(CODONS_BELOW) for _ in range(len(genome) // 2)]


def matching(wanted):
    def cost(sentence):
        total = max(len(sentence), len(wanted))
        for a, b in zip(sentence, wanted):
            total -= 1 if a == b else 1 / (1 + abs(ord(a) - ord(b)))
        return total
    return cost


def fitting(path):
    import numpy as np
    names = {"np": np, "plog": lambda a: np.log(1 + np.abs(a)), "psqrt": lambda a: np.sqrt(np.abs(a)),
             "pdiv": lambda a, b: np.where(np.abs(b) < 1e-3, 1.0, a / np.where(np.abs(b) < 1e-3, 1.0, b))}
    data = np.loadtxt(path, skiprows=1, ndmin=2)
    names["x"], wanted = data[:, :-1], data[:, -1]

    def cost(sentence):
        error = float(np.sqrt(np.mean((eval(sentence, names) - wanted) ** 2)))
        return error if error == error else float("inf")
    return cost


def varied(parents, used):
    points = [random.randint(0, min(u, len(p))) for p, u in zip(parents, used)]
    children = [list(p) for p in parents]
    if random.random() < 0.75:
        (a, b), (i, j) = parents, points
        children = [a[:i] + b[j:], b[:j] + a[i:]]
    for child, read in zip(children, used):
        for i in range(min(read, len(child))):
            if random.random() * read < 1:
                child[i] = random.randrange(CODONS_BELOW)
    return children


def evolve(grammar, cost, generations):
    evaluations = 0

    def scored(genome):
        nonlocal evaluations
        sentence, used = grammar.map(genome)
        evaluations += sentence is not None
        return (cost(sentence) if sentence is not None else float("inf"), genome, used)

    members = sorted((scored(grammar.plant(DEPTHS[i // 2 % len(DEPTHS)], i % 2 == 0)) for i in range(POPULATION)), key=lambda m: m[0])
    for _ in range(generations):
        born = []
        while len(born) < POPULATION - 1:
            parents = [min(random.sample(members, 2), key=lambda m: m[0]) for _ in range(2)]
            born += [scored(child) for child in varied([p[1] for p in parents], [p[2] for p in parents])]
        members = sorted(members[:1] + born[:POPULATION - 1], key=lambda m: m[0])
    return members[0][0], evaluations


def main():
    warnings.simplefilter("ignore")  # values that are no numbers: they cost infinitely much
    with open(sys.argv[1]) as source:
        problem = json.load(source)
    random.seed(int(sys.argv[3]))
    cost = matching(problem["match"]) if "match" in problem else fitting(problem["data"])
    best, evaluations = evolve(Grammar(problem["grammar"]), cost, int(sys.argv[2]))
    print(f"{best:.6g} {evaluations}")


if __name__ == "__main__":
    main()
