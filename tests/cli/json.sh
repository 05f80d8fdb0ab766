#!/usr/bin/env bash
# Needs the parts: mesh store
# JSON of every command, of names and values that it has to escape: what a strict reader takes (json_strict.py).
# Slow under sanitizers.
set -euo pipefail
: "${TARTAN:?the binary to test}"
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
python3 "$here/json_strict.py" "$TARTAN" "$here/../../cli/commands.def" "$scratch"
