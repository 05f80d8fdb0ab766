#!/usr/bin/env bash
# The steps in which models are built: the order of the parts, checked by a program that shares nothing with the engine (kit_steps.py), sub-files,
# sheets, and what is said about wrong ones.
name=kit_steps
source "$(dirname "$0")/golden.bash"
cat >"$scratch/arch.kit" <<'X'
use "bricks";
rule any at stud, tube = 3007 | 3001 | 3003 | 3004 | 3005;
model arch {
  inside box(8 studs, 2 bricks, 2 studs) at (0, 3 bricks, 0) or box(2 studs, 3 bricks, 2 studs) at (-3 studs, 0, 0)
    or box(2 studs, 1 brick, 1 stud) turn 1 repeat 2 by (1 stud, 0, 0) at (2.5 studs, 2 bricks, 0);
  start stud at (-50, 0, 10) by any; order breadth; steps layer;
}
X
cat >"$scratch/floating.kit" <<'X'
use "bricks";
rule any at stud, tube = 3003 | 3005;
model two { inside box(2 studs, 2 bricks, 2 studs) or box(2 studs, 2 bricks, 2 studs) at (5 studs, 2 bricks, 0);
  start stud at (10, 0, 10) by any; start stud at (110, 2 bricks, 10) by any; steps part; }
X
cat >"$scratch/high.kit" <<'X'
use "bricks";
rule plate at stud = 3024;
model high { inside box(1 stud, 201 plates, 1 stud); start stud at (0, 0, 0) by plate; }
X
python3 "$here/kit_steps.py" "$TARTAN" "$here/../../stdlib/bricks.kit" "$scratch/arch.kit" "$scratch/floating.kit" "$here/../fuzz/corpus/kit/tower.kit" ||
    fail 'the order of building is wrong'
golden warned "tartan place $scratch/arch.kit -o $scratch/arch.ldr"
golden floating "tartan place $scratch/floating.kit -o - | sed 's/rules.*//'"
golden subfiles "tartan place $scratch/floating.kit --steps 4 -o $scratch/two.mpd && sed 's/rules.*//' $scratch/two.mpd"
golden wrong_steps "tartan place $scratch/arch.kit --steps 0"
golden no_picture "tartan place $scratch/arch.kit --sheet -o $scratch/arch.ldr"
golden of_pcfg "tartan place ../../../examples/brick-wall/wall.pcfg ../../../examples/brick-wall/bricks.pcfg --steps layer -o $scratch/wall.ldr"
golden sheet_too_long "tartan place $scratch/high.kit --steps part --sheet -o $scratch/high.svg"
"$TARTAN" place "$scratch/floating.kit" --sheet -o "$scratch/two.svg" || fail 'no sheet'
[ "$(grep -c '<path' "$scratch/two.svg")" -gt 20 ] || fail 'the sheet is empty'
exit $((failures > 0))
