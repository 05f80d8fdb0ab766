#!/usr/bin/env python3
"""Edits of rules as pictures, held to the same edits of trees: rule_edits.py LIBTARTAN SEED COUNT FOLDER...

COUNT random edits of the rules of the .plan files below the FOLDERs that compile, by turns with random rules (rule_random.py). Each is
asked of `rule_edit` and made of the tree by rule_model.py. Then the changed text compiles; its tree is the one that was worked out, and the part that is named is the one
that the edit was about; undoing it gives the bytes; nothing but the rule changes, and all comments stay; and what was laid out is. An edit
that is refused has no tree, or one that does not compile. Rules of six trays match the plans that they should (rule_meaning.py).
--refusals shows some edits that were refused for each reason."""
import collections
import ctypes
import glob
import json
import os
import random
import re
import sys

import rule_meaning as meaning
from rule_model import COUNTED, ROWS, Impossible, Part, Tree, any_tray, bare, check_row, step, without_comments, written, written_out
from rule_random import Maker, comment, random_file


class Error(ctypes.Structure):
    _fields_ = [("status", ctypes.c_int), ("code", ctypes.c_uint32), ("column", ctypes.c_uint32), ("message", ctypes.c_char * 480),
                ("help", ctypes.c_char * 320)]


class Wrong(Exception):
    pass


def right(good, *what):
    if not good:
        raise Wrong("\n  ".join(str(one) for one in what))


# ---- the library

class Session:
    """A text that is open. Its questions are answered with what JSON holds; Wrong: refused."""
    c = None

    def __init__(self, path, text):
        self.session, error = ctypes.c_void_p(), Error()
        data = text.encode()
        if self.c.tartan_session_open(path.encode(), data, ctypes.c_size_t(len(data)), None, ctypes.byref(self.session), ctypes.byref(error)):
            self.session = None
            raise Wrong("does not open: " + error.message.decode(errors="replace"))

    def __del__(self):
        if self.session:
            self.c.tartan_session_free(self.session)

    def ask(self, question, **request):
        answer, error = ctypes.c_void_p(), Error()
        if self.c.tartan_ask(self.session, question.encode(), json.dumps(request).encode(), None, None, None, ctypes.byref(answer), ctypes.byref(error)):
            raise Wrong(f"{question} {request}: {error.message.decode(errors='replace')}")
        text = ctypes.string_at(answer).decode()
        self.c.tartan_text_free(answer)
        return json.loads(text)


def opens(path, text):
    try:
        Session(path, text)
    except Wrong:
        return False
    return True


# ---- texts

MARK = "\ufeff"


class Text:
    """A text by places in UTF-16 units, which its byte order mark is no part of."""

    def __init__(self, text):
        self.text = text
        self.units = text.removeprefix(MARK).encode("utf-16-le")
        self.lines = [0] + [at + 2 for at in range(0, len(self.units), 2) if self.units[at:at + 2] == b"\n\0"]

    def slice(self, begin, end):
        return self.units[2 * begin:2 * end].decode("utf-16-le")

    def at(self, place):
        return self.slice(place["utf16_begin"], place["utf16_end"])

    def position(self, position):
        """A place in a line, which ends before what ends it."""
        begin = self.lines[position["line"]]
        end = (self.lines + [len(self.units) + 2])[position["line"] + 1] - 2
        end -= 2 if self.units[end - 2:end] == b"\r\0" and end - 2 >= begin else 0
        right(begin + 2 * position["character"] <= end, "a place behind the end of its line", position)
        return begin // 2 + position["character"]

    def where(self, unit):
        line = max(i for i, begin in enumerate(self.lines) if begin <= 2 * unit)
        return {"line": line, "character": unit - self.lines[line] // 2}


def applied(text, edits):
    """The changed text, and the edits that undo this."""
    right(len(edits) <= 1, "more than one change", edits)
    if not edits:
        return text, []
    old, edit = Text(text), edits[0]
    begin, end = old.position(edit["range"]["start"]), old.position(edit["range"]["end"])
    mark = MARK if text.startswith(MARK) else ""
    new = mark + old.slice(0, begin) + edit["newText"] + old.slice(end, len(old.units) // 2)
    behind = begin + len(edit["newText"].encode("utf-16-le")) // 2
    undo = {"range": {"start": Text(new).where(begin), "end": Text(new).where(behind)}, "newText": old.slice(begin, end)}
    return new, [undo]


LENGTH_OR_TEXT = re.compile(r"""\d+(?:-\d+/\d+)?["'’”′″]|"[^"\r\n]*"|[“„][^”"\r\n]*[”"]|(#[^\r\n]*)""")


def comments(text):
    return collections.Counter(found for found in LENGTH_OR_TEXT.findall(text) if found)


# ---- trees

def tree_of(answer, text):
    """What rule_tree answers, as rule_model.py has it."""
    made = []
    for shown in answer["parts"]:
        part = Part(shown["kind"], [], shown.get("name"), shown.get("condition"), "", shown.get("relation"), shown.get("binds", []),
                    [item["text"] for item in shown["items"]], shown["text"] if shown["kind"] == "text" else None)
        right(shown["number"] == len(made) and text.at(shown["place"]) == shown["text"], "a part with a number or place of another", shown)
        made.append(part)
        if "parent" in shown:
            made[shown["parent"]].parts.append(part)
    for shown, part in zip(answer["parts"], made):
        if part.kind in COUNTED:
            inner = max(other["around"]["utf16_end"] for other in answer["parts"] if other.get("parent") == shown["number"])
            part.region = bare(text.slice(inner, shown["condition_place"]["utf16_begin"])).rstrip(",")
        if part.kind == "sum":
            first = min(other["around"]["utf16_begin"] for other in answer["parts"] if other.get("parent") == shown["number"])
            before = without_comments(text.slice(shown["place"]["utf16_begin"], first))
            part.relation = before[before.index("(") + 1:before.rindex("of")].strip()
    return made[0]


class Case:
    """A rule of a text that is open."""

    def __init__(self, path, text, rule, six=False):
        self.path, self.text, self.rule, self.six = path, text, rule, six
        self.session = Session(path, text)
        self.units = Text(text)
        self.answer = self.session.ask("rule_tree", rule=rule)
        self.tree = tree_of(self.answer, self.units)
        self.parts = list(self.tree.walk())

    def laid_out(self):
        """The text as it is laid out, and whether the rule stands there as it does here."""
        text = self.session.ask("format")["text"]
        there = Case(self.path, text, self.rule)
        return there.units.at(there.answer["place"]) == self.units.at(self.answer["place"]).replace("\r", "")


# ---- edits

class Edits:
    """Random edits of a case: each a request, and what it makes of the tree."""

    def __init__(self, r, case):
        self.r, self.case, self.tree = r, case, Tree(case.tree)

    def number(self):
        return self.r.randrange(len(self.case.parts))

    def of_kind(self, *kinds):
        """A part of these kinds, and now and then any other."""
        found = [i for i, part in enumerate(self.case.parts) if part.kind in kinds]
        return self.r.choice(found) if found and self.r.random() < 0.95 else self.number()

    def item(self):
        fields = [field for field in self.case.answer["fields"] if field["items"]]
        return self.r.choice(self.r.choice(fields)["items"])

    def new(self):
        """A part that is put somewhere."""
        r, tray = self.r, lambda: Part("tray", items=[self.item()])
        names = [usable["name"] for usable in self.case.answer["names"] if usable["means"] in ("rule", "bound")]
        made = [tray, any_tray, lambda: r.choice(self.case.parts).uncommented(), lambda: Part("not", [tray()]), lambda: Part("and", [tray(), tray()]),
                lambda: Part("or", [tray(), any_tray()]), lambda: Part("implies", [tray(), tray()]), lambda: Part("neighbour", [tray(), tray()]),
                lambda: Part("gap"), lambda: Part(r.choice(["beginning", "end"])), lambda: Part("quantity", [tray()], condition="n > 1"),
                lambda: Part("near", [tray(), any_tray()], relation="beside")]
        if self.case.six and self.case.rule != "wide":
            made += [Maker(r).part] * 3
        if names:
            made.append(lambda: Part("name", name=r.choice(names)))
        return r.choice(made)()

    def parts(self, *numbers):
        return [self.tree.parts[number] for number in numbers]

    # Each gives what is asked, and how the tree is edited.

    def step(self):
        number = self.of_kind("tray", "any")
        part, shown = self.tree.parts[number], self.case.answer["parts"][number]
        field = self.r.choice(self.case.answer["fields"])
        depth = field["zone"] and self.r.random() < 0.5
        asked = {"part": number, "field": field["name"], **({"depth": True} if depth else {})}

        def make():
            does = step(part, self.case.answer["fields"], [item.get("field") for item in shown["items"]], field, depth)
            if does is None:
                self.tree.root.kind = "?"
            else:
                {"set": self.tree.set, "clear": self.tree.clear}[does[0]](part, *does[1:]) if does[0] != "add" else self.tree.add(part, does[2], does[1])
        return asked, make

    def set(self):
        number = self.of_kind("tray")
        item, text = self.r.randrange(max(1, len(self.case.parts[number].items)) + (self.r.random() < 0.05)), self.item()
        return {"part": number, "item": item, "text": text}, lambda: self.tree.set(*self.parts(number), item, text)

    def clear(self):
        number = self.of_kind("tray")
        item = self.r.randrange(max(1, len(self.case.parts[number].items)))
        return {"part": number, "item": item}, lambda: self.tree.clear(*self.parts(number), item)

    def add(self):
        number, text = self.of_kind("tray", "any"), self.item()
        at = self.r.choice([{}, {"item": self.r.randrange(3)}])
        return {"part": number, "text": text, **at}, lambda: self.tree.add(*self.parts(number), text, **at)

    def wrap(self):
        number, by = self.number(), self.r.choice(self.case.answer["boxes"])
        return {"part": number, "by": by}, lambda: self.tree.wrap(*self.parts(number), by)

    def unwrap(self):
        number = self.r.choice([i for i, part in enumerate(self.case.parts) if part.parts] or [0])
        at = self.r.choice([{}, {"at": self.r.randrange(max(1, len(self.case.parts[number].parts)))}])
        return {"part": number, **at}, lambda: self.tree.unwrap(*self.parts(number), **at)

    def join(self):
        number, by = self.number(), self.r.choice(["and", "or"])
        asked = {"part": number, "by": by, **({"before": True} if self.r.random() < 0.5 else {})}
        before = "before" in asked
        if self.r.random() < 0.4:
            other = self.number()
            return {**asked, "from": other}, lambda: self.tree.join_moved(*self.parts(number, other), by, before)
        new = self.new()
        return {**asked, "text": written(new)}, lambda: self.tree.join(*self.parts(number), new, by, before)

    def place(self):
        """A part that others are put into, and where."""
        number = self.r.choice([i for i, part in enumerate(self.case.parts) if part.parts] or [0])
        row = self.case.parts[number].kind in ROWS
        return number, self.r.choice([{}, {"at": self.r.randrange(max(1, len(self.case.parts[number].parts)) + row)}])

    def insert(self):
        (number, at), new = self.place(), self.new()
        return {"part": number, **at, "text": written(new)}, lambda: self.tree.insert(*self.parts(number), new, **at)

    def move(self):
        (number, at), origin = self.place(), self.number()
        return {"part": number, **at, "from": origin}, lambda: self.tree.move(*self.parts(number, origin), **at)

    def remove(self):
        number = self.number()
        return {"part": number}, lambda: self.tree.remove(*self.parts(number))

    def condition(self):
        number = self.of_kind(*COUNTED)
        text = self.r.choice(list(meaning.SUM_CONDITIONS if self.case.parts[number].kind == "sum" else meaning.CONDITIONS))
        return {"part": number, "text": text}, lambda: self.tree.condition(*self.parts(number), text)

    def text(self):
        number = self.number()
        new = self.case.parts[number].uncommented() if self.r.random() < 0.3 else self.new()
        return {"part": number, "text": written(new, lambda: self.r.random() < 0.2)}, lambda: self.tree.text(*self.parts(number), new)


OPERATIONS = ["step", "set", "clear", "add", "wrap", "unwrap", "join", "join", "insert", "insert", "move", "move", "remove", "condition", "text"]


BY_LINE = r"has no clause `\w+@\d+`"  # a test names a clause by its line, and there would be more lines before it


class Edit:
    def __init__(self, r, case, operation=None, request=None, make=None, tree=None):
        self.r, self.case, self.operation = r, case, operation or r.choice(OPERATIONS)
        if request is None:
            edits = Edits(r, case)
            request, make = getattr(edits, self.operation)()
            tree = edits.tree
        self.request, self.tree, self.impossible, self.free = request, tree, None, False
        try:
            make()
            self.free = tree.root.kind == "?"      # what it makes is not said
            if not self.free:
                check_row(tree.root)
        except Impossible as impossible:
            self.impossible = impossible

    def told(self):
        return f"{self.case.path}, rule {self.case.rule}: {self.operation} {json.dumps(self.request, ensure_ascii=False)}"

    def made(self):
        """The changed case; None: it is refused, rightly."""
        answer = self.case.session.ask("rule_edit", rule=self.case.rule, operation=self.operation, **self.request)
        if "why_not" in answer:
            self.check_refusal(answer)
            return None
        right(self.impossible is None, f"made, though {self.impossible}", answer)
        new, undo = applied(self.case.text, answer["edits"])
        right(applied(new, undo)[0] == self.case.text, "undo gives another text")
        self.check_around(new)
        after = Case(self.case.path, new, self.case.rule, self.case.six)
        self.check_tree(after, answer)
        return after

    def check_refusal(self, answer):
        why = answer["why_not"]
        refusals[re.sub(r"`[^`]*`|\d+", "_", why)] += 1
        if len(refusal_of.setdefault(re.sub(r"`[^`]*`|\d+", "_", why), [])) < 3:
            refusal_of[re.sub(r"`[^`]*`|\d+", "_", why)].append((self.told(), why))
        right(not answer["edits"] and "part" not in answer, "refused and changed")
        by_words = "stands for several values" in why and any("field" not in item for item in self.case.answer["parts"][self.request["part"]]["items"])
        if self.impossible is None and not self.free and not by_words and not re.search(BY_LINE, why):
            place = self.case.answer["parts"][0]["around"]
            text = self.case.units.slice(0, place["utf16_begin"]) + written_out(self.tree.root) + self.case.units.slice(place["utf16_end"], len(self.case.units.units))
            right(not opens(self.case.path, text), f"refused, though it compiles: {why}", written_out(self.tree.root))

    def check_around(self, new):
        """Nothing but the rule changes, but for comments, which all stay."""
        place, old = self.case.answer["place"], self.case.units
        before, behind = old.slice(0, place["utf16_begin"]), old.slice(place["utf16_end"], len(old.units) // 2)
        bare_new = new.removeprefix(MARK)
        right("\r\n" not in before or not re.search(r"(?<!\r)\n", new) or re.search(r"(?<!\r)\n", self.case.text), "a line that ends otherwise", new)
        right(bare_new.startswith(before) and bare_new.endswith(behind), "changes what is around the rule", new)
        right(comments(new) == comments(self.case.text), "comments", comments(new) - comments(self.case.text), comments(self.case.text) - comments(new), new)

    def check_tree(self, after, answer):
        if self.free:
            return
        wanted = self.tree.root
        right(after.tree.shape() == wanted.shape(), "another tree", after.units.at(after.answer["place"]), "instead of " + written(wanted))
        right(answer["part"] == self.tree.number(), f"about part {answer['part']} instead of {self.tree.number()}", after.units.at(after.answer["place"]))


def undone(r, case, edit, after):
    """What takes the edit back, as an edit of the changed tree; None: nothing does so simply."""
    tree, number = Tree(after.tree), edit.tree.number()
    part = tree.parts[number]
    if edit.operation == "wrap":
        request, make = {"part": number, "at": 0}, lambda: tree.unwrap(part, 0)
        return Edit(r, after, "unwrap", request, make, tree)
    row = case.parts[edit.request["part"]].kind in ROWS
    if edit.operation == "insert" and row:
        return Edit(r, after, "remove", {"part": number}, lambda: tree.remove(part), tree)
    return None


# ---- one edit and all that is asked of it

PLANS = [meaning.Plans(n) for n in range(1, meaning.LONGEST + 1)]
LINES = [line for plans in PLANS for line in plans.lines()]
WORDS = {"wide": ([], Part("tray", items=["3m"])),
         "pair": (["p", "q"], Part("symmetric", [Part("neighbour", [Part("name", name="p"), Part("name", name="q")])])),
         "most": (["p", "k"], Part("quantity", [Part("name", name="p")], condition="n <= k")),
         "sized": (["v"], Part("tray", items=["width v", "lit"]))}


def check_meaning(case, wanted):
    """The plans that the rule matches are those that the tree does."""
    rules = {**WORDS, **{other: ([], case.others[other]) for other in case.others}}
    try:
        part = meaning.expanded(wanted, rules, {})
        sets = [plans.matched(part) for plans in PLANS]
    except meaning.Unknown:
        counts["without a meaning"] += 1
        return
    answer = case.session.ask("match", plans=LINES, rules=[case.rule])
    found = [bool(plan["rules"]) for plan in answer["plans"]]
    judged = [bool(bits >> k & 1) for plans, bits in zip(PLANS, sets) for k in range(len(plans.plans))]
    counts["with a meaning"] += 1
    counts["of which some plans match"] += 0 < sum(judged) < len(judged)
    bad = [line for line, one, other in zip(LINES, found, judged) if one != other]
    right(not bad, f"{len(bad)} plans are matched otherwise, such as {bad[:3]}", written(wanted))


def shape_of(session, rule):
    """Kinds and texts of its parts, or why it has none."""
    try:
        return [(part["kind"], part["text"]) for part in session.ask("rule_tree", rule=rule)["parts"]]
    except Wrong as wrong:
        return str(wrong)


def one_edit(r, case, edit):
    """The changed case, or None."""
    laid_out = r.random() < 0.2 and case.laid_out()
    after = edit.made()
    counts[edit.operation] += 1
    if after is None:
        counts["refused"] += 1
        return None
    if laid_out:
        counts["laid out"] += 1
        right(after.laid_out(), "was laid out and is not", after.units.at(after.answer["place"]))
    if r.random() < 0.1:
        for name in names_in(case.text):
            if name != case.rule:
                counts["other rules"] += 1
                right(shape_of(case.session, name) == shape_of(after.session, name), f"another rule has another tree: {name}")
    if after.six and not edit.free:
        after.others = case.others
        check_meaning(after, edit.tree.root)
    back = undone(r, case, edit, after) if not edit.free else None
    if back:
        counts["taken back"] += 1
        again = back.made()
        right(again is not None and again.tree.shape() == case.tree.shape(), "is not taken back", back.told())
    return after


def some_edit(r, case):
    """Mostly one that has a tree."""
    edit = Edit(r, case)
    for _ in range(3):
        if edit.impossible is None or r.random() < 0.05:
            break
        edit = Edit(r, case)
    return edit


def try_edit(r, case):
    edit = some_edit(r, case)
    try:
        return one_edit(r, case, edit)
    except Wrong as wrong:
        faults.append(f"{edit.told()}:\n  {wrong}\n  rule: {case.units.at(case.answer['place'])!r}")
        return None


def walk(r, case, most):
    """Up to so many edits, some of them one after another."""
    for _ in range(most):
        after = try_edit(r, case)
        if after and r.random() < 0.6 and len(after.parts) < 40:
            after.others = case.others
            case = after
    return most


# ---- sources

def names_in(text):
    """The names of its rules, and of comments that look like such."""
    return dict.fromkeys(re.findall(r"\brule\s+([\w-]+)", text, re.I))


def rules_of(path, text):
    """The names of the rules of a file that compiles."""
    session = Session(path, text)
    return [name for name in names_in(text) if isinstance(shape_of(session, name), list)]


def varied(r, case):
    """The text with comments around parts of the rule, other line ends, or a byte order mark; as it is, if that does not compile."""
    text, share = case.text, r.random()
    if share < 0.3:
        places = sorted({place for shown in case.answer["parts"] for place in (shown["around"]["utf16_begin"], shown["around"]["utf16_end"])}, reverse=True)
        for place in places:
            units = Text(text)
            if r.random() < 0.5:
                text = units.slice(0, place) + comment(r, "\n") + units.slice(place, len(units.units) // 2)
        text = (MARK if case.text.startswith(MARK) else "") + text
    if 0.2 < share < 0.4 and "\r" not in text:
        text = text.replace("\n", "\r\n")
    if 0.35 < share < 0.45 and not text.startswith(MARK):
        text = MARK + text
    try:
        return Case(case.path, text, case.rule)
    except Wrong:
        counts["not varied"] += 1
        return case


def sources(r, folders):
    """Cases without an end: the rules of files by turns with random ones."""
    of_files = []
    for path in sorted(path for folder in folders for path in glob.glob(os.path.join(folder, "**", "*.plan"), recursive=True)):
        with open(path, encoding="utf-8", errors="replace", newline="") as file:
            text = file.read()
        if opens(path, text):
            of_files += [(path, text, name) for name in rules_of(path, text)]
    counts["rules of files"] = len(of_files)
    while True:
        r.shuffle(of_files)
        for path, text, name in of_files:
            case = varied(r, Case(path, text, name))
            case.others = {}
            yield case
            yield from random_cases(r)


def random_cases(r):
    text, names, six = random_file(r, lambda text: opens("random.plan", text))
    text = text.replace("\n", "\r\n") if r.random() < 0.2 else text
    text = MARK + text if r.random() < 0.2 else text
    trees = {name: Case("random.plan", text, name) for name in names}
    case = Case("random.plan", text, r.choice(names), six)
    case.others = {name: other.tree for name, other in trees.items() if name != case.rule} if six else {}
    yield case


# ---- new rules

def check_new(r, case):
    text = case.text
    at = r.choice([{}, {"at": r.randrange(len(Text(text).units) // 2 + 1)}])
    answer = case.session.ask("rule_edit", rule="brand-new", operation="new", **at)
    if re.search("several schemas|" + BY_LINE, answer.get("why_not", "")):
        counts["no new rule"] += 1
        return
    right("why_not" not in answer, "no new rule", answer)
    new, undo = applied(text, answer["edits"])
    right(applied(new, undo)[0] == text, "undo of a new rule")
    right(comments(new) == comments(text), "comments")
    made = Case(case.path, new, "brand-new")
    right([part.kind for part in made.parts] == ["any"], "a new rule is not `any`")
    right(Case(case.path, new, case.rule).tree.shape() == case.tree.shape(), "a new rule changes another")


# ---- all

counts, refusals, refusal_of, faults = collections.Counter(), collections.Counter(), {}, []


def main():
    Session.c = ctypes.CDLL(sys.argv[1])
    r, wanted, done = random.Random(int(sys.argv[2])), int(sys.argv[3]), 0
    for case in sources(r, sys.argv[4:]):
        done += walk(r, case, min(5, wanted - done))
        try:
            check_new(r, case)
        except Wrong as wrong:
            faults.append(f"{case.path}: new: {wrong}")
        if done >= wanted or len(faults) > 50:
            break
    print(", ".join(f"{n} {what}" for what, n in sorted(counts.items())))
    for why, n in refusals.most_common():
        print(f"{n:6} {why}")
        if VERBOSE:
            for told, said in refusal_of[why]:
                print(f"           {told}: {said}")
    print(*faults[:10], sep="\n")
    print(f"{done} edits, {len(faults)} wrong")
    sys.exit(1 if faults else 0)


VERBOSE = "--refusals" in sys.argv
if VERBOSE:
    sys.argv.remove("--refusals")
if __name__ == "__main__":
    main()
