#!/usr/bin/env bash
# What a build lacks is said: the part, and how to get it. Where the part is there, the same commands do their work.
set -euo pipefail
: "${TARTAN:?the binary to test}"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cache=$(dirname "$TARTAN")/CMakeCache.txt

# part NAME COMMAND...: done with the part, refused without it.
part() {
    local name=$1 status=0
    shift
    "$TARTAN" "$@" >/dev/null 2>"$scratch/said" || status=$?
    if grep -q "^TARTAN_WITH_${name^^}:BOOL=ON" "$cache"; then
        [ "$status" = 0 ] || { echo "with $name, tartan $* failed: $(cat "$scratch/said")"; exit 1; }
    else
        [ "$status" = 2 ] || { echo "without $name, tartan $* ended with status $status"; exit 1; }
        grep -q 'error\[E0907\]' "$scratch/said" && grep -q "TARTAN_WITH_${name^^}=ON" "$scratch/said" ||
            { echo "without $name, tartan $* says: $(cat "$scratch/said")"; exit 1; }
    fi
}

part draw draw lahave-houses --sample 2 --seed 7 -o "$scratch/sheet.svg"
part draw house cottage "14' room:14' none ; 1 gable(9:12) 1 flat ; living ; window wall window" -o "$scratch/house.svg"
part draw grow square -n 1 -o "$scratch/surface.png"
part mesh grow square -n 1 -o "$scratch/surface.stl"
part mesh grow square -n 1 --smooth 2 -o "$scratch/smooth.obj"
part store sample lahave-houses 3 --seed 7 -o "$scratch/sample.sqlite"
printf "grammar \"words\"\nproblem word \"tartan\"\npopulation 4\ngenerations 1\n" >"$scratch/word.study"
part store evolve examples/breeding-surfaces/breed.study -o "$scratch/run" --generations 0
