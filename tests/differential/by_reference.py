"""Questions whose answers the brute force of reference.py works out from the file's derivation tree."""
import random
import re
from collections import Counter
from fractions import Fraction

from circles import bodies, faults
from maker import Maker
from program import Refused, answer, json_lines, read_json, run, same
from plan_questions import how_many, number_of, outcomes
from reference import INFINITE, UNITS, File, Unknown, of_rules
from tree import Text, find_all, wrapped

MATCHED = 300            # no more plans than this are asked by both engines


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
    answered(lambda: generated_by_reference(subject, file, kept))
    answered(lambda: ways_by_reference(subject, file, kept))
    answered(lambda: projected_by_reference(subject, file, kept))
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
    want = sum(plan.meets(rule) for plan in kept)
    same("--where", subject.where(rule), want)
    lined = lines_of_all(subject, file)
    lined = [(line, plan) for line, plan in lined if line][::len(lined) // MATCHED + 1]
    matched = "".join("01"[plan.meets(rule)] for _, plan in lined)
    plans = subject.file("every.plans", "".join(line + "\n" for line, _ in lined))
    for engine in ("vm", "dfa") if lined else ():
        try:
            got = answer("match", subject.path, plans, "--rule", rule, "--format", "bits", "--engine", engine)
        except Refused:
            if engine == "vm":
                raise
            continue
        same(f"match --engine={engine}", got.replace("\n", ""), matched)


def lines_of_all(subject, file):
    """(line, plan) of all plans of the library's lengths, whatever it keeps. They are listed in the order in which the reference makes them."""
    lengths = file.lengths(subject.item.name)
    every = subject.edited(f"\nlibrary every-plan using {subject.using()} {{\n  trays {lengths[0]}..{lengths[-1]}\n}}\n")
    lines = answer("enumerate", every, "--library", "every-plan").split("\n")[:-1]
    return list(zip(lines, file.plans(subject.item.name), strict=True))


def generated_by_reference(subject, file, kept):
    """What `explain` says of plans that a library generates, and of others: how far these go along with plans that it generates."""
    clause = file.generate(subject.item.name)
    if clause is None:
        return
    lined = lines_of_all(subject, file)
    generated = {plan.trays for _, plan in lined if file.generates(plan, clause)}
    starts = {trays[:n] for trays in generated for n in range(len(trays) + 1)}
    tray_lines = {plan.trays[0]: line for line, plan in lined if plan.n == 1}
    those = {plan.trays for plan in kept}
    chosen, dropped = random.Random(subject.text), []
    for group in ([p for p in lined if p[0] and p[1].trays in generated], [p for p in lined if p[0] and p[1].trays not in generated]):
        for line, plan in chosen.sample(group, min(len(group), 4)):
            explained = subject.json("explain", line)
            said = next(c for c in explained["clauses"] if c["kind"] == "generate")
            made = plan.trays in generated
            same("explain keeps", explained["kept"], plan.trays in those)
            same("explain says whether it is generated", (said["matches"], said["drops"]), (made, not made))
            same("explain says in how many ways", said.get("ways"), str(file.ways(plan, subject.item.name)) if made else None)
            if not made:
                dropped.append((line, said["name"]))
            if "beginning" in said:
                n = max((n for n in range(plan.n + 1) if plan.trays[:n] in starts), default=0)
                then = {trays[n] for trays in starts if len(trays) == n + 1 and trays[:n] == plan.trays[:n]}
                beginning = said["beginning"]
                same("how far it goes", (beginning["trays"], beginning["may_end"], beginning["follows"]), (n, plan.trays[:n] in generated, len(then)))
                if all(t in tray_lines for t in then):
                    same("what may follow", set(beginning["then"]), {tray_lines[t] for t in then})
            else:
                same("explain says how far a plan goes, if it is not generated and others are", made or not generated, True)
    tests = "".join(f"  drop [{line}] by {name}\n" for line, name in dropped)
    tested = subject.edited(f"\ntest {subject.item.name} {{\n{tests}}}\n")
    if run("check", "--no-analysis", tested)[0] == 0:           # else a plan line is none in a test
        passed, failed = outcomes(subject.path)
        same("dropped by what generates", outcomes(tested), (passed + len(dropped), failed))


def ways_by_reference(subject, file, kept):
    """In how many ways plans are derived: of all of them, and of some."""
    numbers = [file.ways(plan, subject.item.name) for plan in kept]
    found = subject.json("count", "--ways")
    most = max(numbers, default=None)
    same("ways", (int(found["plans"]), int(found["ways"])), (len(kept), sum(numbers)))
    same("mean of ways", found["mean"] and Fraction(found["mean"]), Fraction(sum(numbers), len(kept)) if kept else None)
    if found["distribution"] is not None:
        same("plans by their ways", [[int(n) for n in row] for row in found["distribution"]], [list(row) for row in sorted(Counter(numbers).items())])
        same("most ways", found["most"], most and str(most))
    listed = [line.split("\t") for line in answer("enumerate", subject.path, "--library", subject.item.name, "--ways", "--limit", "200").splitlines()]
    same("ways of each plan", [int(line[0]) for line in listed], numbers[:200])
    if kept and found["first"] is not None and most in numbers[:200]:
        same("first plan with the most ways", found["first"], listed[numbers.index(most)][1])


def projected_by_reference(subject, file, kept):
    """What `explain` says of plans of a library that is projected, and of others."""
    if not file.projection(subject.item.name):
        return
    above, fields = file.projection(subject.item.name)
    lined, those = lines_of_all(subject, file), {plan.trays for plan in kept}
    chosen = random.Random(subject.text)
    for line, plan in chosen.sample(lined, min(len(lined), 6)):
        if line:
            explained = subject.json("explain", line)
            said = next(c for c in explained["clauses"] if c["kind"] == "onto")
            lies = file.images_above(plan, above, fields, file.lengths(subject.item.name)) > 0
            same("explain keeps", explained["kept"], plan.trays in those)
            same("explain says whether a plan lies above", (said["name"], said["matches"], said["drops"], "above" in said), (above, lies, not lies, lies))


def circles_by_reference(kind):
    def circles_by_reference(subject):
        """No rule of an accepted file uses itself as it may not; and of further rules that do, those are refused that may not."""
        if subject.tree is None:
            return
        same("circles of rules that are accepted", {wrong for wrong in faults(of_rules(find_all(subject.tree, "item"))).values() if wrong}, set())
        schemas = subject.source.of("schema")
        if not schemas:
            return
        maker = Maker(kind.grammar, kind.notation, random.Random(subject.text))
        for _ in range(4):
            names = [f"circle-{n}" for n in range(maker.random.choice([1, 1, 2, 3]))]
            made = bodies(maker, lambda: leaf(maker), names, .7)
            heads = "".join(f"\nrule {name} using {schemas[0].name} = {Text(body, {}).text}" for name, body in made)
            wrong = {min(circle): what for circle, what in faults({name: ([], body) for name, body in made}).items()}
            code, _, err = run("check", subject.edited(heads), "--no-analysis", "--diagnostics=json")
            found = [d for d in read_json("check --diagnostics=json", err or "[]") if d["severity"] == "error"]
            same("circles that are refused", (heads, {d["code"] for d in found}, len(found)),
                 (heads, {"E0406"} if any(wrong.values()) else set(), sum(map(bool, wrong.values()))))
    return circles_by_reference


def leaf(maker):
    """A question that knows no names."""
    node = maker.node("primary: ANY")
    if maker.chance(.3):
        node = maker.node("primary: MANY OPEN expression CLOSE", wrapped(maker.grammar, "expression", node))
    return wrapped(maker.grammar, "expression", node)


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
