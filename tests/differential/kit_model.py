"""What a kit's files mean, worked out in the plainest way: which cells a space and parts have, what a model measures, and where parts go."""
import itertools
import math
from collections import Counter, defaultdict, deque
from fractions import Fraction

from kit_reader import AXES, SIZES, beside


def cross(a, b):
    return tuple(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3))


TURNS = [(1, 0, 0, 0, 1, 0, 0, 0, 1), (0, 0, -1, 0, 1, 0, 1, 0, 0), (-1, 0, 0, 0, 1, 0, 0, 0, -1), (0, 0, 1, 0, 1, 0, -1, 0, 0)]
ALL_TURNS = [tuple(c for row in rows for c in row) for rows in itertools.product(AXES.values(), repeat=3)
             if cross(rows[0], rows[1]) == rows[2]]
MOST = 4000              # parts that are placed here


class Standing:
    """A part that stands: its place in cells, y down, and how it is turned."""
    __slots__ = ("name", "colour", "at", "matrix")

    def __init__(self, name, colour, at, matrix):
        self.name, self.colour, self.at, self.matrix = name, colour, tuple(at), tuple(matrix)

    def key(self):
        return self.name, self.colour, self.at, self.matrix


def turned(matrix, v):
    return tuple(sum(matrix[3 * i + k] * v[k] for k in range(3)) for i in range(3))


def product(a, b):
    return tuple(sum(a[3 * i + k] * b[3 * k + j] for k in range(3)) for i in range(3) for j in range(3))


def quarter_about(axis):
    """The quarter turn about an axis that takes right to the back where the axis is up."""
    columns = [plus(tuple(c * axis[k] for c in axis), cross(axis, tuple(int(k == i) for i in range(3)))) for k in range(3)]
    return tuple(columns[k][i] for i in range(3) for k in range(3))


def plus(a, b):
    return tuple(p + q for p, q in zip(a, b))


def opposite(axis):
    return tuple(-c for c in axis)


def box_at(box, standing):
    a, b = (plus(turned(standing.matrix, corner), standing.at) for corner in box)
    return tuple(int(min(p, q)) for p, q in zip(a, b)), tuple(int(max(p, q)) for p, q in zip(a, b))


def cells_of(box):
    return set(itertools.product(*(range(low, high) for low, high in zip(*box))))


def cells_at(kit, standing):
    return set().union(*(cells_of(box_at(box, standing)) for box in kit.parts[standing.name].boxes))


def joints_at(kit, standing):
    """(kind, place, axis, what is beside it) of each connector."""
    return [(kind, plus(turned(standing.matrix, place), standing.at), turned(standing.matrix, axis), turned(standing.matrix, beside(axis)))
            for kind, place, axis in kit.parts[standing.name].joints]


def read_ldraw(text, kit):
    """The parts of a file without sub-files."""
    made = []
    for line in text.splitlines():
        words = line.split(maxsplit=14)
        if words[:1] == ["1"]:
            at = [Fraction(word) / unit for word, unit in zip(words[2:5], kit.unit)]
            made.append(Standing(words[14][:-4], int(words[1]), at, map(int, words[5:14])))
    return made


# ---- spaces

ON_THE_EDGE = "on the edge"


def inside(space, place):
    """True, False, or ON_THE_EDGE where digits decide; None of what a file draws. The place is in LDU, y up."""
    space = written_out(space)
    kind = space[0]
    if kind in ("mesh", "heightmap", "model"):
        return None
    if kind in SIZES:
        return within(kind, space[1:], place)
    if kind in ("and", "or"):
        return both(kind == "or", inside(space[1], place), inside(space[2], place))
    if kind == "not":
        found = inside(space[1], place)
        return not found if found in (True, False) else found
    if kind == "at":
        return inside(space[1], tuple(c - b for c, b in zip(place, space[2])))
    if kind == "turn":
        x, y, z = place
        for _ in range(space[2] % 4):
            x, z = z, -x
        return inside(space[1], (x, y, z))
    answer = False
    for i in range(space[2]):
        answer = both(True, answer, inside(space[1], tuple(c - i * b for c, b in zip(place, space[3]))))
    return answer


def within(kind, sizes, place):
    x, y, z = place
    if kind == "box":
        room = [sizes[0] / 2 - abs(x), sizes[1] / 2 - abs(y - sizes[1] / 2), sizes[2] / 2 - abs(z)]
    elif kind == "cylinder":
        room = [sizes[0] ** 2 - x * x - z * z, sizes[1] / 2 - abs(y - sizes[1] / 2)]
    else:
        room = [sizes[0] ** 2 - x * x - y * y - z * z]
    return False if min(room) < 0 else ON_THE_EDGE if min(room) == 0 else True


def both(either, one, other):
    """`or` with either, else `and`; what is not known decides only where the other does not."""
    if either in (one, other) and either is True:
        return True
    if not either and (one is False or other is False):
        return False
    unknown = [a for a in (one, other) if a not in (True, False)]
    return unknown[0] if unknown else not either


def reach(space):
    """(low, high) of a box in LDU, y up, around the space, or None where it has no end; of files a large one."""
    space = written_out(space)
    kind = space[0]
    if kind == "box":
        return [-space[1] / 2, 0, -space[3] / 2], [space[1] / 2, space[2], space[3] / 2]
    if kind == "sphere":
        return [-space[1]] * 3, [space[1]] * 3
    if kind == "cylinder":
        return [-space[1], 0, -space[1]], [space[1], space[2], space[1]]
    if kind == "not":
        return None
    if kind in ("and", "or"):
        one, other = reach(space[1]), reach(space[2])
        if not one or not other:
            return (one or other) if kind == "and" else None
        low, high = (max, min) if kind == "and" else (min, max)
        return [low(a, b) for a, b in zip(one[0], other[0])], [high(a, b) for a, b in zip(one[1], other[1])]
    if kind in ("at", "turn", "repeat"):
        return moved_reach(kind, space)
    raise KeyError(kind)


def moved_reach(kind, space):
    box = reach(space[1])
    if not box:
        return None
    if kind == "turn":
        far = max(abs(c) for corner in box for c in (corner[0], corner[2]))
        return [-far, box[0][1], -far], [far, box[1][1], far]
    by = space[2] if kind == "at" else space[3]
    counts = (1, 1) if kind == "at" else (0, space[2] - 1)
    return [min(l + n * b for n in counts) for l, b in zip(box[0], by)], [max(h + n * b for n in counts) for h, b in zip(box[1], by)]


def written_out(space):
    """What stands behind a space's name."""
    while space[0] == "named":
        space = space[1][space[2]]
    return space


def has_files(space):
    space = written_out(space)
    return space[0] in ("mesh", "heightmap", "model") or any(has_files(part) for part in space[1:] if isinstance(part, tuple))


def room_of(kit, space):
    """(cells inside, cells on the edge), or None where files draw the space."""
    if has_files(space):
        return None
    low, high = reach(space)
    sides = [range(math.floor(l / u), math.ceil(h / u)) for l, h, u in zip(low, high, kit.unit)]
    if math.prod(map(len, sides)) > 40000:
        return None
    sure, edge = set(), set()
    for x, y, z in itertools.product(*sides):
        found = inside(space, tuple((c + Fraction(1, 2)) * u for c, u in zip((x, y, z), kit.unit)))
        if found is True:
            sure.add((x, -y - 1, z))
        elif found == ON_THE_EDGE:
            edge.add((x, -y - 1, z))
    return sure, edge


# ---- measures

def alike(kit, one, other):
    """In how many of the four turns connectors of two kinds fit."""
    return min(kit.kinds[one][0], kit.kinds[other][0])


def fits(turns, one, other):
    return turns == 4 or one == other or turns == 2 and one == opposite(other)


def joined_pairs(kit, parts):
    """(part, connector, part, connector) of connectors of two parts that are joined."""
    by_place, pairs = defaultdict(list), []
    for i, standing in enumerate(parts):
        for j, joint in enumerate(joints_at(kit, standing)):
            by_place[joint[1]].append((i, j, joint))
    for there in by_place.values():
        for (i, a, one), (k, b, other) in itertools.combinations(there, 2):
            if i != k and (one[0], other[0]) in kit.joins and one[2] == opposite(other[2]) and fits(alike(kit, one[0], other[0]), one[3], other[3]):
                pairs.append((i, a, k, b))
    return pairs


def pieces(count, edges, without=None):
    """The root of each part, where `edges` join them."""
    parent = list(range(count))

    def root(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i
    for a, b in edges:
        if without not in (a, b):
            parent[root(a)] = root(b)
    return [root(i) for i in range(count) if i != without]


def measures(kit, parts, room=None):
    """The terms of conditions, by their definitions."""
    pairs, boxes = joined_pairs(kit, parts), [[box_at(box, s) for box in kit.parts[s.name].boxes] for s in parts]
    edges = [(a, b) for a, _, b, _ in pairs]
    roots, filled, overlaps = pieces(len(parts), edges), set(), 0
    for own in ([cell for box in b for cell in cells_of(box)] for b in boxes):
        overlaps += any(cell in filled for cell in own)
        filled.update(own)
    low, high = ([end(c[k] for c in filled) for k in range(3)] for end in (min, max))
    feet = [any(box[1][1] == high[1] + 1 for box in b) for b in boxes]
    held = {roots[i] for i, foot in enumerate(feet) if foot}
    used = {(i, a) for i, a, _, _ in pairs} | {(k, b) for _, _, k, b in pairs}
    terms = {
        "elements": len(parts), "colours": len({s.colour for s in parts}), "cells": len(filled), "joints": len(pairs),
        "open": sum(len(kit.parts[s.name].joints) for s in parts) - len(used), "components": len(set(roots)),
        "cuts": sum(len(set(pieces(len(parts), edges, i))) > len(set(roots)) for i in range(len(parts))),
        "floating": sum(root not in held for root in roots), "overlaps": overlaps,
        "width": (high[0] - low[0] + 1) * kit.unit[0], "height": (high[1] - low[1] + 1) * kit.unit[1], "depth": (high[2] - low[2] + 1) * kit.unit[2],
        "mass": sum(kit.parts[s.name].mass for s in parts), "price": sum(kit.parts[s.name].price for s in parts),
        "balance": balance(kit, parts, boxes, high[1] + 1),
    }
    if room:
        terms["fill"] = len(filled) / len(room)
    if crowded(pairs):
        terms = {name: value for name, value in terms.items() if name not in OF_JOINTS}
    return {name: float(value) for name, value in terms.items()} | {("count", name): float(n) for name, n in Counter(s.name for s in parts).items()}


OF_JOINTS = {"joints", "open", "components", "cuts", "floating"}


def crowded(pairs):
    """Do more than two connectors meet at one place? Which of them are joined then is not said."""
    ends = Counter(end for i, a, k, b in pairs for end in ((i, a), (k, b)))
    return any(count > 1 for count in ends.values())


def balance(kit, parts, boxes, ground):
    """How far the middle of the masses is from the nearest edge of the hull of what stands on the ground; below 0 outside."""
    weighed = any(kit.parts[s.name].mass for s in parts)
    sums, corners = [0, 0, 0], set()
    for s, own in zip(parts, boxes):
        volume = sum(math.prod(h - l for l, h in zip(*box)) for box in own)
        for low, high in own:
            share = math.prod(h - l for l, h in zip(low, high)) * (kit.parts[s.name].mass / volume if weighed else 1)
            for i, k in ((0, 0), (1, 2)):
                sums[i] += share * float(kit.unit[k]) * (low[k] + high[k]) / 2
            sums[2] += share
            if high[1] == ground:
                corners |= {(x * float(kit.unit[0]), z * float(kit.unit[2])) for x in (low[0], high[0]) for z in (low[2], high[2])}
    centre, edge = (sums[0] / sums[2], sums[1] / sums[2]), hull(corners)
    return min(side(a, b, centre) / math.dist(a, b) for a, b in zip(edge, edge[1:] + edge[:1]))


def side(a, b, p):
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def hull(points):
    """The corners around, by trying at each the next that has all others on one side."""
    at, made = min(points), []
    while at not in made:
        made.append(at)
        following = next(p for p in points if p != at)
        for p in points:
            turn = side(at, following, p)
            if turn < 0 or turn == 0 and math.dist(at, p) > math.dist(at, following):
                following = p
        at = following
    return made


def value_of(expression, terms):
    """A number (1 and 0 of what is true and not), or None where it has none or nobody knows the term."""
    if isinstance(expression, float):
        return expression
    if isinstance(expression, str) or expression[0] == "count":
        return terms.get(expression, 0.0 if isinstance(expression, tuple) else None)
    sign, values = expression[0], [value_of(part, terms) for part in expression[1:]]
    if None in values or sign not in SIGNS or sign == "/" and values[1] == 0:
        return None
    return float(SIGNS[sign](*values))


SIGNS = {
    "+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b, "/": lambda a, b: a / b, "negative": lambda a: -a,
    "<": lambda a, b: a < b, "<=": lambda a, b: a <= b, "=": lambda a, b: a == b, "!=": lambda a, b: a != b, ">=": lambda a, b: a >= b,
    ">": lambda a, b: a > b, "in": lambda a, b, c: b <= a <= c, "and": lambda a, b: a > 0 and b > 0, "or": lambda a, b: a > 0 or b > 0,
    "not": lambda a: not a > 0, "abs": abs, "min": min, "max": max, "floor": math.floor,
}


# ---- where parts go

class Greedy:
    """Places a model by its rules as docs/kit-language.md says: the first alternative that has room, the connectors of a new part before
    those that were there, or after them. Not of what is drawn by chance."""

    def __init__(self, kit, model, room, stands):
        self.kit, self.model, self.free, self.parts = kit, model, set(room), []
        self.used, self.waiting, self.blocked = Counter(), deque(), False      # blocked: what stands has no room
        for start in model.starts:
            self.begin(start, stands)
            if model.order != "breadth":
                self.go_on()
        self.go_on()

    def begin(self, start, stands):
        if len(start) == 2:
            for standing in stands:
                self.blocked |= not self.has_room([standing])
                self.stand(standing)
            self.open([(joint, [start[1]]) for standing in stands for joint in joints_at(self.kit, standing)])
            return
        kind, axis, at, turn, rule = start
        aside = beside(axis)
        for _ in range(turn):
            aside = turned(quarter_about(AXES["up"] if axis[1] else axis), aside)
        self.waiting.append(((kind, at, axis, aside), rule))

    def go_on(self):
        while self.waiting and len(self.parts) < MOST:
            joint, rule = self.waiting.popleft()
            self.grow(joint, rule)

    def open(self, found):
        """(connector, rules): each connector waits for the first of its rules that is at it."""
        made = [(joint, next((r for r in rules if joint[0] in self.kit.rules[r][0]), None)) for joint, rules in found]
        made = [pair for pair in made if pair[1]]
        if self.model.order == "breadth":
            self.waiting.extend(made)
        else:
            self.waiting.extendleft(reversed(made))

    def grow(self, joint, rule):
        for _, alternative in self.kit.rules[rule][1]:
            if not alternative:
                return
            for group in self.placements(joint, alternative):
                if self.has_room(group):
                    for standing in group:
                        self.stand(standing)
                    self.open([(joint, [] if placed.stops else placed.rules or [rule])
                               for standing, placed in zip(group, alternative) for joint in joints_at(self.kit, standing)])
                    return

    def placements(self, joint, alternative):
        kind, at, axis, aside = joint
        for own, place, own_axis in self.kit.parts[alternative[0].name].joints:
            for matrix in self.ways(own_axis, axis, aside) if (own, kind) in self.kit.joins else ():
                if fits(alike(self.kit, own, kind), turned(matrix, beside(own_axis)), aside):
                    first = tuple(a - b for a, b in zip(at, turned(matrix, place)))
                    yield [Standing(p.name, self.colour(p), plus(first, turned(matrix, p.at)), product(matrix, TURNS[p.turn])) for p in alternative]

    def ways(self, own_axis, axis, aside):
        """Each turn of a part whose connector points at one that is open, that which is not turned against it first."""
        matrix = next(m for m in ALL_TURNS if turned(m, own_axis) == opposite(axis) and turned(m, beside(own_axis)) == aside)
        upright = self.kit.turns == 4
        about = quarter_about(opposite(axis) if upright and axis[1] > 0 else axis)     # where parts stay upright, all turn as seen from above
        for _ in range(4):
            if not upright or matrix in TURNS:
                yield matrix
            matrix = product(about, matrix)

    def colour(self, placed):
        return self.model.colour if placed.colour is None else placed.colour

    def has_room(self, group):
        wanted = Counter(standing.name for standing in group)
        if any(name in self.model.stock and self.used[name] + n > self.model.stock[name] for name, n in wanted.items()):
            return False
        return all(cells_at(self.kit, standing) <= self.free for standing in group)

    def stand(self, standing):
        self.parts.append(standing)
        self.used[standing.name] += 1
        self.free -= cells_at(self.kit, standing)
