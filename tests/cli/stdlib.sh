#!/usr/bin/env bash
# The stdlib passes its own checks and tests, and so do the rule files of the examples.
# Slow under sanitizers.
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

# A program that was copied away from its library says so.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$TARTAN" "$folder/tartan"
echo 'use "lahave"' >"$folder/one.plan"
said=$(env -u TARTAN_PATH "$folder/tartan" check "$folder/one.plan" 2>&1) && found=yes || found=no
if [ $found = no ]; then # no library is installed either
    grep -q "set TARTAN_PATH" <<<"$said" || { echo "$said"; exit 1; }
fi
