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
    line = [(Fraction(y), Fraction(z)) for y, z in roof["profile"]]
    low, high = roof["x"] if "x" in roof else roof["y"]
    slab = roof.get("slab")
    under = [(y, z - slab) for y, z in line] if slab else [(line[0][0], roof["base"]), (line[-1][0], roof["base"])]
    ring = ",".join(f"[{mm(y)},{mm(z)}]" for y, z in under + line[::-1])
    turn = "multmatrix([[0,0,1,0],[1,0,0,0],[0,1,0,0],[0,0,0,1]])" if "x" in roof else "multmatrix([[1,0,0,0],[0,0,1,0],[0,1,0,0],[0,0,0,1]])"
    print(f"{turn} translate([0,0,{mm(low)}]) linear_extrude(height={mm(high - low)}) polygon([{ring}]);")
print("}")
