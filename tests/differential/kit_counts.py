"""Buildings of a kit, counted and listed by the command, against a brute force over sets of parts."""
import functools
import os
import re
from collections import Counter
from fractions import Fraction

from file_questions import content
from kit_model import TURNS, Standing, alike, cells_at, joined_pairs, joints_at, opposite, pieces, plus, product, room_of, turned
from program import answer, read_json, run, same

MOST = 400               # buildings that are listed
GROWN = 1500             # and that are grown here
FINE = 3000              # cells that a part has at most, of those whose buildings are looked at cell by cell


def building_of(line, kit):
    made = []
    for part in line.split("; "):
        name, x, y, z, turn = part.rsplit(" ", 4)
        at = [Fraction(v) / u for v, u in zip((x, y, z), kit.unit)]
        made.append(Standing(name, 0, at, TURNS[int(turn)]))
    return made


def look(kit, standing):
    """What tells a part that stands from others: how its connectors are turned counts as far as they tell it."""
    joints = frozenset((kind, at, axis, about(kit, kind, aside)) for kind, at, axis, aside in joints_at(kit, standing))
    return standing.name, frozenset(cells_at(kit, standing)), joints


def about(kit, kind, aside):
    turns = min([kit.kinds[kind][0]] + [alike(kit, kind, other) for one, other in kit.joins if one == kind])
    return None if turns == 4 else tuple(sorted((aside, opposite(aside)))) if turns == 2 else aside


def settled(kit, parts):
    """The building moved so that its lowest corner is at the origin."""
    cells = [cell for s in parts for cell in cells_at(kit, s)]
    low = [min(cell[k] for cell in cells) for k in range(3)]
    return frozenset(look(kit, Standing(s.name, 0, plus(s.at, [-c for c in low]), s.matrix)) for s in parts)


def quarter(parts):
    return [Standing(s.name, 0, turned(TURNS[1], s.at), product(TURNS[1], s.matrix)) for s in parts]


def turns_of(kit, parts):
    """How the building looks in each of four quarter turns."""
    looks = []
    for _ in range(4):
        looks.append(settled(kit, parts))
        parts = quarter(parts)
    return looks


def neighbours(kit, standing):
    for kind, at, axis, aside in joints_at(kit, standing):
        for name, part in kit.parts.items():
            for own, place, own_axis in part.joints:
                for matrix in TURNS if (own, kind) in kit.joins else ():
                    other = Standing(name, 0, plus(at, [-c for c in turned(matrix, place)]), matrix)
                    if turned(matrix, own_axis) == opposite(axis) and joined_pairs(kit, [standing, other]):
                        yield other


@functools.lru_cache(maxsize=1)
def grown(kit, count):
    """One of each building of so many parts, by how it looks where it is moved to the origin; None where they are too many."""
    now = {settled(kit, [s]): [s] for name in kit.parts for s in (Standing(name, 0, (Fraction(0),) * 3, matrix) for matrix in TURNS)}
    for _ in range(count - 1):
        larger = {}
        for parts in now.values():
            filled = set().union(*(cells_at(kit, s) for s in parts))
            for other in (o for s in parts for o in neighbours(kit, s)):
                if not cells_at(kit, other) & filled:
                    larger.setdefault(settled(kit, parts + [other]), parts + [other])
            if len(larger) > GROWN:
                return None
        now = larger
    return now


def is_small(kit):
    return kit.turns == 4 and 0 < len(kit.parts) <= 6 and all(part.volume() <= FINE for part in kit.parts.values())


def counted(subject):
    """As many buildings are counted as are listed, and as a brute force grows; each is legal, and no two are the same."""
    kit = subject.kit
    if not is_small(kit):
        return
    for count in (1, 2, 3):
        said = read_json("count --json", answer("count", subject.path, "--parts", str(count), "--json"))
        if int(said["fixed"]) > MOST:
            return
        for options, wanted in ((["--fixed"], said["fixed"]), ([], said["buildings"])):
            lines = answer("enumerate", subject.path, "--parts", str(count), *options).splitlines()
            same(f"buildings of {count} parts that are listed{' fixed' * bool(options)}", len(lines), int(wanted))
            are_legal(kit, lines, count, bool(options))
        brute = grown(kit, count)
        if brute is not None:
            by_brute_force(kit, brute, said)


def are_legal(kit, lines, count, fixed):
    looks = set()
    for line in lines:
        parts = building_of(line, kit)
        cells = [cell for s in parts for cell in cells_at(kit, s)]
        same("parts of a building are apart", len(cells), len(set(cells)))
        same("parts of a building hang together", len(set(pieces(len(parts), [(a, b) for a, _, b, _ in joined_pairs(kit, parts)]))), 1)
        same("parts of a building", len(parts), count)
        looks.add(settled(kit, parts) if fixed else frozenset(turns_of(kit, parts)))
    same("buildings that differ", len(looks), len(lines))


def by_brute_force(kit, brute, said):
    classes, half, fourth = set(), 0, 0
    for parts in brute.values():
        looks = turns_of(kit, parts)
        classes.add(frozenset(looks))
        half += looks[0] == looks[2]
        fourth += looks[0] == looks[1]
    want = {"fixed": len(brute), "buildings": len(classes), "half_turn": half, "quarter_turn": fourth}
    same("buildings, as a brute force has them", {name: int(said[name]) for name in want}, want)


def counted_inside(subject):
    """In the space of each model as many are counted as listed, and they lie there; with any number of threads."""
    kit = subject.kit
    for name, model in kit.models.items():
        if not is_small(kit):
            return
        options = ["--parts", "2", "--inside", name]
        code, out, err = run("count", subject.path, *options, "--json")
        if code == 1 and ("E1338" in err or "E13" in err):
            continue
        total = int(read_json("count --inside", out)["inside"])
        same("count --inside with 3 threads", answer("count", subject.path, *options, "--json", "--threads", "3"), out)
        if total > MOST:
            continue
        lines, room = answer("enumerate", subject.path, *options).splitlines(), room_of(kit, model.inside)
        same("buildings inside that are listed, and differ", (len(lines), len({frozenset(look(kit, s) for s in building_of(l, kit)) for l in lines})), (total, total))
        for line in lines if room else []:
            cells = set().union(*(cells_at(kit, s) for s in building_of(line, kit)))
            same("cells of a building outside of the space", sorted(cells - room[0] - room[1])[:2], [])


def listed_in_part(subject):
    """A stretch of the list is that stretch; JSON and sub-files have the same buildings."""
    kit = subject.kit
    options = ["--parts", "2", "--limit", "60"]
    if kit.turns != 4 or not kit.parts:
        return
    lines = answer("enumerate", subject.path, *options).splitlines()
    same("buildings from the second on", answer("enumerate", subject.path, "--parts", "2", "--from", "1", "--limit", "5").splitlines(), lines[1:6])
    rows = [read_json("enumerate --format json", row) for row in answer("enumerate", subject.path, *options, "--format", "json").splitlines()]
    same("buildings as JSON", ["; ".join(" ".join([p["part"], *(f"{c:g}" for c in p["at"]), str(p["turn"])]) for p in row["parts"]) for row in rows], lines)
    path = os.path.join(subject.folder, "buildings.mpd")
    answer("enumerate", subject.path, *options, "-o", path)
    parts = Counter(re.findall(r"^1 \d+ (.*\.dat)$", content(path).decode(), re.M))
    standing = [s for line in lines for s in building_of(line, kit)]
    want = Counter(" ".join([*(f"{float(c * u):g}" for c, u in zip(s.at, kit.unit)), *map(str, s.matrix), s.name + ".dat"]) for s in standing)
    same("buildings as sub-files", parts, want)


OF_COUNTS = [counted, counted_inside, listed_in_part]
