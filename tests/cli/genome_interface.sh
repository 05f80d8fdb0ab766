#!/usr/bin/env bash
# The C interface maps, inverts and breeds what the commands do, and has of a stored run what its database has: every grammar of the
# examples and the standard library, and studies that say each setting of breeding. Where a command refuses, the interface does, by the
# same number.
# Needs the parts: draw store
set -euo pipefail
shopt -s nullglob
program=$(dirname "$TARTAN")/tests/genome_interface
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
    echo "genome_interface: $1" >&2
    exit 1
}
number_of() { grep -oE 'error\[E[0-9]+\]' "$1" | head -n 1 | grep -oE 'E[0-9]+'; }

# agree WHAT: the command's answer, or the number of its error, is the interface's.
agree() {
    cmp -s "$work/command" "$work/interface" || fail "$1: $(diff "$work/command" "$work/interface" | head -n 5)"
}

# ---- mapping and inverting: random genomes, short ones, and an empty one
stdlib=$PWD/stdlib
awk 'BEGIN { srand(7); for (g = 0; g < 60; g++) { n = g == 0 ? 0 : 1 + int(rand() * (g < 10 ? 6 : 300)); s = "";
    for (i = 0; i < n; i++) s = s (i ? " " : "") sprintf("%.0f", int(rand() * (g % 5 ? 1000 : 4294967296))); print s == "" ? "0" : s } }' >"$work/genomes"
cat >"$work/odd.bnf" <<'X'
%wraps 1
%max-depth 9
<a> ::= "" | <b><a> | x<c>
<b> ::= GE_RANGE:3 | "say \"" <c> "\""
<c> ::= y | y | <a>
X
printf '%%dialect ge\n%%mapping position-independent\n<e> ::= (<e>+<e>) | x | y\n' >"$work/places.bnf"
grammars=("$stdlib"/*.bnf examples/*/*.bnf "$work"/*.bnf)
inverted=0 refused=0
for grammar in "${grammars[@]}"; do
    "$TARTAN" map "$grammar" --genomes "$work/genomes" 2>/dev/null | sed 's/; repaired with.*//' >"$work/command" || fail "$grammar is not mapped"
    "$program" "$stdlib" map "$grammar" <"$work/genomes" >"$work/interface" || fail "the interface does not map $grammar: $(tail -n 1 "$work/interface")"
    agree "mapping by $grammar"
    grep -v '^#' "$work/command" | awk 'length($0) < 60' | sort -u | head -n 3 >"$work/sentences"
    echo 'not a sentence of any grammar here' >>"$work/sentences"
    while IFS= read -r sentence; do
        if "$TARTAN" map "$grammar" --invert "$sentence" >"$work/command" 2>"$work/errors"; then
            inverted=$((inverted + 1))
        else
            number_of "$work/errors" >"$work/command" || fail "$grammar, $sentence: $(cat "$work/errors")"
            refused=$((refused + 1))
        fi
        "$program" "$stdlib" invert "$grammar" "$sentence" >"$work/interface" || true
        agree "inverting \`$sentence\` by $grammar"
    done <"$work/sentences"
done
[ $inverted -ge 10 ] && [ $refused -ge 10 ] || fail "$inverted were inverted and $refused refused: the test compares too little"

# ---- breeding: the examples' studies with a text to match for a problem, and every setting of breeding
compared=0
compare() { # NAME GENERATIONS: of the study $work/NAME.study, which matches "hello"
    (cd "$work" && "$TARTAN" evolve "$1.study" -o "$1.run" -g "$2" >out 2>errors) || fail "$1: $(cat "$work/errors" "$work/$1.study")"
    tail -n +2 "$work/$1.run/stats.csv" | cut -d , -f 1-12 >"$work/command"
    local made=$(($(wc -l <"$work/command") - 1))
    sed -n '2s/^1.txt,\([0-9]*\),.*/\1/p' "$work/$1.run/best/scores.csv" | tr '\n' ' ' >>"$work/command"
    cat "$work/$1.run/best/1.txt" >>"$work/command"
    "$program" "$stdlib" breed "$work/$1.study" hello "$made" >"$work/interface" || fail "the interface does not breed $1: $(tail -n 1 "$work/interface")"
    agree "breeding $1"
    cut -d , -f 1-12 "$work/$1.run/stats.csv" | tail -n +2 >"$work/command"
    sqlite3 -separator '|' "$work/$1.run/run.sqlite" 'SELECT generation, kind, text FROM event ORDER BY generation, number' >>"$work/command"
    for name in study_path study grammar_path grammar seed objectives; do
        printf '%s: %s\n' "$name" "$(sqlite3 "$work/$1.run/run.sqlite" "SELECT value FROM meta WHERE key = '$name'"; echo .)" | sed '$d' >>"$work/command"
    done
    "$program" "$stdlib" run "$work/$1.run/run.sqlite" >"$work/interface" || fail "the interface does not read $1.run"
    sed -i '$!b;s/$//' "$work/interface"
    agree "the run of $1"
    compared=$((compared + 1))
}
for study in examples/*/*.study; do
    grep -q '^ *grammar ' "$study" || continue
    name=$(basename "$(dirname "$study")")-$(basename "$study" .study)
    cp "$(dirname "$study")"/*.bnf "$work" 2>/dev/null || true
    sed -E 's/^( *)(fit|grow|build|place|keep) .*/\1match "hello"/; /^ *(drop|schema|test|error|scaling|fitness|stop|length-weight|seeds|program-.*) /d; s/^( *population) .*/\1 40/
        s/^( *selection) (nsga2|.*lexicase).*/\1 tournament 3/' "$study" | sed -n '/^evolution/,/^}/p' >"$work/$name.study"
    compare "$name" 3
done
[ $compared -ge 4 ] || fail "there are hardly any studies that breed by a grammar"
number=0
while IFS= read -r settings; do
    number=$((number + 1))
    printf 'evolution {\n  grammar "words"\n  match "hello"\n  population 40\n  seed 11\n  %s\n}\n' "${settings//;/$'\n' }" >"$work/own$number.study"
    compare "own$number" 8
done <<'X'
initialise random; codons 30; wraps 3
initialise grow; depth 4..7; tail 0
initialise pi-grow; depth 3..8; max-depth 9
crossover subtree 0.9; mutation subtree 0.4; tree-depth 6
crossover two-point 0; mutation codons 0
crossover fixed-one-point; mutation genome 3; points anywhere
crossover fixed-two-point 1; codon-limit 50; max-codons 60
selection truncation 0.3; elites 0
selection roulette; elites 4; copies kept
replacement steady-state; selection tournament 5
mapping position-independent
islands 4; migrate 2 every 3
islands 2; max-steps 40
X
