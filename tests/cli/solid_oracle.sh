#!/usr/bin/env bash
# Random designs of boxes against the slow independent reference.
set -euo pipefail
[ -n "${TARTAN_ORACLES:-}" ] && [ -e "$TARTAN_ORACLES/solid/ref.py" ] || exit 77
python3 -B tests/solid_oracle.py "$TARTAN_ORACLES/solid" 1000
