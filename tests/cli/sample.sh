#!/usr/bin/env bash
# sample: as many as asked for, in rank order, without repeats, the same for the same seed.
name=sample
. "$(dirname "$0")/golden.bash"

golden all 'tartan sample sheds.plan 1000 -l sheds'
golden one_length 'tartan sample sheds.plan 50 --length 1 -l sheds'
golden none 'tartan sample sheds.plan 0 -l sheds'

golden by_weight 'tartan sample market.plan 6 -l lively --seed 3'
golden by_weight_of_a_length 'tartan sample market.plan 3 -l market --length 2 --where "tray(shop)"'
golden by_weight_per_length 'tartan sample market.plan --per-length 2 -l market --format csv'
golden by_weight_or_diverse 'tartan sample market.plan 3 -l market --diverse'
golden by_weight_of_shards 'tartan sample market.plan 3 -l market --shards 2 -o "$scratch/set"'
golden by_weight_of_new_shards 'tartan shards new market.plan -l market --sample 3 --shards 2 -o "$scratch/set"'

sample() {
    "$TARTAN" sample "$files/sheds.plan" "$@" -l any-sheds --trays 0..9
}
sample 500 --seed 1 >"$scratch/a"
sample 500 --seed 1 --threads 1 | cmp - "$scratch/a" || fail 'the same seed gives other plans'
sample 500 --seed 2 | cmp -s - "$scratch/a" && fail 'another seed gives the same plans'
is 'plans' "$(wc -l <"$scratch/a")" 500
is 'different plans' "$(sort -u "$scratch/a" | wc -l)" 500
sample 500 --seed 1 --format csv | tail -n +2 | cut -d, -f1 >"$scratch/ranks"
sort -n "$scratch/ranks" | cmp -s - "$scratch/ranks" || fail 'ranks do not ascend'
is 'per length' "$(sample --per-length 3 | wc -l)" $((1 + 3 * 9))
is 'all are in the library' "$("$TARTAN" sample "$files/sheds.plan" 40 --seed 5 -l sheds --trays 5..9 |
    "$TARTAN" prune "$files/sheds.plan" -l sheds --trays 5..9 --engine vm | wc -l)" 40

# By weight: the same with any number of threads; all that there are; and without the weights as if there were none.
by_weight() {
    "$TARTAN" sample "$files/market.plan" "$@" 2>/dev/null
}
by_weight 40 -l lively --threads 1 >"$scratch/one"
by_weight 40 -l lively --threads 4 | cmp - "$scratch/one" || fail 'by weight, other plans with more threads'
is 'different plans by weight' "$(sort -u "$scratch/one" | wc -l)" 40
by_weight 1000 -l market | cmp - <("$TARTAN" enumerate "$files/market.plan" -l market) || fail 'by weight, not all plans'
by_weight 20 -l market --uniform | cmp - <(by_weight 20 -l bare) || fail '--uniform draws other plans than without weights'
by_weight 20 -l market | cmp -s - <(by_weight 20 -l bare) && fail 'weights change nothing'
cat >"$scratch/houses.plan" <<'PLAN'
use "cottage"
library heavy from cottage-rows { weight any 2 }
library heavy-cottages from heavy in cottage-form { }
PLAN
exits 2 "$TARTAN" sample "$scratch/houses.plan" 2 -l heavy-cottages
grep -q 'the plans of `heavy` have weights' "$scratch/err" || fail "houses of plans with weights: $(head -n 1 "$scratch/err")"
exits 0 "$TARTAN" sample "$scratch/houses.plan" 2 -l heavy-cottages --uniform
exits 0 "$TARTAN" sample "$scratch/houses.plan" 2 -l heavy-cottages --plan '#0'
"$TARTAN" sample "$files/market.plan" 5 -l market --uniform --shards 2 -o "$scratch/set" 2>/dev/null
"$TARTAN" shards run "$scratch/set" 2>/dev/null
"$TARTAN" shards cat "$scratch/set" | cmp - <(by_weight 5 -l market --uniform) || fail 'shards draw other plans'
finish
