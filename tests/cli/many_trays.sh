#!/usr/bin/env bash
# Schemas of many trays, which are kept as a diagram, answer as definitions do.
set -euo pipefail
exec python3 -B tests/cli/many_trays.py "$TARTAN"
