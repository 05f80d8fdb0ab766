#!/usr/bin/env bash
# Each command has a manual page with every option that its help shows.
set -euo pipefail
fail() {
    echo "$1"
    exit 1
}

commands=$("$TARTAN" help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
[ "$(wc -w <<<"$commands")" -ge 12 ] || fail 'help lists too few commands'
overview=$("$TARTAN" help --man)
for command in $commands; do
    grep -q "tartan.-$command" <<<"$overview" || fail "tartan(1) does not name $command"
    page=$("$TARTAN" help --man "$command")
    for section in NAME SYNOPSIS DESCRIPTION OPTIONS EXAMPLE; do
        grep -q "^\.SH $section\$" <<<"$page" || fail "tartan-$command(1) has no $section"
    done
    for option in $("$TARTAN" help "$command" | grep -oE '^ +(-[a-zA-Z], )?--[a-z-]+' | grep -oE -- '--[a-z-]+'); do
        grep -qF -- "${option//-/\\-}\\fR" <<<"$page" || fail "tartan-$command(1) lacks $option"
    done
    if grep -vE '^\.(TH|SH|TP|PP|br|nf|fi|B|BR|I)( |$)' <<<"$page" | grep -E "^['.]"; then
        fail "tartan-$command(1) has text that roff would take for a macro"
    fi
done
if "$TARTAN" help --man nonsense 2>/dev/null; then
    fail 'a page for a command that there is not'
fi
