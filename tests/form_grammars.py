"""Sentences of the grammars that promise something of their surfaces keep it: genr8-symmetric has an axis of symmetry,
genr8-dividing divides, genr8-quads has plane faces of four sides that do not run through each other."""
import collections, json, math, os, subprocess, sys, tempfile

SENTENCES = int(os.environ.get("TARTAN_SENTENCES", "60"))
FOLDER = tempfile.mkdtemp()


def run(*words):
    done = subprocess.run([os.environ["TARTAN"], *words], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"tartan {' '.join(words)}: {done.stderr}")
    return done.stdout


def sentences(grammar):
    out = run("map", grammar, "--random", str(SENTENCES), "--seed", "1", "--format", "json")
    found = [json.loads(line) for line in out.splitlines()]
    texts = [one.get("repaired_phenotype") or one["phenotype"] for one in found if one["valid"]]
    if len(texts) < SENTENCES * 9 // 10:
        sys.exit(f"{grammar}: only {len(texts)} sentences")
    return texts


def grow(text, steps):
    path = os.path.join(FOLDER, "one.hemls")
    with open(path, "w") as file:
        file.write(text)
    mesh = os.path.join(FOLDER, "one.obj")
    stats = run("grow", path, "--steps", str(steps), "--scale", "1", "--lines", "--stats", "json", "-o", mesh)
    points, lines = [], []
    with open(mesh) as file:
        for line in file:
            words = line.split()
            if words and words[0] == "v":
                points.append([float(word) for word in words[1:4]])
            elif words and words[0] == "l":
                lines.append([int(word) - 1 for word in words[1:3]])
    return json.loads(stats)[-1], points, lines


def axes_of_symmetry(points, lines, sides):
    """Mirrors of the seed's polygon that bring the middle of each edge to the middle of one."""
    def cell(p):
        return tuple(round(c * 1e4) for c in p)

    middles = [[(points[a][k] + points[b][k]) / 2 for k in range(3)] for a, b in lines]
    counts = collections.Counter(map(cell, middles))
    near = [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)]
    found = 0
    for turn in range(sides):
        angle = math.pi + 2 * math.pi * turn / sides
        c, s = math.cos(angle), math.sin(angle)
        images = (cell((c * x + s * y, s * x - c * y, z)) for x, y, z in middles)
        found += all(any(counts[p[0] + d[0], p[1] + d[1], p[2] + d[2]] for d in near) for p in images)
    return found


def check(what, holds, text):
    if not holds:
        sys.exit(f"{what}: {text}")


for sentence in sentences("genr8-symmetric"):
    _, points, lines = grow(sentence, 3)
    sides = sentence.split(";")[0].count("+") + 1
    check("no axis of symmetry", axes_of_symmetry(points, lines, sides), sentence)
for sentence in sentences("genr8-dividing"):
    check("an outline", grow(sentence, 1)[0]["F"] > 1, sentence)
for sentence in sentences("genr8-quads"):
    stats = grow(sentence, 3)[0]
    measures = stats["measures"]
    sound = set(stats["face_sides"]) == {"4"} and measures["worst-planarity"] < 1e-9 and measures["crossings"] == 0
    check("not plane, or not of four sides", sound, sentence)

# of what the examples must be able to tell apart: a surface without an axis
_, points, lines = grow("A + B + C + A ; A -> A [ [ + B ] - B ] A ; B -> + A - - A + ; Angle 60", 2)
check("an axis where there is none", axes_of_symmetry(points, lines, 4) == 0, "test")
