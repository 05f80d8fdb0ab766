#!/usr/bin/env bash
# Kits whose parts have all 24 turns: a world that is turned or moved gives the result turned or moved, and wrong turns are said.
# Slow under sanitizers.
name=kit_turns
source "$(dirname "$0")/golden.bash"
python3 "$here/kit_turns.py" "$TARTAN" "$scratch" || fail 'a world that is turned gives something else'
cat >"$scratch/one.kit" <<'K'
unit 10 x 10 x 10 turns 24;
connector plug joins hole turns 4;
connector hole joins plug turns 4;
part elbow "elbow" { fill 20 x 20 x 20; plug up; hole left at (-10, -10, 0); mass 1; }
rule any at plug, hole = elbow;
model one { inside box(100, 60, 100); start plug up at (0, 0, 0) turn 1 by any; require overlaps = 0, components = 1; }
model searched { inside box(80, 80, 80); start plug up at (0, 0, 0) by any; maximize elements; search beam 5; }
K
golden placed "tartan place $scratch/one.kit --model one -o $scratch/one.ldr && tartan inspect $scratch/one.ldr --kit $scratch/one.kit"
golden searched "tartan place $scratch/one.kit --model searched --stats"
golden counted "tartan count $scratch/one.kit --parts 2 --json && tartan count $scratch/one.kit --parts 3 --json"
golden export "tartan export $scratch/one.kit --pcfg --model one"
# Parts that all lie on their side are not said to be missing.
printf '1 4 0 0 0 0 1 0 0 0 1 1 0 0 elbow.dat\n' >"$scratch/lies.ldr"
golden lies "tartan export $scratch/lies.ldr --kit $scratch/one.kit"
golden api "tartan place $scratch/one.kit --model one -o - | grep '^1' | cut -d' ' -f6- | sort | uniq -c"
exit $((failures > 0))
