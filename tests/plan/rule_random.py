"""Random files of rules over two small schemas, for rule_edits.py: every kind of part in one another, with comments between all tokens,
parentheses that nobody needs, tabs, characters that take one, two, three and four bytes, and several rules on a line."""
import re

import rule_meaning as meaning
from rule_model import Part, any_tray, written

HELPERS = ("rule wide = tray(3m)\nrule pair(p, q) = symmetric neighbour(p, q)\nrule most(p, k) = quantity(p, n <= k)\n"
           "rule sized(v) = tray(width v, lit)\n")
# Of the other schema only what a click on a sign makes of trays is asked; it has every kind of field.
SIGNS = """schema strip "trays — with “signs” 𝔖" {
  front "the street’s" = 2m | 3m | 4.5m
  use = room | store | stair
  height = one < two < three
  lit = flag
  zone wall = solid(1m, 2m) | open(1m) | none
}
rule wide = tray(3m)
rule pair(p, q) = symmetric neighbour(p, q)
"""
SIGN_ITEMS = ["3m", "front 4.5m", "front >= 3m", "room", "use not stair", "room or stair", "height two", "height >= two", "lit", "not lit",
              "wall solid", "wall solid 2m", "wall open 1m", "wall not none", "wall depth > 1m"]
FIELD_OF = {"3m": "front", "room": "use", "not": "lit", "lit": "lit"}

TOKEN = re.compile(r"[A-Za-z][\w-]*|\d+(?:\.\d+)?(?:m2?|%)?|<=|>=|!=|\.\.\.|\.\.|\S")
COMMENTS = ["# c{}", "#", "# é{} — “so”", "# 𝔘𝔫𝔦 {} 🙂", "#\ttab {}", "# rule x{} = any", '# "open {}', "# (", "# ) or"]


class Maker:
    def __init__(self, r, signs=False):
        self.r, self.signs, self.bound = r, signs, []

    def item(self):
        if self.bound and self.r.random() < 0.3:
            return "width " + self.r.choice(self.bound)
        return self.r.choice(SIGN_ITEMS if self.signs else list(meaning.ITEMS))

    def tray(self):
        """No field twice."""
        items = {re.sub(r"^(not )?", "", item).split()[0] if self.signs else "lit" in item: item for item in
                 [self.item() for _ in range(self.r.choice([1, 1, 2]))]}
        return Part("tray", items=list(items.values())) if self.r.random() < 0.95 else Part("tray")

    def leaf(self):
        share = self.r.random()
        return self.tray() if share < 0.7 else any_tray() if share < 0.8 else Part("name", name="wide") if share < 0.9 or self.signs else self.text()

    def text(self):
        return Part("text", text=self.r.choice(list(meaning.TEXTS)))

    def call(self, deep):
        if not self.signs and self.r.random() < 0.3:
            return Part("call", [Part("text", text=f"{self.r.choice(meaning.WIDTHS)}m")], name="sized")
        if not self.signs and self.r.random() < 0.5:
            return Part("call", [self.part(deep), Part("text", text=str(self.r.randint(0, 2)))], name="most")
        return Part("call", [self.part(deep), self.part(deep)], name="pair")

    def row(self, deep):
        parts = [self.part(deep) for _ in range(self.r.randint(1, 3))]
        parts = [Part("optional", [part]) if self.r.random() < 0.15 else part for part in parts]
        if self.r.random() < 0.25:
            parts.insert(self.r.randint(0, len(parts)), Part("gap"))
        return Part("neighbour", [Part("beginning")] * (self.r.random() < 0.2) + parts + [Part("end")] * (self.r.random() < 0.2)).copy()

    def near(self, deep):
        return Part(self.r.choice(["near", "every near"]), [self.part(deep), self.part(deep)], relation=self.r.choice(list(meaning.RELATIONS)))

    def where(self, deep):
        about = Part("text", text=self.r.choice(list(meaning.REGIONS) + list(meaning.TEXTS)))
        if self.r.random() < 0.3:
            about = Part("quantity", [self.tray()], condition=self.r.choice(list(meaning.CONDITIONS)), region=self.r.choice(["before", "after"]))
        return Part("where", [self.part(deep), about])

    def quantifier(self, deep):
        words = self.r.sample(["v", "w"], self.r.choice([1, 1, 2])) if not self.bound else []
        if self.signs or not words:
            return self.row(deep)
        self.bound = words
        made = Part(self.r.choice(["some", "each"]), [Part("or", [Part("tray", items=["width " + word for word in words[:1]]), self.part(deep)])],
                    name="width", binds=words)
        if len(words) > 1:
            made.parts[0].parts.append(Part("tray", items=["width " + words[1]]))
        self.bound = []
        return made

    def distance(self, deep):
        counted = Part("quantity", [self.tray()], condition=self.r.choice(list(meaning.CONDITIONS)))
        by = counted if self.signs or self.r.random() < 0.6 else Part("text", text="sum(width, w > 3m)")
        return Part("distance", [self.part(deep), self.part(deep), by])

    def part(self, deep=0):
        if deep >= 3 or self.r.random() < 0.12 * deep:
            return self.leaf()
        kind = self.r.choice(["and", "or", "and", "or", "not", "implies", "where", "row", "row", "symmetric", "counted", "counted", "many", "every",
                              "near", "quantifier", "distance", "call", "leaf"])
        own = {"leaf": lambda deep: self.leaf()}.get(kind) or getattr(self, kind, None)
        if own:
            return own(deep + 1)
        inner = self.part(deep + 1)
        if kind in ("and", "or"):
            return Part(kind, [inner] + [self.part(deep + 1) for _ in range(self.r.randint(1, 2))])
        if kind == "counted" and not self.signs and self.r.random() < 0.25:
            return Part("sum", [inner], "width", self.r.choice(list(meaning.SUM_CONDITIONS)), relation="width")
        if kind == "counted":
            return Part(self.r.choice(["quantity", "occurrences"]), [inner], condition=self.r.choice(list(meaning.CONDITIONS)))
        if kind == "symmetric":
            return Part("symmetric", [self.row(deep + 1)])
        return Part(kind, [inner, self.part(deep + 1)] if kind in ("implies", "every") else [inner])


# ---- as a text that somebody with strange habits wrote

def comment(r, line):
    return r.choice(COMMENTS).format(r.randrange(1000)) + line


def strewn(r, text, share):
    """The text with comments between its tokens, or other blanks than one: none where none is needed."""
    tokens, made, tight = TOKEN.findall(text), [], r.random() < 0.3
    for token, behind in zip(tokens, tokens[1:] + [" "]):
        words = re.fullmatch(r"[\w.%-].*", token[-1]) and re.match(r"[\w.%-]", behind)
        blank = "" if tight and not words else r.choice([" "] * 6 + ["\n", "\t", "  ", "\n\t"])
        made += [token, comment(r, "\n") if r.random() < share else blank]
    return "".join(made)


def rule_text(r, name, part):
    doc = r.choice(["", "", ' "a doc"', ' "ä “quote” # no comment"', ' "🙂🙂 — 𝔘"'])
    body = written(part, lambda: r.random() < 0.2)
    share = r.choice([0, 0, 0.1, 1])
    return f"rule {name}{doc} = " + (strewn(r, body, share) if share or r.random() < 0.3 else body)


def random_file(r, opens):
    """(text, names of its random rules, is it about the six trays?) opens: does such a text compile?"""
    signs = r.random() < 0.3
    head = SIGNS if signs else meaning.SCHEMA + HELPERS
    rules = {}
    while len(rules) < 3:
        name = f"r{len(rules)}"
        text = rule_text(r, name, Maker(r, signs).part())
        if opens(head + text):
            rules[name] = text
    gaps = [r.choice(["\n", " ", "\n\n", " # between " + name + "\n", "\n# é𝔘 " + name + "\n", "\t"]) for name in rules]
    text = r.choice(["", "# first 🙂\n"]) + head + "".join(text + gap for text, gap in zip(rules.values(), gaps)) + r.choice(["", "\n"])
    return text, list(rules), not signs
