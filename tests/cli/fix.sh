#!/usr/bin/env bash
# check --fix: what is suggested is put in place, shown first, and written only where somebody says so.
name=fix
. "$(dirname "$0")/golden.bash"

wrong() {
    cat >"$scratch/wrong.plan" <<'PLAN'
use "lahave"
rule a = tray(sngle)
rule b = neighbour(tray(8'), trai(4'))
rule c = tray(8) and quantity(tray(doubl), n > 1)
rule d = neighbour(tray(8'), not tray(public), any)
PLAN
    cp "$scratch/wrong.plan" "$scratch/before"
}
untouched() { cmp -s "$scratch/wrong.plan" "$scratch/before" || fail "$1: the file was changed"; }

# Messages about the schema show where the stdlib is.
shown='2>&1 | grep -v "schema .lahave. is here"'
wrong
golden not_asked "tartan check --fix $scratch/wrong.plan $shown"
untouched 'without a terminal and --yes'
golden yes "tartan check --fix --yes --no-analysis $scratch/wrong.plan $shown"
exits 0 "$TARTAN" check --no-analysis --werror "$scratch/wrong.plan"
golden nothing_left "tartan check --fix --yes --no-analysis $scratch/wrong.plan"

# What cannot be written is not said to be replaced; a pipe is refused before it is read.
wrong
said=$( (ulimit -f 0 && exec "$TARTAN" check --fix --yes --no-analysis "$scratch/wrong.plan") 2>&1) && code=0 || code=$?
is 'a file that cannot be written' "$code" 3
untouched 'a file that cannot be written'
[[ $said == *'larger than is allowed'* && $said != *'replaced'* ]] || fail "a file that cannot be written: ${said##*$'\n'}"
mkfifo "$scratch/pipe.plan"
code=0 && timeout 60 "$TARTAN" check --fix --yes "$scratch/pipe.plan" 2>"$scratch/err" || code=$?
is 'a pipe' "$code" 3
grep -q 'it is a pipe or a device' "$scratch/err" || fail "a pipe: $(head -n 1 "$scratch/err")"

# A mistake that hides behind another is found in the next round; what has no suggestion is left, and said.
printf 'use "lahave"\nrule a = neighbor(tray(sngle), trai(4))\nrule b = tray(qwerty)\n' >"$scratch/two.plan"
golden rounds "tartan check --fix --yes $scratch/two.plan $shown"
exits 1 "$TARTAN" check --fix --yes "$scratch/two.plan"

# A person at a terminal is asked.
answer() { # LINE: the file is as before afterwards, or not
    wrong
    python3 - "$TARTAN" "$scratch/wrong.plan" "$1" <<'PY' >"$scratch/terminal"
import os, pty, sys
pid, fd = pty.fork()
if pid == 0:
    os.execv(sys.argv[1], [sys.argv[1], "check", "--fix", sys.argv[2]])
shown = b""
try:
    while True:
        part = os.read(fd, 4096)
        shown += part
        if b"[y/N]" in shown and b"\0" not in shown:
            os.write(fd, sys.argv[3].encode() + b"\n")
            shown = shown.replace(b"[y/N]", b"[y/N\0")
        if not part:
            break
except OSError:
    pass
os.waitpid(pid, 0)
sys.stdout.buffer.write(shown)
PY
}
answer n
untouched 'a person said no'
answer ''
untouched 'a person said nothing'
grep -q '+++ ' "$scratch/terminal" || fail 'a person is asked without having seen the difference'
answer y
! cmp -s "$scratch/wrong.plan" "$scratch/before" || fail 'a person said yes, and nothing was written'

# Nothing is left half-written where writing fails.
wrong
mkdir "$scratch/locked"
cp "$scratch/wrong.plan" "$scratch/locked"
chmod 500 "$scratch/locked"
if [ "$(id -u)" != 0 ]; then
    exits 3 "$TARTAN" check --fix --yes "$scratch/locked/wrong.plan"
    cmp -s "$scratch/locked/wrong.plan" "$scratch/before" || fail 'a file in a locked folder was changed'
fi
chmod 700 "$scratch/locked"
golden yes_alone "tartan check --yes $scratch/wrong.plan"
golden standard_input "tartan check --fix - <$scratch/wrong.plan"
golden absent "tartan check --fix $scratch/absent.plan"
head -c 100 /dev/zero >"$scratch/zero.plan"
exits 1 "$TARTAN" check --fix --yes "$scratch/zero.plan"
is 'the size of a file that is no text' "$(wc -c <"$scratch/zero.plan")" 100
finish
