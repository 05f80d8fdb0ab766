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
finish
