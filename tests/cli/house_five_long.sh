#!/usr/bin/env bash
# Takes long: five minutes and 4.5 GB.
# The complete LaHave houses of five trays are counted within the limits that hold without options.
set -euo pipefail
"$TARTAN" count lahave-complete --library lahave-complete --trays 5 --json | python3 -c '
import json, sys
found = json.load(sys.stdin)
assert found["houses"] == "19369051570136521811057071936", found["houses"]
assert found["plans"] == "87936000" and found["plans_with_houses"] == "7630616", found
assert found["states"] < 8000000, found["states"]
'
