#!/usr/bin/env python3
"""Openings behind lower roofs, in small forms drawn at random: house_lower_forms.py TARTAN ORACLES FORMS

Lists all houses, in order, with the slow reference and its rule about lower roofs, and holds them against tartan: its list, and its count,
which it makes without a list. At least one form has to have other houses than without the rule. The forms have the older words `section` and `deck`, which the
reference knows."""
import json
import os
import random
import subprocess
import sys
import tempfile

import house_lower_roofs

tartan, reference, forms = sys.argv[1], house_lower_roofs.use(sys.argv[2]), int(sys.argv[3])


def form(seed):
    chance = random.Random(seed)
    slope = lambda: f"{chance.randint(1, 9)}:12"
    kinds = [lambda: "flat", lambda: f"shed(back, {slope()})", lambda: f"shed(front, {slope()})", lambda: f"gable({slope()})", lambda: f'vault({chance.randint(6, 40)}")']
    roofs = lambda: " | ".join(kind() for kind in chance.sample(kinds, 2))
    return f'''schema row {{
  width role length = {chance.choice((7, 9))}'
  zone shed role band = none role absent | open({chance.randint(5, 8)}')
  zone body role band = room({chance.randint(9, 12)}', {chance.randint(13, 16)}')
  zone bay role band = none role absent | room({chance.randint(4, 7)}')
}}
form roofed of row {{
  storey ground 9'
  storey loft 8'
  spine body
  wall {chance.choice((4, 6, 8))}" partition 4" deck 10" roof {chance.randint(3, 9)}"
  section body storeys = 2
  section shed storeys = {chance.choice(("1", "1 | 2"))}
  section bay storeys = 1
  section shed roof = {roofs()}
  section bay roof = {roofs()}
  function den at cell(any)
  opening sash wide 3' high {chance.randint(2, 3)}' sill {chance.randint(1, 3)}'
  opening slot wide {chance.choice((1, 2, 4))}' high 1' sill {chance.choice((42, 50, 58))}"
  opening gate wide 2' high 6'
  face cell(any, ground) outside = wall
  face cell(den) outside left = sash | wall
  face cell(den) outside right = slot
  face cell(body) outside = {chance.choice(("sash | slot", "gate | slot", "sash"))}
  face cell(den) outside = sash
}}
library rows using row {{ trays 1..2 }}
library all from rows in roofed {{ prune touch(cell(shed), cell(bay)) }}
'''


def run(*words):
    done = subprocess.run([tartan, *words], capture_output=True, text=True)
    return done.stdout if done.returncode == 0 else "failed: " + done.stderr


def listed(path):
    parsed = reference.parse(path)
    library = reference.pick(parsed)
    unit = reference.unit_of(parsed.forms[library.form].schema)
    return [reference.show(house, options, [], unit) for house, options, _ in reference.houses(parsed, library)]


def main():
    os.chdir(tempfile.mkdtemp())
    failures, changed, total = [], 0, 0
    for seed in range(1, forms + 1):
        with open("form.plan", "w") as file:
            file.write(form(seed))
        wanted = listed("form.plan")
        got = run("enumerate", "form.plan", "--library", "all").splitlines()
        if got != wanted:
            first = next((f"{a}, not {b}" for a, b in zip(got, wanted) if a != b), f"{len(got)}, not {len(wanted)} houses")
            failures.append(f"form {seed}: {first}")
        counted = run("count", "form.plan", "--library", "all", "--json")
        if json.loads(counted)["houses"] != str(len(wanted)):
            failures.append(f"form {seed}: {counted} houses, not {len(wanted)}")
        reference.face_options = house_lower_roofs.plain_options
        changed += listed("form.plan") != wanted
        reference.face_options = house_lower_roofs.options
        total += len(wanted)
    if not changed:
        failures.append("no form has an opening behind a lower roof")
    print(f"{total} houses of {forms} forms, {changed} with openings behind lower roofs, {len(failures)} differ")
    print("\n".join(failure[:600] for failure in failures[:6]))
    sys.exit(bool(failures))


main()
