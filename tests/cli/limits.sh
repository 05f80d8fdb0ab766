#!/usr/bin/env bash
# Needs the parts: search
# Rule sets that blow up: every command ends with what passed which limit, where, and what raises it; nothing that was
# not analysed passes for fine.
name=limits
. "$(dirname "$0")/golden.bash"

plan="8' double - - dense:4' open:8' open:3'"
for library in blown joint; do
    limit=${library/joint/--max-states 200}
    limit=${limit/blown/}
    golden "count_$library" "tartan count blow-up.plan --library $library $limit"
    golden "diff_$library" "tartan diff blow-up.plan blow-up.plan --library $library $limit"
    golden "explain_$library" "tartan explain blow-up.plan \"$plan\" --library $library --full $limit | head -n 3"
    golden "report_$library" "tartan report blow-up.plan --library $library $limit -o $scratch/report"
    golden "coverage_$library" "tartan test blow-up.plan --coverage --library $library $limit"
done
golden report_limits "sed -n '/id=.limits/,/<.ul>/p' $scratch/report/index.html"
golden count_demanding 'tartan count blow-up.plan --library demanding --max-states 30'
golden count_demanding_json 'tartan count blow-up.plan --library demanding --max-states 30 --json 2>/dev/null | sed -n "/requirements/,\$p"'
# Plans are counted although their automaton passes a limit, also those before a plan; nothing else is asked of them.
golden count_apart 'tartan count apart.plan --max-states 5000'
golden count_apart_json 'tartan count apart.plan --max-states 5000 --json --no-effects'
golden rank_apart 'tartan rank apart.plan "3m store - | 2m stair - | 2m stair - | 4m store lit | 4m store lit" --max-states 5000'
golden rank_apart_no 'tartan rank apart.plan "4m store - | 4m stair - | 4m store -" --max-states 5000'
golden unrank_apart 'tartan unrank apart.plan 3 --max-states 5000'
golden sample_apart 'tartan sample apart.plan 2 --max-states 5000'
for states in 20000 8000 5000; do
    "$TARTAN" count "$files/apart.plan" --no-effects --max-states $states | sed '/^states\|^counted apart/d' >"$scratch/apart-$states" || fail "$states states: exit $?"
    cmp "$scratch/apart-20000" "$scratch/apart-$states" || fail "$states states count other plans"
done
for rank in 0 12345 1000000000 2029456331; do
    held=$("$TARTAN" unrank "$files/apart.plan" $rank) || fail "no plan of rank $rank"
    for limit in '5000 --threads 1' '5000 --threads 4' '8000 --threads 2'; do
        # shellcheck disable=SC2086
        [ "$("$TARTAN" rank "$files/apart.plan" "$held" --max-states $limit)" = $rank ] || fail "$rank is not the rank of $held with --max-states $limit"
    done
done
golden check 'tartan check blow-up.plan'
golden check_small 'tartan check blow-up.plan --max-states 3'
golden relations 'tartan check blow-up.plan --relations --max-states 3'
golden regex 'tartan export blow-up.plan --regex --rule far'
golden match "printf '%s\\n' \"$plan | $plan\" | tartan match blow-up.plan --rule far --format bits"
# Within the library's lengths, so many states are enough for all questions about it; over plans of any length they are not.
golden ward_count 'tartan count ward-strip.plan --max-states 45000'
golden ward_check 'tartan check ward-strip.plan --max-states 45000'
golden ward_coverage 'tartan test ward-strip.plan --coverage --max-states 45000'

# Pictures end at a limit of their size, whatever the lengths.
cat >"$scratch/thin.plan" <<'PLAN'
schema strip {
  width role length = 0.00000001m | 3m
  zone room role band = slab(8m) role solid
}
rule thin = tray(0.00000001m)
library strips using strip { trays 1..2  prune thin and not tray(slab) }
measure plans-width = sum(width)
PLAN
for rank in 0 1 3; do
    (ulimit -f 2000; timeout 60 "$TARTAN" explain "$scratch/thin.plan" "#$rank" -o "$scratch/thin.svg") || fail "no picture of plan $rank"
done
(ulimit -f 2000; timeout 60 "$TARTAN" draw "$scratch/thin.plan" --sample 3 -o "$scratch/thin.svg") || fail 'no picture of narrow plans'
(ulimit -f 2000; timeout 60 "$TARTAN" draw "$scratch/thin.plan" --rule thin -o "$scratch/thin.svg") || fail 'no picture of a rule about a narrow tray'
cat >"$scratch/vast.plan" <<'PLAN'
schema strip {
  width role length = 3000m | 3m
  zone room role band = hall(2000m) role void
}
form vast of strip {
  storey ground 3m
  storey upper 3m
  wall 200mm
  partition 100mm
  floor 300mm
  roof 200mm
  option room storeys = 2
  option room roof = flat
  function sit at cell(room)
  face cell(any) under cell(any) = stair
  face cell(any) outside = wall
}
library strips using strip { trays 1 }
library halls from strips in vast { }
PLAN
golden vast "tartan house $scratch/vast.plan '#0' --library halls --view plan:ground --scale 1 -o $scratch/vast.svg"
(ulimit -f 20000; timeout 100 "$TARTAN" house "$scratch/vast.plan" '#0' --library halls --view plan:ground -o "$scratch/vast.dxf" -o "$scratch/vast.svg") || fail 'no drawings of a vast house'
finish
