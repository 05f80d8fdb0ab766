#!/usr/bin/env bash
# Houses against the slow independent reference, all of them.
# Takes long.
set -euo pipefail
[ -n "${TARTAN_ORACLES:-}" ] && [ -e "$TARTAN_ORACLES/house/house.py" ] || exit 77
python3 -B tests/house_oracle.py "$TARTAN" "$TARTAN_ORACLES"
