#!/usr/bin/env bash
# A question that is rows of the table and a function is in the page of questions, in the schema and in the types; `toy.engine` asks it.
set -euo pipefail
fail() {
    echo "$1"
    exit 1
}
"$TARTAN" help --requests page >page
grep -qF '| `twice` | [`twice_request`](#twice_request) | [`doubled`](#doubled) | how many apples two baskets hold |' page || fail 'the page does not list it'
grep -qF '| `number` | number, 0 to 1000 | apples | the number |' page || fail "the page does not have its request's number"
"$TARTAN" help --requests types | grep -qF 'twice: { request: TwiceRequest; answer: Doubled };' || fail 'the types do not have it'
"$TARTAN" help --requests schema | python3 -c '
import json, sys
schema = json.load(sys.stdin)
assert schema["requests"]["twice"] == {"$ref": "#/$defs/twice_request"}
assert schema["$defs"]["twice_request"]["properties"]["number"]["maximum"] == 1000' || fail 'the schema does not have it'
