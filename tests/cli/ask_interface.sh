#!/usr/bin/env bash
# Needs the parts: draw mesh store
# tartan_ask of the C interface answers what commands write with --json, byte by byte, whatever was asked of the session before; where the command
# refuses, it does, with the same sentence.
name=ask_interface
. "$(dirname "$0")/golden.bash"
program=$(dirname "$TARTAN")/tests/ask_interface
source=$(cd "$here/../.." && pwd)
cd "$source"

requests=()
: >"$scratch/wanted"
# as REQUEST WORDS...: the request asks for what the words of the command do.
as() {
    requests+=("$1")
    shift
    "$TARTAN" count "$file" "$@" --json >"$scratch/one" 2>"$scratch/said" ||
        sed -nE '0,/^(.*: )?error(\[E[0-9]+\])?: /s/^(.*: )?error(\[E[0-9]+\])?: (.*)$/error \3/p' "$scratch/said" | head -n 1 >"$scratch/one"
    cat "$scratch/one" >>"$scratch/wanted"
}
# asked: all requests since the last one, of one session.
asked() {
    "$program" stdlib "$file" count "${requests[@]}" >"$scratch/got"
    diff "$scratch/wanted" "$scratch/got" || fail "$file: the command and the interface differ"
    requests=()
    : >"$scratch/wanted"
}

file=stdlib/lahave-houses.plan
as '{}'
as '{"mirror": true, "no_effects": true, "trays": {"from": 4, "to": 5}}' --mirror --no-effects --trays 4..5
as '{"by": "cost", "trays": {"from": 4, "to": 5}, "values": true}' --by cost --trays 4..5
as '{"by": "cost", "trays": {"from": 4, "to": 5}, "bins": 7}' --by cost --trays 4..5 --bins 7
as '{"by": "cost", "trays": {"from": 4, "to": 5}, "step": "5000"}' --by cost --trays 4..5 --step 5000
as '{"by": "cost", "step": "-1"}' --by cost --step -1
as '{"by": "costs"}' --by costs
as '{"where": ["trays = 4"], "no_effects": true}' --where 'trays = 4' --no-effects
as '{"where": ["trays = 4", "not tray(public)"], "no_effects": true}' --where 'trays = 4' --where 'not tray(public)' --no-effects
as '{"where": ["trays = 4"], "no_effects": true, "mirror": true}' --where 'trays = 4' --no-effects --mirror
as '{"library": "hauses"}' --library hauses
as '{"parts": 2}' --parts 2
as '{"max_states": 3}' --max-states 3
as '{"threads": 3}' --threads 3
asked

file=stdlib/cottage.plan
as '{"library": "cottages"}' --library cottages
as '{"library": "cottages", "clauses": true, "plan": "#10"}' --library cottages --clauses --plan '#10'
as '{"library": "cottages", "plan": "#10", "by": "floor-area", "values": true}' --library cottages --plan '#10' --by floor-area
as '{"library": "cottages", "plan": "#1000000"}' --library cottages --plan '#1000000'
as '{"library": "cottages", "where": ["houses-by-the-sea"]}' --library cottages --where houses-by-the-sea
as '{"plan": "#10", "library": "cottage"}' --plan '#10' --library cottage
asked

file=stdlib/bricks.kit
as '{"parts": 2}' --parts 2
as '{"parts": 2, "fixed": true, "part": ["3001", "3004"]}' --parts 2 --fixed --part 3001 --part 3004
as '{"parts": 2, "part": ["3099999"]}' --parts 2 --part 3099999
as '{}'
as '{"parts": 2, "by": "cost"}' --parts 2 --by cost
asked

# What only requests can get wrong.
wrong() { # REQUEST MESSAGE
    is "$1" "$("$program" stdlib stdlib/terrace.plan count "$1")" "error $2"
}
wrong '{"libary": "street"}' 'a count_request has no `libary`'
wrong '{"library": 3}' "\`library\` is a text: the library's name; needed if the file has more than one"
wrong '{"parts": 33}' '`parts` is from 1 to 32, not 33'
wrong '{"mirror": "yes"}' '`mirror` is true or false: of plans: also one of each pair of plans that mirror each other'
wrong '{"where": "trays = 4"}' '`where` is a list of texts: only plans, or houses, that meet these requirements too, in the words of the file'
wrong '{"trays": {"from": 4}}' 'a tray_range needs `to`: the most trays'
wrong '{"trays": 4}' '`trays` is an object: how many trays a plan has, instead of what the library says'
wrong '{"bins": -3}' '`bins` is a whole number from 0: with `by`: at most so many bins'
wrong '[]' 'the request is no JSON object: it is another value'
is 'another question' "$("$program" stdlib stdlib/terrace.plan cuont '{}')" 'error there is no question `cuont`'
finish
