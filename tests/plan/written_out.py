"""A part written out inside a number means what a rule of that name means: written_out.py TARTAN [SHARE]

Every kind of expression stands inside every kind of number, in a measure and in a comparison, and so do numbers inside the
parts of other expressions: a library is counted by the difference of both, and by which plans a comparison of each keeps.
The schema is the second of its file, and what is emitted for conditions must not make it the first. Every SHAREth is counted (1, all, if none is given)."""
import json, os, re, subprocess, sys, tempfile

tartan = sys.argv[1]
share = int(sys.argv[2]) if len(sys.argv) > 2 else 1

SCHEMA = """schema first { size = 1m | 2m }
schema s { width = 4' | 8'  open = flag  zone yard = deep(6') | none }
rule more(a, k) using s = quantity(a, n > k)
measure named-sum using s = sum(width) + 2' * quantity(tray(open))
"""

# Every expression of the language; @ is a part of it. With # each condition is another one, so that each is emitted where it stands.
SHAPES = [
    "any", "tray(open)", "tray(8', yard deep)", "not @", "@ or tray(4')", "@ and tray(open)", "@ implies tray(open)",
    "neighbour(@, any)", "neighbour(beginning, @)", "neighbour(optional(tray(4')), @, end)", "symmetric neighbour(@, tray(open))",
    "quantity(@, n >= 1 or n > #)", "occurrences(@, n = 1 or n > #)", "sum(width of @, w > 4' or w > #')", "sum(width, w = 8' or w > #')", "sum(yard depth, d < 6' or d > #')",
    "many(@)", "distance(from @, to tray(open), by quantity(any, n > 0 or n > #))", "distance(from any, to @, by sum(width, w < 8' or w > #'))",
    "quantity(@) = 1", "trays < 2", "matches(@) + quantity(@) > 1", "sum(width of @) <= 8'", "sum(width * 2) in 8'..16'",
    "occurrences(@) in 1..2", "named-sum > 10'", "every(@, tray(open))", "some v in width (neighbour(tray(v), @))",
    "every v in width (quantity(tray(v), n >= 1 or n > #) implies @)", "plan [open | ...]", "more(@, 0)",
]
INSIDE = ["tray(open)", "sum(width, w > 4' or w > #')", "quantity(tray(4'), n = 1 or n > #)", "trays = 2"]
NUMBERS = ["matches({})", "quantity({})", "occurrences({})", "sum(width of {})", "sum(width * 2 of {}) / 4'"]


def run(folder, text, *words):
    """What the command prints and says; a crash is never an answer."""
    path = os.path.join(folder, "a.plan")
    with open(path, "w") as file:
        file.write(text)
    done = subprocess.run([tartan, words[0], path, *words[1:]], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1, 4):
        sys.exit(f"{' '.join(words)} ends with {done.returncode}: {done.stderr[:500]}")
    return done


def expressions():
    for shape in SHAPES:
        for inside in INSIDE if "@" in shape else [""]:
            yield shape.replace("@", inside if inside in ("any", "tray(open)") else f"({inside})")


def rules_of(i, number, expression):
    """The number of the expression written out and of a rule that is the same: their difference, and a comparison of each."""
    expression = expression.replace("#", str(100 + i))
    written, named, unit = number.format(expression), number.format(f"e{i}"), "'" if number.startswith("sum(width of") else ""
    return [f"rule e{i} using s = {expression}", f"rule written-{i} using s = {written} > 1{unit}", f"rule named-{i} using s = {named} > 1{unit}",
            f"rule differ-{i} using s = (written-{i} and not named-{i}) or (named-{i} and not written-{i})",
            f"measure apart-{i} using s = {written} - ({named}) + 1000{unit} * matches(differ-{i})"]


def meant(folder, number):
    """The expressions that have a meaning there, by what checking all of them says."""
    every = list(expressions())
    blocks = [rules_of(i, number, expression) for i, expression in enumerate(every)]
    said = run(folder, "\n".join([SCHEMA, *(line for block in blocks for line in block)]), "check").stderr
    first = SCHEMA.count("\n") + 2
    bad = {(int(line) - first) // len(blocks[0]) for line in re.findall(r":(\d+):\d+: error", said)}
    return [expression for i, expression in enumerate(every) if i not in bad], len(every)


def main():
    wrong, limits, tried, of = [], 0, 0, 0
    with tempfile.TemporaryDirectory() as folder:
        for k, number in enumerate(NUMBERS):
            good, count = meant(folder, number)
            tried, of = tried + len(good), of + count
            text = "\n".join([SCHEMA, *(line for i, e in enumerate(good) for line in rules_of(i, number, e)), "library l using s { trays 1..2 }"])
            for i, expression in list(enumerate(good))[k % share::share]:
                by = run(folder, text, "count", "--by", f"apart-{i}", "--json")
                if by.returncode == 4:
                    limits += 1
                elif by.returncode:
                    wrong.append(f"{number.format(expression)}: refused: {by.stderr[:200]}")
                elif [row["value"] for row in json.loads(by.stdout)["distribution"]] != ["0"]:
                    wrong.append(f"{number.format(expression)}: written out it has other values than by name")
    if tried < 9 * of // 10 or limits > tried // 10:
        wrong.append(f"only {tried} of {of} have a meaning, {limits} pass a limit")
    print(*wrong, f"{tried} numbers, {len(wrong)} wrong", sep="\n")
    sys.exit(1 if wrong else 0)


main()
