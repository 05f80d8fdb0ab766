#!/usr/bin/env bash
# Colour on a terminal only, and not there where NO_COLOR or a dumb terminal says so.
name=terminal
. "$(dirname "$0")/golden.bash"
echo 'rule x = tray(' >"$scratch/bad.plan"

# What `tartan check` writes to a terminal, with the environment given.
on_terminal() {
    env -u NO_COLOR TERM=xterm "$@" python3 - "$TARTAN" "$scratch/bad.plan" <<'PYTHON'
import os, pty, sys
pid, terminal = pty.fork()
if pid == 0:
    os.execv(sys.argv[1], [sys.argv[1], "check", sys.argv[2]])
text = b""
while True:
    try:
        part = os.read(terminal, 4096)
    except OSError:
        break
    if not part:
        break
    text += part
os.waitpid(pid, 0)
sys.stdout.buffer.write(text)
PYTHON
}
escape=$'\033['
grep -qF "$escape" <<<"$(on_terminal)" || fail 'no colour on a terminal'
grep -qF "$escape" <<<"$(on_terminal NO_COLOR=1)" && fail 'colour although NO_COLOR is set'
grep -qF "$escape" <<<"$(on_terminal TERM=dumb)" && fail 'colour on a dumb terminal'
grep -qF 'error[' <<<"$(on_terminal NO_COLOR=1)" || fail 'no error on a terminal'
grep -qF "$escape" <<<"$(env -u NO_COLOR "$TARTAN" check "$scratch/bad.plan" 2>&1)" && fail 'colour in a pipe'
finish
