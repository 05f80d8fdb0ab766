"""Places models of random kits and checks each: kit_check.py TARTAN BRICKS.kit

Every part lies in the model's space and in nobody's way, the pieces are as many as `require` is told, and no connector that is left open has
room for a part of the rule. This reads parts from the library's text and knows nothing of the engine."""
import itertools, random, re, subprocess, sys, tempfile, os

tartan, bricks = sys.argv[1:3]
PARTS = {}
for name, body in re.findall(r'^part (\S+) .*?\{(.*?)^\}', open(bricks).read(), re.M | re.S):
    if "slope" in body:
        continue  # slopes: this knows plain boxes
    length, high, unit, wide = re.search(r"fill (\d+) studs? x (\d+) (\w+) x (\d+) stud", body).groups()
    PARTS[name] = (int(length), {"brick": 3, "plate": 1}[unit], int(wide), "studs up" in body)


def cells(part):
    """Studs' squares and plates: (x, y, z), y upwards from the ground."""
    x, y, z, turned, name = part
    length, high, wide, _ = PARTS[name]
    if turned:
        length, wide = wide, length
    return {(i, y + j, k) for i in range(x, x + length) for j in range(high) for k in range(z, z + wide)}


def studs(part):
    tops = cells(part)
    level = max(c[1] for c in tops)
    return {(x, level + 1, z) for x, y, z in tops if y == level} if PARTS[part[4]][3] else set()


def tubes(part):
    bottom = cells(part)
    level = min(c[1] for c in bottom)
    return {(x, level, z) for x, y, z in bottom if y == level}


def read(path):
    parts = []
    for line in open(path):
        if not line.startswith("1 "):
            continue
        f = line.split()
        x, y, z = (float(v) for v in f[2:5])
        name = f[14][:-4]
        length, high, wide, _ = PARTS[name]
        turned = f[5] == "0"
        if turned:
            length, wide = wide, length
        corner = x / 20 - length / 2, -y / 8 - high, z / 20 - wide / 2
        assert all(abs(v - round(v)) < 1e-9 for v in corner), line
        parts.append((*map(round, corner), turned, name))
    return parts


def pieces(parts):
    above = {}
    for i, part in enumerate(parts):
        for place in tubes(part):
            above[place] = i
    roots = list(range(len(parts)))

    def root(i):
        while roots[i] != i:
            i = roots[i]
        return i

    for i, part in enumerate(parts):
        for place in studs(part):
            if place in above:
                roots[root(i)] = root(above[place])
    return len({root(i) for i in range(len(parts))})


def fits_somewhere(place, up, names, free):
    """Has a part room whose connector joins at the square, above it or below?"""
    x, y, z = place
    for name in names:
        length, high, wide, has_studs = PARTS[name]
        if not up and not has_studs:
            continue
        for turned in (False, True):
            l, w = (wide, length) if turned else (length, wide)
            for i, k in itertools.product(range(l), range(w)):
                if cells((x - i, y if up else y - high, z - k, turned, name)) <= free:
                    return True
    return False


def check(seed, folder):
    r = random.Random(seed)
    wide, high, deep = r.randint(2, 9), r.randint(1, 5), r.randint(1, 7)
    names = r.sample([n for n in PARTS if max(PARTS[n][0], PARTS[n][2]) <= 4], r.randint(1, 4))
    hole = (r.randint(1, 3), r.randint(1, 2), r.randint(1, 3))
    # Corners of all squares are whole studs from the corner of the space.
    space = {(x, y, z) for x in range(wide) for y in range(3 * high) for z in range(deep)}
    cut = {(x, y, z) for x in range(hole[0]) for y in range(3 * hole[1]) for z in range(hole[2])} if r.random() < 0.6 else set()
    start = (r.randrange(wide), 0, r.randrange(deep))
    text = 'use "%s";\n' % os.path.abspath(bricks)
    text += "space all = box(%d studs, %d bricks, %d studs) at (%g studs, 0, %g studs);\n" % (wide, high, deep, wide / 2, deep / 2)
    text += "space cut = box(%d studs, %d bricks, %d studs) at (%g studs, 0, %g studs);\n" % (*hole, hole[0] / 2, hole[2] / 2)
    text += "rule grow at stud, tube = %s;\n" % " | ".join(names)
    text += "model one { inside all%s; start stud at (%g studs, 0, %g studs) by grow; require components = PIECES, fill = FILL, overlaps = 0, open = OPEN, elements = COUNT, height = HEIGHT; }\n" % (
        " and not cut" if cut else "", start[0] + 0.5, start[2] + 0.5)
    kit, out = os.path.join(folder, "one.kit"), os.path.join(folder, "one.ldr")
    free = space - cut
    with open(kit, "w") as file:
        file.write(re.sub(r" require.*;", "", text))
    done = subprocess.run([tartan, "place", kit, "-o", out], capture_output=True, text=True)
    if "E1314" in done.stderr:
        assert not fits_somewhere(start, True, names, free), "seed %d: there is room at the start" % seed
        return 0
    assert done.returncode == 0, (seed, done.stderr)
    parts = read(out)
    filled = set()
    for part in parts:
        own = cells(part)
        assert own <= free, "seed %d: %s is outside" % (seed, part)
        assert not own & filled, "seed %d: %s overlaps" % (seed, part)
        filled |= own
    empty = free - filled
    count_open = 0
    above = set().union(*(tubes(p) for p in parts))
    below = set().union(*(studs(p) for p in parts))
    for place in below ^ above:
        count_open += 1
        up = place in below
        assert not fits_somewhere(place, up, names, empty), "seed %d: there is room at %s" % (seed, place)
    figures = {"PIECES": pieces(parts), "OPEN": count_open, "COUNT": len(parts),
               "HEIGHT": 8 * (max(c[1] for c in filled) - min(c[1] for c in filled) + 1), "FILL": "%d / %d" % (len(filled), len(free))}
    for word, value in figures.items():
        text = text.replace(word, str(value))
    with open(kit, "w") as file:
        file.write(text)
    done = subprocess.run([tartan, "place", kit, "-o", out], capture_output=True, text=True)
    assert done.returncode == 0, (seed, done.stderr)
    return len(parts)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        placed = [check(seed, folder) for seed in range(150)]
    assert sum(n > 0 for n in placed) > 75 and max(placed) > 20, "too little was placed"
