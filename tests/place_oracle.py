#!/usr/bin/env python3
"""Random connection grammars, derived by an independent slow model and by tartan: place_oracle.py MODEL.py TARTAN FIRST COUNT

Where the model comes to its end, tartan writes the same bytes, counts the same steps and tries, and its two ways of looking ahead agree.
Where a step of the model fails for good, tartan refuses too. What the model itself refuses or cannot finish is passed over."""
import importlib.util, json, os, random, subprocess, sys, tempfile

OPERATIONS = 4000  # of a run of the model


class TooLong(Exception):
    pass


def load(path):
    spec = importlib.util.spec_from_file_location("model", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    plain = module.M.ex
    count = [0]

    def counted(self, *args):
        count[0] += 1
        if count[0] > OPERATIONS:
            raise TooLong
        return plain(self, *args)

    module.M.ex = counted
    module.count = count
    return module


def terminal(r):
    kind = r.randrange(12)
    if kind < 4:
        return "Move(%d,%d,%d)" % tuple(r.randint(-3, 3) for _ in range(3))
    if kind < 6:
        return "FillRect(%d,%d,%d)" % (r.randint(1, 4), r.randint(1, 3), r.randint(1, 4))
    if kind == 6:
        return "FillRectNoCheck(%d,%d,%d)" % (r.randint(-2, 4), r.randint(0, 3), r.randint(1, 4))
    if kind == 7:
        return "Rotate(%d)" % (90 * r.randint(-4, 8) + r.choice((0, 0, 45)))
    if kind == 8:
        return r.choice(("AssertFilled()", "SetColor(%d)" % r.randint(-2, 300)))
    if kind == 9 and r.random() < 0.15:
        return r.choice(("PlaceBoundingBox(2,3,2)", "PlaceBoundingSphere(5)"))
    return "Place(part%d)" % r.randrange(4)


def alternative(r, symbols, depth=0):
    """Begins with a terminal, and has one between symbols: the published program skips others, and then crashes."""
    if r.random() < 0.15 and depth == 0:
        return []
    items = []
    for _ in range(r.randint(1, 3)):
        items.append("'%s'" % terminal(r))
        if r.random() < 0.5:
            items.append(r.choice(symbols))
    if depth < 3 and r.random() < 0.5:
        items = ["'('"] + items + ["')'"]
        if r.random() < 0.4:
            items += alternative(r, symbols, depth + 1)
    return items


def grammar(seed):
    r = random.Random(seed)
    symbols = ["S%d" % i for i in range(r.randint(1, 5))]
    bound = r.choice(("'PlaceBoundingBox(4,4,4)' ", "'PlaceBoundingBox(6,3,5)' ", "'PlaceBoundingSphere(6)' ", ""))
    lines = ["Start -> %s'Place(seed)' %s" % (bound, " 'Move(0,-3,0)' ".join(r.choice(symbols) for _ in range(r.randint(1, 3))))]
    for symbol in symbols:
        count = r.randint(1, 4)
        drawn = r.random() < 0.25
        weights = [r.randint(0, 4) for _ in range(count)]
        for i in range(count):
            text = " ".join(alternative(r, symbols))
            if drawn and sum(weights):
                text += " [%.17g]" % (weights[i] / sum(weights))
            lines.append("%s -> %s" % (symbol, text))
        if r.random() < 0.6 and not drawn:
            lines.append("%s ->" % symbol)
    return "\n".join(lines) + "\n"


def expected(model, text, seed):
    """What the model writes; None where it refuses; an exception where it says nothing."""
    model.count[0] = 0
    try:
        m, steps, stats = model.run(text, seed)
    except model.Fail:
        return None
    lines = ["1 %d %d %d %d %s %s.dat\n0 STEP\n" % (c, x * 10, y * 8, z * 10, " ".join(map(str, model.ROT[d])), p.replace("r", ""))
             for (x, y, z, d, c), p in m.el]
    return "".join(lines), len(m.el), steps, stats[0]


def compare(model, tartan, folder, seed):
    text = grammar(seed)
    path, out = os.path.join(folder, "g.pcfg"), os.path.join(folder, "out.ldr")
    try:
        wanted = expected(model, text, seed)
    except (TooLong, RecursionError, RuntimeError, IndexError):
        return "passed over"
    with open(path, "w") as file:
        file.write(text)
    if os.path.exists(out):
        os.remove(out)
    command = [tartan, "place", path, "--seed", str(seed), "-o", out, "--stats", "json"]
    for engine in ("auto", "vm"):
        ran = subprocess.run(command + ["--engine", engine], capture_output=True, text=True)
        if wanted is None:
            if ran.returncode != 1 or os.path.exists(out):
                return "the model refuses, tartan (%s) says %d" % (engine, ran.returncode)
            continue
        if ran.returncode != 0:
            return "tartan (%s) says %d: %s" % (engine, ran.returncode, ran.stderr[-400:])
        written = open(out).read()
        if written != wanted[0]:
            return "other bytes (%s)" % engine
        said = json.loads(ran.stdout)
        if (said["elements"], said["terminals"], said["tries"]) != wanted[1:]:
            return "other figures (%s): %s, not %s" % (engine, ran.stdout, wanted[1:])
    return "refused" if wanted is None else "same"


def main():
    model = load(sys.argv[1])
    sys.setrecursionlimit(3000)
    tally = {}
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(int(sys.argv[3]), int(sys.argv[3]) + int(sys.argv[4])):
            result = compare(model, sys.argv[2], folder, seed)
            if result not in ("same", "refused", "passed over"):
                print("seed %d: %s\n%s" % (seed, result, grammar(seed)))
                return 1
            tally[result] = tally.get(result, 0) + 1
    print(", ".join("%d %s" % (n, name) for name, n in sorted(tally.items())))
    return 0 if tally.get("same", 0) and tally.get("refused", 0) else 1


sys.exit(main())
