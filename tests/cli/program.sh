#!/usr/bin/env bash
# Needs the parts: store
# A program that scores: what it is asked and what its answers mean, hostile programs, ends, kills, resuming and replaying without it.
# Slow under sanitizers.
name=program
source "$(dirname "$0")/golden.bash"
cd "$scratch"
cp -r "$goldens/programs" programs
mkdir tmp
export TMPDIR=$scratch/tmp
seconds=600 # a busy machine takes long to start a program
study() { # PROGRAM MORE POPULATION GENERATIONS
    printf 'evolution {\n  grammar "words"\n  fitness program "programs/%s"\n  population %s\n  generations %s\n  program-timeout %s\n  seed 3\n%s\n}\n' "$1" "${3:-40}" "${4:-4}" "$seconds" "${2:-}"
}
nothing_left() {
    [ -z "$(ls tmp)" ] || fail "$1: a folder is left: $(ls tmp)"
    ! pgrep -f "$scratch/programs" >/dev/null || fail "$1: a process is left: $(pgrep -fa "$scratch/programs")"
}

# ---- what a study can say
study length.sh >good.study
golden refused "cd $scratch && tartan evolve good.study"
study none.sh >none.study
golden none "cd $scratch && tartan evolve none.study --run-programs"
study plain.sh >plain.study
golden plain "cd $scratch && tartan evolve plain.study --run-programs"
printf 'evolution {\n  grammar "words"\n  fitness program score\n  fitness program\n  fitness program "a" "b"\n  fitness program "a" target 3\n  fitness program "a" weight 2\n  fitness program "b"\n  match "x"\n  program-values 9\n  program-timeout 0.5\n}\n' >words.study
golden words "cd $scratch && tartan check words.study"
printf 'evolution {\n  grammar "words"\n  match "x"\n  program-values 2\n  program-timeout 5\n}\n' >alone.study
golden alone "cd $scratch && tartan check alone.study"
study length.sh '  selection nsga2' >one.study
golden one "cd $scratch && tartan check one.study"

# ---- hostile programs: the same is said with one thread and with two
for hostile in at_once deaf dies garbage hangs huge_number killed list long no_interpreter not_a_number other overflow says silent twice; do
    population=40 generations=4 more=
    seconds=600
    if [ $hostile = hangs ]; then population=3 seconds=1; fi
    if [ $hostile = dies ]; then generations=0; fi
    if [ $hostile = overflow ]; then more='  program-values 2'; fi
    study $hostile.sh "$more" $population $generations >$hostile.study
    for threads in 2 1; do
        rm -rf $hostile.run
        golden $hostile "cd $scratch && tartan evolve $hostile.study --run-programs --threads \$threads"
        [ "$threads" = 1 ] || cp -r $hostile.run two.run
    done
    if [ -f two.run/run.sqlite ]; then cmp $hostile.run/run.sqlite two.run/run.sqlite || fail "$hostile: another run at 2 threads"; fi
    rm -rf two.run
    nothing_left $hostile
done

# ---- the same scores from programs that answer in other ways: one by one, many at once and in the opposite order, a program for each line
"$TARTAN" evolve good.study --run-programs --threads 1 >said || fail 'no run'
for other in length.py once.sh noisy.sh; do
    study $other >same.study
    for threads in 1 2; do
        "$TARTAN" evolve same.study --run-programs --threads $threads >/dev/null || fail "$other: no run"
        cmp good.run/stats.csv same.run/stats.csv || fail "$other: other scores at $threads threads"
        rm -rf same.run
    done
    nothing_left $other
done

# ---- lexicase by the numbers of an answer: kept with each individual, so that the run goes on and is made again without asking
cat >programs/three.py <<'X'
#!/usr/bin/env python3
import json
import sys

for line in sys.stdin:
    text = json.loads(line)["sentence"]
    print(json.dumps([abs(len(text) - 9), text.count("a"), sum(letter not in "hello" for letter in text)]), flush=True)
X
chmod +x programs/three.py
for selection in lexicase epsilon-lexicase; do
    study three.py "  program-values 3
  selection $selection" >cases.study
    rm -rf cases.*run
    "$TARTAN" evolve cases.study -o cases.run --run-programs --threads 1 >cases.txt || fail "$selection by a program does not run"
    "$TARTAN" evolve cases.study -o cases.two.run --run-programs --threads 2 --generations 1 >/dev/null
    "$TARTAN" evolve cases.study -o cases.two.run --run-programs --threads 2 --resume >/dev/null || fail "$selection by a program is not gone on with"
    cmp cases.run/run.sqlite cases.two.run/run.sqlite || fail "$selection by a program: other bytes when it is resumed with two threads"
    head -n 1 cases.run/best/scores.csv | grep -qx 'file,individual,score,program,program 2,program 3,goals' || fail "$selection: the numbers are not listed"
    awk -F, 'NR > 1 && $3 != $4 + $5 + $6 { exit 1 }' cases.run/best/scores.csv || fail "$selection: the numbers are not the score's"
    "$TARTAN" runs replay cases.run "$(sed -n 's/^best: individual //p' cases.txt)" | tail -n 1 | cmp -s - cases.run/best/1.txt || fail "$selection: the best is not replayed"
    "$TARTAN" evolve cases.study -o cases.run --run-programs --resume --generations 5 --set 'program weight 2' >/dev/null || fail "$selection: the weight cannot be changed"
    nothing_left $selection
done
sed 's/epsilon-lexicase/tournament 2/' cases.study >plainly.study
"$TARTAN" evolve plainly.study --run-programs >/dev/null
! cmp -s plainly.run/stats.csv cases.two.run/stats.csv || fail "lexicase selection is another's"
study length.sh '  selection lexicase' >single.study
golden single "cd $scratch && tartan check single.study"

# ---- killed at any moment, and gone on with: the same bytes, and nothing left
sed 's|programs/length.sh|programs/slow.sh|' good.study >slow.study
printf '#!/bin/sh\nwhile IFS= read -r line; do\n    line=${line#*sentence}\n    sleep 0.01\n    echo ${#line}\ndone\n' >programs/slow.sh
chmod +x programs/slow.sh
"$TARTAN" evolve slow.study -o whole --run-programs >/dev/null
for signal in KILL KILL KILL TERM TERM; do
    "$TARTAN" evolve slow.study -o killed --resume --run-programs --threads $((RANDOM % 2 + 1)) >/dev/null 2>&1 &
    sleep 0.$((RANDOM % 25 + 10))
    kill -$signal $! 2>/dev/null || true
    wait $! 2>/dev/null || true
done
"$TARTAN" evolve slow.study -o killed --resume --run-programs >/dev/null || fail 'a run that was killed is not gone on with'
cmp whole/run.sqlite killed/run.sqlite || fail 'a run that was killed is another'
for wait in 1 2 3 4 5 6 7 8 9 10; do
    [ -n "$(ls tmp)" ] || break
    sleep 0.2 # what stood by is clearing up
done
nothing_left killed

# ---- an interrupt ends a program that hangs
study hangs.sh >forever.study
"$TARTAN" evolve forever.study --run-programs >/dev/null 2>&1 &
running=$!
for wait in $(seq 200); do
    ! pgrep -f "$scratch/programs/hangs.sh" >/dev/null || break
    sleep 0.05
done
kill -TERM $running
wait $running 2>/dev/null || true
nothing_left interrupted

# ---- neither a replay nor a run that goes on asks again; the program's bytes belong to the run
mv programs/length.sh programs/kept.sh
"$TARTAN" runs replay good.run 3 >/dev/null || fail 'a replay needs the program'
mv programs/kept.sh programs/length.sh
"$TARTAN" evolve good.study --resume --run-programs >again || fail 'a finished run is not opened'
cmp said again || fail 'another report of the same run'
"$TARTAN" evolve good.study --resume --run-programs -g 6 >/dev/null
"$TARTAN" evolve good.study -o longer --run-programs -g 6 >/dev/null
cmp good.run/run.sqlite longer/run.sqlite || fail 'a run that is extended is another'
echo '# longer' >>programs/length.sh
golden changed "cd $scratch && tartan evolve good.study --resume --run-programs -g 8"
exits 0 "$TARTAN" evolve good.study --resume --run-programs --rescore -g 8
# What a study's program may take can be changed in between, and so can what it counts.
sed -i 's/program-timeout 600/program-timeout 900/' good.study
exits 0 "$TARTAN" evolve good.study --resume --run-programs -g 9 --set 'program weight 2'
"$TARTAN" runs show good.run | grep -q 'changed: program weight 2' || fail 'the weight is not changed'
exits 1 "$TARTAN" evolve good.study --resume --run-programs -g 9 --set 'program target 2'

# ---- forms: a surface, a design, a field and a kit, each with its mesh and measures, and as objectives of their own
cat >programs/form.py <<'PY'
#!/usr/bin/env python3
import json, os, sys
for line in sys.stdin:
    asked = json.loads(line)
    points = [[float(x) for x in row.split()[1:4]] for row in open(asked["mesh"]) if row.startswith("v ")]
    open(os.path.join(os.path.dirname(asked["mesh"]), "own"), "w").close()
    print(json.dumps({"id": asked["id"], "score": [max(p[2] for p in points) - min(p[2] for p in points), len(asked["measures"])]}), flush=True)
PY
chmod +x programs/form.py
printf 'rules "square"\nsteps 2\nedge-limit 1000\n' >bare.growth.study
printf 'rules "square"\nsteps 2\nedge-limit 1000\nfitness undulation target 2\nrequire faces > 1\n' >wants.growth.study
printf 'solid top { box top from (0, 7, 0) to (9, 8, 9) rigid; box leg from (0, 0, 0) to (1, 7, 1); fitness volume target 3; }\n' >top.solid
printf 'use "bricks";\nrule bred at stud, tube = 3005;\nmodel room { inside box(2 studs, 2 bricks, 2 studs); start stud at (10, 0, 10) by bred; }\n' >room.kit
form() { printf 'evolution {\n%s\n  fitness program "programs/form.py" weight 0.5\n  program-values 2\n  population 8\n  generations 2\n%s\n}\n' "$2" "${3:-}" >$1.study; }
form bare '  grammar "genr8-dividing"; grow "bare.growth.study"'
form wants '  grammar "genr8-dividing"; grow "wants.growth.study"' '  selection nsga2'
form design '  design "top.solid"'
form field '  parent "sphere"; parent "torus"; grid 12' '  selection nsga2'
form kit '  grammar "kit-rules"; place "room.kit"'
export TMPDIR=tmp # from here on by another name; programs run in a folder of their own
for kind in bare wants design field kit; do
    for threads in 1 2; do
        "$TARTAN" evolve $kind.study -o $threads.run --run-programs --threads $threads >said 2>&1 || fail "$kind: $(cat said)"
    done
    cmp 1.run/run.sqlite 2.run/run.sqlite || fail "$kind: another run at 2 threads"
    head -n 1 1.run/best/scores.csv >>heads
    rm -rf 1.run 2.run
    nothing_left $kind
done
is 'the objectives' "$(paste -sd' ' heads)" 'file,individual,score file,individual,undulation,program,program 2 file,individual,score file,individual,program,program 2 file,individual,score'

TMPDIR=none exits 3 "$TARTAN" evolve bare.study -o none.run --run-programs

# ---- a module that was built of a study, beside it
"$TARTAN" build good.study -o good.tnb
"$TARTAN" evolve good.tnb -o built --run-programs -g 2 >/dev/null || fail 'no run of a module'
"$TARTAN" evolve good.study -o plain --run-programs -g 2 >/dev/null
cmp built/stats.csv plain/stats.csv || fail 'a module makes another run than its study'

# ---- a surface's score is that of its goals and, weighed, that of the program
printf '#!/bin/sh\nwhile read -r line; do echo 0; done\n' >programs/nothing.sh
printf '#!/bin/sh\nwhile read -r line; do echo 3; done\n' >programs/three.sh
chmod +x programs/nothing.sh programs/three.sh
for program in nothing three; do
    printf 'evolution {\n  grammar "genr8-dividing"; grow "wants.growth.study"\n  fitness program "programs/%s.sh" weight 0.5\n  population 8\n  generations 0\n}\n' $program >$program.study
    "$TARTAN" evolve $program.study --run-programs >/dev/null
done
is 'what three counts' "$(paste -d, <(cut -d, -f3 nothing.run/best/scores.csv) <(cut -d, -f3 three.run/best/scores.csv) | awk -F, 'NR > 1 { printf "%s%.9g", between, $2 - $1; between = " " }' | tr ' ' '\n' | sort -u)" 1.5
finish
