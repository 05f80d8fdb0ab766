#!/usr/bin/env python3
"""Prints how fast connection grammars grow beside a slow independent model of the published program: place_model.py TARTAN PLACE

PLACE is the folder with model.py and its grammars. Both write the same bytes, which is looked at first. Processor seconds and the most memory of whole
processes: medians of 21 runs of ours, of three of the model. Growing alone is what the large box takes longer than a box of 8 9 8."""
import os, re, statistics, subprocess, sys, tempfile

tartan, place = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
grammars = os.path.join(place, "grammars")
BOX = ["box_constraints.pcfg", "brick.pcfg", "brick_defs.pcfg", "close.pcfg"]
CASTLE = ["castle/wall_constraints.pcfg", "brick.pcfg", "brick_defs.pcfg", "tile.pcfg", "close.pcfg"]


def measured(command):
    """The processor seconds and megabytes of a process."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = status
    assert status == 0, command
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def sized(folder, size):
    """The box's grammars with another bound."""
    with open(os.path.join(grammars, BOX[0])) as file:
        text = re.sub(r"PlaceBoundingBox\([^)]*\)", "PlaceBoundingBox(%d,%d,%d)" % size, file.read())
    path = os.path.join(folder, "%dx%dx%d.pcfg" % size)
    with open(path, "w") as file:
        file.write(text)
    return [path] + [os.path.join(grammars, name) for name in BOX[1:]]


def ours(files, out):
    runs = [measured([tartan, "place", *files, "--seed", "0", "-o", out]) for _ in range(21)]
    return statistics.median(run[0] for run in runs), max(run[1] for run in runs)


def model(files, out):
    runs = [measured([sys.executable, "-B", os.path.join(place, "model.py"), "0", out, *files]) for _ in range(3)]
    return statistics.median(run[0] for run in runs), max(run[1] for run in runs)


def parts(out):
    with open(out) as file:
        return sum(line.startswith("1 ") for line in file)


with tempfile.TemporaryDirectory() as folder:
    mine, theirs = os.path.join(folder, "mine.ldr"), os.path.join(folder, "theirs.ldr")
    print("%-22s %8s %10s %8s %10s %8s %8s" % ("grown, whole process", "parts", "tartan, s", "MB", "model, s", "MB", "ratio"), flush=True)
    for name, files in (("box 32 36 32", sized(folder, (32, 36, 32))), ("castle", [os.path.join(grammars, f) for f in CASTLE])):
        (seconds, memory), (slow, much) = ours(files, mine), model(files, theirs)
        with open(mine, "rb") as a, open(theirs, "rb") as b:
            assert a.read() == b.read(), name
        if name.startswith("box"):
            less = sized(folder, (8, 9, 8))
            alone = seconds - ours(less, os.path.join(folder, "less.ldr"))[0], slow - model(less, os.path.join(folder, "less.ldr"))[0]
        print("%-22s %8d %10.3f %8.0f %10.2f %8.0f %8.0f" % (name, parts(mine), seconds, memory, slow, much, slow / max(seconds, 1e-3)), flush=True)
    print("%-22s %8s %10.4f %8s %10.2f %8s %8.0f" % ("box 32 36 32, grown", "", alone[0], "", alone[1], "", alone[1] / max(alone[0], 1e-4)))
    files = sized(folder, (128, 144, 128))
    seconds, memory = ours(files, mine)
    large = seconds / parts(mine)
    print("%-22s %8d %10.3f %8.0f" % ("box 128 144 128", parts(mine), seconds, memory))
    small = sized(folder, (64, 72, 64))
    seconds, _ = ours(small, mine)
    print("a part takes %.2f us in the box of 128 144 128, %.2f in that of 64 72 64 (%.2f times)" % (large * 1e6, seconds / parts(mine) * 1e6, large * parts(mine) / seconds))
