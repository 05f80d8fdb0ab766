#!/usr/bin/env bash
# In how many ways plans are derived: counted over libraries, and of single plans in every format.
name=ways
. "$(dirname "$0")/golden.bash"

golden count 'tartan count grown.plan --library grown-rows --ways'
golden count_json 'tartan count grown.plan --library twin-rows --ways --json'
golden count_limits 'tartan count grown.plan --library grown-rows --trays 2..3 --where "tray(room)" --ways'
golden words 'for l in cornered implied gaps some-end either-side; do tartan count grown.plan --library $l --ways --json; done'
golden nothing 'tartan count grown.plan --library nothing --ways; tartan count grown.plan --library nothing --ways --json'
golden empty_plan 'tartan count grown.plan --library implied --ways'
golden free 'tartan count grown.plan --library free --ways; tartan sample grown.plan 2 --library free --ways'

golden rank 'tartan rank grown.plan --library grown-rows "[room | hall | room]" --ways; tartan rank grown.plan --library grown-rows "[room | hall | room]" --ways --json'
golden projected 'tartan count furnished.plan --library bare-rows --ways; tartan enumerate furnished.plan --library bare-rows --ways; tartan count furnished.plan --library bare-rows --ways --json'
golden explain 'tartan explain grown.plan --library grown-rows "[room | hall | room]" --full'
golden lines 'tartan enumerate grown.plan --library grown-rows --ways --limit 5'
golden csv 'tartan enumerate grown.plan --library grown-rows --ways --from 4 --limit 3 --format csv'
golden json 'tartan sample grown.plan 2 --library grown-rows --ways --seed 3 --format json'
golden generated 'tartan enumerate grown.plan --library twin-rows --trays 3..3 --ways'
golden packed 'tartan enumerate grown.plan --library grown-rows --ways -o $scratch/plans.bin'
golden refused 'for o in "--by trays" --mirror --no-effects; do tartan count grown.plan --library grown-rows --ways $o; done'
golden houses 'for c in "count cottage" "sample cottage 1" "enumerate cottage"; do tartan $c --library cottages --ways; done; tartan rank cabins.plan "$(tartan unrank cabins.plan "#10:77")" --ways'
golden kits 'tartan count bricks --parts 2 --ways; tartan enumerate bricks --parts 2 --ways'
golden shards 'tartan sample grown.plan 2 --library grown-rows --ways --shards 2 -o $scratch/set'

# Long rows are counted as exactly as short ones.
cat >"$scratch/long.plan" <<'END'
schema row { use = a | b }
rule pairs = tray(a) or neighbour(pairs, pairs)
library l using row { trays 1..150  generate pairs }
END
ways=$("$TARTAN" count "$scratch/long.plan" --ways --json | grep -o '"most":"[0-9]*"')
is '149th Catalan number' "$ways" "\"most\":\"$(python3 -c 'from math import comb; print(comb(298, 149) // 150)')\""
row=$(printf 'a | %.0s' {1..149})a
is 'ways of a long plan' "$("$TARTAN" rank "$scratch/long.plan" "$row" --ways | cut -f2)" \
    "$(python3 -c 'from math import comb; print(comb(298, 149) // 150)')"

finish
