#!/usr/bin/env bash
# check: what rules mean. (What is wrong with their text: diagnostics.sh and build.sh.)
name=check
. "$(dirname "$0")/golden.bash"

cat >"$scratch/odd.plan" <<'PLAN'
schema s { door = flag }
rule all = tray(door) or not tray(door)
PLAN
golden relations 'tartan check relations.plan --relations'
golden relations_limit 'tartan check relations.plan --relations --max-states 20'
golden examples "tartan check $scratch/odd.plan --relations; tartan check sheds.plan --relations --examples"
golden relations_json 'tartan check sheds.plan --relations --examples --json'
golden warning "tartan check $scratch/odd.plan"
golden warning_json "tartan check --diagnostics=json $scratch/odd.plan"
golden werror "tartan check --werror $scratch/odd.plan"
golden no_analysis "tartan check --werror --no-analysis $scratch/odd.plan"
golden no_relations_without_analysis 'tartan check sheds.plan --relations --no-analysis'
golden examples_without_relations 'tartan check sheds.plan --examples'
golden several_files "tartan check sheds.plan rows.plan --count"
printf '# a tape\n_0 const 2.95\n_1 var-x\n_2 mul _1 _0\n' >"$scratch/tape.vm"
golden other_ending "tartan check $scratch/tape.vm"
# A name that is not UTF-8 is written so into modules that they can be read.
printf 'schema s { door = flag }\nrule r = tray(door)\n' >"$scratch/"$'h\xfctte.plan'
exits 0 "$TARTAN" check "$scratch/"$'h\xfctte.plan'
exits 0 "$TARTAN" build "$scratch/"$'h\xfctte.plan' -o "$scratch/named.tnb"
"$TARTAN" disasm "$scratch/named.tnb" | grep -q 'h?tte.plan' || fail 'a module does not name its source'
golden library_alone "tartan check sheds.plan --library rows"
golden relations_and_count "tartan check sheds.plan --relations --count"

# Several questions in one run are answered as each by itself is, in that order.
sed "s/n in 1..3)/n in 1..2)/" "$here/../../stdlib/lahave-houses.plan" >"$scratch/edited.plan"
"$TARTAN" check "$scratch/edited.plan" --test --count --diff lahave-houses >"$scratch/together" 2>"$scratch/together.said" || true
for question in "check $scratch/edited.plan" "test $scratch/edited.plan" "count $scratch/edited.plan" "diff --no-measures lahave-houses $scratch/edited.plan"; do
    # shellcheck disable=SC2086
    "$TARTAN" $question || true
done >"$scratch/apart" 2>"$scratch/apart.said"
cmp -s "$scratch/together" "$scratch/apart" || fail 'several questions at once have other answers'
cmp -s "$scratch/together.said" "$scratch/apart.said" || fail 'several questions at once say something else'
grep -q 'only by it' "$scratch/together" || fail 'nothing was counted'

golden relations_of_two 'tartan check sheds.plan rows.plan --relations'

# A module says nothing of what its author allows: it has relations, but no warnings.
"$TARTAN" build "$scratch/odd.plan" -o "$scratch/odd.tnb" 2>/dev/null
exits 0 "$TARTAN" check --werror "$scratch/odd.tnb"
cmp -s <("$TARTAN" check --relations "$files/sheds.plan") \
    <("$TARTAN" build "$files/sheds.plan" -o "$scratch/sheds.tnb" && "$TARTAN" check --relations "$scratch/sheds.tnb") ||
    fail 'a module has other relations than its source'

# The same at any number of threads.
for threads in 1 2 5; do
    "$TARTAN" check --threads "$threads" --relations --examples stdlib/lahave-houses.plan >"$scratch/$threads" 2>&1
    cmp -s "$scratch/1" "$scratch/$threads" || fail "$threads threads find something else"
done
finish
