#!/usr/bin/env python3
"""Holds what questions say of the text of rule files to what commands do: ask_source.py PROGRAM TARTAN [SCHEMA]

PROGRAM asks through the C interface (ask_interface.c). `check` answers what `tartan check --diagnostics=json` says, and compiling does not;
`format` has the text that `tartan fmt` writes. With SCHEMA, answers follow it, too."""
import json
import os
import shutil
import subprocess
import sys
import tempfile

from ask_files import asked_of, first_error

# Files of the test's own. The second has characters of one to four bytes, and a byte order mark.
FILES = {
    "odd.plan": "schema s { door = flag }\nrule all = tray(door) or not tray(door)\nrule pair = neighbour(tray(door), tray(door))\n"
                "library rows using s { trays 1..3 prune pair require all }\n",
    "marked.plan": "\ufeffschema s { door = flag } # \u00e9\u4e2d\U0001f3e0\nrule all \"\u00e9\u4e2d\U0001f3e0\" = tray(door) or not tray(door)\n",
    "wild.plan": "schema s { door = flag }\nRULE a=tray(  door )# why\nrule b \"two\"=a\n",
    "empty.plan": "# nothing\n",
    "growing.bnf": "<a> ::= <a> <a> <a> | <a> <a> | \"x\"\n",
    "squashed.solid": "solid s {\n  box a from (0, 0, 0) to (4, 4, 4);\n  box b from (1, 1, 1) to (5, 3, 3);\n  box c from (20, 0, 0) to (21, 1, 1);\n}\n",
    "divides.plan": "schema s { width = 0m | 1m }\nmeasure m = sum(1m / width)\nlibrary rows using s { trays 1..2 }\n",
}

# Question: file, request, and the command's words behind the file's name.
ASKED = {
    "check": [
        ("odd.plan", {}, ""), ("marked.plan", {}, ""), ("empty.plan", {}, ""), ("growing.bnf", {}, ""), ("growing.bnf", {"figures": True}, "--figures"),
        ("odd.plan", {"figures": True}, "--figures"), ("squashed.solid", {}, ""), ("squashed.solid", {"max_boxes": 1}, "--max-boxes 1"),
        ("divides.plan", {}, ""), ("tests/cli/files/relations.plan", {"max_states": 20, "threads": 1}, "--max-states 20 --threads 1"),
        ("tests/cli/files/sheds.plan", {}, ""), ("tests/cli/files/huts.plan", {}, ""), ("tests/cli/files/cabins.plan", {}, ""), ("stdlib/koch.hemls", {}, ""),
        ("stdlib/bricks.kit", {}, ""), ("tests/cli/files/ball.field", {}, ""),
    ],
    "format": [(file, {}, "") for file in (
        "odd.plan", "marked.plan", "wild.plan", "growing.bnf", "squashed.solid", "tests/cli/files/cabins.plan", "stdlib/koch.hemls", "stdlib/bricks.kit",
        "tests/cli/files/ball.field", "tests/cli/files/sheds.plan")],
}


def without(item, *keys):
    return {key: value for key, value in item.items() if key not in keys}


def said_by(tartan, command, file, words):
    """What the command says as JSON, and how it ends."""
    done = subprocess.run([tartan, command, file, "--diagnostics=json", *words], capture_output=True, text=True, check=False)
    return json.loads(done.stderr), done.returncode


def wrong_place(place):
    """Are UTF-16 offsets those of the line and the column?"""
    if place["line"] is None:
        return place["utf16_begin"] is not None
    with open(place["file"], "rb") as opened:
        lines = opened.read().removeprefix(b"\xef\xbb\xbf").split(b"\n")

    def units(line, column):
        before = b"".join(one + b"\n" for one in lines[:line - 1]) + lines[line - 1][:column - 1]
        return len(before.decode().encode("utf-16-le")) // 2

    return [place["utf16_begin"], place["utf16_end"]] != [units(place["line"], place["column"]), units(place["end_line"], place["end_column"])]


def wrong_check(answer, tartan, file, words, folder):
    whole, code = said_by(tartan, "check", file, words.split())
    if answer.startswith("error"):
        return None if code in (2, 4) and answer[6:] == whole[-1]["message"] else f"the command says {whole}, the answer is {answer}"
    opening, _ = said_by(tartan, "build", file, ["-o", os.path.join(folder, "made.tnb")])
    answer = json.loads(answer)
    found = [{**without(item, "utf16_begin", "utf16_end"), "notes": [without(note, "end_line", "end_column", "utf16_begin", "utf16_end") for note in item["notes"]]}
             for item in answer["findings"]]
    if found != [item for item in whole if item not in opening]:
        return f"the command says {whole}, the answer is {answer}"
    if [answer[f"{kind}s"] for kind in ("error", "warning", "note")] != [sum(item["severity"] == kind for item in found) for kind in ("error", "warning", "note")]:
        return f"wrong counts: {answer}"
    if any(wrong_place(place) for item in answer["findings"] for place in (item, *item["notes"])):
        return f"wrong offsets: {answer}"
    return None


def wrong_format(answer, tartan, file, folder):
    laid = shutil.copy(file, os.path.join(folder, "laid-" + os.path.basename(file)))
    done = subprocess.run([tartan, "fmt", laid], capture_output=True, text=True, check=False)
    if done.returncode:
        return None if answer == first_error(done.stderr) else f"the command says {done.stderr}, the answer is {answer}"
    answer = json.loads(answer)
    with open(file, encoding="utf-8", newline="") as old, open(laid, encoding="utf-8", newline="") as new:
        old, new = old.read(), new.read()
    return None if answer == {"same": old == new, "text": new} else f"the command writes {new!r:.300}, the answer is {str(answer):.300}"


def main():
    program, tartan = sys.argv[1:3]
    validators = {}
    if len(sys.argv) > 3:
        import jsonschema

        with open(sys.argv[3], encoding="utf-8") as opened:
            schema = json.load(opened)
        validators = {question: jsonschema.Draft202012Validator({"$defs": schema["$defs"], **schema["answers"][question]}) for question in ASKED}
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        for name, text in FILES.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as out:
                out.write(text)
        for question, rows in ASKED.items():
            for file, request, words in rows:
                path = os.path.join(folder, file) if file in FILES else file
                answer = asked_of(program, question, path, request)
                found = wrong_check(answer, tartan, path, words, folder) if question == "check" else wrong_format(answer, tartan, path, folder)
                if not found and question in validators and not answer.startswith("error"):
                    found = "; ".join(error.message[:200] for error in validators[question].iter_errors(json.loads(answer)))
                if found:
                    wrong.append(f"{question} {file} {request}: {found}")
    print("\n".join(wrong) or "fine")


if __name__ == "__main__":
    main()
