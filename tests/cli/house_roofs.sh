#!/usr/bin/env bash
# Needs the parts: mesh
# Roofs at random, with eaves, open and across: the solids of houses are apart, their meshes closed and as large, and slabs and walls where
# what roofs mean says.
# Seeds 6 and 14 have lines of roofs that cross side by side, a step of the mesh apart; 103 and 172 a roof beside a wall, below another
# roof that has corners over it.
# Slow under sanitizers.
name=house_roofs
. "$(dirname "$0")/golden.bash"
tests=$(cd "$here/.." && pwd)
cd "$scratch"

for seed in ${TARTAN_SEEDS:-1 2 6 14 103 172}; do
    python3 -B "$tests/house_roofs.py" "$seed" >form.plan
    "$TARTAN" sample form.plan 2 --library all --plan '#70' --seed "$seed" >lines
    is "houses of form $seed" "$(wc -l <lines)" 2
    while read -r line; do
        rm -rf built
        mkdir built
        "$TARTAN" house form.plan "$line" -o built/house.json -o built/house.parts.csv -o built/house.obj </dev/null
        is "solids of form $seed, $line" "$(python3 -B "$tests/house_solids.py" built)" fine
        is "roofs of form $seed, $line" "$(python3 -B "$tests/house_slabs.py" built/house.json form.plan)" fine
    done <lines
done

# Two sheds that rise to a ridge, of slopes and depths that differ: no wall is below it.
"$TARTAN" house row-houses "$("$TARTAN" sample row-houses 1 --library row-houses --where 'option(street roof shed)' --seed 3)" -o house.json
is 'row houses' "$(python3 -B "$tests/house_slabs.py" house.json "$here/../../stdlib/row-houses.plan" 12)" fine
finish
