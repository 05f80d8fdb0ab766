"""Formats rule files about houses that have been laid out at random: formatting gives the file back where only blanks
are others, and where lines are broken elsewhere it keeps what the file means, and every comment.

Usage: fmt_houses.py TARTAN FOLDER FILE..."""

import pathlib
import random
import re
import subprocess
import sys

tartan, folder = sys.argv[1], pathlib.Path(sys.argv[2])
PIECES = re.compile(r'"[^"\n]*"|#[^\n]*|\n|[^\S\n]+|[^\s"#]+|"')
DECLARES = {"schema", "rule", "library", "test", "form", "measure", "use", "matcher"}


def run(*arguments):
    done = subprocess.run([tartan, *arguments], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"tartan {' '.join(arguments)}: {done.stderr}")
    return done.stdout


def other_blanks(text, random):
    """The same lines, with other blanks between words and before them."""
    made = []
    for piece in PIECES.findall(text):
        blank = piece.isspace() and piece != "\n"
        made.append(random.choice([" ", "  ", "\t", " \t "]) if blank else piece)
    return "".join(made)


def other_lines(text, random):
    """The same words in other lines; a word that may begin a declaration stays in its own."""
    pieces, made = PIECES.findall(text), []
    for i, piece in enumerate(pieces):
        after = pieces[i + 1] if i + 1 < len(pieces) else ""
        bound = after in DECLARES or (i > 0 and pieces[i - 1].startswith("#"))
        if piece.isspace() and piece != "\n" and not bound:
            piece = random.choice([" ", "   ", "\n", "\n\n\n"])
        made.append(piece)
    return "".join(made)


def meaning(text):
    """What the module says, but for places in the source and for names that lines give."""
    (folder / "meant.plan").write_text(text)
    run("build", "meant.plan", "-o", "meant.tnb")
    listing = run("disasm", "meant.tnb").split("\n")[2:]
    return [re.sub(r"\(\S+:\d+(:\d+)?\)|@\d+(\.\d+)?", "", line) for line in listing if not line.startswith("  ; meant.plan")]


def comments(text):
    return [piece for piece in PIECES.findall(text) if piece.startswith("#")]


def formatted(text):
    (folder / "laid.plan").write_text(text)
    run("fmt", "laid.plan")
    return (folder / "laid.plan").read_text()


for number, path in enumerate(sys.argv[3:]):
    text = pathlib.Path(path).read_text()
    chance = random.Random(number)
    if formatted(other_blanks(text, chance)) != text:
        sys.exit(f"{path}: with other blanks, formatting does not give it back")
    laid = formatted(other_lines(text, chance))
    if formatted(laid) != laid:
        sys.exit(f"{path}: in other lines, what is formatted is formatted otherwise")
    if comments(laid) != comments(text):
        sys.exit(f"{path}: in other lines, formatting loses comments")
    if meaning(laid) != meaning(text):
        sys.exit(f"{path}: in other lines, formatting changes what it means")
