"""Makes parts with slopes of every direction and size, in every turn, and looks at their cells and at the meshes of models.

It shares nothing with the engine: a cell is left where its middle is on this side of the plane through two edges of the box.
"""
import random
import re
import subprocess
import sys

tartan, folder = sys.argv[1:]
AXES = {"up": (1, 1), "down": (1, -1), "left": (0, -1), "right": (0, 1), "front": (2, -1), "back": (2, 1)}  # y is up
HEAD = "connector plug joins hole turns 4;\nconnector hole joins plug turns 4;\n"


def run(*words):
    done = subprocess.run([tartan, *words], capture_output=True, text=True, check=False)
    assert done.returncode == 0, (words, done.stderr)
    return done.stdout


def kept(size, sides):
    """The cells that are left, from the low corner of the box, y up."""
    cells = set()
    for x in range(size[0]):
        for y in range(size[1]):
            for z in range(size[2]):
                beyond = 0
                for k, way in (AXES[s] for s in sides):
                    part = (2 * (x, y, z)[k] + 1) / (2 * size[k])
                    beyond += part if way > 0 else 1 - part
                if beyond < 1 - 1e-12:
                    cells.add((x, y, z))
    return cells


def check_cells(rng):
    one, other = rng.sample(sorted(AXES), 2)
    while AXES[one][0] == AXES[other][0]:
        one, other = rng.sample(sorted(AXES), 2)
    size = [2 * rng.randint(1, 6) for _ in range(3)]
    with open(f"{folder}/cells.kit", "w", encoding="ascii") as out:
        out.write(f"unit 10 x 8 x 10;\n{HEAD}part it {{ slope {one} {other} {10 * size[0]} x {8 * size[1]} x {10 * size[2]}; plug up; }}\n")
    found = set()
    for line in run("disasm", f"{folder}/cells.kit").splitlines():
        if line.startswith("  part box"):
            n = dict(re.findall(r"((?:low|high)_[xyz]) (-?\d+)", line))
            box = [(int(n["low_" + a]), int(n["high_" + a])) for a in "xyz"]
            for x in range(*box[0]):
                for y in range(*box[1]):
                    for z in range(*box[2]):
                        cell = (x + size[0] // 2, size[1] - 1 - y, z + size[2] // 2)
                        assert cell not in found
                        found.add(cell)
    assert found == kept(size, (one, other)), (one, other, size)


def mesh(path):
    corners, faces = [], []
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            words = line.split()
            if words[:1] == ["v"]:
                corners.append(tuple(float(w) for w in words[1:4]))
            elif words[:1] == ["f"]:
                faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return corners, faces


def closed_volume(path):
    """Fails unless every edge has its opposite once."""
    corners, faces = mesh(path)
    edges, volume = set(), 0
    for face in faces:
        for a, b in zip(face, face[1:] + face[:1]):
            assert (a, b) not in edges, path
            edges.add((a, b))
        for i in range(1, len(face) - 1):
            p, q, r = (corners[face[j]] for j in (0, i, i + 1))
            volume += p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0])
    assert all((b, a) in edges for a, b in edges), path
    return volume / 6 / 0.4 ** 3  # cubic LDU


KIT = """unit 10 x 10 x 10 turns 24;
connector plug joins hole turns 4;
connector hole joins plug turns 4;
part wedge { fill 30 x 10 x 20 at (5, 0, 0); slope %s %s 30 x 30 x 30 at (5, -10, 5); plug up; hole down at (0, -40, 0); hole left at (-10, -20, 0); }
part block { fill 20 x 20 x 20; plug up; hole down at (0, -20, 0); plug left at (-10, -10, 0); plug back at (0, -10, 10); }
rule any at plug, hole = (wedge [0.6] | block [0.4]) | block;
model it { inside box(100, 90, 80); start plug up at (0, 0, 0) by any; %s }
"""


def check_models(seed):
    rng = random.Random(seed)
    one, other = rng.choice((("up", "front"), ("down", "front"), ("left", "up"), ("left", "front"), ("up", "back"), ("down", "right")))
    with open(f"{folder}/model.kit", "w", encoding="ascii") as out:
        out.write(KIT % (one, other, rng.choice(("", "order breadth;"))))
    run("place", f"{folder}/model.kit", "--seed", str(seed), "-o", f"{folder}/model.obj", "-o", f"{folder}/model.ldr", "-o", f"{folder}/model.svg")
    with open(f"{folder}/model.ldr", encoding="ascii") as lines:
        names = [line.split()[14] for line in lines if line.startswith("1 ")]
    wedges, blocks = sum("wedge" in n for n in names), sum("block" in n for n in names)
    cells = len(kept((3, 3, 3), (one, other)))
    slope, steps = 30 * 30 * 30 / 2, 1000 * cells
    rest = closed_volume(f"{folder}/model.obj") - 8000 * blocks - 6000 * wedges
    drawn = (rest - steps * wedges) / (slope - steps)  # how many as slopes, the others as steps
    assert abs(drawn - round(drawn)) < 1e-3 and 0 <= round(drawn) <= wedges, (seed, drawn, wedges, blocks)
    return wedges, round(drawn)


chosen = random.Random(1)
for _ in range(40):
    check_cells(chosen)
many = slopes = 0
for number in range(24):
    wedges, drawn = check_models(number)
    many += wedges
    slopes += drawn
assert many > 60 and 0 < slopes < many, (many, slopes)
