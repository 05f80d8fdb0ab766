#!/usr/bin/env bash
# Needs the parts: draw
# An SVG shows what the PNG of the same picture does, which cairo draws: by their pixels, the SVG drawn by librsvg.
name=pictures_alike
. "$(dirname "$0")/golden.bash"
distance=$(dirname "$TARTAN")/tests/picture_distance
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
    rsvg-convert -d 150 -p 150 "$scratch/$picture.svg" -o "$scratch/$picture.rsvg.png" || fail "$picture.svg is not read"
    "$distance" "$scratch/$picture.rsvg.png" "$scratch/$picture.png" "$scratch/$picture.difference.png" >"$scratch/apart" ||
        fail "$picture cannot be compared"
    awk -v mean="$mean" -v largest="$largest" '$1 > mean || $2 > largest { exit 1 }' "$scratch/apart" ||
        fail "$picture: SVG and PNG are $(cat "$scratch/apart") apart, and may be $mean $largest"
}

plan=$("$TARTAN" sample lahave-houses 1 --seed 3)
ward=examples/hospital-ward/ward.plan
alike sheet 3 4 draw lahave-houses --sample 6 --seed 7 -o
alike table 3 4 draw "$files/sheds.plan" --library sheds --sample 5 --seed 1 -o
alike rule 8 5 draw lahave --rule stranded --rule thin-totem -o
alike explanation 7 5 explain lahave-houses "$plan" --full -o
alike dropped 9 5 explain "$files/cabins.plan" "14' room:14' none | 14' room:14' none ; 1 gable(9:12) 1 flat ; bedroom | bedroom ; wall wall wall wall wall wall" -o
alike house 3 4 house "$files/cabins.plan" '#10:77' -o
alike histogram 4 4 count "$ward" -l short-strip --by capacity -o
alike front 6 8 pareto "$ward" -l short-strip --most capacity --least floor -o
alike open 8 5 complete "$ward" '3000mm beds | ? | station | ... | not store' -l short-strip --least floor -o
alike derivation 4 4 map genr8 --genome '1 2 3 4 5 6 7 8 9 10 11 12' --tree
alike surface 2 2 grow square -n 3 -o
alike surroundings 4 3 grow square -n 2 --boundary 'sphere at 0 0 -1 radius 1' --attractor 'at 2 0 1 strength 0.2' --gravity '0 0 -0.1' -o
alike boxes 3 4 draw table --sheet -o
finish
