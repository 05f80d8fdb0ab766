#!/usr/bin/env bash
# Needs the parts: store
# Grammars made to explode: checking, mapping, inverting and evolving them ends, within limits that are told.
name=hostile_grammars
. "$(dirname "$0")/golden.bash"
cd "$scratch" || exit 1

{
    echo '<s> ::= <a0>'
    for i in $(seq 0 59); do echo "<a$i> ::= <a$((i + 1))><a$((i + 1))>"; done
    echo '<a60> ::= x | y'
} >doubling.bnf
echo '<e> ::= <e> + <e> | <e> * <e> | x' >left.bnf
echo '<s> ::= <s><s> | <s><s><s> | "" | x' >ambiguous.bnf
awk 'BEGIN { printf "<s> ::= v <t>\n<t> ::= w"; for (i = 0; i < 60000; i++) printf " | w%d", i; print "" }' >many.bnf
awk 'BEGIN {
    printf "%%dialect genr8\n%%repair off\n%%max-depth 4\n<s> ::= <t> { <t> }\n<t> ::= w"
    for (i = 0; i < 30000; i++) printf " | w%d | v%d <t>", i, i
    print ""
}' >closed.bnf
{ printf '<s> ::= <t><s> | <t>\n<t> ::= '; head -c 20000 /dev/zero | tr '\0' x; echo; } >long.bnf

for grammar in doubling left ambiguous many closed long; do
    "$TARTAN" check "$grammar.bnf" >/dev/null 2>check.err || fail "$grammar does not check: $(cat check.err)"
    "$TARTAN" map "$grammar.bnf" --random 20 --seed 1 --format json >map.out || fail "$grammar does not map"
    is "$grammar: genomes mapped" "$(wc -l <map.out)" 20
    printf 'evolution {\n grammar "%s.bnf"\n match "xx + xx"\n population 20\n generations 2\n crossover subtree 0.9\n' "$grammar" >run.study
    printf ' mutation subtree 0.5\n max-steps 20000\n}\n' >>run.study
    "$TARTAN" evolve run.study -o "$grammar.run" >evolve.out 2>&1 || fail "$grammar does not evolve: $(head -n 3 evolve.out | cut -c 1-200)"
    grep -q '^2 generations' evolve.out || fail "$grammar was not evolved to the end"
done

# refuses LIMIT SENTENCE OPTION...: inverting passes a limit, which is told with the option that raises it.
refuses() {
    local code=0
    "$TARTAN" map ambiguous.bnf --invert "$2" "${@:3}" >/dev/null 2>err || code=$?
    is "exit code of --invert" "$code" 4
    grep -q "$1" err || fail "the limit is not told: $(cat err)"
    grep -q -e '--max-items' err || fail "nothing says how to raise it: $(cat err)"
}
letters=$(head -c 120 /dev/zero | tr '\0' x)
refuses '1000 parser states' "$letters" --max-items 1000
refuses '1216000 steps' "$letters" --max-items 38000
"$TARTAN" map ambiguous.bnf --invert "$letters" >/dev/null || fail 'an ambiguous sentence cannot be inverted'
finish
