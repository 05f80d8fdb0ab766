#!/usr/bin/env bash
# Fitting: data to test with, measures of errors, classes, scaling, lexicase selection, why sentences fail.
# Slow under sanitizers.
# Needs the parts: store
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
failed=0
fail() { echo "fitting: $*" >&2; failed=1; }

awk 'BEGIN { print "x,y,wanted"; for (i = 0; i < 50; i++) { x = i / 10; y = (i * 7 % 11) / 3; print x "," y "," 3 * x * y + 2 } }' > data.csv
awk 'BEGIN { print "x,y,wanted"; for (i = 0; i < 30; i++) { x = 5 + i / 10; y = (i * 5 % 13) / 2; print x "," y "," 3 * x * y + 2 } }' > test.csv
cat > sums.bnf <<'X'
<e> ::= (<e> + <e>) | (<e> * <e>) | (<e> - <e>) | x | y | x | y | <d>
<d> ::= GE_RANGE:4
X
study() {
  printf 'evolution {\n  grammar "sums.bnf"\n  fit "data.csv"\n  population 80\n  generations 10\n  depth 2..5\n  seed 3\n'
  printf '  %s\n' "$@"
  printf '}\n'
}

# ---- every measure, with both numbers of threads, resumed; the cost of a right sentence is 0
for measure in rmse mse mae r2; do
  study "error $measure" 'test "test.csv"' > "$measure.study"
  "$TARTAN" evolve "$measure.study" -o "$measure.one" --threads 1 > "$measure.txt" || fail "error $measure does not run"
  "$TARTAN" evolve "$measure.study" -o "$measure.two" --threads 2 -g 4 > /dev/null
  "$TARTAN" evolve "$measure.study" -o "$measure.two" --threads 2 --resume > /dev/null || fail "error $measure cannot be resumed"
  cmp -s "$measure.one/run.sqlite" "$measure.two/run.sqlite" || fail "error $measure: other bytes with two threads"
  grep -q '^with the test data: ' "$measure.txt" || fail "error $measure: no score with the test data"
  head -n 1 "$measure.one/best/scores.csv" | grep -qx 'file,individual,score,test' || fail "error $measure: scores.csv has no test"
done
python3 - <<'X' || fail "scores are not what the measures say"
import csv, math
def read(name): return [[float(v) for v in row] for row in list(csv.reader(open(name)))[1:]]
data, test = read("data.csv"), read("test.csv")
def errors(sentence, rows):
    code = compile(sentence.strip(), "s", "eval")
    return [eval(code, {"x": r[0], "y": r[1]}) - r[2] for r in rows]
def cost(measure, rows, e):
    if measure == "mae": return sum(map(abs, e)) / len(e)
    square = sum(v * v for v in e)
    mean = sum(r[2] for r in rows) / len(rows)
    return {"mse": square / len(e), "rmse": math.sqrt(square / len(e)), "r2": square / sum((r[2] - mean) ** 2 for r in rows)}[measure]
for measure in ("rmse", "mse", "mae", "r2"):
    for row in list(csv.reader(open(measure + ".one/best/scores.csv")))[1:]:
        s = open(f"{measure}.one/best/{row[0]}").read()
        for said, rows in ((row[2], data), (row[3], test)):
            real = cost(measure, rows, errors(s, rows))
            assert abs(float(said) - real) <= 1e-9 * max(1, abs(real)), (measure, s, said, real)
X

# ---- scaling: with it, a product alone is right
study 'scaling linear' > scaled.study
"$TARTAN" evolve scaled.study > scaled.txt || fail "does not scale"
awk '/^last generation/ { sub(/,/, "", $4); exit !($4 + 0 < 1e-3) }' scaled.txt && grep -qE '^scaled: -?[0-9.]+ \+ -?[0-9.]+ times this$' scaled.txt ||
  fail "scaling does not find the line: $(cat scaled.txt)"
head -n 1 scaled.run/best/scores.csv | grep -q 'intercept,slope' || fail "scores.csv has no line"

# ---- lexicase and epsilon-lexicase: with any number of threads, resumed, and replayed without the data
for selection in lexicase epsilon-lexicase; do
  study "selection $selection" > "$selection.study"
  "$TARTAN" evolve "$selection.study" -o "$selection.one" --threads 1 > "$selection.txt" || fail "$selection does not run"
  "$TARTAN" evolve "$selection.study" -o "$selection.two" --threads 2 -g 4 > /dev/null
  "$TARTAN" evolve "$selection.study" -o "$selection.two" --threads 2 --resume > /dev/null || fail "$selection cannot be resumed"
  cmp -s "$selection.one/run.sqlite" "$selection.two/run.sqlite" || fail "$selection: other bytes with two threads"
  mv data.csv away.csv
  "$TARTAN" runs replay "$selection.one" "$(sed -n 's/^best: individual //p' "$selection.txt")" | tail -n 1 | cmp -s - "$selection.one/best/1.txt" ||
    fail "$selection: the best is not replayed"
  mv away.csv data.csv
done
printf 'evolution {\n grammar "words"\n match "abc"\n selection lexicase\n}\n' > letters.study
"$TARTAN" check letters.study 2> err.txt && fail "selects by cases where there are none"
grep -q 'E1232.*in each line of data' err.txt || fail "does not say what lexicase looks at"

# ---- position-independent mapping: with any number of threads, resumed, replayed, and from a module
for way in "initialise random" "initialise pi-grow" "crossover subtree 0.9" "mutation subtree 0.5"; do
  study "mapping position-independent" "$way" > places.study
  rm -rf places.one places.two places.three
  "$TARTAN" evolve places.study -o places.one --threads 1 > places.txt || fail "mapping position-independent, $way: does not run"
  "$TARTAN" evolve places.study -o places.two --threads 2 -g 4 > /dev/null
  "$TARTAN" evolve places.study -o places.two --threads 2 --resume > /dev/null || fail "mapping position-independent, $way: cannot be resumed"
  cmp -s places.one/run.sqlite places.two/run.sqlite || fail "mapping position-independent, $way: other bytes with two threads"
  "$TARTAN" runs replay places.one "$(sed -n 's/^best: individual //p' places.txt)" > replayed.txt || fail "mapping position-independent, $way: not replayed"
  tail -n 1 replayed.txt | cmp -s - places.one/best/1.txt || fail "mapping position-independent, $way: the best is not replayed"
  { echo '%mapping position-independent'; cat sums.bnf; } > pairs.bnf
  "$TARTAN" map pairs.bnf --genome "$(sed -n 's,^# genome: ,,p' replayed.txt)" | sed 1d | cmp -s - places.one/best/1.txt ||
    fail "mapping position-independent, $way: the genome is not mapped to the sentence"
done
"$TARTAN" build places.study -o places.tnb && "$TARTAN" evolve places.tnb -o places.three > /dev/null && cmp -s places.one/stats.csv places.three/stats.csv ||
  fail "mapping position-independent: another run from a module"

# ---- classes
awk 'BEGIN { print "x,y,kind"; for (i = 0; i < 60; i++) { x = i % 10; y = int(i / 10); print x "," y "," (x > 2 * y ? 1 : 0) } }' > kinds.csv
for measure in log-loss accuracy f1; do
  study "error $measure" | sed 's/data.csv/kinds.csv/; s/population 80/population 400/' > "$measure.study"
  "$TARTAN" evolve "$measure.study" > "$measure.txt" || fail "error $measure does not run"
done
grep -q '^last generation: best 0,' accuracy.txt || fail "does not tell two kinds apart: $(cat accuracy.txt)"
study 'error log-loss' > numbers.study
"$TARTAN" evolve numbers.study > /dev/null 2> err.txt && fail "takes 50 values for two classes"
grep -q 'E1243.*different values' err.txt || fail "does not say that these are no classes"
study 'error f1' 'scaling linear' > both.study
"$TARTAN" check both.study > /dev/null 2>&1 && fail "scales classes"

# ---- test data of other columns
sed 's/x,y/y,x/' test.csv > turned.csv
study 'test "turned.csv"' > turned.study
"$TARTAN" evolve turned.study > /dev/null 2> err.txt && fail "tests with other columns"
grep -q 'E1243.*columns' err.txt || fail "does not say that the columns differ"

# ---- why sentences fail: counted by reason, and said before the run where most do
cat > odd.bnf <<'X'
<e> ::= sinh(<v>) | sinh(<v>) | logg(<v>) | <v> + <v>
<v> ::= x | y
X
study | sed 's/sums.bnf/odd.bnf/' > odd.study
"$TARTAN" evolve odd.study -g 0 > odd.txt 2> err.txt || fail "a run of which most sentences fail does not run"
grep -q '^warning\[W158\]: of 80 sentences of the first generation, .* have no score: there is no function `sinh`' err.txt || fail "does not warn of failures: $(cat err.txt)"
failing=$(sed -n 's/.*sentence, \([0-9]*\) failed.*/\1/p' odd.txt | tail -n 1)
counted=$(sed -n 's/^  \([0-9]*\) failed: there is no function `\(sinh\|logg\)`.*/\1/p' odd.txt | awk '{ s += $1 } END { print s }')
[ -n "$failing" ] && [ "$failing" = "$counted" ] || fail "reasons do not add up: $failing, $counted"

# ---- a first generation of few different sentences, of which none names a column: said at once, and stored; the help is right
printf '<e> ::= <e>+<e> | <e>*<e> | <c>\n<c> ::= 1.0 | 2.0 | 0.5\n' > plain.bnf
study | sed 's/sums.bnf/plain.bnf/; s/depth .*/depth 2..3/' > few.study
"$TARTAN" evolve few.study -g 3 --threads 1 > few.txt 2> err.txt || fail "a run that begins with few sentences does not run"
grep -q '^warning\[W159\]: of 80 sentences of the first generation, only [0-9]* are different' err.txt || fail "does not warn of few sentences: $(cat err.txt)"
grep -q '^warning\[W160\]: no sentence of the first generation .* names a column' err.txt && grep -q 'its columns are `x`, `y`' err.txt ||
  fail "does not warn of missing columns: $(cat err.txt)"
[ "$("$TARTAN" runs show few.run | grep -c '^ *warning: ')" = 2 ] || fail "the run does not keep its warnings"
setting=$(sed -n 's/^  help: `\([^`]*\)` makes \([0-9]*\) different ones of 80$/\1/p' err.txt)
promised=$(sed -n 's/^  help: `\([^`]*\)` makes \([0-9]*\) different ones of 80$/\2/p' err.txt)
study | sed "s/sums.bnf/plain.bnf/; s/depth .*/$setting/" > better.study
"$TARTAN" evolve better.study -g 0 > better.txt 2> err.txt || fail "the setting that a warning names does not run: $setting"
grep -q " $promised distinct" better.txt || fail "\`$setting\` does not make $promised different sentences: $(cat better.txt)"
! grep -q W159 err.txt || fail "still few sentences with what the help says"
"$TARTAN" evolve few.study -o few.two -g 1 --threads 2 > /dev/null 2>&1
"$TARTAN" evolve few.study -o few.two -g 3 --threads 2 --resume > /dev/null 2> err.txt || fail "a run with warnings cannot be resumed"
[ ! -s err.txt ] || fail "warns again where it goes on: $(cat err.txt)"
cmp -s few.run/run.sqlite few.two/run.sqlite || fail "a run with warnings: other bytes when it is resumed"
"$TARTAN" runs replay few.run "$(sed -n 's/^best: individual //p' few.txt)" | tail -n 1 | cmp -s - few.run/best/1.txt || fail "a run with warnings is not replayed"
printf '<e> ::= 1 | x + 1\n' > two.bnf
study | sed 's/sums.bnf/two.bnf/' > two.study
"$TARTAN" evolve two.study -g 0 > /dev/null 2> err.txt
grep -q W159 err.txt && ! grep -q 'help' err.txt && ! grep -q W160 err.txt || fail "promises more sentences than a grammar has: $(cat err.txt)"
study > many.study
"$TARTAN" evolve many.study -o many.run -g 0 2>&1 > /dev/null | grep -q 'W159\|W160' && fail "warns of a first generation that is as it should be"

# ---- seeds have 64 bits, in the study, on the command line and in a module; runs of before have theirs
study | sed 's/^ *seed .*/seed 18446744073709551615/' > far.study
"$TARTAN" evolve far.study -o far.one -g 1 > /dev/null || fail "a seed of 64 bits does not run"
"$TARTAN" evolve many.study -o far.two -g 1 --seed 18446744073709551615 > /dev/null
cmp -s far.one/stats.csv far.two/stats.csv || fail "--seed is another seed than the study's"
"$TARTAN" evolve many.study -o far.three -g 1 --seed 9223372036854775807 > /dev/null
! cmp -s far.one/stats.csv far.three/stats.csv || fail "the 64th bit of a seed is lost"
"$TARTAN" runs show far.one | grep -q '^  seed 18446744073709551615$' || fail "the run does not keep its seed"
"$TARTAN" build far.study -o far.tnb && "$TARTAN" disasm far.tnb | grep -q 'seed 18446744073709551615$' || fail "a module does not keep its seed"
"$TARTAN" evolve far.tnb -o far.one --resume -g 2 > /dev/null || fail "a run with a seed of 64 bits cannot be resumed"
"$TARTAN" runs replay far.one 100 > /dev/null || fail "a run with a seed of 64 bits is not replayed"
study | sed 's/^ *seed .*/seed 18446744073709551616/' > past.study
"$TARTAN" check past.study 2>&1 | grep -q 'from 0 to 18446744073709551615' || fail "takes a seed of 65 bits, or does not say how large one is"

# ---- medians and quartiles
head -n 1 rmse.one/stats.csv | grep -q 'lower_quartile,median,upper_quartile$' || fail "no quartiles in stats.csv"
tail -n 1 rmse.one/stats.csv | awk -F, '{ exit !($2 <= $13 && $13 <= $14 && $14 <= $15) }' || fail "quartiles are not in order"
sqlite3 rmse.one/run.sqlite 'SELECT count(*) FROM generation WHERE median BETWEEN best AND upper_quartile' 2> /dev/null | grep -qx 11 || [ ! -x "$(command -v sqlite3)" ] ||
  fail "medians are not in the database"
exit "$failed"
