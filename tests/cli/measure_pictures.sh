#!/usr/bin/env bash
# Needs the parts: draw
# Pictures of measures: histograms, fronts, open plans, the best plans. What is counted is there, and the bytes are the same each time.
name=measure_pictures
. "$(dirname "$0")/golden.bash"
plan=$files/measures.plan

# drawn FILE COLOUR: how many shapes of that colour an SVG has.
drawn() {
    grep -c "^<path fill=\"$2\"" "$1" || true
}
green='#7a9c6b' red='#b33333' choice='#cce0c2'

for kind in svg png pdf; do
    "$TARTAN" count "$plan" -l strips --by area -o "$scratch/a.$kind"
    "$TARTAN" count "$plan" -l strips --by area --threads 1 -o "$scratch/b.$kind"
    cmp -s "$scratch/a.$kind" "$scratch/b.$kind" || fail "$kind: the same histogram has other bytes"
done
python3 -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' "$scratch/a.svg" || fail 'the SVG is not well-formed'

# A bar for each value, or for each bin.
values=$("$TARTAN" count "$plan" -l strips --by area --json | grep -c '"value"')
is 'bars of values' "$(drawn "$scratch/a.svg" "$green")" "$values"
is 'bars that are numbered' "$(grep -o 'data-bar="[0-9]*"' "$scratch/a.svg" | tr -dc '0-9\n' | paste -sd ' ')" "$(seq -s ' ' 0 $((values - 1)))"
"$TARTAN" count "$plan" -l strips --by cost --bins 6 -o "$scratch/bins.svg"
is 'bars of bins' "$(drawn "$scratch/bins.svg" "$green")" "$("$TARTAN" count "$plan" -l strips --by cost --bins 6 | grep -c ' \.\. ')"
"$TARTAN" count "$plan" -l strips --by cost --where 'trays = 2 and trays = 3' -o "$scratch/none.svg"
is 'bars of nothing' "$(drawn "$scratch/none.svg" "$green")" 0
"$TARTAN" count "$plan" -l strips --by area --where 'area = 8m2' -o "$scratch/one.svg"
is 'bars of one value' "$(drawn "$scratch/one.svg" "$green")" 1

# A dot for each point of the front, in each panel.
"$TARTAN" pareto "$plan" -l strips --least cost --most all-beds -o "$scratch/front.svg"
points=$("$TARTAN" pareto "$plan" -l strips --least cost --most all-beds --json | grep -c '"plan"')
is 'dots of the front' "$(drawn "$scratch/front.svg" "$red")" "$points"
is 'dots that are numbered' "$(grep -o 'data-point="[0-9]*"' "$scratch/front.svg" | tr -dc '0-9\n' | paste -sd ' ')" "$(seq -s ' ' 0 $((points - 1)))"
"$TARTAN" pareto "$plan" -l strips --least cost --most all-beds --least area -o "$scratch/three.svg"
points=$("$TARTAN" pareto "$plan" -l strips --least cost --most all-beds --least area --json | grep -c '"plan"')
is 'dots of three panels' "$(drawn "$scratch/three.svg" "$red")" "$((3 * points))"
"$TARTAN" pareto "$plan" -l strips --least cost --most area --where 'trays = 2 and trays = 3' -o "$scratch/empty.svg"
is 'dots of nothing' "$(drawn "$scratch/empty.svg" "$red")" 0

# A bar for each choice that there is.
"$TARTAN" complete "$plan" '3m room | ? | ... | store' -l strips --least cost -o "$scratch/open.svg"
choices=$("$TARTAN" complete "$plan" '3m room | ? | ... | store' -l strips --json | grep -c '": "[1-9]')
is 'choices' "$(drawn "$scratch/open.svg" "$choice")" "$((choices - 1))" # the first is `plans`
"$TARTAN" complete "$plan" 'store | ?' -l strips -o "$scratch/closed.svg"
is 'choices of none' "$(drawn "$scratch/closed.svg" "$choice")" 0

# The best plans on a sheet; the measure beside each choice.
"$TARTAN" best "$plan" 4 -l strips --least cost --then-most all-beds -o "$scratch/best.svg"
"$TARTAN" best "$plan" 2 -l strips --least cost -o "$scratch/two.svg"
[ "$(wc -c <"$scratch/best.svg")" -gt "$(wc -c <"$scratch/two.svg")" ] || fail 'four plans are no more than two'
golden complete_least 'tartan complete measures.plan -l strips "3m room | ? | ... | store" --least cost'
golden complete_most_json 'tartan complete measures.plan -l strips "room | store" --most area --json'
golden complete_two_wishes 'tartan complete measures.plan -l strips "room | ?" --most area --then-least cost'
golden json_picture "tartan count measures.plan -l strips --by area --json -o $scratch/x.svg"
golden count_picture "tartan count measures.plan -l strips -o $scratch/x.svg"
"$TARTAN" draw "$plan" --best 4 -l strips --least cost --then-most all-beds -o "$scratch/drawn.svg"
cmp "$scratch/best.svg" "$scratch/drawn.svg" || fail '`draw --best` draws other plans than `best`'
golden best_without_measure "tartan draw measures.plan --best 4 -l strips -o $scratch/x.svg"
golden measure_without_best "tartan draw measures.plan -l strips --least cost -o $scratch/x.svg"
golden best_and_sample "tartan draw measures.plan --best 4 --sample 4 -l strips --least cost -o $scratch/x.svg"
golden many_best "tartan draw measures.plan --best 5001 -l strips --least cost -o $scratch/x.svg"
golden many_drawn "tartan best measures.plan 5001 -l strips --least cost -o $scratch/x.svg"
finish
