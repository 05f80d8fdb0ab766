#!/usr/bin/env bash
# rule: a rule as a tree of its parts, its picture, and edits of it.
name=rule
. "$(dirname "$0")/golden.bash"
cd "$scratch"

cat >rows.plan <<'PLAN'
schema row { width role length = 3m | 4m  use = shop | home | stair  light = flag  zone back role band = yard(2m, 3m) role void | none role absent }
param reach = 2 in 0..9

rule narrow = tray(3m)  # the least
rule beside(a, b) = neighbour(a, b) or neighbour(b, a)
rule ends = neighbour(beginning, tray(shop), ..., end)
rule mixed "all kinds"   =  not (narrow  or tray( use home,not light ))  and quantity( tray(back yard 2m), n in 1..3) # of yards
rule more =
  some u in use(beside(tray(u), tray(stair))) or
  tray(shop) within reach of tray(stair) or
  sum(width) > 12m
rule spread =
  distance(from tray(stair),
           to   tray(stair),  # the next one
           by   quantity(tray(home), n >= 2))
PLAN
cp rows.plan kept.plan

edited() { # what becomes of a rule
  "$TARTAN" rule rows.plan "$@" >out.plan && diff rows.plan out.plan | grep '^[<>]'
  echo
}
export -f edited

golden trees "cd $scratch
for rule in narrow beside ends mixed more spread; do \$TARTAN rule rows.plan \$rule; done
\$TARTAN rule rows.plan narrow --json
\$TARTAN rule rows.plan ends -o ends.svg && grep -o 'data-[a-z]*=\"[0-9]*\"' ends.svg | sort | uniq -c"
golden edits "cd $scratch
edited narrow --edit step --part 0 --field width
edited narrow --edit step --part 0 --field light
edited narrow --edit step --part 0 --field back
edited mixed --edit step --part 6 --field back --depth
edited narrow --edit set --item 0 --text 'shop or home'
edited mixed --edit clear --part 4 --item 0
edited narrow --edit clear
edited narrow --edit add --text 'not stair'
edited narrow --edit wrap --by symmetric
edited mixed --edit wrap --part 2 --by quantity
edited mixed --edit unwrap --part 1
edited spread --edit unwrap --at 1
edited narrow --edit join --by or --text ends
edited mixed --edit join --part 3 --by or --text any --before
edited mixed --edit join --part 5 --by or --from 3
edited ends --edit insert --text 'tray(home)'
edited spread --edit insert --at 1 --text 'tray(home) and any'
edited ends --edit move --from 2 --at 3
edited ends --edit remove --part 4
edited spread --edit remove
edited mixed --edit condition --part 5 --text 'n > 1'
edited more --edit text --part 5 --text 'trays > 3'
edited lone --edit new --at 400"
golden ends "cd $scratch
printf 'schema s { w = a | b }\\rrule r = tray(a) # é\\rrule q = (r) and tray(b)\\r' >returns.plan
\$TARTAN rule returns.plan q --edit wrap --part 2 --by not | tr '\\r' '\\n'
\$TARTAN rule returns.plan q --edit wrap --part 2 --by not --json
printf '\\xef\\xbb\\xbfschema s { w = a | b }\\r\\nrule r = tray(a)\\r\\n' >marked.plan
\$TARTAN rule marked.plan r --edit wrap --by not | od -An -c | tail -3"
golden none "cd $scratch
edited narow
edited narrow --edit wrap
edited narrow --edit wrap --by box
edited narrow --edit wrap --part 7 --by not
edited narrow --edit wrap --by not --text x
edited narrow --edit step
edited narrow --edit step --field lihgt
edited narrow --edit step --field back --depth
edited mixed --edit step --part 1 --field use
edited more --edit step --part 4 --field use
edited narrow --edit set --item 3 --text shop
edited narrow --edit set --item 0 --text 'shop) or any'
edited narrow --edit set --item 0 --text 'shopp'
edited ends --edit wrap --part 1 --by not
edited ends --edit join --part 0 --by and --text end
edited narrow --edit unwrap
edited narrow --edit insert --text any
edited mixed --edit move --part 2 --from 1
edited mixed --edit condition --text 'n > 1'
edited mixed --edit condition --part 5 --text 'n > 1) and (any'
edited ends --edit new
edited 'a b' --edit new
edited narrow --part 3
edited narrow --edit remove -o x.svg
\$TARTAN rule primitives torus
\$TARTAN rule rows.plan
printf 'rule r = ' >broken.plan; \$TARTAN rule broken.plan r
cmp rows.plan kept.plan"
finish
