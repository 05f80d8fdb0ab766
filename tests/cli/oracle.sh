#!/usr/bin/env bash
# Both engines decide every case of the independent reference as that does.
set -euo pipefail
oracle=$TARTAN_ORACLES/plan
if [ -z "$TARTAN_ORACLES" ] || [ ! -f "$oracle/to_plan.py" ]; then
    echo 'skipped: the independent reference is not here (-DTARTAN_ORACLES=FOLDER)'
    exit 77
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

failures=0
for cases in fixtures paper_cases; do
    out=$scratch/$cases
    python3 "$oracle/to_plan.py" "$oracle/$cases.jsonl" "$out"
    "$TARTAN" build "$out/rules.plan" -o "$out/rules.tnb" 2>/dev/null
    for expect in "$out"/r*.expect; do
        name=$(basename "$expect" .expect)
        for engine in vm dfa; do
            if ! "$TARTAN" match "$out/rules.tnb" --rule "$name" --threads 1 --engine="$engine" --format bits "$out/$name.plans" >"$out/got" ||
                ! cmp -s "$out/got" "$expect"; then
                echo "$cases, rule $name, --engine=$engine: not as the reference decides:"
                grep -n "^rule $name " "$out/rules.plan"
                paste -d ' ' "$expect" "$out/got" "$out/$name.plans" | awk '$1 != $2' | head -n 3
                failures=$((failures + 1))
            fi
        done
    done
done
echo "$failures rules differ"
[ "$failures" -eq 0 ]
