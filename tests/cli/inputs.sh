#!/usr/bin/env bash
# A run never mixes scores: whatever a score depends on, a change of it is named when the run is gone on with.
# Needs the parts: store mesh
name=inputs
. "$(dirname "$0")/golden.bash"
cd "$scratch"
printf 'x,y\n0,1\n1,3\n2,5\n3,7\n' >data.csv
printf '0 7 1 4 0 11\n1 2 3 4 5 6 7 8\n' >first.genomes
printf 'schema s { k = x | y | z }\n' >letters.plan
printf 'x | y\nx | x\n' >keep.plans
printf 'z | y\nz | x\n' >drop.plans
cat >sheet.off <<'END'
OFF
4 1 0
-5 -5 -1
5 -5 -1
5 5 -1
-5 5 -1
4 0 1 2 3
END
printf 'OFF\n3 1 0\n0 0 1\n1 0 1\n0 1 1\n3 0 1 2\n' >hull.off
cat >pavilion.study <<'STUDY'
rules "square"
steps 2
boundary mesh "sheet.off" stop
fitness size target 4
fitness smoothness target 20
distance-to "hull.off"
fitness near = distance-to
STUDY
settings='population 20; generations 3; seed 5'
echo "evolution { grammar \"arithmetic\"; fit \"data.csv\"; seeds \"first.genomes\"; $settings }" | tr ';' '\n' >fit.study
echo "evolution { grammar \"plan-rules\"; schema \"letters.plan\"; keep \"keep.plans\"; drop \"drop.plans\"; $settings }" | tr ';' '\n' >learn.study
echo "evolution { grammar \"genr8-symmetric\"; grow \"pavilion.study\"; $settings }" | tr ';' '\n' >grow.study

# changes STUDY NAME COMMAND: the command changes a file, by that name in what is said.
changes() {
    local study=$1 named=$2 change=$3 run=$1.run
    rm -rf "$run" kept
    "$TARTAN" evolve "$study.study" -o "$run" >/dev/null || { fail "$study does not run"; return; }
    exits 0 "$TARTAN" evolve "$study.study" -o "$run" --resume --generations 4
    mkdir kept && cp -- *.csv *.plan *.plans *.genomes *.study *.off kept
    eval "$change"
    exits 1 "$TARTAN" evolve "$study.study" -o "$run" --resume --generations 5
    grep -q "E1252.*\`$named\` has changed" err || fail "$change: not named $named: $(head -n 1 err)"
    grep -q -- '--rescore' err || fail "$change: no way on is said"
    exits 0 "$TARTAN" evolve "$study.study" -o "$run" --resume --rescore --generations 5
    exits 0 "$TARTAN" evolve "$study.study" -o "$run" --resume --generations 6
    exits 0 "$TARTAN" runs replay "$run" 100
    cp kept/* .
    exits 1 "$TARTAN" evolve "$study.study" -o "$run" --resume --generations 7
}
changes fit 'fit data.csv' "sed -i 's/,\([0-9]\)/,\\1000/' data.csv"
best=$(tail -n 1 fit.run/stats.csv | cut -d, -f2)
changes fit 'seeds first.genomes' "echo '3 3 3' >>first.genomes"
changes learn 'keep keep.plans' "echo 'y | y' >>keep.plans"
changes learn 'drop drop.plans' "echo 'z | z' >>drop.plans"
changes learn 'schema letters.plan' "sed -i 's/| z/| z | w/' letters.plan"
changes grow 'grow pavilion.study' "sed -i 's/target 4/target 40/' pavilion.study"
changes grow 'grow its boundary meshes' "sed -i 's/ -1\$/ -2/' sheet.off"
changes grow 'grow its target mesh' "sed -i 's/^1 0 1$/2 0 1/' hull.off"

# The scores after it are those of the changed data: worse than a thousandth of them.
python3 -c 'import sys; sys.exit(not float(sys.argv[1]) > 1)' "$best" || fail "a score of old data is still the best: $best"
exits 2 "$TARTAN" evolve fit.study -o other.run --rescore
# A run of other elementary functions is not gone on with, nor replayed; neither is one from before they had versions.
rm -rf fit.run
"$TARTAN" evolve fit.study -o fit.run >/dev/null
for arithmetic in "update meta set value = '1' where key = 'arithmetic'" "delete from meta where key = 'arithmetic'"; do
    python3 -c 'import sqlite3, sys; db = sqlite3.connect("fit.run/run.sqlite"); db.execute(sys.argv[1]); db.commit()' "$arithmetic"
    exits 1 "$TARTAN" evolve fit.study -o fit.run --resume --generations 5
    grep -q 'E1252.*was made with arithmetic 1, and this Tartan has arithmetic' err || fail "not said: $(head -n 1 err)"
    exits 1 "$TARTAN" runs replay fit.run 1
    grep -q 'E1252.*was made with arithmetic 1' err || fail "not said by replay: $(head -n 1 err)"
done
finish
