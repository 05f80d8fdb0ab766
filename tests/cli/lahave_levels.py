"""The levels of the LaHave House, lahave_levels.py TARTAN: trays, plans and zoned plans of three trays are gone through one by one, by rules
in Python that say what the rules' texts say. Zoned plans are those of `houses`. The table of docs/lahave.md is counted again."""
import collections, itertools, json, re, subprocess, sys

TARTAN = sys.argv[1]
WIDTHS = [4, 8, 12]
MACHINES = [("dense", 4), ("dense", 8), ("empty", 0)]
BODIES = [("open", 8), ("open", 12), ("dense", 8), ("dense", 12)]
BAYS = [("open", 3), ("open", 4), ("empty", 0)]
Tray = collections.namedtuple("Tray", "width machine body bay")
Zoned = collections.namedtuple("Zoned", "width machine body bay double public great")


def run(*words):
    done = subprocess.run([TARTAN, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=600)
    if done.returncode != 0:
        sys.exit("tartan %s: %s" % (" ".join(words), done.stderr.decode()))
    return done.stdout.decode()


def count(file, *options, library=None):
    return json.loads(run("count", file, "--library", library or file, "--json", *options))


def same(name, found, wanted):
    if found != wanted:
        sys.exit("%s: %s, and not %s" % (name, found, wanted))


def grouped(number):
    return "{:,}".format(int(number))


# ---- trays

def combinations():
    return [Tray(*values) for values in itertools.product(WIDTHS, MACHINES, BODIES, BAYS)]


def too_narrow(tray):
    return tray.width == 4 and tray.body[0] == "dense"


def bay_of_no_room(tray):
    return tray.bay[0] == "open" and (tray.width == 4 or tray.body[0] == "dense")


def legal(tray):
    return not too_narrow(tray) and not bay_of_no_room(tray)


# ---- plans

def is_row(plan):
    """It begins and ends with a main tray, and no two tartans lie side by side."""
    narrow = [tray.width == 4 for tray in plan]
    return not narrow[0] and not narrow[-1] and not any(a and b for a, b in zip(narrow, narrow[1:]))


def long_enough(plan):
    return 32 <= sum(tray.width for tray in plan) <= 56


def has_machine(tray):
    return tray.machine[0] == "dense"


def is_room(tray):
    return tray.width > 4 and tray.body[0] == "open"


def runs(plan, n, so):
    return any(all(so(tray) for tray in plan[i:i + n]) for i in range(len(plan) - n + 1))


def unserved(plan):
    """Of some room, whatever lies between it and each machine is longer than 12'."""
    def far(i, j):
        return sum(tray.width for tray in plan[min(i, j) + 1:max(i, j)]) > 12
    machines = [j for j, tray in enumerate(plan) if has_machine(tray)]
    return any(is_room(tray) and all(j != i and far(i, j) for j in machines) for i, tray in enumerate(plan))


PLAN_RULES = {
    "coreless": lambda plan: not runs(plan, 2, has_machine),
    "broken-core": lambda plan: sum(has_machine(a) and not has_machine(b) for a, b in zip(plan, plan[1:])) > 1,
    "ragged-core": lambda plan: {4, 8} <= {tray.machine[1] for tray in plan},
    "lonely-rooms": lambda plan: runs(plan, 2, lambda tray: is_room(tray) and not has_machine(tray)),
    "unserved": unserved,
    "solid-block": lambda plan: runs(plan, 2, lambda tray: tray.body[0] == "dense"),
    "dense-end": lambda plan: plan[0].body[0] == "dense" or plan[-1].body[0] == "dense",
    "no-tartan": lambda plan: runs(plan, 3, lambda tray: tray.width == 12),
    "crowded-bays": lambda plan: runs(plan, 3, lambda tray: tray.bay[0] == "open"),
    "blind-house": lambda plan: all(tray.bay[0] == "empty" for tray in plan),
}

# ---- zoned plans


def zonings(tray):
    """The trays of zoned plans that a tray may become."""
    for double, public, great in itertools.product((False, True), repeat=3):
        gathers = not great or tray.width > 4 and tray.body[0] == "open"
        if gathers and (not double or great or tray.width == 4):
            yield Zoned(*tray, double, public, great)


def is_zoned(plan):
    public = [i for i, tray in enumerate(plan) if tray.public]
    return len(public) == 1 and public[0] in (0, len(plan) - 1) and 1 <= sum(tray.great for tray in plan) <= 3


def hall_without_totem(plan):
    def totem(i):
        return 0 <= i < len(plan) and plan[i].body[0] == "dense"
    halls = [i for i, tray in enumerate(plan) if tray.great]
    return bool(halls) and not any(totem(i - 1) or totem(i + 1) for i in halls)


def distant_hall(plan):
    halls = [i for i, tray in enumerate(plan) if tray.great]
    public = [i for i, tray in enumerate(plan) if tray.public]
    return bool(halls) and not any(abs(i - j) <= 3 for i in halls for j in public)


ZONED_RULES = {
    "split-hall": lambda plan: "10" in re.sub("^0*|0*$", "", "".join("01"[tray.great] for tray in plan)),
    "low-hall": lambda plan: any(t.great for t in plan) and not any(t.great and t.double for t in plan),
    "hall-without-totem": hall_without_totem,
    "distant-hall": distant_hall,
}


def sift(plans, rules):
    """How many plans there are, how many each rule prunes, how many only it prunes; and the plans that are kept."""
    generated, prunes, alone, kept = 0, collections.Counter(), collections.Counter(), []
    for plan in plans:
        generated += 1
        broken = [name for name, rule in rules.items() if rule(plan)]
        prunes.update(broken)
        if len(broken) == 1:
            alone.update(broken)
        if not broken:
            kept.append(plan)
    return generated, prunes, alone, kept


def compare(library, generated, prunes, alone, kept, rules):
    found = count(library, "--trays", "3")
    row = found["by_length"][0]
    same(library, (int(row["generated"]), int(row["kept"])), (generated, kept))
    clauses = {rule["name"]: (int(rule["prunes"]), int(rule["only"])) for rule in found["rules"]}
    for name in rules:
        same("%s: %s" % (library, name), clauses[name], (prunes[name], alone[name]))


def brute():
    every = combinations()
    trays = [tray for tray in every if legal(tray)]
    zoned = [after for tray in trays for after in zonings(tray)]
    for schema, wanted in (("lahave-trays", (len(trays), len(every))), ("lahave-zoned-trays", (len(zoned), 8 * len(every)))):
        told = re.search(r"schema %s: (\d+) trays of (\d+)" % schema, run("schema", "lahave-zoned", "--used"))
        same(schema, tuple(map(int, told.groups())), wanted)
    rows = (plan for plan in itertools.product(trays, repeat=3) if is_row(plan) and long_enough(plan))
    generated, prunes, alone, kept = sift(rows, PLAN_RULES)
    compare("lahave-plans", generated, prunes, alone, len(kept), PLAN_RULES)
    above = (plan for plain in kept for plan in itertools.product(*map(list, map(zonings, plain))) if is_zoned(plan))
    kept = sift(above, ZONED_RULES)[3]
    below = {tuple(tray[:4] for tray in plan) for plan in kept}
    for library, wanted in ("lahave-zoned", kept), ("lahave-with-zoning", below):
        found = count("lahave-zoned", "--trays", "3", "--no-effects", library=library)
        same(library, int(found["by_length"][0]["kept"]), len(wanted))
    return len(every), len(trays), len(zoned)


# ---- the same plans in one level

def as_house(line):
    """A zoned plan in the order of the fields of `lahave`."""
    trays = (tray.split() for tray in line.split(" | "))
    return " | ".join(" ".join([w, height, public, great, machine, body, bay]) for w, machine, body, bay, height, public, great in trays)


def one_level():
    zoned, houses = count("lahave-zoned", "--no-effects"), json.loads(run("count", "lahave-houses", "--json", "--no-effects"))
    lengths = [[(row["length"], row["kept"]) for row in found["by_length"]] for found in (zoned, houses)]
    same("lahave-zoned and houses", *lengths)
    drawn = run("sample", "lahave-zoned", "--library", "lahave-zoned", "--per-length", "400").splitlines()
    plans = [as_house(line) for line in drawn if not line.startswith("#")]
    done = subprocess.run([TARTAN, "prune", "lahave-houses", "-"], input="\n".join(plans).encode(), stdout=subprocess.PIPE, timeout=600)
    same("kept of the drawn", len(done.stdout.decode().splitlines()), len(plans))
    return zoned


# ---- the table of the page

def table():
    with open("docs/lahave.md") as file:
        page = file.read()
    every, trays, zoned_trays = brute()
    plans, zoned = count("lahave-plans", "--no-effects"), one_level()
    bare = count("lahave-zoned", "--no-effects", library="lahave-with-zoning")
    house = ["count", "lahave-complete", "--library", "lahave-complete", "--plan", "#718518", "--json"]
    houses = json.loads(run(*house, "--clauses"))
    sections = 2 * 2 * 2 * 3 * 1 * 2 * 2
    rows = [("trays", every, trays), ("plans of four to eight trays", plans["generated"], plans["kept"]), ("zoned trays", 8 * every, zoned_trays),
            ("zoned plans", zoned["generated"], zoned["kept"]), ("plans, and those with a zoning", plans["kept"], bare["kept"]), ("options", sections, sections - 24 - 16 + 4),
            ("houses on one of them", houses["without_clauses"], houses["houses"])]
    livable = count("lahave-complete", "--no-effects", library="livable")
    same("docs/lahave.md has the livable plans", "that one can live on | | %s |" % grouped(livable["kept"]) in page, True)
    for name, before, after in rows:
        line = "| %s | %s | %s |" % (name, grouped(before), grouped(after))
        if line not in page:
            sys.exit("docs/lahave.md has no line %s" % line)


table()
