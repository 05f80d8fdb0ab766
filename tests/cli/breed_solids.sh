#!/usr/bin/env bash
# Designs of boxes bred as lists of genes: the same bytes for any number of threads and after an interruption, results that compile,
# score as they were scored and keep the skeleton, choices by hand, changed inputs.
# Slow under sanitizers.
# Needs the parts: store
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
failed=0
fail() { echo "breed_solids: $*" >&2; failed=1; }

cat > top.solid <<'END'
solid top {
  symmetry x, z;
  box top at (0, 7.25, 0) size (12, 0.5, 8) rigid;
  box brace from (-1, 6, -1) to (1, 7, 1) clip normal (1, 1, 0) through (0.9, 6.9, 0) rigid;
  box leg from (4.5, 0, 2.5) to (5.5, 7, 3.5);
  require parts = 1, height in 7.4..7.6;
  fitness light = volume target 60;
}
END
cat > legs.study <<'END'
evolution {
  design "top.solid"
  region "(-6, 0, -4)..(6, 7, 4)"
  sizes 0.5..7
  boxes 1..4
  population 40
  generations 12
  selection tournament 3
  split 0.1
  delete 0.1
  fitness "footprint / 10" target 6
  seed 4
}
END
"$TARTAN" evolve legs.study -o one --threads 1 > /dev/null || fail "cannot evolve"
"$TARTAN" evolve legs.study -o four --threads 4 > /dev/null
cmp -s one/run.sqlite four/run.sqlite || fail "threads change a run"
diff -r one/best four/best > /dev/null || fail "threads or folders change the results"
"$TARTAN" evolve legs.study -o two -g 5 > /dev/null
"$TARTAN" evolve legs.study -o two --resume > /dev/null || fail "cannot resume"
cmp -s one/run.sqlite two/run.sqlite || fail "a resumed run differs"

# ---- killed at random moments, and resumed: the same bytes
for i in $(seq 1 "${KILLS:-8}"); do
    rm -rf killed
    for again in 1 2; do
        "$TARTAN" evolve legs.study -o killed --resume > /dev/null 2>&1 &
        pid=$!
        sleep "$(awk -v seed="$i$again" 'BEGIN { srand(seed); print 0.005 + rand() * 0.06 }')"
        kill -9 "$pid" 2> /dev/null
        wait "$pid" 2> /dev/null
    done
    "$TARTAN" evolve legs.study -o killed --resume > /dev/null || fail "a killed run cannot be resumed"
    cmp -s one/run.sqlite killed/run.sqlite || fail "a killed run ends with other bytes (kill $i)"
    diff -r one/best killed/best > /dev/null || fail "a killed run ends with other results (kill $i)"
done

# ---- what is written: compiles, is laid out, holds the skeleton, and the design's free box was the first seed
"$TARTAN" check one/best/*.solid || fail "results do not compile, or are warned of"
"$TARTAN" fmt --check one/best/*.solid || fail "results are not laid out"
for id in 0 7 50 300; do
    "$TARTAN" runs replay one $id > r.solid || fail "cannot replay $id"
    grep -q 'box top from (-6, 7, -4) to (6, 7.5, 4) rigid;' r.solid || fail "individual $id lost its top"
    grep -q 'box brace from (-1, 6, -1) to (1, 7, 1) clip normal (1, 1, 0) through (0.9, 6.9, 0) rigid;' r.solid ||
        fail "individual $id lost its brace"
done
"$TARTAN" runs replay one 0 | grep -q 'genes (5, 3.5, 3, 1, 7, 1, ' || fail "the free box is not the first design's"

# ---- a score is the same by genes and by the text
cat > again.study <<'END'
evolution {
  grammar "same.bnf"
  build "goals.solid"
  population 2
  generations 0
}
END
sed -e 's/fitness light.*/&\n  fitness foot = footprint \/ 10 target 6;/' top.solid > goals.solid
for file in 1 2 3; do
    awk 'BEGIN { printf "<S> ::= " } !/^#/ { gsub(/"/, ""); printf "%s\"%s\\n\"", n++ ? " " : "", $0 } END { print "" }' one/best/$file.solid > same.bnf
    rm -rf again
    "$TARTAN" evolve again.study -o again > again.txt || fail "cannot score the text of $file"
    [ "$(sed -n 2p again/best/scores.csv | cut -d, -f3)" = "$(sed -n $((file + 1))p one/best/scores.csv | cut -d, -f3)" ] ||
        fail "design $file scores otherwise as a text"
done

# ---- flat designs, without planes, with NSGA-II
cat > flat.solid <<'END'
solid sheet { flat 0.5; noclip; box base from (0, 0, 0) to (4, 0.5, 0) rigid; fitness tall = height target 5; fitness small = volume target 3; }
END
printf 'evolution { design "flat.solid"; region "(0, 0, 0)..(4, 5, 1)"; sizes 0.2..3; boxes 1..6; population 30; generations 6; selection nsga2 }\n' > flat.study
"$TARTAN" evolve flat.study -o flat > /dev/null || fail "cannot evolve a flat design"
head -n 1 flat/best/scores.csv | grep -q 'tall,small' || fail "goals are not objectives"
"$TARTAN" check flat/best/*.solid || fail "flat results do not compile"

# ---- by hand
sed 's/population 40/population 9/' legs.study > hand.study
printf '1 3@0.4\n#1 2*2\n\n' | "$TARTAN" breed hand.study -o hand > hand.txt || fail "cannot breed by hand"
grep -q '<path' hand/sheet-0002.svg || fail "no designs on the sheet"
printf '1 3@0.4\n' | "$TARTAN" breed hand.study -o hand2 > /dev/null
printf '#1 2*2\n\n' | "$TARTAN" breed hand.study -o hand2 --resume > /dev/null || fail "cannot go on by hand"
cmp -s hand/run.sqlite hand2/run.sqlite || fail "choices are not made again"

# ---- what scores depend on
sed -i 's/target 60/target 50/' top.solid
"$TARTAN" evolve legs.study -o one --resume -g 14 > changed.txt 2>&1 && fail "a changed design is not noticed"
grep -q 'top.solid' changed.txt || fail "the changed design is not named"
sed -i 's/target 50/target 60/' top.solid
"$TARTAN" evolve legs.study -o one --resume -g 13 --set "light target 40" > /dev/null || fail "cannot set the design's goal"
"$TARTAN" evolve legs.study -o one --resume -g 14 --set "footprint / 10 target 5" > /dev/null || fail "cannot set the study's goal"
exit $failed
