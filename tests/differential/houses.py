"""Files about houses: a schema with zones, a library of plans, a form, libraries and measures of houses."""
import plans
from plans import AVAILABLE, CONTEXTS, LIMIT, NAMED, QUESTIONS, SORTS, WEIGHTS, Place, add, add_rules, library, name, pick
from scope import Form, Scope, form_clause
from tree import Node, listed, wrapped

# want: (in feet, in metres)
LENGTHS = {
    "storey": (["9'", "8'"], ["3m", "2.7m"]), "thickness": (["8\"", "10\""], ["200mm", "250mm"]), "partition": (["4\""], ["100mm"]),
    "wide": (["2'8\"", "3'"], ["800mm", "900mm"]), "high": (["6'8\"", "3'"], ["2m", "900mm"]), "sill": (["2'8\""], ["800mm"]),
    "flight": (["3'"], ["900mm"]), "low": (["6\""], ["150mm"]), "rise": (["7 3/4\""], ["200mm"]), "going": (["10\""], ["250mm"]),
    "person": (["2'", "2'6\""], ["600mm", "800mm"]), "headroom": (["6'"], ["1.8m"]), "short": (["0'", "1'"], ["0m", "300mm"]), "long": (["5'", "12'"], ["1.5m", "4m"]), "roof": (["3'", "1'6\""], ["1m", "450mm"]),
}

WEIGHTS.update({
    "size: NUMBER": plans.MISTAKE, "shape: NAME OPEN arguments CLOSE": 2, "cell_not: CELL OPEN specifier CLOSE": 5, "cell_not: NOT cell_not": .2,
    "cell_not: OPEN cells CLOSE": .2, "cells: cell_ors": .08, "cell_and: cell_ands": .1, "options: option_ors": 1, "option_and: option_ands": 2, "option_ands: option_ands AND option_not": 2,
    "material_where: WHERE options": 2, "tile_part: stretch_word NAME doc reaches drawn": 2, "drawn: %empty": 8, "drawn: SYMBOL OPEN_BRACE symbol_lines CLOSE_BRACE": 2,
    "option_not: OPTION OPEN option_items CLOSE": 4, "opening_part: PASSAGE": 8, "opening_part: SILL size": .3, "opening_part: NEAR side size": .2, "opening_parts: opening_parts opening_part": 2,
    "option_not: OPEN options CLOSE": 1, "option_not: NOT option_not": .5,
    "primary: APART OPEN cells COMMA FROM cells walk_by CLOSE": 4, "primary: TOUCH OPEN cells COMMA cells by_kinds CLOSE": 2,
    "by_kinds: BY or_names": .4, "walk_by: COMMA BY or_names": .3, "outside_side: %empty": 2, "relation: BESIDE": 8, "relation: UNDER": .2,
})
FORM_CLAUSES = {
    "storey NAME doc size": 0, "thickness size": 0, "thickness size OPEN_BRACE CLOSE_BRACE": 0, "thickness size OPEN_BRACE layers CLOSE_BRACE": 0,
    "spine NAME": .3, "option EQUAL shapes": .4, "option NAME EQUAL shapes": .8,
    "forbid_word options": 1, "void cells": .3, "no cells": .2, "function NAME doc AT cells": 0, "function NAME doc OUTDOOR AT cells": .3, "opening NAME doc WIDE size HIGH size opening_parts": 0,
    "flight NAME doc WIDE size RISE size DOTS size going turn winders": .2, "face cells relation cells EQUAL kinds": 2.5,
    "face cells OUTSIDE outside_side EQUAL kinds": 1, "tile NAME doc FOR names OPEN_BRACE tile_parts CLOSE_BRACE": .8, "allow_word names": .2,
    "material NAME STRING price FOR names material_where": .8, "way size": .4, "way size FOR names": .2, "headroom size": .2, "guard size": .1, "beam NAME doc WIDE size HIGH size SPAN size": .1,
    "classification STRING FOR classes": .3,
}
CELLS = {"counted", "cells"}
SORTS["primary: CELL OPEN specifier CLOSE"] = QUESTIONS | CELLS
SORTS["primary: ROOM OPEN specifier CLOSE"] = QUESTIONS | {"counted"}
SORTS["primary: TRAY OPEN specifier CLOSE"] = SORTS["primary: ANY"] = QUESTIONS | LIMIT | {"counted"}


# ---- contexts

def sized(**wants):
    """Lengths of the kinds that are named, by the place of `size` among the symbols."""
    return lambda maker, place: {int(i[1:]): place.but(want=want) for i, want in wants.items()}


def fresh(word, **more):
    return lambda maker, place: {1: place.but(want="exact", text=place.scope.fresh(maker.random, word)), **sized(**more)(maker, place)}


def cells(*places, kind="cell"):
    """What is about everything, where that is wanted, is about `cell(any)`."""
    return lambda maker, place: {i: place.but(cells="any" if place.want == "everywhere" else kind, sort="cells") for i in places}


def joined(*tables):
    def contexts(maker, place):
        made = {}
        for table in tables:
            made.update(table(maker, place))
        return made
    return contexts


def named(**wants):
    return lambda maker, place: {int(i[1:]): place.but(want=want) for i, want in wants.items()}


def counted_cells(index, *conditions):
    """Of houses mostly cells and rooms are counted."""
    def contexts(maker, place):
        made = plans.counted(*conditions)(maker, place) if conditions else {}
        if place.form and (place.counts == "houses" or maker.chance(.8)):
            made[index] = place.but(sort="counted")
        return made
    return contexts


def added_areas(maker, place):
    if place.counts == "houses" or place.form and place.dimension == 2 and maker.chance(.6):
        return {2: place.but(sort="field", dimension=2, want="area"), 4: place.but(sort="cells", cells="cell")}
    return plans.summed(maker, place)


def asked_areas(maker, place):
    made = plans.asked_sum(7)(maker, place)
    if place.form:
        made[4] = place.but(sort="cells", cells="cell")
    return made


CONTEXTS.update({
    "form_clause: storey NAME doc size": fresh("low", _3="storey"), "form_clause: spine NAME": named(_1="zone"),
    "form_clause: option EQUAL shapes": lambda maker, place: {0: place.but(want="exact", text=place.scope.fresh(maker.random, "cladding")),
                                                               2: place.but(want="cladding")},
    "form_clause: option NAME EQUAL shapes": lambda maker, place: chosen_section(maker, place),
    "form_clause: void cells": cells(1, kind="place"), "form_clause: no cells": cells(1, kind="place"),
    "form_clause: function NAME doc AT cells": joined(fresh("K"), cells(4, kind="place")),
    "form_clause: function NAME doc OUTDOOR AT cells": joined(fresh("K"), cells(5, kind="place")),
    "form_clause: opening NAME doc WIDE size HIGH size opening_parts": fresh("door", _4="wide", _6="high"),
    "form_clause: flight NAME doc WIDE size RISE size DOTS size going turn winders": fresh("ladder", _4="flight", _6="low", _8="rise", _9="going", _10="turn"),
    "form_clause: face cells relation cells EQUAL kinds": lambda maker, place: face_between(maker, place),
    "form_clause: face cells OUTSIDE outside_side EQUAL kinds": joined(cells(1), named(_5="outside")),
    "form_clause: tile NAME doc FOR names OPEN_BRACE tile_parts CLOSE_BRACE": joined(fresh("bed"), named(_4="function", _6="tile")),
    "form_clause: allow_word names": named(_1="code"),
    "form_clause: material NAME STRING price FOR names material_where": joined(fresh("oak"), named(_2="colour", _3="unit", _5="part")),
    "form_clause: classification STRING FOR classes": named(_1="title"),
    "form_clause: way size": sized(_1="person"), "form_clause: headroom size": sized(_1="headroom"), "form_clause: guard size": sized(_1="sill"),
    "form_clause: beam NAME doc WIDE size HIGH size SPAN size": fresh("girder", _4="partition", _6="sill", _8="storey"),
    "form_clause: way size FOR names": joined(sized(_1="person"), named(_3="function")), "opening_part: NEAR side size": sized(_2="short"),
    "opening_part: SILL size": sized(_1="sill"), "opening_part: CLEAR size": sized(_1="short"),
    "tile_part: WIDE size DOTS size": sized(_1="short", _3="long"), "tile_part: DEEP size DOTS size": sized(_1="short", _3="long"),
    "tile_part: AGAINST or_names": named(_1="outside"), "tile_part: stretch_word NAME doc drawn": fresh("item"),
    "tile_part: stretch_word NAME doc reaches drawn": fresh("item"),
    "drawn: SYMBOL NAME": named(_1="symbol"), "reach: side_word size DOTS size": sized(_1="short", _3="long"),
    "reach: side_word size DOTS side_word size": sized(_1="short", _4="short"),
    "argument: NAME": named(_0="roof-word"), "argument: NAME LENGTH": lambda maker, place: {0: place.but(want="exact", text="eaves"), 1: place.but(want="roof")},
    "argument: LENGTH": sized(_0="roof"), "shape: NAME OPEN arguments CLOSE": named(_0="roof-kind"),
    "primary: CELL OPEN specifier CLOSE": cells(2), "primary: ROOM OPEN specifier CLOSE": cells(2, kind="room"),
    "primary: TRAY OPEN specifier CLOSE": lambda maker, place: {2: place.but(cells=None)},
    "primary: TOUCH OPEN cells COMMA cells by_kinds CLOSE": joined(cells(2, 4), named(_5="face")),
    "primary: APART OPEN cells COMMA FROM cells walk_by CLOSE": joined(cells(2, 5), named(_6="walk")),
    "primary: APART OPEN cells COMMA FROM cells COMMA THROUGH cells walk_by CLOSE": joined(cells(2, 5, 8), named(_9="walk")),
    "primary: APART OPEN cells COMMA FROM cells COMMA BY or_names COMMA THROUGH cells CLOSE": joined(cells(2, 5, 11), named(_8="walk")),
    "primary: QUANTITY OPEN expression region CLOSE": counted_cells(2),
    "primary: QUANTITY OPEN expression region COMMA condition CLOSE": counted_cells(2, 5),
    "primary: SUM OPEN tray_sum OF expression region CLOSE": added_areas,
    "primary: SUM OPEN tray_sum OF expression region COMMA condition CLOSE": asked_areas,
})


def form_of(place):
    return place.scope.forms.get(place.form) or Form(place.schema)


def chosen_section(maker, place):
    what = maker.random.choice(["roof", "roof", "storeys"])
    return {0: place.but(want="zone"), 1: place.but(want="exact", text=what), 3: place.but(want=what)}


def face_between(maker, place):
    """Often from some cells to all others: walls of which only some have a way through them."""
    made = cells(1, 3)(maker, place)
    if maker.chance(.5):
        made[3] = made[3].but(cells="any")
    return {**made, 5: place.but(want="way" if place.want == "everywhere" else "face")}


def kinds_of(maker, place, ends):
    form = form_of(place)
    return maker.random.choice(ends + form.openings * 2)


NAMED.update({
    "way": lambda maker, place: kinds_of(maker, place, ["open"] + form_of(place).passages * 3),
    "face": lambda maker, place: kinds_of(maker, place, ["wall"] * 4 + ["open", "party"]),
    "walk": lambda maker, place: maker.random.choice(["open"] + form_of(place).passages * 2),
    "outside": lambda maker, place: kinds_of(maker, place, ["wall"]),
    "function": lambda maker, place: pick(place, maker, form_of(place).functions),
    "part": lambda maker, place: maker.random.choice(["wall", "party", "partition", "floor", "roof"] + form_of(place).openings + form_of(place).items),
    "unit": lambda maker, place: maker.random.choice(["each", "m2", "m3"] if place.metric else ["each", "sf", "cf"]),
    "turn": lambda maker, place: maker.random.choice(["half", "quarter"]),
    "symbol": lambda maker, place: maker.random.choice(["bed", "table", "wc"]),
    "cladding": lambda maker, place: maker.random.choice(["boards", "bricks", "stone"]),
    "roof-kind": lambda maker, place: maker.random.choice(["gable", "vault", "shed"]),
    "roof-word": lambda maker, place: maker.random.choice(["open", "across", "back"]),
    "roof": lambda maker, place: "flat",
})
plain_length, plain_string, plain_number = plans.TOKENS["LENGTH"], plans.TOKENS["STRING"], plans.TOKENS["NUMBER"]


def length(maker, place):
    if place.want in LENGTHS:
        return maker.random.choice(LENGTHS[place.want][place.metric])
    return plain_length(maker, place)


plans.TOKENS.update({
    "LENGTH": length,
    "STRING": lambda maker, place: maker.random.choice(['"#c9c1ae"', '"#102030"']) if place.want == "colour" else plain_string(maker, place),
    "NUMBER": lambda maker, place: "0" if place.want in LENGTHS else plain_number(maker, place),
})


# ---- hooks

ROOFS = {"gable": ["9:12"], "shed": ["back", "4:12"], "vault": ["LENGTH"], "flat": []}


def shapes(maker, depth, place):
    """Values of a choice: storeys, roofs, or names."""
    random = maker.random
    if place.want == "storeys":
        made = [maker.node("shape: NUMBER", maker.word("NUMBER", n)) for n in random.choice([["1"], ["1", "2"]])]
    elif place.want == "roof":
        made = [roof(maker, place, kind) for kind in random.sample(sorted(ROOFS), random.choice([1, 1, 2]))]
    elif place.want == "cladding":
        made = [maker.node("shape: NAME", maker.word("NAME", n)) for n in random.sample(["boards", "bricks"], random.choice([1, 2]))]
    else:
        return None
    return listed(maker.grammar, "shapes", made)


def roof(maker, place, kind):
    if not ROOFS[kind]:
        return maker.node("shape: NAME", maker.word("NAME", kind))
    arguments = [argument(maker, place, text) for text in ROOFS[kind]]
    if maker.chance(.3):
        arguments.append(maker.make_of("argument: NAME LENGTH", 1, place))
    if maker.chance(.2):
        arguments.append(argument(maker, place, "open"))
    return maker.node("shape: NAME OPEN arguments CLOSE", maker.word("NAME", kind), listed(maker.grammar, "arguments", arguments))


def argument(maker, place, text):
    if ":" in text:
        return maker.node("argument: NUMBER COLON NUMBER", *[maker.word("NUMBER", n) for n in text.split(":")])
    if text == "LENGTH":
        return maker.make_of("argument: LENGTH", 1, place)
    return maker.node("argument: NAME", maker.word("NAME", text))


def option_item(maker, depth, place):
    """A value of a choice that the form has."""
    options = form_of(place).options
    if not options:
        return None
    choice, values = maker.random.choice(options)
    some = maker.random.sample(values, min(len(values), maker.random.choice([1, 1, 1, 2])))
    nodes = [option_alternative(maker, choice, value) for value in some]
    made = maker.node("option_item: option_alternatives", listed(maker.grammar, "option_alternatives", nodes))
    return Node(made.symbol, made.production, made.children, context=place)


def option_alternative(maker, choice, value):
    token = "NUMBER" if value.isdigit() else "NAME"
    node = maker.node("option_alternative: shape", maker.node("shape: " + token, maker.word(token, value)))
    if maker.chance(.05):
        node = maker.node("option_alternative: NOT option_alternative", node)
    for word in reversed(choice):
        node = maker.node("option_alternative: NAME option_alternative", maker.word("NAME", word), node)
    return node


def plain_cells(maker, depth, place):
    """`cell(...)` of one word, as most lines of forms have it: so few that clauses have much to ask about."""
    if place.cells != "any" and (not place.cells or maker.chance(.25 if place.form == "being made" else .4)):
        return None
    word = maker.node("spec_word: NAME", maker.word("NAME", maker.random.choice(plain_words(place))))
    cell = maker.node("cell_not: CELL OPEN specifier CLOSE", wrapped(maker.grammar, "specifier", wrapped(maker.grammar, "spec_words", word)))
    return wrapped(maker.grammar, "cells", cell)


def plain_words(place):
    if place.cells == "any":
        return ["any"]
    form, zones = form_of(place), [f.name for f in place.fields("zone")]
    return zones + (form.storeys if place.cells == "place" else form.functions * 3 + ["any"] * 3) or ["any"]


def form_clauses(maker, depth, place):
    """What every form needs, then whatever the grammar has."""
    inside = being_made(place)
    made = []
    for production, want in form_plan(maker):
        if plans.Plans().weight(maker.grammar.production(production), inside):
            clause = maker.make_of(production, 2, inside.but(want=want))
            form_clause(inside.scope.forms[inside.form], clause)
            made.append(clause)
    return listed(maker.grammar, "form_clauses", made)


def being_made(place):
    scope = Scope()
    scope.__dict__.update(place.scope.__dict__)
    scope.forms = {**place.scope.forms, "being made": Form(place.schema)}
    return place.but(scope=scope, form="being made")


NEEDED = [
    ("storey NAME doc size", None, [1, 1, 1, 2]), ("thickness size", "thickness", [4]),
    ("opening NAME doc WIDE size HIGH size opening_parts", None, [0, 1, 1, 1, 2]),
    ("function NAME doc AT cells", "everywhere", [0] + [1] * 9), ("function NAME doc AT cells", None, [0, 1, 1, 1, 1, 1, 2]),
    ("face cells relation cells EQUAL kinds", None, [0, 1, 1, 1, 1, 1, 1, 2]),
]
LAST = ("form_clause: face cells relation cells EQUAL kinds", "everywhere")     # so that few faces are walls for want of a line


def form_plan(maker):
    """(production, what its first name is) of each clause."""
    random = maker.random
    needed = [(f"form_clause: {text}", want) for text, want, counts in NEEDED for _ in range(random.choice(counts))]
    every = [p.name for p in maker.grammar.rules["form_clause"]]
    more = random.choices(every, [FORM_CLAUSES.get(p.partition(": ")[2], 1) for p in every], k=random.choice([0, 0, 1, 1, 2, 4]))
    return needed + [(p, None) for p in more] + [LAST] * maker.chance(.85)


def kinds(maker, depth, place):
    """Each once."""
    names = {name(maker, place) for _ in range(maker.random.choice([1, 1, 1, 2]))}
    return listed(maker.grammar, "kinds", [maker.word("NAME", text) for text in sorted(names)])


def classes(maker, depth, place):
    """Codes of some parts and functions, each once."""
    form = form_of(place)
    known = [n for n in form.functions + form.openings if n not in form.items and not (n in form.functions and n in form.openings)]
    some = maker.random.sample(sorted({"wall", "party", "partition", "post", "roof", *known}), maker.random.choice([1, 1, 2, 3]))
    return listed(maker.grammar, "classes", [classified(maker, place, name) for name in some])


def classified(maker, place, name):
    code = maker.word("STRING", f'"{maker.random.randint(1, 999)}"')
    return maker.node("class: NAME STRING doc", maker.word("NAME", name), code, maker.make("doc", 1, place))


def line_end(maker, depth, place):
    """From a side and from one across it."""
    sides = [maker.random.choice(pair) for pair in (("LEFT", "RIGHT"), ("BACK", "FRONT"))]
    if maker.chance(.5):
        sides.reverse()
    short = maker.random.choice(LENGTHS["short"][place.metric])
    sizes = [maker.node("size: LENGTH", maker.word("LENGTH", short)) for _ in sides]
    return maker.node("line_end: side_word size COMMA side_word size", maker.node("side_word: " + sides[0]), sizes[0], maker.node("side_word: " + sides[1]), sizes[1])


def symbol_lines(maker, depth, place):
    """One or two."""
    return listed(maker.grammar, "symbol_lines", [maker.make_of("symbol_line: LINE line_end DOTS line_end", 1, place) for _ in range(maker.random.choice([1, 2]))])


def thickness(maker, depth, place):
    """Each of the four once: the next that the form being made lacks."""
    done = form_of(place).__dict__.setdefault("thicknesses", [])
    left = [w for w in ("WALL", "PARTITION", "FLOOR", "ROOF") if w not in done]
    if place.form != "being made" or not left:
        return None
    done.append(left[0])
    return maker.node("thickness: " + left[0])


plans.HOOKS.update({"cells": plain_cells, "shapes": shapes, "option_item": option_item, "form_clauses": form_clauses, "kinds": kinds, "classes": classes, "thickness": thickness, "line_end": line_end, "symbol_lines": symbol_lines})
AVAILABLE["primary: OPTION OPEN option_items CLOSE"] = lambda place: place.form and form_of(place).options
AVAILABLE["size: NUMBER"] = lambda place: place.want in ("short", "sill")                    # 0, where a size may be none
AVAILABLE["form_clause: forbid_word options"] = AVAILABLE["material_where: WHERE options"] = lambda place: form_of(place).options


# ---- a file

HOUSE_LIBRARY = "library_head: library NAME doc using FROM NAME IN NAME"


def make_file(maker):
    """The items of a file about houses."""
    scope, random, items = Scope(), maker.random, []
    place = Place(scope, metric=maker.chance(.5))
    add(maker, items, "item: schema NAME doc from OPEN_BRACE body CLOSE_BRACE", 3, place.but(item="schema of houses"))
    about = place.but(schema=list(scope.schemas)[0])
    library(maker, items, "library_head: library NAME doc using", 1, about.but(item="plans of houses"))
    add(maker, items, "item: form_head OPEN_BRACE form_clauses CLOSE_BRACE", 4, about.but(item="form"))
    house = about.but(form=list(scope.forms)[0])
    add_rules(maker, items, house, [1, 2, 2, 3, 4])
    library(maker, items, HOUSE_LIBRARY, random.choice([0, 0, 0, 0, 1, 1, 2, 3]), house.but(item="library"))
    if maker.chance(.4):
        library(maker, items, "library_head: library NAME doc using FROM NAME", 2, house.but(item="library"))
    return listed(maker.grammar, "items", items)
