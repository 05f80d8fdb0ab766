"""The layers of roofs and of the walls below them, worked out from the cells and faces of a house's JSON alone: for house_layers.py. Nothing of the
engines is shared. A slab is cut by its thickness, upright, from the top; a wall below it point by point, as the wall of the first face of its cell
that is near: those along x before those along y."""
import math
import random
from fractions import Fraction as F

import house_prisms


def is_along_y(face):
    return face["at"][0] == face["at"][1]


def is_top(house, cell):
    c = house["cells"][cell]
    return not any(d["tray"] == c["tray"] and d["zone"] == c["zone"] and d["storey"] > c["storey"] for d in house["cells"])


def goes_on(form, house, face):
    """Is below the roof nothing between the two cells of a face?"""
    if face["b"] is None or form.roof_of(house["cells"][face["a"]]["zone"]).across:
        return False
    a, b = house["cells"][face["a"]], house["cells"][face["b"]]
    one = a["zone"] == b["zone"] and a["rect"][2:] == b["rect"][2:] and is_top(house, face["a"]) and is_top(house, face["b"])
    return one and face["kind"] != "party" and (not form.roof_of(a["zone"]).open or face["kind"] == "open")


def faces_of(form, house, cell):
    """Those above which the cell has walls below its roof, as their layers come first."""
    faces = [f for f in house["faces"] if f["rel"] != "above" and cell in (f["a"], f["b"]) and not goes_on(form, house, f)]
    return sorted(faces, key=is_along_y)


def layers_at(form, faces, x, y):
    """(name, thickness) of the layers there, with how deep in them the point is; None: no layers."""
    half = form.inches("outside") / 2
    for face in faces:
        x0, x1, y0, y1 = face["at"]
        if not (x0 - half < x < x1 + half and y0 - half < y < y1 + half):
            continue
        of = "party" if face["kind"] == "party" and face["rel"] != "outside" else "outside"
        low = face["side"] in ("back", "left")  # of the first cell
        over = (x - x0 if is_along_y(face) else y - y0) + half
        from_low = low if face["rel"] == "outside" else not low
        return (form.layers[of], over if from_low else 2 * half - over) if of in form.layers else None
    return None


def layer_at(layers, deep):
    for name, quarters in layers:
        thick = F(quarters * 25400000, 4)
        deep -= thick
        if deep < 0:
            return name, thick
    return None


def inside(prism, chance):
    """A point over a prism, off all lines that matter."""
    parts = [F(chance.randint(1, 10**6), 10**6 + 3) for _ in prism["corners"]]
    corners = house_prisms.corners_of(prism)
    return [sum(p * c[k] for p, c in zip(parts, corners)) / sum(parts) for k in (0, 1)]


def check_wall(form, house, prism, faces, check, where):
    chance = random.Random(str(prism["corners"]))
    known, pieces = house_prisms.Known(prism), [(l["name"], house_prisms.Known(l)) for l in prism.get("layers", [])]
    for _ in range(6):
        x, y = inside(prism, chance)
        at = layers_at(form, faces, x, y)
        want = [(layer_at(*at)[0], *known.ends(x, y))] if at else []
        said = [(name, *piece.ends(x, y)) for name, piece in pieces if piece.is_over(x, y)]
        check(f"{where}: a wall below a roof is {said} at {float(x), float(y)}, not {want}", said == want)
    filled = sum(map(house_prisms.volume_of, prism.get("layers", [])))
    check(f"{where}: layers fill a wall below a roof", not pieces or filled == house_prisms.volume_of(prism))


def check_slab(form, prism, check, where):
    want, above = [], 0
    for name, quarters in form.layers.get("roof", []):
        thick = F(quarters * 25400000, 4)
        want.append((name, [(x, y, high - above - thick, high - above) for x, y, _, high in house_prisms.corners_of(prism)]))
        above += thick
    said = [(l["name"], house_prisms.corners_of(l)) for l in prism.get("layers", [])]
    check(f"{where}: the layers of a slab are {said}, not {want}", said == want)


def check_roofs(form, house, check, where):
    faces = {prism["of"]: faces_of(form, house, prism["of"]) for prism in house["roofs"]}
    for prism in house["roofs"]:
        if prism["kind"] == "roof":
            check_slab(form, prism, check, where)
        else:
            check_wall(form, house, prism, faces[prism["of"]], check, where)


def slope_of(prism):
    """How much longer a slope is than its plan, rounded down to a billionth."""
    p, q, _ = house_prisms.plane_of(house_prisms.corners_of(prism), 3)
    square = 10**18 * (1 + p * p + q * q)
    return F(math.isqrt(square.numerator // square.denominator), 10**9)


def add_wall(form, house, prism, bill):
    """Walls below a roof are no walls more; each layer is as wide as its thickness makes it."""
    faces = faces_of(form, house, prism["of"])
    for piece in prism.get("layers", []):
        volume, at = house_prisms.volume_of(piece), layers_at(form, faces, *inside(piece, random.Random(1)))
        bill[piece["name"]][1] += volume / layer_at(*at)[1]
        bill[piece["name"]][2] += volume
    if "layers" not in prism:
        volume = house_prisms.volume_of(prism)
        bill["wall"][1] += volume / form.inches("outside")
        bill["wall"][2] += volume


def add_to_bill(form, house, bill):
    """A cell has one roof, in however many pieces."""
    seen = set()
    for prism in house["roofs"]:
        if prism["kind"] == "gable":
            add_wall(form, house, prism, bill)
            continue
        for name, piece in [(l["name"], l) for l in prism.get("layers", [])] or [("roof", prism)]:
            bill[name][0] += prism["of"] not in seen
            bill[name][1] += house_prisms.plan_of(piece) * slope_of(piece)
            bill[name][2] += house_prisms.volume_of(piece)
        seen.add(prism["of"])
