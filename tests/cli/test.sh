#!/usr/bin/env bash
# test: passes silently, and says of failures what was expected, of which plan, by which rule.
name=test
. "$(dirname "$0")/golden.bash"

golden passing 'tartan test sheds.plan'
golden failing 'tartan test failing.plan'
golden failing_json 'tartan test failing.plan --diagnostics json'
golden two_files 'tartan test sheds.plan failing.plan 2>/dev/null'
golden module "tartan build sheds.plan -o $scratch/sheds.tnb; tartan test $scratch/sheds.tnb"
golden missing 'tartan test nowhere.plan'
golden todo 'tartan test todo.plan'
golden todo_done 'tartan test todo-done.plan'
golden coverage 'tartan test sheds.plan --coverage --library sheds'
golden coverage_alone 'tartan test todo.plan parts.plan --coverage'
golden coverage_library 'tartan test failing.plan --coverage 2>/dev/null'
golden coverage_json 'tartan test todo.plan failing.plan --coverage --json 2>/dev/null'
golden json 'tartan test sheds.plan --json'
golden coverage_module "tartan build sheds.plan -o $scratch/sheds.tnb; tartan test --coverage $scratch/sheds.tnb"
golden coverage_steps 'tartan test steps.plan --coverage --library bays'
golden coverage_limit 'tartan test parts.plan --coverage --max-states 3'

# What coverage counts is what `count` says where the part is written as one that never matches.
kept() { "$TARTAN" count "$1" --library "$2" --json | sed -n 's/^  "kept": "\([0-9]*\)",$/\1/p'; }
flips() { "$TARTAN" test "$1" --coverage --library "$3" | awk -v part="  $2  " 'index($0, part) { gsub(",", "", $(NF - 1)); print $(NF - 1); exit }'; }
never='(any and not any)'
compare() { # FILE PART LIBRARY: for a part that only ever prunes more
    cp "$1" "$scratch/before.plan"
    sed "s/$(sed 's/[.*()]/[&]/g' <<<"$2")/$never/" "$1" >"$scratch/after.plan"
    is "coverage of $2" "$(flips "$1" "$2" "$3")" "$(($(kept "$scratch/after.plan" "$3") - $(kept "$scratch/before.plan" "$3")))"
}
compare "$files/sheds.plan" 'neighbour(tray(door), tray(door))' sheds
compare "$files/sheds.plan" 'tray(6m)' sheds
compare stdlib/lahave-houses.plan "tray(4', great)" houses
compare stdlib/lahave-houses.plan "tray(4', bay open)" houses
finish
