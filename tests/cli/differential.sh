#!/usr/bin/env bash
# Random files, made from the grammar of plans: every question against every other, and against brute forces (tests/differential). This is a
# fixed share; `make search` goes on with other seeds. Small cases of faults that were mended lie in tests/differential/cases.
# Slow under sanitizers.
name=differential
. "$(dirname "$0")/golden.bash"
search=$(cd "$here/../differential" && pwd)

# agrees WHAT COMMAND...: what it prints is shown, and it ends with 0.
agrees() {
    local what=$1
    shift
    python3 -B "$@" || fail "$what: answers differ"
}

agrees 'productions' "$search/reached.py" 400
shopt -s nullglob
for case in "$search"/cases/*.plan; do
    agrees "$(basename "$case")" "$search/search.py" plans "$case"
done
agrees 'plans' "$search/search.py" plans --seeds 36
agrees 'houses' "$search/search.py" houses --seeds 40
finish
