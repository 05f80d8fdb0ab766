"""What formulas are worth, operation by operation as docs/field-language.md has them.

Elementary functions are the C library's here, and may differ in the last place from those of the program. So each of their values can be
nudged by one unit in the last place, at random: a value that hangs on that is known no better than its values differ."""
import math
import random

NAN = math.nan
NUDGES = 6
WHOLE_POWER_MAX = 64
HULL = (2.0, 1.5, 1.0)               # half sides of the one mesh that files measure the distance from
GRADIENTS = ((1, 1, 0), (-1, 1, 0), (1, -1, 0), (-1, -1, 0), (1, 0, 1), (-1, 0, 1), (1, 0, -1), (-1, 0, -1), (0, 1, 1), (0, -1, 1), (0, 1, -1),
             (0, -1, -1))
REACH = 7.0                          # of the box of a file that has none


def divided(a, b):
    if b:
        return a / b
    return NAN if a == 0 or a != a else math.copysign(math.inf, a) * math.copysign(1, b)


def remainder(a, b):
    """With the sign of b."""
    if a != a or b != b or b == 0 or math.isinf(a):
        return NAN
    rest = math.fmod(a, b)
    return rest + b if rest and (rest < 0) != (b < 0) else rest


def least(a, b):
    return a if a != a or a < b else b


def most(a, b):
    return a if a != a or a > b else b


def blend(a, b, k):
    if not k >= 0:
        return NAN
    if k == 0:
        return least(a, b)
    overlap = most(k - abs(a - b), 0.0)
    return least(a, b) - overlap * overlap / (4 * k)


def whole_power(a, n):
    """By the binary digits of n, the highest first."""
    if n == 0:
        return 1.0
    made = a
    for digit in bin(abs(n))[3:]:
        made = made * made
        if digit == "1":
            made = made * a
    return made if n > 0 else divided(1.0, made)


def power(a, b):
    if a != a or b != b:
        return NAN
    odd = b == math.floor(b) and math.fmod(b, 2) != 0 if math.isfinite(b) else False
    try:
        return math.pow(a, b)
    except OverflowError:
        return -math.inf if a < 0 and odd else math.inf
    except ValueError:
        return NAN if a else math.copysign(math.inf, a) if odd else math.inf


def floor(a):
    return float(math.floor(a)) if math.isfinite(a) and a else a


def noise(x, y, z):
    if any(not abs(v) < 2.0**31 for v in (x, y, z)):
        return NAN
    cell = [math.floor(v) for v in (x, y, z)]
    inside = [v - c for v, c in zip((x, y, z), cell)]
    fade = [t * t * t * (t * (t * 6 - 15) + 10) for t in inside]
    values = [corner(cell, inside, (k & 1, k >> 1 & 1, k >> 2)) for k in range(8)]
    for t in fade:
        values = [a + (b - a) * t for a, b in zip(values[::2], values[1::2])]
    return values[0]


def corner(cell, inside, step):
    i, j, k = ((c + s) & 0xffffffff for c, s in zip(cell, step))
    h = (i * 0x9E3779B1 ^ j * 0x85EBCA77 ^ k * 0xC2B2AE3D) & 0xffffffff
    h = (h ^ h >> 15) * 0x2C1B3C6D & 0xffffffff
    h = (h ^ h >> 12) * 0x297A2D39 & 0xffffffff
    gradient = GRADIENTS[(h ^ h >> 15) % 12]
    a, b, c = (g * (v - s) for g, v, s in zip(gradient, inside, step))
    return a + b + c


def elementary(function, *operands):
    try:
        return function(*operands)
    except ValueError:
        return NAN
    except OverflowError:
        return math.inf


def logarithm(a):
    return -math.inf if a == 0 else elementary(math.log, a)


def hull_distance(*place):
    away = [abs(v) - half for v, half in zip(place, HULL)]
    return math.sqrt(sum(max(v, 0.0)**2 for v in away)) + min(max(away), 0.0) if all(map(math.isfinite, place)) else NAN


EXACT = {"abs": abs, "sqrt": lambda a: elementary(math.sqrt, a), "square": lambda a: a * a, "floor": floor, "noise": noise, "blend": blend,
         "clamp": lambda a, low, high: least(most(a, low), high), "mix": lambda a, b, t: a + (b - a) * t,
         "+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b, "/": divided, "%": remainder, "negative": lambda a: -a}


class Values:
    def __init__(self, fields, nudged=None):
        self.fields, self.nudged, self.exact = fields, nudged, True

    def near(self, value):
        self.exact = False
        if not self.nudged or not math.isfinite(value):
            return value
        return self.nudged.choice((value, math.nextafter(value, math.inf), math.nextafter(value, -math.inf)))

    def value(self, formula, given, place):
        """`given` has the values of parameters, as pairs; `place` those of the coordinates."""
        if formula.kind == "number":
            return formula.of
        if formula.kind == "name":
            return self.named(formula.of, dict(given), place)
        if formula.kind == "distance":
            return self.near(hull_distance(*place))
        if formula.kind == "at":
            there = tuple(self.value(part, given, place) for part in formula.parts[:3])
            return self.value(formula.parts[3], given, there)
        if formula.kind == "call" and formula.of == "pow" and "pow" not in self.fields.definitions:
            return self.power(formula, given, place)
        operands = [self.value(part, given, place) for part in formula.parts]
        return self.called(formula, operands, place)

    def named(self, name, given, place):
        if name in given:
            return given[name]
        if name in ("x", "y", "z"):
            return place["xyz".index(name)]
        return self.value(self.fields.definitions[name].body, (), place)

    def called(self, formula, operands, place):
        own = self.fields.definitions.get(formula.of) if formula.kind == "call" else None
        if own:
            return self.value(own.body, tuple(zip(own.params, operands)), place)
        name = formula.of if formula.kind == "call" else formula.kind
        if name in ("min", "max"):
            made = operands[0]
            for operand in operands[1:]:
                made = (least if name == "min" else most)(made, operand)
            return made
        if name in EXACT:
            return EXACT[name](*operands)
        if any(operand != operand for operand in operands):
            return NAN
        if name == "tan":
            return divided(self.near(elementary(math.sin, *operands)), self.near(elementary(math.cos, *operands)))
        return self.near(logarithm(*operands) if name == "log" else elementary(getattr(math, name), *operands))

    def power(self, formula, given, place):
        base, exponent = formula.parts
        negative = exponent.kind == "negative"
        written = exponent.parts[0] if negative else exponent
        a = self.value(base, given, place)
        if written.kind == "number" and written.of == math.floor(written.of) and written.of <= WHOLE_POWER_MAX:
            return whole_power(a, -int(written.of) if negative else int(written.of))
        return self.near(power(a, self.value(exponent, given, place)))

    def at(self, surface, place):
        return self.value(self.fields.surfaces[surface].body, (), place)


def value_at(fields, surface, place):
    """(value, by how much another may differ from it). The second is NaN where nothing can be said."""
    plain = Values(fields)
    value = plain.at(surface, place)
    if plain.exact:
        return value, 0.0
    others = [Values(fields, random.Random(i)).at(surface, place) for i in range(NUDGES)]
    if value != value:
        return value, 0.0 if all(other != other for other in others) else NAN
    if math.isinf(value):
        return value, 0.0 if all(other == value for other in others) else NAN
    return value, 8 * max(abs(other - value) for other in others) + 8 * math.ulp(value)


def box_of(fields):
    """Its low and its high corner."""
    if not fields.corners:
        return (-REACH,) * 3, (REACH,) * 3
    return tuple(tuple(Values(fields).value(part, (), (0.0, 0.0, 0.0)) for part in corner) for corner in fields.corners)
