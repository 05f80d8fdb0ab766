#!/usr/bin/env bash
# Random files, made from the grammar of plans: every question against every other and against brute forces (tests/differential). `make search`
# goes on with other seeds. Small cases of faults that were mended lie in tests/differential/cases.
# Slow under sanitizers.
name=differential
. "$(dirname "$0")/golden.bash"
search=$(cd "$here/../differential" && pwd)

is 'every production is reached' "$(python3 -B "$search/reached.py" 400 | tail -n 1 | sed 's/^[0-9]* of [0-9]*/all/')" 'all productions in 400 files of each kind'
is 'cases that were mended' "$(python3 -B "$search/search.py" plans "$search"/cases/*.plan | tail -n 1 | sed 's/.*, //')" '0 differences'
for kind in plans houses; do
    python3 -B "$search/search.py" "$kind" --seeds 25 >"$scratch/$kind"
    is "answers about $kind agree" $? 0
    cat "$scratch/$kind"
done
