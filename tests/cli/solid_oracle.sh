#!/usr/bin/env bash
# Random designs of boxes against the slow independent reference; solid_oracle_long.sh begins with the same ones and goes on.
# Slow under sanitizers.
set -euo pipefail
[ -n "${TARTAN_ORACLES:-}" ] && [ -e "$TARTAN_ORACLES/solid/ref.py" ] || exit 77
python3 -B tests/solid_oracle.py "$TARTAN_ORACLES/solid" 300
