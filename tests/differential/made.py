#!/usr/bin/env python3
"""Writes the files of the first seeds of a kind, as they are before they are mended: made.py KIND SEEDS FOLDER"""
import os
import random
import sys

from kinds import KINDS
from maker import Maker
from tree import Text


def main():
    kind, folder = KINDS[sys.argv[1]], sys.argv[3]
    for seed in range(int(sys.argv[2])):
        maker = Maker(kind.grammar, kind.notation, random.Random(f"{kind.name} {seed}"))
        kind.beside(maker.random)
        with open(os.path.join(folder, f"{kind.name}-{seed}.plan"), "w", encoding="utf-8") as file:
            file.write(Text(kind.make_file(maker), kind.notation.indents).text)


if __name__ == "__main__":
    main()
