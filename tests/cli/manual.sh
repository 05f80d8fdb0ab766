#!/usr/bin/env bash
# Each command has a manual page with every option that its help shows.
set -euo pipefail
fail() {
    echo "$1"
    exit 1
}

commands=$("$TARTAN" help | sed -n '/^Commands:/,/^$/s/^  \([a-z-]*\) .*/\1/p')
[ "$(wc -w <<<"$commands")" -ge 12 ] || fail 'help lists too few commands'
overview=$("$TARTAN" help --man)
for command in $commands; do
    grep -q "tartan.-$command" <<<"$overview" || fail "tartan(1) does not name $command"
    page=$("$TARTAN" help --man "$command")
    for section in NAME SYNOPSIS DESCRIPTION OPTIONS EXAMPLE; do
        [[ $page == *$'\n.SH '"$section"$'\n'* ]] || fail "tartan-$command(1) has no $section"
    done
    for option in $("$TARTAN" help "$command" | grep -oE '^ +(-[a-zA-Z], )?--[a-z-]+' | grep -oE -- '--[a-z-]+'); do
        [[ $page == *"${option//-/\\-}\\fR"* ]] || fail "tartan-$command(1) lacks $option"
    done
    if grep -vE '^\.(TH|SH|TP|PP|br|nf|fi|B|BR|I)( |$)' <<<"$page" | grep -E "^['.]"; then
        fail "tartan-$command(1) has text that roff would take for a macro"
    fi
done
# Where mandoc is, which other systems read pages with, it has no warning.
lint() {
    command -v mandoc >/dev/null || return 0
    local warnings
    warnings=$(mandoc -T lint -W warning 2>&1 <<<"$2") || fail "$1: $warnings"
}
lint 'tartan(1)' "$overview"
for command in $commands; do
    lint "tartan-$command(1)" "$("$TARTAN" help --man "$command")"
done
if "$TARTAN" help --man nonsense 2>/dev/null; then
    fail 'a page for a command that there is not'
fi

# Each notation has one too, made of its page of docs, and so have houses and files of plans; the overview names it, and every grammar of the compiler has one.
version=$("$TARTAN" --version | sed 's/^tartan //')
rows=$(sed -nE 's/^[A-Z_]+\(.*, "([^"]*)", "([^"]+)", "([^"]*)"\)$/\2|\1|\3/p' compiler/notations.def)
rows+=$'\nhouse|house-language.md|forms of houses, and rules and measures about houses'
rows+=$'\nplans|plan-files.md|the formats of files of plans'
names=$(cut -d'|' -f1 <<<"$rows")
for name in plan bnf study house plans $(find stdlib -type f | sed 's/.*\.//' | sort -u); do
    grep -qx "$name" <<<"$names" || fail "no notation $name"
done
while IFS='|' read -r name source summary; do
    page=$(tools/manual-page "docs/$source" "$name" "$summary" "$version" 2026-11-30)
    for text in '.SH NAME' '.SH DESCRIPTION' '.SH SEE ALSO'; do
        grep -qxF "$text" <<<"$page" || fail "tartan-$name(5) has no line $text"
    done
    grep -q "tartan.-$name (5)" <<<"$overview" || fail "tartan(1) does not name tartan-$name(5)"
    while read -r title; do
        title=${title//-/\\-}
        [[ $page == *".SH ${title//\'/\\(aq}"* ]] || fail "tartan-$name(5) lacks the section $title"
    done < <(sed -n '/^```/,/^```/d;s/^## \([^`(]*\).*/\1/p' "docs/$source")
    lint "tartan-$name(5)" "$page"
    if grep -qF '](' <<<"$page"; then
        fail "tartan-$name(5) has a link left"
    fi
    if command -v man >/dev/null && command -v troff >/dev/null; then
        warnings=$(LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -l - <<<"$page" 2>&1 >/dev/null | grep -v "can't break line" || true)
        [ -z "$warnings" ] || fail "tartan-$name(5): $warnings"
    fi
done <<<"$rows"
