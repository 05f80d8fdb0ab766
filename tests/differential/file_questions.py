"""Questions that files of any notation are asked.

A question is a function that is given a Subject and raises Wrong where two answers differ."""
import os
import random
import re

from mend import errors
from program import answer, read_json, run, same, same_lines
from tree import words


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
    """The listing of a module, without places: lines, columns, and names that are made of them; and without blanks, as names of calls are
    made of their texts."""
    listing = answer("disasm", path)
    listing = re.sub(r" *\([^\s()]*\.[a-z]+:\d+(:\d+)?\)|^(module|written by|source | *;).*$", "", listing, flags=re.M)
    listing = "\n".join(re.sub(r"\s", "", line) for line in listing.split("\n") if line.strip())
    return re.sub(r"(require|prune|generate|weight|prefer)@\d+(\.\d+)?", r"\1@", listing)


def scattered(subject):
    """Of notations in which line ends mean nothing: the file's words with other blanks between them, line ends and comments, mean the same,
    also when `fmt` has laid them out; it keeps every comment, in order."""
    if subject.tree is None:
        return
    chosen, before, gaps = random.Random(subject.text), meaning(subject.path), []
    for _ in words(subject.tree):
        gaps.append(chosen.choices([" ", "\n", f" # remark {len(gaps)}\n", f"\n\n# note {len(gaps)}\n", "\t  "], [12, 2, 1, 1, 2])[0])
    comments = re.findall(r"# \w+ \d+", "".join(gaps))
    try:
        subject.file(os.path.basename(subject.path), "".join(word + gap for word, gap in zip(words(subject.tree), gaps)))
        same_lines("other blanks and comments keep the meaning", meaning(subject.path), before)
        laid_out = formatted(subject.path)
        same("fmt keeps comments", re.findall(r"# \w+ \d+", laid_out), comments)
        same("fmt of comments twice", formatted(subject.path), laid_out)
        same_lines("fmt keeps the meaning of what has comments", meaning(subject.path), before)
    finally:
        subject.file(os.path.basename(subject.path), subject.text)


def says_json(subject):
    code, _, err = run("check", subject.path, "--diagnostics=json")
    read_json("check --diagnostics=json", err or "[]")
    same("check of a file that is accepted", code, 0)
