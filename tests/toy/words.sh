#!/usr/bin/env bash
# A word that is one row of the table, with a token and a rule of the grammar, is known to all that knows words: the lexer and the
# checker, the formatter, suggestions, completion and hovering, the page of docs and the editors' colours.
set -euo pipefail
fail() {
    echo "$1"
    exit 1
}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
made=(docs/words.md editors/vscode/syntaxes/plan.tmLanguage.json)
for file in $(find compiler -name words.def) docs/words.md editors/vscode/syntaxes/*.json; do
    mkdir -p "$scratch/$(dirname "$file")"
    cp "$file" "$scratch/$file"
done
if python3 tools/words "$scratch" --check --rows tests/toy/words.def >"$scratch/said"; then fail 'nothing lacks the word before it is made'; fi
for file in "${made[@]}"; do
    grep -q "^$file .*it lacks once:" "$scratch/said" || fail "$file is not said to lack the word"
done
python3 tools/words "$scratch" --rows tests/toy/words.def
for file in "${made[@]}"; do
    diff "$file" "$scratch/$file" >"$scratch/new" && fail "$file is made without the word"
    grep '^>' "$scratch/new" | grep -qw once || fail "$file has another change than the word: $(cat "$scratch/new")"
done

mkdir "$scratch/plans"
cp tests/cli/word_tables/*.plan tests/toy/once.plan "$scratch/plans"
"$TARTAN" fmt "$scratch/plans/once.plan"
"$TARTAN" count "$scratch/plans/once.plan" >/dev/null
exec python3 tests/words.py "$TARTAN" "$scratch/plans" tests/toy/words.def
