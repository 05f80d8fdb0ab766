#!/usr/bin/env bash
# Growing against the slow independent reference, on ten times as many random rewrite systems as growth_oracle.sh.
# Takes long: some minutes.
set -euo pipefail
[ -n "${TARTAN_ORACLES:-}" ] && [ -e "$TARTAN_ORACLES/growth/ref.py" ] || exit 77
python3 -B tests/growth_oracle.py "$TARTAN_ORACLES/growth" 1500
