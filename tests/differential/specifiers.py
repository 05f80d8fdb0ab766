"""What stands in `tray(...)`, `cell(...)` and plan literals: words of the file's own schemas and forms."""
import re

from tree import Node, listed

OPERATORS = {"<": "LESS", "<=": "AT_MOST", "=": "EQUAL", "!=": "UNEQUAL", ">=": "AT_LEAST", ">": "GREATER"}


SIGNS = {"+": "PLUS", "-": "DASH", "*": "STAR", "/": "SLASH"}


def token_of(text):
    if re.fullmatch(r"\d+(\.\d+)?(sf|m2|ft2)", text):
        return "AREA"
    if text.isdigit():
        return "NUMBER"
    return "LENGTH" if text[0].isdigit() else "NAME"


def spec_word(maker, text):
    if text in OPERATORS:
        return maker.node("spec_word: comparison", maker.node("comparison: " + OPERATORS[text]))
    if text == "not":
        return maker.node("spec_word: NOT")
    if text in SIGNS:
        return maker.node("spec_sign: " + SIGNS[text])
    if ":" in text:
        return maker.node("spec_word: NUMBER COLON NUMBER", *[maker.word("NUMBER", n) for n in text.split(":")])
    if ".." in text:
        low, high = text.split("..")
        token = token_of(low)
        return maker.node(f"spec_word: {token} DOTS {token}", maker.word(token, low), maker.word(token, high))
    return maker.node("spec_word: " + token_of(text), maker.word(token_of(text), text))


def group(maker, alternatives):
    made = [alternative(maker, texts) for texts in alternatives]
    return maker.node("spec_word: OPEN spec_alternatives CLOSE", listed(maker.grammar, "spec_alternatives", made))


def alternative(maker, texts):
    nodes = [text if isinstance(text, Node) else spec_word(maker, text) for text in texts]
    return maker.node("spec_alternative: spec_words", listed(maker.grammar, "spec_words", nodes))


def item(maker, alternatives, place):
    made = listed(maker.grammar, "spec_alternatives", [alternative(maker, texts) for texts in alternatives])
    node = maker.node("spec_item: spec_alternatives", made)
    return Node(node.symbol, node.production, node.children, context=place)


def items(maker, depth, place):
    """Some fields of the schema, each as its kind may be asked for. A share is left to the grammar alone."""
    if maker.chance(.02 if place.form else .04):
        return None
    if place.cells and place.form:
        return listed(maker.grammar, "spec_items", [item(maker, alternatives, place) for alternatives in HOUSE[place.cells](maker, place)])
    fields = place.fields()
    if not fields:
        return None
    some = maker.random.sample(fields, maker.random.choice([1] * 3 + [min(2, len(fields))]))
    asked = [ASKED[f.kind](maker, f, place) for f in some]
    compared = of_sums(maker, fields) if maker.chance(.15) else None
    return listed(maker.grammar, "spec_items", [item(maker, alternatives, place) for alternatives in ([compared] if compared else []) + asked[:2 - bool(compared)]])


def of_sums(maker, fields):
    """A comparison of numbers of the tray; None where it has too few. What no tray can be is refused, and mended."""
    random = maker.random
    lengths, plain = [f for f in fields if f.kind in ("length", "zone")], [f for f in fields if f.kind in ("order", "number")]
    op = random.choice(list(OPERATORS))
    name = lambda f: [f.name] + ["depth"] * (f.kind == "zone" and random.random() < .5)
    made = []
    if len(lengths) > 1:
        f, g = random.sample(lengths, 2)
        one = random.choice([v for f in lengths if f.kind == "length" for v in f.values] or ["2'"])
        made += [[*name(f), op, *name(g)], [*name(f), op, "2", "*", *name(g)], [*name(f), "+", *name(g), op, one], [one, op, *name(f), "-", *name(g)],
                 [group(maker, [[*name(f), "-", *name(g)]]), "*", "2", op, one], ["not", *name(f), op, *name(g)]]
    if plain:
        f, g = random.choice(plain), random.choice(plain)
        made += [[f.name, "*", "2", op, g.name, "+", "1"], ["2", op, f.name]] + [[f.name, op, "2"]] * (f.kind == "order")
    if not made:
        return None
    return random.sample(made, 1) if random.random() < .8 or len(made) < 2 else random.sample(made, 2)


# ---- one field: a list of alternatives, each a list of words

def bound_to(maker, f, place):
    """A name that stands for values of the field: a parameter, one that `some` binds, or that of a `let`."""
    names = [n for n, of in place.bound + place.params if of == f.name]
    if names and maker.chance(.7):
        return maker.random.choice(names)
    names = [n for n, (of, dimension) in place.scope.lets.items() if of == f.name or (of is None and dimension == 1 and f.kind == "length")]
    return maker.random.choice(names) if names and maker.chance(.1) else None


def of_length(maker, f, place):
    random, one = maker.random, maker.random.choice(f.values)
    name = bound_to(maker, f, place)
    if name:
        return [[name]]
    compared = [f.name, random.choice(list(OPERATORS)), one]
    pair = sorted(random.choices(f.values, k=2), key=f.values.index)
    return random.choice([[[one]], [[one]], [[f.name, one]], [["not", one]], [[one], [random.choice(f.values)]], [compared],
                          [["..".join(pair)]], [[f.name, "..".join(pair)]], [["not", group(maker, [[v] for v in pair])]]])


def of_choice(maker, f, place):
    random, one = maker.random, maker.random.choice(f.values)
    name = bound_to(maker, f, place)
    if name:
        return [[name]]
    return random.choice([[[one]], [[f.name, one]], [["not", one]], [[f.name, "not", one]], [[one], [random.choice(f.values)]],
                          [[f.name, "not", group(maker, [[v] for v in f.values[:2]])]]])


def of_order(maker, f, place):
    random, one = maker.random, maker.random.choice(f.values)
    pair = sorted(random.choices(f.values, k=2), key=f.values.index)
    return random.choice([[[one]], [[f.name, "not", one]], [[f.name, random.choice(list(OPERATORS)), one]], [[f.name, "..".join(pair)]]])


def of_flag(maker, f, place):
    return maker.random.choice([[[f.name]], [["not", f.name]]])


def of_zone(maker, f, place):
    random = maker.random
    fill, depths = random.choice(f.values)
    every = [d for _, ds in f.values for d in ds] or ["2'"]
    depth = random.choice(every)
    return random.choice([[[f.name, fill]], [[f.name, fill]], [[f.name, "not", fill]], [[f.name, depth]], [[f.name, fill, *random.sample(depths, min(1, len(depths)))]],
                          [[f.name, "depth", random.choice(list(OPERATORS)), depth]], [[f.name, fill], [random.choice(f.values)[0]]]])


def of_number(maker, f, place):
    return [[f.name, maker.random.choice(list(OPERATORS)), str(maker.random.choice([0, 1, 2, 3]))]]


ASKED = {"length": of_length, "choice": of_choice, "order": of_order, "flag": of_flag, "zone": of_zone, "number": of_number}


# ---- cells and rooms

def cell(maker, place):
    random, form = maker.random, place.scope.forms[place.form]
    function = form.functions or ["any"]
    options = [[["any"]]] + [[[random.choice(names)]] for names in ([f.name for f in place.fields("zone")], form.storeys) if names]
    if place.cells == "cell":
        options += [[[random.choice(function)]]] * 4 + [[["not", random.choice(function)]], [[random.choice(function)], [random.choice(function)]], [["void"]]]
        low, high = ("6m2", "10m2") if place.metric else ("60sf", "100sf")
        options += [[["area", random.choice(["<", ">="]), random.choice([low, high])]]]
    chosen = random.sample(options, random.choice([1, 1, 1, 2]))
    if maker.chance(.15):
        f = random.choice(place.fields())
        chosen.append(ASKED[f.kind](maker, f, place))
    return chosen


def room(maker, place):
    random, form = maker.random, place.scope.forms[place.form]
    chosen = [[[random.choice(form.functions or ["any"])]]]
    if form.openings and maker.chance(.3):
        chosen.append([[*["not"] * maker.chance(.4), "by", random.choice(form.openings)]])
    if maker.chance(.2):
        chosen.append([["cells", random.choice(list(OPERATORS)), random.choice("12")]])
    if maker.chance(.2):
        chosen.append([["area", random.choice(list(OPERATORS)), "10m2" if place.metric else "100sf"]])
    if maker.chance(.03):
        chosen.append([["glazing", random.choice("<>"), "1:12"]])
    if form.storeys and maker.chance(.15):
        chosen.append([[random.choice(form.storeys)]])
    return chosen


HOUSE = {"cell": cell, "place": cell, "room": room}


# ---- the tray of a plan literal

def literal_tray(maker, depth, place):
    """What differs from the defaults, or a value for each field as in a plan line."""
    fields = [f for f in place.fields() if f.kind != "number"]
    if not fields or maker.chance(.08):
        return None
    line = maker.chance(.3)
    texts = [text for f in fields if line or maker.chance(.6) for text in literal(maker, f, line)]
    return maker.node("literal_tray: words", listed(maker.grammar, "words", [literal_word(maker, text) for text in texts]))


def literal(maker, f, line):
    if f.kind == "flag":
        return maker.random.choice([[f.name], ["-" if line else "not"] + ([] if line else [f.name])])
    value = maker.random.choice(f.values)
    if f.kind != "zone":
        return [value]
    fill, depths = value
    depth = [maker.random.choice(depths)] if depths else []
    return [fill] + [":"] * len(depth) + depth if line else [f.name, fill] + depth


def literal_word(maker, text):
    names = {"-": "ABSENT", ":": "OF_DEPTH", "not": "NOT"}
    return maker.node("literal_word: " + names[text]) if text in names else maker.node("literal_word: " + token_of(text), maker.word(token_of(text), text))
