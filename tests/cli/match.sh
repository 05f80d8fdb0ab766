#!/usr/bin/env bash
# match: formats, chosen rules, engines, threads, bad lines, and all ways to give plans.
name=match
. "$(dirname "$0")/golden.bash"

cat >"$scratch/plans" <<'PLANS'
# a comment, and an empty plan below

3m door
3m door | 6m door
6m - | 3m door | 3m door
3m - | 3m -
PLANS
printf '3m door\n3m dor\n4m -\n6m - | 3m -\n' >"$scratch/bad"

golden names "tartan match sheds.plan $scratch/plans"
golden bits "tartan match sheds.plan $scratch/plans --format bits"
golden any "tartan match sheds.plan $scratch/plans --format any"
golden json "tartan match sheds.plan $scratch/plans --format json"
golden one_rule "tartan match sheds.plan $scratch/plans --rule wide-end --format bits"
golden order_of_rules "tartan match sheds.plan $scratch/plans --rule wide-end --rule door-pair --format bits"
golden imported_rules "tartan match failing.plan $scratch/plans --format bits"
golden standard_input "printf '3m door | 3m door\n' | tartan match sheds.plan"
golden bad_plan_stops "tartan match sheds.plan $scratch/bad --format bits"
golden bad_plan_skipped "tartan match sheds.plan $scratch/bad --format bits --on-error skip"
golden bad_plan_json "tartan match sheds.plan $scratch/bad --diagnostics=json --on-error skip"
golden fallback "tartan match sheds.plan $scratch/plans --format bits --max-states 1"
golden dfa_limit "tartan match sheds.plan $scratch/plans --format bits --max-states 1 --engine dfa"
golden missing_file 'tartan match sheds.plan nowhere.txt'
echo 'use "lahave"' >"$scratch/none.plan"
golden no_rules "tartan match $scratch/none.plan $scratch/plans"
golden no_schema "tartan draw /dev/null $scratch/plans -o $scratch/x.svg"
cp "$scratch/plans" "$scratch/houses.plans"
golden near_file "tartan match sheds.plan $scratch/hovses.plans"

# A file is written whole or not at all; skipping a bad plan is the author's own wish.
exits 1 "$TARTAN" match "$files/sheds.plan" "$scratch/bad" -o "$scratch/answers"
[ ! -e "$scratch/answers" ] || fail 'half a file of answers'
exits 1 "$TARTAN" match "$files/sheds.plan" "$scratch/bad" -o "$scratch/answers" --on-error skip
is 'answers to good plans' "$(wc -l <"$scratch/answers")" 2

# Thousands of plans, in order, whatever the engine and the number of threads; from a module too.
"$TARTAN" enumerate "$files/sheds.plan" --library any-sheds --trays 0..7 --limit 20000 >"$scratch/many"
"$TARTAN" match "$files/sheds.plan" "$scratch/many" --format bits --engine vm --threads 1 >"$scratch/one"
is 'plans answered' "$(wc -l <"$scratch/one")" 20000
"$TARTAN" build "$files/sheds.plan" -o "$scratch/sheds.tnb"
for threads in 1 2 7; do
    for rules in "$files/sheds.plan" "$scratch/sheds.tnb"; do
        "$TARTAN" match "$rules" "$scratch/many" --format bits --engine dfa --threads $threads | cmp -s - "$scratch/one" ||
            fail "$threads threads of automata differ from the interpreter ($rules)"
    done
done

# Whether any rule matches is what all of them say, by the automaton of their union, by those of each, and interpreted.
sed 's/.*1.*/1/; t; s/.*/0/' "$scratch/one" >"$scratch/some"
is 'plans that some rule matches, and that none does' "$(sort -u "$scratch/some" | wc -l)" 2
for how in '--engine dfa' '--engine vm' '--max-states 8' '--threads 7'; do
    "$TARTAN" match "$files/sheds.plan" "$scratch/many" --format any $how 2>/dev/null | cmp -s - "$scratch/some" || fail "any by $how"
done

# What a person gives by mistake for a list of plans.
printf '  0\r\nSECTION\r\n  2\r\nHEADER\r\n' >"$scratch/drawing.dxf"
printf 'ISO-10303-21;\nHEADER;\n' >"$scratch/house.ifc"
printf '%%PDF-1.7\n' >"$scratch/page.pdf"
printf '0\n' >"$scratch/zero"
for file in drawing.dxf house.ifc page.pdf zero; do
    golden "mistaken_$file" "tartan match sheds.plan $scratch/$file"
done
golden comma_between "echo \"6m door, 3m door\" | tartan match sheds.plan"
finish
