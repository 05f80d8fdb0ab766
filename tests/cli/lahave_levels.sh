#!/usr/bin/env bash
# The levels of the LaHave House in the standard library, and what docs/lahave.md says that they come to.
set -euo pipefail
exec python3 -B tests/cli/lahave_levels.py "$TARTAN"
