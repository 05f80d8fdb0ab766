#!/usr/bin/env bash
# Fields bred from parents: the same bytes for any number of threads and after an interruption, weights and ids, results that can be
# meshed and bred again as the same trees, changed inputs.
# Slow under sanitizers.
# Needs the parts: draw mesh store
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
failed=0
fail() { echo "breed_fields: $*" >&2; failed=1; }

cat > ring.field <<'END'
let radius = 3
fn round(x, y, z, r) = sqrt(x*x + y*y + z*z) - r
surface ball "a ball" = round(x, y, z, radius)
surface pair = min(ball at (x - 2, y, z), ball at (x + 2, -y, z), 9)
box (-8, -6, -6)..(8, 6, 6)
END
cat > rings.study <<'END'
evolution {
  parent "ring.field"
  parent "ring.field:ball"
  parent "torus" weight 0.4
  population 12
  generations 6
  grid 16
  mutation-rate 0.5
  nudge 4
  fitness volume target 100
  fitness "area / volume" target 2 weight 3
  likeness "ball.obj"
}
END
"$TARTAN" mesh ring.field --surface ball --grid 30 -o ball.obj 2> /dev/null || fail "cannot mesh the target"

# ---- evolution: threads, interruption, replay
"$TARTAN" evolve rings.study -o one --threads 1 > /dev/null 2>&1 || fail "cannot evolve"
"$TARTAN" evolve rings.study -o four --threads 4 > /dev/null 2>&1
cmp -s one/run.sqlite four/run.sqlite || fail "threads change a run"
diff -r one/best four/best > /dev/null || fail "threads or folders change the results"
"$TARTAN" evolve rings.study -o two -g 2 > /dev/null 2>&1
"$TARTAN" evolve rings.study -o two --resume > /dev/null 2>&1 || fail "cannot resume"
cmp -s one/run.sqlite two/run.sqlite || fail "a resumed run differs"
grep -q '^1.field,' one/best/scores.csv || fail "no scores"
for id in 0 1 2 13 60; do
    "$TARTAN" runs replay one $id > "r$id.field" || fail "cannot replay $id"
    "$TARTAN" check "r$id.field" > /dev/null 2>&1 || fail "individual $id does not compile"
done
grep -q 'let radius = 3' r0.field || fail "a named constant is lost"
"$TARTAN" fmt --check one/best/*.field || fail "results are not laid out"
"$TARTAN" mesh one/best/1.field -o best.obj 2> /dev/null && [ -s best.obj ] || fail "the best cannot be meshed"

# ---- what is written reads back as the same tree
for id in 0 1 2 13 60; do
    printf 'evolution { parent "r%s.field"; population 2; fitness volume target 3; grid 5 }\n' $id > again.study
    rm -rf again
    "$TARTAN" evolve again.study -g 0 -o again > /dev/null 2>&1 || fail "cannot breed from individual $id"
    "$TARTAN" runs replay again 0 | grep '^# genome' > again.txt
    grep '^# genome' "r$id.field" | cmp -s - again.txt || fail "individual $id reads back as another tree"
done

# ---- by hand: weights, ids, parents that stay
sed '/fitness\|likeness/d' rings.study > hand.study
printf '1 3@0.4\n#1 2*2\n\n' | "$TARTAN" breed hand.study -o hand > hand.txt 2>&1 || fail "cannot breed by hand"
[ -s hand/sheet-0002.png ] || fail "no sheet of the third generation"
printf '1 3@0.4\n' | "$TARTAN" breed hand.study -o hand2 > /dev/null 2>&1
printf '#1 2*2\n\n' | "$TARTAN" breed hand.study -o hand2 --resume > /dev/null 2>&1 || fail "cannot go on by hand"
cmp -s hand/run.sqlite hand2/run.sqlite || fail "choices are not made again"
"$TARTAN" runs show hand | grep -q 'chosen: 1 3@0.4' || fail "weights are not shown"
[ "$("$TARTAN" runs replay hand 30 | head -n 1 | cut -d, -f1)" = "# individual 30" ] || fail "cannot replay what was chosen"

printf "3@1.5\n\n" | "$TARTAN" breed hand.study -o hand3 2>&1 | grep -q "is not a choice.*(0 to 1)" || fail "a weight above 1 is taken"

# ---- open at the box: other pictures of the same run
printf 'surface pipe = x*x + y*y - 9\n' > pipe.field
printf 'evolution { parent "pipe.field"; population 4; grid 16 }\n' > pipe.study
for as in closed open; do
    printf '1 2\n\n' | "$TARTAN" breed pipe.study -o $as $([ $as = closed ] || echo --open) > /dev/null 2>&1 || fail "cannot breed $as forms"
done
cmp -s closed/run.sqlite open/run.sqlite || fail "--open changes a run"
for picture in sheet-0001.png sheet.html; do
    ! cmp -s closed/$picture open/$picture || fail "--open changes nothing of $picture"
done
printf 'evolution { design "slab.solid"; population 4 }\n' > slab.study
printf 'solid slab { box a from (0, 0, 0) to (1, 1, 1); box b from (1, 0, 0) to (2, 2, 1); }\n' > slab.solid
"$TARTAN" breed slab.study -o slab --open < /dev/null 2>&1 | grep -q "open is about fields" || fail "designs of boxes are bred open"

# ---- what scores depend on
sed -i 's/radius = 3/radius = 4/' ring.field
"$TARTAN" evolve rings.study -o one --resume -g 8 > changed.txt 2>&1 && fail "a changed parent is not noticed"
grep -q 'ring.field' changed.txt || fail "the changed parent is not named"
sed -i 's/radius = 4/radius = 3/' ring.field
"$TARTAN" evolve rings.study -o one --resume -g 7 --set "volume target 120" > /dev/null 2>&1 || fail "cannot set a goal"
"$TARTAN" mesh ring.field --surface pair --grid 30 -o ball.obj 2> /dev/null
"$TARTAN" evolve rings.study -o one --resume -g 8 > changed.txt 2>&1 && fail "a changed target is not noticed"
grep -q 'ball.obj' changed.txt || fail "the changed target is not named"
"$TARTAN" evolve rings.study -o one --resume -g 8 --rescore > /dev/null 2>&1 || fail "cannot score again"

# ---- as a module
"$TARTAN" build rings.study -o rings.tnb || fail "cannot build a study of fields"
"$TARTAN" disasm rings.tnb | grep -q 'parent "torus" weight 0.4' || fail "parents are not listed"
"$TARTAN" evolve rings.tnb -g 1 -o module > /dev/null 2>&1 || fail "cannot evolve a module"
exit $failed
