#!/usr/bin/env python3
"""Modules of released versions mean what they meant.

    modules.py numbers PROGRAM VERSION [--update]
        What modules number (PROGRAM without arguments prints it, tests/numbers.c) is what tests/modules/numbers.txt lists. A
        row that is new there has to be added, by hand or by --update; one that is gone stays in the list, as `gone`, so that
        its number is not given again.
    modules.py coverage PROGRAM
        Each instruction of a released version is in some module of tests/modules.
    modules.py answers TARTAN [--update VERSION]
        The commands in tests/modules/VERSION/answers.txt answer as they did when that version was released.

A line of the list is, with tabs between: kind, name, number, what else never changes, and the version that it came with
or `gone`.
"""
import collections
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

MODULES = pathlib.Path(__file__).resolve().parent / "modules"
LIST = MODULES / "numbers.txt"
HEAD = """# What modules number, and the version that gave the number: tests/modules.py says what a line is.
# Lines are added, and marked as gone; nothing else in them ever changes.
"""

Row = collections.namedtuple("Row", "kind name number detail since")


def fail(message):
    print(message)
    sys.exit(1)


def read_row(line, since=None):
    kind, name, number, detail, *rest = line.split("\t")
    return Row(kind, name, int(number), detail, since or rest[0])


def written(rows):
    return HEAD + "".join("\t".join(map(str, row)) + "\n" for row in rows)


def read_list():
    lines = LIST.read_text().splitlines() if LIST.exists() else []
    return [read_row(line) for line in lines if not line.startswith("#")]


def read_tables(program, version):
    said = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    return [read_row(line, version) for line in said.splitlines()]


# ---- numbers


def scope(row):
    """What a number is given once in: choices in their setting, fields and flags in their record, and so on."""
    return row.kind, row.name.rpartition(":")[0]


def doubles(rows):
    seen = {}
    for row in rows:
        other = seen.setdefault((scope(row), row.number), row)
        if other is not row:
            yield f"{row.kind} {row.name} has the number {row.number}, which was given to {other.name}"


def differences(listed, made):
    """What is wrong with the tables, by the list; and the list as it would be right."""
    tables = {(row.kind, row.name): row for row in made}
    wrong, merged = [], []
    for row in listed:
        now = tables.pop((row.kind, row.name), None)
        if now and row.since == "gone":
            wrong.append(f"{row.kind} {row.name} is there again, and is `gone` in the list: give it another name")
        elif not now and row.since != "gone":
            wrong.append(f"{row.kind} {row.name} is not in the tables any more: mark it as `gone`")
            row = row._replace(since="gone")
        elif now and (now.number, now.detail) != (row.number, row.detail):
            wrong.append(f"{row.kind} {row.name} is {now.number} {now.detail}; modules hold it as {row.number} {row.detail}")
        merged.append(row)
    for row in tables.values():
        wrong.append(f"{row.kind} {row.name} is new: add it, with its number {row.number}")
        at = max((i for i, other in enumerate(merged) if scope(other) == scope(row)), default=len(merged) - 1)
        merged.insert(at + 1, row)
    return wrong, merged


def check_numbers(program, version, update=False):
    made, listed = read_tables(program, version), read_list()
    wrong, merged = differences(listed, made)
    wrong = [line for line in wrong if not update or " modules hold it " in line] + list(doubles(merged))
    if update and not wrong:
        LIST.write_text(written(merged))
    if wrong:
        fail("\n".join([*wrong, f"{LIST.name} lists what modules hold; --update adds to it"]))
    # The test itself: a change of a row of any kind is found.
    for row in {row.kind: row for row in made}.values():
        others = [other for other in made if other != row]
        for change in ([row._replace(number=row.number + 1)], [row._replace(detail="other")], []):
            if not differences(merged, others + change)[0]:
                fail(f"a change of {row.kind} {row.name} goes unseen")


# ---- coverage


def check_coverage(program):
    kept = sorted(str(path) for path in MODULES.glob("*/*.tnb"))
    said = subprocess.run([program, *kept], capture_output=True, text=True)
    if said.returncode != 0:
        fail(said.stderr)
    held = set(map(int, said.stdout.split()))
    released = {path.name for path in MODULES.iterdir() if path.is_dir()}
    lost = [row for row in read_list() if row.kind == "instruction" and row.since != "gone" and row.number not in held]
    for row in lost:
        print(f"no module has {row.name}, of {row.since}")
    if any(row.since in released for row in lost):
        fail("add a rule file with it to the folder of that version, with the module that it made of it")


# ---- answers


def answer(tartan, folder, command):
    """What a command writes, and where it fails what it says of that."""
    ran = subprocess.run([tartan, *shlex.split(command)[1:]], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True,
                         text=True, timeout=600)
    said = ran.stdout if ran.returncode == 0 else ran.stdout + ran.stderr
    return f"$ {command}\n{said}[exit {ran.returncode}]\n"


def check_answers(tartan, update=None):
    wrong = []
    for version in sorted(path for path in MODULES.iterdir() if path.is_dir()):
        golden = version / "answers.txt"
        wanted = re.findall(r"^\$ .*?^\[exit \d+\]\n", golden.read_text(), re.M | re.S)
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch) / version.name
            shutil.copytree(version, folder)
            got = [answer(tartan, folder, one.splitlines()[0][2:]) for one in wanted]
        if update == version.name:
            golden.write_text("".join(got))
        else:
            wrong += [f"{version.name}: wanted\n{one}got\n{other}" for one, other in zip(wanted, got) if one != other]
        asked = {word for one in wanted for word in shlex.split(one.splitlines()[0]) if word.endswith(".tnb")}
        wrong += [f"{version.name}: {path.name} is asked nothing" for path in version.glob("*.tnb") if path.name not in asked]
        if not wanted or "".join(wanted) != golden.read_text() and update is None:
            wrong.append(f"{golden} has other lines than commands with their answers")
    if wrong:
        fail("\n".join(wrong))


def main(what, program, *rest):
    program = str(pathlib.Path(program).resolve())
    if what == "numbers":
        check_numbers(program, rest[0], "--update" in rest)
    elif what == "coverage":
        check_coverage(program)
    elif what == "answers":
        check_answers(program, rest[1] if rest[:1] == ("--update",) else None)
    else:
        fail(__doc__)


if __name__ == "__main__":
    main(*sys.argv[1:])
