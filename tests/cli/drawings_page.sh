#!/usr/bin/env bash
# docs/drawings.md is as commands draw, as their help has it, and as the tables of layers, papers and scales say.
# Needs the parts: draw mesh
set -o pipefail
tools/drawings-page "$TARTAN" | diff -u docs/drawings.md - || {
    echo 'Run: tools/drawings-page build/tartan >docs/drawings.md'
    exit 1
}
