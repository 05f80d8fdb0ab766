#!/usr/bin/env bash
# prune: keeps what the library keeps, and says what drops the rest.
name=prune
. "$(dirname "$0")/golden.bash"

cat >"$scratch/plans" <<'PLANS'
3m door
3m -
3m door | 3m door
6m door | 6m door
3m door | 6m - | 3m door

3m door | 3m - | 3m - | 3m -
PLANS
golden kept "tartan prune sheds.plan $scratch/plans --library sheds"
golden dropped "tartan prune sheds.plan $scratch/plans --library sheds --dropped $scratch/why -o $scratch/kept; cat $scratch/why"
golden both "tartan prune sheds.plan $scratch/plans --library sheds --dropped -"
golden json "tartan prune sheds.plan $scratch/plans --library sheds --format json --dropped -"
golden trays "tartan prune sheds.plan $scratch/plans --library sheds --trays 2..4"
golden bad "printf '3m door\n3m\n3m - | 3m door\n' | tartan prune sheds.plan - --library sheds --on-error skip"

# What was dropped can be read again, and is dropped again; what was kept is kept.
"$TARTAN" prune "$files/sheds.plan" "$scratch/plans" -l sheds -d "$scratch/why" >"$scratch/kept"
is 'dropped and read again' "$("$TARTAN" prune "$files/sheds.plan" "$scratch/why" -l sheds | wc -l)" 0
"$TARTAN" prune "$files/sheds.plan" "$scratch/kept" -l sheds | cmp - "$scratch/kept" || fail 'kept plans are not kept'

# Every plan there is, filtered, is the library.
"$TARTAN" enumerate "$files/sheds.plan" -l any-sheds --trays 1..3 | "$TARTAN" prune "$files/sheds.plan" -l sheds >"$scratch/filtered"
"$TARTAN" enumerate "$files/sheds.plan" -l sheds | cmp - "$scratch/filtered" || fail 'filtering all plans does not give the library'
finish
