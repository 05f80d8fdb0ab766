#!/usr/bin/env bash
# Counting by a measure says on a terminal that it is at work, and ends when it is interrupted.
name=measure_progress
. "$(dirname "$0")/golden.bash"

python3 - "$TARTAN" "$files/prices.plan" <<'PYTHON' || fail 'see above'
import os, pty, signal, sys, time
tartan, rules = sys.argv[1:]
pid, terminal = pty.fork()
if pid == 0:
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # heard also where the tests run in the background of a script
    os.execv(tartan, [tartan, "count", rules, "--by", "cost"])
signal.alarm(300)  # rather than wait for ever
# It is held up, so that it is at work for over a second also on a fast machine.
time.sleep(0.2)
os.kill(pid, signal.SIGSTOP)
time.sleep(1.5)
os.kill(pid, signal.SIGCONT)
said = b""
while b"counting by the measure: " not in said:
    part = os.read(terminal, 4096)  # fails where the command ends without a word
    said += part
os.kill(pid, signal.SIGINT)
try:
    while part := os.read(terminal, 4096):
        said += part
except OSError:
    pass
code = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
if code != 130 or b"interrupted" not in said:
    print(f"exit code {code}: {said[-300:]!r}")
    sys.exit(1)
PYTHON
