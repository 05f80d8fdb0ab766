#!/usr/bin/env bash
# Both engines decide every case of the independent reference as that does.
# Slow under sanitizers.
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
        name=${expect##*/} name=${name%.expect}
        wanted=$(<"$expect")
        for engine in vm dfa; do
            if ! got=$("$TARTAN" match "$out/rules.tnb" --rule "$name" --threads 1 --engine="$engine" --format bits "$out/$name.plans") ||
                [ "$got" != "$wanted" ]; then
                echo "$cases, rule $name, --engine=$engine: not as the reference decides:"
                grep -n "^rule $name " "$out/rules.plan"
                paste -d ' ' "$expect" <(printf '%s\n' "$got") "$out/$name.plans" | awk '$1 != $2' | head -n 3
                failures=$((failures + 1))
            fi
        done
    done
done

# The Prolog program too, where SWI-Prolog is installed: each rule on the first hundred of its cases.
prolog() { # FOLDER
    "$TARTAN" export "$1/rules.tnb" --prolog -o "$1/rules.pl"
    {
        echo ":- initialization((run, halt))."
        echo "decide(R, P) :- ( call(R, P) -> writeln(1) ; writeln(0) )."
        echo "run :- forall(case(R, P), decide(R, P))."
        for expect in "$1"/r*.expect; do
            name=${expect##*/} name=${name%.expect}
            head -n 100 "$1/$name.plans" | awk -v q="'" -v rule="$name" 'function atom(t) { gsub(q, q q, t); return q t q }
                { n = split($0, trays, / \| /); line = ""
                  for (i = 1; i <= n; i++) {
                      m = split(trays[i], words, " "); if (m == 0) continue
                      term = atom(words[1]); for (k = 2; k <= m; k++) term = term "," atom(words[k])
                      line = line (line == "" ? "" : ",") "tray(" term ")" }
                  print "case(" atom(rule) ", [" line "])." }'
        done
    } >"$1/cases.pl"
    swipl -q -l "$1/rules.pl" "$1/cases.pl" >"$1/prolog"
    for expect in "$1"/r*.expect; do head -n 100 "$expect"; done | cmp - "$1/prolog"
}
if command -v swipl >/dev/null; then
    for cases in fixtures paper_cases; do
        prolog "$scratch/$cases" || {
            echo "$cases: Prolog decides otherwise"
            failures=$((failures + 1))
        }
    done
fi
echo "$failures rules differ"
[ "$failures" -eq 0 ]
