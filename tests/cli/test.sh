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
cat >"$scratch/sums.plan" <<'END'
schema row {
  width = 1m | 2m | 3m
  height = one < two
  zone north = shut | open(1m, 2m)
}
rule long "longer than 2:1" = tray(width > 2 * north depth, height + 1 >= 3)
library rows { trays 1..2  prune long }
test long {
  match  [3m two north open 1m]
  reject [2m two north open 1m]
  reject [3m one north open 1m]
}
END
golden coverage_sums "tartan test $scratch/sums.plan --coverage"
golden coverage_alone 'tartan test todo.plan parts.plan --coverage'
golden coverage_library 'tartan test failing.plan --coverage 2>/dev/null'
golden coverage_json 'tartan test todo.plan failing.plan --coverage --json 2>/dev/null'
golden json 'tartan test sheds.plan --json'
golden coverage_module "tartan build sheds.plan -o $scratch/sheds.tnb; tartan test --coverage $scratch/sheds.tnb"
golden coverage_steps 'tartan test steps.plan --coverage --library bays'
golden coverage_extremes 'tartan test extremes.plan --coverage'
golden coverage_limit 'tartan test parts.plan --coverage --max-states 3'

golden coverage_rules 'for file in cov-prune cov-require-not; do tartan test $file.plan --coverage --json; done'
golden write_tests 'tartan test sheds.plan --write-tests --library sheds'
golden write_tests_none 'tartan test told.plan --write-tests'
golden write_tests_json 'tartan test steps.plan --write-tests --library bays --json'

# What coverage says of a change is what is said of a file in which it is written out; and what it writes tells what it was written for.
for file in "$files/sheds.plan sheds" "$files/steps.plan bays" "$files/extremes.plan" "$files/cov-require-not.plan" examples/narrow-lot/narrow.plan; do
    # shellcheck disable=SC2086 # a file, and perhaps a library
    python3 tests/coverage_edits.py $file >"$scratch/said" 2>&1 || fail "$(tail -n 3 "$scratch/said")"
done
finish
