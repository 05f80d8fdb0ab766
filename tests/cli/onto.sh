#!/usr/bin/env bash
# Libraries that are projected onto older schemas: everything that is asked of libraries is asked of one.
name=onto
. "$(dirname "$0")/golden.bash"

golden check 'tartan check projected.plan && tartan test projected.plan && tartan schema projected.plan --json | grep -c "\"kind\": \"onto\""'
golden count 'for l in bare fewer; do tartan count projected.plan --library $l; done'
golden ways 'tartan count projected.plan --library bare --ways; tartan enumerate projected.plan --library fewer --ways --limit 4'
golden explain 'tartan explain projected.plan --library bare --full "[4m hall | 3m room]"; tartan explain projected.plan --library bare "[4m hall | 4m hall | 3m room]"'
golden explain_json 'tartan explain projected.plan --library bare --json "[4m hall | 3m room]"'
golden ranked 'tartan unrank projected.plan --library bare 20; tartan rank projected.plan --library bare "$(tartan unrank projected.plan --library bare 20)"'
golden sampled 'tartan sample projected.plan 3 --library bare --seed 4'
golden engines 'for e in vm dfa; do tartan enumerate projected.plan --library plain | tartan prune projected.plan --library bare --engine $e -; done'
golden completed 'tartan complete projected.plan --library bare "4m hall | ? | 4m hall"'
golden trays 'tartan count projected.plan --library bare --trays 5..5 --no-effects'
golden where 'tartan count projected.plan --library bare --where "quantity(tray(hall)) = 1" --no-effects'
golden longer 'tartan prune projected.plan --library bare --engine vm <<<"$(for i in {1..30}; do printf "%s4m room built:4m" "${sep-}"; sep=" | "; done)"'
golden prolog 'tartan export projected.plan --prolog --library plain | grep "left out\.$"; tartan export projected.plan --prolog --library bare'
golden houses 'tartan count projected.plan --library huts; tartan sample projected.plan 2 --library huts --seed 1'
golden disasm 'tartan disasm projected.plan | grep -A3 "holds bayed"'

# A picture of the clause, a report, and a module.
exits 0 "$TARTAN" explain "$files/projected.plan" --library bare "[4m hall | 4m hall]" -o "$scratch/why.svg"
grep -q 'from bayed onto row' "$scratch/why.svg" || fail 'the picture does not say what is projected'
exits 0 "$TARTAN" report "$files/projected.plan" --library bare -o "$scratch/report.html"
grep -q 'bayed <small>projected' "$scratch/report.html" || fail 'the report does not say that it is projected'
exits 0 "$TARTAN" build "$files/projected.plan" -o "$scratch/projected.tnb"
is 'the module' "$("$TARTAN" count "$scratch/projected.tnb" --library bare)" "$("$TARTAN" count "$files/projected.plan" --library bare)"
is 'the layout' "$("$TARTAN" fmt - <"$files/projected.plan")" "$(cat "$files/projected.plan")"

finish
