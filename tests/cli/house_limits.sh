#!/usr/bin/env bash
# Libraries of houses that take much work: what is said where they pass a limit, and of very many houses.
# Slow under sanitizers.
name=house_limits
. "$(dirname "$0")/golden.bash"

{
    printf 'schema s { width = 8'"'"'\n zone body = open(8'"'"') }\nform f of s {\n'
    for ((i = 0; i < 40; i++)); do printf '  storey s%s 9'"'"'\n' "$i"; done
    printf "  wall 6\" partition 4\" deck 1' roof 10\"\n"
    for ((i = 0; i < 200; i++)); do printf '  function f%s at cell(body)\n' "$i"; done
    printf '}\nlibrary rows using s { trays 1..1 }\nlibrary tall from rows in f { }\n'
} >"$scratch/city.plan"
golden too_many_together "tartan count $scratch/city.plan --library tall"
golden too_many_steps "tartan count $scratch/city.plan --library tall --plan '#0'"
golden relations_limit 'tartan check lahave-few.plan --relations --max-states 12000'
# Long numbers stay apart from those beside them.
golden count_wide "tartan count apartments --library apartments --plan '#0' --clauses | sed -n '/without/,\$p'"
finish
