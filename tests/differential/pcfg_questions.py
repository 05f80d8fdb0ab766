"""Every question about a connection grammar against every other: its steps are carried out here, and an independent model derives it."""
import csv
import functools
import importlib.util
import io
import os
import random
import re
from collections import Counter

from c_place import OPTIONS, SEED as NUMBER, placed_by_interface
from file_questions import content, keeps_its_meaning, loads, says_json
from program import answer, read_json, run, same
from subject import Subject

LIMITS = ["--part-limit", "300", "--step-limit", "20000", "--lookahead-limit", "20000", "--frame-limit", "1000"]
STEPS = 4000             # of the model that derives it
MATRICES = ["1 0 0 0 1 0 0 0 1", "0 0 -1 0 1 0 1 0 0", "-1 0 0 0 1 0 0 0 -1", "0 0 1 0 1 0 -1 0 0"]
SEED = str(NUMBER)
ORACLES = os.environ.get("TARTAN_ORACLES", "")


class GrammarSubject(Subject):
    def place(self, *more, file=None, limits=LIMITS):
        """(exit code, the text of the file or None, what is said)"""
        path = os.path.join(self.folder, "placed.ldr")
        if os.path.exists(path):
            os.unlink(path)
        code, out, err = run("place", *([file] if isinstance(file, str) else file or [self.path]), *limits, "--seed", SEED, "-o", path, *more)
        written = os.path.exists(path)
        same("a file is written", written, code == 0 or "--keep-partial" in more and written)
        return code, content(path).decode() if written else None, out + err

    def ends_in(self):
        """(what is said, the text) as the interface is asked."""
        code, text, said = self.place(limits=OPTIONS)
        return "limit" if code == 4 else None if code == 0 else re.search(r"error\[(E\d+)\]", said)[1], text

    @functools.cached_property
    def placed(self):
        return self.place()[:2]


def by_steps(subject):
    """The steps that were taken, carried out, place the parts; nothing is filled that is not free."""
    path = os.path.join(subject.folder, "steps.txt")
    code, text, said = subject.place("--program", path, "--stats", "json")
    if code:
        return
    steps = content(path).decode().split()
    got, overlaps = carried_out(steps)
    same("parts that the steps place", text.splitlines(), got)
    same("boxes that were not free", overlaps, [])
    stats = read_json("--stats json", said[:said.index("}") + 1])
    same("steps and parts", (stats["terminals"], stats["elements"]), (len(steps), text.count("0 STEP")))


def carried_out(steps):
    filled, frames, lines, overlaps = set(), [(0, 0, 0, 0, 1)], [], []
    for step in steps:
        word, numbers = step.partition("(")[0], step.partition("(")[2][:-1]
        x, y, z, turn, colour = frames[-1]
        if step == "(":
            frames.append(frames[-1])
        elif step == ")":
            frames.pop()
        elif word == "Move":
            dx, dy, dz = map(int, numbers.split(","))
            for _ in range(turn):
                dx, dz = -dz, dx
            frames[-1] = (x + dx, y + dy, z + dz, turn, colour)
        elif word == "Rotate":
            frames[-1] = (x, y, z, (turn + int(int(numbers) / 90)) % 4, colour)
        elif word == "SetColor":
            frames[-1] = (x, y, z, turn, int(numbers))
        elif word == "Place":
            lines += [f"1 {colour} {10 * x} {8 * y} {10 * z} {MATRICES[turn]} {numbers.replace('r', '')}.dat", "0 STEP"]
        else:
            fill(word, numbers, frames[-1], filled, overlaps, step)
        if not filled:
            filled |= ball(8)
    return lines, overlaps


def fill(word, numbers, frame, filled, overlaps, step):
    x, y, z, turn, _ = frame
    if word in ("FillRect", "FillRectNoCheck", "AssertFilled"):
        wide, high, deep = map(int, numbers.split(",")) if numbers else (2, 1, 2)
        wide, deep = (deep, wide) if turn % 2 else (wide, deep)
        wide, deep = abs(wide) // 2, abs(deep) // 2
        cells = [(x + i, y + j, z + k) for i in range(-wide, wide) for j in range(high) for k in range(-deep, deep)]
        if word == "AssertFilled":
            there = next((i for i, cell in enumerate(cells) if cell in filled), None)
            overlaps += [step] * (there is None)
            cells = cells[:there]
        elif word == "FillRect" and not filled.isdisjoint(cells):
            overlaps.append(step)
        filled.update(cells)
    elif word == "PlaceBoundingSphere":
        filled |= ball(int(numbers))
    else:
        a, b, c = map(int, numbers.split(","))
        filled |= {(x + i, y + j, z + k) for i in range(-a - 1, a + 1) for j in range(-b - 1, b + 1) for k in range(-c - 1, c + 1)
                   if i in (-a - 1, a) or j in (-b - 1, b) or k in (-c - 1, c)}


@functools.lru_cache(maxsize=4)
def ball(r):
    return {(i, j, k) for i in range(-r, r) for j in range(-r, r) for k in range(-r, r) if (r - 1) ** 2 < i * i + j * j + k * k <= r * r}


def by_model(subject):
    """What an independent model writes, where one is at hand and comes to its end."""
    model = oracle()
    if not model or not subject.text.isascii():
        return
    model.steps[0] = 0
    try:
        found, steps, stats = model.run(subject.text, int(SEED))
    except model.Fail:
        same("what the model refuses is placed", subject.placed[0] in (1, 4), True)
        return
    except (TooLong, RecursionError, RuntimeError, IndexError, ValueError, KeyError):
        return
    code, text, said = subject.place("--stats", "json")
    if code == 4 or code == 1 and not found.el:
        return
    want = "".join(f"1 {c} {10 * x} {8 * y} {10 * z} {MATRICES[turn]} {part.replace('r', '')}.dat\n0 STEP\n" for (x, y, z, turn, c), part in found.el)
    same("what the model places", (code, text), (0, want))
    figures = read_json("--stats json", said[:said.index("}") + 1])
    same("steps and tries of the model", (figures["terminals"], figures["tries"]), (steps, stats[0]))


class TooLong(Exception):
    pass


@functools.lru_cache(maxsize=1)
def oracle():
    path = os.path.join(ORACLES, "place", "model.py")
    if not ORACLES or not os.path.isfile(path):
        return None
    spec = importlib.util.spec_from_file_location("place_model", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    plain, module.steps = module.M.ex, [0]

    def counted(self, *args):
        module.steps[0] += 1
        if module.steps[0] > STEPS:
            raise TooLong
        return plain(self, *args)
    module.M.ex = counted
    return module


def same_bytes(subject):
    """By each engine, of a module, with a trace, of its lines in two files, and with one more quote."""
    want = subject.placed
    for others in (["--engine", "vm"], ["--trace"]):
        same(f"place with {' '.join(others)}", subject.place(*others)[:2], want)
    built = os.path.join(subject.folder, "built.tnb")
    answer("build", subject.path, "-o", built)
    same("the module placed", subject.place(file=built)[:2], want)
    lines = subject.text.splitlines(keepends=True)
    cut = random.Random(subject.text).randint(1, max(1, len(lines) - 1))
    halves = [subject.file(name, "".join(part)) for name, part in (("first.pcfg", lines[:cut]), ("second.pcfg", lines[cut:]))]
    if "".join(lines[cut:]).strip():
        same("placed of two files", subject.place(file=halves)[:2], want)
    again = subject.file("quotes.pcfg", subject.text.replace("'", '"'))
    same("placed with other quotes", subject.place(file=again)[:2], want)


def files(subject):
    """The list of parts counts those of the model; a header changes nothing else."""
    code, text = subject.placed
    if code:
        return
    path = os.path.join(subject.folder, "list.csv")
    answer("place", subject.path, *LIMITS, "--seed", SEED, "-o", path)
    want = Counter((line.split()[14][:-4], line.split()[1]) for line in text.splitlines() if line.startswith("1 "))
    rows = list(csv.DictReader(io.StringIO(content(path).decode())))
    if not re.search("bick", text):              # names with an r lose it in the model
        same("parts of the list", Counter({(row["part"], row["colour"]): int(row["number"]) for row in rows}), want)
    headed = subject.place("--header")[1]
    same("a header", [line for line in headed.splitlines() if line[:2] == "1 " or line == "0 STEP"], text.splitlines())


def limits(subject):
    """A limit that is passed ends with 4 and leaves no file; --keep-partial keeps what was placed before."""
    code, text = subject.placed
    if code:
        _, kept, _ = subject.place("--keep-partial")
        same("a partial model has parts", kept is None or bool(re.match("1 ", kept)) or kept == "", True)
        return
    count = text.count("0 STEP")
    for limit, ends in ((count, 0), (count - 1, 4)) if count > 1 else ():
        same(f"--part-limit {limit} of {count}", subject.place(limits=["--part-limit", str(limit)])[0], ends)


def fitness(subject):
    """With a fitness that all have, the first alternative is taken; what it counts, it counts."""
    code, text, said = subject.place("--fitness", "elements <= 6")
    same("--fitness ends with", code in (0, 1, 4), True)
    if code == 0:
        same("parts with a fitness, by each engine", subject.place("--fitness", "elements <= 6", "--engine", "vm")[1], text)


QUICK = [by_steps, by_model]
OF_GRAMMARS = [loads, keeps_its_meaning, says_json, same_bytes, files, limits, fitness, placed_by_interface]
