#!/usr/bin/env bash
# Files that change while they are read: the old content or an error, never a mix without a word. Each reader of plans, and rules.
name=changing
. "$(dirname "$0")/golden.bash"
shapes=$(cd "$here/../../bench" && pwd)/ten.plan
"$TARTAN" sample "$shapes" 300000 >"$scratch/whole.txt"
"$TARTAN" sample "$shapes" 60000 --format csv >"$scratch/whole.csv"
"$TARTAN" sample "$shapes" 60000 --format bin >"$scratch/whole.bin"
python3 - "$TARTAN" "$shapes" "$scratch" <<'PYTHON' || fail 'see above'
import os, shutil, subprocess, sys, time
tartan, rules, scratch = sys.argv[1:]
wrong = []

def answers(path, threads):
    """What match says of the file: it is stopped before the last plans are read, as its reader has not taken what it wrote."""
    return subprocess.Popen([tartan, "match", rules, path, "--format", "names", "--threads", str(threads)],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, bufsize=0)

def shorten(path):
    os.truncate(path, os.path.getsize(path) * 3 // 4)

def lengthen(path):
    with open(path, "ab") as out:
        out.write(b"\n" * 100)

def rewrite(path):
    size = os.path.getsize(path)
    with open(path, "r+b") as out:
        out.seek(size - 2000)
        out.write(b"#" * 1000)

def replace(path):
    shutil.copy(path, path + ".new")
    shorten(path + ".new")
    os.rename(path + ".new", path)

for kind in "txt", "csv", "bin":
    for change in shorten, lengthen, rewrite, replace:
        for threads in 1, 3:
            path = f"{scratch}/part.{kind}"
            shutil.copy(f"{scratch}/whole.{kind}", path)
            whole = subprocess.run([tartan, "match", rules, path, "--format", "names"], stdout=subprocess.PIPE).stdout
            run = answers(path, threads)
            first = run.stdout.read(1)  # it has opened the file, and waits for its answers to be read
            time.sleep(0.05)
            change(path)
            rest, said = run.communicate()
            if first + rest == whole and run.returncode == 0:
                continue  # the old content
            if run.returncode == 0 or b"error[E" not in said:
                wrong.append(f"{kind}, {change.__name__}, {threads} threads: exit {run.returncode}, {said[-200:]}")
            elif change is replace:
                wrong.append(f"{kind}: another file of the same name is an error: {said[-200:]}")

print("\n".join(wrong))
sys.exit(1 if wrong else 0)
PYTHON
finish
