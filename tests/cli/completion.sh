#!/usr/bin/env bash
# Completion: bash, zsh and fish offer every command, and every option of each that its help shows; choices after an option, files elsewhere.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() {
    echo "$1"
    exit 1
}
export LC_ALL=C
commands=$("$TARTAN" help | sed -n '/^Commands:/,/^$/s/^  \([a-z-]*\) .*/\1/p')
[ "$(wc -w <<<"$commands")" -ge 12 ] || fail 'help lists too few commands'
options_of() { # COMMAND: what its help shows, long and short
    "$TARTAN" help "$1" | grep -oE '^ +(-[a-zA-Z], )?--[a-z-]+' | grep -oE -- '-[a-zA-Z],|--[a-z-]+' | tr -d , | sort
}
for shell in bash zsh fish; do
    "$TARTAN" help --completion "$shell" >"$scratch/tartan.$shell"
done
"$TARTAN" help --completion tcsh 2>"$scratch/errors" && fail 'completion for a shell that there is none for'
grep -q 'bash, zsh and fish, not for tcsh' "$scratch/errors" || fail "an unknown shell: $(cat "$scratch/errors")"

# bash: the registered function is called as the shell would call it.
[ "$(. "$scratch/tartan.bash" && complete -p tartan)" = 'complete -F _tartan tartan' ] || fail 'bash: nothing is registered for tartan'
. "$scratch/tartan.bash"
offers() { # WORD...: what is offered for the last of them
    COMP_WORDS=("$@")
    COMP_CWORD=$(($# - 1))
    _tartan tartan "${!#}" "${COMP_WORDS[COMP_CWORD - 1]}"
    [ ${#COMPREPLY[@]} -eq 0 ] || printf '%s\n' "${COMPREPLY[@]}" | sort | tr '\n' ' '
}
expect() { # WANTED WORD...
    local wanted=$1
    shift
    [ "$(offers "$@")" = "$wanted" ] || fail "bash: tartan ${*:2} is offered '$(offers "$@")', not '$wanted'"
}
expect "$(printf '%s\n' $commands help --help --version | sort | tr '\n' ' ')" tartan ''
expect 'count ' tartan cou
expect "$(sort <<<"$commands" | tr '\n' ' ')" tartan help ''
expect '' tartan help count ''
for command in $commands; do
    expect "$(options_of "$command" | tr '\n' ' ')" tartan "$command" -
done
expect 'json text ' tartan count --diagnostics ''
expect 'json ' tartan count --diagnostics j
expect 'json text ' tartan count --diagnostics =
expect 'json ' tartan count --diagnostics = j
expect 'bits ' tartan match rules.plan -f b
expect '' tartan match rules.plan --rule ''
expect 'compare insert remove replay show ' tartan runs ''
touch "$scratch/a file.plan" "$scratch/b.tnb"
cd "$scratch"
expect 'a file.plan ' tartan check 'a '
expect 'b.tnb ' tartan match rules.plan b
expect 'b.tnb ' tartan count rules.plan -o b
expect 'b.tnb ' tartan count rules.plan --json b
expect 'b.tnb ' tartan runs show b

# zsh: the function is run with its helpers replaced by ones that print what they are given.
if command -v zsh >/dev/null; then
    zsh -n tartan.zsh
    cat >drive.zsh <<'DRIVE'
compdef() { :; }
compadd() { print -l -- "$@"; }
_files() { print files; }
_describe() { print -l -- ${(P)4}; }
_arguments() { print -l -- "$@"; }
source ./tartan.zsh
words=("$@")
CURRENT=$#
_tartan
_tartan_operand
DRIVE
    zsh -f drive.zsh tartan '' >zsh.commands
    for command in $commands; do
        grep -q "^$command:" zsh.commands || fail "zsh does not offer $command"
        zsh -f drive.zsh tartan "$command" '' >zsh.options
        for option in $(options_of "$command"); do
            grep -qE "^(\*|\([a-zA-Z -]*\))?$option[+=]?\[" zsh.options || fail "zsh does not offer $command $option"
        done
    done
    grep -q '^--diagnostics=.*:FORM:(text json)$' zsh.options || fail 'zsh does not offer the choices of --diagnostics'
else
    echo 'zsh is not here: its completion was not run'
fi

# fish says itself what it would offer.
if command -v fish >/dev/null; then
    export HOME=$scratch XDG_CONFIG_HOME=$scratch XDG_DATA_HOME=$scratch
    fish --no-config -n tartan.fish
    fish_offers() {
        fish --no-config -c 'source tartan.fish; complete -C $argv[1]' "$1" | cut -f 1 | sort -u | tr '\n' ' '
    }
    offered=" $(fish_offers 'tartan ')"
    for command in $commands; do
        [[ $offered == *" $command "* ]] || fail "fish does not offer $command: $offered"
        long=" $(fish_offers "tartan $command --")"
        for option in $(options_of "$command" | grep -- --); do
            [[ $long == *" $option "* ]] || fail "fish does not offer $command $option: $long"
        done
    done
    [ "$(fish_offers 'tartan count --diagnostics ')" = 'json text ' ] || fail 'fish does not offer the choices of --diagnostics'
    for word in show compare replay; do
        [[ " $(fish_offers 'tartan runs ')" == *" $word "* ]] || fail "fish does not offer tartan runs $word"
    done
else
    echo 'fish is not here: its completion was not run'
fi
