#!/usr/bin/env python3
"""Holds that the files of the fixed share have every production of the grammars: reached.py [SEEDS]

A production that no file has, and one of a kind's table that a file has, is a failure. New syntax takes part in the search by itself;
where this test says that it does not, it needs names that the grammar does not know, which the kind's tables have to give."""
import random
import sys

from kinds import KINDS
from maker import Maker
from tree import walk


def reached(kind, seeds):
    names = set()
    for seed in range(seeds):
        maker = Maker(kind.grammar, kind.notation, random.Random(f"{kind.name} {seed}"))
        kind.beside(maker.random)
        names |= {node.name for _, node in walk(kind.make_file(maker)) if node.production}
    return names


def missing_of(kinds, seeds):
    """What is wrong with the files of kinds that share a grammar, and how many productions they have."""
    every = {p.name for p in kinds[0].grammar.every_production()}
    names = set().union(*(reached(kind, seeds) for kind in kinds))
    excused = set().union(*(kind.not_reached for kind in kinds))
    print(f"{kinds[0].grammar_file}: {len(every & names)} of {len(every)} productions in {seeds} files of each kind")
    return [f"no file has `{name}`" for name in sorted(every - names - excused)] + \
        [f"not_reached lists `{name}` without need" for name in sorted(excused) if name in names or name not in every]


def main():
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 400
    wrong = []
    for file in sorted({kind.grammar_file for kind in KINDS.values()}):
        wrong += missing_of([kind for kind in KINDS.values() if kind.grammar_file == file], seeds)
    print("\n".join(wrong))
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
