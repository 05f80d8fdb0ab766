#!/usr/bin/env bash
# Takes long: the same as shards_killed.sh, with 1,000 kills.
set -euo pipefail
exec python3 "$(dirname "$0")/../shards_kill.py" "$TARTAN" "$(dirname "$0")/files/sheds.plan" 1000
