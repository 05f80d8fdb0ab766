#!/usr/bin/env bash
# Takes long: half a minute and 1.5 GB.
# The complete LaHave houses of three to five trays are counted together, within the limits that hold without options.
set -euo pipefail
"$TARTAN" count lahave-complete --library lahave-complete --json | python3 -c '
import json, sys
found = json.load(sys.stdin)
assert found["houses"] == "18609483943040", found["houses"]
assert found["plans"] == "4297728" and found["plans_with_houses"] == "236784", found
assert found["states"] < 1100000, found["states"]
'
