#!/usr/bin/env bash
# fmt: in place, to standard output, as a difference, as a question; a file with errors is not touched.
name=fmt
. "$(dirname "$0")/golden.bash"

printf 'RULE a=tray(  8'"'"' )# why\nrule b "two"=a\n' >"$scratch/wild.plan"
printf 'rule a = tray(\n' >"$scratch/broken.plan"
cp "$scratch/broken.plan" "$scratch/kept.plan"

golden stdin "tartan fmt - <$scratch/wild.plan"
golden check "tartan fmt --check $scratch/wild.plan sheds.plan"
golden diff "tartan fmt --diff $scratch/wild.plan"
golden diff_json "tartan fmt --check --diagnostics json $scratch/wild.plan"
golden broken "tartan fmt $scratch/broken.plan $scratch/wild.plan"
golden missing 'tartan fmt nowhere.plan'
cmp -s "$scratch/broken.plan" "$scratch/kept.plan" || fail 'a file with errors was changed'
exits 0 "$TARTAN" fmt --check "$scratch/wild.plan"
touch -d '2001-01-01' "$scratch/wild.plan"
exits 0 "$TARTAN" fmt "$scratch/wild.plan"
is 'a formatted file' "$(stat -c %y "$scratch/wild.plan" | cut -c 1-4)" 2001
cd "$here/../.."
exits 0 "$TARTAN" fmt --check stdlib/*.plan examples/*/*.plan bench/*.plan
# What --diff says, patch can do.
if command -v patch >/dev/null; then
    cp tests/cli/files/sheds.plan "$scratch/a.plan"
    cp tests/cli/files/sheds.plan "$scratch/b.plan"
    "$TARTAN" fmt --diff "$scratch/a.plan" | patch -s "$scratch/a.plan" >/dev/null
    "$TARTAN" fmt "$scratch/b.plan"
    cmp -s "$scratch/a.plan" "$scratch/b.plan" || fail 'the difference does not make the formatted file'
fi
finish
