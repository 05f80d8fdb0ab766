#!/usr/bin/env bash
# new: a file to start from compiles, is formatted, passes its tests, counts, and has no warning; nothing is overwritten.
name=new
. "$(dirname "$0")/golden.bash"

for schema in own lahave terrace; do
    file=$scratch/$schema.plan
    exits 0 "$TARTAN" new "$file" --schema $schema
    exits 0 "$TARTAN" check --werror --test "$file"
    [ ! -s "$scratch/err" ] || fail "$schema: $(cat "$scratch/err")"
    grep -q '^[23] passed, 0 failed$' "$scratch/out" || fail "$schema: no tests: $(cat "$scratch/out")"
    exits 0 "$TARTAN" fmt --check "$file"
    exits 0 "$TARTAN" count "$file"
    grep -q '^ *total  *[1-9]' "$scratch/out" || fail "$schema: no plans"
    cmp -s "$file" <("$TARTAN" new - --schema $schema) || fail "$schema: standard output has another text"
done
cmp -s "$scratch/own.plan" <("$TARTAN" new -) || fail 'own is not the default'

echo mine >"$scratch/mine.plan"
golden exists "tartan new $scratch/mine.plan"
[ "$(cat "$scratch/mine.plan")" = mine ] || fail 'a file was overwritten'
ln -s "$scratch/nowhere.plan" "$scratch/link.plan"
exits 3 "$TARTAN" new "$scratch/link.plan"
golden other_extension "tartan new $scratch/houses.study"
golden no_extension "tartan new $scratch/houses"
golden no_folder "tartan new $scratch/none/houses.plan"
golden unknown_schema "tartan new $scratch/x.plan --schema lahav"
[ ! -e "$scratch/x.plan" ] || fail 'a file was written in spite of a wrong option'
finish
