#!/usr/bin/env bash
# Counting buildings of a kit's parts: known numbers, what is said about wrong questions, and a brute force (kit_count.py).
# Slow under sanitizers.
name=kit_count
source "$(dirname "$0")/golden.bash"
printf 'use "bricks";\nlength far = 20000;\npart long { fill 1 far x 1 brick x 1 stud; stud up; tube down at (1 far, -1 brick, 0); }\n' >"$scratch/long.kit"
printf 'unit 10 x 8 x 10;\nconnector peg joins peg;\n' >"$scratch/no_parts.kit"
printf 'unit 10 x 8 x 10;\nconnector peg joins hole;\nconnector hole joins peg;\npart a { fill 20 x 8 x 20; peg up; }\npart b { fill 20 x 8 x 20; hole down at (0, -8, 0); }\n' >"$scratch/two.kit"

# 2 x 4 bricks: OEIS A112389 (B. Durhuus and S. Eilers). The sixth is in known_buildings_long.sh.
number=0
for known in 1 24 1560 119580 10166403; do
    number=$((number + 1))
    is "$number bricks" "$("$TARTAN" count bricks --part 3001 --parts $number)" "$known"
done
number=0
for known in 2 92 6152 477950 40659060; do
    number=$((number + 1))
    is "$number bricks, fixed" "$("$TARTAN" count bricks --part 3001 --parts $number --fixed --threads 3)" "$known"
done
golden pairs "tartan count $scratch/two.kit --parts 1; tartan count $scratch/two.kit --parts 2 --json; tartan count $scratch/two.kit --parts 3"
golden no_number "tartan count bricks"
golden no_part "tartan count bricks --parts 3 --part 3006"
golden no_parts "tartan count $scratch/no_parts.kit --parts 2"
golden too_many "tartan count bricks --parts 33"
golden table "tartan count $scratch/long.kit --part long --parts 9"
golden plan "tartan count lahave --parts 3"
golden of_plans "tartan count bricks --parts 2 --trays 1..2"
golden file "tartan count bricks --part 3005 --parts 3 -o $scratch/number && cat $scratch/number"

python3 "$here/kit_count.py" "$TARTAN" "$here/../../stdlib/bricks.kit" || fail 'a number is not what listing all buildings gives'
printf 'use "bricks";\nrule any at stud, tube = 3004 | 3005;\nmodel room { inside box(3 studs, 2 bricks, 2 studs); start stud at (0, 0, 10) by any; }\n' >"$scratch/room.kit"
golden inside "tartan count $scratch/room.kit --parts 2 --inside room --part 3004 --part 3005; tartan count $scratch/room.kit --parts 2 --inside room --part 3003"
golden inside_of_none "tartan count $scratch/room.kit --parts 2 --inside rom"
golden inside_fixed "tartan count $scratch/room.kit --parts 2 --inside room --fixed"
golden inside_of_plans "tartan count ../../../examples/narrow-lot/narrow.plan --inside room"

# Listing what is counted; the brute force above compares the lists.
golden listed "tartan enumerate bricks --part 3001 --parts 2 --limit 3; tartan enumerate bricks --part 3001 --parts 2 --from 22 --format json; tartan enumerate $scratch/two.kit --parts 2"
golden listed_subfiles "tartan enumerate bricks --part 3003 --parts 2 --from 1 --to 2 -o $scratch/two.mpd && cat $scratch/two.mpd && tartan inspect $scratch/two.mpd --kit bricks --require 'components = 1, overlaps = 0'"
golden listed_past "tartan enumerate bricks --part 3001 --parts 2 --from 30; tartan enumerate bricks --part 3001 --parts 2 --from 3 --to 2"
golden listed_no_number "tartan enumerate bricks"
golden listed_as_csv "tartan enumerate bricks --parts 2 --format csv"
golden listed_mirror "tartan enumerate bricks --parts 2 --mirror"
golden listed_of_plans "tartan enumerate sheds.plan --parts 2"
golden listed_inside "tartan enumerate $scratch/room.kit --parts 1 --inside room --part 3004; tartan enumerate $scratch/room.kit --parts 1 --inside room --fixed"
all() { "$TARTAN" enumerate bricks --part 3001 --parts 4 "$@"; }
all >"$scratch/all"
is 'listed' "$(sort -u "$scratch/all" | wc -l)" 119580
{ all --to 50000 && all --from 50000; } | cmp - "$scratch/all" || fail 'two halves are not the whole list'
all | head -n 2 >"$scratch/begin" || true
head -n 2 "$scratch/all" | cmp - "$scratch/begin" || fail 'a list that is read in part begins otherwise'
for seconds in 3 10 30; do # a busy machine takes longer until there is something to write
    code=0
    timeout -s INT $seconds "$TARTAN" enumerate bricks --part 3001 --parts 8 -o "$scratch/part.txt" 2>"$scratch/err" || code=$?
    ! grep -q 'goes on after them' "$scratch/err" || break
done
is 'interrupted' "$code" 124
grep -q 'goes on after them' "$scratch/err" && [ -s "$scratch/part.txt" ] || fail 'an interrupted list says nothing of its end'
exit $((failures > 0))
