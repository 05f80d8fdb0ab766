#!/usr/bin/env bash
# docs/errors.md is what the table of diagnostics says.
set -euo pipefail
python3 tools/errors-page compiler/codes.def | diff -u docs/errors.md - || {
    echo 'Run: tools/errors-page compiler/codes.def >docs/errors.md'
    exit 1
}
