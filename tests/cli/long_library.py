#!/usr/bin/env python3
"""A library of many rules that leaves plans: long_library.py [--count] RULES SEED TRAYS WIDTHS USES GAPS QUANTITIES

Writes the file of rules. With --count it writes how many plans of 1 to TRAYS trays no rule matches, one length a line, by
trying all of them."""
import itertools
import random
import sys

counting = sys.argv[1] == "--count"
rules, seed, trays, widths, uses, gaps, quantities = (int(word) for word in sys.argv[-7:])
chance = random.Random(seed)
fields = [("width", ["%dm" % (i + 2) for i in range(widths)]), ("use", ["use-%d" % i for i in range(uses)]), ("height", ["single", "double"])]
everything = list(itertools.product(*(values for _, values in fields)))


def specifier():
    """Some values of a tray, and the trays that have them."""
    chosen = chance.sample([chance.choice(values) for _, values in fields], chance.choice([2, 3, 3]))
    return "tray(%s)" % ", ".join(chosen), {number for number, tray in enumerate(everything) if set(chosen) <= set(tray)}


def rule(i):
    """The text of a rule, and whether it matches a plan."""
    (a, first), (b, second), (c, third) = specifier(), specifier(), specifier()
    if i < quantities:
        most = chance.choice([1, 2])
        return "quantity(%s, n > %d)" % (a, most), lambda plan: sum(tray in first for tray in plan) > most
    if i < quantities + gaps:
        return "neighbour(%s, any, %s)" % (a, b), lambda plan: any(p in first and q in second for p, q in zip(plan, plan[2:]))
    kind = i % 4
    if kind == 0:
        return "neighbour(beginning, %s, %s)" % (a, b), lambda plan: len(plan) > 1 and plan[0] in first and plan[1] in second
    if kind == 1:
        return "neighbour(%s, %s, end)" % (a, b), lambda plan: len(plan) > 1 and plan[-2] in first and plan[-1] in second
    if kind == 2:
        return ("neighbour(%s, %s, %s)" % (a, b, c),
                lambda plan: any(p in first and q in second and r in third for p, q, r in zip(plan, plan[1:], plan[2:])))
    return "neighbour(%s, %s)" % (a, b), lambda plan: any(p in first and q in second for p, q in zip(plan, plan[1:]))


made = [rule(i) for i in range(rules)]
if counting:
    for length in range(1, trays + 1):
        plans = itertools.product(range(len(everything)), repeat=length)
        print(sum(not any(matches(plan) for _, matches in made) for plan in plans))
else:
    print("schema block { %s }" % "  ".join("%s = %s" % (name, " | ".join(values)) for name, values in fields))
    for i, (text, _) in enumerate(made):
        print("rule r%d = %s" % (i, text))
    print("library blocks { trays 1..%d  %s }" % (trays, "  ".join("prune r%d" % i for i in range(rules))))
