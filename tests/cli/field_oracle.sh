#!/usr/bin/env bash
# Meshes of fields against the slow independent reference: random expressions of all operations.
# Slow under sanitizers.
set -euo pipefail
[ -n "${TARTAN_ORACLES:-}" ] && [ -e "$TARTAN_ORACLES/field/contour.py" ] || exit 77
python3 -B tests/field_oracle.py "$TARTAN_ORACLES/field" 40
