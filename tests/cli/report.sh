#!/usr/bin/env bash
# report: one page with nothing from elsewhere, the same each time, with every clause and plan; nothing else is left behind.
name=report
. "$(dirname "$0")/golden.bash"

golden no_folder 'tartan report rows.plan'
golden not_a_folder "tartan report rows.plan -o rows.plan/x"
golden no_library "printf 'schema s { w = 1m }' >$scratch/s.plan; tartan report $scratch/s.plan -o $scratch/none"
"$TARTAN" report "$files/rows.plan" -o "$scratch/a" --sample 5 --seed 2
"$TARTAN" report "$files/rows.plan" -o "$scratch/b" --sample 5 --seed 2 --threads 1
cmp -s "$scratch/a/index.html" "$scratch/b/index.html" || fail 'the same report has other bytes'
is 'files in the folder' "$(ls -A "$scratch/a")" index.html
"$TARTAN" count "$files/rows.plan" --json >"$scratch/counts"
python3 - "$scratch/a/index.html" "$scratch/counts" require@18 twins <<'PYTHON' || fail 'the page is not as it should be'
import html.parser, json, re, sys, xml.dom.minidom

page = open(sys.argv[1], encoding="utf-8").read()
assert not re.search(r'(src|href)="(?!#)|url\((?!#)', page), "something comes from elsewhere"
open_tags = []


class Checker(html.parser.HTMLParser):
    def handle_starttag(self, tag, attrs):
        if tag not in ("meta", "input", "option", "br"):
            open_tags.append(tag)

    def handle_endtag(self, tag):
        if tag != "option":
            assert open_tags.pop() == tag, tag


Checker().feed(page)
assert not open_tags, open_tags
pictures = re.findall(r"<svg.*?</svg>", page, re.S)
for picture in pictures:
    xml.dom.minidom.parseString(picture)
    assert "<symbol" not in picture, "letters are drawn, not written"
ids = re.findall(r'\bid="([^"]*)"', page)
assert len(ids) == len(set(ids)), "an id twice"
for target in re.findall(r'href="#([^"]*)"', page) + re.findall(r"url\(#([^)]*)\)", page):
    assert target in ids, target
assert page.count('<div class="plan kept"') == 5

# What a client asks comes first, and what is wrong or not known last, once.
heads = re.findall(r'<h2 id="([^"]*)"', page)
assert heads == ["plans", "figures", "rules", "each", "findings"], heads
sheet = page[page.index('id="plans"'):page.index('id="figures"')]
assert sheet.count("<svg") == 1 and sheet.count(">rank</text>") == 5, sheet.count(">rank</text>")
cards = re.findall(r'<section class="card" id="rule-([^"]*)">(.*?)</section>', page, re.S)
assert [name for name, card in cards] == sys.argv[3:], cards
counts = json.load(open(sys.argv[2]))
counted = [("keeps out", c["keeps_out"], c["only"]) for c in counts["requirements"]]
counted += [("prunes", c["prunes"], c["only"]) for c in counts["rules"]]
for (name, card), (what, out, only) in zip(cards, counted, strict=True):
    words = re.sub(r"</?b>", "", card)
    assert f"{what} {int(out):,} (" in words and f"kept out by this alone {int(only):,}<" in words, (name, out, only)
for name, card in cards:
    assert "<svg" in card and "<pre>" in card and "coverage: tests notice" in card, name
assert len(page) < 40000 * len(pictures)
PYTHON

# Measures: a histogram and the plans with the least and the most of each; no backticks in what is read; long text is not cut off.
"$TARTAN" report "$files/measures.plan" --library strips -o "$scratch/measures" --sample 2
python3 - "$scratch/measures/index.html" "$("$TARTAN" best "$files/measures.plan" 5 -l strips --most cost -f lines | grep -v '^#')" <<'PYTHON' || fail 'the measures of the page are not as they should be'
import re, sys

page = open(sys.argv[1], encoding="utf-8").read()
cards = re.findall(r'<section class="card measure" id="measure-([^"]*)" aria-label="[^"]*">(.*?)</section>', page, re.S)
assert [name for name, card in cards] == ["area", "cost", "all-beds", "served"], [name for name, card in cards]
for name, card in cards:
    assert card.count("<svg") == 11 and ">mean</text>" in card, name
cost = dict(cards)["cost"]

# The table of figures says of each measure what its histogram says.
figures = page[page.index('id="figures"'):page.index('id="measures"')]
rows = re.findall(r'<tr><td><a href="#measure-([^"]*)">.*?</td><td>.*?</td>(.*?)</tr>', figures)
assert [name for name, row in rows] == [name for name, card in cards], rows
for (name, row), (_, card) in zip(rows, cards):
    values = re.findall(r"<td class=\"number\">(.*?)</td>", row)
    texts = re.findall(r">([^<>]*)</text>", card)
    facts = [texts[texts.index(word) + 1] for word in ("least", "half is at most", "most", "mean") if word in texts]
    assert len(values) == 4 and values[:3] == facts[:3], (name, values, facts)
assert re.findall(r'class="line">([^<]*)<', cost)[5:] == sys.argv[2].splitlines()
assert "`" not in re.sub(r"<(script|pre|style)>.*?</\1>", "", page, flags=re.S), "backticks"
assert "overlaps with" not in page and "pre-wrap" in page
PYTHON

# Rules that are no clauses: how many of the plans generated and kept they match.
"$TARTAN" report "$files/sheds.plan" --library any-sheds -o "$scratch/any"
is 'what other rules match' "$(sed -n 's|.*"counts">matches \(.*\)</p>|\1|p' "$scratch/any/index.html" | sed 's|</*b>||g')" \
    '4 (19.0 % of what is generated)<br>of the plans kept 4 (19.0 %)
14 (66.6 % of what is generated)<br>of the plans kept 14 (66.6 %)'

# Rules past the limit of states: told once, at the end, not on every card.
{
    cat "$files/rows.plan"
    for n in 60 70 80 90; do echo "rule shops-$n = quantity(tray(shop), n >= $n)"; done
} >"$scratch/many.plan"
"$TARTAN" report "$scratch/many.plan" --max-states 30 -o "$scratch/many" --sample 2 2>/dev/null
is 'not compared' "$(grep -c 'not compared' "$scratch/many/index.html")" 1
sed -n '/id="limits"/,$p' "$scratch/many/index.html" | grep -q '<li>[0-9]* of [0-9]* pairs of rules are not compared: past' || fail 'limits are not last'

# Clauses of one name, of a library and of the one that it is from, have a place each.
{
    cat "$files/rows.plan"
    echo 'rule pairs = neighbour(tray(4.5m), tray(4.5m))'
    echo 'library short { trays 1..2 total <= 12m } library shorter from short { total <= 9m }'
} >"$scratch/short.plan"
"$TARTAN" report "$scratch/short.plan" --library shorter -o "$scratch/short" 2>/dev/null
grep -q '<p>short.plan:[0-9]*: W004: <code>pairs</code> matches the same plans as <code>twins</code></p>' "$scratch/short/index.html" ||
    fail 'a finding has no place'
is 'cards' "$(grep -o 'id="rule-[^"]*"' "$scratch/short/index.html" | tr '\n' ' ')" 'id="rule-total" id="rule-total.2" id="rule-twins" id="rule-pairs" '

# A few houses side by side: the table has what `house` writes of each, and marks what differs. One house: no table.
golden many_houses 'tartan report cottage '"$(printf '%s ' $(seq 1 13))"' -o x.html'
golden houses_and_sample "tartan report cottage '#1' --sample 2 -o $scratch/none.html"
golden no_house "tartan report cottage '#99999999999' -o $scratch/none.html"
"$TARTAN" sample cottage 3 -l cottages --seed 3 >"$scratch/three"
i=0
while read -r house; do
    i=$((i + 1))
    "$TARTAN" house cottage "$house" -o "$scratch/$i.csv" -o "$scratch/$i.parts.csv" >/dev/null
    printf '%s\0' "$house"
done <"$scratch/three" >"$scratch/three.0"
xargs -0 "$TARTAN" report cottage -l cottages -o "$scratch/three.html" <"$scratch/three.0"
"$TARTAN" report cottage "$(head -n 1 "$scratch/three")" -o "$scratch/one.html"
grep -q 'class="compared"' "$scratch/one.html" && fail 'one house is compared'
grep -q '<h4>Parts and prices</h4>' "$scratch/one.html" || fail 'a house has no prices'
python3 - "$scratch" <<'PYTHON' || fail 'houses side by side are not as they should be'
import csv, re, sys

page = open(f"{sys.argv[1]}/three.html").read()
lines = open(f"{sys.argv[1]}/three").read().splitlines()
table = page[page.index('<table class="compared">'):page.index('id="houses"')]
rows = {}
for mark, name, cells in re.findall(r"<tr( class=\"differs\")?><th>(.*?)</th>(.*?)</tr>", table)[1:]:
    rows[name] = re.findall(r"<td[^>]*>(.*?)</td>", cells)
    assert len(rows[name]) == 3 and bool(mark) == (len(set(rows[name])) > 1), (name, rows[name])
for i in range(3):
    rooms = list(csv.DictReader(open(f"{sys.argv[1]}/{i + 1}.csv")))
    parts = list(csv.DictReader(open(f"{sys.argv[1]}/{i + 1}.parts.csv")))
    near = lambda name, value: abs(float(rows[name][i].replace(",", "")) - value) < 0.006
    assert int(rows["rooms"][i]) == len(rooms)
    assert near("net sf", sum(float(r["net_sf"]) for r in rooms)) and near("gross sf", sum(float(r["gross_sf"]) for r in rooms))
    assert near("glazed sf", sum(float(r["glazed_sf"]) for r in rooms)) and near("cost", float(parts[-1]["cost"]))
    for function in ("living", "kitchen", "bath", "bedroom", "stair"):
        of = [float(r["net_sf"]) for r in rooms if r["function"] == function]
        assert int(rows[f"{function} rooms"][i]) == len(of) and near(f"{function} net sf", sum(of)), function
    assert int(rows["bedrooms"][i]) == sum(r["function"] == "bedroom" for r in rooms)
    plan = lines[i].split(" ; ")[0]
    assert rows["plan"][i].replace("&quot;", '"') == plan and "options" not in rows
    assert lines[i].split(" ; ")[1].split()[2] == rows["body roof"][i]
assert page.count('<section class="card house">') == 3 and page.count("<h4>Rooms</h4>") == 3
assert page.count("<svg") >= 4, page.count("<svg")
PYTHON
finish
