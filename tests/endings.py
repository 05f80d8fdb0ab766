#!/usr/bin/env python3
"""Asks every command that takes -o to write files of every ending that Tartan knows: endings.py TARTAN [SHARE].

Of the endings that a command says it does not write, every SHAREth is tried (1, all, if none is given).

Either the file is in the format that its name promises, or an error lists the endings that there are, and nothing is written. An SVG has its paths in
units of the page: no transform makes it smaller than a thousandth, which browsers would lose thin lines by."""
import csv
import io
import json
import os
import re
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
import zipfile
from concurrent.futures import ThreadPoolExecutor

TARTAN = os.path.abspath(sys.argv[1])
SHARE = int(sys.argv[2]) if len(sys.argv) > 2 else 1
SOURCE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
TEST_FILES = os.path.join(SOURCE, "tests/cli/files")
failures = []

# Command lines, without -o; the words are split at blanks. {} is a folder with the files below, {files} that of the other tests.
COMMANDS = """
build {}/own.plan
disasm {}/own.plan
check {}/own.plan --relations
match {}/own.plan {}/some.plans
prune {}/own.plan {}/some.plans
count {}/own.plan
count {}/own.plan --by floor
count {files}/cabins.plan --library cottages --by floor-area --plan #10
count bricks --parts 2
complete {}/own.plan room|...
complete {}/own.plan room|... --least floor
enumerate {}/own.plan --limit 3
enumerate {files}/cabins.plan --library cottages --limit 3
enumerate bricks --parts 2 --limit 3
sample {}/own.plan 3
sample {files}/cabins.plan 3 --library cottages
sample {}/own.plan 3 --shards 2
best {}/own.plan 3 --most floor
best {files}/cabins.plan 3 --library cottages --plan #10 --most floor-area
pareto {}/own.plan --most floor --least floor
pareto {files}/cabins.plan --library cottages --plan #10 --most floor-area --least bedrooms
diff {}/own.plan {}/edited.plan
diff {files}/cabins.plan {files}/cabins.plan --library cottages
explain {}/own.plan #0
explain {}/own.plan --plan {}/some.plans
explain {}/own.plan --plan {}/one.plans
explain {files}/cabins.plan #10:77
explain {files}/cabins.plan #10: --library cottages
explain {files}/cabins.plan #77 --library cottages
explain {}/two.solid
draw {}/own.plan
draw {}/own.plan {}/some.plans
draw {files}/cabins.plan --library cottages --sample 2
draw {}/ball.field
draw {}/two.solid
rule lahave stranded
rule lahave stranded --edit remove --part 1
report {}/own.plan --sample 2
report {files}/cabins.plan --library cottages --sample 2
report bricks --pictures 2
mesh {}/ball.field
mesh {}/two.solid
slice {}/ball.field --layer 1
slice {}/two.solid --layer 1
place {}/tower.kit
place {}/row.pcfg
inspect {}/tower.ldr --kit bricks
grow square --steps 2
house {files}/cabins.plan #10:77
house {files}/cabins.plan #10:77 --view elevation:front
vary {files}/cabins.plan #10:77
export {}/own.plan --prolog
export {}/own.plan --regex --rule stores-together
export {}/tower.kit --pcfg
export {}/tower.ldr --kit bricks
map {}/words.bnf --genome 1
map {}/words.bnf --random 2
runs show {}/words.run
runs replay {}/words.run 1
evolve {}/words.study
breed {}/words.study
shards new {}/own.plan --shards 2
shards status {}/lines.set
shards check {}/lines.set
shards cat {}/lines.set
shards cat {}/csv.set
shards merge {}/lines.set
"""

FILES = {
    "ball.field": "unit mm\nsurface ball = x*x + y*y + z*z - 9\ngrid 8\n",
    "two.solid": "solid two {\n  box low from (0, 0, 0) to (4, 2, 3);\n  box high from (3, 0, 1) to (7, 2, 4);\n}\n",
    "tower.kit": 'use "bricks";\nspace all = box(4 studs, 2 bricks, 1 stud);\nrule stone at stud, tube = 3004 in 71 | 3005 in 72;\n'
                 'model tower {\n  inside all;\n  start stud at (-1.5 studs, 0, 0) by stone;\n}\n',
    "row.pcfg": "Start -> 'PlaceBoundingBox(4,4,4)' 'Place(3003)'\n",
    "words.bnf": '<s> ::= "hello" | "world" | <s> <s>\n',
    "words.study": 'evolution {\n  grammar "words.bnf"\n  match "hello"\n  population 8\n  generations 2\n  seed 7\n}\n',
}


def tartan(*words, folder=None):
    return subprocess.run([TARTAN, *words], capture_output=True, cwd=folder, stdin=subprocess.DEVNULL, timeout=300, check=False)


def formats():
    """The endings of each format."""
    with open(os.path.join(SOURCE, "runtime/base/formats.def"), encoding="ascii") as table:
        rows = re.findall(r'^FORMAT\((\w+), "\w*", "([^"]*)", \w+, ".*"\)', table.read(), re.M)
    return [endings.split()[:1] if name == "FOREIGN" else endings.split() for name, endings in rows]


def known_endings():
    return [ending for endings in formats() for ending in endings]


# ---- what a file of an ending has to be


def numbers(text):
    return [float(number) for number in re.findall(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?", text)]


def scale_of(transform):
    """By how much a transform makes things larger."""
    scale = 1.0
    for kind, inside in re.findall(r"(\w+)\(([^)]*)\)", transform or ""):
        values = numbers(inside)
        if kind == "matrix":
            scale *= abs(values[0] * values[3] - values[1] * values[2]) ** 0.5
        elif kind == "scale":
            scale *= abs(values[0] * values[-1]) ** 0.5
    return scale


def check_scales(element, scale=1.0):
    scale *= scale_of(element.get("transform")) * scale_of(element.get("patternTransform"))
    assert scale >= 1e-3, f"a transform by {scale}"
    for number in numbers(element.get("d", "") if element.tag.endswith("path") else ""):
        assert abs(number) < 1e6, f"a coordinate of {number}"
    for child in element:
        check_scales(child, scale)


def is_svg(data):
    root = xml.fromstring(data)
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    check_scales(root)


def is_html(data):
    text = data.decode()
    assert text.lower().startswith("<!doctype html>")
    for transform in re.findall(r'transform="([^"]*)"', text):
        assert scale_of(transform) >= 1e-3, transform


def is_glb(data):
    magic, version, size, length, _ = struct.unpack("<IIIII", data[:20])
    assert (magic, version, size) == (0x46546C67, 2, len(data))
    json.loads(data[20:20 + length])


def is_stl(data):
    assert len(data) == 84 + 50 * struct.unpack("<I", data[80:84])[0]


def is_json(data):
    for line in data.decode().splitlines() if data.count(b"\n{") else [data]:
        json.loads(line)


def is_csv(data):
    rows = list(csv.reader(io.StringIO(data.decode())))
    assert len(rows) > 1 and len({len(row) for row in rows}) == 1 and len(set(rows[0])) == len(rows[0]) > 1


def is_dxf(data):
    lines = data.decode("utf-8").splitlines()
    assert all(code.strip().isdigit() for code in lines[::2]) and lines[-1] == "EOF"


def is_3mf(data):
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        xml.fromstring(archive.read("3D/3dmodel.model"))


def is_obj(data):
    assert all(re.fullmatch(r"(#.*|(v|vn|vt|f|l|g|o|s|mtllib|usemtl) .*|)", line) for line in data.decode().splitlines()) and b"\nv " in b"\n" + data


def is_ldraw(data):
    assert all(re.match(r"[0-5](\s|$)", line) for line in data.decode().splitlines() if line) and b"\n1 " in b"\n" + data


def begins(*words):
    def check(data):
        assert data.startswith(words), data[:40]
    return check


def has(pattern):
    def check(data):
        assert re.search(pattern, data, re.M), data[:80]
    return check


def compiles(ending):
    def check(data):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "made" + ending)
            with open(path, "wb") as file:
                file.write(data)
            assert tartan("check", path).returncode == 0
    return check


CHECKS = {
    "svg": is_svg, "png": begins(b"\x89PNG\r\n"), "pdf": begins(b"%PDF-"), "obj": is_obj, "mtl": begins(b"newmtl "), "ply": begins(b"ply\n"), "stl": is_stl,
    "off": begins(b"OFF"), "om": begins(b"OM"), "glb": is_glb, "3mf": is_3mf, "scad": has(rb"polyhedron\("), "ifc": begins(b"ISO-10303-21;"),
    "dxf": is_dxf, "cli": begins(b"$$HEADERSTART"), "csv": is_csv, "bin": begins(b"TARTANPL"), "parquet": begins(b"PAR1"),
    "html": is_html, "htm": is_html, "ldr": is_ldraw, "mpd": is_ldraw, "tnb": compiles(".tnb"), "pl": has(rb"^\w+\(.*:-"),
    "pcfg": has(rb"->"), "kit": compiles(".kit"), "plan": compiles(".plan"),
    **{ending: is_json for ending in ("json", "jsonl", "ndjson")},
    **{ending: begins(b"SQLite format 3\0") for ending in ("sqlite", "sqlite3", "db")},
}


def ask(words, ending, folder):
    """Did it write a file, and what is wrong with what it does; None where nothing is."""
    with tempfile.TemporaryDirectory(dir=folder) as empty:
        done = tartan(*words, "-o", "made." + ending, folder=empty)
        made = os.listdir(empty)
        said = done.stderr.decode()
        if done.returncode != 0:
            named = re.search(r"end its name in \.\w+|another ending|a folder: name one|otherwise|leave out -o|write an \.\w+ file|let it end in|add `-o NAME\.\w+", said)
            if made or not named:
                return False, f"exit {done.returncode}, {made} made: {said[:300]}"
            return False, None
        beside = {f"made.{table}.{ending}" for table in ("rooms", "faces")} if ending in ("csv", "parquet") else {"made.mtl"} if ending == "obj" else set()  # of houses
        if set(made) - beside != {"made." + ending} or len(made) not in (1, 1 + len(beside)):
            return True, f"it made {made}"
        if ending not in CHECKS:
            return True, "it writes what nothing is known of"
        try:
            for name in made:
                with open(os.path.join(empty, name), "rb") as file:
                    data = file.read()
                CHECKS[name.rpartition(".")[2]](data)
        except Exception as wrong:  # whatever a reader says
            return True, f"it is no .{ending}: {wrong!r}"
        return True, None


def told(command):
    """The endings that the command's help has beside -o."""
    said = tartan("help", command).stdout.decode()
    option = re.search(r"^ +-o, --output.*\n(?: {16,}.*\n)*", said, re.M).group()
    return {ending for ending in re.findall(r"\.(\w+)", option) if ending in known_endings()}


def asked_of(number, words, folder):
    """The endings to try: those that the command and its help say it writes, and a share of the others."""
    with tempfile.TemporaryDirectory(dir=folder) as empty:
        said = tartan(*words, "-o", "made.nonsense", folder=empty).stderr.decode()
    named = set(re.findall(r"\.(\w+)", said)) | told(words[0])
    return [ending for k, ending in enumerate(known_endings()) if ending in named or (number + k) % SHARE == 0]


def prepare(folder):
    for name, text in FILES.items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    for words in ("new own.plan", "sample own.plan 5 -o some.plans", "sample own.plan 1 -o one.plans", "place tower.kit -o tower.ldr", "evolve words.study -o words.run",
                  "shards new own.plan -o lines.set --shards 2 --to 9", "shards run lines.set", "shards new own.plan -o csv.set --shards 2 --to 9 --format csv",
                  "shards run csv.set"):
        done = tartan(*words.split(), folder=folder)
        assert done.returncode == 0, (words, done.stderr.decode())
    with open(os.path.join(folder, "own.plan"), encoding="utf-8") as file:
        text = file.read()
    with open(os.path.join(folder, "edited.plan"), "w", encoding="utf-8") as file:
        file.write(text.replace("trays 4..6", "trays 4..5"))


def check_help(written):
    """Help names a format beside -o if the command writes it, and no other. written: command -> endings of what it was seen to write"""
    for command, made in written.items():
        named = told(command)
        for endings in formats():
            if "study" in endings:  # rule files: what is read
                continue
            if made & set(endings) and not named & set(endings):
                failures.append(f"the help of {command} does not say beside -o that it writes .{endings[0]}")
            elif named & set(endings) and not made & set(endings):
                failures.append(f"the help of {command} says beside -o that it writes .{endings[0]}")


def main():
    lines = [line for line in COMMANDS.splitlines() if line]
    names = re.findall(r"^  (\w[\w-]*)  ", tartan("help").stdout.decode(), re.M)
    taking = {name for name in names if b"-o, --output" in tartan("help", name).stdout}
    missing = taking - {line.split()[0] for line in lines}
    if missing:
        failures.append(f"commands that are not asked: {missing}")
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        prepare(folder)
        commands = [line.replace("{}", folder).replace("{files}", TEST_FILES).split() for line in lines]
        endings = pool.map(lambda number: asked_of(number, commands[number], folder), range(len(commands)))
        asked = [(line, words, ending) for line, words, some in zip(lines, commands, endings) for ending in some]
        written = {}
        for (line, _, ending), (wrote, wrong) in zip(asked, pool.map(lambda a: ask(a[1], a[2], folder), asked)):
            if wrong:
                failures.append(f"{line} -o made.{ending}: {wrong}")
            written.setdefault(line.split()[0], set()).update({ending} if wrote else ())
        check_help(written)
    print("\n".join(failures[:60]) or "fine")
    sys.exit(bool(failures))


main()
