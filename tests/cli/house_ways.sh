#!/usr/bin/env bash
# Ways through houses: each rule by two houses that differ by a millimetre; what is said of cells that do not fit.
# Slow under sanitizers.
name=house_ways
. "$(dirname "$0")/golden.bash"
tests=$(cd "$here/.." && pwd)
cd "$scratch"

python3 -B "$tests/house_way_rules.py" "$TARTAN" || fail 'a rule about ways'

# A bedroom beside the hole of a stair: its door must be near the front, where the flight begins.
cat >stair.plan <<'PLAN'
schema row { width role length = 2.4m | 3m  zone house role band = space(4.2m) }
form houses of row {
  storey ground 2.7m
  storey upper 2.7m
  wall 280mm
  partition 110mm
  floor 260mm
  roof 200mm
  function bedroom at cell(3m)
  function stair at cell(2.4m)
  opening door wide 900mm high 2m passage sliding near front 140mm
  flight dogleg wide 850mm rise 150mm..200mm going 220mm turn half
  face cell(stair) under cell(stair) = dogleg
  face cell(any) beside cell(any) = door
  face cell(any) outside = wall
  way 800mm
  allow W212
}
library rows using row { trays 3 }
library all from rows in houses { require cell(stair, ground) }
PLAN
sed 's/ near front 140mm//' stair.plan >middle.plan
house='3m space:4.2m | 2.4m space:4.2m | 3m space:4.2m ; - ; bedroom bedroom | stair stair | bedroom bedroom'
is 'a stair with doors beside it is a house' "$("$TARTAN" count stair.plan --library all --plan "${house%%;*}" 2>/dev/null | awk '/^houses/ {print $2}')" 1
"$TARTAN" house stair.plan "$house" -o house.json >/dev/null 2>&1
is 'where it stands' "$(python3 -c 'import json; print(*[f["foot"] + f["head"] for f in json.load(open("house.json"))["faces"] if "foot" in f])')" \
    '[4495000000, 5345000000, 3210000000, 4060000000, 3645000000, 4495000000, 3210000000, 4060000000]'
golden no_place "tartan house $scratch/middle.plan '$house'"
golden explained "tartan explain $scratch/middle.plan '$house' --library all"
"$TARTAN" explain middle.plan "$house" --library all -o why.svg >/dev/null 2>&1
is 'the flight where it comes nearest to a place, the person, and the door that is not reached' \
    "$(for colour in 737373 1a40a6 c7332b; do grep -c "fill=\"#$colour\"" why.svg; done | tr '\n' ' ')" '3 1 1 '
sed -e 's/ turn half//; s/2.4m | 3m/3m/; s/function stair at cell(2.4m)/function stair at cell(any)/' middle.plan >straight.plan
golden no_landing "tartan explain $scratch/straight.plan '3m space:4.2m | 3m space:4.2m | 3m space:4.2m ; - ; bedroom bedroom | stair stair | bedroom bedroom' --library all"
# Plans: a cell in which nobody could go about, whatever is in its walls; no place for a flight, though each cell could be in a house.
golden plan_cut "tartan explain cut-off.plan '3m space:4m | 0.9m space:4m' --library cabins"
golden plan_no_place "tartan explain no-place.plan '2.4m space:4.2m | 3.6m space:4.2m' --library cabins"
golden plan_no_place_house "tartan explain no-place.plan '2.4m space:4.2m | 3.6m space:4.2m ; - ; hall landing | living bedroom ; window window door window window window window window window window window window' --library cabins"
finish
