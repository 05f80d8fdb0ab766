#!/usr/bin/env bash
# Needs the parts: draw store
# Every command explains itself: usage, every option, an example; in lines that fit a terminal.
name=help
. "$(dirname "$0")/golden.bash"

golden overview 'tartan help'
golden count 'tartan help count'
golden draw 'tartan draw --help'

for command in $("$TARTAN" help | sed -n 's/^  \([a-z]*\)  .*/\1/p' | grep -v '^tartan$'); do
    text=$("$TARTAN" help "$command")
    is "$command --help" "$("$TARTAN" "$command" --help)" "$text"
    for heading in Usage: Options: Example:; do
        grep -q "^$heading" <<<"$text" || fail "help $command has no $heading"
    done
    grep -q "^  tartan $command" <<<"$text" || fail "help $command does not say how it is called"
    grep -q "^  \$ .*tartan $command " <<<"$text" || fail "help $command has no example of its own"
    grep -q -- '--diagnostics' <<<"$text" || fail "help $command does not list --diagnostics"
    [ "$(awk 'length > 100' <<<"$text")" = '' ] || fail "help $command has a long line"
done
[ "$("$TARTAN" help | grep -c '^  [a-z]* ')" -ge 12 ] || fail 'some commands are missing'

# Examples about files of the standard library run as they stand.
mkdir "$scratch/examples"
cd "$scratch/examples"
tartan() { "$TARTAN" "$@"; }
tartan sample lahave-houses 3 --length 4 >plans.txt
for command in count draw enumerate explain match prune rank sample test unrank; do
    while read -r example; do
        eval "$example" >out 2>err </dev/null || fail "help $command: $example: $(head -n 1 err)"
    done < <(tartan help "$command" | sed -n 's/^  \$ //p')
done
finish
