"""Sends SIGTERM and SIGINT to commands at random moments: signals.py TARTAN SOURCES SCRATCH TIMES SHARE SEED [SECONDS]

SHARE of all commands are tried, which ones the seed says, or all of them where SHARE is 0. Whatever the moment, the command ends within SECONDS (30), says so, and leaves no half a file: an output is not there, or
it is what an undisturbed run writes. Prints the longest answer of each command."""
import os, random, re, shutil, signal, subprocess, sys, time

tartan, sources, scratch = map(os.path.abspath, sys.argv[1:4])
times, share, seed = map(int, sys.argv[4:7])
allowed = float(sys.argv[7] if len(sys.argv) > 7 else 30)
bench, files, examples = f"{sources}/bench", f"{sources}/tests/cli/files", f"{sources}/examples"

SYSTEM = "A + A + A + A\nA -> A A A A A A A A\nAngle 90\nBranchAngle 90\n"  # one face with eight times more edges a step
os.makedirs(scratch, exist_ok=True)
with open(f"{scratch}/outline.hemls", "w") as out:
    out.write(SYSTEM)
with open(f"{scratch}/long.bnf", "w") as out:
    out.write("<s> ::= <s> <s> | a | b\n")

with open(f"{scratch}/cells.pcfg", "w") as out:
    out.write("Start -> 'PlaceBoundingBox(4,4,4)' 'Place(3003)' 'FillRectNoCheck(2000,2000,200)'\n")

# What each command is given, and the name of its output. Every one takes a second or more, or is quick and is met late.
LIBRARY = "lahave-houses"
COMMANDS = [
    ("check", ["check", "--relations", LIBRARY], None),
    ("fmt", ["fmt", f"{files}/sheds.plan"], None),
    ("test", ["test", LIBRARY, "--coverage"], None),
    ("build", ["build", LIBRARY, "-o", "@/m.tnb"], "m.tnb"),
    ("disasm", ["disasm", LIBRARY], None),
    ("match", ["match", f"{bench}/ten.plan", "plans.txt", "-o", "@/bits.txt"], "bits.txt"),
    ("prune", ["prune", LIBRARY, "houses.txt", "-o", "@/kept.txt"], "kept.txt"),
    ("explain", ["explain", LIBRARY, "#7"], None),
    ("count", ["count", LIBRARY], None),
    ("diff", ["diff", f"{files}/sheds.plan", f"{files}/sheds-edited.plan"], None),
    ("enumerate", ["enumerate", LIBRARY, "-n", "400000", "-o", "@/all.txt"], None),  # keeps what it wrote, and says so
    ("enumerate to SQLite", ["enumerate", LIBRARY, "-n", "400000", "-o", "@/all.sqlite"], None),
    ("sample", ["sample", LIBRARY, "100000", "-o", "@/some.txt"], "some.txt"),
    ("rank", ["rank", LIBRARY, "houses.txt"], None),
    ("unrank", ["unrank", LIBRARY, "5"], None),
    ("draw", ["draw", LIBRARY, "--sample", "300", "-o", "@/plans.pdf"], "plans.pdf"),
    ("report", ["report", LIBRARY, "-o", "@/report"], None),
    ("grow", ["grow", "outline.hemls", "-n", "6", "-t", "-o", "@/surface.obj"], "surface.obj"),
    ("grow a picture", ["grow", "outline.hemls", "-n", "5", "-o", "@/surface.png"], "surface.png"),
    ("grow to GLB", ["grow", "square", "-n", "9", "-o", "@/square.glb"], "square.glb"),
    ("mesh", ["mesh", "primitives", "--surface", "torus", "--grid", "200", "-o", "@/torus.obj"], "torus.obj"),
    ("mesh, smoothed", ["mesh", "primitives", "--surface", "torus", "--grid", "60", "--subdivide", "1", "--smooth", "3",
                        "--decimate", "1000", "-o", "@/torus.stl"], "torus.stl"),
    ("house", ["house", f"{files}/cabins.plan", "14' room:14' none ; 1 gable(9:12) 1 flat ; living ; wall window wall",
               "-o", "@/house.obj"], "house.obj"),
    ("place", ["place", "cells.pcfg", "-o", "@/cells.ldr"], "cells.ldr"),
    ("export", ["export", LIBRARY, "--prolog"], None),
    ("map", ["map", "long.bnf", "--random", "200000", "-o", "@/sentences.txt"], "sentences.txt"),
    ("evolve", ["evolve", f"{examples}/breeding-surfaces/breed.study", "-o", "@/run"], None),
]


def listen():
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # also where the tests run in the background of a script


def start(arguments, folder):
    words = [word.replace("@", folder) if word.startswith("@/") else word for word in arguments]
    return subprocess.Popen([tartan, *words], cwd=scratch, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE, preexec_fn=listen)


def contents(folder, name):
    path = os.path.join(folder, name) if name else None
    if not path or not os.path.exists(path):
        return None
    with open(path, "rb") as file:
        return file.read()


def fresh(name):
    folder = os.path.join(scratch, name)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    return folder


wrong = []
chance = random.Random(seed)
chosen = sorted(chance.sample(range(len(COMMANDS)), share)) if share else range(len(COMMANDS))
for file, rules in ("plans.txt", f"{bench}/ten.plan"), ("houses.txt", LIBRARY):
    if any(file in COMMANDS[i][1] for i in chosen):
        with open(f"{scratch}/{file}", "wb") as out:
            subprocess.run([tartan, "sample", rules, "100000"], stdout=out, check=True)

for name, arguments, output in (COMMANDS[i] for i in chosen):
    began = time.monotonic()
    whole = start(arguments, fresh("whole"))
    said = whole.communicate()[1]
    takes = time.monotonic() - began
    if whole.returncode not in (0, 1):
        wrong.append(f"{name} does not work: exit {whole.returncode}, {said.decode()[-300:]}")
        continue
    wanted = contents(os.path.join(scratch, "whole"), output)
    longest = met = 0
    for _ in range(times):
        folder = fresh("cut")
        run = start(arguments, folder)
        moment = chance.uniform(0, takes)
        time.sleep(moment)
        sent = chance.choice([signal.SIGTERM, signal.SIGINT])
        run.send_signal(sent)
        began = time.monotonic()
        try:
            said = run.communicate(timeout=allowed)[1]
        except subprocess.TimeoutExpired:
            run.kill()
            run.communicate()
            wrong.append(f"{name}: {sent.name} after {moment:.2f} s is not answered within {allowed:g} s")
            continue
        longest = max(longest, time.monotonic() - began)
        what = f"{name}: {sent.name} after {moment:.3f} s of {takes:.2f}"
        if run.returncode == -sent:
            if os.listdir(folder):  # before it listens there is nothing yet
                wrong.append(f"{what} leaves {os.listdir(folder)}")
            continue
        if run.returncode == 130:
            met += 1
            if b"interrupted" not in said:
                wrong.append(f"{what} says nothing of the interrupt: {said.decode()[-300:]}")
            if re.search(rb"error|internal", said):
                wrong.append(f"{what} is called an error: {said.decode()[-300:]}")
        elif run.returncode != whole.returncode:
            wrong.append(f"{what} ends with exit {run.returncode}: {said.decode()[-300:]}")
        got = contents(folder, output)
        if got is not None and got != wanted and not output.endswith(".pdf"):
            wrong.append(f"{what} leaves another file than a whole run")
        if run.returncode == 130 and got is not None and b"not written" in said:
            wrong.append(f"{what} says that {output} is not written, and it is")
        left = [file for file in os.listdir(folder) if ".tartan-" in file]
        if left:
            wrong.append(f"{what} leaves {left}")
    print(f"{name:22} {takes:7.2f} s, {met} of {times} interrupted, longest answer {longest:5.2f} s")

for line in wrong:
    print(line)
sys.exit(1 if wrong else 0)
