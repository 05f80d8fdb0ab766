"""What grammars of genomes are about, beside their grammar: which symbols there are, and texts of both dialects."""
from dataclasses import dataclass, replace

from genome_questions import OF_GRAMMARS, QUICK, GenomeSubject
from kind import Kind
from maker import Notation
from tree import listed

NAMES = ["<e>", "<v>", "<Big-one>", "<x2>", "<größe>"]
MISTAKE = .008


@dataclass(frozen=True)
class Place:
    names: tuple
    genr8: bool
    head: str = None
    first: bool = False              # does the line begin here?

    def but(self, **changes):
        return replace(self, **changes)


GE_TEXTS = ["x", "+", "a b", "(", "u\\n", "\\x41", "größe", "\\\\", "0", "x[:, 1]", "{y}", "<", "GE_RANGE:3", "\\u00e9", "\\q", "z\\101"]
GE_QUOTED = ["'|'", '"#"', "'<e>'", '""', "'  '", '" x"', "'\\t'", "'\"'", '"it\'s"']
GENR8_TEXTS = ["+", "-", "->", "~", "x", "Angle", "30", "größe", "\\", "^"]
GENR8_QUOTED = ["';'", '"["', "'{'", "'|'", "'#'", "'<'"]


def text(maker, place):
    if place.genr8:
        return maker.random.choice(GENR8_TEXTS)
    if maker.chance(.3):
        name = maker.random.choice(place.names)
        return maker.random.choice(["({})", "{}+", "-{}", "{0}{0}", "x{}"]).format(name)
    return maker.random.choice(GE_TEXTS[:-4] if maker.chance(.8) else GE_TEXTS)


TOKENS = {
    "HEAD": lambda maker, place: place.head + maker.random.choice([" ::=", "::=", "  ::="]), "NAME": lambda maker, place: maker.random.choice(place.names),
    "TEXT": text, "QUOTED": lambda maker, place: maker.random.choice(GENR8_QUOTED if place.genr8 else GE_QUOTED), "NEWLINE": lambda maker, place: "\n",
    "COMMENT": lambda maker, place: "# a comment\n", "QUOTE": lambda maker, place: maker.random.choice("'\""), "STRAY": lambda maker, place: "stray",
    "EDGE_SAME": lambda maker, place: maker.random.choice(["EdgeX", "EdgeX", "EdgeY", "EdgeZ"]), "DIRECTIVE": lambda maker, place: place.head,
}
WEIGHTS = {"alternatives: alternatives BAR alternative": 2, "alternatives: alternatives COMMENT alternative": .08, "item: QUOTE": MISTAKE, "item: NEWLINE": .15, "item: QUOTED": .6,
           "item: TEXT": 2, "items: %empty": 1, "items: items item": 1.3, "item: EDGE_SAME": .6}
OF_GENR8 = {"item: EDGE", "item: EDGE_SAME", "item: REPEAT items REPEAT_END", "item: MAYBE items MAYBE_END"}


def alternatives(maker, depth, place):
    """Several, of which one is text alone, so that sentences end; sometimes a range."""
    count = maker.random.choice([1, 2, 2, 3, 4])
    made = [maker.make("alternative", maker.random.choice([1, 2, 3]), place) for _ in range(count)]
    if maker.chance(.85):
        ended = [maker.word("TEXT", maker.random.choice(["x", "7", "y"]))]
        if not place.genr8 and maker.chance(.25):
            ended = [maker.word("TEXT", maker.random.choice(["GE_RANGE:2", "GE_RANGE:3", "GE_RANGE:dataset_n_vars", "GE_RANGE:dataset_n_is"]))]
        items = listed(maker.grammar, "items", [maker.node("item: TEXT", ended[0])])
        made.append(maker.node("alternative: items", items))
    maker.random.shuffle(made)
    node = maker.node("alternatives: alternative", made[0])
    for alternative in made[1:]:
        comment = not place.genr8 and maker.chance(.08)
        node = maker.node("alternatives: alternatives COMMENT alternative", node, maker.word("COMMENT", "# a comment\n"), alternative) if comment else \
            maker.node("alternatives: alternatives BAR alternative", node, alternative)
    return node


class Grammars(Notation):
    start = "file"
    indents = {"rule": 0, "DIRECTIVE": 0}
    remade = ("alternative", "alternatives", "items", "item")
    hooks = {"alternatives": alternatives}

    def weight(self, production, context):
        if production.name in OF_GENR8 and not context.genr8 or production.name == "item: NEWLINE" and context.genr8:
            return 0
        return WEIGHTS.get(production.name, 1)

    def token(self, maker, token, context):
        return TOKENS[token](maker, context)


class GrammarKind(Kind):
    name, grammar_file, suffix, notation = "grammars", "bnf.y", ".bnf", Grammars()
    literals = {"BAR": "|", "REPEAT": "{", "REPEAT_END": "}", "MAYBE": "[", "MAYBE_END": "]", "EDGE": "Edge"}
    not_reached = {
        "rule: HEAD broken": "after an error", **{f"skipped: {token}": "after an error" for token in (
            "NAME", "TEXT", "QUOTED", "NEWLINE", "QUOTE", "EDGE", "EDGE_SAME", "BAR", "COMMENT", "REPEAT", "REPEAT_END", "MAYBE", "MAYBE_END")},
        "broken: broken skipped": "after an error",
    }

    def make_file(self, maker):
        random = maker.random
        place = Place(tuple(random.sample(NAMES, random.randint(1, 4))), maker.chance(.35))
        prelude = maker.node("prelude: %empty")
        for directive in directives(maker, place):
            prelude = maker.node("prelude: prelude DIRECTIVE", prelude, maker.word("DIRECTIVE", directive))
        if maker.chance(.02):
            prelude = maker.node("prelude: prelude STRAY", prelude, maker.word("STRAY", "stray"))
        rules = maker.node("rules: %empty")
        for name in place.names:
            rules = maker.node("rules: rules rule", rules, maker.make_of("rule: HEAD alternatives", 4, place.but(head=name)))
        return maker.node("file: prelude rules", prelude, rules)

    def subject(self, path, folder, part, tree):
        return GenomeSubject(path, folder, part, tree)

    def questions(self, path):
        return [(q, None) for q in QUICK], [(q, None) for q in OF_GRAMMARS]


def directives(maker, place):
    random = maker.random
    made = ["%dialect genr8", "%repair off"] if place.genr8 else ["%dialect ge"] * maker.chance(.8) + ["%dataset-vars 2", "%dataset-inputs 3"]
    made += [f"%wraps {random.choice([0, 1, 2, 3])}"] * maker.chance(.4) + [f"%max-depth {random.choice([0, 3, 4, 5, 8])}"] * maker.chance(.4)
    if not place.genr8 and maker.chance(.25):
        made.append(random.choice(["%single-choice skip", "%single-choice consume", "%mapping position-independent"]))
    return made


GRAMMARS = GrammarKind()
