#!/usr/bin/env bash
# The best houses by measures, the best trade-offs, and what open plans leave.
name=house_best
. "$(dirname "$0")/golden.bash"

golden best 'tartan best house-measures.plan 3 -l cottages --least floor-area --then-most rooms-value'
golden best_json 'tartan best house-measures.plan 2 -l cottages --most bedrooms --then-least floor-area --format json'
golden best_on_plan "tartan best house-measures.plan 2 --plan '#3' --least rooms-value"
golden best_none_on_plan "tartan best house-measures.plan 1 -l cottages --plan '#3' --least floor-area --where 'quantity(cell(bedroom), n > 90)'"
golden best_where 'tartan best house-measures.plan 1 -l cottages --least floor-area --where "quantity(cell(bedroom), n >= 2)"'
golden best_none 'tartan best house-measures.plan 1 -l cottages --least floor-area --where "quantity(cell(bedroom), n > 90)"'
golden best_of_plans 'tartan best house-measures.plan 1 -l cottages --least bedroom'
golden best_database 'tartan best house-measures.plan 1 -l cottages --least bedrooms -o best.bin'
golden best_mirror 'tartan best house-measures.plan 1 -l cottages --least bedrooms --mirror'
golden best_limit 'tartan best house-measures.plan 1 -l cottages --least bedrooms --max-states 10'
golden best_bad_plan "tartan best house-measures.plan 1 --plan '#99' --least bedrooms"
golden best_cost 'tartan best priced.plan 3 -l barns --least price --then-most floors'
golden best_cost_json 'tartan best priced.plan 2 -l barns --most offer --format json --where "quantity(cell(living), n = 3)"'
golden front_cost 'tartan pareto priced.plan -l barns --least price --most floors'
golden complete_cost 'tartan complete priced.plan "14'"'"' | ..." -l barns --least price'
golden front 'tartan pareto house-measures.plan -l cottages --least floor-area --most bedrooms'
golden front_json "tartan pareto house-measures.plan --plan '#3' --least floor-area --most rooms-value --json"
golden front_one 'tartan pareto house-measures.plan -l cottages --least floor-area'
golden open_plan "tartan complete house-measures.plan -l cottages \"14' | ? | ...\" --least floor-area"
golden open_plan_json "tartan complete house-measures.plan -l cottages \"10'\" --json"
golden open_plan_cells 'tartan complete house-measures.plan -l cottages "cell(bedroom) | ..." 2>&1 | grep -v "  note: "'

# The best that differ as people see it: on other plans, then in other sections, functions, faces, tiles.
golden best_diverse 'tartan best cabins.plan 4 -l cottages --least floor-area --diverse'
golden best_diverse_on_plan "tartan best cabins.plan 7 --plan '#3' --least floor-area --diverse"
golden best_diverse_json 'tartan best cabins.plan 2 -l cottages --most bedrooms --diverse --format json'
golden best_diverse_many 'tartan best cabins.plan 501 -l cottages --least floor-area --diverse'
golden best_diverse_of_plans 'tartan best lahave-houses 3 --least cost --diverse'
is 'houses on other plans' "$("$TARTAN" best "$files/cabins.plan" 10 -l cottages --least floor-area --diverse | grep -v '^#' | cut -d ';' -f 1 | sort -u | wc -l)" 10
is 'the best of those that differ is the best' "$("$TARTAN" best "$files/cabins.plan" 5 -l cottages --least floor-area --diverse | head -n 2)" \
    "$("$TARTAN" best "$files/cabins.plan" 1 -l cottages --least floor-area)"
is 'all houses differ' "$("$TARTAN" best "$files/cabins.plan" 500 --plan '#3' --least floor-area --diverse | grep -v '^#' | sort -u | wc -l)" 500

golden values 'tartan test house-values.plan'

# The best are drawn by both commands, on all plans and on one; of none, nothing is.
if grep -q '^TARTAN_WITH_DRAW:BOOL=ON' "$(dirname "$TARTAN")/CMakeCache.txt"; then
    "$TARTAN" best "$files/house-measures.plan" 5 -l cottages --least floor-area --then-most bedrooms -o "$scratch/best.svg"
    "$TARTAN" draw "$files/house-measures.plan" -l cottages --best 5 --least floor-area --then-most bedrooms -o "$scratch/drawn.svg"
    cmp "$scratch/best.svg" "$scratch/drawn.svg" || fail 'two pictures of the best houses differ'
    "$TARTAN" best "$files/house-measures.plan" 5 --plan '#3' --least rooms-value -o "$scratch/plan.svg"
    cmp -s "$scratch/best.svg" "$scratch/plan.svg" && fail 'the best on one plan are drawn as the best of all'
    "$TARTAN" pareto "$files/house-measures.plan" -l cottages --least floor-area --most bedrooms -o "$scratch/front.svg"
    is 'the front is drawn' "$(head -c 5 "$scratch/front.svg")" '<?xml'
    golden front_picture_none "tartan pareto house-measures.plan -l cottages --least floor-area --most bedrooms --where 'quantity(cell(bedroom), n > 90)' -o $scratch/none.svg"
    golden best_picture_none "tartan best house-measures.plan 2 -l cottages --least floor-area --where 'quantity(cell(bedroom), n > 90)' -o $scratch/none.svg"
    is 'a picture of none' "$(ls "$scratch/none.svg" 2>&1 | grep -c 'No such')" 1
fi
golden best_picture_of_0 "tartan best house-measures.plan 0 -l cottages --least floor-area -o $scratch/none.svg"

# What completes the plan is what is counted with the pattern as a requirement.
is 'houses that complete a plan' \
    "$("$TARTAN" complete "$files/cabins.plan" -l cottages "14' porch | ... | none" --json | python3 -c 'import json, sys; print(json.load(sys.stdin)["houses"])')" \
    "$("$TARTAN" count "$files/cabins.plan" -l cottages --where "plan [14' porch | ... | none]" --json | python3 -c 'import json, sys; print(json.load(sys.stdin)["houses"])')"

finish
