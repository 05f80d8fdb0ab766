#!/usr/bin/env bash
# Libraries of houses that take much work: what is said where they pass a limit, and of very many houses.
# Slow under sanitizers.
name=house_limits
. "$(dirname "$0")/golden.bash"

{
    printf 'schema s { width = 8'"'"'\n zone body = open(8'"'"') }\nform f of s {\n'
    for ((i = 0; i < 40; i++)); do printf '  storey s%s 9'"'"'\n' "$i"; done
    printf "  wall 6\" partition 4\" floor 1' roof 10\"\n"
    for ((i = 0; i < 200; i++)); do printf '  function f%s at cell(body)\n' "$i"; done
    printf '}\nlibrary rows using s { trays 1..1 }\nlibrary tall from rows in f { }\n'
} >"$scratch/city.plan"
golden too_many_together "tartan count $scratch/city.plan --library tall"
golden too_many_steps "tartan count $scratch/city.plan --library tall --plan '#0'"
tower() { # STOREYS
    printf 'schema t { width role length = 4m | 6m  zone core role band = core(5m)  zone flat role band = flat(6m) | none }\nform tower of t {\n'
    for ((i = 0; i < $1; i++)); do printf '  storey s%s 3m\n' "$i"; done
    cat <<'END'
  wall 30cm  partition 10cm  floor 30cm  roof 30cm
  function hall at cell(core)
  function home at cell(flat)
  function den at cell(flat)
  opening door wide 1m high 2.1m passage
  opening win wide 1m high 1.5m sill 1m glazed
  face cell(hall) beside cell(home or den) = door
  face cell(any) outside = win | wall
}
library rows using t { trays 1..1 }
library towers from rows in tower { prune room(home, not by win)  require quantity(cell(den), n >= 2) }
measure dens = quantity(cell(den))
END
}
# Windows that no clause asks for are counted together, so that a tower of eight storeys is within the limits.
tower 8 >"$scratch/eight.plan"
tower 12 >"$scratch/twelve.plan"
tower 31 >"$scratch/thirty.plan"
golden eight_storeys "tartan count $scratch/eight.plan --library towers --by dens"
golden eight_storeys_ranked "tartan unrank $scratch/eight.plan 123456789 --library towers"
golden too_many_slices "tartan count $scratch/twelve.plan --library towers --by dens"
golden too_many_cells "tartan count $scratch/thirty.plan --library towers --by dens"
# What is too much is said before it is counted, where states without tiles already are.
golden sample_too_many 'tartan sample lahave-complete 6 --library lahave-complete --max-states 100000'
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
  floor 300mm
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

# Longer rows than the library has: that they are too many is said before they are counted.
golden steps_count "tartan count lahave-complete --library lahave-complete --trays 6..8 --max-states 300000"
golden steps_sample "tartan sample lahave-complete 3 --library lahave-complete --trays 6..8 --max-states 100000"
finish
