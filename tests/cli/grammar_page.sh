#!/usr/bin/env bash
# docs/plan-grammar.md is the grammar that the program reads by.
set -euo pipefail
python3 tools/grammar-page grammar/plan.y | diff -u docs/plan-grammar.md - || {
    echo 'Run: tools/grammar-page grammar/plan.y >docs/plan-grammar.md'
    exit 1
}
