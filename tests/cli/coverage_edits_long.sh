#!/usr/bin/env bash
# What coverage says of the changes of larger files is what `diff` and `test` say where they are written out.
name=coverage_edits_long
. "$(dirname "$0")/golden.bash"

for file in stdlib/terrace.plan stdlib/lahave-houses.plan "examples/hospital-ward/ward.plan short-strip"; do
    # shellcheck disable=SC2086 # a file, and perhaps a library
    python3 tests/coverage_edits.py $file >"$scratch/said" 2>&1 || fail "$(tail -n 3 "$scratch/said")"
done
finish
