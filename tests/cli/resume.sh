#!/usr/bin/env bash
# Needs the parts: store
# A database that is killed while it is written goes on with --resume: nothing twice, nothing missing.
# Slow under sanitizers.
name=resume
. "$(dirname "$0")/golden.bash"
command -v sqlite3 >/dev/null || exit 77

enumerate=("$TARTAN" enumerate "$files/sheds.plan" -l any-sheds --trays 0..9)
contents() { # values as SQL writes them, so that 1 and '1' differ
    local table
    sqlite3 "$1" "select name from sqlite_master where type = 'table' order by name" | while read -r table; do
        sqlite3 -cmd '.mode quote' "$1" "select * from \"$table\" order by 1"
    done
}
"${enumerate[@]}" -o "$scratch/whole.sqlite"
contents "$scratch/whole.sqlite" >"$scratch/whole"
[ "$(wc -l <"$scratch/whole")" -gt 349525 ] || fail 'the database lacks plans'

broken=0
for attempt in 'KILL 0.05' 'KILL 0.2' 'TERM 0.1' 'KILL 0.4'; do
    read -r signal delay <<<"$attempt"
    rm -f "$scratch/part.sqlite"*
    "${enumerate[@]}" -o "$scratch/part.sqlite" 2>/dev/null &
    pid=$!
    sleep "$delay"
    if kill -"$signal" "$pid" 2>/dev/null; then
        broken=$((broken + 1))
    fi
    wait "$pid" 2>/dev/null || true
    "${enumerate[@]}" -o "$scratch/part.sqlite" --resume 2>/dev/null || fail "cannot resume after SIG$signal at ${delay}s"
    contents "$scratch/part.sqlite" | cmp -s - "$scratch/whole" || fail "another database after SIG$signal at ${delay}s"
done
[ "$broken" -gt 0 ] || echo 'note: every run ended before it was killed'

# Houses, too: also where the limit ended it, and not with another requirement.
houses=("$TARTAN" enumerate "$files/cabins.plan" -l cottages --trays 2..3 --from 1000 --to 260000)
"${houses[@]}" -o "$scratch/whole.sqlite"
contents "$scratch/whole.sqlite" >"$scratch/whole"
rm -f "$scratch/part.sqlite"*
"${houses[@]}" -o "$scratch/part.sqlite" 2>/dev/null &
pid=$!
sleep 0.7
kill -KILL "$pid" 2>/dev/null || true
wait "$pid" 2>/dev/null || true
"${houses[@]}" -o "$scratch/part.sqlite" --limit 150000 --resume 2>/dev/null || fail 'cannot resume houses'
"${houses[@]}" -o "$scratch/part.sqlite" --resume 2>/dev/null || fail 'cannot go on with houses'
contents "$scratch/part.sqlite" | cmp -s - "$scratch/whole" || fail 'other houses after a kill'
is 'houses in the database' "$(wc -l <"$scratch/whole")" $((259000 + 10))
exits 1 "${houses[@]}" --where 'cell(kitchen)' -o "$scratch/part.sqlite" --resume

# Nothing is left of a file whose writer was killed, where the system has files without a name.
if python3 -c 'import os, sys; os.close(os.open(sys.argv[1], os.O_TMPFILE | os.O_WRONLY))' "$scratch" 2>/dev/null; then
    mkdir "$scratch/folder"
    "$TARTAN" enumerate "$files/sheds.plan" -l any-sheds --trays 0..20 --limit 5000000 -o "$scratch/folder/x.csv" &
    pid=$!
    sleep 0.1
    kill -KILL "$pid"
    wait "$pid" 2>/dev/null || true
    is 'files after SIGKILL' "$(ls -A "$scratch/folder")" ''
fi

# Another library, or another stretch of it, is not gone on with.
exits 1 "$TARTAN" enumerate "$files/sheds.plan" -l sheds -o "$scratch/part.sqlite" --resume
exits 1 "${enumerate[@]}" --from 5 -o "$scratch/part.sqlite" --resume
finish
