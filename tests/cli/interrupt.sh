#!/usr/bin/env bash
# Needs the parts: store
# An enumeration that is interrupted has written whole plans, says from where to go on, and shows right progress.
name=interrupt
. "$(dirname "$0")/golden.bash"

python3 - "$TARTAN" "$files/sheds.plan" "$scratch" <<'PYTHON' || fail 'see above'
import os, pty, re, signal, sqlite3, subprocess, sys, time
tartan, rules, scratch = sys.argv[1:]
command = [tartan, "enumerate", rules, "-l", "any-sheds", "--trays", "0..40"]  # never done
wrong = []

def check(what, right):
    if not right:
        wrong.append(what)

def listen():
    """Interrupts are heard, also where the tests run in the background of a script, which does not hear them."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)

def interrupted(more, after):
    """Reads so many bytes of the plans, interrupts, reads the rest: the plans, and the rank to go on from."""
    run = subprocess.Popen(command + more, bufsize=0, stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=listen)
    begun = b""
    while len(begun) < after:
        begun += run.stdout.read(after - len(begun))
    run.send_signal(signal.SIGINT)
    rest, said = run.communicate()
    check(f"exit code {run.returncode}, {said}", run.returncode == 130)
    written, rank = re.search(rb"interrupted; (\d+) plans are written, and --from (\d+) goes on", said).groups()
    return begun + rest, int(written), int(rank)

def stretch(start, end):
    return subprocess.run(command + ["--from", str(start), "--to", str(end)], stdout=subprocess.PIPE, check=True).stdout

for after in 1, 70_000, 1_000_000:
    text, written, rank = interrupted([], after)
    check(f"{written} plans, {rank} ranks", written == rank == text.count(b"\n"))
    check(f"other plans, or half of one, when interrupted after {after} bytes", text == stretch(0, rank))
    check("going on is not the whole", text + stretch(rank, rank + 999) == stretch(0, rank + 999))

text, written, rank = interrupted(["--mirror", "--from", "1000"], 70_000)
mirrored = subprocess.run(command + ["--mirror", "--from", "1000", "--to", str(rank)], stdout=subprocess.PIPE).stdout
check("other mirrored plans", text == mirrored and text.count(b"\n") == written)

# Progress goes to a terminal and is right, also after resuming.
def progress(more, enough=3):
    """Runs on a terminal until progress was shown so often, interrupts: what stood there."""
    pid, terminal = pty.fork()
    if pid == 0:
        listen()
        os.execv(tartan, command + more)
    text, shown = b"", 0
    while True:
        try:
            part = os.read(terminal, 4096)
        except OSError:
            break
        if not part:
            break
        text += part
        if shown < enough <= text.count(b"/s"):
            os.kill(pid, signal.SIGINT)
        shown = text.count(b"/s")
    check("exit on a terminal", os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == 130)
    return text.decode()

def lines_of(text, total):
    """Each time that progress was drawn must say so many per cent as its numbers do."""
    found = [(int(n), float(p)) for n, p in re.findall(r"\r\x1b\[K(\d+) plans, \d+/s, ([\d.]+) %, [\d.e+]+ (?:s|min|h) left", text)]
    check(f"no progress in {text!r}", len(found) >= 2)
    check(f"progress goes back: {found}", found == sorted(found))
    for n, percent in found:
        check(f"{n} of {total} plans is not {percent} %", abs(100 * n / total - percent) < 0.06)
    return found

limit = 2_000_000_000
database = scratch + "/long.sqlite"
first = lines_of(progress(["--limit", str(limit), "-o", database]), limit)
kept = sqlite3.connect(database).execute("select count(*) from plans").fetchone()[0]
check(f"not whole batches: {kept}", kept % 100_000 == 0)
again = lines_of(progress(["--limit", str(limit), "-o", database, "--resume"]), limit)
check(f"{kept} plans were there, and then {again}", again[0][0] > kept)
check(f"a rate that counts what was there: {again}", again[0][0] - kept < first[-1][0] * 3 + 1_000_000)

# A file keeps what was written before the interruption. (Until then the file has no name to look at: the interruption comes after a
# while, and again after twice as long where that was before tartan had begun to write.)
os.mkdir(scratch + "/file")
delay = 0.02
while True:
    run = subprocess.Popen(command + ["-o", scratch + "/file/plans"], stderr=subprocess.PIPE, preexec_fn=listen)
    time.sleep(delay)
    run.send_signal(signal.SIGINT)
    said = run.communicate()[1]
    if run.returncode == 130 or delay > 10:
        break
    delay *= 2
check(f"exit code {run.returncode}, {said}", run.returncode == 130)
written = int(re.search(rb"interrupted; (\d+) plans", said)[1])
check("not the plans before the interruption", open(scratch + "/file/plans", "rb").read() == stretch(0, written))
check("more than one file", os.listdir(scratch + "/file") == ["plans"])
print(*wrong, sep="\n", end="\n" if wrong else "")
sys.exit(bool(wrong))
PYTHON
finish
