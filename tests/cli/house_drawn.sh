#!/usr/bin/env bash
# Sheets of houses are drawn as offices draw: widths of lines, lettering, tags, numbers and areas (tests/house_drawn.py).
name=house_drawn
. "$(dirname "$0")/golden.bash"
tests=$(cd "$here/.." && pwd)

for house in '#2:18693' '#2:5' '#2:9001'; do
    "$TARTAN" house row-houses "$house" -o "$scratch/house.svg" -o "$scratch/house.json" 2>"$scratch/said" || fail "no house $house: $(cat "$scratch/said")"
    is "house $house" "$(python3 -B "$tests/house_drawn.py" "$scratch/house.svg" "$scratch/house.json" && echo fine)" fine
done
finish
