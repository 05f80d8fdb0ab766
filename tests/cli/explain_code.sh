#!/usr/bin/env bash
# explain-code: every code has an answer; wrong ones get a suggestion.
name=explain_code
. "$(dirname "$0")/golden.bash"

golden error 'tartan explain-code E0304'
golden spellings "tartan explain-code w012 '[E0304]' 304"
golden unknown 'tartan explain-code E0344'
golden none 'tartan explain-code hello'
golden without 'tartan explain-code'
codes=$(sed -nE 's/^ERROR\(([0-9]+),.*/\1 E/p; s/^WARNING\(([0-9]+),.*/\1 W/p' runtime/base/codes.def |
    while read -r number kind; do
        if [ "$kind" = E ]; then printf 'E%04d ' "$number"; else printf 'W%03d ' "$number"; fi
    done)
# shellcheck disable=SC2086
exits 0 "$TARTAN" explain-code $codes
for code in $codes; do
    grep -q "^$code: ." "$scratch/out" || fail "nothing is said of $code"
done
finish
