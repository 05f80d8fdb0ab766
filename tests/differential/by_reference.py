"""Questions whose answers the brute force of reference.py works out from the file's derivation tree."""
import re
from collections import Counter
from fractions import Fraction

from program import Refused, json_lines, run, same
from plan_questions import how_many, number_of
from reference import INFINITE, UNITS, File, Unknown


def plans_by_reference(subject):
    """Counts, measures and rules of a library of plans."""
    if subject.tree is None or subject.houses:
        return
    try:
        file = File(subject.tree, subject.source.about(subject.item)[0])
        kept = file.kept(subject.item.name)
    except Unknown:
        return
    same("count", how_many(subject.counts), len(kept))
    lengths = Counter(plan.n for plan in kept)
    same("count by length", {d["length"]: int(d["kept"]) for d in subject.counts["by_length"] if int(d["kept"])}, dict(lengths))
    answered(lambda: weights_by_reference(subject, file, kept))
    answered(lambda: preferences_by_reference(subject, file, kept))
    for rule in subject.rules():
        answered(lambda: rule_by_reference(subject, file, kept, rule))
    for measure in subject.measures() if kept else []:
        answered(lambda: measure_by_reference(subject, file, kept, measure))


def answered(ask):
    """What the reference does not know, or the program refuses for a limit, is no difference."""
    try:
        ask()
    except Unknown:
        pass
    except Refused as refused:
        if not refused.limit:
            raise


def rule_by_reference(subject, file, kept, rule):
    want = sum(plan.holds(file.rule(rule)[1]) for plan in kept)
    same("--where", subject.where(rule), want)


def preferences_by_reference(subject, file, kept):
    """The measure `preference`: how plans are spread over it, which are the best by it, what `explain` says of one, and how many have as much."""
    if not file.preferences(subject.item.name) or not kept:
        return
    values = [file.preference(plan, subject.item.name) for plan in kept]
    same("--by preference", [(v, n) for v, n in subject.distribution("preference")], sorted(Counter(values).items()))
    best = json_lines("best", subject.ask("best", "3", "--format", "json"))
    same("best without a measure", [Fraction(b["value"]) for b in best], sorted(values, reverse=True)[:3])
    if subject.lines is not None:
        same("the best have these values", [values[int(b["rank"])] for b in best], [Fraction(b["value"]) for b in best])
        for rank in {0, len(values) // 2}:
            if subject.lines[rank]:
                explained = subject.json("explain", subject.lines[rank])
                same("explain says the preference", Fraction(explained["preference"]), values[rank])
                met = sum(Fraction(p["worth"]) for p in explained["preferences"] if p["met"])
                same("explain adds up what is met", met, values[rank])
    least = sorted(values)[len(values) // 2]
    same("--where preference", subject.where(f"preference >= {number_of(least, '')}"), sum(v >= least for v in values))


def weights_by_reference(subject, file, kept):
    """What all weights add up to, as a sample says it; and a sample of all plans but one."""
    if not any(c.production.symbols[0] == "weight_word" for c in file.clauses(subject.item.name)) or not kept:
        return
    code, out, err = run("sample", subject.path, str(max(len(kept) - 1, 1)), *subject.options)
    said = re.search(r"those of all plans add up to ([0-9,./-]+);", err)
    if code or not said:
        raise Refused(re.search(r"error\[(E\d+)\]", err + "error[E0]")[1], code == 4)
    same("the weights of all plans", Fraction(said[1].replace(",", "")), sum(file.weight(plan, subject.item.name) for plan in kept))
    same("plans drawn by weight", len(set(out.split("\n")[:-1])), max(len(kept) - 1, 1))


def measure_by_reference(subject, file, kept, measure):
    want = Counter(plan.value(file.sum(measure)) for plan in kept)
    none = sum(want.pop(value, 0) for value in (None, INFINITE, -INFINITE))
    found = subject.json("count", "--by", measure)
    unit = UNITS.get(found["unit"].strip("/").rstrip("23"), Fraction(1)) ** found["dimension"]
    same("--by", [(Fraction(d["value"]) * unit, int(d["plans"])) for d in found["distribution"]], sorted(want.items()))
    same("plans without a value", int(found.get("none", 0)), none)
