#!/usr/bin/env python3
"""The solids of a house as a union for OpenSCAD, in millimetres: house_scad.py HOUSE.json >HOUSE.scad"""
import json
import sys
from fractions import Fraction

house = json.load(open(sys.argv[1]))
mm = lambda n: f"{float(Fraction(n) / 10**6):.9f}"
print("union() {")
for solid in house["solids"]:
    x0, x1, y0, y1, z0, z1 = solid["box"]
    print(f"translate([{mm(x0)},{mm(y0)},{mm(z0)}]) cube([{mm(x1 - x0)},{mm(y1 - y0)},{mm(z1 - z0)}]);")
for roof in house["roofs"]:
    corners = roof["corners"]
    count = len(corners)
    points = ",".join(f"[{mm(x)},{mm(y)},{mm(z)}]" for k in (2, 3) for x, y, z in ((c[0], c[1], c[k]) for c in corners))
    sides = [[i, count + i, count + (i + 1) % count, (i + 1) % count] for i in range(count)]  # clockwise from outside
    print(f"polyhedron([{points}], {sides + [list(range(count)), list(range(2 * count - 1, count - 1, -1))]});")
print("}")
