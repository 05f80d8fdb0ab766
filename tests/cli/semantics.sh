#!/usr/bin/env bash
# The corners of the language that tests/plan decides by hand.
set -euo pipefail
"$TARTAN" check --werror tests/plan/*.plan
"$TARTAN" test tests/plan/*.plan >/dev/null
