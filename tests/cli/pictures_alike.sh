#!/usr/bin/env bash
# Needs the parts: draw
# An SVG shows what the PNG of the same picture does, which cairo draws: by their pixels, the SVG drawn by librsvg, and by Chromium where it
# is installed.
name=pictures_alike
. "$(dirname "$0")/golden.bash"
distance=$(dirname "$TARTAN")/tests/picture_distance
meanings=$(dirname "$TARTAN")/tests/drawn_meanings
chromium=$(command -v chromium || true)
command -v rsvg-convert >/dev/null || { echo 'there is no rsvg-convert (librsvg2-bin)'; exit 77; }
[ -x "$distance" ] || { echo 'there is no picture_distance'; exit 77; }

# alike NAME MEAN LARGEST COMMAND...: draws to NAME.svg and NAME.png. MEAN: the root of the mean square of what they differ by, at most;
# LARGEST: the most that a block of 24 by 24 pixels may be darker or lighter; both of 100. Lettering is most of that: librsvg fits it to
# pixels, and moves letters closer where their shapes allow it.
alike() {
    local picture=$1 mean=$2 largest=$3
    shift 3
    for kind in svg png; do
        "$TARTAN" "$@" "$scratch/$picture.$kind" >"$scratch/out" 2>&1 || fail "$picture.$kind is not drawn: $(cat "$scratch/out")"
    done
    by_rsvg "$picture" "$mean" "$largest"
}

# compared PICTURE READER MEAN LARGEST: what READER has made of the SVG, with the PNG.
compared() {
    "$distance" "$scratch/$1.$2.png" "$scratch/$1.png" "$scratch/$1.difference.png" >"$scratch/apart" || fail "$1 cannot be compared"
    awk -v mean="$3" -v largest="$4" '$1 > mean || $2 > largest { exit 1 }' "$scratch/apart" ||
        fail "$1: SVG by $2 and PNG are $(cat "$scratch/apart") apart, and may be $3 $4"
}

by_rsvg() {
    rsvg-convert -d 150 -p 150 "$scratch/$1.svg" -o "$scratch/$1.rsvg.png" || fail "$1.svg is not read"
    compared "$1" rsvg "$2" "$3"
}

# A page that is as large as the PNG, with the picture at 150 dots to an inch.
by_chromium() {
    [ -n "$chromium" ] || return 0
    local wide high
    read -r wide high < <(od -An -j16 -N8 -tu1 "$scratch/$1.png" | awk '{ print $3 * 256 + $4, $7 * 256 + $8 }')
    printf '<body style="margin:0"><img src="%s.svg" style="width:%spx;display:block">' "$1" \
        "$(sed -n 's/.*<svg [^>]*width="\([0-9.]*\)pt".*/\1/p' "$scratch/$1.svg" | awk '{ print $1 * 150 / 72 }')" >"$scratch/$1.html"
    (cd "$scratch" && HOME=$scratch timeout 120 "$chromium" --headless --no-sandbox --disable-gpu --hide-scrollbars \
        --force-device-scale-factor=1 --window-size="$wide,$high" --screenshot="$scratch/$1.chromium.png" "file://$scratch/$1.html" >"$scratch/out" 2>&1)
    [ -s "$scratch/$1.chromium.png" ] || { fail "chromium shows nothing of $1: $(cat "$scratch/out")"; return; }
    compared "$1" chromium "$2" "$3"
}

plan=$("$TARTAN" sample lahave-houses 1 --seed 3)
ward=examples/hospital-ward/ward.plan
alike sheet 3 4 draw lahave-houses --sample 6 --seed 7 -o
alike table 3 4 draw "$files/sheds.plan" --library sheds --sample 5 --seed 1 -o
alike rule 8 5 draw lahave --rule stranded --rule thin-totem -o
alike explanation 7 5 explain lahave-houses "$plan" --full -o
alike dropped 9 5 explain "$files/cabins.plan" "14' room:14' none | 14' room:14' none ; 1 gable(9:12) 1 flat ; bedroom | bedroom ; wall wall wall wall wall wall" -o
alike house 4 6 house "$files/cabins.plan" '#10:77' -o
alike histogram 4 4 count "$ward" -l short-strip --by capacity -o
alike front 6 8 pareto "$ward" -l short-strip --most capacity --least floor -o
alike open 8 5 complete "$ward" '3000mm beds | ? | station | ... | not store' -l short-strip --least floor -o
alike derivation 4 4 map genr8 --genome '1 2 3 4 5 6 7 8 9 10 11 12' --tree
alike surface 2 2 grow square -n 3 -o
alike surroundings 4 3 grow square -n 2 --boundary 'sphere at 0 0 -1 radius 1' --attractor 'at 2 0 1 strength 0.2' --gravity '0 0 -0.1' -o
alike boxes 3 4 draw table --sheet -o
by_chromium house 4 6
by_chromium sheet 4 6

# Symbols that are turned and mirrored, all hatches, dimensions.
for kind in svg png; do
    "$meanings" "$scratch/meanings.$kind" || fail "meanings.$kind is not drawn"
done
grep -q '<use href=.*scale(-1 1)' "$scratch/meanings.svg" || fail 'no symbol is used mirrored'
grep -q 'fill="url(#h0)"' "$scratch/meanings.svg" || fail 'no pattern is used'
by_rsvg meanings 9 4
by_chromium meanings 7 10
finish
