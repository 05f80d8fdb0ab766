#!/usr/bin/env bash
# Slow under sanitizers.
# The examples of sequences have the numbers that are published.
set -euo pipefail
exec python3 -B tests/cli/sequences.py "$TARTAN"
