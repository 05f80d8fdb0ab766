#!/usr/bin/env python3
"""Coverage says of a change what `tartan diff` and `tartan test` say of a file in which it is written out.

    coverage_edits.py FILE [LIBRARY]

Each change that can be written in the language is made in the text: `diff` counts the plans that only one of the two
libraries holds, and `test` tells whether a case comes out otherwise. Then the tests that `--write-tests` writes are
appended: they pass, and nothing survives that had one.
"""
import json
import os
import subprocess
import sys
import tempfile

NEVER, ALWAYS = "(any and not any)", "(not (any and not any))"
MOST = 60  # changes of a file that are written out


def tartan(*arguments):
    return subprocess.run([os.environ["TARTAN"], *arguments], capture_output=True, text=True)


def measured(path, library):
    said = json.loads(tartan("test", path, "--coverage", "--json", *library).stdout)
    return said, said["coverage"][0]


def left_out(before, after):
    """The text around an item without it, and without the comma or `or` beside it; None where that is not clear."""
    head, tail = before.rstrip(), after.lstrip()
    for mark in (",", "or "):
        if tail.startswith(mark):
            return head + " " + tail[len(mark):]
        if head.endswith(mark.rstrip()):
            return head[: -len(mark.rstrip())] + " " + tail
    return head + tail if head.endswith("(") and tail.startswith(")") else None


def edited(text, part):
    """The file with the change, on as many lines; None where the language has no way to write it."""
    lines = text.encode().split(b"\n")
    begin = sum(len(line) + 1 for line in lines[: part["line"] - 1]) + part["column"] - 1
    before, changed, after = (
        piece.decode() for piece in (text.encode()[:begin], text.encode()[begin : begin + part["bytes"]], text.encode()[begin + part["bytes"] :])
    )
    breaks = "\n" * changed.count("\n")
    change = part["change"]
    if change == "never matches":
        return before + NEVER + breaks + after
    if change == "always matches":
        return before + ALWAYS + breaks + after
    if change == "is any tray":
        return before + "tray()" + breaks + after
    if change.startswith("changed to"):
        return before + part["to"] + breaks + after
    if change == "left out" and part["kind"] == "item":
        return left_out(before, after)
    return None


def check_change(path, text, part, library, failed, scratch):
    """Whether it could be compared."""
    other = edited(text, part)
    if other is None or part["flips"] is None or part.get("alone"):
        return False
    after = os.path.join(scratch, "after.plan")
    with open(after, "w") as file:
        file.write(other)
    difference = tartan("diff", path, after, "--json", *library)
    if difference.returncode != 0:
        return False
    total = json.loads(difference.stdout)["total"]
    count = int(total["removed"]) + int(total["added"])
    assert count == int(part["flips"]), f"{path}: {part}: {count} plans"
    counts = json.loads(tartan("test", after, "--json").stdout)
    assert part["noticed"] or counts["failed"] == failed, f"{path}: {part}: a test notices"
    assert not part["noticed"] or counts["failed"] != failed or failed > 0, f"{path}: {part}: no test notices"
    return True


def check_written(path, text, said, coverage, library, scratch):
    written = tartan("test", path, "--write-tests", *library).stdout
    after = os.path.join(scratch, "written.plan")
    with open(after, "w") as file:
        file.write(text + written)
    again, more = measured(after, library)
    assert again["failed"] == said["failed"], f"{path}: a test that was written fails"
    untold = sum(1 for rule in coverage["rules"] for part in rule["parts"] if part["outcome"] == "survives" and "test" not in part and part["of"] == "plans")
    plans = sum(1 for rule in more["rules"] for part in rule["parts"] if part["outcome"] == "survives" and part["of"] == "plans")
    assert plans == untold, f"{path}: {plans} changes survive, not {untold}"


def main(path, *names):
    library = ["--library", names[0]] if names else []
    with open(path) as file:
        text = file.read()
    said, coverage = measured(path, library)
    parts = [part for rule in coverage["rules"] for part in rule["parts"] if part["of"] == "plans" and part.get("file") == path]
    with tempfile.TemporaryDirectory() as scratch:
        step = max(1, len(parts) // MOST)
        compared = sum(check_change(path, text, part, library, said["failed"], scratch) for part in parts[::step])
        check_written(path, text, said, coverage, library, scratch)
    assert compared >= min(8, len(parts) // 3), f"{path}: only {compared} of {len(parts)} changes were compared"
    print(f"{path}: {compared} changes compared")


main(*sys.argv[1:])
