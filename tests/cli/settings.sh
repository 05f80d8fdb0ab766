#!/usr/bin/env bash
# settings: the params of rules about plans and the numbers of other notations, with their places and ranges.
name=settings
. "$(dirname "$0")/golden.bash"
cd "$scratch"

cat >shared.plan <<'PLAN'
schema row { width = 3m | 4m use = shop | home }
param depth "of a lot" = 12m in 9m..20m
PLAN
cat >lot.plan <<'PLAN'
use "shared.plan"
param side "where the yard is" = left | right | both # ü
param few = 3
library rows { trays 1..4 require quantity(tray(shop)) <= few  require side = left implies sum(width) <= depth }
PLAN
cat >curve.field <<'FIELD'
let r = 2.5
surface hill = -1.5 * pow(x, 2) + 2e-1*y - r
FIELD
cat >eight.field <<'FIELD'
grid 64
surface ball = x*x + y*y + z*z - 1
FIELD
cat >bred.study <<'STUDY'
evolution {
  grammar "words"
  match "hello"
  seed 7
  population 500
  depth 2..8
  selection tournament 3
  tail 0.25
}
STUDY
cat >grown.study <<'STUDY'
rules "square"
steps 4
scale 1.5
seed 7
branch-angle 45
branch-length 3
edge-limit 100
fitness undulation target -2 weight 2
STUDY
cat >wall.kit <<'KIT'
use "bricks";
space room = box(4 studs, 2 bricks, 2 studs);
part block { fill 1 stud x 1 brick x 1 stud; studs up 1 x 1; mass 2.5; }
rule wall at stud, tube = 3010 | (3004 in 71 [0.8] | 3004 in 72 [0.2]) | block in 4;
model tower { inside room; start stud at (0.5 studs, 0, 0.5 studs) by wall; search beam 50; stock 3010 <= 20; }
KIT
cat >two.study <<'STUDY'
rules "square"
steps 4
attractor at 1 -2.5 3 strength 2
STUDY

golden plan "cd $scratch
\$TARTAN settings lot.plan
\$TARTAN settings lot.plan --used
\$TARTAN settings lot.plan --set few=5
\$TARTAN settings lot.plan --json"
golden numbers "cd $scratch
\$TARTAN settings curve.field
\$TARTAN settings two.study
\$TARTAN settings two.study --json | head -20"
golden ranges "cd $scratch
\$TARTAN settings eight.field
\$TARTAN settings bred.study
\$TARTAN settings grown.study
\$TARTAN settings wall.kit
\$TARTAN settings grown.study --json"
golden none "cd $scratch
\$TARTAN settings
\$TARTAN settings none.plan
\$TARTAN build lot.plan -o lot.tnb && \$TARTAN settings lot.tnb
printf 'library l {' >broken.plan; \$TARTAN settings broken.plan"
finish
