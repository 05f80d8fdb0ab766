#!/usr/bin/env python3
"""Meshes of random fields against a slow independent reference: field_oracle.py FOLDER COUNT.

FOLDER has contour.py. TARTAN is the binary. Vertices must agree to 1e-9 of a cell, triangles exactly; and the mesh of each
field must be the same bytes by the interpreter and by rows, at one thread and at four."""
import os, random, struct, subprocess, sys, tempfile

sys.path.insert(0, sys.argv[1])
import contour

TARTAN = os.environ["TARTAN"]
N = 14


def field(r, depth):
    if depth == 0 or r.random() < 0.12:
        return r.choice(["x", "y", "z", "x", "y", "z", "%.2f" % r.uniform(0.1, 4), "%.2f" % r.uniform(0.1, 4)])
    down = lambda: field(r, depth - 1)
    kind = r.randrange(26)
    if kind < 8:
        return "(%s%s%s)" % (down(), "+-*+-*/%"[kind], down())
    if kind < 18:
        name = ["sqrt", "abs", "square", "sin", "cos", "tanh", "floor", "exp", "log", "tan"][kind - 8]
        return "%s(%s)" % (name, down())
    if kind == 18:
        return "pow(%s,%d)" % (down(), r.choice([2, 2, 3, 4, 5, -1]))
    if kind == 19:
        return "pow(abs(%s),%.1f)" % (down(), r.uniform(0.3, 2))
    if kind < 22:
        return "%s(%s,%s,%s)" % (["min", "max"][kind - 20], down(), down(), down())
    if kind == 22:
        return "blend(%s,%s,%.1f)" % (down(), down(), r.uniform(0, 2))
    if kind == 23:
        return r.choice(["clamp(%s,%s,%s)", "mix(%s,%s,%s)"]) % (down(), down(), down())
    if kind == 24:
        return "noise(%s,%s,%s)" % (down(), down(), down())
    return "atan2(%s,%s)" % (down(), down())


def read_ply(data):
    head, body = data.split(b"end_header\n", 1)
    counts = [int(line.split()[2]) for line in head.decode().splitlines() if line.startswith("element")]
    vertices = [struct.unpack_from("<3d", body, 24 * i) for i in range(counts[0])]
    at = 24 * counts[0]
    faces = [struct.unpack_from("<3I", body, at + 1 + 13 * i) for i in range(counts[1])]
    return vertices, faces


def mesh(path, *options):
    out = path + ".ply"
    if os.path.exists(out):
        os.remove(out)
    done = subprocess.run([TARTAN, "mesh", path, "--grid", str(N), "-o", out, *options], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit("%s: exit %d\n%s" % (open(path).read(), done.returncode, done.stderr))
    return open(out, "rb").read()


def main():
    r = random.Random(20)
    some = 0
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.field")
        for _ in range(int(sys.argv[2])):
            text = "(%s)-%.2f" % (field(r, 4), r.uniform(-2, 6))
            with open(path, "w") as f:
                f.write(text + "\n")
            data = mesh(path, "--threads", "1")
            for others in (["--threads", "4"], ["--engine", "vm"]):
                if mesh(path, *others) != data:
                    sys.exit("%s\ndiffers with %s" % (text, others))
            got_v, got_t = read_ply(data)
            want_v, want_t = contour.contour(N, text)
            cell = 14 / (N - 1)
            if len(got_v) != len(want_v) or got_t != [tuple(t) for t in want_t]:
                sys.exit("%s\n%d vertices, %d triangles; the reference has %d and %d" % (text, len(got_v), len(got_t), len(want_v), len(want_t)))
            worst = max((abs(a - b) for p, q in zip(got_v, want_v) for a, b in zip(p, q)), default=0)
            if worst > 1e-9 * cell:
                sys.exit("%s\na vertex is %g of a cell away" % (text, worst / cell))
            some += len(got_v) > 0
    print("%d of %d fields have a surface; all agree" % (some, int(sys.argv[2])))


main()
