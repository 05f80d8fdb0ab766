#!/usr/bin/env python3
"""Writes a file of so many random rules, and a library that prunes with all of them and one that does not prune.

usage: many_rules.py RULES SEED TRAYS
"""
import random
import sys

count, seed, trays = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
chance = random.Random(seed)
FIELDS = [["4'", "8'", "12'"], ["single", "double"], ["public", "not public"], ["bay open", "bay empty", "bay dense"]]


def tray():
    """A specifier of one field at least, so that no rule prunes everything."""
    items = [chance.choice(values) for values in FIELDS if chance.random() < 0.6]
    return "tray(%s)" % ", ".join(items or [chance.choice(FIELDS[0])])


def rule():
    kind = chance.randrange(5)
    if kind == 0:
        return "neighbour(%s, %s)" % (tray(), tray())
    if kind == 1:
        return "quantity(%s, n > %d)" % (tray(), chance.randint(2, 4))
    if kind == 2:
        return "neighbour(%s, many(%s), %s)" % (tray(), tray(), tray())
    if kind == 3:
        distance = "distance(from %s, to %s, by quantity(%s, n >= %d))"
        return distance % (tray(), tray(), tray(), chance.randint(1, 2)) + " and %s and %s" % (tray(), tray())
    return "%s and %s and quantity(%s, n = %d)" % (tray(), tray(), tray(), chance.randint(1, 3))


print("""schema row {
  width  = 4' | 8' | 12'
  height = single | double
  public = flag
  zone bay = open | empty | dense
}""")
names = ["r%d" % i for i in range(count)]
for name in names:
    print("rule %s = %s" % (name, rule()))
print("library pruned using row { trays %s prune %s }" % (trays, ", ".join(names)))
print("library whole using row { trays %s }" % trays)
