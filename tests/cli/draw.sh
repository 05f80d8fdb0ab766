#!/usr/bin/env bash
# Needs the parts: draw
# draw: pictures of the kind that the name asks for, the same bytes each time, with what has to be on them.
name=draw
. "$(dirname "$0")/golden.bash"
sheds=$files/sheds.plan
rows=$files/rows.plan

for kind in svg png pdf; do
    "$TARTAN" draw "$rows" --sample 12 --seed 3 -o "$scratch/a.$kind"
    sleep 1.1 # past the second, in case a picture carries the time
    "$TARTAN" draw "$rows" --sample 12 --seed 3 --threads 1 -o "$scratch/b.$kind"
    cmp -s "$scratch/a.$kind" "$scratch/b.$kind" || fail "$kind: the same sheet has other bytes"
    "$TARTAN" draw "$rows" --sample 12 --seed 4 -o "$scratch/c.$kind"
    cmp -s "$scratch/a.$kind" "$scratch/c.$kind" && fail "$kind: another seed gives the same sheet"
done
# What an SVG shows says what it is: twelve plans with their trays; a rule and its parts, by the numbers that `explain` gives them.
said() { # ATTRIBUTE FILE: its values, once each
    grep -o "<g data-$1=\"[0-9]*\"" "$2" | grep -o '[0-9]*' | sort -nu | tr '\n' ' '
}
is 'plans of the sheet' "$(said plan "$scratch/a.svg")" '0 1 2 3 4 5 6 7 8 9 10 11 '
is 'trays of the sheet' "$(grep -c '<g data-tray' "$scratch/a.svg")" "$("$TARTAN" sample "$rows" 12 --seed 3 | tr -cd '|\n' | wc -c)"
"$TARTAN" draw lahave --rule stranded --rule thin-totem -o "$scratch/two.svg"
is 'rules of a picture' "$(said rule "$scratch/two.svg")" '0 1 '
plan=$("$TARTAN" sample lahave-houses 1 --seed 3)
for rule in thin-totem narrow-pair dense-end hall-without-totem; do
    "$TARTAN" draw lahave-houses --rule "$rule" -o "$scratch/rule.svg"
    is "parts of $rule" "$(said part "$scratch/rule.svg")" \
        "$("$TARTAN" explain lahave-houses "$plan" --rule "$rule" --full --json | grep -o '"number": *[0-9]*' | grep -o '[0-9]*' | sort -nu | tr '\n' ' ')"
done
"$TARTAN" explain lahave-houses "$plan" --rule thin-totem --full -o "$scratch/why.svg"
is 'rows of an explanation' "$(said part "$scratch/why.svg")" '0 1 2 3 4 '
is 'PNG' "$(head -c 4 "$scratch/a.png" | tail -c 3)" PNG
is 'PDF' "$(head -c 4 "$scratch/a.pdf")" %PDF
python3 -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' "$scratch/a.svg" || fail 'the SVG is not well-formed'

# Plans from a file or a pipe, by line or by rank; tables where the schema has no roles; more plans than a page holds.
"$TARTAN" enumerate "$rows" --limit 5 >"$scratch/plans"
"$TARTAN" draw "$rows" "$scratch/plans" -o "$scratch/file.svg"
"$TARTAN" draw "$rows" -o "$scratch/pipe.svg" <"$scratch/plans"
[ -s "$scratch/file.svg" ] && [ -s "$scratch/pipe.svg" ] || fail 'plans from a file or a pipe are not drawn'
"$TARTAN" draw "$sheds" --library sheds --sample 5 -o "$scratch/table.svg"
"$TARTAN" enumerate "$sheds" -l any-sheds --limit 1 | "$TARTAN" draw "$sheds" - -o "$scratch/empty.svg"
"$TARTAN" draw "$rows" --sample 400 --paper a4 -o "$scratch/pages.pdf"
pages=$(python3 - "$scratch/pages.pdf" <<'PYTHON'
import re, sys, zlib
data = open(sys.argv[1], "rb").read()
for stream in re.findall(rb"stream\r?\n(.*?)endstream", data, re.S):
    try:
        data += zlib.decompress(stream)
    except zlib.error:
        pass
print(len(re.findall(rb"/Type\s*/Page\b", data)))
PYTHON
)
[ "$pages" -gt 3 ] || fail "four hundred plans are on $pages pages"
"$TARTAN" draw "$rows" --sample 3 --columns 1 --scale 100 --paper a2 --dpi 40 --title 'Three' -o "$scratch/options.png"

# What a tray is for has a tone of its own, with roles and without; a tray without zones is dashed.
# tones SVG: how many colours other than black, white and grey the fills have.
tones() {
    python3 - "$1" <<'PYTHON'
import re, sys
fills = set(re.findall(r'fill="#([0-9a-f]{6})"', open(sys.argv[1]).read()))
print(sum(max(bytes.fromhex(f)) - min(bytes.fromhex(f)) > 10 for f in fills))
PYTHON
}
printf '2m %s north - open:1m none | 2m %s south water none none\n' fish meat flowers nothing >"$scratch/stalls.plans"
"$TARTAN" draw "$files/stalls.plan" "$scratch/stalls.plans" -o "$scratch/stalls.svg"
is 'tones of the trades and of the legend' "$(tones "$scratch/stalls.svg")" 5
grep -q 'stroke-dasharray="2.5' "$scratch/stalls.svg" || fail 'a tray without zones is not there'
sed -E 's/ role [a-z]+//' "$files/stalls.plan" | sed -E 's/ role [a-z]+//g' >"$scratch/bare.plan"
"$TARTAN" draw "$scratch/bare.plan" "$scratch/stalls.plans" -o "$scratch/bare.svg"
is 'tones without roles' "$(tones "$scratch/bare.svg")" 5
"$TARTAN" draw lahave-houses --sample 2 -o "$scratch/plain.svg"
is 'tones where nothing is chosen by name' "$(tones "$scratch/plain.svg")" 0

golden too_many_plans "tartan draw rows.plan --sample 60 --max-plans 50 -o $scratch/x.svg"
golden too_many_pixels "tartan draw rows.plan --sample 60 --dpi 2400 -o $scratch/x.png"
golden unknown_paper "tartan draw rows.plan --sample 6 --paper a9 -o $scratch/x.png"
golden does_not_fit "tartan draw rows.plan --sample 6 --paper a4 --scale 2 -o $scratch/x.pdf"
golden no_scale_for_tables "tartan draw sheds.plan --library sheds --sample 5 --scale 100 -o $scratch/x.svg"
golden bad_plan "printf '9m -\n' | tartan draw sheds.plan - -o $scratch/x.svg"
golden bad_plan_skipped "printf '9m -\n3m -\n' | tartan draw sheds.plan - --on-error skip -o $scratch/x.svg"
golden no_plans "tartan draw sheds.plan -o $scratch/x.svg"
# Rules as pictures: of every rule of the stdlib, of every kind of part, in each format, the same each time.
for file in stdlib/lahave.plan stdlib/lahave-houses.plan stdlib/terrace.plan "$files/parts.plan"; do
    rules=$(sed -n 's/^rule \([^ ]*\).*/--rule \1/p' "$file")
    for format in svg png pdf; do
        "$TARTAN" draw "$file" $rules -o "$scratch/rules.$format"
        "$TARTAN" draw "$file" $rules -o "$scratch/again.$format"
        cmp "$scratch/rules.$format" "$scratch/again.$format" || fail "the rules of $file differ in $format"
    done
done
"$TARTAN" build "$files/parts.plan" -o "$scratch/parts.tnb"
"$TARTAN" draw "$scratch/parts.tnb" --rule far -o "$scratch/module.svg"
"$TARTAN" draw "$files/parts.plan" --rule far -o "$scratch/source.svg"
cmp "$scratch/module.svg" "$scratch/source.svg" || fail 'the rule of a module is drawn otherwise'
golden no_such_rule "tartan draw parts.plan --rule fra -o $scratch/x.svg"
golden rules_and_plans "tartan draw parts.plan --rule far --sample 3 -o $scratch/x.svg"
{
    printf 'use "lahave"\nrule deep = symmetric neighbour(any, '
    for i in 1 2 3 4 5 6 7 8 9; do printf 'symmetric neighbour(any, '; done
    echo 'any))))))))))'
} >"$scratch/deep.plan"
golden rule_too_large "tartan draw $scratch/deep.plan --rule deep -o $scratch/x.svg"
# Rules: what is so for some value of a field is drawn once, with its words; a call as what it means; trays in the sheet's colours
# and names.
alike=$files/alike.plan
"$TARTAN" draw "$alike" --sample 12 -o "$scratch/alike.svg"
for rule in twin each-use growing nested wet alike-pair steamy by-any no-baths; do
    "$TARTAN" draw "$alike" --rule "$rule" -o "$scratch/rule-$rule.svg"
done
python3 - "$scratch" <<'PYTHON' || fail 'rules are not drawn as they should be'
import collections, re, sys, xml.etree.ElementTree as tree

NAMES = {"kitchen", "bath", "bedroom", "living"}


def words(name):
    return [e.text for e in tree.parse(f"{sys.argv[1]}/{name}.svg").iter("{http://www.w3.org/2000/svg}text") if e.text]


def colours(name):
    """The fills that are no grey, in their order."""
    fills = re.findall(r'fill="#([0-9a-f]{6}|[0-9a-f]{3})"', open(f"{sys.argv[1]}/{name}.svg").read())
    fills = ["".join(c * 2 for c in f) if len(f) == 3 else f for f in fills]
    return [f for f in fills if len({f[0:2], f[2:4], f[4:6]}) > 1]


sheet = words("alike")
legend = [w for w in sheet[sheet.index("LEGEND"):] if w in NAMES][:4]
assert legend == ["kitchen", "bath", "bedroom", "living"], legend
tones = dict(zip(legend, dict.fromkeys(colours("alike"))))
assert len(tones) == 4 and len(set(tones.values())) == 4, tones
assert collections.Counter(w for w in sheet if w in ("street", "garden"))["street"] >= 12, "sides are not said"

assert words("rule-twin")[2:] == ["some v in use", "v", "v, garden terrace"], words("rule-twin")
assert words("rule-each-use")[1:] == ["every u in use", "u"], words("rule-each-use")
assert words("rule-growing")[1:] == ["some v, w in width: v < w", "v", "w"], words("rule-growing")
assert [w for w in words("rule-nested") if w.startswith("some")] == ["some v in use", "some w in width"], words("rule-nested")
assert words("rule-alike-pair")[1:] == ["some v in use", "beside(tray(v), tray(v))", "v", "v"], words("rule-alike-pair")
assert words("rule-by-any")[1:] == ["some v in use", "near-any(tray(v))", "beside(tray(living), tray(v))", "living", "v"], words("rule-by-any")
assert words("rule-steamy")[1:] == ["and", "around(bath)", "or", "pair(bath, kitchen)", "or", "bath", "kitchen", "bath", "kitchen",
                                    "beside(tray(bath), tray(living))", "bath", "living", "several(2, bath)", "n > 2", "bath"], words("rule-steamy")
wet = words("rule-wet")
assert "pair(kitchen, bath)" in wet and "pair(bath, bedroom)" in wet, wet
assert collections.Counter(w for w in wet if w in NAMES) == {"kitchen": 2, "bath": 4, "bedroom": 2}, wet
assert set(colours("rule-wet")) == {tones["kitchen"], tones["bath"], tones["bedroom"]}, (colours("rule-wet"), tones)
assert "not bath" in words("rule-no-baths") and set(colours("rule-no-baths")) <= set(tones.values()) - {tones["bath"]}
PYTHON

# The dashes of a room of several storeys leave its name free.
python3 - "$scratch/alike.svg" <<'PYTHON' || fail 'a dashed cross goes through a name'
import re, sys

text = open(sys.argv[1]).read()
segments = []
for element in re.findall(r'<path[^>]*stroke-dasharray="3 1.6"[^>]*/>', text):
    x = y = 0
    for kind, numbers in re.findall(r"([mMlL])([^mMlL]*)", re.search(r' d="([^"]*)"', element)[1]):
        values = [float(n) for n in re.findall(r"-?(?:[0-9]+\.?[0-9]*|\.[0-9]+)", numbers)]
        for i in range(0, len(values), 2):
            to = (values[i], values[i + 1]) if kind.isupper() else (x + values[i], y + values[i + 1])
            if kind in "lL" or i > 0:
                segments.append((x, y, *to))
            x, y = to
names = 0
for element, word in re.findall(r"<text([^>]*font-weight=\"bold\"[^>]*text-anchor=\"middle\"[^>]*)>([^<]*)</text>", text):
    at = {k: float(v) for k, v in re.findall(r' (x|y|font-size)="([0-9.]*)"', element)}
    across, down = at["font-size"] * 0.2 * len(word), at["font-size"] * 0.3  # half of what the letters take, at least
    if "rotate" in element:
        across, down = down, across
        middle = (at["x"] - at["font-size"] * 0.36, at["y"])
    else:
        middle = (at["x"], at["y"] - at["font-size"] * 0.36)
    names += 1
    for x1, y1, x2, y2 in segments:
        for k in range(101):
            x, y = x1 + (x2 - x1) * k / 100, y1 + (y2 - y1) * k / 100
            assert abs(x - middle[0]) > across or abs(y - middle[1]) > down, (word, middle, (x1, y1, x2, y2))
assert names >= 24 and len(segments) >= 24, (names, len(segments))
PYTHON
finish
