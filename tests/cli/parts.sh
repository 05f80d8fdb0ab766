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

# Pictures as SVG need no part: the same bytes with and without any.
for picture in sheet house surface tree histogram; do
    case $picture in
    sheet) words=(draw lahave-houses --sample 2 --seed 7) ;;
    house) words=(house "$(dirname "$0")/files/cabins.plan" "14' room:14' none ; 1 gable(9:12) 1 flat ; living ; window wall window") ;;
    surface) words=(grow square -n 1) ;;
    tree) words=(map words --genome '1 2 3' --tree) ;;
    histogram) words=(count examples/hospital-ward/ward.plan -l short-strip --by capacity) ;;
    esac
    [ "$picture" = tree ] && output=("$scratch/$picture.svg") || output=(-o "$scratch/$picture.svg")
    "$TARTAN" "${words[@]}" "${output[@]}" >/dev/null
    grep -q '<text' "$scratch/$picture.svg" || { echo "no lettering in $picture.svg"; exit 1; }
    part draw "${words[@]}" "${output[@]/%.svg/.png}"
    part draw "${words[@]}" "${output[@]/%.svg/.pdf}"
done
part mesh grow square -n 1 -o "$scratch/surface.stl"
part mesh grow square -n 1 --smooth 2 -o "$scratch/smooth.obj"
printf 'schema s { use = a | b }\nlibrary rows using s { trays 3 require quantity(tray(a)) = 2 }\n' >"$scratch/rows.plan"
if grep -q '^TARTAN_WITH_SEARCH:BOOL=ON' "$cache"; then
    [ "$("$TARTAN" enumerate "$scratch/rows.plan" --max-states 1 2>/dev/null | wc -l)" = 3 ] || { echo 'search finds other plans'; exit 1; }
else
    status=0
    "$TARTAN" enumerate "$scratch/rows.plan" --max-states 1 >/dev/null 2>"$scratch/said" || status=$?
    [ "$status" = 4 ] && grep -q 'error\[E0802\]' "$scratch/said" && grep -q 'libcadical-dev' "$scratch/said" ||
        { echo "without search, a limit of states says: $(cat "$scratch/said")"; exit 1; }
fi
part store sample lahave-houses 3 --seed 7 -o "$scratch/sample.sqlite"
printf "grammar \"words\"\nproblem word \"tartan\"\npopulation 4\ngenerations 1\n" >"$scratch/word.study"
part store evolve examples/breeding-surfaces/breed.study -o "$scratch/run" --generations 0

# The command alone, without the libraries that it loads parts from: it does what needs none, and says what it cannot load. A build that links
# the parts has nothing to load, and where Tartan is installed the system finds them.
if grep -q '^TARTAN_LOAD_PARTS:BOOL=ON' "$cache" && grep -q '^TARTAN_WITH_DRAW:BOOL=ON' "$cache" && ! ldconfig -p | grep -q libtartan-draw; then
    if readelf -d "$TARTAN" | grep NEEDED | grep -E 'cairo|sqlite|OpenMesh|stdc'; then
        echo 'the command needs these at each start'
        exit 1
    fi
    mkdir "$scratch/alone"
    cp "$TARTAN" "$scratch/alone/tartan"
    alone() { env -u LD_LIBRARY_PATH TARTAN_PATH="${TARTAN_PATH:-stdlib}" "$scratch/alone/tartan" "$@"; }
    alone draw lahave-houses --sample 1 --seed 7 -o "$scratch/alone.svg" >/dev/null
    status=0
    alone draw lahave-houses --sample 1 --seed 7 -o "$scratch/alone.png" >/dev/null 2>"$scratch/said" || status=$?
    [ "$status" = 2 ] && grep -q 'error\[E0907\].*cannot be loaded.*libtartan-draw' "$scratch/said" && grep -q 'libcairo2' "$scratch/said" ||
        { echo "a part that cannot be loaded: status $status, $(cat "$scratch/said")"; exit 1; }
    [ ! -e "$scratch/alone.png" ] || { echo 'a picture that could not be drawn is there'; exit 1; }
fi
