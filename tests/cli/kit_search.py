"""Searches in random kits and checks what is found: kit_search.py TARTAN BRICKS.kit EXACT ANY

The models of small spaces are listed here by brute force, and `search exact` has to look at as many and find one as good. Every model that any
search finds lies in its space, has nothing in its way, is its own image, keeps to its stock, and has no open connector where a part has room.
This knows nothing of the engine. EXACT kits are searched wholly, ANY in all ways."""
import itertools, json, os, random, re, subprocess, sys, tempfile

from kit_check import PARTS, cells, pieces, read, studs, tubes

tartan, bricks = sys.argv[1:3]
exacts, anys = map(int, sys.argv[3:])


def run(kit, *more):
    return subprocess.run([tartan, "place", kit, *more], capture_output=True, text=True)


def write(path, space, names, start, lines, rule="stud, tube"):
    """space: (wide, high, deep) studs and bricks, standing on the ground; centred, or with its corner at the origin."""
    wide, high, deep, centred = space
    at = (0, 0) if centred else (wide / 2, deep / 2)
    with open(path, "w") as file:
        file.write('use "%s";\n' % os.path.abspath(bricks))
        file.write("rule grow at %s = %s;\n" % (rule, " | ".join(names)))
        file.write("model one { inside box(%d studs, %d bricks, %d studs) at (%g studs, 0, %g studs); start stud at (%g studs, 0, %g studs) by grow; %s }\n"
                   % (wide, high, deep, *at, start[0] + 0.5, start[2] + 0.5, lines))


def room_of(space):
    wide, high, deep, centred = space
    low = (-wide // 2, -deep // 2) if centred else (0, 0)
    return {(x, y, z) for x in range(low[0], low[0] + wide) for y in range(3 * high) for z in range(low[1], low[1] + deep)}


def placements(place, up, names):
    """All parts that join at the square: above it (up) or below."""
    x, y, z = place
    found = []
    for name in names:
        length, high, wide, has_studs = PARTS[name]
        for turned in (False, True) if length != wide else (False,):
            l, w = (wide, length) if turned else (length, wide)
            found += [(x - i, y if up else y - high, z - k, turned, name) for i in range(l) for k in range(w) if up or has_studs]
    return found


def image(part, symmetry):
    x, y, z, turned, name = part
    length, _, wide, _ = PARTS[name]
    l, w = (wide, length) if turned else (length, wide)
    if symmetry == "turn 2":
        return {part, (-x - l, y, -z - w, turned, name)}
    if symmetry == "turn 4":  # (x, z) to (-z, x) and so on
        square = length == wide
        quarter = (-z - w, y, x, not turned and not square, name)
        return image(part, "turn 2") | image(quarter, "turn 2")
    if symmetry == "mirror x":
        return {part, (-x - l, y, z, turned, name)}
    if symmetry == "mirror z":
        return {part, (x, y, -z - w, turned, name)}
    return {part}


def fits(part, free, symmetry, stock, used):
    images = image(part, symmetry)
    filled = [c for one in images for c in cells(one)]
    return len(filled) == len(set(filled)) and set(filled) <= free and used.get(part[4], 0) + len(images) <= stock.get(part[4], 10**9)


def open_places(parts, start, at):
    """The connectors at which the rule goes on: (square, up)."""
    above = set().union(*(tubes(p) for p in parts)) if parts else set()
    below = set().union(*(studs(p) for p in parts)) if parts else set()
    places = [(p, True) for p in below - above if "stud" in at] + [(p, False) for p in above - below if "tube" in at]
    return places + ([(start, True)] if start not in above else [])


def brute_force(room, names, start, at, may_stop):
    """All complete models, as sets of parts."""
    seen, waiting, complete = {frozenset()}, [frozenset()], set()
    while waiting:
        model = waiting.pop()
        free = room - set().union(*(cells(p) for p in model)) if model else room
        more = {p for place, up in open_places(model, start, at) for p in placements(place, up, names) if cells(p) <= free}
        if may_stop or not more:
            complete.add(model)
        for part in more:
            bigger = model | {part}
            if bigger not in seen:
                seen.add(bigger)
                waiting.append(bigger)
        if len(seen) > 60000:
            return None
    return complete


def joints(model):
    return sum(len(studs(a) & tubes(b)) for a in model for b in model)


def check_exact(seed, folder):
    r = random.Random(seed)
    names = r.sample(["3005", "3004", "3003", "3622"], r.randint(1, 3))
    space = (r.randint(1, 3), r.randint(1, 2), r.randint(1, 3), False)
    start, at, may_stop = (r.randrange(space[0]), 0, r.randrange(space[2])), r.choice(["stud, tube", "stud"]), r.random() < 0.2
    models = brute_force(room_of(space), names, start, at, may_stop)
    if models is None or len(models) > 5000:
        return 0
    kit, out = os.path.join(folder, "exact.kit"), os.path.join(folder, "exact.ldr")
    rule = names + (["{}"] if may_stop else [])
    write(kit, space, rule, start, "maximize joints; search exact;", at)
    done = run(kit, "--stats", "json", "-o", out)
    if max(map(len, models)) == 0:
        assert "E1314" in done.stderr, (seed, done)
        return 0
    assert done.returncode == 0, (seed, done.stderr)
    stats = json.loads(done.stdout)
    assert stats["models"] == len(models), "seed %d: %d models, not %d" % (seed, stats["models"], len(models))
    assert stats["proved"] == 1
    assert joints(read(out)) == max(map(joints, models)), "seed %d: there is a better model" % seed
    write(kit, space, rule, start, "require elements > 0; minimize elements; search exact;", at)
    done = run(kit, "--stats", "json", "-o", out)
    assert json.loads(done.stdout)["elements"] == min(len(m) for m in models if m), "seed %d: there is a smaller model" % seed
    return len(models)


def check_any(seed, folder):
    r = random.Random(seed)
    symmetry = r.choice(["", "", "turn 2", "turn 4", "mirror x", "mirror z"])
    names = r.sample([n for n in PARTS if PARTS[n][0] <= 4 and PARTS[n][2] <= 4], r.randint(1, 4))
    side = 2 * r.randint(1, 4)
    space = (side, r.randint(1, 3), side, True) if symmetry else (r.randint(2, 6), r.randint(1, 3), r.randint(2, 6), False)
    start = (0, 0, 0) if symmetry else (r.randrange(space[0]), 0, r.randrange(space[2]))
    stock = {n: r.randint(0, 9) for n in names if r.random() < 0.3}
    search = r.choice(["greedy", "beam 1", "beam 4", "anneal 40"])
    lines = ("symmetry %s; " % symmetry if symmetry else "") + ("stock %s; " % ", ".join("%s <= %d" % s for s in stock.items()) if stock else "")
    lines += "minimize elements; search %s;" % search
    kit, out = os.path.join(folder, "any.kit"), os.path.join(folder, "any.ldr")
    write(kit, space, names, start, lines)
    done = run(kit, "-o", out, "--seed", str(seed), *(() if search == "greedy" else ("--threads", "1")))
    room = room_of(space)
    if "E1314" in done.stderr:
        assert not any(fits(p, room, symmetry, stock, {}) for p in placements(start, True, names)), (seed, "there is room at the start")
        return 0
    assert done.returncode == 0, (seed, done.stderr)
    parts, used, filled = read(out), {}, set()
    for part in parts:
        used[part[4]] = used.get(part[4], 0) + 1
        assert cells(part) <= room and not cells(part) & filled, (seed, part)
        filled |= cells(part)
    assert all(used.get(n, 0) <= most for n, most in stock.items()), (seed, "more than the stock has")
    square = lambda p: (*p[:3], p[3] and PARTS[p[4]][0] != PARTS[p[4]][2], p[4])
    model = {square(p) for p in parts}
    assert all(square(i) in model for p in parts for i in image(p, symmetry)), (seed, symmetry, "not its own image")
    for place, up in open_places(parts, start, "stud, tube") if not stock or not symmetry else ():
        room_left = [p for p in placements(place, up, names) if fits(p, room - filled, symmetry, stock, used)]
        assert not room_left, (seed, search, symmetry, "there is room", place, room_left)
    if search == "beam 1":
        again = os.path.join(folder, "again.ldr")
        write(kit, space, names, start, lines.replace("beam 1", "greedy"))
        assert run(kit, "-o", again).returncode == 0 and read(again) == parts, (seed, "a beam of 1 is not greedy")
    elif search != "greedy":
        again = os.path.join(folder, "again.ldr")
        assert run(kit, "-o", again, "--seed", str(seed), "--threads", "4").returncode == 0
        assert open(again).read() == open(out).read(), (seed, "another model with 4 threads")
    return len(parts)


with tempfile.TemporaryDirectory() as folder:
    exact = [check_exact(seed, folder) for seed in range(exacts)]
    found = [check_any(seed, folder) for seed in range(anys)]
assert sum(n > 1 for n in exact) > exacts // 3 and max(exact) > 100, "too few models: %s" % exact
assert sum(n > 1 for n in found) > anys // 2 and max(found) > 20, "too little was placed"
