#!/usr/bin/env bash
# Needs the parts: mesh store
# What `tartan help --requests` says of the questions: docs/requests.md is its page, answers follow its schema, and nothing else does.
name=requests
. "$(dirname "$0")/golden.bash"
source=$(cd "$here/../.." && pwd)

"$TARTAN" help --requests page | diff -u "$source/docs/requests.md" - || fail 'run: tartan help --requests page >docs/requests.md'
# A question has a command of its name, or the error about that name says which command asks it.
for question in $(sed -n 's/^TN_QUESTION(\([a-z_]*\),.*/\1/p' "$source/ask/session/requests.def"); do
    "$TARTAN" help "$question" >/dev/null 2>&1 || { "$TARTAN" "$question" 2>&1 || true; } | grep -q 'that is what `tartan' ||
        fail "no command is found by the name of the question $question"
done
golden unknown 'tartan help --requests graph'
golden nothing 'tartan help --requests'
python3 -c 'import jsonschema' 2>/dev/null || {
    echo 'skipped: python3-jsonschema is not here'
    exit 77
}
"$TARTAN" help --requests schema >"$scratch/schema.json"
is 'answers by the schema' "$(python3 "$here/../requests.py" "$TARTAN" "$scratch/schema.json")" fine
finish
