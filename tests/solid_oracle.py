#!/usr/bin/env python3
"""Random designs of boxes against a slow independent reference: solid_oracle.py FOLDER COUNT.

FOLDER has ref.py. TARTAN is the binary. The boxes that correction leaves must agree to 1e-12, and volumes to 1e-9: all planes of
symmetry, rigid boxes, flat designs, nested and touching boxes, boxes on a coarse lattice."""
import json, os, random, subprocess, sys, tempfile

sys.path.insert(0, sys.argv[1])
import ref

TARTAN = os.environ["TARTAN"]


def design(r, lattice):
    number = (lambda low, high: round(r.uniform(low, high) * 4) / 4) if lattice else r.uniform
    angle = lambda most: r.choice([-most, -45, 0, 45, most, 30]) if lattice else r.uniform(-most, most)
    flat = r.random() < 0.1
    boxes = [[number(-3, 3), number(-3, 3), number(-3, 3), number(0, 4), number(0, 4), number(0, 4),
              number(-1, 2), angle(180), angle(90)] for _ in range(r.randint(1, 6))]
    if lattice and r.random() < 0.3:  # nested in the first, or a box once more; elsewhere ties would be a matter of rounding
        x, y, z, w, h, d = boxes[0][:6]
        boxes.append([x, y, z] + [s / r.choice([1, 2, 4]) for s in (w, h, d)] + boxes[0][6:])
    return {
        "primitives": boxes,
        "symmetry": "".join(a for a in ("xy" if flat else "xyz") if r.random() < 0.4),
        "inflexible": [i for i in range(len(boxes)) if r.random() < 0.2],
        "two_d": 0.5 if flat else None,
        "planes": r.random() < 0.8,
    }


def text(d, penetration):
    out = ["solid one {"]
    if d["symmetry"]:
        out.append("symmetry %s;" % ", ".join(d["symmetry"]))
    if d["two_d"] is not None:
        out.append("flat %r;" % d["two_d"])
    if not d["planes"]:
        out.append("noclip;")
    if penetration:
        out.append("correct penetration;")
    for i, box in enumerate(d["primitives"]):
        out.append("genes (%s)%s;" % (", ".join(repr(float(g)) for g in box), " rigid" if i in d["inflexible"] else ""))
    return "\n".join(out + ["measure volume, voids, boxes;", "}", ""])


def run(*arguments):
    done = subprocess.run([TARTAN, *arguments], capture_output=True, text=True)
    if done.returncode not in (0, 1):
        sys.exit("%s: exit %d\n%s" % (arguments, done.returncode, done.stderr))
    return done.returncode, done.stdout, done.stderr


def built(d, path):
    """The boxes as written, with the history applied."""
    boxes = ref.decode(d)
    _, out, _ = run("explain", "--json", path)
    for step in json.loads(out):
        box = boxes[int(step["box"].split()[-1]) - 1]
        axis = "xyz".index(step["axis"])
        (box.hi if step["side"] == "high" else box.lo)[axis] = step["after"]
        box.void = box.void or not step["left"]
    return boxes


def differs(a, b):
    if a.void or b.void:
        return a.void != b.void
    return any(abs(x - y) > 1e-12 * (1 + abs(y)) for x, y in zip(a.lo + a.hi, b.lo + b.hi))


def check(seed, path):
    r = random.Random(seed)
    d, penetration = design(r, seed % 2 == 0), r.random() < 0.2
    policy = ref.Policy()
    policy.axis = "minpen" if penetration else "centre"
    open(path, "w").write(text(d, penetration))
    wanted, groups, _ = ref.develop_compact(d, policy)
    for i, (a, b) in enumerate(zip(built(d, path), wanted)):
        if differs(a, b):
            return "box %d: %s %s %s, not %s %s %s" % (i + 1, a.lo, a.hi, a.void, b.lo, b.hi, b.void)
    volume = 0.0
    for box in wanted:
        volume += float(ref.volume(*ref.clip(box, exact=False))[0])
    code, out, errors = run("test", "--json", path)
    if code:
        return None if volume < 1e-9 and "E1512" in errors else "it is refused: %s" % errors
    found = json.loads(out)["solids"][0]["measures"]
    if abs(found["volume"] - volume * len(groups)) > 1e-9 * (1 + volume * len(groups)):
        return "volume %r, not %r" % (found["volume"], volume * len(groups))
    if found["boxes"] != len(wanted) * len(groups) or found["voids"] != sum(b.void for b in wanted) * len(groups):
        return "%r boxes, %r of them void" % (found["boxes"], found["voids"])
    return None


def main():
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "one.solid")
        for seed in range(int(sys.argv[2])):
            wrong = check(seed, path)
            if wrong:
                failures += 1
                print("design %d: %s\n%s" % (seed, wrong, open(path).read()))
    sys.exit(failures > 0)


main()
