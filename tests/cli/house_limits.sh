#!/usr/bin/env bash
# Libraries of houses that take much work: what is said where they pass a limit, and of very many houses.
# Slow under sanitizers.
name=house_limits
. "$(dirname "$0")/golden.bash"

{
    printf 'schema s { width = 8'"'"'\n zone body = open(8'"'"') }\nform f of s {\n'
    for ((i = 0; i < 40; i++)); do printf '  storey s%s 9'"'"'\n' "$i"; done
    printf "  wall 6\" partition 4\" deck 1' roof 10\"\n"
    for ((i = 0; i < 200; i++)); do printf '  function f%s at cell(body)\n' "$i"; done
    printf '}\nlibrary rows using s { trays 1..1 }\nlibrary tall from rows in f { }\n'
} >"$scratch/city.plan"
golden too_many_together "tartan count $scratch/city.plan --library tall"
golden too_many_steps "tartan count $scratch/city.plan --library tall --plan '#0'"
golden relations_limit 'tartan check lahave-few.plan --relations --max-states 12000'
# Long numbers stay apart from those beside them.
golden count_wide "tartan count apartments --library apartments --plan '#0' --clauses | sed -n '/without/,\$p'"

# A plan whose houses are too many to go through: they are listed by their numbers, also where clauses ask what tiles cost.
cat >"$scratch/bays.plan" <<'END'
schema bays { width role length = 3m  zone body = room(4m) }
library five using bays { trays 5..5 }
form two of bays {
  storey ground 3m
  storey upper 3m
  wall 300mm
  partition 100mm
  deck 300mm
  roof 200mm
  function living at cell(body)
  function bedroom at cell(body)
  function hall at cell(body)
  opening door wide 900mm high 2m passage
  face cell(any) along cell(any) = door | wall
  tile bed for bedroom { against wall  item bed left 600mm..2.1m, back 0..2m }
  material furniture "#aa8855" price 300 per each for bed
}
library houses from five in two {
  prune apart(cell(bedroom), from cell(hall), by door) as shut-off
}
END
bays() { "$TARTAN" "$@" "$scratch/bays.plan" --library houses; }
same_by_number() { # FROM, and more options
    local from=$1 number
    shift
    bays enumerate --from "$from" --limit 12 "$@" >"$scratch/listed" || fail "the houses from $from on are not listed"
    for ((number = from; number < from + 12; number++)); do
        "$TARTAN" unrank "$scratch/bays.plan" "$number" --library houses "$@"
    done >"$scratch/numbered"
    cmp -s "$scratch/listed" "$scratch/numbered" || fail "houses from $from on differ from those of these numbers $*"
}
same_by_number 123456789
same_by_number 4000000 --where 'sum(cost) <= 900'
[ "$(bays enumerate --from 410467598 | wc -l)" = 2 ] || fail 'the last houses of the plan are not listed'
finish
