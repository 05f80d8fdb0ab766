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
def progress(more, enough=3, plans=0):
    """Runs on a terminal until progress was shown so often, with so many plans, interrupts: what stood there."""
    pid, terminal = pty.fork()
    if pid == 0:
        listen()
        os.execv(tartan, command + more)
    text, sent = b"", False
    while True:
        try:
            part = os.read(terminal, 4096)
        except OSError:
            break
        if not part:
            break
        text += part
        shown = re.findall(rb"(\d+) plans, \d+/s", text)
        if not sent and len(shown) >= enough and int(shown[-1]) >= plans:
            os.kill(pid, signal.SIGINT)
            sent = True
    check("exit on a terminal", os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == 130)
    return text.decode()

def lines_of(text, total):
    """Each time that progress was drawn must say so many per cent as its numbers do."""
    drawn = re.findall(r"\r\x1b\[K(\d+) plans, (\d+)/s, ([\d.]+) %, [\d.e+]+ (?:s|min|h) left", text)
    found = [(int(n), int(rate), float(percent)) for n, rate, percent in drawn]
    numbers = [n for n, _, _ in found]
    check(f"no progress in {text!r}", len(found) >= 2)
    check(f"progress goes back: {found}", numbers == sorted(numbers))
    for n, _, percent in found:
        check(f"{n} of {total} plans is not {percent} %", abs(100 * n / total - percent) < 0.06)
    return found

limit = 2_000_000_000
database = scratch + "/long.sqlite"
lines_of(progress(["--limit", str(limit), "-o", database], plans=300_000), limit)
kept = sqlite3.connect(database).execute("select count(*) from plans").fetchone()[0]
check(f"not whole batches: {kept}", kept >= 200_000 and kept % 100_000 == 0)
again = lines_of(progress(["--limit", str(limit), "-o", database, "--resume"]), limit)
check(f"{kept} plans were there, and then {again}", again[0][0] > kept)
# Nothing is shown in the first half second: the first rate is at most twice the plans that are new.
check(f"{kept} plans were there, and the rate counts them: {again}", again[0][1] <= 2 * (again[0][0] - kept) + 1)

# A file keeps what was written before the interruption. (Until then the file has no name to look at: the interruption comes after a
# while, and again after twice as long where that was before tartan had begun to write, or even to hear it.)
delay = 0.02
while True:
    folder = f"{scratch}/{delay}"
    os.mkdir(folder)
    run = subprocess.Popen(command + ["-o", folder + "/plans"], stderr=subprocess.PIPE, preexec_fn=listen)
    time.sleep(delay)
    run.send_signal(signal.SIGINT)
    said = run.communicate()[1]
    begun = re.search(rb"interrupted; (\d+) plans", said)
    if begun or delay > 10:
        break
    check(f"exit code {run.returncode}, {said}, before the first plan", run.returncode in (130, -signal.SIGINT))
    check(f"a file without plans: {said}", not os.path.exists(folder + "/plans"))
    delay *= 2
check(f"exit code {run.returncode}, {said}", begun and run.returncode == 130)
if begun:
    check("not the plans before the interruption", open(folder + "/plans", "rb").read() == stretch(0, int(begun[1])))
    check("more than one file", os.listdir(folder) == ["plans"])
print(*wrong, sep="\n", end="\n" if wrong else "")
sys.exit(bool(wrong))
PYTHON
finish
