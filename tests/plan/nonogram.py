#!/usr/bin/env python3
"""Nonograms as plans: nonogram.py TARTAN SIZE [SEED]. A plan is a picture, a tray a row of it; `tartan enumerate` has to find the picture, and no other.

The picture is one that filling in single rows and columns determines (a solver of its own here), so that there is one solution.
A tray says which row it is, and which of the ways of its row to have such runs of black cells; a column is a rule about the trays."""
import functools
import os
import random
import subprocess
import sys
import tempfile

WAYS_MAX = 200


def runs(line):
    return [len(run) for run in "".join("#" if cell else " " for cell in line).split()]


@functools.lru_cache(maxsize=None)
def ways(clue, size):
    """All lines of this size with these runs."""
    if not clue:
        return [(False,) * size]
    found = []
    least = sum(clue[1:]) + len(clue) - 1
    for begin in range(size - least - clue[0] + 1):
        head = (False,) * begin + (True,) * clue[0]
        if len(clue) == 1:
            found.append(head + (False,) * (size - len(head)))
        else:
            found += [head + (False,) + rest for rest in ways(clue[1:], size - len(head) - 1)]
    return found


def fills_itself(rows, columns, size):
    """Do single rows and columns, one after another, determine every cell?"""
    cells = [[None] * size for _ in range(size)]
    changed = True
    while changed:
        changed = False
        for clues, turned in ((rows, False), (columns, True)):
            for i, clue in enumerate(clues):
                line = [cells[k][i] if turned else cells[i][k] for k in range(size)]
                fitting = [way for way in ways(clue, size) if all(c is None or c == w for c, w in zip(line, way))]
                for k in range(size):
                    if line[k] is None and len({way[k] for way in fitting}) == 1:
                        cells[k if turned else i][i if turned else k] = fitting[0][k]
                        changed = True
    return all(cell is not None for row in cells for cell in row)


def picture_of(size, chance):
    while True:
        picture = [[chance.random() < .62 for _ in range(size)] for _ in range(size)]
        rows = [tuple(runs(row)) for row in picture]
        columns = [tuple(runs([row[k] for row in picture])) for k in range(size)]
        few = all(len(ways(clue, size)) <= WAYS_MAX for clue in rows)
        if few and fills_itself(rows, columns, size):
            return picture, rows, columns


def plan_file(rows, columns, size):
    most = max(len(ways(clue, size)) for clue in rows)
    text = "schema rows {\n  row = " + " | ".join(f"r{i}" for i in range(size))
    text += "\n  way = " + " < ".join(f"w{k}" for k in range(most)) + "\n"
    for i, clue in enumerate(rows):
        if len(ways(clue, size)) < most:
            text += f"  forbid tray(r{i}, way >= w{len(ways(clue, size))})\n"
    text += "}\n"
    for c in range(size):
        black = []
        for i, clue in enumerate(rows):
            of_row = [f"w{k}" for k, way in enumerate(ways(clue, size)) if way[c]]
            if of_row:
                black.append(f"tray(r{i}, " + " or ".join(of_row) + ")")
        text += f"rule black-{c} using rows = " + " or ".join(black or ["tray(r0 or r1) and tray(r2)"]) + "\n"
        text += f"rule white-{c} using rows = any where not black-{c}\n"
    text += f"library pictures using rows {{\n  trays {size}\n"
    text += "  require neighbour(beginning, " + ", ".join(f"tray(r{i})" for i in range(size)) + ", end)\n"
    for c, clue in enumerate(columns):
        parts = []
        for k, run in enumerate(clue):
            parts.append(f"many(white-{c})" if k else f"optional(many(white-{c}))")
            parts.append(f"repeat(black-{c}, {run})")
        parts.append(f"optional(many(white-{c}))" if clue else f"many(white-{c})")
        text += "  require neighbour(beginning, " + ", ".join(parts) + ", end)\n"
    return text + "}\n"


def main():
    tartan, size = sys.argv[1], int(sys.argv[2])
    chance = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    picture, rows, columns = picture_of(size, chance)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "nonogram.plan")
        with open(path, "w", encoding="utf-8") as file:
            file.write(plan_file(rows, columns, size))
        done = subprocess.run([tartan, "enumerate", path, "--max-states", "1"], capture_output=True, text=True, check=False)
        if done.returncode != 0 or "found by search" not in done.stderr:
            sys.exit(f"enumerate ends with {done.returncode}: {done.stderr}")
    found = done.stdout.splitlines()
    if len(found) != 1:
        sys.exit(f"{len(found)} pictures, and not one")
    for i, (tray, row) in enumerate(zip(found[0].split(" | "), picture)):
        name, way = tray.split()
        if name != f"r{i}" or list(ways(rows[i], size)[int(way[1:])]) != row:
            sys.exit(f"row {i} is wrong: {tray}")
    print("\n".join("".join("#" if cell else "." for cell in row) for row in picture))


if __name__ == "__main__":
    main()
