#!/usr/bin/env bash
# The terms of goals against a program of their definitions, which shares nothing with the engine but the mesh file.
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
here=$(cd "$(dirname "$0")" && pwd)
cd "$work"
printf 'o hull\nv -1 -1 1\nv 2 -1 1.5\nv 2 2 2\nv -1 2 0.5\nf 1 2 3\nf 1 3 4\n' > hull.obj
for rules in ruffle square triangle alternate apical timed context; do
  for steps in 1 2 3 4; do
    printf 'rules "%s"\nsteps %s\ngravity 0.02 0.01 0.1\nattractor at 0.4 0.2 3 strength 0.6\nsun 1 -0.5 0.4\ndistance-to "hull.obj"\nfitness height target 1\nrequire area >= 0\n' \
      "$rules" "$steps" > "$rules-$steps.study"
    "$TARTAN" grow "$rules-$steps.study" -o "$rules-$steps.obj" --stats json > "$rules-$steps.json" 2> err.txt ||
      { echo "terms: $rules after $steps steps does not grow: $(cat err.txt)" >&2; exit 1; }
  done
done
python3 "$here/../terms.py" hull.obj ./*-?.json

# a goal that has the name of a term hides it where goals are listed; expressions are over the terms
printf 'rules "ruffle"\nsteps 3\nfitness area = 7 target 7\nfitness twice = area * 2 target 0\n' > named.study
"$TARTAN" grow named.study --stats json -o named.obj > named.json || exit 1
python3 - <<'Y' || { echo "terms: a goal does not hide the term of its name: $(tail -n 1 named.json)" >&2; exit 1; }
import json
last = json.load(open("named.json"))[-1]
goals = last["fitness"]
assert goals["area"] == 7 and goals["twice"] == 2 * last["measures"]["area"] != 14, goals
Y
