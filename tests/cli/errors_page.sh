#!/usr/bin/env bash
# docs/errors.md is what the table of diagnostics says.
set -euo pipefail
python3 tools/errors-page runtime/base/codes.def tests/diagnostics | diff -u docs/errors.md - || {
    echo 'Run: tools/errors-page runtime/base/codes.def tests/diagnostics >docs/errors.md'
    exit 1
}
