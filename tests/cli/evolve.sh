# Runs of evolution: the same bytes for any number of threads, whether interrupted or not; extension; replay; breeding by hand.
# Slow under sanitizers.
# Needs the parts: store
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
failed=0
fail() { echo "evolve: $*" >&2; failed=1; }

cat > hello.study <<'X'
evolution {
  grammar "words"
  match "hello world"
  population 60
  generations 25
  selection tournament 4
  crossover subtree 0.8
  seed 7
}
X

# ---- any number of threads, the same database
"$TARTAN" evolve hello.study -o one --threads 1 > one.txt || fail "does not run"
"$TARTAN" evolve hello.study -o four --threads 4 > four.txt || fail "does not run with four threads"
cmp -s one/run.sqlite four/run.sqlite || fail "four threads make another run than one"
cmp -s one/stats.csv four/stats.csv || fail "four threads make other statistics"
diff -r one/best four/best > /dev/null || fail "four threads have other results"

# ---- a study as a module makes the same run; what it evolves does not depend on where it was called from
"$TARTAN" build hello.study -o hello.tnb || fail "a study cannot be built"
"$TARTAN" evolve hello.tnb -o module > module.txt || fail "a module cannot be evolved"
cmp -s one/run.sqlite module/run.sqlite || fail "a module makes another run than its study"
mkdir elsewhere
(cd elsewhere && "$TARTAN" evolve ../hello.study > /dev/null) || fail "cannot be called from elsewhere"
cmp -s one/run.sqlite elsewhere/hello.run/run.sqlite || fail "a run depends on the folder that it is called from"
"$TARTAN" disasm hello.tnb | grep -q '^  crossover subtree 0.8' || fail "disasm does not list the settings"

# ---- islands: a part of the study, the same with any number of threads, gone on with, and replayed
sed 's/population 60/population 60; islands 5; migrate 2 every 3/' hello.study > islands.study
"$TARTAN" evolve islands.study -o islands --threads 1 > islands.txt || fail "islands do not run"
"$TARTAN" evolve islands.study -o islands4 --threads 4 -g 10 > /dev/null || fail "islands do not run with four threads"
"$TARTAN" evolve islands.study -o islands4 --threads 2 --resume > /dev/null || fail "islands cannot be gone on with"
diff -r islands islands4 > /dev/null || fail "islands depend on the threads or on an interruption"
! cmp -s one/stats.csv islands/stats.csv || fail "islands change nothing"
grep -q '^evolution' <("$TARTAN" build islands.study -o islands.tnb && "$TARTAN" disasm islands.tnb) || fail "islands are not in the module"
"$TARTAN" disasm islands.tnb | grep -q '^  migrate 2 every 3' || fail "disasm does not list what migrates"
"$TARTAN" evolve islands.tnb -o islands5 > /dev/null && cmp -s islands/run.sqlite islands5/run.sqlite || fail "a module with islands makes another run"
best=$(sed -n 's/^best: individual //p' islands.txt)
"$TARTAN" breed islands.study -o chosen < /dev/null > /dev/null 2> err && fail "islands are bred by hand"
grep -q 'islands.study.*E1232.*a person chooses parents from one population' err || fail "breed says of islands: $(cat err)"

# ---- first genomes from a file are part of the run: it is replayed where the file is gone
sed 's/seed 7/seeds "first.genomes"/' hello.study > seeded.study
printf '# two\n0 7 1 4 0 11\n1 2 3 4 5 6 7 8\n' > first.genomes
"$TARTAN" evolve seeded.study -o seeded --generations 3 > /dev/null || fail "does not take first genomes"
rm first.genomes
[ "$("$TARTAN" runs replay seeded 1 | sed -n 's/^# genome: //p')" = "1 2 3 4 5 6 7 8" ] || fail "a first genome is not replayed"

# ---- a run in the way is not overwritten
"$TARTAN" evolve hello.study -o one > /dev/null 2> err.txt && fail "overwrote a run"
grep -q 'E1250' err.txt || fail "does not say that there is a run"

# ---- stopped early and extended: the same as made at once
"$TARTAN" evolve hello.study -o short --generations 9 > /dev/null || fail "does not stop early"
"$TARTAN" evolve hello.study -o short --resume > /dev/null || fail "cannot be extended"
cmp -s one/run.sqlite short/run.sqlite || fail "an extended run differs from one made at once"

# ---- a run in which nothing has a score says why
sed 's/seed 7/max-depth 1/' hello.study > shallow.study
"$TARTAN" evolve shallow.study --generations 1 | grep -q 'no individual has a score (too deep), 60 without' || fail "does not say why nothing has a score"

# ---- killed at any moment and resumed: the same bytes
cat > slow.study <<'X'
evolution {
  grammar "words"
  match "a quick brown fox jumps over the lazy dog"
  population 200
  generations 60
  crossover two-point 0.9
  seed 3
}
X
"$TARTAN" evolve slow.study -o whole > /dev/null || fail "does not run"
kills=${KILLS:-17} # each time three: 51 moments
for i in $(seq 1 "$kills"); do
  rm -rf killed
  for again in 1 2 3; do
    "$TARTAN" evolve slow.study -o killed --resume > /dev/null 2>&1 &
    pid=$!
    sleep "$(awk -v seed="$i$again" 'BEGIN { srand(seed); print 0.01 + rand() * 0.12 }')"
    kill -9 "$pid" 2> /dev/null
    wait "$pid" 2> /dev/null
  done
  "$TARTAN" evolve slow.study -o killed --resume > /dev/null || fail "cannot be resumed"
  cmp -s whole/run.sqlite killed/run.sqlite || fail "a killed run ends with other bytes (kill $i)"
done

# ---- another study does not go on with the run
sed 's/population 60/population 61/' hello.study > other.study
"$TARTAN" evolve other.study -o one --resume > /dev/null 2> err.txt && fail "resumed with another study"
grep -q 'E1252' err.txt || fail "does not say that the study differs"

# ---- replay: what the database says of an individual
id=$(sed -n 's/^best: individual //p' one.txt)
"$TARTAN" runs replay one "$id" > replay.txt || fail "cannot replay"
tail -n 1 replay.txt | cmp -s - one/best/1.txt || fail "the replayed individual is not the best one"
"$TARTAN" map "$(dirname "$TARTAN")/stdlib/words.bnf" --genome "$(sed -n 's/^# genome: //p' replay.txt)" 2> /dev/null | tail -n 1 > mapped.txt
[ -s mapped.txt ] && { cmp -s mapped.txt one/best/1.txt || fail "the replayed genome maps to something else"; }
"$TARTAN" runs replay one 99999999 > /dev/null 2>&1 && fail "replayed an individual that is not there"
"$TARTAN" runs show one | grep -q '^ *25 ' || fail "does not show the last generation"
"$TARTAN" runs compare one four | grep -c '^one\|^four' | grep -q 2 || fail "does not compare"
"$TARTAN" runs show nothing > /dev/null 2>&1; [ $? -eq 3 ] || fail "a run that is not there is no file error"

# ---- breeding by hand: choices are stored and made again
sed 's/population 60/population 12/' hello.study > hand.study
printf '1 2*3 5\nx\n13\n4 4 6\n\n' | "$TARTAN" breed hand.study -o hand > hand.txt || fail "cannot breed"
[ -f hand/sheet-0002.svg ] || fail "no sheet of the third generation"
grep -q 'is not a choice' hand.txt || fail "does not refuse a wrong choice"
printf '1 2*3 5\n' | "$TARTAN" breed hand.study -o hand2 > /dev/null
printf '4 4 6\n\n' | "$TARTAN" breed hand.study -o hand2 --resume > /dev/null || fail "cannot go on breeding"
cmp -s hand/run.sqlite hand2/run.sqlite || fail "choices are not made again"
"$TARTAN" runs replay hand 30 > /dev/null || fail "cannot replay a choice"
printf '2 #5 3@0.5\n#99\n#5 #11*2\n#3 1\n\n' | "$TARTAN" breed hand.study -o ids > ids.txt || fail "cannot choose by id"
grep -q 'does not weigh its parents' ids.txt || fail "weighs the parents of codons"
grep -q 'nobody with the id 99' ids.txt || fail "takes an id that nobody has"
printf '#5 #11*2\n' | "$TARTAN" breed hand.study -o ids2 > /dev/null
printf '#3 1\n\n' | "$TARTAN" breed hand.study -o ids2 --resume > /dev/null || fail "cannot go on with ids"
cmp -s ids/run.sqlite ids2/run.sqlite || fail "choices by id are not made again"
"$TARTAN" evolve hand.study -o ids2 --resume -g 4 > /dev/null || fail "evolve cannot go on with choices by id"
"$TARTAN" runs replay ids2 30 > /dev/null || fail "cannot replay a choice by id"

# ---- interrupted where it asks: what was chosen stays, and the answer is not waited for
mkfifo answers
"$TARTAN" breed hand.study -o asked < answers > asked.txt &
pid=$!
exec 3> answers
echo '1 2' >&3
for i in $(seq 200); do [ -f asked/sheet-0001.svg ] && break; sleep 0.1; done
sleep 0.5
kill -TERM "$pid"
for i in $(seq 600); do kill -0 "$pid" 2> /dev/null || break; sleep 0.1; done
kill -0 "$pid" 2> /dev/null && fail "an interrupted prompt waits for its answer"
exec 3>&-
wait "$pid"; [ $? -eq 130 ] || fail "an interrupted prompt does not end as interrupted"
"$TARTAN" runs show asked | grep -q '^ *1 ' || fail "an interrupted breeding forgets what was chosen"

# ---- fitting data; evaluations that fail are counted, not fatal
printf 'x0,x1,y\n' > data.csv
awk 'BEGIN { for (i = 0; i < 40; i++) printf "%d,%d,%d\n", i, i % 7, i * 2 + i % 7 }' >> data.csv
cat > fit.study <<'X'
evolution {
  grammar "arithmetic"
  fit "data.csv"
  population 100
  generations 15
  max-depth 9
  depth 3..6
  seed 2
}
X
"$TARTAN" evolve fit.study > fit.txt || fail "does not fit"
grep -q '^best: individual' fit.txt || fail "finds nothing"
grep -qE ' [1-9][0-9]* failed' fit.txt || sqlite3 fit.run/run.sqlite 'SELECT count(*) FROM birth WHERE state=2' 2> /dev/null | grep -qv '^0$' ||
  fail "no evaluation failed, though the data have no x2"
sed 's/"arithmetic"/"arithmetic-functions"/' fit.study > curve.study
"$TARTAN" evolve curve.study -o curve > curve.txt || fail "does not fit with functions"
grep -q '^best: individual' curve.txt || fail "finds nothing with functions"
printf 'x0,y\n1,two\n' > data.csv
"$TARTAN" evolve fit.study -o bad > /dev/null 2>&1; [ $? -eq 1 ] || fail "wrong data are no error"

# ---- learning a rule; weights changed while the run is paused are made again, and once only
examples=$OLDPWD/examples/learning-a-rule
sed "s#\(keep\|drop\).plans#$examples/\1.plans#; s/nsga2 2/tournament 3/; s/population 200/population 60/" "$examples/learn.study" > learn.study
"$TARTAN" evolve learn.study -o steps --generations 4 > /dev/null || fail "does not learn"
"$TARTAN" evolve learn.study -o steps --resume --generations 6 --set "length-weight 0.2" > /dev/null || fail "cannot change a weight"
"$TARTAN" evolve learn.study -o steps --resume --generations 9 --set "length-weight 0.2" > /dev/null || fail "cannot go on"
"$TARTAN" evolve learn.study -o leap --generations 4 > /dev/null
"$TARTAN" evolve learn.study -o leap --resume --generations 9 --set "length-weight 0.2" > /dev/null
cmp -s steps/run.sqlite leap/run.sqlite || fail "a changed weight is not made again as it was"
"$TARTAN" evolve learn.study -o leap --resume --generations 11 > /dev/null || fail "cannot go on without saying it again"
"$TARTAN" runs replay leap 500 > /dev/null || fail "cannot replay past a change"
"$TARTAN" evolve learn.study -o leap --resume --set "colour 3" > /dev/null 2>&1; [ $? -eq 1 ] || fail "changes what is not there"
"$TARTAN" check leap/best/1.plan || fail "the best rule is no rule file"
"$TARTAN" draw leap/best/1.plan --rule learned -o leap.svg
cmp -s leap.svg leap/best/1.svg || fail "the best rule's picture is not that of its rule"

# ---- rule files bred for what they grow
cat > garden.study <<'X'
rules "square"
steps 3
scale 1.2
gravity 0 0 -0.1
repeller at 1 1 -1 strength 0.3
fitness undulation target 2 weight 1
fitness subdivisions target 0.6 weight 5
edge-limit 2000
X
sed 's/^fitness undulation.*/fitness slope = undulation \/ size target 0.3/' garden.study > slope.study
cat > bred.study <<'X'
evolution {
  grammar "genr8-angles"
  grow "garden.study"
  population 40
  generations 6
  depth 4..8
  tail 1
  seed 5
}
X
"$TARTAN" evolve bred.study -o bred --threads 1 > bred.txt || fail "does not breed surfaces"
"$TARTAN" evolve bred.study -o bred4 --threads 4 > /dev/null || fail "does not breed surfaces with four threads"
cmp -s bred/run.sqlite bred4/run.sqlite || fail "four threads breed other surfaces than one"
"$TARTAN" check bred/best/1.hemls || fail "the best rules are no rule file"
"$TARTAN" grow bred/best/1.hemls --steps 2 > /dev/null || fail "the best rules do not grow"
grep -q '<path' bred/best/1.svg || fail "no picture of the best surface"
# best/ has each surface once, though others have sentences that grow the same
sed 's/genr8-angles/genr8-dividing/; s/depth .*/depth 3..5/; s/generations .*/generations 12/' bred.study > alike.study
"$TARTAN" evolve alike.study > /dev/null 2>&1 || fail "does not breed surfaces that are alike"
for rules in alike.run/best/*.hemls; do
  sed "s,\"square\",\"$rules\"," garden.study > one.study
  "$TARTAN" grow one.study -o one.obj > /dev/null 2>&1 && grep '^v ' one.obj | sort | md5sum
done > forms.txt
[ "$(sort -u forms.txt | wc -l)" = "$(ls alike.run/best/*.hemls | wc -l)" ] || fail "best/ has a surface twice: $(sort forms.txt | uniq -c)"
"$TARTAN" evolve bred.study -o bred --resume --generations 8 --set "undulation target 1 weight 3" > /dev/null || fail "cannot change a target"
"$TARTAN" runs replay bred 300 > /dev/null || fail "cannot replay surfaces"
"$TARTAN" evolve bred.study -o bred --resume --set "undulation height 1" > /dev/null 2>&1; [ $? -eq 1 ] || fail "takes a wrong target"
sed 's/tail 1/tail 1\n selection nsga2 2/' bred.study > fronts.study
"$TARTAN" evolve fronts.study > /dev/null || fail "does not breed surfaces with two objectives"

# ---- goals that are expressions: three objectives; what has no value is a failure; a target of one is changed
sed 's/garden/slope/' fronts.study > slopes.study
printf 'fitness soft-boundary\n' >> slope.study
"$TARTAN" evolve slopes.study > /dev/null || fail "does not breed for an expression"
"$TARTAN" evolve slopes.study --resume --generations 7 --set "slope target 1 weight 3" --set "soft-boundary weight 2" > /dev/null || fail "cannot change an expression's target"
"$TARTAN" runs replay slopes.run 290 > /dev/null || fail "cannot replay three objectives"
sed -i 's/^fitness slope.*/fitness slope = 1 \/ (undulation - undulation)/' slope.study
"$TARTAN" evolve slopes.study -o nowhere --generations 1 > nowhere.txt || fail "an expression without value ends the run"
grep -q 'no individual has a score (the fitness term `slope` has no value for this surface)' nowhere.txt || fail "does not say which term has no value"
sed 's/population 40/population 6/' bred.study > hand.study
printf '1 2*3\n\n' | "$TARTAN" breed hand.study -o surfaces > /dev/null || fail "cannot choose surfaces"
grep -q '<path' surfaces/sheet-0001.svg || fail "no surfaces on the sheet"
sed '/fitness/d' garden.study > nothing.study
sed 's/garden/nothing/' bred.study > wants.study
"$TARTAN" evolve wants.study > /dev/null 2>&1; [ $? -eq 1 ] || fail "a study that wants nothing is no error"

# ---- designs of boxes bred by grammar for the goals of another
cat > goals.solid <<'X'
solid goals {
  box any from (0, 0, 0) to (1, 1, 1);
  require parts = 1, height in 6.5..7.5;
  fitness wide = width target 8;
  fitness light = volume target 40;
}
X
cat > boxes.study <<'X'
evolution {
  grammar "boxes"
  build "goals.solid"
  population 60
  generations 8
  crossover subtree 0.8
  seed 3
}
X
"$TARTAN" evolve boxes.study -o boxes1 --threads 1 > /dev/null || fail "designs cannot be bred"
"$TARTAN" evolve boxes.study -o boxes4 --threads 4 > /dev/null || fail "designs cannot be bred with four threads"
cmp -s boxes1/run.sqlite boxes4/run.sqlite || fail "four threads breed other designs than one"
"$TARTAN" evolve boxes.study -o boxes5 --generations 3 > /dev/null && "$TARTAN" evolve boxes.study -o boxes5 --resume > /dev/null || fail "breeding designs is not resumed"
cmp -s boxes1/run.sqlite boxes5/run.sqlite || fail "resuming breeds other designs"
"$TARTAN" runs replay boxes1 61 > /dev/null || fail "cannot replay designs"
"$TARTAN" check boxes1/best/1.solid || fail "the best design is none"
[ -z "$("$TARTAN" check boxes1/best/1.solid 2>&1)" ] || fail "bred designs have warnings"
grep -q '<path' boxes1/best/1.svg || fail "the best design has no picture"
sed 's/seed 3/selection nsga2/' boxes.study > fronts.study
"$TARTAN" evolve fronts.study -o front --generations 2 > /dev/null || fail "goals are not weighed one by one"
head -1 front/best/scores.csv | grep -qx 'file,individual,wide,light' || fail "the goals have no names: $(head -1 front/best/scores.csv)"
"$TARTAN" evolve boxes.study -o boxes1 --resume --generations 8 --set 'light target 20 weight 2' > /dev/null 2>&1 || fail "a goal cannot be changed"
"$TARTAN" evolve boxes.study -o boxes1 --resume --set 'lihgt target 20' > /dev/null 2>&1; [ $? -eq 1 ] || fail "a goal that is not there is no error"
printf '1 2*3\n\n' | "$TARTAN" breed boxes.study -o chosen > /dev/null || fail "cannot choose designs"
grep -q '<path' chosen/sheet-0001.svg || fail "no designs on the sheet"

exit $failed
