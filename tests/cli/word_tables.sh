#!/usr/bin/env bash
# Whatever knows the words of a notation has every row of its words.def: docs/words.md and the editors' colours as they are
# made from it; the formatter, suggestions, completion and hovering as they are asked (tests/words.py).
# Slow under sanitizers.
set -euo pipefail
fail() {
    echo "$1"
    exit 1
}

python3 tools/words . --check || fail 'what is made from the table of words is not up to date'
python3 tests/words.py "$TARTAN" tests/cli/word_tables || fail 'something does not follow the table of words'

# The checks themselves find a word that is in the table alone.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
echo 'WORD("thrice", THRICE, TN_READ_OPENING, TN_AT(RULE), TN_AS_CALL, "three times")' >"$scratch/more.def"
if python3 tools/words . --check --rows "$scratch/more.def" >"$scratch/said"; then fail 'a word that no page and no editor has passes'; fi
for made in docs/words.md editors/vscode/syntaxes/plan.tmLanguage.json; do
    grep -q "^$made .*it lacks thrice:" "$scratch/said" || fail "of another row it does not say that $made lacks it"
done
if python3 tests/words.py "$TARTAN" tests/cli/word_tables "$scratch/more.def" >"$scratch/said"; then fail 'a word that nobody knows passes'; fi
grep -q 'nobody says what `thrice` of .plan is' "$scratch/said" || fail 'of another row it does not say that nobody says what it is'
