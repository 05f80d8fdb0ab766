"""The prisms of a house's roofs, as its JSON has them: upright over a convex polygon, from `low` to `high` at each corner. Exact."""
from fractions import Fraction as F


def corners_of(prism):
    return [tuple(map(F, corner)) for corner in prism["corners"]]


def turn(a, b, p):
    """Above 0 if p is left of the way from a to b in plan."""
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def triangles(corners):
    return [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]


def plan_of(prism):
    return sum(turn(*t) for t in triangles(corners_of(prism))) / 2


def volume_of(prism):
    return sum(turn(*t) * sum(c[3] - c[2] for c in t) for t in triangles(corners_of(prism))) / 6


def is_over(corners, x, y):
    """Points on its edges are not over it."""
    return all(turn(a, b, (x, y)) > 0 for a, b in zip(corners, corners[1:] + corners[:1]))


def plane_of(corners, which):
    """(p, q, r) of z = p x + q y + r through the corners' lower ends (2) or upper ends (3)."""
    a, b, c = max(triangles(corners), key=lambda t: turn(*t))
    area = turn(a, b, c)
    p = ((b[which] - a[which]) * (c[1] - a[1]) - (c[which] - a[which]) * (b[1] - a[1])) / area
    q = ((c[which] - a[which]) * (b[0] - a[0]) - (b[which] - a[which]) * (c[0] - a[0])) / area
    return p, q, a[which] - p * a[0] - q * a[1]


def height_at(corners, which, x, y):
    p, q, r = plane_of(corners, which)
    return p * x + q * y + r


class Known:
    """A prism with what is asked of it again and again."""

    def __init__(self, prism):
        self.corners = corners_of(prism)
        self.low, self.high = plane_of(self.corners, 2), plane_of(self.corners, 3)
        self.bounds = [(float(min(c[k] for c in self.corners)), float(max(c[k] for c in self.corners))) for k in (0, 1)]

    def is_over(self, x, y):
        near = all(low - 1 < float(at) < high + 1 for (low, high), at in zip(self.bounds, (x, y)))
        return near and is_over(self.corners, x, y)

    def ends(self, x, y):
        return [p * x + q * y + r for p, q, r in (self.low, self.high)]

    def is_inside(self, x, y, z):
        if not self.is_over(x, y):
            return False
        low, high = self.ends(x, y)
        return low < z < high


def is_sound(prism):
    """Its polygon is convex and goes round counter-clockwise, its ends are planes, and it is solid somewhere."""
    corners = corners_of(prism)
    ring = list(zip(corners, corners[1:] + corners[:1], corners[2:] + corners[:2]))
    return (len(corners) >= 3 and all(turn(a, b, c) >= 0 for a, b, c in ring) and plan_of(prism) > 0 and all(c[2] <= c[3] for c in corners)
            and any(c[2] < c[3] for c in corners) and all(height_at(corners, k, c[0], c[1]) == c[k] for c in corners for k in (2, 3)))
