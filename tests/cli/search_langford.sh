#!/usr/bin/env bash
# Needs the parts: search
# Takes long: all rows of eleven numbers, each twice at its distance (Langford pairings), by search, and one of each mirror pair.
name=search_langford
. "$(dirname "$0")/golden.bash"
{
    echo 'schema s { number = n1 | n2 | n3 | n4 | n5 | n6 | n7 | n8 | n9 | n10 | n11 }'
    echo 'library langford using s {'
    echo '  trays 22'
    for ((i = 1; i <= 11; i++)); do
        echo "  require quantity(tray(n$i)) = 2 and neighbour(tray(n$i), repeat(any, $i), tray(n$i))"
    done
    echo '}'
} >"$scratch/eleven.plan"
"$TARTAN" enumerate "$scratch/eleven.plan" --max-states 20 2>/dev/null >"$scratch/all"
is 'plans' "$(wc -l <"$scratch/all")" 35584
is 'different plans' "$(sort -u "$scratch/all" | wc -l)" 35584
is 'kept' "$("$TARTAN" prune "$scratch/eleven.plan" --engine vm <"$scratch/all" | wc -l)" 35584
is 'mirror pairs' "$("$TARTAN" enumerate "$scratch/eleven.plan" --max-states 20 --mirror 2>/dev/null | wc -l)" 17792
finish
