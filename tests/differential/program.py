"""Runs the command that is searched. A crash, a hang, an exit code that is not documented and JSON that is none are differences of their own."""
import json
import os
import re
import subprocess

TARTAN = os.environ.get("TARTAN", "tartan")
EXIT_CODES = {0, 1, 2, 3, 4}
TIMEOUT = 60
TOO_COARSE = {"E1417",           # a form lies between the samples that were asked for: another grid has an answer
              "E0429"}           # the best by a quotient that divides by less than 0: only some of its plans have an answer


class Wrong(Exception):
    """A difference: which question, what the program answers, what it should."""

    def __init__(self, question, got, want):
        super().__init__(question)
        self.question, self.got, self.want = question, str(got), str(want)


class Refused(Exception):
    """The program refuses the file or the question, with an error or a limit."""

    def __init__(self, code, limit):
        super().__init__(code)
        self.limit = limit


def run(*args, text=None):
    """(exit code, standard output, standard error)"""
    try:
        done = subprocess.run([TARTAN, *args], input=(text or "").encode(), capture_output=True, timeout=TIMEOUT, env=environment())
    except subprocess.TimeoutExpired:
        raise Wrong("hang", " ".join(args), f"an answer within {TIMEOUT} s") from None
    out, err = done.stdout.decode("utf8", "replace"), done.stderr.decode("utf8", "replace")
    if done.returncode not in EXIT_CODES or "Sanitizer" in err or "runtime error:" in err:
        raise Wrong("crash", f"{args[0]} ends with {done.returncode} {err[-200:]}", "a documented exit code")
    said = "error[" in err or '"severity":"error"' in err
    if done.returncode == 0 and said or done.returncode == 1 and not (said or out or "--werror" in args):
        raise Wrong("exit", f"{args[0]} ends with {done.returncode}: {err[:200]}", "1 with an error, 0 without")
    return done.returncode, out, err


def environment():
    return {**os.environ, "NO_COLOR": "1", "LC_ALL": "C.UTF-8"}


def answer(*args, text=None):
    """The standard output of a command that has an answer to give."""
    code, out, err = run(*args, text=text)
    if code == 0:
        return out
    error = re.search(r"error\[(E\d+)\]", err)
    if code in (1, 4) and error:
        raise Refused(error[1], code == 4 or error[1] in TOO_COARSE)
    raise Wrong("exit", f"{args[0]} ends with {code}: {err[:200]}", 0)


def read_json(question, text):
    """Strictly: no name twice in an object, no NaN."""
    try:
        return json.loads(text, object_pairs_hook=once_each, parse_constant=no_constant)
    except ValueError as wrong:
        raise Wrong("json", f"{question}: {wrong}: {text[:160]!r}", "JSON") from None


def once_each(pairs):
    names = [name for name, _ in pairs]
    if len(set(names)) != len(names):
        raise ValueError(f"a name twice in {names}")
    return dict(pairs)


def no_constant(name):
    raise ValueError(name)


def json_lines(question, text):
    return [read_json(question, line) for line in text.splitlines()]


def same(question, got, want):
    if got != want:
        raise Wrong(question, got, want)


def same_lines(question, got, want):
    """Of long texts the first line that differs is told."""
    lines = [text.splitlines() + ["the end"] for text in (got, want)]
    for i, (one, other) in enumerate(zip(*lines)):
        same(question, f"line {i + 1}: {one}", f"line {i + 1}: {other}")
