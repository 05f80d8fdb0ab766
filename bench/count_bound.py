"""What four processors gain in counting at most: count_bound.py TARTAN

Nobody needs four processors for this. It measures the processor time of each of four threads wherever they work together, and of what one
does alone: no number of processors takes less than that and the longest of the threads, each time. Of several runs that of the shortest
such time counts, as a thread that waits for a processor leaves its work to the others.
"""
import glob
import os
import subprocess
import sys
import time

RUNS, THREADS = 15, 4


def command(tartan, threads):
    return [tartan, "count", "bricks", "--part", "3001", "--parts", "5", "--threads", str(threads)]


def alone(tartan):
    """The processor time with one thread, in seconds."""
    pid = os.posix_spawn(tartan, command(tartan, 1), os.environ, file_actions=[(os.POSIX_SPAWN_OPEN, 1, "/dev/null", os.O_WRONLY, 0)])
    used = os.wait4(pid, 0)[2]
    return used.ru_utime + used.ru_stime


def threads_of(pid):
    """[thread]: the processor time that it has had, in seconds."""
    times = {}
    for path in glob.glob(f"/proc/{pid}/task/*/schedstat"):
        try:
            with open(path, encoding="ascii") as text:
                times[int(path.split("/")[4])] = int(text.read().split()[0]) / 1e9
        except (OSError, ValueError, IndexError):
            pass
    return times


def together(tartan):
    """What one thread does alone, and for each time that they work together the times of the threads."""
    run = subprocess.Popen(command(tartan, THREADS), stdout=subprocess.DEVNULL)
    phases, own, begun, helpers = [], 0, 0, {}
    while run.poll() is None:
        times = threads_of(run.pid)
        own = times.pop(run.pid, own)
        if times:
            del times[min(times)]  # the first thread watches for memory
        if helpers and not set(times) & set(helpers):
            phases.append([own - begun, *helpers.values()])
            helpers = {}
        if times and not helpers:
            begun = own
        helpers.update(times)
        time.sleep(0.0003)
    if helpers:
        phases.append([own - begun, *helpers.values()])
    return own - sum(phase[0] for phase in phases), phases


def main():
    tartan = sys.argv[1]
    one = sorted(alone(tartan) for _ in range(5))[2]
    found = [together(tartan) for _ in range(RUNS)]
    least, (serial, phases) = min(((serial + sum(max(p) for p in phases), (serial, phases)) for serial, phases in found if phases), key=lambda run: run[0])
    threads = [sum(sorted(phase, reverse=True)[i] for phase in phases if i < len(phase)) for i in range(THREADS)]
    print("  one thread %.3f s; four threads %s s, and %.3f s alone" % (one, ", ".join("%.3f" % t for t in threads), serial))
    print("  bound on the gain of four processors: %.3f / (%.3f + %.3f) = %.1f" % (one, serial, least - serial, one / least))


main()
