"""Params that are given values: a file with them answers as one in which the values are written."""
import re

from program import Refused, read_json, run, same

VALUES = ["0", "1", "2", "3", "2m", "3.6m", "5'", "8'6\"", "20m2", "48sf"]


def params_of(subject):
    """{name: (item, words or None)}"""
    found = {}
    for item in subject.source.of("param"):
        names = re.fullmatch(r"[\w-]+(\s*\|\s*[\w-]+)+", item.body())
        found[item.name] = (item, re.split(r"\s*\|\s*", item.body()) if names else None)
    return found


def takes(subject, name, value):
    return run("check", subject.path, "--no-analysis", "--set", f"{name}={value}")[0] == 0


def values_for(subject, name, words):
    """Two that it takes, besides its default where there are such."""
    chosen = words[::-1] if words else [v for v in VALUES if takes(subject, name, v)]
    return chosen[:1] + chosen[-1:]


def written(text, params, given):
    """The file in which these values stand, and no test."""
    text = re.sub(r"^test\b.*?^}", "", text, flags=re.M | re.S)
    for name, value in given.items():
        item, words = params[name]
        line = f"param {name} = " + " | ".join([value] + [w for w in words if w != value]) if words else f"let {name} = {value}"
        text = text.replace(item.text, line + "\n", 1)
    return text


def settings_of(subject, params):
    each = {name: values_for(subject, name, words) for name, (_, words) in params.items()}
    names = sorted(name for name in each if each[name])
    alone = [{name: value} for name in names for value in each[name]]
    return alone[:3] + ([{name: each[name][0] for name in names}] if len(names) > 1 else [])


def answers(subject, file, *options):
    """What is counted, listed and measured."""
    more = [] if subject.houses else ["--no-effects"]
    counts = subject.json("count", *more, *options, file=file)
    made = {"counts": counts}
    if int(counts.get("kept", counts.get("houses", 0))) <= 3000:
        made["list"] = subject.ask("enumerate", *options, file=file)
    for measure in subject.measures()[:2]:
        made[measure] = subject.json("count", "--by", measure, *options, file=file)["distribution"]
    return made


def set_as_written(subject):
    params = params_of(subject)
    for given in settings_of(subject, params) if params else []:
        file = subject.file("written.plan", written(subject.text, params, given))
        options = [word for name in given for word in ("--set", f"{name}={given[name]}")]
        try:
            want = answers(subject, file)
        except Refused as refused:
            if refused.limit:
                continue
            raise
        got = answers(subject, subject.path, *options)
        for key in want:
            same(f"{key if key in ('counts', 'list') else 'distribution'} with --set = with the value written", got[key], want[key])
        tested_with(subject, params, given, file)


def tested_with(subject, params, given, file):
    """Tests `with` the values: what the written file matches and keeps is expected, or what it does not."""
    if subject.houses:
        return
    lines = [line for line in subject.ask("enumerate", "--to", "40", file=file).split("\n")[:-1] if line][:6]
    head = ", ".join(f"{name} = {value}" for name, value in given.items())
    tests = [(subject.part, ["keep"] * len(lines))]
    plans = subject.file("tested.plans", "".join(line + "\n" for line in lines))
    for rule in subject.rules()[:2]:
        code, out, err = run("match", file, plans, "--rule", rule, "--format", "bits")
        if code == 0:
            tests.append((rule, ["match" if bit == "1" else "reject" for bit in out.split()]))
    other = {"keep": "drop", "match": "reject", "reject": "match"}
    text = re.sub(r"^test\b.*?^}", "", subject.text, flags=re.M | re.S)
    for right in (True, False):
        blocks = [f"test {name} with {head} {{\n" + "".join(f"  {word if right else other[word]} [{line}]\n" for word, line in zip(expected, lines)) + "}\n"
                  for name, expected in tests]
        if run("check", "--no-analysis", subject.file("with.plan", text + "\n" + "".join(blocks).replace(f" with {head}", "")))[0]:
            return                                              # a plan line is none in a test
        code, out, err = run("test", subject.file("with.plan", text + "\n" + "".join(blocks)), "--json")
        if not out:
            raise Refused(re.search(r"error\[(E\d+)\]", err)[1], code == 4)
        found = read_json("test --json", out)
        cases = sum(len(expected) for _, expected in tests)
        same("tests with values", (found["passed"], found["failed"]), (cases, 0) if right else (0, cases))
