#!/usr/bin/env bash
# The stdlib passes its own checks and tests, and so do the rule files of the examples.
set -euo pipefail
for file in stdlib/*.plan examples/*/*.plan; do
    "$TARTAN" check --werror "$file"
    if grep -q '^test ' "$file"; then
        "$TARTAN" test "$file" >/dev/null
    fi
done
for file in stdlib/*.bnf stdlib/*.kit; do
    "$TARTAN" check --werror "$file"
done
