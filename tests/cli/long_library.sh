#!/usr/bin/env bash
# A library of many rules: its rules are combined in runs, and the plans that are left are those that trying each plan leaves.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for words in '60 1 3 2 3 0 0' '150 2 3 3 3 10 2' '40 3 4 2 2 6 3'; do
    python3 tests/cli/long_library.py $words >"$scratch/long.plan"
    "$TARTAN" count --json "$scratch/long.plan" | python3 -c '
import json, sys
for row in json.load(sys.stdin)["by_length"]:
    print(row["kept"])' >"$scratch/found"
    python3 tests/cli/long_library.py --count $words >"$scratch/tried"
    cmp "$scratch/found" "$scratch/tried" || { echo "$words: other counts"; diff "$scratch/found" "$scratch/tried"; exit 1; }
    "$TARTAN" enumerate "$scratch/long.plan" --threads 1 | sort >"$scratch/plans"
    [ "$(wc -l <"$scratch/plans")" = "$(awk '{ n += $1 } END { print n }' "$scratch/tried")" ]
    for threads in 2 5; do "$TARTAN" enumerate "$scratch/long.plan" --threads $threads | sort | cmp - "$scratch/plans"; done
done
# one of 500 rules opens, and the same with one thread as with more
python3 tests/cli/long_library.py 500 1 12 4 6 20 3 >"$scratch/long.plan"
for threads in 1 2; do "$TARTAN" enumerate "$scratch/long.plan" --from 1000000 --limit 20000 --threads $threads >"$scratch/$threads"; done
cmp "$scratch/1" "$scratch/2"
[ "$(wc -l <"$scratch/1")" = 20000 ]
