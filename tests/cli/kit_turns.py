"""Turns and moves the worlds of kits, and compares what is placed, for each of the 24 turns of a cube.

It shares nothing with the engine: turns are matrices here, and a turned world is a space and a start that were turned as they are written.
"""
import itertools
import random
import subprocess
import sys

tartan, folder = sys.argv[1:]

# In a kit y is up: x, y, z; left is -x, front is -z.
AXES = {"up": (0, 1, 0), "down": (0, -1, 0), "left": (-1, 0, 0), "right": (1, 0, 0), "front": (0, 0, -1), "back": (0, 0, 1)}


def apply(m, v):
    return tuple(sum(m[i][k] * v[k] for k in range(3)) for i in range(3))


def product(a, b):
    return tuple(tuple(sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)) for i in range(3))


def determinant(m):
    return sum(m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3]) for i in range(3))


TURNS = []
for order in itertools.permutations(range(3)):
    for signs in itertools.product((1, -1), repeat=3):
        m = tuple(tuple(signs[i] if order[i] == j else 0 for j in range(3)) for i in range(3))
        if determinant(m) == 1:
            TURNS.append(m)
assert len(TURNS) == 24


def start_of(m):
    """The direction and quarter turns of a start that was `up` without a turn: right was beside it. One that points down turns about the
    vertical, too."""
    up, right = apply(m, AXES["up"]), apply(m, AXES["right"])
    name = next(n for n, v in AXES.items() if v == up)
    beside = AXES["right"] if name in ("up", "down") else AXES["up"]
    across = tuple(up[(i + 1) % 3] * beside[(i + 2) % 3] - up[(i + 2) % 3] * beside[(i + 1) % 3] for i in range(3))
    # a quarter turn about up takes right to the back: against the right-hand rule about an axis that is up
    ways = [beside, tuple(-c for c in across), tuple(-c for c in beside), across]
    return name, -ways.index(right) % 4 if name == "down" else ways.index(right)


def box(low, high):
    """A box of a kit, which is given by its size and the middle of its floor."""
    size = [h - l for l, h in zip(low, high)]
    at = ((low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2)
    return f"box({size[0]}, {size[1]}, {size[2]}) at ({at[0]:g}, {at[1]:g}, {at[2]:g})"


def turned_box(m, by, low, high):
    a, b = apply(m, low), apply(m, high)
    return box([min(p, q) + d for p, q, d in zip(a, b, by)], [max(p, q) + d for p, q, d in zip(a, b, by)])


def parts_of(kit, seed):
    path = f"{folder}/world.kit"
    with open(path, "w", encoding="ascii") as out:
        out.write(kit)
    run = subprocess.run([tartan, "place", path, "-o", "-", "--seed", str(seed)], capture_output=True, text=True, check=False)
    assert run.returncode == 0, (kit, run.stderr)
    parts = []
    for line in run.stdout.splitlines():
        if line.startswith("1 "):
            words = line.split()
            numbers = [int(w) for w in words[2:14]]
            at = (numbers[0], -numbers[1], numbers[2])  # heights upwards
            m = [numbers[3:6], numbers[6:9], numbers[9:12]]
            flip = (1, -1, 1)
            turn = tuple(tuple(flip[i] * m[i][j] * flip[j] for j in range(3)) for i in range(3))
            parts.append((words[14], words[1], at, turn))
    return parts


SEARCHES = ("", "order breadth;", "search beam 3; minimize open;", "search anneal 40; minimize open;", "search exact; maximize cells;")


def world(choice, m, by, upright, search):
    """A kit with random parts, whose world is turned by m and moved by `by`."""
    low, high, hole = (-60, -40, -50), (70, 80, 60), [(30, 20, -30), (60, 60, 10)]
    if "exact" in search:
        low, high, hole = (-30, -20, -20), (20, 20, 40), [(10, 0, 10), (20, 10, 20)]
    name, turns = start_of(m)
    at = apply(m, (0, 0, 0))
    turn = f" turn {turns}" if turns else ""
    unit = "unit 10 x 10 x 10;" if upright else "unit 10 x 10 x 10 turns 24;"
    return f"""{unit}
connector plug joins hole turns {choice.choice((1, 2, 4))};
connector hole joins plug turns {choice.choice((1, 2, 4))};
connector side joins side turns {choice.choice((1, 2, 4))};
part long {{ fill 20 x 10 x 40; plug up at (0, 0, 10); hole down at (0, -10, -10); plug {choice.choice(("left at (-10, 0, 0)", "front at (0, -10, -20)", "right at (10, -10, 0)"))}; side back at (0, 0, 20); }}
part odd {{ fill 20 x 10 x 20; fill 10 x 10 x 20 at (5, -10, 0); plug up; hole {choice.choice(("down at (0, -20, 0)", "left at (-10, -10, 0)"))}; side left at (-10, 0, 10); }}
rule any at plug, hole, side = {choice.choice(("long | odd", "odd | long", "(long [0.5] | odd [0.5]) | odd"))};
model it {{ inside {turned_box(m, by, low, high)} and not {turned_box(m, by, *hole)};
  start plug {name} at ({at[0] + by[0]}, {at[1] + by[1]}, {at[2] + by[2]}){turn} by any; {search} }}
"""


def check(seed, upright, search):
    turns = [m for m in TURNS if not upright or m[1] == (0, 1, 0)]
    same = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    plain = parts_of(world(random.Random(seed), same, (0, 0, 0), upright, search), seed)
    assert len(plain) > 1
    for m in turns if seed % 4 == 0 else random.Random(seed).sample(turns, 3):
        by = tuple(10 * random.Random(seed).randint(-9, 9) for _ in range(3))
        found = parts_of(world(random.Random(seed), m, by, upright, search), seed)
        wanted = [(name, colour, tuple(p + d for p, d in zip(apply(m, at), by)), product(m, turn)) for name, colour, at, turn in plain]
        assert found == wanted, (seed, upright, search, m, by)
    return len(plain), {turn for _, _, _, turn in plain}


most, seen = 0, set()
for seed in range(12):
    for upright in (False, True):
        count, turns = check(seed, upright, SEARCHES[(2 * seed + upright) % len(SEARCHES)])
        most = max(most, count)
        if not upright:
            seen |= turns
assert most > 20 and len(seen) > 12, (most, len(seen))
