#!/usr/bin/env bash
# Growing against the slow independent reference: its fixtures, and random rewrite systems.
# Slow under sanitizers.
set -euo pipefail
[ -n "${TARTAN_ORACLES:-}" ] && [ -e "$TARTAN_ORACLES/growth/ref.py" ] || exit 77
python3 -B tests/growth_oracle.py "$TARTAN_ORACLES/growth" 150
