#!/usr/bin/env python3
"""Prints how fast connection grammars grow beside a slow independent model of the published program: place_model.py TARTAN PLACE

PLACE is the folder with model.py and its grammars. Both write the same bytes, which is looked at first. Processor seconds and the most memory of whole
processes: medians of 21 runs of ours, of three of the model. Growing alone is timed within a process that grows again and again: bench_derive, and the model's
own function, less reading its grammar."""
import importlib.util, os, re, statistics, subprocess, sys, tempfile, time

tartan, place = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
derive = os.path.join(os.path.dirname(tartan), "bench", "bench_derive")
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


def grown_by_us(files, module, runs):
    """Seconds to derive a model once, of many times in one process."""
    subprocess.run([tartan, "build", *files, "-o", module], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    said = subprocess.run([derive, module, str(runs)], capture_output=True, text=True, check=True).stdout
    return float(re.search(r"in ([0-9.]+) ms", said).group(1)) / 1e3


def grown_by_model(files, runs):
    sys.dont_write_bytecode = True
    spec = importlib.util.spec_from_file_location("model", os.path.join(place, "model.py"))
    known = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(known)
    text = "\n".join(open(file).read() for file in files)
    times = []
    for _ in range(runs):
        begun = time.process_time()
        known.load(text)
        read = time.process_time()
        known.run(text, 0)
        times.append(time.process_time() - read - (read - begun))
    return statistics.median(times)


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
        print("%-22s %8d %10.3f %8.0f %10.2f %8.0f %8.0f" % (name, parts(mine), seconds, memory, slow, much, slow / max(seconds, 1e-3)), flush=True)
    print("%-22s %8s %10s %8s %10s %8s %8s" % ("grown alone", "", "tartan, ms", "", "model, ms", "", "ratio"), flush=True)
    for name, files in (("box 32 36 32", sized(folder, (32, 36, 32))), ("castle", [os.path.join(grammars, f) for f in CASTLE])):
        few, many = (3, 101) if name.startswith("box") else (21, 1001)
        mine, theirs = grown_by_us(files, os.path.join(folder, "grown.tnb"), many), grown_by_model(files, few)
        print("%-22s %8s %10.3f %8s %10.1f %8s %8.0f" % (name, "", mine * 1e3, "", theirs * 1e3, "", theirs / mine), flush=True)
    mine = os.path.join(folder, "mine.ldr")
    files = sized(folder, (128, 144, 128))
    seconds, memory = ours(files, mine)
    large = seconds / parts(mine)
    print("%-22s %8d %10.3f %8.0f" % ("box 128 144 128", parts(mine), seconds, memory))
    small = sized(folder, (64, 72, 64))
    seconds, _ = ours(small, mine)
    print("a part takes %.2f us in the box of 128 144 128, %.2f in that of 64 72 64 (%.2f times)" % (large * 1e6, seconds / parts(mine) * 1e6, large * parts(mine) / seconds))
