#!/usr/bin/env bash
# Takes long.
# The larger of the published numbers that the examples of sequences are held to.
set -euo pipefail
exec python3 -B tests/cli/sequences.py "$TARTAN" --long
