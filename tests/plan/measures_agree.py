"""Questions about measures have to agree with one another: measures_agree.py TARTAN SOURCES [FIRST LAST]

Each is answered by code of its own, so that one checks the other: the best plans are the first of the distribution; no plan
is better than the best, or than a point of the front (counted over the whole library, not sampled); the choices of an open
plan add up; a narrowed library has the plans that the distribution says. The bytes are the same with one thread and with four.
Cases FIRST to before LAST are asked (all, if none is given)."""
import json, subprocess, sys
from fractions import Fraction

tartan, sources = sys.argv[1:3]
first, last = (int(word) for word in sys.argv[3:5]) if len(sys.argv) > 4 else (0, None)
wrong = []

# File, library, its trays, two measures, an open plan.
CASES = [
    (f"{sources}/tests/cli/files/measures.plan", "strips", "2..4", "cost", "all-beds", "room | ? | ..."),
    (f"{sources}/tests/cli/files/measures.plan", "strips", "2..3", "area", "served", "... | store"),
    ("lahave-houses", "houses", "4..5", "cost", "daylight", "8' | ? | ... | great | ..."),
    ("lahave-houses", "houses", "4..7", "area", "outer-wall", "... | public"),
    ("terrace", "street", "5..7", "floor-area", "homes", "? | ... | ?"),
    (f"{sources}/examples/hospital-ward/ward.plan", "short-strip", "8..8", "floor", "capacity", "? | ... | ? | ?"),
]


def ask(command, subject, *words):
    """What the command prints: the same with one thread and with four."""
    said = [subprocess.run([tartan, command, subject[0], *words, *subject[1:], "--threads", str(threads)], stdout=subprocess.PIPE,
                           check=True).stdout for threads in (1, 4)]
    if said[0] != said[1]:
        wrong.append(f"{command} {subject} {words}: other bytes with four threads")
    return said[0].decode()


def kept_of(subject, *wheres):
    words = [word for where in wheres for word in ("--where", where)]
    said = subprocess.run([tartan, "count", *subject, "--json", "--no-effects", *words], stdout=subprocess.PIPE, check=True)
    return int(json.loads(said.stdout)["kept"])


def written(value, unit):
    """A value as rules write it."""
    one = {"": "1", "ft": "1'"}.get(unit, "1" + unit)
    return f"({value.numerator} / {value.denominator} * {one})"


def check(right, what):
    if not right:
        wrong.append(what)


def check_best(subject, measure, spread, unit, least):
    """Best N are the first N of the distribution."""
    wish = "--least" if least else "--most"
    lines = ask("best", subject, "3000", wish, measure, "-f", "json").splitlines()
    values = [Fraction(json.loads(line)["value"]) for line in lines]
    rows, first = spread if least else spread[::-1], []
    for value, plans in rows:
        first += [value] * min(plans, 3000 - len(first))
    check(values == first, f"best {subject[2]} {wish} {measure}: not the first of the distribution")
    better = f"{measure} {'<' if least else '>'} {written(values[0], unit)}"
    check(kept_of(subject, better) == 0, f"best {subject[2]}: there is a plan with {better}")
    ranks = [(value if least else -value, int(json.loads(line)["rank"])) for value, line in zip(values, lines)]
    check(ranks == sorted(ranks), f"best {subject[2]} {wish} {measure}: not in the order of ranks")


def check_front(subject, low, high, units):
    """No plan has as little of one measure and more of the other, or less and as much."""
    front = json.loads(ask("pareto", subject, "--least", low, "--most", high, "--json"))["points"]
    step = max(1, len(front) // 3)
    for point in front[::step]:
        a, b = (Fraction(value) for value in point["values"])
        less, more = written(a, units[0]), written(b, units[1])
        for where in (f"{low} < {less}", f"{high} >= {more}"), (f"{low} <= {less}", f"{high} > {more}"):
            check(kept_of(subject, *where) == 0, f"pareto {subject[2]}: better than {point['values']}: {where}")
        same = kept_of(subject, f"{low} = {less}", f"{high} = {more}")
        check(same == int(point["plans"]), f"pareto {subject[2]}: {same} plans on {point['values']}, not {point['plans']}")


def check_open(subject, pattern):
    """The values of each field of each tray add up to the plans that complete the pattern."""
    answer = json.loads(ask("complete", subject, pattern, "--json"))
    plans = int(answer["plans"])
    check(plans > 0, f"complete {subject[2]} {pattern}: no plans")
    for number, tray in enumerate(answer["trays"], 1):
        for field, values in tray.items():
            total = sum(map(int, values.values()))
            check(total == plans, f"complete {subject[2]} {pattern}: tray {number}, {field}: {total}, not {plans}")
    check(kept_of(subject, f"plan [{pattern}]") == plans, f"complete {subject[2]} {pattern}: another number than --where")


for file, name, trays, low, high, pattern in CASES[first:last]:
    subject = (file, "-l", name, "--trays", trays)
    units = []
    for measure in low, high:
        answer = json.loads(ask("count", subject, "--by", measure, "--json"))
        units.append(answer["unit"])
        spread = [(Fraction(row["value"]), int(row["plans"])) for row in answer["distribution"]]
        check(sum(plans for _, plans in spread) == int(answer["plans"]), f"count {subject[2]} --by {measure}: does not add up")
        check_best(subject, measure, spread, units[-1], True)
        check_best(subject, measure, spread, units[-1], False)
        middle = spread[len(spread) // 2]
        narrowed = kept_of(subject, f"{measure} = {written(middle[0], answer['unit'])}")
        check(narrowed == middle[1], f"count {subject[2]} --where {measure} = {middle[0]}: {narrowed}, not {middle[1]}")
    check_front(subject, low, high, units)
    check_open(subject, pattern)

for line in wrong:
    print(line)
sys.exit(1 if wrong else 0)
