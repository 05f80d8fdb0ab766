"""The published numbers of examples/sequences: sequences.py TARTAN [--long]. --long takes the larger ones, for which files are written with
more values."""
import collections, itertools, json, os, re, subprocess, sys, tempfile

TARTAN = os.path.abspath(sys.argv[1])
FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "sequences")

SQUARE_FREE = [3, 6, 12, 18, 30, 42, 60, 78, 108, 144, 204, 264, 342, 456, 618, 798, 1044, 1392, 1830, 2388, 3180]  # OEIS A006156
DOMINOES = {4: 36, 6: 6728, 8: 12988816, 10: 258584046368, 12: 53060477521960000}  # OEIS A004003
QUEENS = [1, 0, 0, 2, 10, 4, 40, 92, 352, 724, 2680, 14200]  # OEIS A000170
LANGFORD = [0, 0, 1, 1, 0, 0, 26, 150, 0, 0, 17792]  # OEIS A014552
ALL_INTERVAL = [2, 4, 4, 8, 24, 32, 40, 120, 296, 648, 1328]  # of 2 notes and more; CSPLib 007
PIGMENT = {"15a": 1195, "15b": 1123, "15d": 1486, "15e": 1583, "20a": 1147, "20b": 2101, "20c": 2182, "30a": 1119, "30b": 1320}  # CSPLib 058

TEAM = 48244729625447040  # rosters of ten days for seven nurses, three by day and two or more at night: from the automaton of MiniZinc's handbook


def run(*words):
    done = subprocess.run([TARTAN, *words], cwd=FOLDER, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=1800)
    if done.returncode != 0:
        sys.exit("tartan %s: %s" % (" ".join(words), done.stderr.decode()))
    return done.stdout


def kept(file, *options, what="kept"):
    """The counts of a file, by the number of trays."""
    found = json.loads(run("count", file, "--json", "--no-effects", *options))
    return {row["length"]: int(row[what]) for row in found["by_length"]}


def same(name, found, published):
    if found != published:
        sys.exit("%s: counted %s, published %s" % (name, found, published))


def numbered(values, first=1):
    return dict(enumerate(values, first))


def tired(roster):
    """Four days on duty in a row, or three nights: at the end of a roster of the letters o, d, n."""
    return roster[-3:] == "nnn" or len(roster) >= 4 and "o" not in roster[-4:]


def rosters(days):
    """The rosters of one nurse, as how many there are by their last three days, nights and days off."""
    found = {("", 0, 0): 1}
    for _ in range(days):
        longer = collections.Counter()
        for (last, nights, off), ways in found.items():
            for duty in "odn":
                if not tired(last + duty):
                    longer[(last + duty)[-3:], nights + (duty == "n"), off + (duty == "o")] += ways
        found = longer
    return found


def next_day(worked, nights):
    """What may follow so many days on duty, the last of them so many nights: the same two numbers, and whether by day and at night."""
    yield (0, 0), 0, 0
    if worked < 3:
        yield (worked + 1, 0), 1, 0
    if worked < 3 and nights < 2:
        yield (worked + 1, nights + 1), 0, 1


def teams(nurses, days):
    """The rosters of several nurses, day by day. Who of them has which two numbers does not matter, since they have the same rules."""
    found = {((0, 0),) * nurses: 1}
    for _ in range(days):
        longer = collections.Counter()
        for team, ways in found.items():
            some = {((), 0, 0): ways}
            for nurse in team:
                more = collections.Counter()
                for (others, by_day, by_night), each in some.items():
                    for nurse_then, day, night in next_day(*nurse):
                        more[tuple(sorted(others + (nurse_then,))), by_day + day, by_night + night] += each
                some = more
            for (team_then, by_day, by_night), each in some.items():
                if by_day == 3 and by_night >= 2:
                    longer[team_then] += each
        found = longer
        yield sum(found.values())


def nurses():
    one = numbered([sum(rosters(days).values()) for days in range(1, 15)])
    for days in range(1, 9):
        listed = ("".join(word) for word in itertools.product("odn", repeat=days))
        same("rosters listed", one[days], sum(not any(tired(word[:n]) for n in range(1, days + 1)) for word in listed))
    same("rosters", kept("nurse.plan", "-l", "fortnights"), one)
    same("rosters, pruned", kept("nurse.plan", "-l", "pruned-fortnights"), one)
    month = sum(ways for (_, nights, off), ways in rosters(30).items() if 4 <= nights <= 8 and off >= 8)
    same("months", kept("nurse.plan", "-l", "months"), {30: month})
    team = numbered(teams(7, 10))
    same("teams", team[10], TEAM)
    same("teams", kept("roster.plan"), team)
    for file in "nurse.plan", "roster.plan":
        same("check", run("check", "--werror", file), b"")


def short():
    nurses()
    words = kept("square-free.plan")
    same("words", words, numbered(SQUARE_FREE[:15]))
    words = kept("square-free.plan", "--trays", "16..21", "--where", "not square(16, 7)", "--max-states", "200000")
    same("longer words", words, numbered(SQUARE_FREE[15:], 16))
    for side, count in DOMINOES.items():
        same("dominoes", kept("dominoes.plan", "-l", "board-%d" % side), {side * side: count})
    same("queens", kept("queens.plan"), numbered(QUEENS[:10]))
    rows = kept("langford.plan", "--mirror", what="mirror")
    same("pairings", rows, {n: 0 if n % 2 else LANGFORD[n // 2 - 1] for n in range(2, 17)})
    same("series", kept("all-interval.plan"), numbered(ALL_INTERVAL[:9]))
    for name, cost in PIGMENT.items():
        best = run("best", "pigment-%s.plan" % name, "1", "--least", "cost")
        same(name, re.match(r"# (\S+)  rank", best.decode())[1], "{:,}".format(cost))


def larger(scratch, name, *changes):
    """A file like that example, with each text replaced."""
    with open(os.path.join(FOLDER, name)) as file:
        text = file.read()
    for old, new in changes:
        assert old in text, (name, old)
        text = text.replace(old, new)
    path = os.path.join(scratch, name)
    with open(path, "w") as file:
        file.write(text)
    return path


def long():
    with tempfile.TemporaryDirectory() as scratch:
        board = larger(scratch, "queens.plan", ("9m | 10m\n", "9m | 10m | 11m | 12m\n"), ("trays 1..10", "trays 11..12"),
                       ("attack(10m) as row-10", "attack(10m) as row-10, attack(11m) as row-11, attack(12m) as row-12"))
        same("queens", kept(board, "--max-states", "20000000"), numbered(QUEENS[10:], 11))
        row = larger(scratch, "langford.plan", ("7m | 8m\n", "7m | 8m | 9m | 10m | 11m\n"), ("trays 2..16", "trays 18..22"),
                     ("placed(8m)", "placed(8m), placed(9m), placed(10m), placed(11m)"))
        rows = kept(row, "--mirror", "--max-states", "20000000", what="mirror")
        same("pairings", rows, {n: 0 if n % 2 else LANGFORD[n // 2 - 1] for n in range(18, 23)})
        notes = larger(scratch, "all-interval.plan", ("8m | 9m\n", "8m | 9m | 10m | 11m\n"), ("trays 1..9", "trays 10..11"),
                       ("twice(8m) as steps-of-8", "twice(8m) as steps-of-8, twice(9m) as steps-of-9, twice(10m) as steps-of-10"))
        same("series", kept(notes, "--max-states", "20000000"), numbered(ALL_INTERVAL[9:], 10))


if __name__ == "__main__":
    long() if "--long" in sys.argv else short()
