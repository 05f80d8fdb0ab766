#!/usr/bin/env python3
"""Free floors of random cells, judged by an independent slow model too: floor_oracle.py MODEL.py FLOOR_ANSWERS FIRST COUNT

To each cell of the model are added, by the same seed, stairs in the air and sides that flights meet. Then cells of it are asked in nanometres
too: each number times a million, and an odd one aside."""
import importlib.util
import json
import random
import subprocess
import sys

SIDES = {"back": 1, "front": 2, "left": 3, "right": 4}
KINDS = {"door": 0, "open": 1, "met": 2}


def load(path):
    spec = importlib.util.spec_from_file_location("model", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def more(cell, seed):
    """As it is; or with what flights of stairs add."""
    r = random.Random(-seed)
    if r.random() < 0.5:
        return cell
    x0, x1, y0, y1 = cell["clear"]
    for passage in cell["passages"]:
        if passage["kind"] == "open" and r.random() < 0.5:
            passage["kind"] = "met"
    cell["apart"] = [sorted(r.sample(range(x0, x1 + 1), 2)) + sorted(r.sample(range(y0, y1 + 1), 2)) for _ in range(r.randrange(2))]
    if r.random() < 0.3:
        cell["keeps"] = []
    return cell


def scaled(value, by, aside):
    if isinstance(value, dict):
        return {key: scaled(item, by, aside) if key in ("clear", "obstacles", "keeps", "passages", "leaves", "landings", "apart", "from", "to")
                else item * by if key == "way" else item for key, item in value.items()}
    if isinstance(value, list):
        return [scaled(item, by, aside) for item in value]
    return value * by + aside if isinstance(value, int) else value


def numbers(cell):
    out = [cell["way"], *cell["clear"]]
    for name in ("obstacles", "keeps"):
        out += [len(cell[name]), *(v for box in cell[name] for v in box)]
    out.append(len(cell["passages"]))
    for passage in cell["passages"]:
        out += [SIDES[passage["side"]], KINDS[passage["kind"]], passage["from"], passage["to"]]
    for name in ("leaves", "landings", "apart"):
        boxes = cell.get(name, [])
        out += [len(boxes), *(v for box in boxes for v in box)]
    return " ".join(map(str, out))


def flags(values):
    return "".join(str(int(value)) for value in values)


def expected(answer):
    joined = "".join("".join("%d " % part for part in parts) + "/" for parts in answer["joined"])
    return "%d;%s;%s;%s;%d;%d" % (answer["parts"], joined, flags(answer["keeps"]), flags(answer["leaves"]), answer["ways"], answer["fits"])


def lengths(cell):
    """From the middle of each passage and landing to that of each; and whether some way is longer than a straight one."""
    half = cell["way"] // 2
    boxes = [model.line(cell["clear"], passage, half) for passage in cell["passages"]] + [model.centre(box) for box in cell["landings"]]
    ends = [((box[0] + box[1]) // 2, (box[2] + box[3]) // 2) for box in boxes]
    found = model.walks(cell, ends)
    text = "".join("- " if found[p, q] is None else "%d " % found[p, q] for p in ends for q in ends)
    return text, any(found[p, q] is not None and found[p, q] > 1 + abs(p[0] - q[0]) + abs(p[1] - q[1]) for p in ends for q in ends)


WALKED = 3      # one cell of so many: the model takes its time for ways
model, program, first, count = load(sys.argv[1]), sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
cells = [more(model.random_cell(seed), seed) for seed in range(first, first + count)]
cells += [scaled(cell, 1000000, cell["seed"] % 2) for cell in cells[: count // 4]]
done = subprocess.run([program], input="\n".join(map(numbers, cells)), capture_output=True, text=True)
answers = done.stdout.splitlines()
bad, fit, bent = 0, 0, 0
for cell, got in zip(cells, answers):
    wanted = model.judge(cell)
    fit += wanted["fits"]
    got, ways = got.rsplit(";", 1)
    if got != expected(wanted):
        bad += 1
        print("differs:", json.dumps(cell), got, expected(wanted), sep="\n  ")
    if cell["seed"] % WALKED:
        continue
    wanted, longer = lengths(cell)
    bent += longer
    if ways != wanted:
        bad += 1
        print("ways differ:", json.dumps(cell), ways, wanted, sep="\n  ")
print(len(answers), "cells,", fit, "fit,", bent, "with ways round something,", bad, "differences")
sys.exit(bad > 0 or done.returncode != 0 or len(answers) != len(cells) or not 0 < fit < len(cells) or not bent)
