#!/usr/bin/env bash
# Needs the parts: draw mesh store
# Slow under sanitizers.
# The examples in the README, the docs and the worked studies do what these say.
set -euo pipefail
exec python3 tests/docs.py README.md docs/*.md examples/*/README.md
