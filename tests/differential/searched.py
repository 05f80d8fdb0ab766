"""Where the automaton passes a limit, plans are found by search: every question that is answered so against the automaton's answer, or against the
list of all plans."""
import re

from program import Refused, answer, read_json, run, same

LISTED = 50              # plans are found by search
NEAR = 4
COMPLETED = 10           # that `complete` gives
COMPARED = 6             # that `diff` gives of each kind
LIMIT = ["--max-states", "1"]


def is_listed(subject):
    return not subject.houses and subject.lines is not None


def searched(subject):
    """The same plans in the same order; none, where there is none."""
    if not is_listed(subject):
        return
    first = subject.lines[:LISTED]
    same("enumerate by search", subject.ask("enumerate", *LIMIT, "--limit", str(LISTED)).split("\n")[:-1], first)
    drawn = subject.ask("sample", "20", "--uniform", *LIMIT).split("\n")[:-1]
    same("sample by search, in the library", set(drawn) <= set(subject.lines), True)
    same("sample by search, each once", len(set(drawn)), min(20, subject.total))


def best_searched(subject):
    """The best plans have the same values, in whatever order those of one value come."""
    for measure in subject.measures()[:2] if is_listed(subject) else []:
        for better in ("--most", "--least"):
            values = [[read_json("best", line)["value"] for line in subject.ask("best", "3", better, measure, "--format", "json", *limit).split("\n")[:-1]]
                      for limit in ([], LIMIT)]
            same(f"best {better} by search", values[1], values[0])


def front_searched(subject):
    """The same values, and the first plan of each."""
    measures = subject.measures()[:3]
    if len(measures) < 2 or not is_listed(subject):
        return
    wishes = [word for measure, end in zip(measures, ("--least", "--most", "--most")) for word in (end, measure)]
    exact, found = (subject.json("pareto", *wishes, *limit) for limit in ([], LIMIT))
    if "proven" not in found:                                    # no limit was passed
        return
    same("pareto by search is proven", found["proven"], True)
    same("pareto by search", [(p["values"], p["plan"]) for p in found["points"]], [(p["values"], p["plan"]) for p in exact["points"]])


def trays_of(line):
    return line.split(" | ") if line else []


def dropped(subject):
    """Plans that are none of the library's, of its trays."""
    trays = sorted({tray for line in subject.lines[:200] for tray in trays_of(line)})
    if not trays:
        return []
    some = [trays_of(subject.lines[i]) for i in sorted({0, len(subject.lines) // 2, len(subject.lines) - 1})]
    made = [line + [trays[0]] for line in some] + [line[:-1] + [trays[-1]] for line in some] + [line[::-1] for line in some] + [trays[:5]]
    kept = set(subject.lines)
    return [line for line in dict.fromkeys(" | ".join(plan) for plan in made if plan) if line not in kept]


def near_searched(subject):
    """The nearest kept plans of plans that are dropped."""
    for line in dropped(subject)[:3] if is_listed(subject) and subject.lines else []:
        answers = []
        for limit in ([], LIMIT):
            code, out, err = run("explain", subject.path, line, "--json", "--nearest", str(NEAR), *limit, *subject.options)
            if code:
                raise Refused(err[:60], code == 4)
            if "nearest plans are not known" in err:             # a clause can neither be an automaton nor gates
                return
            found = read_json("explain", out)
            answers.append((found["distance"], found["more"], [(near["plan"], near["changes"]) for near in found["nearest"]]))
        same(f"nearest of {line} by search", answers[1], answers[0])


def fits(pattern, trays):
    """Do the parts of an open plan stand for these trays?"""
    if not pattern:
        return not trays
    if pattern[0] == "...":
        return any(fits(pattern[1:], trays[i:]) for i in range(len(trays) + 1))
    return bool(trays) and meets(pattern[0], trays[0]) and fits(pattern[1:], trays[1:])


def meets(part, tray):
    """`?` is any tray, and `-` of a flag any value of it."""
    return part == "?" or all(written in ("-", value) for written, value in zip(part.split(" "), tray.split(" ")))


def as_open(part):
    """A tray as open plans have it: flags are set, or not written, and depths stand behind their fills."""
    return " ".join(value.replace(":", " ") for value in part.split(" ") if value != "-") or "?"


def opened(subject):
    """Open plans, of which some stand for plans of the library."""
    line = trays_of(subject.lines[len(subject.lines) // 2])
    other = trays_of(subject.lines[-1])
    patterns = [line[:1] + ["..."], ["..."] + other[-1:], ["?"] * (len(line) - 1) + other[-1:], line[:1] + ["..."] + other[-1:] + ["?"], line[:-1] + ["...", "?"],
                line + line[-1:], line[:2] + other[:1], ["..."] + line[:1] + line[:1] + ["..."]]
    return [pattern for pattern in patterns if any(part not in ("?", "...") for part in pattern)]


def completed_searched(subject):
    """The first plans that complete an open plan, by the list; and if there is none, the tray that leaves none."""
    for pattern in opened(subject) if is_listed(subject) and subject.lines and subject.lines[-1] else []:
        text = " | ".join(map(as_open, pattern))
        try:
            found = subject.json("complete", text, *LIMIT)
        except Refused as refused:
            if refused.limit:
                raise
            continue                                             # two fields have the same values: it is not clear whose they are
        if "first" not in found:                                 # no limit was passed
            return
        want = [line for line in subject.lines if fits(pattern, trays_of(line))]
        exact = subject.json("complete", text)
        plans = int(exact["plans"])
        same(f"how many complete {text}, by search", (len(found["first"]), found["more"]), (min(plans, COMPLETED), plans > COMPLETED))
        if plans == len(want):                                   # else two fields share a value, and it was read as the other's
            same(f"complete {text} by search", found["first"], want[:COMPLETED])
        if not plans:
            same(f"why nothing completes {text}, by search", leaves_none(found["why_none"]), leaves_none(exact["why_none"]))


def leaves_none(why):
    """Which tray does, or what else it is."""
    tray = re.search(r"(?:before tray|has tray) (\d+)", why.split("\n")[0])
    return int(tray[1]) if tray else "`| ...` at the end" in why


def compared_searched(subject):
    """`diff` of the library with and without its last clause, by the lists of both."""
    other = subject.without_last() if is_listed(subject) else None
    if not other:
        return
    file, new = other
    found = read_json("diff", answer("diff", subject.path, file, "--json", "--sample", str(COMPARED - 1), *LIMIT, *subject.options))
    if "removed" not in found:                                   # no limit was passed
        return
    for kind, here, there in (("removed", subject.lines, set(new)), ("added", new, set(subject.lines))):
        only = [line for line in here if line not in there]
        same(f"{kind} by search", (found[kind]["plans"], found[kind]["more"]), (only[:COMPARED], len(only) > COMPARED))


OF_SEARCHED = [searched, best_searched, front_searched, near_searched, completed_searched, compared_searched]
