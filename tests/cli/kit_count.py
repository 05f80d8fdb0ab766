"""Counts buildings of a few parts by listing them all, and compares: kit_count.py TARTAN BRICKS.kit

A building here is a set of parts on whole studs, grown by adding a part to a smaller one in every possible way. This knows nothing of the
engine."""
import itertools, json, os, random, subprocess, sys, tempfile

from kit_check import PARTS, cells, studs, tubes

tartan, bricks = sys.argv[1:3]


def sides(part):
    length, _, wide, _ = PARTS[part[4]]
    return (wide, length) if part[3] else (length, wide)


def settle(parts):
    """Moved so that the lowest corner is at the origin."""
    low = [min(p[k] for p in parts) for k in range(3)]
    return frozenset((p[0] - low[0], p[1] - low[1], p[2] - low[2], p[3], p[4]) for p in parts)


def quarter(parts):
    turned = set()
    for p in parts:
        length, wide = sides(p)
        square = PARTS[p[4]][0] == PARTS[p[4]][2]
        turned.add((-p[2] - wide, p[1], p[0], not p[3] and not square, p[4]))
    return settle(turned)


def neighbours(part, names):
    for name in names:
        length, high, wide, _ = PARTS[name]
        for turned in (False, True) if length != wide else (False,):
            l, w = (wide, length) if turned else (length, wide)
            for x, z in itertools.product(range(part[0] - l + 1, part[0] + sides(part)[0]), range(part[2] - w + 1, part[2] + sides(part)[1])):
                for y in (part[1] + PARTS[part[4]][1], part[1] - high):
                    other = (x, y, z, turned, name)
                    if studs(part) & tubes(other) or studs(other) & tubes(part):
                        yield other


def grow(buildings, names):
    larger = set()
    for building in buildings:
        filled = set().union(*(cells(p) for p in building))
        for part in building:
            larger.update(settle(building | {other}) for other in neighbours(part, names) if not cells(other) & filled)
    return larger


def ask(names, parts, *more):
    command = [tartan, "count", bricks, "--parts", str(parts), "--json", *more]
    for name in names:
        command += ["--part", name]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def listed(path, names, parts, *more):
    """The buildings that are listed: what stands in each line, as sets of parts on whole studs."""
    command = [tartan, "enumerate", path, "--parts", str(parts), *more]
    for name in names:
        command += ["--part", name]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    buildings = []
    for line in done.stdout.splitlines():
        building = set()
        for part in line.split("; "):
            name, x, y, z, turn = part.split()
            length, high, wide, _ = PARTS[name]
            turned = length != wide and int(turn) % 2 == 1
            if turned:
                length, wide = wide, length
            corner = float(x) / 20 - length / 2, -float(y) / 8 - high, float(z) / 20 - wide / 2
            building.add((corner[0], int(corner[1]), corner[2], turned, name))
        assert len(building) == parts, line
        buildings.append(frozenset(building))
    return buildings


def least(building):
    turns = [settle(building)]
    for _ in range(3):
        turns.append(quarter(turns[-1]))
    return min(tuple(sorted(t)) for t in turns)


total = 0
for names, most in ((["3005"], 6), (["3004"], 4), (["3003"], 4), (["3622"], 3), (["3001"], 3), (["3024"], 4), (["3005", "3004"], 4), (["3004", "3023"], 3), (["3005", "3070b"], 5), (["3003", "3005", "3024"], 3)):
    one = [(0, 0, 0, turned, n) for n in names for turned in ((False, True) if PARTS[n][0] != PARTS[n][2] else (False,))]
    buildings = {frozenset([p]) for p in one}
    for parts in range(1, most + 1):
        if parts > 1:
            buildings = grow(buildings, names)
        different = {min(tuple(sorted(b)), *(tuple(sorted(t)) for t in (quarter(b), quarter(quarter(b)), quarter(quarter(quarter(b)))))) for b in buildings}
        half = sum(quarter(quarter(b)) == b for b in buildings)
        fourth = sum(quarter(b) == b for b in buildings)
        wanted = {"parts": parts, "buildings": len(different), "fixed": len(buildings), "half_turn": half, "quarter_turn": fourth}
        assert ask(names, parts) == wanted, (names, parts, ask(names, parts), wanted)
        assert ask(names, parts, "--fixed", "--threads", "3") == {"parts": parts, "fixed": len(buildings)}
        if len(buildings) < 20000:
            lines = listed(bricks, names, parts)
            assert len(lines) == len(different) and {least(b) for b in lines} == different, (names, parts)
            lines = listed(bricks, names, parts, "--fixed")
            assert len(lines) == len(buildings) and {settle(b) for b in lines} == buildings, (names, parts)
        total += len(buildings)
assert total > 10000, total

# Inside of a space: the same sets, each where it stands, which no part leaves.
def grow_inside(buildings, names, room):
    larger = set()
    for building in buildings:
        filled = set().union(*(cells(p) for p in building))
        for part in building:
            larger.update(building | {other} for other in neighbours(part, names) if not cells(other) & filled and cells(other) <= room)
    return larger


KIT = """use "bricks";
rule any at stud, tube = %s;
model room { inside box(%d studs, %d plates, %d studs)%s; start stud at (%d, 0, %d) by any; }
"""
inside = 0
with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "room.kit")
    for names, size, step, hole, most in ((["3005", "3004"], (3, 6, 2), 3, False, 4), (["3001", "3005"], (4, 6, 3), 3, True, 3), (["3024", "3023", "3005"], (2, 4, 3), 1, True, 3),
                                          (["3003"], (4, 9, 4), 3, False, 4), (["3023", "3070b"], (3, 2, 2), 1, False, 3)):
        wide, high, deep = size
        room = set(itertools.product(range(wide), range(high), range(deep)))
        text = ""
        if hole:
            room -= {(0, y, 0) for y in range(high)}
            text = " and not box(1 stud, %d plates, 1 stud) at (%d, 0, %d)" % (high, 10 - 10 * wide, 10 - 10 * deep)
        with open(path, "w") as file:
            file.write(KIT % (" | ".join(names), wide, high, deep, text, 10 * wide - 10, 10 * deep - 10))
        buildings = set()
        for name in names:
            for turned in (False, True) if PARTS[name][0] != PARTS[name][2] else (False,):
                places = itertools.product(range(wide), range(0, high, step), range(deep))
                buildings.update(frozenset([(*at, turned, name)]) for at in places if cells((*at, turned, name)) <= room)
        for parts in range(1, most + 1):
            if parts > 1:
                buildings = grow_inside(buildings, names, room)
            command = [tartan, "count", path, "--parts", str(parts), "--inside", "room", "--json", "--threads", str(1 + parts % 3)]
            for name in names:
                command += ["--part", name]
            said = subprocess.run(command, capture_output=True, text=True)
            assert said.returncode == 0 and json.loads(said.stdout) == {"parts": parts, "inside": len(buildings)}, (names, parts, len(buildings), said)
            lines = listed(path, names, parts, "--inside", "room")
            stand = {frozenset((x + wide / 2, y, z + deep / 2, *rest) for x, y, z, *rest in b) for b in lines}
            assert len(lines) == len(buildings) and stand == buildings, (names, parts)
            inside += len(buildings)
assert inside > 1000, inside
