#!/usr/bin/env bash
# Random files, made from the grammars of notations: every question against every other, and against brute forces (tests/differential). This
# is a fixed share; `make search` goes on with other seeds. Small cases of faults that were mended lie in tests/differential/cases.
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

# small KIND SUFFIX: the small cases of a kind.
small() {
    local case
    for case in "$search"/cases/*"$2"; do
        agrees "$(basename "$case")" "$search/search.py" "$1" "$case"
    done
}

agrees 'productions' "$search/reached.py" 400
shopt -s nullglob
small plans .plan
small fields .field
small solids .solid
small kits .kit
while read -r kind seeds; do
    agrees "$kind" "$search/search.py" "$kind" --seeds "$seeds" --jobs 2
done <<'SHARES'
plans 12
searched 60
houses 12
fields 6
solids 6
kits 6
pcfg 6
grammars 6
hemls 4
studies 4
SHARES
finish
