"""Every command that can write JSON writes what a strict reader takes: json_strict.py TARTAN COMMANDS.DEF SCRATCH

Files, folders, names, docs and values hold what JSON has to escape, as far as the notations allow it. A command or an option that can write
JSON and isn't tried here is a failure, too: the options are those whose help speaks of JSON."""
import json, os, re, struct, subprocess, sys

tartan, commands_def, scratch = os.path.abspath(sys.argv[1]), sys.argv[2], sys.argv[3]
commands = [name.replace("_", "-") for name in re.findall(r"^COMMAND\((\w+)\)", open(commands_def).read(), re.M)]
failures = 0


def fail(text):
    global failures
    failures += 1
    print(text.replace(repr(NAME)[2:-1], "NAME"))


# ---- a strict reader

def refuse(constant):
    raise ValueError("%s is not JSON" % constant)


def members(pairs):
    keys = [key for key, _ in pairs]
    twice = {key for key in keys if keys.count(key) > 1}
    if twice:
        raise ValueError("members twice: %s" % ", ".join(sorted(twice)))
    return dict(pairs)


def read(text):
    """One document: UTF-8 without anything that changes a terminal or the order of what is read."""
    text = text.decode("utf-8", errors="strict")
    for c in text:
        if (c < " " and c != "\n") or c in "\x7f\u2028\u2029\u202e\u2066" or "\x80" <= c < "\xa0":
            raise ValueError("%r is not escaped" % c)
    return json.loads(text, parse_constant=refuse, object_pairs_hook=members)


def documents(text):
    """A document, or one a line."""
    try:
        return [read(text)]
    except json.JSONDecodeError as error:
        if not error.msg.startswith("Extra data"):
            raise
    return [read(line) for line in text.splitlines()]


def arrays(text):
    """Diagnostics: an array, or one after another where several files are read."""
    text, at = text.strip(), 0
    while at < len(text):
        end = text.find(b"\n]\n[", at)
        one = text[at:] if end < 0 else text[at:end + 2]
        while one.startswith(b"[]\n"):
            one = one[3:]
        if not isinstance(read(one), list):
            raise ValueError("no array")
        at = len(text) if end < 0 else end + 3


def texts(value):
    """Every string of a document, keys included."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for key, item in value.items():
            yield from texts(key)
            yield from texts(item)
    elif isinstance(value, list):
        for item in value:
            yield from texts(item)


# ---- what can write JSON

def helped(command):
    return subprocess.run([tartan, command, "--help"], capture_output=True, check=True, env=dict(os.environ, COLUMNS="80")).stdout.decode()


def ways(command):
    """The options of a command whose help speaks of JSON (SARIF and GLB are of it)."""
    found = set()
    for block in re.split(r"\n(?= +(?:-\w, |    )--[a-z])", helped(command)):
        name = re.match(r" +(?:-\w, |    )--([a-z-]+)", block)
        about = block.split("\n\n")[0]
        if name and re.search(r"\bjson\b|SARIF|\.glb\b", about, re.I):
            found.add((command, name.group(1)))
    return found


expected = set().union(*(ways(command) for command in commands))
tried = set()

# ---- hostile files

WORDS = "7'-9\\\" \\\\ \U0001f3e0 \u05e9\u05dc\u05d5\u05dd \u2028 \u202e </script>"  # in the strings of rule files
NAME = b'a "b" \\ \n\t\x01 ' + "\U0001f3e0 \u05e9\u05dc\u05d5\u05dd \u2028 \u202e".encode()
BROKEN = NAME + b"\xff"  # in UTF-8 no text at all: rule files cannot be called so
folder = os.path.join(os.fsencode(scratch), NAME)
os.mkdir(folder)
os.chdir(folder)


def write(ending, text):
    """A file whose name is hostile, too."""
    name = NAME + ending.encode()
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)
    return name


PLAN = """schema tiny "%(w)s" {
  width "%(w)s" role length = 6' 2" | 7'-9"
  glazed "%(w)s" = flag
  zone main "%(w)s" role band = open(9'6") role void | dense(8'2")
}
rule wide "%(w)s" = tray(7'-9")
rule two-wide = neighbour(tray(7'-9"), tray(7'-9"))
measure ends "%(w)s" = 2' 1" * quantity(any) + 1' * quantity(tray(7'-9"))
measure wide-ones = quantity(tray(7'-9"))
library base "%(w)s" using tiny { trays 1..2 prune two-wide }
library all using tiny { trays 1..2 }
test wide { match [7'-9" glazed open:9'6"] }
"""
HOUSES = """schema tiny { width role length = 6' 2" zone main role band = open(9'6") role void | dense(8'2") }
library base using tiny { trays 1..1 }
form f "%(w)s" of tiny {
  storey low "%(w)s" 9' 4 1/2" wall 12" partition 4" floor 10" roof 8"
  option main roof = vault(3'6") | gable(9:12, eaves 1'6")
  function L at cell(main)
}
rule vaulted "%(w)s" using f = option(main roof vault)
measure rooms "%(w)s" using f = 2' 1" * quantity(cell(L))
measure open-ones using f = quantity(cell(main open))
library h "%(w)s" from base in f { }
library gabled from base in f { require option(main roof gable) require vaulted or option(main roof gable) }
library vaults from base in f { require vaulted }
"""
KIT = """unit 10 x 8 x 10;
connector peg joins peg;
part "a" { fill 20 x 8 x 20; peg up; }
"""
SOLID = """solid table "%(w)s" {
  box top from (0, 7, 0) to (12, 7.5, 8) rigid;
  box leg from (4.5, 0, 2.5) to (5.5, 7.4, 3.5);
  measure volume, area, volume / (parts - 1);
  require parts = 2;
}
"""
GRAMMAR = """<e> ::= <e>'"'<e> | '\\\\'<v> | <v>
<v> ::= 'a "b" \\\\ 🏠 ש </script>' | y
"""
PLACED = """Up -> 'PlaceBoundingBox(8,9,8)' 'Place(3005)' 'FillRect(2,3,2)'
"""

TOWER = """use "bricks";
space room = box(2 studs, 2 bricks, 2 studs);
rule wall at stud, tube = 3004 | 3005;
model tower "%(w)s" { inside room; start stud at (0, 0, 10) by wall; }
"""

tower = write("-tower.kit", TOWER % {"w": WORDS})
plans, houses, kit, solid = write(".plan", PLAN % {"w": WORDS}), write("-houses.plan", HOUSES % {"w": WORDS}), write(".kit", KIT), write(".solid", SOLID % {"w": WORDS})
edited = write("-edited.plan", (PLAN % {"w": WORDS}).replace("prune two-wide", "prune wide"))
other = write("-other.plan", (HOUSES % {"w": WORDS}).replace("library h ", "library g "))
wrong = write("-wrong.plan", (PLAN % {"w": WORDS}).replace("tray(7'-9\")", "tray(7'-8\")").replace("prune two-wide", "prune twowide"))
grammar, placed = write(".bnf", GRAMMAR), write(".pcfg", PLACED)
field = write(".field", 'surface ball = x*x + y*y + z*z - 1\n')
lines = write(".lines", "6'2\" - open:9'6\" | 7'-9\" glazed dense:8'2\"\n7'-9\" glazed open:9'6\"\n7'-9\" - dense:8'2\" | 7'-9\" - dense:8'2\"\n")


def run(*words, code=(0,), given=b""):
    done = subprocess.run([tartan, *words], input=given, capture_output=True)
    if done.returncode not in code:
        fail("%s ends with %d\n%s" % (words, done.returncode, done.stderr.decode(errors="replace")))
    return done


def check(words, text, inches):
    """What was written; it has this text, if any, in one of its strings."""
    try:
        found = documents(text)
    except ValueError as error:
        fail("%s is no JSON: %s\n%s" % (words, error, text[:600]))
        return []
    if inches and not any(inches in said for one in found for said in texts(one)):
        fail("%s does not have %s\n%s" % (words, inches, text[:600]))
    return found


def complains(words, text):
    try:
        arrays(text)
    except ValueError as error:
        fail("%s complains in no JSON: %s\n%s" % (words, error, text[:600]))


def writes(option, *words, inches=None, code=(0,), given=b""):
    """A command that writes JSON to standard output."""
    tried.add((words[0], option))
    return check(words, run(*words, code=code, given=given).stdout, inches)


def files(option, path, *words, inches=None, code=(0,)):
    """One that writes it to files."""
    tried.add((words[0], option))
    run(*words, code=code)
    try:
        with open(path, "rb") as file:
            return check(words, file.read(), inches)
    except FileNotFoundError:
        return fail("%s does not write %s" % (words, path))


def glb(option, *words):
    """The JSON chunk of a binary glTF file."""
    tried.add((words[0], option))
    if run(*words, "-o", NAME + b".glb").returncode:
        return
    with open(NAME + b".glb", "rb") as file:
        whole = file.read()
    size, kind = struct.unpack_from("<I4s", whole, 12)
    assert kind == b"JSON" and whole[:4] == b"glTF"
    check(words, whole[20:20 + size], None)


# ---- plans
WIDE = "7'-9\""
PLAN_LINE = "7'-9\" - dense:8'2\" | 7'-9\" - dense:8'2\""
writes("json", "check", plans, "--relations", "--examples", "--json", inches=WIDE)
writes("json", "check", plans, "--test", "--json")
files("sarif", "log.sarif", "check", wrong, "--sarif", "log.sarif", code=(1,), inches="7'-8\"")
writes("json", "test", plans, edited, "-l", "base", "--coverage", "--json", inches=WIDE)
writes("format", "match", plans, lines, "--format", "json", inches=WIDE)
writes("format", "prune", plans, lines, "-l", "base", "--format", "json", inches=WIDE)
files("format", "dropped", "prune", plans, lines, "-l", "base", "--format", "json", "--dropped", "dropped", inches=WIDE)
writes("json", "explain", plans, PLAN_LINE, "-l", "base", "--json", inches=WIDE)
writes("json", "explain", plans, PLAN_LINE, "--rule", "two-wide", "--json", inches=WIDE)
writes("json", "count", plans, "-l", "base", "--json", "--mirror")
writes("json", "count", plans, "-l", "base", "--by", "ends", "--json")
writes("json", "diff", plans, edited, "-l", "base", "--json", inches=WIDE)
writes("format", "enumerate", plans, "-l", "base", "--format", "json", inches=WIDE)
writes("format", "sample", plans, "3", "-l", "base", "--seed", "1", "--format", "json", inches="\"")
writes("format", "best", plans, "2", "-l", "base", "--most", "ends", "--format", "json", inches=WIDE)
writes("format", "best", plans, "2", "-l", "base", "--most", "ends", "--then-least", "wide-ones", "--format", "json", inches=WIDE)
writes("json", "pareto", plans, "-l", "base", "--most", "ends", "--least", "wide-ones", "--json", inches=WIDE)
writes("json", "complete", plans, "? | 7'-9\"", "-l", "base", "--json", inches=WIDE)
writes("json", "complete", plans, "? | 7'-9\"", "-l", "base", "--least", "ends", "--json", inches=WIDE)
for words in (["count"], ["enumerate"], ["sample", "3"], ["best", "2", "--most", "ends"], ["pareto", "--most", "ends", "--least", "wide-ones"],
              ["complete", "? | 7'-9\""]):  # by the ending alone
    files("output", NAME + b"-made.json", words[0], plans, *words[1:], "-l", "base", "-o", NAME + b"-made.json")
for words in (["check", plans, "--relations"], ["match", plans, lines], ["prune", plans, lines, "-l", "base"],
              ["vary", houses, "6'2\" open:9'6\" ; vault(3'6\") ; L ; - ; -", "--library", "h"], ["map", grammar, "--random", "3", "--seed", "1"]):
    files("output", NAME + b"-written.json", *words, "-o", NAME + b"-written.json")
writes("json", "unrank", plans, "9", "-l", "base", "--json", inches="\"")
writes("json", "rank", plans, run("unrank", plans, "9", "-l", "base").stdout.decode().rstrip("\n"), "-l", "base", "--json")
for task in (["-l", "base", "--format", "json"], ["--task", "match", "--input", lines, "--rule", "wide", "--format", "json"],
             ["--task", "prune", "-l", "base", "--input", lines, "--format", "json"], ["-l", "base", "--sample", "3", "--format", "json"]):
    shards = NAME + b"-" + str(len(tried) + len(os.listdir())).encode()
    run("shards", "new", plans, "-o", shards, "--shards", "2", *task)
    run("shards", "run", shards)
    writes("format", "shards", "cat", shards, inches="\"")
    for place, _, names in os.walk(shards):
        for name in names:
            if name.endswith((b".json", b".done", b".jsonl")):
                with open(os.path.join(place, name), "rb") as file:
                    text = file.read()
                    if text:  # no plan may be in a shard
                        check((name, task), text, None)

# ---- houses
CHANGED = "eaves-1'6\""
HOUSE = "6'2\" open:9'6\" ; vault(3'6\") ; L ; - ; -"
writes("json", "check", houses, "--relations", "--examples", "--json", inches=CHANGED)
writes("format", "match", houses, "-", "--format", "json", given=HOUSE.encode(), inches=HOUSE)
writes("json", "explain", houses, HOUSE, "-l", "gabled", "--json", inches=CHANGED)
writes("json", "explain", houses, HOUSE, "--rule", "vaulted", "--json", inches=HOUSE)
writes("json", "explain", houses, "#0:", "-l", "h", "--json")
writes("json", "count", houses, "-l", "gabled", "--clauses", "--json", inches=CHANGED)
writes("json", "count", houses, "-l", "h", "--by", "rooms", "--json")
writes("json", "diff", houses, other, "-l", "gabled", "--json")
writes("json", "diff", houses, write("-fewer.plan", (HOUSES % {"w": WORDS}).replace("gable(9", "vaulted(9").replace("vaulted(9", "gable(9")
       .replace("option(main roof gable)", "option(main roof vault)")), "-l", "gabled", "--json", inches=CHANGED)
writes("format", "enumerate", houses, "-l", "h", "--format", "json", inches=CHANGED)
writes("format", "sample", houses, "3", "-l", "h", "--seed", "1", "--format", "json", inches="\"")
writes("format", "best", houses, "2", "-l", "h", "--least", "rooms", "--format", "json", inches="\"")
writes("format", "best", houses, "2", "-l", "h", "--least", "rooms", "--then-most", "open-ones", "--format", "json", inches="\"")
writes("json", "pareto", houses, "-l", "h", "--least", "rooms", "--most", "open-ones", "--json", inches="\"")
writes("json", "complete", houses, "6'2\"", "-l", "h", "--json", inches="6'2\"")
writes("json", "complete", houses, "6'2\"", "-l", "h", "--least", "rooms", "--json", inches="6'2\"")
writes("json", "unrank", houses, "#0:0", "-l", "h", "--json", inches=HOUSE)
writes("json", "rank", houses, run("unrank", houses, "#0:0", "-l", "h").stdout.decode().rstrip("\n"), "-l", "h", "--json")
writes("json", "schema", houses, "--used", "--json", inches="6'2\"")
writes("json", "settings", houses, "--used", "--json")
writes("json", "rule", plans, "wide", "--json", inches="7'-9\"")
writes("json", "rule", plans, "wide", "--edit", "wrap", "--by", "not", "--json")
writes("json", "vary", houses, HOUSE, "--library", "h", "--json", inches=CHANGED)
files("output", NAME + b".json", "house", houses, HOUSE, "-o", NAME + b".json", inches=HOUSE)
glb("output", "house", houses, HOUSE)

# ---- forms
writes("json", "test", solid, "--json", code=(0, 1))
writes("json", "check", solid, "--test", "--json", code=(0, 1))
writes("json", "explain", solid, "--json")
writes("stats", "mesh", solid, "--stats", "json")
writes("stats", "mesh", field, "--stats", "json")
glb("output", "mesh", solid)
writes("stats", "grow", "square", "-n", "2", "--stats", "json")
glb("output", "grow", "square", "-n", "2")
writes("stats", "place", placed, "--stats", "json")
glb("output", "place", tower)
writes("stats", "place", tower, "--stats", "json")
writes("json", "count", kit, "--parts", "2", "--json")
writes("json", "count", kit, "--parts", "2", "--fixed", "--json")
writes("format", "enumerate", "bricks", "--part", "3001", "--parts", "2", "--to", "2", "--format", "json")
run("place", placed, "-o", NAME + b".ldr")
writes("json", "inspect", NAME + b".ldr", "--kit", "bricks", "--json")

# ---- genomes
writes("format", "map", grammar, "--random", "30", "--seed", "1", "--format", "json", inches="a \"b\" \\ 🏠")
writes("tree", "map", grammar, "--genome", "2 0 1 2 0 1", "--tree", "json", code=(0,))

# ---- what is asked of a program that scores, and the page of a generation
with open("score.py", "w") as program:
    program.write("""#!%s
import json, sys
def refuse(word):
    raise ValueError(word)
for line in sys.stdin:
    asked = json.loads(line, parse_constant=refuse, object_pairs_hook=lambda pairs: dict(pairs) if len(dict(pairs)) == len(pairs) else refuse(pairs))
    print(json.dumps({"id": asked["id"], "score": asked["sentence"].count('"')}), flush=True)
""" % sys.executable)
os.chmod("score.py", 0o755)
with open("words.bnf", "w") as file:
    file.write(GRAMMAR)
study = write(".study", 'evolution {\n  grammar "words.bnf"\n  fitness program "score.py"\n  population 8\n  generations 2\n  seed 3\n}\n')
writes("json", "evolve", study, "--run-programs", "-o", NAME + b"-run", "--json")
writes("json", "runs", "show", NAME + b"-run", "--json")
writes("json", "runs", "replay", NAME + b"-run", "1", "--json")
files("output", NAME + b"-runs.json", "runs", "compare", NAME + b"-run", "-o", NAME + b"-runs.json")

# ---- diagnostics: of every command
for command in commands:
    tried.add((command, "diagnostics"))
    for words in ([wrong, "x", "y", "z"], [BROKEN], ["--no-such", BROKEN], [BROKEN, "1", "--library", BROKEN]):
        done = subprocess.run([tartan, command, "--diagnostics=json", *words], stdin=subprocess.DEVNULL, capture_output=True, timeout=120)
        if done.stderr.startswith(b"["):
            complains((command, *words), done.stderr)
        elif done.returncode not in (0, 2) or done.stderr.startswith(b"{"):
            fail("%s %s says, with %d: %s" % (command, words, done.returncode, done.stderr[:300]))
for words in (["check", wrong], ["match", plans, lines, "--rule", BROKEN], ["explain", plans, BROKEN], ["rank", plans, BROKEN, "-l", "base"],
              ["prune", plans, wrong, "-l", "base"], ["house", houses, BROKEN], ["map", grammar, "--genome", BROKEN], ["test", solid]):
    done = subprocess.run([tartan, *words, "--diagnostics=json"], stdin=subprocess.DEVNULL, capture_output=True)
    complains(words, done.stderr)

for command, option in sorted(expected - tried):
    fail("`tartan %s --%s` can write JSON and is not tried" % (command, option))
sys.exit(failures > 0)
