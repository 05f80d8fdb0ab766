#!/usr/bin/env bash
# Grammars, data and parameters as they are written for PonyGE2. A folder of its grammars is taken from $TARTAN_PONYGE2, where that is set
# (cmake -DTARTAN_PONYGE2=DIR): each of them is read, or what is not supported is said in one line.
# Needs the parts: store
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
failed=0
fail() { echo "ponyge: $*" >&2; failed=1; }

# ---- brackets beside non-terminals are text; alone they are, too, and it is said
cat > index.bnf <<'X'
<e> ::= (<e> <op> <e>) | x[:, <i>] | x.iloc[:, <i>] | [<i>]
<op> ::= + | *
<i> ::= GE_RANGE:2
X
"$TARTAN" check index.bnf > out.txt 2>&1 || fail "brackets beside non-terminals are not read"
[ -s out.txt ] && grep -v W155 out.txt | grep -q 'W157' && fail "brackets beside non-terminals are no question of dialect"
[ "$("$TARTAN" map index.bnf --genome '1 1' | tail -n 1)" = 'x[:, 1]' ] || fail "a column is mapped to something else"
printf '<a> ::= { <b> } | [ <b> ]\n<b> ::= x\n' > alone.bnf
"$TARTAN" check alone.bnf 2> err.txt || fail "braces that stand alone are not read"
grep -q 'W157.*read as ge' err.txt || fail "does not say that the dialect ge was taken"
[ "$("$TARTAN" map alone.bnf --genome '0 0' | tail -n 1)" = '{ x }' ] || fail "braces are not text in ge"
printf '<a> ::= Edge { + Edge } ;\n' > edges.bnf
"$TARTAN" check edges.bnf 2> err.txt; grep -q 'W157.*read as genr8' err.txt || fail "does not say that the dialect genr8 was taken"
"$TARTAN" fmt edges.bnf > /dev/null 2>&1 || fail "a grammar of a guessed dialect is not laid out"
grep -q '^<a> ::= Edge { + Edge } ;$' edges.bnf || fail "a guessed dialect is laid out otherwise: $(cat edges.bnf)"

# ---- libGE's escaped quotes: text where another quote closes it; what was read before is read as before
quoted() { printf '%s\n' "$1" '<b> ::= y | z' > quotes.bnf; "$TARTAN" map quotes.bnf --genome '0 1 1' 2> err.txt | tail -n 1; }
[ "$(quoted '<a> ::= "say(\""<b>"\")"')" = 'say("z")' ] || fail "an escaped double quote is no text: $(cat err.txt)"
[ "$(quoted "<a> ::= 'it\\'s '<b>")" = "it's z" ] || fail "an escaped single quote is no text: $(cat err.txt)"
[ "$(quoted '<a> ::= "\\"<b>"|"')" = '\z|' ] || fail "a text does not end behind an escaped backslash: $(cat err.txt)"
[ "$(quoted '<a> ::= "x" <b> "\"|\"" | v')" = 'x z "|"' ] || fail "a bar between escaped quotes ends an alternative: $(cat err.txt)"
"$TARTAN" fmt quotes.bnf && [ "$(head -n 1 quotes.bnf)" = '<a> ::= "x" <b> "\"|\"" | v' ] || fail "escaped quotes are laid out otherwise"
[ -z "$(quoted '<a> ::= "x\" <b>')" ] && grep -q 'E1211\|single backslash' err.txt || fail "a lone backslash before the last quote is no error: $(cat err.txt)"

# ---- grammars of Python programs are refused with the reason, as themselves and in a study
printf '<p> ::= def f():{:<s>:}\n<s> ::= return 1\n' > program.pybnf
"$TARTAN" check program.pybnf 2> err.txt && fail "takes a grammar of Python programs"
[ "$(grep -c 'error\[' err.txt)" = 1 ] && grep -q 'E1263' err.txt || fail "does not say why a .pybnf is refused: $(cat err.txt)"

# ---- numbers of the data: from the data, from a directive, and otherwise an error
cat > numbers.bnf <<'X'
<e> ::= np.where(x[:, <v>] == <is>, <os>, <os>)
<v> ::= GE_RANGE:dataset_n_vars
<is> ::= GE_RANGE:dataset_n_is
<os> ::= GE_RANGE:dataset_n_os
X
"$TARTAN" check numbers.bnf 2> err.txt && fail "knows numbers of data that are not there"
[ "$(grep -c 'E1213.*dataset_n_' err.txt)" = 3 ] || fail "does not name the numbers that are not known"
(printf '%%dataset-vars 3\n%%dataset-inputs 4\n%%dataset-outputs 2\n'; cat numbers.bnf) > told.bnf
[ "$("$TARTAN" map told.bnf --genome '0 2 3 1 0' | tail -n 1)" = 'np.where(x[:, 2] == 3, 1, 0)' ] || fail "a directive does not say the numbers"
printf '%%dataset-vars 0\n<a> ::= b\n' > none.bnf
"$TARTAN" check none.bnf 2> err.txt && fail "takes no columns"
awk 'BEGIN { print "# a\tb\tc\tclass"; for (i = 0; i < 64; i++) { a = i % 4; b = int(i / 4) % 4; c = int(i / 16); print a "\t" b "\t" c "\t" (b == 3 ? 1 : 0) } }' > classes.txt
cat > classes.study <<'X'
evolution {
  grammar "numbers.bnf"
  fit "classes.txt"
  error accuracy
  population 60
  generations 12
  codons 12
  initialise random
  seed 5
}
X
"$TARTAN" evolve classes.study -o one --threads 1 > one.txt || fail "does not evolve with numbers of the data"
grep -qF 'np.where(x[:, 1] == 3, 1, 0)' one.txt || fail "does not find the class: $(cat one.txt)"
"$TARTAN" evolve classes.study -o two --threads 2 -g 5 > /dev/null && "$TARTAN" evolve classes.study -o two --threads 2 --resume > /dev/null
cmp -s one/run.sqlite two/run.sqlite || fail "a resumed run with numbers of the data has other bytes"
cp classes.txt kept.txt; rm classes.txt
"$TARTAN" runs replay one "$(sed -n 's/^best: individual //p' one.txt)" | tail -n 1 | cmp -s - one/best/1.txt || fail "a run is not replayed without its data"
awk -v OFS='\t' 'NR == 1 { print "# a", "b", "c", "d", "class"; next } { print $1, $2, $3, 0, $4 }' kept.txt > classes.txt
"$TARTAN" evolve classes.study -o one --resume > /dev/null 2> err.txt && fail "goes on with data of more columns"
grep -q 'E1252.*dataset-vars' err.txt || fail "does not say that the number of columns differs: $(cat err.txt)"

# ---- parameter files: a study is made of them, and what does not apply is listed
mkdir -p tool/parameters tool/grammars tool/datasets/Plane
cp numbers.bnf tool/grammars/classes.bnf
cp kept.txt tool/datasets/Plane/Train.txt
cat > tool/parameters/plane.txt <<'X'
CACHE:                  True      # of no use here
CODON_SIZE:             1000
CROSSOVER:              operators.crossover.variable_twopoint
CROSSOVER_PROBABILITY:  0.8
DATASET_TRAIN:          Plane/Train.txt
ERROR_METRIC:           mae
FITNESS_FUNCTION:       supervised_learning.regression
GENERATIONS:            8
GRAMMAR_FILE:           classes.bnf
INITIALISATION:         operators.initialisation.PI_grow
MAX_INIT_TREE_DEPTH:    6
MUTATION:               int_flip_per_ind
MUTATION_EVENTS:        2
POPULATION_SIZE:        40
RANDOM_SEED:            12
SELECTION:              tournament
TOURNAMENT_SIZE:        3
VERBOSE:                False
X
"$TARTAN" evolve --ponyge tool/parameters/plane.txt -o plane > plane.txt 2> err.txt || fail "does not read parameters: $(cat err.txt)"
grep -q 'do not apply: CACHE, VERBOSE$' err.txt || fail "does not list what does not apply: $(cat err.txt)"
sqlite3 plane/run.sqlite "SELECT value FROM meta WHERE key='identity'" > identity.txt 2> /dev/null
for line in 'population 40' 'crossover two-point 0.8' 'mutation genome 2' 'selection tournament 3' 'initialise pi-grow' 'depth 3..6' 'codon-limit 1000' 'error mae' 'seed 12'; do
  [ ! -s identity.txt ] || grep -qx "$line" identity.txt || fail "the parameters do not say $line: $(cat identity.txt)"
done
"$TARTAN" evolve --ponyge tool/parameters/plane.txt -o short -g 3 > /dev/null 2>&1 && "$TARTAN" evolve --ponyge tool/parameters/plane.txt -o short --resume > /dev/null 2>&1
cmp -s plane/run.sqlite short/run.sqlite || fail "a run of parameters is not resumed"
"$TARTAN" runs replay plane 41 > /dev/null || fail "a run of parameters is not replayed"
printf 'POPULATION_SIZE: 40\nFITNESS_FUNCTION: pymax\n' > pymax.txt
"$TARTAN" evolve --ponyge pymax.txt > /dev/null 2> err.txt && fail "runs a Python program"
grep -q '^pymax.txt:2:1: error\[E1232\].*Python program' err.txt || fail "does not say that a fitness function is not run: $(cat err.txt)"
sed 's/supervised_learning.regression/pymax/' tool/parameters/plane.txt > tool/parameters/program.txt
"$TARTAN" evolve --ponyge tool/parameters/program.txt > /dev/null 2> err.txt && fail "fits data in the place of a Python program"
grep -q 'program.txt:[0-9]*:1: error\[E1232\].*`pymax` is a Python program' err.txt || fail "does not name the fitness function: $(cat err.txt)"
printf 'TARGET: abc\nDATASET_TRAIN: none.txt\nFITNESS_FUNCTION: string_match\nGRAMMAR_FILE: words.bnf\nPOPULATION_SIZE: 20\nGENERATIONS: 1\n' > both.txt
printf '<w> ::= <l> | <l><w>\n<l> ::= a | b | c\n' > words.bnf
"$TARTAN" evolve --ponyge both.txt > /dev/null 2> err.txt || fail "does not match a text where data are named too: $(cat err.txt)"
grep -q 'do not apply: .*DATASET_TRAIN' err.txt || fail "does not list the data that a text has no use for"
printf 'evolution {\n grammar "blocks.pybnf"\n match "x"\n}\n' > blocks.study
printf '<p> ::= {::}x{::}\n' > blocks.pybnf
"$TARTAN" check blocks.study > /dev/null 2> err.txt && fail "takes a grammar of Python programs"
grep -q 'blocks.study:2:10: error\[E1263\].*only PonyGE2' err.txt || fail "does not say why such a grammar is refused: $(cat err.txt)"
printf 'TARGET: abc\nCROSSOVER: mine.own\nFITNESS_FUNCTION: string_match\nGRAMMAR_FILE: words.bnf\n' > own.txt
"$TARTAN" evolve --ponyge own.txt > /dev/null 2> err.txt && fail "takes an operator that is not there"
grep -q '^own.txt:2:1: error\[E1232\].*mine.own' err.txt || fail "does not name the operator: $(cat err.txt)"
"$TARTAN" evolve --ponyge classes.study > /dev/null 2> err.txt && fail "takes a study for parameters"
grep -q 'E1231' err.txt || fail "does not say that a study is no parameter file"

# ---- all grammars of a folder
if [ -n "${TARTAN_PONYGE2:-}" ]; then
  count=0
  while IFS= read -r grammar; do
    count=$((count + 1))
    "$TARTAN" check "$grammar" > /dev/null 2> err.txt
    status=$?
    [ "$status" -le 1 ] || fail "$grammar: exit status $status"
    [ "$status" = 0 ] || grep -q 'error\[E\(1213\|1263\|1207\|0002\|1209\)\]' err.txt || fail "$grammar: $(head -n 1 err.txt)"
  done < <(find "$TARTAN_PONYGE2" -name '*.bnf' -o -name '*.pybnf')
  echo "$count grammars of $TARTAN_PONYGE2"
fi
exit "$failed"
