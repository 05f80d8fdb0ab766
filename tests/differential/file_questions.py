"""Questions that files of any notation are asked.

A question is a function that is given a Subject and raises Wrong where two answers differ."""
import os
import re

from mend import errors
from program import answer, read_json, run, same, same_lines


def checks(subject):
    """`check` ends as it should, and says the same as the exit code does."""
    errors(subject.path)


def loads(subject):
    """What `check` accepts can be built; the module can be loaded, and is the same when it is built again."""
    modules = [os.path.join(subject.folder, name) for name in ("built.tnb", "again.tnb")]
    for module in modules:
        answer("build", subject.path, "-o", module)
    answer("disasm", modules[0])
    same("a module built twice", *map(content, modules))
    return modules[0]


def content(path):
    with open(path, "rb") as file:
        return file.read()


def keeps_its_meaning(subject):
    """`fmt` gives a text of the same meaning, and the same text where it is used twice."""
    before = meaning(subject.path)
    try:
        laid_out = formatted(subject.path)
        same("fmt twice", formatted(subject.path), laid_out)
        same_lines("fmt keeps the meaning", meaning(subject.path), before)
    finally:
        subject.file(os.path.basename(subject.path), subject.text)


def formatted(path):
    code, _, err = run("fmt", path)
    same("fmt refuses what check accepts", err[:200] if code else "", "")
    return content(path).decode()


def meaning(path):
    """The listing of a module, without places: lines, columns, and names that are made of them."""
    listing = answer("disasm", path)
    listing = re.sub(r" *\([^\s()]*\.[a-z]+:\d+(:\d+)?\)|^(module|written by|source | *;).*$", "", listing, flags=re.M)
    listing = "\n".join(line for line in listing.split("\n") if line.strip())
    return re.sub(r"(require|prune)@\d+(\.\d+)?", r"\1@", listing)


def says_json(subject):
    code, _, err = run("check", subject.path, "--diagnostics=json")
    read_json("check --diagnostics=json", err or "[]")
    same("check of a file that is accepted", code, 0)


OF_FILES = [loads, keeps_its_meaning, says_json]
