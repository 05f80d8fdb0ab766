#!/usr/bin/env bash
# Slopes: their cells against a list made independently, closed meshes of the right volume, and steps where there is no room for a slope.
name=kit_slopes
source "$(dirname "$0")/golden.bash"
cat >"$scratch/roof.kit" <<'K'
use "bricks";
rule roof at stud = 3039 | 3040b;
model roof { inside box(8 studs, 1 brick, 3 studs); start stud at (0, 0, 0.5 studs) by roof; start stud at (2 studs, 0, 0.5 studs) by roof; }
K
golden roof "tartan place $scratch/roof.kit -o $scratch/roof.svg && grep -c '<path' $scratch/roof.svg"
golden layout "printf '%s' 'part a{slope up   front 20 x 24 x 20 at(0,0,0);}' >$scratch/layout.kit && tartan fmt $scratch/layout.kit && cat $scratch/layout.kit"
python3 "$here/kit_slopes.py" "$TARTAN" "$scratch" || fail 'slopes are wrong'
exit $((failures > 0))
