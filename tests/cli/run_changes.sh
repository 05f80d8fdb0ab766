#!/usr/bin/env bash
# Needs the parts: mesh store
# A run that has begun takes other surroundings and rates; each is stored, and made again at any number of threads.
name=run_changes
source "$(dirname "$0")/golden.bash"
cd "$scratch"
cat >tent.study <<'STUDY'
rules "square"
steps 3
gravity 0 0 -0.1
attractor at 2 2 3 strength 0.5
fitness undulation target 3
fitness size target 6
edge-limit 2000
STUDY
echo 'evolution { grammar "genr8-dividing"; grow "tent.study"; population 16; generations 3; seed 5 }' | tr ';' '\n' >breed.study
first=(--set 'gravity 0 0 -0.5' --set 'mutation codons 0.3')
second=(--set 'attractor at 2 2 3 strength 0' --set 'crossover subtree 0.9' --set 'boundary plane at 0 0 -1 normal 0 0 1')
for threads in 1 2; do
    "$TARTAN" evolve breed.study -o $threads --threads $threads >/dev/null
    "$TARTAN" evolve breed.study -o $threads --threads $threads --resume -g 5 "${first[@]}" >/dev/null
    "$TARTAN" evolve breed.study -o $threads --threads $threads --resume -g 7 "${first[@]}" "${second[@]}" >/dev/null
done
cmp 1/run.sqlite 2/run.sqlite || fail 'another run at 2 threads'
"$TARTAN" runs show 1 >shown
for change in 'gravity 0 0 -0.5' 'mutation codons 0.3' 'attractor at 2 2 3 strength 0' 'crossover subtree 0.9' 'boundary plane at 0 0 -1 normal 0 0 1'; do
    [ "$(grep -c "changed: $change\$" shown)" = 1 ] || fail "not once in the run: $change"
done
# What is not changed goes on otherwise; what is scored again has another score.
"$TARTAN" evolve breed.study -o 3 -g 5 >/dev/null
[ "$("$TARTAN" runs show 3 | tail -n 1)" != "$("$TARTAN" runs show 1 | grep '^ *5 ')" ] || fail 'the changes change nothing'
# One that is gone on with twice is as one that is gone on with at once.
"$TARTAN" evolve breed.study -o 1 --resume -g 8 >/dev/null
"$TARTAN" evolve breed.study -o 1 --resume -g 9 >/dev/null
"$TARTAN" evolve breed.study -o 2 --threads 2 --resume -g 9 >/dev/null
cmp 1/run.sqlite 2/run.sqlite || fail 'another run in two parts'
# Scores, the size and scores again, between the same two generations: who left is kept, so that the same members stay.
for threads in 1 2; do
    "$TARTAN" evolve breed.study -o mixed-$threads --threads $threads >/dev/null
    "$TARTAN" evolve breed.study -o mixed-$threads --threads $threads --resume -g 5 --set 'gravity 0 0 -0.9' --set 'population 8' \
        --set 'attractor at 2 2 3 strength 0' --set 'population 5' --set 'gravity 0 0 -0.2' --set 'population 9' >/dev/null
    "$TARTAN" evolve breed.study -o mixed-$threads --threads $threads --resume -g 6 >/dev/null || fail 'a run whose scores and size were changed is not gone on with'
done
cmp mixed-1/run.sqlite mixed-2/run.sqlite || fail 'changes of scores and size: another run at 2 threads'
[ "$("$TARTAN" runs show mixed-1 | grep -c ' left: ')" = 2 ] || fail 'who left is not said'
# At the prompt; a wrong change is said and asked again.
printf '1 2\nset gravity 0 0\nset gravity 0 0 -0.3\nset mutation genome 2\n3 4\n' | "$TARTAN" breed breed.study -o by-eye >said
grep -q 'changes nothing that surfaces grow in' said || fail 'a wrong change is not said'
"$TARTAN" runs show by-eye | grep -A2 'changed: gravity 0 0 -0.3' | grep -q 'changed: mutation genome 2' || fail 'changes at the prompt are not stored'
echo | "$TARTAN" breed breed.study -o by-eye --resume >/dev/null || fail 'a run with changes at the prompt is not gone on with'
for change in 'gravity 0 0' 'mutation codons 3' 'mutation genome 1.5' 'mutation much 3' 'crossover two-point' 'boundary mesh "x.obj"' 'steps 3' 'attractor at 1 2 strength 3'; do
    exits 1 "$TARTAN" evolve breed.study -o 1 --resume --set "$change"
    grep -q 'error\[E1232\]' err || fail "not refused: $change"
done
finish
