#!/usr/bin/env bash
# Needs the parts: mesh
# Forms drawn at random against a brute force that shares nothing with the engine: all houses in order, daylight, step-free ways, flights.
# A form without choices has as many houses as plans. Solids of some of the houses are apart, and their meshes closed and as large.
# Slow under sanitizers.
name=house_brute
. "$(dirname "$0")/golden.bash"
tests=$(cd "$here/.." && pwd)
cd "$scratch"

is 'houses of random forms' "$(python3 -B "$tests/house_brute.py" "$TARTAN" 12 | sed 's/^[0-9]* houses of 12 forms, [0-9]* decisions/all/')" 'all, 0 differ'
for seed in 1 2 4 6; do
    mkdir "built-$seed"
    "$TARTAN" sample "form-$seed.plan" 1 --library all --seed "$seed" >line
    "$TARTAN" house "form-$seed.plan" "$(cat line)" -o "built-$seed/house.json" -o "built-$seed/house.obj" -o "built-$seed/house.glb"
    is "solids of $(cat line)" "$(python3 -B "$tests/house_solids.py" "built-$seed")" fine
done

cat >plain.plan <<'PLAN'
schema hut {
  width role length = 8' | 10'
  zone body role band = room(10', 12')
  zone wing role band = empty role absent | porch(5')
}
form huts of hut {
  storey ground 9'
  storey loft 8'
  wall 6" partition 4" floor 1' roof 6"
  option wing storeys = 1
  function den at cell(body)
  function seat at cell(wing)
  opening sash wide 3' high 4' sill 2'8"
  face cell(any) outside front = sash
}
library rows using hut { trays 1..3 prune neighbour(tray(wing empty), tray(wing empty)) }
library all from rows in huts { }
PLAN
is 'a form without choices has as many houses as plans' \
    "$("$TARTAN" count plain.plan --library all --json | python3 -c 'import json, sys; c = json.load(sys.stdin); print(c["plans"] == c["houses"] == c["plans_with_houses"], c["plans"])')" \
    "True $("$TARTAN" enumerate plain.plan --library rows | wc -l)"
finish
