#!/usr/bin/env bash
# check --watch, count --watch: again whenever a file that was read changes, imports included; an interrupt ends them.
name=watch
. "$(dirname "$0")/golden.bash"

printf 'schema s { w = 1m | 2m }\nrule thin = tray(1m)\n' >"$scratch/base.plan"
printf 'use "base.plan"\nlibrary l { trays 2 prune thin }\n' >"$scratch/own.plan"

# says COUNT TEXT: waits until the output has so many lines with the text.
says() {
    for _ in $(seq 100); do
        [ "$(grep -c "$2" "$scratch/said")" -lt "$1" ] || return 0
        sleep 0.1
    done
    fail "'$2' was not said $1 times: $(cat "$scratch/said")"
}

# Interrupts are heard also where whoever runs the tests ignores them: background commands of a script are begun so.
hearing() {
    exec python3 -c 'import os, signal, sys
signal.signal(signal.SIGINT, signal.SIG_DFL)
os.execv(sys.argv[1], sys.argv[1:])' "$@"
}

replaced() { # FILE TEXT: at once, so that nobody reads half of it
    # shellcheck disable=SC2059 # the text has escapes
    printf "$2" >"$scratch/new"
    mv "$scratch/new" "$scratch/$1"
}

watched() { # COMMAND: begins to watch
    : >"$scratch/said" # there before the command begins
    hearing "$TARTAN" "$1" --watch "$scratch/own.plan" >"$scratch/said" 2>&1 &
    pid=$!
    says 1 'waiting for a change of 2 files'
    replaced own.plan 'use "base.plan"\nlibrary l { trays 2..3 prune thin }\n'
    says 1 'own.plan has changed'
    says 2 'waiting for a change'
    replaced base.plan 'schema s { w = 1m | 2m }\nrule thin = tray(3m)\n'
    says 1 'base.plan has changed'
    says 1 'error\[E0303\]'
    says 3 'waiting for a change'
    replaced base.plan 'schema s { w = 1m | 2m }\nrule thin = tray(1m)\n'
    says 2 'base.plan has changed'
    says 4 'waiting for a change'
    kill -INT $pid
    code=0
    wait $pid || code=$?
    is "$1: the exit code" "$code" 0
    ! grep -q 'interrupted' "$scratch/said" || fail "$1: an interrupt is called a failure"
}
watched check
watched count
grep -q 'total' "$scratch/said" || fail 'count does not count'
golden with_fix 'tartan check --watch --fix sheds.plan'
golden standard_input 'tartan check --watch -'
golden absent "tartan check --watch $scratch/absent.plan"
golden count_standard_input 'tartan count --watch -'
finish
