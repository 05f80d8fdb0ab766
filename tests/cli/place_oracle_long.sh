#!/usr/bin/env bash
# Many random connection grammars against the slow independent model.
# Takes long: some minutes.
set -euo pipefail
[ -n "${TARTAN_ORACLES:-}" ] && [ -e "$TARTAN_ORACLES/place/model.py" ] || exit 77
python3 -B tests/place_oracle.py "$TARTAN_ORACLES/place/model.py" "$TARTAN" 1000 2000
