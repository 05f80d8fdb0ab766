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

# A pipe that nobody writes to is named after a second; what is written then is read whole.
mkfifo "$scratch/pipe"
echo 'rule x = tray(' >"$scratch/late"
python3 - "$TARTAN" "$scratch/pipe" "$scratch/late" <<'PYTHON' || fail 'a pipe without a writer is not named, or not read'
import os, pty, select, shutil, sys, time
tartan, pipe, late = sys.argv[1:]
pid, terminal = pty.fork()
if pid == 0:
    os.execv(tartan, [tartan, "check", pipe])
text, fed, begun = b"", False, time.time()
while time.time() < begun + 30:
    if select.select([terminal], [], [], 0.1)[0]:
        try:
            part = os.read(terminal, 4096)
        except OSError:
            break
        text += part
    if not fed and b"waiting for somebody to write to the pipe" in text:
        fed = time.time() - begun
        shutil.copyfileobj(open(late, "rb"), open(pipe, "wb"))
if not fed:
    os.kill(pid, 9)
os.waitpid(pid, 0)
sys.exit(0 if fed and fed > 0.9 and b"error[E0001]" in text.replace(b"\x1b[1;31m", b"") else 1)
PYTHON
# Where somebody writes, nothing is said, and all is read.
{ sleep 0.3; cat "$scratch/bad.plan"; } >"$scratch/pipe" &
"$TARTAN" check "$scratch/pipe" >"$scratch/out" 2>&1 || true
grep -q 'error\[' "$scratch/out" || fail 'a pipe is not read'
grep -q 'waiting' "$scratch/out" && fail 'a pipe is named without a terminal'
# What was written is read, too, where the writer has left before the command opens the pipe.
python3 - "$scratch/pipe" "$TARTAN" "$here/../../examples/editing-a-rule/after.plan" <<'PYTHON' || fail 'what a writer left in a pipe is not read'
import os, subprocess, sys
pipe, tartan = sys.argv[1:3]


def read(*command):
    kept = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    with open(pipe, "w") as written:
        written.write("rule x = tray(\n")
    answer = subprocess.run([tartan, *command, pipe], stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=60)
    os.close(kept)
    return answer.stderr


assert b"error[E0001]" in read("check")
assert b"error[" in read("match", sys.argv[3])
PYTHON
finish
