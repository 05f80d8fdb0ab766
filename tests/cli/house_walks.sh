#!/usr/bin/env bash
# Walks and ways out: a nanometre decides; cells without a walk meet no bound, and where there are no such cells all do that have a `most`;
# what is said of single houses; houses on one plan are counted, listed, ranked, varied, put in order and spread by them; those on all plans are listed
# and drawn by trying them; walks between cells that no house has are warned about.
# Slow under sanitizers.
name=house_walks
. "$(dirname "$0")/golden.bash"
cd "$scratch"

# A row of two rooms, 3 m each, with a door between them; the only door out is at the left. In the second room one walks from its door to
# nothing: its walk is through the first room, which is clear from 100 mm to 2950 mm, and has its doors in the middle of both ends.
form() {
    cat <<PLAN
schema row { width role length = 3m | 4m  zone house role band = space(4m) }
form f of row {
  storey ground 2.7m
  wall 200mm
  partition 100mm
  floor 300mm
  roof 200mm
  way 800mm
  function first at cell(3m)
  function second at cell(4m)
  opening door wide 900mm high 2m passage sliding
  opening hatch wide 900mm high 2m passage sliding
  face cell(any) beside cell(any) = door | hatch | wall
  face cell(first) outside left = door
  face cell(any) outside = wall
}
library rows using row { trays 1..3 }
library all from rows in f { }
library asked from rows in f { $1 }
PLAN
}
count() { # CLAUSE PLAN: how many houses on the plan are kept
    form "$1" >asked.plan
    "$TARTAN" count asked.plan --library asked --plan "$2" 2>/dev/null | awk '/^houses/ {print $2}'
}
two='3m space:4m | 4m space:4m'
# One comes in at x = 100 mm and goes on at x = 2950 mm: 2850 mm, straight on.
is 'all' "$(count '' "$two")" 3
is 'as long as it is' "$(count 'require walk(cell(second), to outside) <= 2.85m' "$two")" 2
is 'a nanometre less' "$(count 'require walk(cell(second), to outside) <= 2849.999999mm' "$two")" 0
is 'a nanometre more' "$(count 'require walk(cell(second), to outside) >= 2850.000001mm' "$two")" 0
is 'at least' "$(count 'require walk(cell(second), to outside) >= 2.85m' "$two")" 2
is 'in a range' "$(count 'require walk(cell(second), to outside) in 2.85m..3m' "$two")" 2
is 'another number' "$(count 'require walk(cell(second), to outside) != 3m' "$two")" 2
is 'without a walk no bound is met' "$(count 'require walk(cell(second), to outside) > 0m or walk(cell(second), to outside) <= 99m' "$two")" 2
is 'not' "$(count 'require not walk(cell(second), to outside) <= 99m' "$two")" 1
is 'they share a door' "$(count 'require walk(cell(second), to cell(first)) = 0m' "$two")" 2
is 'by one kind' "$(count 'require walk(cell(second), to cell(first), by hatch) <= 0m' "$two")" 1
is 'by the other all the way' "$(count 'require walk(cell(second), to outside, by door) <= 3m' "$two")" 1
is 'through none' "$(count 'require walk(cell(second), to outside, through cell(second)) <= 99m' "$two")" 0
is 'the other order' "$(count 'require walk(cell(second), to outside, by door, through cell(first)) <= 3m' "$two")" 1
is 'of all cells' "$(count 'require walk(cell(any), to outside) <= 2.85m' "$two")" 2
is 'of the nearest' "$(count 'require least walk(cell(any), to outside) <= 0m' "$two")" 2
is 'no such cells: below all bounds' "$(count 'require walk(cell(second), to outside) <= 1m' '3m space:4m')" 1
is 'and above none' "$(count 'require walk(cell(second), to outside) >= 0m' '3m space:4m')" 0
is 'the least of none is above all' "$(count 'require least walk(cell(second), to outside) > 99m' '3m space:4m')" 1
is 'ways out' "$(count 'require exits(cell(second)) = 1' "$two")" 2
is 'none' "$(count 'require exits(cell(second)) = 0' "$two")" 1
is 'two' "$(count 'require exits(cell(any)) >= 2' "$two")" 0
is 'with a number of cells' "$(count 'require walk(cell(second), to outside) + 1m * quantity(cell(first)) = 3.85m' "$two")" 2

# Numbers on the plan; names both ways; the same at one thread and at four.
form 'require walk(cell(second), to outside) <= 3m' >asked.plan
is 'listed' "$("$TARTAN" enumerate asked.plan --library asked --plan "$two" | wc -l)" 2
"$TARTAN" enumerate asked.plan --library asked --plan "$two" >listed
is 'a house of its name' "$("$TARTAN" house asked.plan '#3:1' --library asked)" "$(sed -n 2p listed)"
is 'its name' "$("$TARTAN" rank asked.plan --library asked "$(sed -n 2p listed)")" '#3:1'
is 'drawn by chance' "$("$TARTAN" sample asked.plan 5 --library asked --plan "$two" 2>/dev/null | sort)" "$(sort listed)"
printf 'measure wide = sum(width)\n' >>asked.plan
for command in 'count' 'house #3' 'best --least wide' 'pareto --least wide --most wide' 'count --by wide' 'count --clauses'; do
    read -ra words <<<"$command"
    if "$TARTAN" "${words[0]}" asked.plan "${words[@]:1}" --library asked >/dev/null 2>said; then fail "$command is not refused"; fi
    grep -q 'E1687' said || fail "$command: $(head -1 said)"
    grep -q 'tartan sample' said || fail "$command is not told what to ask instead: $(cat said)"
done

# All plans together: houses that the other clauses keep are tried. Those that are kept have the ranks and the names that they have on
# their plans; a sample has each as often as each; where trying ends is said, and how many were kept until then.
mixed='require walk(cell(second), to outside) <= 3m or quantity(any, n <= 1) prune exits(cell(any)) = 0 and quantity(any, n >= 3) require cell(first)'
form "$mixed" >tried.plan
"$TARTAN" enumerate tried.plan --library all >all
"$TARTAN" enumerate tried.plan --library asked >kept
is 'tried: as explain says' "$(while read -r line; do "$TARTAN" explain tried.plan "$line" --library asked | grep -q keeps && echo "$line"; done <all)" "$(<kept)"
"$TARTAN" enumerate tried.plan --library asked --format json >kept.json
for k in 0 5 11; do
    line=$(sed -n $((k + 1))p kept)
    named=$(sed -n $((k + 1))p kept.json | sed -E 's/.*"plan_rank":"([0-9]+)","variant":"([0-9]+)".*/#\1:\2/')
    is "the name of house $k" "$("$TARTAN" rank tried.plan "$line" --library asked)" "$named"
    is "the house of $named" "$("$TARTAN" house tried.plan "$named" --library asked)" "$line"
    is "from rank $k on" "$("$TARTAN" enumerate tried.plan --library asked --from $k --limit 3)" "$(sed -n "$((k + 1)),$((k + 3))p" kept)"
    is "to rank $k" "$("$TARTAN" enumerate tried.plan --library asked --to $k)" "$(head -n $k kept)"
done
is 'tried with --where' "$("$TARTAN" enumerate tried.plan --library all --where 'walk(cell(second), to outside) <= 3m or quantity(any, n <= 1)' \
    --where 'not exits(cell(any)) = 0 or quantity(any, n <= 2)' --where 'cell(first)')" "$(<kept)"
"$TARTAN" sample tried.plan 99999 --library asked >sample 2>said
is 'all are drawn' "$(<sample)" "$(<kept)"
is 'and that is said' "$(grep -c 'these are all' said)" 1
for seed in $(seq 60); do "$TARTAN" sample tried.plan 7 --library asked --seed "$seed" 2>/dev/null; done >drawn
python3 - <<'PY' || fail 'houses that are drawn'
import collections
kept, drawn = open("kept").read().splitlines(), open("drawn").read().splitlines()
times, often = collections.Counter(drawn), 420 / len(kept)
assert len(kept) >= 12 and len(drawn) == 420 and set(drawn) <= set(kept), (len(kept), len(drawn))
assert all(len(set(drawn[i : i + 7])) == 7 for i in range(0, 420, 7)), "one twice"
assert all(often / 2.5 < times[house] < often * 2 for house in kept), times
PY
"$TARTAN" sample tried.plan 7 --library asked --seed 60 --threads 4 2>/dev/null | diff - <(tail -7 drawn) || fail 'the same seed draws others'
"$TARTAN" sample tried.plan 3 --library asked --columns -o drawn.csv 2>/dev/null
is 'a table of them' "$(sed 1d drawn.csv | cut -d, -f2 | sort -u):$(sed 1d drawn.csv | wc -l)" ':3'
is 'diverse ones' "$("$TARTAN" sample tried.plan 4 --library asked --diverse 2>/dev/null | sort | comm -12 - <(sort kept) | wc -l)" 4
"$TARTAN" draw tried.plan --library asked --sample 3 -o drawn.svg 2>/dev/null && [ -s drawn.svg ] || fail 'they are not drawn'
cp tried.plan walked.plan
golden tried_few "tartan sample $scratch/walked.plan 9 --library asked --max-houses 20"
golden tried_listed "tartan enumerate $scratch/walked.plan --library asked --max-houses 5"
golden tried_table "tartan sample $scratch/walked.plan 3 --library asked -o $scratch/x.sqlite"
form 'require exits(cell(any)) >= 2, walk(cell(second), to outside) >= 0m' >walked.plan
is 'no more are drawn than there are' "$("$TARTAN" sample tried.plan 7 --library asked --seed 60 --max-houses 1152921504606846976 2>/dev/null)" "$(tail -7 drawn)"
golden tried_none "tartan sample $scratch/walked.plan 9 --library asked --max-houses 12"
golden tried_nowhere "tartan enumerate $scratch/walked.plan --library asked"

# Tiles that stand in the way, in groups, with what they cost: those that are kept by both numbers, and by the one and not the other.
cat >furnished.plan <<'PLAN'
schema row { width role length = 4m  zone house role band = space(5m) }
form f of row {
  storey ground 2.7m
  wall 200mm
  partition 100mm
  floor 300mm
  roof 200mm
  way 700mm
  function room at cell(any)
  opening door wide 900mm high 2m passage sliding
  face cell(any) beside cell(any) = door
  face cell(any) outside left = door
  face cell(any) outside = wall
  tile rooms for room { against wall  item table left 1m..2m, back 1.5m..3m  item stool left 0..300mm, back 0..300mm }
  tile benches for room { against wall  item bench left 300mm..2m, back 0..400mm }
  tile shelves for room { item shelf left 0..right 0, back 0..300mm, up 0..1m }
  material pine "#c0a080" price 100 per m2 for table, shelf
  material oak "#806040" price 75.50 per each for bench
}
library rows using row { trays 1..2 }
library all from rows in f { }
library near from rows in f { require walk(cell(any), to outside) <= 3.9m }
library cheap from rows in f { require walk(cell(any), to outside) <= 3.9m, sum(cost) <= 230 }
library dear from rows in f { require walk(cell(any), to outside) <= 3.9m, sum(cost) > 230 }
library twice from rows in f { require walk(cell(any), to outside) / 1m + sum(cost) / 1000 <= 4.075 }
PLAN
two='4m space:5m | 4m space:5m'
of() { "$TARTAN" count furnished.plan --library "$1" --plan "$two" | awk '/^houses/ {print $2}'; }
[ "$(of near)" -lt "$(of all)" ] && [ "$(of cheap)" -gt 0 ] && [ "$(of dear)" -gt 0 ] || fail "few kinds of houses: $(of near) of $(of all), $(of cheap) cheap, $(of dear) dear"
is 'cheap or dear' "$(($(of cheap) + $(of dear)))" "$(of near)"
for library in near cheap twice; do
    "$TARTAN" enumerate furnished.plan --library all --plan "$two" >all
    "$TARTAN" enumerate furnished.plan --library $library --plan "$two" >some
    is "$library: one by one" "$(while read -r line; do "$TARTAN" explain furnished.plan "$line" --library $library | grep -q keeps && echo "$line"; done <all)" "$(<some)"
    is "$library: as many" "$(wc -l <some)" "$(of $library)"
    k=$(($(wc -l <some) / 2))
    is "$library: by its number" "$("$TARTAN" house furnished.plan "#1:$k" --library $library)" "$(sed -n $((k + 1))p some)"
done

# What is said.
two='3m space:4m | 4m space:4m'
cp asked.plan walked.plan
golden explained "tartan explain $scratch/walked.plan '$two ; - ; first | second ; wall' --library asked"
"$TARTAN" explain walked.plan "$two ; - ; first | second ; door" --library asked --full -o why.svg
is 'drawn, as a line' "$(grep -c 'stroke="#143399"' why.svg)" 1
# Where the first room is: to the right of the second one, half of the partition and 50 mm from it, at half its depth.
is 'drawn, as a line in its room' "$(python3 - why.svg <<'PY'
import re, sys
svg = open(sys.argv[1], encoding="utf-8").read()
x, y, along = map(float, re.search(r'stroke="#143399".* d="M(\S+) (\S+)h(\S+)"', svg).groups())
left, top, wide, deep = map(float, re.search(r'fill-opacity=".35" d="M(\S+) (\S+)h(\S+)v([^h]*)h', svg).groups())
mm = along / 2850
print(abs(left + wide + 100 * mm - x) < 0.01, abs(top + deep / 2 - y) < 0.01)
PY
)" 'True True'
golden kept "tartan explain $scratch/walked.plan '$two ; - ; first | second ; door' --library asked --full"
form 'require exits(cell(second)) >= 2, walk(cell(second), to outside) <= 2m' >walked.plan
golden dropped "tartan explain $scratch/walked.plan '$two ; - ; first | second ; door' --library asked"
form 'prune walk(cell(second), to outside) > 3m as far' >walked.plan
golden varied "tartan vary $scratch/walked.plan '$two ; - ; first | second ; door' --library asked"
cat >>walked.plan <<'PLAN'
measure longest = walk(cell(any), to outside)
measure ways = exits(cell(any))
test longest { value [3m space:4m | 4m space:4m ; - ; first | second ; door] = 2.85m  value [3m space:4m | 4m space:4m ; - ; first | second ; wall] = 2.85m }
test ways { value [3m space:4m | 4m space:4m ; - ; first | second ; door] = 1 }
PLAN
golden tested "tartan test $scratch/walked.plan"
golden measured "tartan house $scratch/walked.plan '3m space:4m | 4m space:4m ; - ; first | second ; door' --measures"
golden measured_none "tartan house $scratch/walked.plan '3m space:4m | 4m space:4m ; - ; first | second ; wall' --measures -o -"
golden measured_nowhere "tartan house $scratch/walked.plan '3m space:4m | 4m space:4m ; - ; first | second ; wall' --measures -o $scratch/x.json"

# The JSON of each house says what the table of all says, and no more; costs among it are those of its bill, to the cent.
cat >>furnished.plan <<'PLAN'
measure longest = walk(cell(any), to outside)
measure shortest = least walk(cell(any), to outside)
measure ways = exits(cell(any))
measure price = sum(cost)
measure space = sum(area of cell(any))
measure mixed = 2 * longest + sum(width)
PLAN
"$TARTAN" enumerate furnished.plan --library all --plan '4m space:5m | 4m space:5m' --columns -o houses.csv
for k in 0 1 33 60 149; do "$TARTAN" house furnished.plan "#1:$k" --library all -o $k.json; done
python3 - 0 1 33 60 149 <<'PY' || fail 'measures of a house'
import csv, fractions, json, sys
rows = list(csv.DictReader(open("houses.csv")))
names = {"longest": "m", "shortest": "m", "ways": "", "price": "", "space": "m2", "mixed": "m"}
seen = set()
for k in sys.argv[1:]:
    house, row = json.load(open(k + ".json")), rows[int(k)]
    assert house["house"] == row["line"], (k, row["line"])
    values = {m["measure"]: (m.get("value"), m["unit"]) for m in house["measures"]}
    assert list(values) == list(names), values
    for name, unit in names.items():
        value, of = values[name]
        shown = row[name + ("_" + unit if unit else "")]
        assert of == unit and (value is None) == (shown == ""), (k, name, values, shown)
        assert value is None or abs(fractions.Fraction(value) - fractions.Fraction(shown)) <= fractions.Fraction(1, 2000000), (k, name)
        seen.add((name, value))
    assert abs(fractions.Fraction(values["price"][0]) - fractions.Fraction(house["cost"])) < 1, (k, house["cost"])
    area = sum((x1 - x0) * (y1 - y0) for x0, x1, y0, y1 in (c["rect"] for c in house["cells"]))
    assert fractions.Fraction(values["space"][0]) == fractions.Fraction(area, 10**18), (k, area)
    if values["longest"][0] is not None:
        assert fractions.Fraction(values["mixed"][0]) == 2 * fractions.Fraction(values["longest"][0]) + 8, k
assert len({v for n, v in seen if n == "longest"}) == 2 and len({v for n, v in seen if n == "price"}) > 2, seen
PY

# Put in order, spread and traded off by such measures, on one plan: as Python does with the table of all, in which some have no value.
cat >>furnished.plan <<'PLAN'
library some from rows in f { require walk(cell(any), to outside) <= 3.9m }
PLAN
cat >doors.plan <<'PLAN'
schema row { width role length = 4m  zone house role band = space(5m) }
library rows using row { trays 1..2 }
form g of row {
  storey ground 2.7m
  wall 200mm
  partition 100mm
  floor 300mm
  roof 200mm
  way 700mm
  function room at cell(any)
  opening door wide 900mm high 2m passage sliding
  opening arch wide 1.2m high 2m passage leafless
  face cell(any) beside cell(any) = door | arch | wall
  face cell(any) outside left = door | arch | wall
  face cell(any) outside = wall
  tile rooms for room { item table left 2m..3m, back 1.5m..3m }
  tile benches for room { against wall  item bench left 300mm..2m, back 0..400mm }
  material pine "#c0a080" price 100 per m2 for table
  material oak "#806040" price 75.50 per each for bench
}
library doors from rows in g { }
measure far using g = walk(cell(any), to outside)
measure near using g = least walk(cell(any), to outside)
measure out using g = exits(cell(any))
measure paid using g = sum(cost)
measure both using g = far * 1/3 - near + sum(width) / 7
PLAN
plan='4m space:5m | 4m space:5m'
"$TARTAN" enumerate doors.plan --library doors --plan "$plan" --columns -o doors.csv
ask() { "$TARTAN" "$1" doors.plan "${@:2}" --library doors --plan "$plan" 2>said; }
ask best 9 --least far --then-most paid --format json >best.1
ask best 3000 --most far --then-least out --then-least paid --format json >best.2
ask best 3000 --most both --format json >best.3
ask best 3000 --most paid --then-least out --format json >best.4
ask best 500 --least far --then-most paid --diverse --format json >best.5
ask best 3000 --most both --format json --threads 4 >best.6
ask pareto --least far --most paid --json >front.1
ask pareto --least both --most near --least paid --json >front.2
ask count --by far --json >by.1
ask count --by both --json >by.2
ask count --by out --json >by.3
python3 - <<'PY' || fail 'houses in order by walks'
import csv, fractions, json
rows = list(csv.DictReader(open("doors.csv")))
column = {"far": "far_m", "near": "near_m", "out": "out", "both": "both_m", "paid": "paid"}
def value(row, name):
    return None if row[column[name]] == "" else fractions.Fraction(row[column[name]])
def valued(*names):
    return [r for r in rows if None not in [value(r, n) for n in names]]
def found(name):
    return [json.loads(line) for line in open(name)]
def ordered(*wishes):
    return sorted(valued(*(n for n, most in wishes)), key=lambda r: [-value(r, n) if most else value(r, n) for n, most in wishes])
close = fractions.Fraction(1, 1000000)
def same(name, wishes, count):
    got, want = found(name), ordered(*wishes)[:count]
    assert [h["house"] for h in got] == [r["line"] for r in want], (name, len(got), len(want))
    for h, r in zip(got, want):
        values = h["values"] if "values" in h else [h["value"]]
        assert all(abs(fractions.Fraction(v) - value(r, n)) <= close for v, (n, most) in zip(values, wishes)), (name, h)
assert len(rows) > 200 and 50 < len(valued("far")) < len(rows), (len(rows), len(valued("far")))
same("best.1", [("far", False), ("paid", True)], 9)
same("best.2", [("far", True), ("out", False), ("paid", False)], 3000)
same("best.3", [("both", True)], 3000)
same("best.4", [("paid", True), ("out", False)], 3000)
same("best.6", [("both", True)], 3000)
diverse = {h["house"] for h in found("best.5")}
assert len(found("best.5")) == len(diverse) == 500 and diverse <= {r["line"] for r in valued("far", "paid")}, len(diverse)
assert found("best.5")[0]["house"] == found("best.1")[0]["house"]
def front(name, wishes):
    of = lambda r: tuple(-value(r, n) if most else value(r, n) for n, most in wishes)
    all = valued(*(n for n, most in wishes))
    keep = [r for r in all if not any(of(o) != of(r) and all_le(of(o), of(r)) for o in all)]
    want = {}
    for r in keep:
        want.setdefault(of(r), []).append(r["line"])
    got = json.load(open(name))["points"]
    assert [(p["house"], p["houses"]) for p in got] == [(want[k][0], str(len(want[k]))) for k in sorted(want)], (name, got, want)
    return len(got)
def all_le(a, b):
    return all(x <= y for x, y in zip(a, b))
assert front("front.1", [("far", False), ("paid", True)]) > 1
front("front.2", [("both", False), ("near", True), ("paid", False)])
for number, name in enumerate(["far", "both", "out"], 1):
    got, want = json.load(open("by.%d" % number)), {}
    for r in valued(name):
        want[value(r, name)] = want.get(value(r, name), 0) + 1
    assert [int(d["houses"]) for d in got["distribution"]] == [want[k] for k in sorted(want)], (name, got, want)
    assert all(abs(fractions.Fraction(d["value"]) - k) <= close for d, k in zip(got["distribution"], sorted(want))), name
    assert int(got["houses"]) == len(valued(name)) and int(got.get("none", 0)) == len(rows) - len(valued(name)), name
PY
"$TARTAN" best doors.plan 3 --library doors --plan "$plan" --least far -o best.svg 2>/dev/null
[ -s best.svg ] || fail 'the best by walks are not drawn'
"$TARTAN" draw doors.plan --library doors --plan "$plan" --best 2 --least far -o drawn.svg 2>/dev/null
is 'the best by walks are drawn small, each with its name' "$(grep -c '>#[0-9]*:[0-9]*<' drawn.svg)" 2
is 'of a library that asks for walks, by another measure' "$("$TARTAN" best furnished.plan 3000 --library some --plan "$plan" --least price 2>/dev/null | grep -v '^#' | sort)" \
    "$("$TARTAN" enumerate furnished.plan --library some --plan "$plan" | sort)"
sed 's/trays 1..2/trays 1..6/' furnished.plan >many.plan
golden many "tartan best $scratch/many.plan 3 --library all --plan '4m space:5m | 4m space:5m | 4m space:5m | 4m space:5m | 4m space:5m | 4m space:5m' --least longest"
best_of() { "$TARTAN" best furnished.plan 3 --library all --plan '4m space:5m | 4m space:5m' --least longest --max-houses "$1" 2>&1; }
is 'as many as are allowed' "$(best_of 150 | grep -cv '^#\|^note')" 3
is 'one fewer' "$(best_of 149 | grep -o 'E1617.*')" 'E1617]: measures of walks are found house by house, and there are more than 149 on this plan'
golden best_none "tartan best $scratch/walked.plan 3 --plan '3m space:4m | 4m space:4m' --library all --least longest"
golden best_all "tartan best $scratch/walked.plan 3 --library all --least longest"
golden spread "tartan count $scratch/walked.plan --plan '3m space:4m | 4m space:4m' --library all --by longest"

# A walk between cells that no house has: said where it stands, of cells for which no house is counted, and of no others; of forms of
# other files, too, but not in those files again.
cat >two.plan <<'PLAN'
schema row { width role length = 3m | 4m  zone house role band = space(4m) }
form f of row {
  storey ground 2.7m
  storey upper 2.7m
  wall 200mm
  partition 100mm
  floor 300mm
  roof 200mm
  way 800mm
  function hall at cell(ground)
  function bedroom at cell(upper)
  function study at cell(4m)
  opening door wide 900mm high 2m passage sliding
  face cell(any) outside = door
}
library rows using row { trays 1..2 }
library all from rows in f { }
measure never = walk(cell(bedroom, ground), to outside)
PLAN
warned=0 silent=0
for function in hall bedroom study any; do
    for storey in '' ', ground' ', upper'; do
        for width in '' ', 3m' ', 4m'; do
            cell="cell($function$storey$width)"
            case $cell in 'cell(any, '*) cell="cell(${cell#cell(any, }" ;; esac
            printf '%s\n' 'use "two.plan"' "measure one = walk($cell, to cell(any))" "measure two = least walk(cell(any), to $cell)" \
                "measure three = exits($cell) + exits(cell(any))" "measure four = walk(cell(any), to outside, through $cell)" \
                "rule five = apart($cell, from cell(any))" "rule six = apart(cell(any), from $cell)" \
                "rule seven = six or apart(cell(any), from cell(any), by door, through $cell)" >asking.plan
            "$TARTAN" check asking.plan >said 2>&1 || true
            houses=$("$TARTAN" count two.plan --library all --where "quantity($cell, n >= 1)" 2>/dev/null | awk '/^houses/ {print $2}')
            is "warnings of $cell" "$(grep -c 'W208' said || true)" "$([ "$houses" = 0 ] && echo 7 || echo 0)"
            [ "$houses" = 0 ] && warned=$((warned + 1)) || silent=$((silent + 1))
        done
    done
done
[ $warned -ge 5 ] && [ $silent -ge 10 ] || fail "cells that no house has: $warned, others: $silent"
finish
