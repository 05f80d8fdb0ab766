"""tartan_ask of the C interface by ctypes, against what commands write with --json: the same bytes, or the same sentence where both refuse. All
requests are asked of one session. A crash of the library is one of the process that asks it: c_ask.py LIBTARTAN FILE, which reads
[question, request] as lines of JSON and prints answers so."""
import ctypes
import json
import os
import re
import shutil
import subprocess
import sys

from c_interface import Error
from program import TARTAN, Wrong, environment, run, same


class Session:
    def __init__(self, path, file):
        self.c, self.session, error = ctypes.CDLL(path), ctypes.c_void_p(), Error()
        if self.c.tartan_session_open(file.encode(), None, ctypes.c_size_t(0), None, ctypes.byref(self.session), ctypes.byref(error)):
            sys.exit("not opened: " + error.message.decode())

    def ask(self, question, request):
        answer, error = ctypes.c_void_p(), Error()
        if self.c.tartan_ask(self.session, question.encode(), json.dumps(request).encode(), None, None, None, ctypes.byref(answer), ctypes.byref(error)):
            return "error: " + error.message.decode()
        text = ctypes.string_at(answer).decode()
        self.c.tartan_text_free(answer)
        return text


# ---- the question

def as_words(question, request):
    """The operand of the command, and its options."""
    operands = {"rank": ["plan", "house"], "explain": ["plan", "house"], "unrank": ["rank"], "sample": ["count"], "best": ["count"], "complete": ["pattern"], "vary": ["house"]}.get(question, [])
    yield from (str(request[key]) for key in operands if key in request)
    then = ""
    for wish in request.get("by") if isinstance(request.get("by"), list) else []:
        yield from ("--" + then + ("most" if wish.get("most") else "least"), wish["measure"])
        then = "then-" if question == "best" else ""
    for key, value in request.items():
        if key in operands or key == "before" or (key == "by" and isinstance(value, list)):
            continue
        for one in value if isinstance(value, list) else [value]:
            yield "--" + key.replace("_", "-")
            yield from [] if one is True else [str(one)]


ROWS = {"sample", "enumerate", "best", "vary", "prune"}                             # whose command writes a line of JSON for each plan or house
COMMANDS = {"relations": ["check", "--relations"]}                 # others have the question's name


def by_command(subject, question, request):
    words = [word for word in as_words(question, request) if word != "--values"]
    if question == "prune":
        path = os.path.join(subject.folder, "given.txt")
        with open(path, "w", encoding="utf-8") as file:
            file.writelines(line + "\n" for line in request["plans"])
        words = [path, "--dropped", "-", "--library", request["library"]]
    if question == "diff":
        words[:0] = [subject.path]
    code, out, err = run(*COMMANDS.get(question, [question]), subject.path, *words, *(["--format", "json"] if question in ROWS - {"vary"} else ["--json"]))
    said = re.search(r"^(?:.*?: )?error(?:\[E\d+\])?: (.*)$", err, re.M)
    return out if code == 0 or question == "test" and out else "error: " + (said.group(1) if said else err)


def explained(subject):
    library, rules = subject.item.name, subject.rules()[:1]
    for line in [line for line in (subject.lines or [])[-2:] if line]:
        asked = {"house" if subject.houses else "plan": line, "library": library}
        yield asked
        yield from ({**asked, "where": [f"not {rule}"]} for rule in rules)
    yield {"house" if subject.houses else "plan": "#0", "library": library}
    yield {"plan": "no plan", "library": library}


def numbered(subject):
    """A plan or a house by its number, and the other way round."""
    library, count = subject.item.name, len(subject.lines or [])
    for rank in {0, count - 1, count} if subject.lines else ():
        yield "unrank", {"rank": str(rank), "library": library}
        if rank < count and subject.lines[rank]:
            yield "rank", {"house" if subject.houses else "plan": subject.lines[rank], "library": library}


def found(subject):
    """Plans or houses one after another, and what they are best by."""
    library, measures, rules = subject.item.name, subject.measures()[:2], subject.rules()[:1]
    yield "sample", {"library": library, "count": 4, "seed": 3, **({"uniform": True} if subject.houses else {})}
    yield "enumerate", {"library": library, "from": "1", "limit": 4}
    yield from (("enumerate", {"library": library, "limit": 3, "where": [rule]}) for rule in rules)
    by = [{"measure": measure, "most": i == 0} for i, measure in enumerate(measures)]
    if by:
        yield "best", {"library": library, "by": by, "count": 3}
        yield "complete", {"library": library, "pattern": "? | ...", "by": by[:1]}
    if len(by) > 1:
        yield "pareto", {"library": library, "by": by}
    yield "complete", {"library": library, "pattern": "... | ?"}
    for line in [line for line in (subject.lines or [])[-1:] if line and subject.houses]:
        yield "vary", {"house": line, "library": library}
    lines = [line for line in (subject.lines or [])[:3] if line]
    if lines and not subject.houses:
        yield "prune", {"library": library, "plans": lines}
    yield "diff", {"library": library, "before": subject.path, "sample": 1}


def rows_of(question, answer):
    """As the command writes them."""
    if question not in ROWS or not answer.startswith("{"):
        return answer
    read = json.loads(answer)
    return "".join(json.dumps(row, ensure_ascii=False, separators=(",", ":")) + "\n" for row in read.get("plans", read.get("houses")))


def counted(subject):
    library, measures, rules = subject.item.name, subject.measures()[:2], subject.rules()[:1]
    yield {"library": library}
    yield from ({"library": library, "by": measure, "values": True} for measure in measures)
    yield from ({"library": library, "by": measure, "bins": 3} for measure in measures[:1])
    for rule in rules:
        yield {"library": library, "where": [rule]}
        yield {"library": library, "where": [rule, f"not {rule}"]}
    yield {"library": library, "clauses": True} if subject.houses else {"library": library, "mirror": True, "no_effects": True}
    yield {"library": library, "max_states": 2}
    yield {"library": library}


def c_ask(subject):
    path = os.path.join(os.path.dirname(shutil.which(TARTAN) or ""), "libtartan.so")
    if not os.path.exists(path) or "\nuse " in "\n" + subject.source.text:
        return
    requests = [("count", request) for request in counted(subject)] + [("explain", request) for request in explained(subject)]
    requests += [("test", {}), ("schema", {}), ("schema", {"used": True}), *numbered(subject), *found(subject), ("relations", {"max_states": 50, "examples": True})]
    lines = "".join(json.dumps(asked) + "\n" for asked in requests)
    done = subprocess.run([sys.executable, "-B", os.path.abspath(__file__), path, subject.path], input=lines, capture_output=True, text=True,
                          encoding="utf-8", timeout=300, env=environment())
    if done.returncode:
        raise Wrong("tartan_ask ends", f"{done.returncode}: {done.stderr[-300:]}", "0")
    for (question, request), line in zip(requests, done.stdout.splitlines(), strict=True):
        same(f"tartan_ask {question} {json.dumps(request)}", rows_of(question, json.loads(line)), by_command(subject, question, request))


def main():
    session = Session(*sys.argv[1:3])
    for line in sys.stdin:
        print(json.dumps(session.ask(*json.loads(line))))


if __name__ == "__main__":
    main()
