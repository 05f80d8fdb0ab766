"""Rules in other notations, run by the programs that read these: they decide about plans as `match` does."""
import itertools
import re
import shutil
import subprocess
from fractions import Fraction

from program import Refused, Wrong, answer, environment, json_lines, same

PLANS = 150              # no more of a library's plans are asked of a Prolog program
WORDS = 300              # and no more texts of a regular expression


def bits(subject, rule, lines):
    """A list of 0 and 1: does the rule match the plan?"""
    plans = subject.file("decided.plans", "".join(line + "\n" for line in lines))
    return answer("match", subject.path, plans, "--rule", rule, "--format", "bits", "--engine", "vm").split()


# ---- Prolog

def prolog(subject):
    """Rules and the library as a Prolog program, where SWI-Prolog is installed."""
    if subject.houses or not subject.lines or not shutil.which("swipl"):
        return
    try:
        program = answer("export", subject.path, "--prolog", *subject.options)
    except Refused as refused:
        if str(refused) == "E0607":              # no rule of the file can be said in Prolog
            return
        raise
    lines = [line for line in subject.lines if line][:PLANS]
    rules = [rule for rule in subject.rules() if f"rule_part({atom(rule)}," in program]
    kept = f"trays_of({atom(subject.item.name)}," in program
    preferred = kept and f"preference({atom(subject.item.name)}," in program
    decided = consulted(subject, program, rules, lines, kept)
    if preferred and lines:
        same("plan_preference as best", worths(subject, program, lines), preferences(subject)[:len(lines)])
    for i, rule in enumerate(rules if lines else []):
        same("Prolog as match", [bit[i] for bit in decided], bits(subject, rule, lines))
    if kept:
        same("Prolog keeps what is listed", {bit[-1] for bit in decided}, {"1"} if lines else set())


def consulted(subject, program, rules, lines, kept):
    """A text for each plan: 0 or 1 for each rule, then for the library."""
    goals = [f"match_plan({atom(rule)}, P)" for rule in rules] + [f"keep_plan({atom(subject.item.name)}, P)"] * kept
    decide = "".join(f", ( {goal} -> write(1) ; write(0) )" for goal in goals)
    plans = "".join(f"plan({i}, {term(line)}).\n" for i, line in enumerate(lines)) or "plan(_, _) :- fail.\n"
    path = subject.file("rules.pl", program)
    run = subject.file("run.pl", f"{plans}run :- forall(plan(_, P), (true{decide}, nl)).\n")
    done = subprocess.run(["swipl", "-q", "-f", path, "-l", run, "-g", "run", "-g", "halt"], capture_output=True, text=True, encoding="utf-8", timeout=120,
                          env=environment())
    same("SWI-Prolog says nothing", (done.returncode, done.stderr[:300]), (0, ""))
    return done.stdout.splitlines()


def worths(subject, program, lines):
    """What the preferences that each plan meets are worth together, by the program."""
    plans = "".join(f"plan({i}, {term(line)}).\n" for i, line in enumerate(lines))
    run = subject.file("run.pl", f"{plans}run :- forall(plan(_, W), ( plan_preference({atom(subject.item.name)}, W, P, Q), write(P/Q), nl )).\n")
    done = subprocess.run(["swipl", "-q", "-f", subject.file("rules.pl", program), "-l", run, "-g", "run", "-g", "halt"], capture_output=True,
                          text=True, encoding="utf-8", timeout=120, env=environment())
    same("SWI-Prolog says nothing", (done.returncode, done.stderr[:300]), (0, ""))
    return [Fraction(line) for line in done.stdout.splitlines()]


def preferences(subject):
    """The same by `best`, in the order of ranks, without the plan that has no trays."""
    best = json_lines("best", subject.ask("best", str(subject.total), "--format", "json"))
    value = {int(b["rank"]): Fraction(b["value"]) for b in best}
    return [value[rank] for rank, line in enumerate(subject.lines) if line]


def term(line):
    trays = [", ".join(map(atom, tray.split())) for tray in line.split(" | ")]
    return "[" + ", ".join(f"tray({values})" for values in trays) + "]"


def atom(text):
    return "'" + text.replace("'", "''") + "'"


# ---- regular expressions

def regex(subject):
    """Every rule as a regular expression over a letter for each kind of tray, on all short texts."""
    for rule in subject.rules()[-1:] if not subject.houses else []:
        said = answer("export", subject.path, "--regex", "--rule", rule).splitlines()
        trays = dict(found.groups() for found in (re.match(r"# (\S)  \d+ trays?, such as ([^;]*)", line) for line in said) if found)
        pattern = re.compile(said[-1]) if not said[-1].startswith("#") else None
        texts = list(itertools.islice(short_texts(sorted(trays)), WORDS))
        got = [str(int(bool(pattern and pattern.search(text)))) for text in texts]
        want = bits(subject, rule, [" | ".join(trays[letter] for letter in text) for text in texts])
        differ = [(text, one, other) for text, one, other in zip(texts, got, want) if one != other]
        if differ or len(got) != len(want):
            raise Wrong("regular expression as match", f"{said[-1]} on {differ[:3]}", "as match")


def short_texts(letters):
    for length in range(1, 7):
        yield from map("".join, itertools.product(letters, repeat=length))
