"""Rules as trees, and what each edit makes of a tree: worked out on trees alone, from what docs/requests.md and
compiler/plan/edit/rule_edit.h say of edits, so that rule_edits.py can hold the edits of texts to it."""
import re

ROWS = {"and", "or", "neighbour"}
LEAVES = {"tray", "any", "name", "beginning", "end", "gap", "text"}
ENDS = {"beginning", "end", "gap"}
COUNTED = {"quantity", "occurrences", "sum"}
# How tightly what stands in a place has to hold together there, and how tightly each kind does.
WORDS = {"implies": 0, "where": 0, "or": 1, "and": 2, "not": 3, "near": 3, "every near": 3}
HOLDS = {"or": 2, "and": 3, "not": 3, "implies": 1, "where": 1, "symmetric": 5, "near": 4, "every near": 4}
PRIMARY = 5


class Impossible(Exception):
    """The edit has no tree, which the answer has to say, too."""


def without_comments(text):
    return text and re.sub(r"#[^\r\n]*", "", text)


def bare(text):
    """A text without its comments and blanks."""
    return text and re.sub(r"\s+", "", without_comments(text))


class Part:
    """A part of a rule. Texts are as somebody wrote them; two parts are alike if these say the same (shape). relation: of `sum` what is added."""

    def __init__(self, kind, parts=(), name=None, condition=None, region="", relation=None, binds=(), items=(), text=None):
        self.kind, self.parts, self.name, self.condition = kind, list(parts), name, condition
        self.region, self.relation, self.binds, self.items, self.text = region, relation, list(binds), list(items), text

    def copy(self):
        return Part(self.kind, [part.copy() for part in self.parts], self.name, self.condition, self.region, self.relation, self.binds,
                    self.items, self.text)

    def uncommented(self):
        """The same without the comments in its texts."""
        made = self.copy()
        for part in made.walk():
            part.items = [without_comments(item) for item in part.items]
            part.text, part.condition, part.relation = map(without_comments, (part.text, part.condition, part.relation))
        return made

    def walk(self):
        yield self
        for part in self.parts:
            yield from part.walk()

    def shape(self):
        return (self.kind, self.name, bare(self.condition), self.region, bare(self.relation), tuple(self.binds),
                tuple(bare(item) for item in self.items), bare(self.text), tuple(part.shape() for part in self.parts))

    def binding(self):
        """A text is put into parentheses wherever it is more than a word."""
        return (3 if re.search(r"[^\w.'-]", self.text) else PRIMARY) if self.kind == "text" else WORDS.get(self.kind, PRIMARY)

    def become(self, other):
        self.__init__(other.kind, other.parts, other.name, other.condition, other.region, other.relation, other.binds, other.items, other.text)


def any_tray():
    return Part("any")


# ---- as text

WRITTEN = {
    "any": "any", "beginning": "beginning", "end": "end", "gap": "...", "not": "not {0}", "implies": "{0} implies {1}", "where": "{0} where {1}",
    "symmetric": "symmetric {0}", "many": "many({0})", "optional": "optional({0})", "distance": "distance(from {0}, to {1}, by {2})",
    "every": "every({0}, {1})", "near": "{0} {relation} {1}", "every near": "every {0} {relation} {1}", "some": "some {binds} in {name} ({0})",
    "each": "every {binds} in {name} ({0})", "sum": "sum({relation} of {0}{region}, {condition})", "quantity": "quantity({0}{region}, {condition})", "occurrences": "occurrences({0}{region}, {condition})",
}


def written(part, more=lambda: False):
    """The part as text; `more` says where parentheses stand that nobody needs."""
    holds = HOLDS.get(part.kind, 0)
    inner = [enclosed(inside, inside.binding() < holds or inside.kind not in ENDS and more(), more) for inside in part.parts]
    if part.kind == "tray":
        return f"tray({', '.join(part.items)})"
    if part.kind in ("name", "text"):
        return part.name or part.text
    if part.kind in ("and", "or"):
        return f" {part.kind} ".join(inner)
    if part.kind in ("call", "neighbour"):
        return f"{part.name or 'neighbour'}({', '.join(inner)})"
    return WRITTEN[part.kind].format(*inner, relation=part.relation, binds=", ".join(part.binds), name=part.name, condition=part.condition,
                                     region=part.region and " " + part.region)


def enclosed(part, parentheses, more):
    text = written(part, more)
    return f"({text})" if parentheses else text


def written_out(part):
    """With parentheses around all that has parts."""
    return written(part, lambda: True)


# ---- edits

BOXES = {
    "not": lambda part: Part("not", [part]), "symmetric": lambda part: Part("symmetric", [part]), "many": lambda part: Part("many", [part]),
    "neighbour": lambda part: Part("neighbour", [part]), "optional": lambda part: Part("optional", [part]),
    "quantity": lambda part: Part("quantity", [part], condition="n >= 1"), "occurrences": lambda part: Part("occurrences", [part], condition="n >= 1"),
    "distance": lambda part: Part("distance", [part, any_tray(), Part("quantity", [any_tray()], condition="n >= 1")]),
}


class Tree:
    """A rule that is edited. `about` becomes the part that the edit was about."""

    def __init__(self, root):
        self.above = Part("rule", [root.copy()])
        self.parts = list(self.root.walk())
        self.about = None

    @property
    def root(self):
        return self.above.parts[0]

    def number(self):
        return next(i for i, part in enumerate(self.root.walk()) if part is self.about)

    def parent(self, part):
        return next(above for above in self.above.walk() if any(inside is part for inside in above.parts))

    def place(self, part):
        parent = self.parent(part)
        return parent, next(i for i, inside in enumerate(parent.parts) if inside is part)

    def put(self, part, other):
        parent, at = self.place(part)
        parent.parts[at] = self.about = other

    # items of trays

    def set(self, part, item, text):
        if part.kind != "tray" or item >= len(part.items):
            raise Impossible("no such item")
        part.items[item] = text
        self.about = part

    def clear(self, part, item):
        if part.kind != "tray" or item >= len(part.items):
            raise Impossible("no such item")
        del part.items[item]
        if not part.items:
            part.become(any_tray())
        self.about = part

    def add(self, part, text, item=None):
        if part.kind not in ("tray", "any"):
            raise Impossible("no tray")
        part.items.insert(len(part.items) if item is None else item, text)
        part.kind, self.about = "tray", part

    # boxes

    def wrap(self, part, by):
        if part.kind in ENDS:
            raise Impossible("in no box")
        parent, at = self.place(part)
        parent.parts[at] = self.about = BOXES[by](part)

    def unwrap(self, part, at=None):
        if not part.parts or at is not None and at >= len(part.parts):
            raise Impossible("no such part")
        self.put(part, part.parts[-1 if at is None else at])

    # rows and places

    def insert(self, part, new, at=None):
        if part.kind in ROWS:
            part.parts.insert(inside_ends(part, new, len(part.parts) if at is None else at), new)
        elif at is not None and at >= len(part.parts) or not part.parts:
            raise Impossible("no such place")
        else:
            part.parts[-1 if at is None else at] = new
        self.about = new

    def join(self, part, new, by, before=False):
        parent, at = self.place(part)
        if parent.kind == by:
            parent.parts.insert(at if before else at + 1, new)
        elif part.kind == by:
            part.parts.insert(0 if before else len(part.parts), new)
        else:
            parent.parts[at] = Part(by, [new, part] if before else [part, new])
        self.about = new

    def remove(self, part):
        parent, at = self.place(part)
        if parent.kind not in ROWS or len(parent.parts) == 1:
            self.put(part, any_tray())
        elif parent.kind != "neighbour" and len(parent.parts) == 2:
            self.put(parent, parent.parts[1 - at])
        else:
            del parent.parts[at]
            self.about = parent

    def take(self, part, origin):
        """What is moved: a copy of it is put, and it is removed afterwards."""
        if any(inside is part for inside in origin.walk()):
            raise Impossible("into itself")
        return origin.copy()

    def take_away(self, origin):
        about = self.about
        self.remove(origin)
        self.about = about

    def move(self, part, origin, at=None):
        new = self.take(part, origin)
        if part.kind not in ROWS and part.parts and (at is None or at < len(part.parts)):
            if any(inside is origin for inside in part.parts[-1 if at is None else at].walk()):
                raise Impossible("there already")
        self.insert(part, new, at)
        self.take_away(origin)

    def join_moved(self, part, origin, by, before=False):
        self.join(part, self.take(part, origin), by, before)
        self.take_away(origin)

    # what is written

    def condition(self, part, text):
        if part.kind not in COUNTED:
            raise Impossible("no condition")
        part.condition = text
        self.about = part

    def text(self, part, new):
        self.put(part, new)


def inside_ends(row, new, at):
    """In a row of neighbours what is put stands between its ends."""
    least = 1 if row.parts[0].kind == "beginning" and new.kind != "beginning" else 0
    most = len(row.parts) - (1 if row.parts[-1].kind == "end" and new.kind != "end" else 0)
    return max(least, min(at, most))


def check_row(root):
    """Ends of the plan stand at the ends of a row of neighbours, and `...` stands in one."""
    if root.kind in ENDS:
        raise Impossible("out of a row")
    for part in root.walk():
        for i, inside in enumerate(part.parts):
            if inside.kind in ENDS and part.kind != "neighbour" or inside.kind == "beginning" and i > 0 or \
                    inside.kind == "end" and i + 1 < len(part.parts):
                raise Impossible("out of a row")


# ---- a click on a sign

def step(part, fields, about, field, depth):
    """The edit that a click on the sign of a field means: ("set", item, text), ("clear", item), ("add", item, text). None: what it makes of an
    item that asks for several values is not said, but that one value or none is asked for afterwards. fields: those of the trays, in their
    order, as rule_tree tells them; about: the field of each item of the tray."""
    if part.kind not in ("tray", "any"):
        raise Impossible("no signs")
    here = [i for i, name in enumerate(about) if name == field["name"]]
    values = field["items"]
    if len(here) > 1:
        raise Impossible("says several things")
    if depth and not field["zone"]:
        raise Impossible("no depths")
    if not here:
        if depth:
            raise Impossible("no fill")
        order = [other["name"] for other in fields]
        behind = [i for i, name in enumerate(about) if name not in order or order.index(name) > order.index(field["name"])]
        return "add", behind[0] if behind else len(about), values[0]
    texts = [bare(text) for text in values]
    now = bare(part.items[here[0]])
    if now not in texts:
        return None
    return next_value(values, texts.index(now), here[0], field["zone"], depth)


def next_value(values, now, item, zone, depth):
    fill = lambda text: " ".join(text.split()[:2]) if zone else text
    same = [text for text in values if fill(text) == fill(values[now])]
    if depth and len(same) == 1:
        raise Impossible("no depths")
    if depth:
        at = same.index(values[now])
        return "set", item, same[(at + 1) % len(same)]
    later = [text for text in values[now + 1:] if fill(text) != fill(values[now])] if zone else values[now + 1:]
    return ("set", item, later[0]) if later else ("clear", item)
