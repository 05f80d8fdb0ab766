#!/usr/bin/env bash
# The functions of docs/c-interface.md are as the headers have them, each with a sentence.
tools/c-interface-page | diff -u docs/c-interface.md - || {
    echo 'Run: tools/c-interface-page >page && mv page docs/c-interface.md'
    exit 1
}
