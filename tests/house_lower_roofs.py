"""The slow reference with one rule more: an opening does not fit where a lower roof stands above its sill.

use(ORACLES) loads the reference from ORACLES/house and returns it with the rule. The roofs are the solids that the reference itself
builds, and heights are exact fractions: nothing here is shared with the engines."""
import os
import sys
from fractions import Fraction


def use(oracles):
    global reference, plain_options
    sys.path.insert(0, os.path.join(oracles, "house"))
    import house

    reference = house
    plain_options, house.face_options = house.face_options, options
    return house


def roofs_of(house):
    """(storey, x, [(y, z)...]) of each roof. Which openings there are does not matter to roofs, but something has to be in all faces."""
    if not hasattr(house, "lower_roofs"):
        kinds = [face.kind for face in house.faces]
        for face in house.faces:
            face.kind = "floor" if face.rel == "above" else "wall"
        _, prisms = reference.build(house, [None] * len(house.cells))
        for face, kind in zip(house.faces, kinds):
            face.kind = kind
        house.lower_roofs = [(house.cells[p["of"]].storey, p["x"], [(Fraction(y), Fraction(z)) for y, z in p["profile"]]) for p in prisms]
    return house.lower_roofs


def height_at(profile, y):
    for (y0, z0), (y1, z1) in zip(profile, profile[1:]):
        if y0 <= y <= y1:
            return z0 + (z1 - z0) * (y - y0) / (y1 - y0)


def height_along(face, roof, wall, start, wide):
    """The highest point of a roof at the outer side of the wall along an opening, or None where it does not stand there."""
    _, (x0, x1), profile = roof
    y0, y1 = profile[0][0], profile[-1][0]
    low, high = (x0, x1) if face.side in ("left", "right") else (y0, y1)
    at = face.x0 if face.side in ("left", "right") else face.y0
    if not (low <= at + wall // 2 < high if face.side in ("right", "front") else low < at - wall // 2 <= high):
        return None
    if face.side in ("back", "front"):
        beside = max(x0, start) < min(x1, start + wide)
        return height_at(profile, Fraction(at + (wall // 2 if face.side == "front" else -(wall // 2)))) if beside else None
    first, last = max(y0, Fraction(start)), min(y1, Fraction(start + wide))
    if first >= last:
        return None
    return max([height_at(profile, first), height_at(profile, last)] + [z for y, z in profile if first < y < last])


def is_behind(house, face, opening):
    form = house.form
    along = (face.y0, face.y1) if face.x0 == face.x1 else (face.x0, face.x1)
    if opening.wide + form.wall > along[1] - along[0]:
        return False
    start = (along[0] + along[1] - opening.wide) // 2
    lower = (roof for roof in roofs_of(house) if roof[0] < face.storey)
    heights = [height_along(face, roof, form.wall, start, opening.wide) for roof in lower]
    sill = sum(high for _, high in form.storeys[: face.storey]) + opening.sill
    return any(height is not None and height > sill for height in heights)


def options(house, face):
    """The reference's, as if openings behind roofs were far too wide."""
    if face.rel != "outside" or face.storey == 0:
        return plain_options(house, face)
    form, openings = house.form, house.form.openings
    form.openings = {}
    for name, opening in openings.items():
        form.openings[name] = reference.File()
        form.openings[name].__dict__.update(opening.__dict__)
        if is_behind(house, face, opening):
            form.openings[name].wide = 1 << 62
    try:
        return plain_options(house, face)
    finally:
        form.openings = openings
