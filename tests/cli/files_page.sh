#!/usr/bin/env bash
# docs/files.md is as the table of endings and the help of commands have it.
# Needs the parts: mesh store
tools/files-page "$TARTAN" | diff -u docs/files.md - || {
    echo 'Run: tools/files-page build/tartan >docs/files.md'
    exit 1
}
