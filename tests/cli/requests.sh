#!/usr/bin/env bash
# Needs the parts: draw mesh store
# What `tartan help --requests` says of the questions: docs/requests.md is its page, answers follow its schema, and nothing else does.
name=requests
. "$(dirname "$0")/golden.bash"
source=$(cd "$here/../.." && pwd)

"$TARTAN" help --requests page | diff -u "$source/docs/requests.md" - || fail 'run: tartan help --requests page >docs/requests.md'
golden unknown 'tartan help --requests graph'
golden nothing 'tartan help --requests'
python3 -c 'import jsonschema' 2>/dev/null || {
    echo 'skipped: python3-jsonschema is not here'
    exit 77
}
"$TARTAN" help --requests schema >"$scratch/schema.json"
is 'answers by the schema' "$(python3 "$here/../requests.py" "$TARTAN" "$scratch/schema.json")" fine
finish
