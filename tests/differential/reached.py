#!/usr/bin/env python3
"""Holds that the files of the fixed share have every production of the grammar: reached.py [SEEDS]

A production that no file has, and one of the table below that a file has, is a failure. New syntax takes part in the search by itself;
where this test says that it does not, it needs names that the grammar does not know (plans.py, houses.py)."""
import random
import sys

import plans
from search import GRAMMAR, KINDS
from maker import Maker
from tree import walk

NOT_REACHED = {
    "file: ONE_EXPRESSION expression": "the command line's, not a file's",
    "file: ONE_PATTERN pattern": "the command line's, not a file's",
    "file: items": "the start is `items`",
    "value: NUMBER doc role": "taken by the grammar in order to say that a number has no unit",
}


def reached(seeds):
    names = set()
    for kind, make_file in KINDS.items():
        for seed in range(seeds):
            maker = Maker(GRAMMAR, plans.Plans(), random.Random(f"{kind} {seed}"))
            names |= {node.name for _, node in walk(make_file(maker)) if node.production}
    return names


def main():
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 400
    names, every = reached(seeds), {p.name for p in GRAMMAR.every_production()}
    missing = sorted(every - names - set(NOT_REACHED))
    needless = sorted(name for name in NOT_REACHED if name in names or name not in every)
    for name in missing:
        print(f"no file has `{name}`")
    for name in needless:
        print(f"NOT_REACHED lists `{name}` without need")
    print(f"{len(every & names)} of {len(every)} productions in {seeds} files of each kind")
    sys.exit(1 if missing or needless else 0)


if __name__ == "__main__":
    main()
