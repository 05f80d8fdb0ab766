"""Designs of boxes as docs/solid-language.md has them: how boxes are squashed, and what is measured of those without planes.

Faces are doubles, as the program rounds them once; all else is exact. What hangs on distances that differ by less than rounding is not known."""
import itertools
import math
from fractions import Fraction

CLOSE = Fraction(1, 10**9)           # distances of centres that differ by less, and are not equal on a lattice, are not told apart
LATTICE = 64                         # coordinates that are whole 64ths are exact in every sum, and on the units of files


class Unknown(Exception):
    """Nothing can be said: two distances are as good as equal, or faces are moved."""


class Cell:
    """A box of a design while it is squashed, or one of its images."""

    def __init__(self, number, low, high, rigid, mirrors=""):
        self.number, self.low, self.high, self.rigid, self.mirrors = number, list(low), list(high), rigid, mirrors

    @property
    def gone(self):
        return any(l >= h for l, h in zip(self.low, self.high))

    def centre(self, axis):
        return (self.low[axis] + self.high[axis]) / 2

    def mirrored(self, axes):
        low, high = self.low[:], self.high[:]
        for axis in axes:
            a = "xyz".index(axis)
            low[a], high[a] = -high[a], -low[a]
        return Cell(self.number, low, high, self.rigid, axes)

    def take(self, image):
        """The faces of an image of this, mirrored back."""
        back = image.mirrored(image.mirrors)
        self.low, self.high = back.low, back.high

    def size(self):
        return math.prod(h - l for l, h in zip(self.low, self.high)) if not self.gone else Fraction(0)


def rounded(number):
    return Fraction(float(number))


def on_lattice(design):
    return all((LATTICE * v).denominator == 1 for box in design.boxes for v in box.low + box.high)


class Squashed:
    """The boxes of a design after squashing, and the images of each."""

    def __init__(self, design):
        self.design, self.lattice = design, on_lattice(design)
        if "unit" in design.settings and not self.lattice:
            raise Unknown()                      # where a face lies between two units is not followed here
        self.cells = [Cell(i, map(rounded, box.low), map(rounded, box.high), box.rigid) for i, box in enumerate(design.boxes)]
        self.written = sum(cell.size() for cell in self.cells)
        for j, cell in enumerate(self.cells):
            for before in self.cells[:j]:
                self.meet(before, cell)
        self.groups = [""]
        for axis in sorted(design.axes):
            self.mirror(axis)
            self.groups += [group + axis for group in self.groups]

    def mirror(self, axis):
        for j, cell in enumerate(self.cells):
            for before in self.cells[:j + 1]:
                for group in [""] if before is cell else self.groups:
                    image = cell.mirrored(group + axis)
                    self.meet(before, image, axis if before is cell else None)
                    if before is not cell:
                        cell.take(image)

    def all(self):
        return [cell.mirrored(group) for group in self.groups for cell in self.cells if not cell.gone]

    # ---- two boxes

    def meet(self, p, q, own=None):
        """Squashes both where they overlap; q is an image of p itself along `own`."""
        overlap = [min(p.high[a], q.high[a]) - max(p.low[a], q.low[a]) for a in range(3)]
        if p.gone or q.gone or min(overlap) <= 0:
            return
        axes = ["xyz".index(own)] if own else self.order(p, q, overlap)
        if p.rigid == q.rigid:
            self.share(p, q, axes[0], own)
        elif p.rigid:
            self.give_way(p, q, axes, True)
        else:
            self.give_way(q, p, axes, False)

    def order(self, p, q, overlap):
        """Axes: of the farthest centres first, or of the least overlap; of equal ones x, y, z."""
        if "correct" in self.design.settings:
            keys = overlap
        else:
            keys = [-abs(p.centre(a) - q.centre(a)) for a in range(3)]
        for a, b in itertools.combinations(keys, 2):
            if abs(a - b) < CLOSE and not (self.lattice and a == b):
                raise Unknown()
        return sorted(range(3), key=lambda a: keys[a])

    def below(self, p, q, a):
        """Is the centre of p below that of q? None: they are the same."""
        difference = p.centre(a) - q.centre(a)
        if abs(difference) < CLOSE and not self.lattice:
            raise Unknown()
        return difference < 0 if difference else None

    def give_way(self, rigid, other, axes, later):
        """The other goes back to the rigid one's faces, on the first axis on which it sticks out on its own side; of equal centres the one
        that is written later is the upper."""
        for a in axes:
            below = self.below(other, rigid, a)
            below = not later if below is None else below
            if below and other.low[a] < rigid.low[a]:
                other.high[a] = rigid.low[a]
                return
            if not below and other.high[a] > rigid.high[a]:
                other.low[a] = rigid.high[a]
                return
        other.high = other.low[:]

    def share(self, p, q, a, own):
        """Both give up half of what they share, but not more than up to their centres."""
        below = self.below(p, q, a)
        first = not own if below is None else below
        low, high = (p, q) if first else (q, p)
        middle = rounded((low.high[a] + high.low[a]) / 2)
        middle = min(max(middle, rounded(low.centre(a))), rounded(high.centre(a)))
        low.high[a] = high.low[a] = middle


# ---- measures of boxes without planes

def measures(design):
    """What is measured exactly, by name; some of it as doubles. None where nothing is left."""
    squashed = Squashed(design)
    cells, images = squashed.all(), len(squashed.groups)
    if not cells:
        return None
    low = [min(cell.low[a] for cell in cells) for a in range(3)]
    high = [max(cell.high[a] for cell in cells) for a in range(3)]
    volume = sum(cell.size() for cell in cells)
    centre = [sum(cell.size() * cell.centre(a) for cell in cells) / volume for a in range(3)]
    spread = [sum(cell.size() * ((cell.high[a] - cell.low[a])**2 / 12 + (cell.centre(a) - centre[a])**2) for cell in cells) for a in range(3)]
    made = {"width": high[0] - low[0], "height": high[1] - low[1], "depth": high[2] - low[2], "volume": volume, "mass": volume,
            "boxes": len(squashed.cells) * images, "voids": sum(cell.gone for cell in squashed.cells) * images, "ghosts": 0, "inward": 0, "support": 1,
            "squashed": squashed.written * images - volume}
    for a, name in enumerate("xyz"):
        made[f"centre-{name}"] = centre[a]
        made[f"inertia-{name}"] = sum(spread) - spread[a]
    made.update(surfaces(cells, low[1]))
    made.update(joints(cells))
    made.update(stand(cells, low[1], centre))
    return made


def surfaces(cells, ground):
    """Areas of the union, by the lattice that all faces make."""
    lines = [sorted({v for cell in cells for v in (cell.low[a], cell.high[a])}) for a in range(3)]
    index = [{v: i for i, v in enumerate(axis)} for axis in lines]
    filled = set()
    for cell in cells:
        filled.update(itertools.product(*(range(index[a][cell.low[a]], index[a][cell.high[a]]) for a in range(3))))
    width = lambda a, i: lines[a][i + 1] - lines[a][i]
    across = lambda place, a: math.prod(width(b, place[b]) for b in range(3) if b != a)
    beside = lambda place, a, step: tuple(i + step * (b == a) for b, i in enumerate(place))
    exposed = {(a, step): [p for p in filled if beside(p, a, step) not in filled] for a in range(3) for step in (-1, 1)}
    made = {"area": sum(across(p, a) for (a, _), places in exposed.items() for p in places),
            "overhang": sum(across(p, 1) for p in exposed[1, -1] if lines[1][p[1]] != ground)}
    for a, name in enumerate("xyz"):
        columns = {tuple(i for b, i in enumerate(p) if b != a): across(p, a) for p in filled}
        made[f"shadow-{name}"] = sum(columns.values())
    return made


def joints(cells):
    """How many pieces share no area, and the least contact that holds each together."""
    contacts = sorted((area, i, j) for (i, p), (j, q) in itertools.combinations(enumerate(cells), 2) if (area := contact(p, q)) > 0)[::-1]
    parent = list(range(len(cells)))

    def root(i):
        while parent[i] != i:
            i = parent[i]
        return i
    weakest, count = 0, len(cells)
    for area, i, j in contacts:
        if root(i) != root(j):
            parent[root(i)] = root(j)
            weakest, count = area, count - 1
    return {"parts": count, "weakest": weakest}


def contact(p, q):
    shared = [min(p.high[a], q.high[a]) - max(p.low[a], q.low[a]) for a in range(3)]
    touching = [a for a in range(3) if shared[a] == 0]
    return math.prod(s for s in shared if s) if len(touching) == 1 and min(shared) == 0 else 0


def stand(cells, ground, centre):
    """The hull of the lowest corners, and how far inside of it the centre of mass lies."""
    points = {(x, z) for cell in cells if cell.low[1] == ground for x in (cell.low[0], cell.high[0]) for z in (cell.low[2], cell.high[2])}
    corners = hull(sorted(points))
    sides = list(zip(corners, corners[1:] + corners[:1]))
    area = sum(a[0] * b[1] - b[0] * a[1] for a, b in sides) / 2
    x, z = centre[0], centre[2]
    inside = min(float((b[0] - a[0]) * (z - a[1]) - (b[1] - a[1]) * (x - a[0])) / math.dist(tuple(map(float, a)), tuple(map(float, b))) for a, b in sides)
    away = min(to_side(float(x), float(z), *(tuple(map(float, p)) for p in side)) for side in sides)
    return {"footprint": area, "stable": inside if inside >= 0 else -away}


def hull(points):
    def half(points):
        made = []
        for p in points:
            while len(made) > 1 and turn(made[-2], made[-1], p) <= 0:
                made.pop()
            made.append(p)
        return made[:-1]
    return half(points) + half(points[::-1])


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def to_side(x, z, a, b):
    along = ((x - a[0]) * (b[0] - a[0]) + (z - a[1]) * (b[1] - a[1])) / ((b[0] - a[0])**2 + (b[1] - a[1])**2)
    along = min(max(along, 0), 1)
    return math.hypot(x - a[0] - along * (b[0] - a[0]), z - a[1] - along * (b[1] - a[1]))
