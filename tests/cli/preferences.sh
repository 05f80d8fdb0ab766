#!/usr/bin/env bash
# Libraries that prefer: the measure `preference` wherever measures are named, and what explain, schema, diff and Prolog say.
# Needs the parts: store
name=preferences
. "$(dirname "$0")/golden.bash"

golden best 'tartan best market.plan 3 -l liked'
golden best_json 'tartan best market.plan 2 -l best-liked --format json'
golden best_by_both 'tartan best market.plan 2 -l best-liked --most preference --then-least preference'
golden best_without 'tartan best market.plan 2 -l bare'
golden best_houses 'tartan best cabins.plan 2 -l cottages'
golden by 'tartan count market.plan -l liked --by preference'
golden by_misspelled 'tartan count market.plan -l liked --by preferense'
golden by_of_others 'tartan count market.plan -l bare --by preference'
golden where 'tartan count market.plan -l liked --where "preference in 3..4" --no-effects'
golden where_of_others 'tartan count market.plan -l bare --where "preference > 3"'
golden complete 'tartan complete market.plan "cafe | ..." -l best-liked --most preference'
golden explain 'tartan explain market.plan "hall 3m | cafe 3m | shop 6m" -l best-liked'
golden explain_full 'tartan explain market.plan "hall 3m | shop 6m" -l liked --full'
golden explain_json 'tartan explain market.plan "hall 3m | cafe 3m" -l liked --json'
golden explain_dropped 'tartan explain market.plan "shop 3m | cafe 3m" -l liked --nearest 1'
golden schema 'tartan schema market.plan | sed -n "/liked/,\$p"'
sed 's/busy worth 3/busy worth 4/; s/, trays = 3 worth 0.5/, trays = 2/' "$files/market.plan" >"$scratch/market.plan"
golden diff "tartan diff market.plan $scratch/market.plan -l liked --sample 0"
golden diff_json "tartan diff market.plan $scratch/market.plan -l liked --sample 0 --json | sed -n '/\"preferences\"/,/^  ]/p'"
{
    cat "$files/market.plan"
    printf 'measure long using stall = sum(width)\n'
} >"$scratch/measured.plan"
golden pareto "tartan pareto $scratch/measured.plan -l liked --most preference --least long"
golden disasm 'tartan disasm market.plan | sed -n "/^library 3/,/^function 0/p"'
golden prolog 'tartan export market.plan --prolog | grep -A 4 preference'

# A module answers as its source does; threads change nothing; each plan has the value that explain says.
"$TARTAN" build "$files/market.plan" -o "$scratch/market.tnb" >/dev/null 2>&1
for asked in 'count --by preference' 'best 5'; do
    read -r command more <<<"$asked"
    # shellcheck disable=SC2086
    "$TARTAN" $command "$scratch/market.tnb" $more -l best-liked 2>/dev/null |
        cmp - <("$TARTAN" $command "$files/market.plan" $more -l best-liked --threads 4 2>/dev/null) || fail "$asked: a module answers otherwise"
done
"$TARTAN" best "$files/market.plan" 700 -l best-liked --format json 2>/dev/null >"$scratch/best"
is 'all plans' "$(wc -l <"$scratch/best")" "$("$TARTAN" enumerate "$files/market.plan" -l best-liked | wc -l)"
"$TARTAN" best "$files/market.plan" 9 -l best-liked 2>/dev/null | grep -v '^#' | while read -r plan; do
    "$TARTAN" explain "$files/market.plan" "$plan" -l best-liked --json
done | python3 -c 'import json, sys
best = [json.loads(line)["value"] for line in open(sys.argv[1])][:9]
sys.exit([json.loads(line)["preference"] for line in sys.stdin] != best)' "$scratch/best" || fail 'explain says another preference than best'
finish
