#!/usr/bin/env bash
# Libraries of 50 and 500 pruning rules: counted as trying every plan counts them, the same at any number of threads, or
# refused with the names of the rules in the way.
# Slow under sanitizers.
name=many_rules
. "$(dirname "$0")/golden.bash"

# check RULES SEED TRAYS LENGTHS: the counts of a file of random rules against what match says of every plan.
check() {
    python3 "$here/many_rules.py" "$1" "$2" "$3" >"$scratch/rules.plan"
    "$TARTAN" count "$scratch/rules.plan" -l pruned --json 2>/dev/null >"$scratch/counts"
    "$TARTAN" enumerate "$scratch/rules.plan" -l whole 2>/dev/null >"$scratch/plans"
    "$TARTAN" match "$scratch/rules.plan" "$scratch/plans" --format bits 2>/dev/null >"$scratch/bits"
    python3 - "$scratch/counts" "$scratch/bits" <<'EOF' || fail "$1 rules, seed $2: wrong counts"
import json, sys
counts = json.load(open(sys.argv[1]))
rows = [line.strip() for line in open(sys.argv[2])]
rules = counts["rules"]
prunes, only, kept = [0] * len(rules), [0] * len(rules), 0
for row in rows:
    assert len(row) == len(rules)
    hits = [i for i, bit in enumerate(row) if bit == "1"]
    kept += not hits
    for i in hits:
        prunes[i] += 1
    if len(hits) == 1:
        only[hits[0]] += 1
assert int(counts["generated"]) == len(rows) > 10000
assert int(counts["kept"]) == kept
assert [int(rule["prunes"]) for rule in rules] == prunes
assert [int(rule["only"]) for rule in rules] == only
EOF
    "$TARTAN" enumerate "$scratch/rules.plan" -l pruned 2>/dev/null >"$scratch/kept"
    paste -d ' ' "$scratch/bits" "$scratch/plans" | sed -n 's/^0* \(.*\)/\1/p' >"$scratch/expected"
    cmp -s "$scratch/kept" "$scratch/expected" || fail "$1 rules, seed $2: other plans are enumerated"
}

# idle RULES SEED TRAYS: check says that a rule changes nothing (W005) just where it alone prunes no plan.
idle() {
    python3 "$here/many_rules.py" "$1" "$2" "$3" >"$scratch/rules.plan"
    "$TARTAN" count "$scratch/rules.plan" -l pruned --json 2>/dev/null >"$scratch/counts"
    "$TARTAN" check "$scratch/rules.plan" --diagnostics=json 2>"$scratch/said"
    python3 - "$scratch/counts" "$scratch/said" <<'EOF' || fail "$1 rules, seed $2: check and count differ on which rules are idle"
import json, sys
idle = {rule["name"] for rule in json.load(open(sys.argv[1]))["rules"] if rule["only"] == "0"}
found = {said["message"].split("`")[1] for said in json.load(open(sys.argv[2])) if said["code"] == "W005"}
assert idle and found == idle, (found, idle)
EOF
}
idle 120 1 0..3
idle 50 2 0..4
idle 80 4 1..6
check 50 1 0..3
check 50 2 0..3
check 500 1 0..3
python3 "$here/many_rules.py" 50 1 1..3 >"$scratch/rules.plan"
"$TARTAN" count "$scratch/rules.plan" -l pruned 2>/dev/null | grep -q '^states: [0-9]* within these lengths$' ||
    fail 'it is not said that the states are those of these lengths'
is 'states in JSON' "$("$TARTAN" count "$scratch/rules.plan" -l pruned --json 2>/dev/null |
    python3 -c 'import json, sys; print(json.load(sys.stdin)["states"])')" None
for threads in 1 2 8; do
    "$TARTAN" count "$scratch/rules.plan" -l pruned --mirror --threads "$threads" >"$scratch/out.$threads" 2>/dev/null
    cmp -s "$scratch/out.1" "$scratch/out.$threads" || fail "$threads threads count otherwise"
done

# The hash is of the plans, not of how the library was built: nor of the order of its rules.
hash_of() {
    "$TARTAN" count "$1" -l pruned --json 2>/dev/null | python3 -c 'import json, sys; print(json.load(sys.stdin)["hash"])'
}
sed 's/prune r0, \(.*\) }/prune \1, r0 }/' "$scratch/rules.plan" >"$scratch/turned.plan"
is 'the hash' "$(hash_of "$scratch/turned.plan")" "$(hash_of "$scratch/rules.plan")"
sed 's/prune r0, r1, /prune /' "$scratch/rules.plan" >"$scratch/fewer.plan"
[ "$(hash_of "$scratch/fewer.plan")" != "$(hash_of "$scratch/rules.plan")" ] || fail 'another library has the same hash'

# What multiplies too much says so, and which rules it is.
python3 "$here/many_rules.py" 20 1 4..8 >"$scratch/rules.plan"
code=0
"$TARTAN" count "$scratch/rules.plan" -l pruned --max-states 20000 >"$scratch/out" 2>"$scratch/err" || code=$?
is 'the exit code' "$code" 4
grep -q "error\[E0802\]: in the clause \`r[0-9]*\`: the automaton of this library, of its lengths alone, passes the limit of 20000 states" \
    "$scratch/err" || fail 'the limit is not named'
grep -q "help: leave out \`r[0-9]*\`, \`r[0-9]*\` or \`r[0-9]*\`, which multiply the states most, give fewer trays with --trays, or raise the limit with --max-states" \
    "$scratch/err" || fail 'the rules in the way are not named'
finish
