#!/usr/bin/env bash
# Houses against the slow independent reference: lines, cells, faces, rooms, boxes and roofs of its fixtures.
# Then openings behind lower roofs, in forms drawn at random, which the reference lists.
# A fixed share; the rest is in `make check-long`.
# Slow under sanitizers.
set -euo pipefail
[ -n "${TARTAN_ORACLES:-}" ] && [ -e "$TARTAN_ORACLES/house/house.py" ] || exit 77
python3 -B tests/house_oracle.py "$TARTAN" "$TARTAN_ORACLES" 3
python3 -B tests/house_lower_forms.py "$TARTAN" "$TARTAN_ORACLES" 2
