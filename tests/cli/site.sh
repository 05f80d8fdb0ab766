#!/usr/bin/env bash
# The documentation as a site: every link leads somewhere, every code has a page, and what a link opens in the playground passes.
set -euo pipefail
if ! command -v cmark-gfm >/dev/null || ! command -v mandoc >/dev/null; then
    echo 'skipped: make site needs cmark-gfm and mandoc'
    exit 77
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/play"
echo '<!DOCTYPE html><title>stands in for the playground</title>' >"$scratch/play/index.html"
python3 tools/build-site "$(dirname "$TARTAN")" "$scratch/site" "$scratch/play"
python3 tests/site.py "$TARTAN" "$scratch/site"

# A link that leads nowhere is found.
sed -i 's/href="houses.html"/href="hoses.html"/' "$scratch/site/index.html"
if python3 tests/site.py "$TARTAN" "$scratch/site" >"$scratch/said"; then
    echo 'a link that leads nowhere was not found'
    exit 1
fi
grep -q 'index.html: hoses.html leads nowhere' "$scratch/said"
