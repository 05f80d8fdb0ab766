#!/usr/bin/env bash
# sample: as many as asked for, in rank order, without repeats, the same for the same seed.
name=sample
. "$(dirname "$0")/golden.bash"

golden all 'tartan sample sheds.plan 1000 -l sheds'
golden one_length 'tartan sample sheds.plan 50 --length 1 -l sheds'
golden none 'tartan sample sheds.plan 0 -l sheds'

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
finish
