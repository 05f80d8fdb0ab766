"""What a plan file has declared so far, read from the trees of its items: the names that a new part may use."""
import re
from dataclasses import dataclass, field as default

from tree import find_all, words


@dataclass
class Field:
    name: str
    kind: str                                   # length, choice, order (a choice whose values go from least to greatest), flag, zone, number
    values: list                                # texts; of a zone (fill, texts of its depths)


@dataclass
class Rule:
    about: str                                  # a schema or a form
    params: list = default(default_factory=list)
    circle: bool = False                        # it uses itself


@dataclass
class Measure:
    about: str
    dimension: int


@dataclass
class Param:
    dimension: int                              # of a number
    words: list                                 # of a choice, the default first
    range: list                                 # texts, or empty


@dataclass
class Library:
    schema: str
    form: str = None


@dataclass
class Form:
    schema: str
    storeys: list = default(default_factory=list)
    functions: list = default(default_factory=list)
    openings: list = default(default_factory=list)
    passages: list = default(default_factory=list)   # those of the openings through which one walks
    flights: list = default(default_factory=list)
    options: list = default(default_factory=list)   # (words of a choice, values)
    items: list = default(default_factory=list)


class Scope:
    def __init__(self, items=()):
        self.schemas, self.rules, self.measures, self.lets, self.params, self.libraries, self.forms = {}, {}, {}, {}, {}, {}, {}
        self.used = set()
        for item in items:
            self.declare(item)

    def fresh(self, random, word):
        """A name that the file does not have."""
        names = [word, word + "-two", word + "_3", word + "é"]
        name = random.choices(names, [12, 3, 2, 1])[0]
        while name in self.used:
            name = f"{word}{len(self.used)}"
        self.used.add(name)
        return name

    def names_of(self, kind):
        return list(getattr(self, kind))

    def declare(self, item):
        known = DECLARED.get(item.production.symbols[0])
        self.used |= {w for w in words(item) if re.fullmatch(r"[^\W\d][\w-]*", w)}
        if known:
            known(self, item)


def named(node):
    return next(c.text for c in node.children if c.symbol == "NAME")


def after(node, symbol):
    """The NAME after a word such as USING, else None."""
    texts = [(c.symbol, c.text) for c in tokens(node)]
    return next((b[1] for a, b in zip(texts, texts[1:]) if a[0] == symbol), None)


def tokens(node):
    return [node] if node.production is None else [t for c in node.children for t in tokens(c)]


# ---- schemas

def schema(scope, item):
    older = scope.schemas.get(after(item.child("from"), "FROM"), [])
    scope.schemas[named(item)] = merged(older, body_fields(item.child("body")))


def merged(older, newer):
    """The fields of a schema from another: `...` stands for the values that a field has."""
    fields = {f.name: f for f in older}
    for field in newer:
        same = fields.get(field.name)
        fields[field.name] = Field(same.name, same.kind, same.values + field.values) if same else field
    return list(fields.values())


def body_fields(body):
    fields = [declared(f) for f in find_all(body, "field")]
    return fields + [Field(words(n)[1], "number", []) for n in find_all(body, "number_item")]


def declared(node):
    name = words(node.child("field_head"))[0]
    values = find_all(node, "value")
    if node.child("FLAG"):
        return Field(name, "flag", [name])
    if node.child("zone"):
        return Field(name, "zone", [fill(v) for v in values if words(v)[0] != "..."])
    texts = [words(v)[0] for v in values if words(v)[0] != "..."]
    if node.child("ordered"):
        return Field(name, "order", texts)
    return Field(name, "length" if texts and texts[0][0].isdigit() else "choice", texts)


def fill(value):
    depths = value.child("depths")
    return words(value)[0], [words(d)[0] for d in find_all(depths, "spec_word")] if depths else []


# ---- the rest

def rule(scope, item):
    head = item.child("rule_head")
    about = head.context.form if head.context.form else head.context.schema
    scope.rules[named(head)] = Rule(about, list(head.context.params))


def measure(scope, item):
    scope.measures[named(item)] = Measure(item.context.form or item.context.schema, item.context.dimension)


def let(scope, item):
    scope.lets[named(item)] = (item.context.field.name if item.context.field else None, item.context.dimension)


def param(scope, item):
    """A number stands where a `let` may; words are compared."""
    choice, texts = item.child("param_words"), words(item)
    names = words(choice)[::2] if choice else []
    ends = texts[texts.index("in") + 1:] if item.child("IN") else []
    ends = [ends[0], ends[-1]] if len(ends) == 3 else []
    scope.params[named(item)] = Param(item.context.dimension, names, ends)
    if not choice:
        scope.lets[named(item)] = (None, item.context.dimension)


def library(scope, item):
    head = item.child("library_head")
    scope.libraries[named(head)] = Library(head.context.schema, head.context.form)


def form(scope, item):
    head = item.child("form_head")
    made = scope.forms[named(head)] = Form(head.context.schema)
    for clause in find_all(item, "form_clause"):
        form_clause(made, clause)


def form_clause(made, clause):
    lists = {"storey": made.storeys, "function": made.functions, "opening": made.openings, "flight": made.flights}
    first = clause.children[0].symbol
    if first in lists:
        lists[first].append(named(clause))
    if first == "opening" and "passage" in words(clause):
        made.passages.append(named(clause))
    elif first in ("option", "section"):
        choice = words(clause)[1:words(clause).index("=")]
        made.options.append((choice, [words(s)[0] for s in find_all(clause, "shape")]))
    elif first == "tile":
        made.items += [p.child("NAME").text for p in find_all(clause, "tile_part") if words(p)[0] == "item"]


DECLARED = {"schema": schema, "rule_head": rule, "measure": measure, "let": let, "param": param, "library_head": library, "form_head": form}
