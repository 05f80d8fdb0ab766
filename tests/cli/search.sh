#!/usr/bin/env bash
# Needs the parts: search
# Plans of libraries whose automata pass a limit are found by search: those that the automaton has, in their order.
name=search
. "$(dirname "$0")/golden.bash"

# langford N: each number twice, with as many trays between as it says.
langford() {
    local i numbers=n1
    for ((i = 2; i <= $1; i++)); do numbers+=" | n$i"; done
    printf 'schema s { number = %s }\nlibrary langford using s {\n  trays %d\n' "$numbers" $((2 * $1))
    for ((i = 1; i <= $1; i++)); do
        printf '  require quantity(tray(n%d)) = 2\n  require neighbour(tray(n%d), repeat(any, %d), tray(n%d))\n' $i $i $i $i
    done
    printf '}\n'
}

cd "$scratch"
langford 7 >seven.plan
langford 9 >nine.plan
enumerate() {
    "$TARTAN" enumerate "$@" 2>said
}
enumerate seven.plan --format csv >automaton
[ -s said ] && fail "seven numbers are searched: $(<said)"
enumerate seven.plan --format csv --max-states 20 >searched
grep -q '^note: plans are found by search, since .*passes the limit of 20 states$' said || fail "search is not told: $(<said)"
cmp automaton searched || fail 'search finds other plans'
is 'plans of seven numbers' "$(tail -n +2 searched | wc -l)" 52
enumerate seven.plan --format csv --max-states 20 --threads 1 | cmp - searched || fail 'one thread finds other plans'
enumerate seven.plan --format csv --max-states 20 --threads 4 | cmp - searched || fail 'four threads find other plans'

# Ranks are counted on the way.
enumerate seven.plan --format csv --from 20 --to 23 >automaton
enumerate seven.plan --format csv --from 20 --to 23 --max-states 20 | cmp - automaton || fail 'other plans from rank 20'
enumerate seven.plan --from 52 --max-states 20 >searched
is 'none' "$(<searched)" ''
grep -q 'the library holds 52 plans, none of them from rank 52 on' said || fail "nothing is said of rank 52: $(<said)"
enumerate seven.plan --format csv --mirror >automaton
enumerate seven.plan --format csv --mirror --max-states 20 | cmp - automaton || fail 'other plans of mirror pairs'
is 'mirror pairs' "$(tail -n +2 automaton | wc -l)" 26

# None is proven, and what is found is kept.
is 'none of nine numbers' "$(enumerate nine.plan --max-states 20)" ''
enumerate seven.plan --max-states 20 | "$TARTAN" prune seven.plan --engine vm | cmp - <(enumerate seven.plan) || fail 'some are not kept'

# A clause that is too large for gates is judged plan by plan.
enumerate seven.plan --max-states 20 --max-gates 3000 --limit 2 | cmp - <(enumerate seven.plan --limit 2) || fail 'other plans with few gates'

# Drawn: different plans of the library, the same for the same seed; all of them, if there are no more.
sample() {
    "$TARTAN" sample seven.plan "$@" --max-states 20 2>said
}
sample 20 --seed 4 >drawn
is 'drawn' "$(sort -u drawn | wc -l)" 20
"$TARTAN" prune seven.plan --engine vm <drawn | cmp - drawn || fail 'some that are drawn are not kept'
grep -q 'not each plan is as likely as each' said || fail "nothing is said of likelihood: $(<said)"
sample 20 --seed 4 | cmp - drawn || fail 'the same seed draws others'
sample 20 --seed 5 | cmp -s - drawn && fail 'another seed draws the same'
sample 100 | cmp - <(enumerate seven.plan) || fail 'not all are drawn'
grep -q 'fewer than the 100 asked for' <(sample 100 >/dev/null; cat said) || fail "nothing is said of few: $(<said)"
is 'no ranks' "$(sample 1 --format json | grep -c rank)" 0
sample 1 --format csv >/dev/null && fail 'there are ranks'
grep -q 'error\[E0904\].*their ranks' said || fail "ranks: $(<said)"

# The best, and whether that is proven.
measured() {
    sed 's/^library/measure pairs using s = occurrences(neighbour(tray(n1 or n2 or n3), tray(n4 or n5)))\n&/' "$1"
}
measured seven.plan >measured.plan
for better in --most --least; do
    "$TARTAN" best measured.plan 4 $better pairs | grep '#' | cut -d' ' -f2 >expected
    "$TARTAN" best measured.plan 4 $better pairs --max-states 20 2>said | grep '#' | cut -d' ' -f2 | cmp - expected ||
        fail "other values $better"
    grep -q 'not proven' said && fail "the best are not proven: $(<said)"
done
langford 12 >twelve.plan
measured twelve.plan >measured.plan
"$TARTAN" best measured.plan 1 --most pairs --max-states 20 --max-conflicts 300 2>said >found
grep -q 'it is not proven that these are the best within --max-conflicts: no plan has more than' said ||
    fail "what is not proven is not said: $(<said)"
is 'still a plan' "$(grep -c '|' found)" 1
"$TARTAN" draw seven.plan --sample 3 --max-states 20 -o drawn.svg 2>said || fail "not drawn: $(<said)"
grep -q '3 plans found by search' drawn.svg || fail 'the sheet does not say how its plans were found'

# What plans are nearest, what completes an open plan, trade-offs and edits: as the automaton answers. Random files are asked the same (tests/differential/searched.py).
measured seven.plan | sed 's/^library/measure early using s = occurrences(neighbour(beginning, tray(n1 or n2 or n3)))\n&/' >measured.plan
first=$("$TARTAN" enumerate seven.plan --limit 1)
near() { "$TARTAN" explain seven.plan "n7 | $first" "$@" 2>said || is 'the plan is dropped' $? 1; }
near >expected
near --max-states 2 | cmp - expected || fail 'other plans are nearest'
near --max-states 2 >found
grep -q 'nearest plans are found by search, since .* passes the limit of 2 states' said || fail "search for near plans is not told: $(<said)"
near --max-states 2 --max-conflicts 1 >found
grep -q 'so nearest plans are not known' said || fail "nothing is said of near plans that are not found: $(<said)"

points() { "$TARTAN" pareto measured.plan --most pairs --least early "$@" 2>said | awk '{ print $1, $2 }'; }
points >expected
points --max-states 20 | cmp - expected || fail 'another front by search'
"$TARTAN" pareto measured.plan --most pairs --least early --max-states 20 --json 2>said | grep -q '"proven": true' || fail "the front is not proven: $(<said)"
"$TARTAN" pareto measured.plan --most pairs --least early --max-states 20 -o front.svg 2>said && fail 'a front without counts is drawn'
grep -q 'is not drawn' said || fail "nothing is said of the picture: $(<said)"

complete() { "$TARTAN" complete seven.plan "$@" --max-states 20 2>said; }
"$TARTAN" enumerate seven.plan --where 'plan [... | n7]' >expected
complete '... | n7' | tail -n +2 | cmp - <(head -10 expected) || fail 'other completions'
is 'no completion' "$(complete 'n7 | ? | n7 | ...')" "no plan completes it
plans fit what is written before tray 3, and none of them goes on with it
\`n7\` of tray 3 alone leaves none: its number is something else"
is 'too long' "$(complete 'n7 | ?')" 'no plan completes it
plans begin so, and all have more trays: `| ...` at the end lets them'
complete '? | ...' --most pairs >found && fail 'completions are weighed'

sed 's/^}$/  prune neighbour(beginning, tray(n7))\n}/' seven.plan >edited.plan
"$TARTAN" enumerate seven.plan --where 'neighbour(beginning, tray(n7))' >expected
"$TARTAN" diff seven.plan edited.plan --max-states 20 --sample 9 2>said | sed -n '/removed/,/^$/{/|/p}' | cmp - <(head -10 expected) || fail 'other plans are removed'
"$TARTAN" diff seven.plan edited.plan --max-states 20 2>said | grep -q '^added: none$' || fail 'plans are added'
is 'no difference' "$("$TARTAN" diff nine.plan nine.plan --max-states 20 2>said)" 'langford of nine.plan, nine.plan: the same plans

removed: none

added: none'
"$TARTAN" diff twelve.plan nine.plan --max-states 20 >found 2>said && fail 'libraries of other trays are compared'
grep -q 'E0508' said || fail "other trays: $(<said)"

refused() {
    local code=0
    "$TARTAN" "$@" --max-states 20 >found 2>said || code=$?
    is "$1 ends" $code 4
    grep -q 'note: .*`enumerate`' said || fail "$1 does not say what to ask instead: $(<said)"
}
refused count seven.plan
refused rank seven.plan "$first"
refused unrank seven.plan 3

# As a question, and in files.
enumerate seven.plan --max-states 20 -o plans.sqlite --limit 10
enumerate seven.plan --max-states 20 -o plans.sqlite --resume
is 'resumed' "$(sqlite3 plans.sqlite 'select count(*), max(cast(rank as integer)) from plans')" '52|51'
enumerate seven.plan --max-states 20 -o plans.parquet
cmp <("$TARTAN" prune seven.plan plans.parquet --engine vm) <(enumerate seven.plan) || fail 'Parquet has other plans'

finish
