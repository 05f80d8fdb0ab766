"""Every question about plans and houses against every other: nothing is worked out but by the program itself.

A question is a function that is given a PlanSubject and raises Wrong where two answers differ."""
import os
import re
import shutil
from fractions import Fraction

import file_questions
from c_ask import c_ask
from c_interface import c_interface
from exports import prolog, regex
from house_files import bills, solids, swings
from program import Refused, answer, json_lines, read_json, run, same
from searched import OF_SEARCHED
from settings import set_as_written
from source import Source
from subject import Subject

LISTED = 3000            # no more plans or houses than this are listed


class PlanSubject(Subject):
    """A file about plans or houses, or one of its libraries."""

    def __init__(self, path, folder, part=None, tree=None):
        super().__init__(path, folder, part, tree)
        self.source = Source(self.text)
        self.item = self.source.by_name[part] if part else None
        self.options = ["--library", part] if part else []
        self._lines = self._counts = None

    def edited(self, more):
        """The file with more items."""
        return self.file("edited.plan", self.text + more)

    @property
    def houses(self):
        return self.source.about(self.item)[1] is not None

    @property
    def counts(self):
        if self._counts is None:
            self._counts = self.json("count", *([] if self.houses else ["--mirror"]))
        return self._counts

    @property
    def total(self):
        return how_many(self.counts)

    @property
    def lines(self):
        """All plans or houses in the order of their ranks; None where there are too many."""
        if self._lines is None and self.total <= LISTED:
            self._lines = self.ask("enumerate").split("\n")[:-1]
        return self._lines

    def without_last(self):
        """The file without the library's last clause, and the plans that it then has; None if it has no such clause, or too many plans."""
        lines = None if self.houses or self.lines is None else clause_lines(self)
        if not lines:
            return None
        file = without_line(self, [lines[-1][1]])
        return (file, self.ask("enumerate", file=file).split("\n")[:-1]) if count_kept(self, file) <= LISTED else None

    def where(self, question, file=None):
        return how_many(self.json("count", "--where", question, *([] if self.houses else ["--no-effects"]), file=file))

    def listed_where(self, question):
        return self.ask("enumerate", "--where", question).split("\n")[:-1]

    def rules(self):
        return self.source.suiting("rule", self.item)

    def measures(self):
        return self.source.suiting("measure", self.item)

    def using(self):
        schema, form = self.source.about(self.item)
        return form or schema

    def distribution(self, measure, file=None):
        """[(value, how many)]; `without` is then how many have none"""
        found = self.json("count", "--by", measure, file=file)
        self.without = int(found.get("none", 0))
        return [(Fraction(d["value"]), int(d["houses" if self.houses else "plans"])) for d in found["distribution"] if "value" in d]


def how_many(counts):
    return int(counts["houses"] if "houses" in counts else counts["kept"])


# ---- of the file

def loads(subject):
    """A module gives the counts that its source gives."""
    built = file_questions.loads(subject)
    for library in subject.source.of("library"):
        options = ["--library", library.name, "--json"]
        try:
            want = answer("count", subject.path, *options)
        except Refused as refused:
            if refused.limit:
                continue
            raise
        same("count of the module", read_json("count", answer("count", built, *options)), read_json("count", want))


def says_json(subject):
    """Other answers that are JSON."""
    code, out, err = run("check", subject.path, "--relations", "--json", "--examples")
    nothing = code == 2 and "E0904" in err                       # there is nothing to relate
    if not nothing and code != 4:                                # or a library passes a limit
        read_json("check --relations", out)
    file_questions.says_json(subject)
    read_json("test --json", run("test", subject.path, "--json")[1] or "[]")


# ---- of a library

def counted_ways(subject):
    by_length = subject.counts["by_length"]
    lengths = by_length.values() if isinstance(by_length, dict) else [d["kept"] for d in by_length]
    same("sum by length = count", sum(map(int, lengths)), subject.total)
    if subject.lines is not None:
        same("lines of enumerate = count", len(subject.lines), subject.total)
        same("lines of enumerate, each once", len(set(subject.lines)), subject.total)
    if subject.total:
        completed = subject.json("complete", "...")
        same("complete ... = count", int(completed["houses" if subject.houses else "plans"]), subject.total)


def by_length(subject):
    """Plans or houses by their number of trays as a measure, and as `count` says it."""
    if not subject.total:
        return
    file = subject.edited(f"\nmeasure number-of-trays using {subject.using()} = trays\n")
    by_length = subject.counts["by_length"]
    counts = by_length.items() if isinstance(by_length, dict) else [(d["length"], d["kept"]) for d in by_length]
    same("--by trays = by length", subject.distribution("number-of-trays", file), sorted((Fraction(t), int(n)) for t, n in counts if int(n)))


def threads(subject):
    for count in "124":
        if subject.lines is not None:
            same(f"enumerate with {count} threads", subject.ask("enumerate", "--threads", count).split("\n")[:-1], subject.lines)
        if not subject.houses:
            same(f"count with {count} threads", subject.json("count", "--mirror", "--threads", count), subject.counts)


def by_measures(subject):
    """Each measure's values and how many plans have which, by `--by`, by `--where` and by `best`."""
    for measure in subject.measures()[:2] if subject.total else []:
        values = subject.distribution(measure)
        if not values:
            continue
        same("sum of --by = count", sum(n for _, n in values) + subject.without, subject.total)
        if subject.lines is None:
            continue
        groups = [(v, subject.listed_where(equals(subject, measure, v))) for v, _ in some(values)]
        for (value, lines), (_, count) in zip(groups, some(values)):
            same(f"--where {measure} = value as --by says", len(lines), count)
        best_of(subject, measure, "least", groups, len(groups) == len(values))
        best_of(subject, measure, "most", groups[::-1], len(groups) == len(values))


def some(values):
    return values if len(values) <= 6 else values[:3] + values[-3:]


def equals(subject, measure, value):
    """`measure = value`, in the unit of its dimension."""
    number = number_of(abs(value), unit_of(subject, measure))
    return f"{measure} = {number}" if value >= 0 else f"{measure} = 0 - {number}"


def unit_of(subject, measure):
    """As constants are written; of a number by a length with a stroke before it."""
    unit = subject.json("count", "--by", measure)["unit"]
    return "/" * unit.startswith("/") + {"": "", "ft": "'", "m": "m", "ft2": "sf", "m2": "m2", "ft3": "cf", "m3": "m3"}[unit.strip("/")]


def number_of(value, unit):
    if unit.startswith("/"):
        return f"{value.numerator} / {value.denominator} / 1{unit[1:]}"
    return f"{value.numerator}{unit} / {value.denominator}" if value.denominator != 1 else f"{value.numerator}{unit}"


def best_of(subject, measure, end, groups, complete):
    wanted = [(value, line) for value, lines in groups[:2 if not complete else None] for line in lines][:5]
    found = json_lines("best", subject.ask("best", str(len(wanted)), "--" + end, measure, "--format", "json"))
    got = [(Fraction(b["value"] if "value" in b else b["values"][0]), b["house"] if "house" in b else subject.lines[int(b["rank"])]) for b in found]
    same(f"best --{end} are the first of the sorted list", got, wanted)


def fronts(subject):
    """Of pareto, by the values of all plans as `--where` lists them."""
    measures = subject.measures()
    if len(measures) < 2 or not subject.total or subject.lines is None:
        return
    value_of = [values_of_lines(subject, m) for m in measures[:2]]
    if None in value_of:
        return
    pairs = [(value_of[0][line], -value_of[1][line]) for line in subject.lines if line in value_of[0] and line in value_of[1]]
    front = sorted({p for p in pairs if not any(q != p and q[0] <= p[0] and q[1] <= p[1] for q in set(pairs))})
    found = subject.json("pareto", "--least", measures[0], "--most", measures[1])["points"]
    key = "houses" if subject.houses else "plans"
    got = [(Fraction(p["values"][0]), -Fraction(p["values"][1]), int(p[key])) for p in found]
    same("pareto", sorted(got), [(*p, pairs.count(p)) for p in front])


def values_of_lines(subject, measure):
    values = subject.distribution(measure)
    if len(values) > 8:
        return None
    return {line: value for value, _ in values for line in subject.listed_where(equals(subject, measure, value))}


def questions_and_denials(subject):
    for rule in subject.rules()[:2]:
        yes, no = subject.where(rule), subject.where(f"not ({rule})")
        same("--where r + --where not r = count", yes + no, subject.total)


def written_by_name(subject):
    """A rule by its name, written out, and as a parameter of another."""
    for name in subject.rules()[-1:]:
        rule = subject.source.by_name[name]
        head = f" using {rule.using}" if rule.using else f" using {subject.using()}"
        body = rule.body()
        text = f"\nrule handed-on(handed){head} = handed\nrule written-out{head} = ({body})\n"
        if rule.using is None and len(subject.source.of("schema")) == 1 and not subject.source.of("form"):
            text = text.replace(head, "")
        more = numbers_of(name, body, head if head in text else "")
        file = subject.edited(text + more)
        if run("check", "--no-analysis", file)[0]:
            file = subject.edited(text)
            more = ""
        by_name = subject.where(name)
        same("--where written out = by name", subject.where("written-out", file), by_name)
        same("--where as a parameter = by name", subject.where(f"handed-on({name})", file), by_name)
        if more and subject.total:
            for kind in KINDS:
                same(f"{kind}, written out = by name", subject.distribution(f"out-{kind}", file), subject.distribution(f"named-{kind}", file))
            same("matches = --where", sum(n for v, n in subject.distribution("named-matches", file) if v), by_name)


KINDS = ("matches", "quantity", "occurrences")


def numbers_of(name, body, head):
    return "".join(f"measure out-{kind}{head} = {kind}({body})\nmeasure named-{kind}{head} = {kind}({name})\n" for kind in KINDS)


def ranks(subject):
    if not subject.total:
        return
    for rank in sorted({0, subject.total // 3, subject.total // 2, subject.total - 1}):
        line = subject.ask("unrank", str(rank)).rstrip("\n")
        if subject.lines is not None:
            same("unrank as enumerate", line, subject.lines[rank])
        if not subject.houses and line:
            same("rank of unrank", int(subject.ask("rank", line)), rank)
    same("unrank past the last is refused", run("unrank", subject.path, str(subject.total), *subject.options)[0], 1)


def samples(subject):
    if not subject.total:
        return
    number = min(5, subject.total)
    uniform = ["--uniform"] * subject.houses                     # by the weights of their plans no houses are drawn
    lines = subject.ask("sample", str(number), "--seed", "7", *uniform).split("\n")[:-1]
    same("sample, as many as asked", len(set(lines)), number)
    for line in lines:
        explained(subject, "a sample", line)
    if subject.lines is not None:
        same("samples are listed, in order", lines, [line for line in subject.lines if line in set(lines)])


def explained(subject, what, line, kept=True, *options):
    if not line:                                                # the plan without trays
        return
    code, out, err = run("explain", subject.path, line, "--json", *subject.options, *options)
    if code:
        raise Refused(err[:60], code == 4)
    same(f"{what} is kept, says explain", read_json("explain", out)["kept"], kept)


def explained_where(subject):
    """With a further requirement, `explain` keeps what is listed with it."""
    if not subject.lines:
        return
    for rule in subject.rules()[:1]:
        listed = set(subject.listed_where(rule))
        for line in sorted({*subject.lines[:2], *subject.lines[-2:], *sorted(listed)[:2]}):
            explained(subject, f"what is listed where {rule}", line, line in listed, "--where", rule)


def all_explained(subject):
    """What is listed is kept, says `prune` (of plans) or `explain` (of the first houses)."""
    if not subject.lines:
        return
    if subject.houses:
        for line in subject.lines[:3] + subject.lines[-3:]:
            explained(subject, "a house", line)
        return
    plans = subject.file("all.plans", "".join(line + "\n" for line in subject.lines if line))
    for engine in ("vm", "dfa"):
        try:
            kept = answer("prune", subject.path, plans, *subject.options, "--engine", engine)
        except Refused:
            continue
        same(f"prune --engine={engine} keeps what is listed", kept.split("\n")[:-1], [line for line in subject.lines if line])


def both_engines(subject):
    """`match` by both engines over all plans of the library, against `--where`."""
    if subject.houses or not subject.lines:
        return
    lines = [line for line in subject.lines if line]
    plans = subject.file("match.plans", "".join(line + "\n" for line in lines))
    for rule in subject.rules()[:2]:
        listed = set(subject.listed_where(rule))
        want = "".join("01"[line in listed] for line in lines)
        for engine in ("vm", "dfa"):
            try:
                got = answer("match", subject.path, plans, "--rule", rule, "--format", "bits", "--engine", engine)
            except Refused:
                continue
            same(f"match --engine={engine} as --where", got.replace("\n", ""), want)


def saved(subject):
    """Plans that are written in some format and read again."""
    if subject.houses or not subject.lines:
        return
    for ending in ("json", "csv", "sqlite", "bin"):
        path = os.path.join(subject.folder, "saved." + ending)
        shutil.rmtree(path, ignore_errors=True)
        subject.ask("enumerate", "--format", ending, "-o", path)
        read = answer("prune", subject.path, path, *subject.options).split("\n")[:-1]
        same(f"written as {ending} and read", read, subject.lines)
        os.unlink(path)


def mirrored(subject):
    if subject.houses or subject.lines is None:
        return
    rank = {line: i for i, line in enumerate(subject.lines)}
    half = [line for i, line in enumerate(subject.lines) if rank.get(backwards(line), len(rank)) >= i]
    same("enumerate --mirror", subject.ask("enumerate", "--mirror").split("\n")[:-1], half)
    same("count --mirror", int(subject.counts["mirror"]), len(half))


def backwards(line):
    return " | ".join(line.split(" | ")[::-1])


def clause_lines(subject):
    """(kind, line number) of the clauses that stand alone on their lines, or None where the library has others. `generate` is a requirement."""
    block = subject.source.by_name[subject.item.name].text
    begin = subject.source.text[:subject.source.text.index(block)].count("\n")
    found = [(m[1].replace("generate", "require"), begin + i) for i, line in enumerate(block.split("\n"))
             if (m := re.match(r"\s+(require|prune|generate)\b", line))]
    named = [r for r in subject.counts["requirements"] if not r["name"].startswith("total")] + subject.counts["rules"]
    return found if len(found) == len(named) and not subject.item.older else None


def effects(subject):
    """What each clause does, by files without it, and with it alone."""
    lines = None if subject.houses else clause_lines(subject)
    if not lines:
        return
    for kind, said, name in (("require", "keeps_out", "requirements"), ("prune", "prunes", "rules")):
        clauses = [c for c in subject.counts[name] if not c["name"].startswith("total")]
        for clause, (_, line) in zip(clauses, [l for l in lines if l[0] == kind]):
            without = without_line(subject, [line])
            if clause["only"] is not None:
                same("only by it", int(clause["only"]), count_kept(subject, without) - subject.total)
            others = [l for k, l in lines if l != line and (kind == "require" or k == "prune")] + (totals(subject) if kind == "require" else [])
            alone = read_json("count", subject.ask("count", "--json", "--no-effects", file=without_line(subject, others)))
            same(said, int(clause[said]), effect_alone(subject, kind, alone, others, line))


def effect_alone(subject, kind, alone, others, line):
    if kind == "prune":
        return int(alone["pruned"])
    return count_kept(subject, without_line(subject, others + [line])) - int(alone["kept"])


def totals(subject):
    block = subject.source.by_name[subject.item.name].text
    begin = subject.source.text[:subject.source.text.index(block)].count("\n")
    return [begin + i for i, line in enumerate(block.split("\n")) if re.match(r"\s+total\b", line)]


def without_line(subject, lines):
    """The file without these lines, and without its tests, which may name the clauses there."""
    text = re.sub(r"^test\b.*?^}", lambda test: "\n" * test[0].count("\n"), subject.source.text, flags=re.M | re.S)
    kept = [line for i, line in enumerate(text.split("\n")) if i not in lines]
    return subject.file("without.plan", "\n".join(kept))


def count_kept(subject, file):
    return how_many(read_json("count", subject.ask("count", "--json", "--no-effects", file=file)))


def compared(subject):
    """`diff` of the library with and without its last clause, by the lists of both."""
    other = subject.without_last()
    if not other:
        return
    file, old, new = other[0], set(subject.lines), set(other[1])
    found = read_json("diff", answer("diff", subject.path, file, "--json", "--no-measures", *subject.options))["total"]
    same("diff", [int(found[k]) for k in ("removed", "added", "kept")], [len(old - new), len(new - old), len(old & new)])


def tested(subject):
    """Tests that name houses: those whose expectations are right pass, and those whose expectations are wrong fail."""
    if not subject.houses or not subject.lines:
        return
    lines = [subject.lines[i] for i in sorted({0, len(subject.lines) // 2, len(subject.lines) - 1})]
    right = {subject.item.name: [f"keep [{line}]" for line in lines]}
    wrong = {subject.item.name: [f"drop [{line}]" for line in lines]}
    for rule in subject.rules()[:2]:
        listed = set(subject.listed_where(rule))
        words = [("match", "reject") if line in listed else ("reject", "match") for line in lines]
        right[rule], wrong[rule] = ([f"{pair[i]} [{line}]" for pair, line in zip(words, lines)] for i in (0, 1))
    for measure in subject.measures()[:2]:
        found = json_lines("best", subject.ask("best", "3", "--least", measure, "--format", "json"))
        values = [(b["house"], Fraction(b["value"] if "value" in b else b["values"][0])) for b in found]
        unit = unit_of(subject, measure)
        right[measure], wrong[measure] = ([f"value [{house}] = {number_of(value + more, unit)}" for house, value in values if value >= 0] for more in (0, 1))
    before = outcomes(subject.path)
    for what, tests, place in (("right", right, 0), ("wrong", wrong, 1)):
        tests = {name: cases for name, cases in tests.items() if cases}
        text = "".join(f"\ntest {name} {{\n" + "".join(f"  {case}\n" for case in cases) + "}\n" for name, cases in tests.items())
        same(f"tests of houses that are {what}", outcomes(subject.edited(text)), tuple(b + (i == place) * sum(map(len, tests.values()))
                                                                                       for i, b in enumerate(before)))


def outcomes(file):
    """(how many tests pass, how many fail)"""
    code, out, err = run("test", file, "--json")
    if not out:
        raise Refused(re.search(r"error\[(E\d+)\]", err)[1], code == 4)
    found = read_json("test --json", out)
    return found["passed"], found["failed"]


def limits(subject):
    """A limit ends with 4: what was written until then stays, in whole lines. What does not pass it is written as ever."""
    if subject.lines is None:
        return
    path = os.path.join(subject.folder, "limited.txt")
    for limit in (["--max-states", "3"], ["--memory-limit", "1"]):
        code = run("enumerate", subject.path, "-o", path, *limit, *subject.options)[0]
        same(f"{limit[0]} ends with 0 or 4", code in (0, 4), True)
        written = ""
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                written = file.read()
            os.unlink(path)
        whole = "".join(line + "\n" for line in subject.lines)
        same(f"{limit[0]} alters no answer", written if code == 0 else whole.startswith(written), whole if code == 0 else True)
        same(f"{limit[0]} leaves whole lines", written[-1:] in ("", "\n"), True)


QUICK = [counted_ways, by_length]              # asked of every library; of those that follow some are chosen
OF_FILES = [loads, file_questions.keeps_its_meaning, says_json]
OF_LIBRARIES = [by_measures, written_by_name, questions_and_denials, ranks, samples, all_explained, explained_where, both_engines, fronts, mirrored,
                effects, compared, threads, saved, limits, *OF_SEARCHED, prolog, regex, c_interface, c_ask, solids, swings, bills, tested, set_as_written]
