#!/usr/bin/env bash
# The counts and the numbers of states that are known for tests/plan/known.plan, from two independent programs.
set -euo pipefail
"$TARTAN" count --json tests/plan/known.plan | python3 -c '
import json, sys
known = [72, 6592, 1306112, 231268352, 40242053120, 7005086679040, 1224736518438912, 214889984585367552, 37795440232304214016,
         6656474744531514818560, 1172963314647629576536064, 206689117482878778342375424]
found = json.load(sys.stdin)
assert [int(row["kept"]) for row in found["by_length"]] == known, found["by_length"]
assert [int(row["generated"]) for row in found["by_length"]] == [192 ** n for n in range(1, 13)]
assert [row["length"] for row in found["by_length"]] == list(range(1, 13))
assert int(found["kept"]) == sum(known) and int(found["pruned"]) == int(found["generated"]) - sum(known)
assert found["states"] == 44, found["states"]
assert [(rule["name"], rule["states"]) for rule in found["rules"]] == [
    ("narrow-pair", 3), ("dense-end", 4), ("thin-totem", 4), ("stranded", 6)], found["rules"]
'
