#!/usr/bin/env python3
"""Prints a form with roofs of every kind at random: house_roofs.py SEED. Eaves, roofs open to their ridge and ridges across the row are
combined with odd slopes, walls and bands, in a body with a bay before it and a shed behind it."""
import random
import sys

chance = random.Random(int(sys.argv[1]))


def inches(low, high):
    return f'{chance.randint(low, high)} {chance.choice(["1/4", "1/2", "3/4"])}"'


def roof():
    kind = chance.choice(("flat", "gable", "vault", "shed", "hip", "cross-gable"))
    slope = f"{chance.randint(1, 7)}:{chance.randint(8, 15)}"
    said = {"flat": [], "gable": [slope], "hip": [slope], "cross-gable": [slope], "vault": [inches(9, 40)], "shed": [chance.choice(("back", "front")), slope]}[kind]
    if chance.random() < 0.7:
        said.append("eaves " + inches(1, 20))
    if chance.random() < 0.5 and kind != "hip":
        said.append("open")
    if kind in ("gable", "vault") and chance.random() < 0.5:
        said.append("across")
    return f'{kind}({", ".join(said)})' if said else kind


def roofs(zone):
    return f"  option {zone} roof = {' | '.join(sorted({roof() for _ in range(4)}))}"


print(f"""schema row {{
  width role length = {chance.randint(9, 10)}' | {chance.randint(11, 15)}'
  zone shed role band = none role absent | open({chance.randint(5, 8)}')
  zone body role band = room({chance.randint(10, 13)}', {chance.randint(14, 18)}')
  zone bay role band = none role absent | room({chance.randint(4, 7)}')
}}
form roofed of row {{
  storey ground {chance.randint(8, 10)}'
  storey loft {chance.randint(7, 9)}'
  spine body
  wall {chance.randint(2, 6) * 2}"
  partition {chance.randint(1, 3) * 2}"
  floor {inches(6, 11)}
  roof {inches(3, 11)}
  option body storeys = 1 | 2
  option shed storeys = 1
  option bay storeys = 1
{roofs("shed")}
{roofs("body")}
{roofs("bay")}
  function den at cell(any)
  void cell(body, loft)
  opening sash wide 2' high 3' sill 2'
  face cell(den) outside = sash | wall
}}
library rows using row {{ trays 1..4 }}
library all from rows in roofed {{ }}""")
