#!/usr/bin/env bash
# count: exact numbers, for people and as JSON.
name=count
. "$(dirname "$0")/golden.bash"

golden text 'tartan count sheds.plan --library sheds'
golden mirror 'tartan count sheds.plan --library sheds --mirror'
golden json 'tartan count sheds.plan --library sheds --json --mirror | sed "s/\"hash\": \"[0-9a-f]*\"/\"hash\": \"HASH\"/"'
golden no_effects 'tartan count sheds.plan --library sheds --no-effects'
golden no_effects_json 'tartan count sheds.plan --library sheds --no-effects --json | sed "s/\"hash\": \"[0-9a-f]*\"/\"hash\": \"HASH\"/"'
golden no_rules 'tartan count sheds.plan --library any-sheds'
golden trays 'tartan count sheds.plan --library sheds --trays 40..42'
golden state_limit 'tartan count sheds.plan --library sheds --max-states 1'
golden length_limit 'tartan count sheds.plan --library sheds --trays 1..9 --max-length 8'

field() {
    python3 -c 'import json,sys; print(json.load(sys.stdin)[sys.argv[1]])' "$1"
}
is 'kept' "$("$TARTAN" count "$files/sheds.plan" -l sheds --json | field kept)" "$("$TARTAN" enumerate "$files/sheds.plan" -l sheds | wc -l)"
is 'up to mirror' "$("$TARTAN" count "$files/sheds.plan" -l sheds --json --mirror | field mirror)" \
    "$("$TARTAN" enumerate "$files/sheds.plan" -l sheds --mirror | wc -l)"
is 'any sheds' "$("$TARTAN" count "$files/sheds.plan" -l any-sheds --json | field kept)" 21
"$TARTAN" build "$files/sheds.plan" -o "$scratch/sheds.tnb"
is 'a module counts as its source' "$("$TARTAN" count "$scratch/sheds.tnb" -l sheds --json)" "$("$TARTAN" count "$files/sheds.plan" -l sheds --json)"
finish
