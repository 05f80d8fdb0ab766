#!/usr/bin/env bash
# schema: what a rule file has, as text and as JSON; of a module all but what is forbidden.
name=schema
. "$(dirname "$0")/golden.bash"

golden text 'tartan schema sheds.plan'
golden houses 'tartan schema cottage'
golden used 'tartan schema cottage --used'
golden json 'tartan schema sheds.plan --json'
golden weights 'tartan schema market.plan'
golden weights_json 'tartan schema market.plan --json | sed -n "/lively/,/^    }/p"'
golden no_schema 'tartan schema koch'
golden two_files 'tartan schema sheds.plan rows.plan'
"$TARTAN" build "$files/sheds.plan" -o "$scratch/sheds.tnb"
"$TARTAN" schema "$files/sheds.plan" | grep -v '^  forbid' >"$scratch/wanted"
"$TARTAN" schema "$scratch/sheds.tnb" | diff "$scratch/wanted" - || fail 'a module says something else'
finish
