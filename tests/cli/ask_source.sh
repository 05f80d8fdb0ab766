#!/usr/bin/env bash
# Needs the parts: draw mesh store
# check and format as questions of the C interface say what the commands do (tests/ask_source.py has the questions).
name=ask_source
. "$(dirname "$0")/golden.bash"
program=$(dirname "$TARTAN")/tests/ask_interface
cd "$here/../.."
"$TARTAN" help --requests schema >"$scratch/schema.json"
schema=$scratch/schema.json
python3 -c 'import jsonschema' 2>/dev/null || schema=
is 'sources' "$(python3 tests/ask_source.py "$program" "$TARTAN" ${schema:+"$schema"})" fine
printf 'rule a = tray(\n' >"$scratch/broken.plan"
is 'no text' "$("$program" stdlib tests/cli/files/sheds.plan format '{"no_text": true}')" '{"same":true}'
is 'syntax errors' "$("$program" stdlib "$scratch/broken.plan" format '{}' | cut -c1-6)" 'error '
finish
