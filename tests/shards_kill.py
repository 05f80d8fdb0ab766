#!/usr/bin/env python3
"""Kills workers of a shard set at random moments: shards_kill.py TARTAN RULES KILLS

Workers are begun two at a time, each by a launcher, and one of the four processes is killed with -9, again and again. A set that is
complete, of plans or of answers about them, is held against one `enumerate` or `match`, byte for byte, and a new one is begun. Nothing may be missing, there twice or half there."""
import os, random, signal, subprocess, sys, tempfile, time

tartan, rules, kills = sys.argv[1], sys.argv[2], int(sys.argv[3])
seed = int(os.environ.get("SEED", time.time_ns() % 1000000))
random.seed(seed)
LIBRARY = ["-l", "any-sheds", "--trays", "0..7"]
LAUNCHER = "import subprocess, sys; sys.exit(subprocess.call(sys.argv[1:]))"


def fail(what):
    sys.exit("shards_kill: SEED=%d: %s" % (seed, what))


def call(*words):
    done = subprocess.run([tartan, *words], capture_output=True)
    if done.returncode:
        fail("%s: %s" % (" ".join(words), done.stderr.decode()))
    return done.stdout


def begin(folder):
    """A launcher and its worker, in a session of their own."""
    command = [sys.executable, "-S", "-c", LAUNCHER, tartan, "shards", "run", folder, "--stale", "1", "--threads", "2"]
    return subprocess.Popen(command, stderr=subprocess.DEVNULL, start_new_session=True)


def kill_one(launcher):
    """The worker alone, or the launcher with it."""
    try:
        if random.random() < 0.5:
            os.killpg(launcher.pid, signal.SIGKILL)
        else:
            with open("/proc/%d/task/%d/children" % (launcher.pid, launcher.pid)) as file:
                os.kill(int(file.read().split()[0]), signal.SIGKILL)
    except (ProcessLookupError, FileNotFoundError, IndexError):
        return 0  # it had ended, or not begun
    return 1


def end(launchers):
    for launcher in launchers:
        launcher.wait(timeout=300)


def files(folder):
    return sorted(os.path.join(top, name) for top, _, names in os.walk(folder) for name in names)


def check(folder, wanted, shards, ending):
    call("shards", "run", folder, "--stale", "1")
    call("shards", "check", folder)
    if call("shards", "cat", folder) != wanted:
        fail("the set is not what one command writes")
    left = [name for name in files(folder + "/shards") if not name.endswith((ending, ".record", ".claim"))]
    if left or len([name for name in files(folder) if name.endswith(ending)]) != shards:
        fail("files that are half there: %s" % left)


def main():
    killed = sets = 0
    with tempfile.TemporaryDirectory() as work:
        plans = work + "/plans"
        call("enumerate", rules, *LIBRARY, "-o", plans)
        kinds = [(".bin", call("enumerate", rules, *LIBRARY, "--format", "bin"), [*LIBRARY, "--format", "bin"]),
                 (".jsonl", call("match", rules, plans, "--format", "json"),
                  ["--task", "match", "--input", plans, "--format", "json"])]
        while killed < kills:
            folder, shards, sets = "%s/set%d" % (work, sets), random.choice([5, 40, 150]), sets + 1
            ending, wanted, asked = kinds[sets % len(kinds)]
            call("shards", "new", rules, *asked, "--shards", str(shards), "-o", folder)
            for _ in range(12):
                launchers = [begin(folder), begin(folder)]
                time.sleep(random.random() * 0.12)
                killed += sum(kill_one(launcher) for launcher in launchers if random.random() < 0.8)
                end(launchers)
                if killed >= kills:
                    break
            check(folder, wanted, shards, ending)
    print("%d kills, %d sets" % (killed, sets))


main()
