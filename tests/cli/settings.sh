#!/usr/bin/env bash
# settings: the params of rules about plans and the numbers of other notations, with their places.
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
golden none "cd $scratch
\$TARTAN settings
\$TARTAN settings none.plan
\$TARTAN build lot.plan -o lot.tnb && \$TARTAN settings lot.tnb
printf 'library l {' >broken.plan; \$TARTAN settings broken.plan"
finish
