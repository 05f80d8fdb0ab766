#!/usr/bin/env bash
# Workers of a shard set and their launchers, killed at 30 random moments: every set ends with the bytes of one enumerate.
# Slow under sanitizers.
set -euo pipefail
exec python3 "$(dirname "$0")/../shards_kill.py" "$TARTAN" "$(dirname "$0")/files/sheds.plan" 30
