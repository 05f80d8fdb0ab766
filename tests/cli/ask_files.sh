#!/usr/bin/env bash
# Needs the parts: draw mesh store
# Files that questions make through the C interface have the bytes of those that commands write (tests/ask_files.py has the questions).
name=ask_files
. "$(dirname "$0")/golden.bash"
program=$(dirname "$TARTAN")/tests/ask_interface
cd "$here/../.."
"$TARTAN" help --requests schema >"$scratch/schema.json"
schema=$scratch/schema.json
python3 -c 'import jsonschema' 2>/dev/null || schema=
is 'files' "$(python3 tests/ask_files.py "$program" "$TARTAN" ${schema:+"$schema"})" fine
finish
