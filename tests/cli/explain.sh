#!/usr/bin/env bash
# Needs the parts: draw search
# explain: which clauses drop a plan, by which trays, and what is nearest; rules by themselves; JSON and pictures.
name=explain
. "$(dirname "$0")/golden.bash"

golden dropped "tartan explain sheds.plan '3m door | 3m door' --library sheds"
golden kept "tartan explain sheds.plan '3m door' --library sheds"
golden kept_full "tartan explain sheds.plan '3m door' --library sheds --full"
golden rank "tartan explain sheds.plan '#3' --library sheds --full"
golden length "tartan explain sheds.plan '3m door | 3m - | 3m - | 3m - | 6m -' --library sheds --nearest 1"
golden rule "tartan explain sheds.plan '3m - | 6m - | 3m door' --rule wide-end --rule door-pair"
golden rules_alone "tartan explain parts.plan 'low red 1m | high grey 1m | low grey 2m | high red 1m | low blue 3m' --full"
golden rules_unmatched "tartan explain parts.plan 'high grey 1m | low blue 1m | high grey 1m' --full"
golden steps "tartan explain steps.plan '2m x'"
golden steps_kept "tartan explain steps.plan '2m y' --full"
golden where "tartan explain sheds.plan '3m door | 6m -' --library sheds --where 'trays = 3' --nearest 1"
golden json "tartan explain sheds.plan '6m - | 3m -' --library sheds --json"
golden file "printf '3m door\n6m -\n' | tartan explain sheds.plan --plan - --library sheds --nearest 0"
golden bad_plan "tartan explain sheds.plan '3m dor' --library sheds"
golden bad_rank "tartan explain sheds.plan '#x' --library sheds"
golden no_rules "tartan explain /dev/null '3m'"
golden no_such_rank "tartan explain sheds.plan '#100000' --library sheds"
golden rank_of_rules "tartan explain parts.plan '#1'"
golden in_brackets "tartan explain sheds.plan '[6m door | 3m]' --library sheds"
golden no_plan "tartan explain sheds.plan"
golden two_plans "tartan explain sheds.plan '3m -' --plan -"
golden state_limit "tartan explain sheds.plan '6m - | 3m -' --library sheds --max-states 2"
golden too_long "tartan explain parts.plan 'low red 1m | low red 1m | low red 1m' --max-length 2"

# A module explains as its rule file does, and pictures are made in each format, the same each time.
(cd "$files" && "$TARTAN" build sheds.plan -o "$scratch/sheds.tnb")
is 'from a module' "$("$TARTAN" explain "$scratch/sheds.tnb" '6m - | 3m -' --library sheds)" \
    "$("$TARTAN" explain "$files/sheds.plan" '6m - | 3m -' --library sheds)"
plan=$("$TARTAN" unrank stdlib/lahave-houses.plan 12345)
for format in svg png pdf; do
    "$TARTAN" explain stdlib/lahave-houses.plan "$plan" --full -o "$scratch/a.$format"
    "$TARTAN" explain stdlib/lahave-houses.plan "$plan" --full -o "$scratch/b.$format"
    cmp "$scratch/a.$format" "$scratch/b.$format" || fail "the pictures in $format differ"
done
grep -q '#5ca861' "$scratch/a.svg" || fail 'no green'
grep -q '#c7332b' "$scratch/a.svg" || fail 'no red'
"$TARTAN" explain "$files/sheds.plan" '6m - | 3m -' --library sheds -o "$scratch/table.svg"
[ -s "$scratch/table.svg" ] || fail 'no picture of a schema without roles'
exits 2 "$TARTAN" explain "$files/sheds.plan" '6m - | 3m -' --library sheds -o "$scratch/a.txt"

# What is nearest to a plan that is kept is not asked; what is nearest otherwise is kept.
"$TARTAN" explain "$files/sheds.plan" '3m door | 3m door' --library sheds --nearest 100 | sed -n 's/^    \([36]m\)/\1/p' >"$scratch/near"
[ -s "$scratch/near" ] || fail 'no nearest plans'
is 'nearest plans that are not kept' "$("$TARTAN" prune "$files/sheds.plan" "$scratch/near" --library sheds | wc -l)" \
    "$(wc -l <"$scratch/near")"

# In a picture what condemns is red, and the nearest plans that are kept stand below: without them it is lower.
if "$TARTAN" draw "$files/rows.plan" --sample 1 -o "$scratch/any.svg" 2>/dev/null; then
    plan='2m fish north - open:1m none | 2m fruit north - open:1m none | 2m nothing north - none none'
    "$TARTAN" explain "$files/stalls.plan" "$plan" -o "$scratch/near.svg"
    "$TARTAN" explain "$files/stalls.plan" "$plan" --nearest 0 -o "$scratch/alone.svg"
    height() { sed -n 's/.*<svg[^>]* height="\([0-9]*\).*/\1/p' "$1" | head -1; }
    [ "$(height "$scratch/near.svg")" -gt "$(($(height "$scratch/alone.svg") + 100))" ] || fail 'the nearest plans are not drawn'
    grep -q '#c7332b' "$scratch/alone.svg" || fail 'what condemns is not red'
    grep -q '#5ca861' "$scratch/alone.svg" && fail 'what condemns is green'
fi

# What both sides of a comparison came to, beside what Python finds.
"$TARTAN" sample "$files/sides.plan" 12 --seed 5 >"$scratch/sides"
{
    while read -r plan; do
        for rule in wide share between dear many-beds back turned rate named moved shifted by-trays floor half-beds least-share each-use longest; do
            "$TARTAN" explain "$files/sides.plan" "$plan" --rule "$rule" --json 2>/dev/null
        done
    done
} <"$scratch/sides" >"$scratch/sides.json"
python3 - "$scratch/sides.json" <<'PYTHON' || fail 'the sides of comparisons come to something else'
import json, sys
from fractions import Fraction as F

RENT = {"kitchen": 30, "bath": 20, "bed": 10}


def number(text):
    word = text.split()[0].replace(",", "")
    return float(F(word)) if "." not in word else float(word)


def sides(rule, trays):
    widths = [(int(w[:-1]), u) for w, u in trays]
    width, rent = sum(w for w, u in widths), sum(RENT[u] for w, u in widths)
    of = lambda use: sum(w for w, u in widths if u == use)
    many = lambda use: sum(u == use for w, u in widths)
    n = len(widths)
    return {
        "wide": (width, [2 * of("bed") + 3], " m"),
        "share": (100 * of("bed") / width, [40], " %"),
        "between": (100 * of("bath") / width, [10, 30], " %"),
        "dear": (rent, [30, 60], ""),
        "many-beds": (many("bed"), [many("kitchen")], ""),
        "back": (of("bed") - of("bath"), [3], " m"),
        "turned": (60, [rent], ""),
        "rate": (rent / width, [3, 5], " /m"),
        "named": (rent, [2 * (rent + n)], ""),
        "moved": (rent + 1 - 2 * (rent + n) - 7, None, ""),
        "shifted": (rent + 5 - 60, None, ""),
        "by-trays": (3 * n, [4 * many("bed")], ""),
        "floor": (6 * width, [70], " m2"),
        "half-beds": (many("bed"), [F(n, 2)], ""),
        "least-share": (25, [100 * of("kitchen") / width], " %"),
        "longest": None,
    }[rule]


seen = 0
for line in open(sys.argv[1]):
    answer = json.loads(line)
    trays = [tray.split() for tray in answer["plan"].split(" | ")]
    rule, why = answer["rules"][0]["name"], answer["rules"][0]["why"]
    if rule == "each-use":  # a comparison for each use, in their order
        whole = sum(int(tray[0][:-1]) for tray in trays)
        for use, part in zip(RENT, why["parts"], strict=True):
            held = sum(int(tray[0][:-1]) for tray in trays if tray[1] == use)
            assert part["evidence"] == part["left"] + ", compared with " + part["right"][0]
            assert number(part["left"]) == held and number(part["right"][0]) == whole / 2, (trays, part)
        continue
    wanted = sides(rule, trays)
    if wanted is None:
        assert "left" not in why and "difference" not in why, (rule, why)
        continue
    left, right, unit = wanted
    if right is None:
        got = [why["difference"]]
        assert "left" not in why and why["evidence"] == "the left side less the right side is " + why["difference"]
    else:
        got = [why["left"], *why["right"]]
        assert why["evidence"] == why["left"] + ", compared with " + " and ".join(why["right"]), why
    for text, value in zip(got, [left, *(right or [])], strict=True):
        assert abs(number(text) - value) <= 1e-5 * max(1, abs(value)) and text.endswith(unit), (rule, trays, text, value)
    seen += 1
assert seen == 12 * 15, seen
PYTHON
finish
