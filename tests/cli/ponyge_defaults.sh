#!/usr/bin/env bash
# What a parameter file of PonyGE2 does not say is as PonyGE2's algorithm/parameters.py has it: the same run, written out or not.
# Needs the parts: store
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
failed=0
fail() { echo "ponyge_defaults: $*" >&2; failed=1; }

# ---- all defaults
mkdir -p plain written
printf '<string> ::= <letter> | <letter><string>\n<letter> ::= a | b | c | d | e | h | l | o\n' | tee plain/letters.bnf > written/letters.bnf
cat > plain/p.txt <<'X'
GRAMMAR_FILE:     letters.bnf
FITNESS_FUNCTION: string_match
TARGET:           hello # all
RANDOM_SEED:      3
GENERATIONS:      4
X
(cat plain/p.txt; cat <<'X') > written/p.txt
POPULATION_SIZE:       500
MAX_TREE_DEPTH:        90
CODON_SIZE:            100000
MAX_GENOME_LENGTH:     None
MAX_WRAPS:             0
INITIALISATION:        operators.initialisation.PI_grow
INIT_GENOME_LENGTH:    200
MAX_INIT_TREE_DEPTH:   10
MIN_INIT_TREE_DEPTH:   None
SELECTION:             operators.selection.tournament
TOURNAMENT_SIZE:       2
SELECTION_PROPORTION:  0.5
WITHIN_USED:           True
MUTATE_DUPLICATES:     False
CROSSOVER:             "operators.crossover.variable_onepoint"
CROSSOVER_PROBABILITY: 0.75
MUTATION:              operators.mutation.int_flip_per_codon
MUTATION_PROBABILITY:  None
MUTATION_EVENTS:       1
REPLACEMENT:           'operators.replacement.generational'
ELITE_SIZE:            None
ERROR_METRIC:          None
X
identity() { sqlite3 "$1/run.sqlite" "SELECT value FROM meta WHERE key='identity'" 2> /dev/null; }
for folder in plain written; do
  (cd "$folder" && "$TARTAN" evolve --ponyge p.txt > out.txt 2> err.txt) || fail "$folder parameters are not read: $(cat "$folder/err.txt")"
done
cmp -s plain/p.run/run.sqlite written/p.run/run.sqlite ||
  fail "PonyGE2's defaults, written out, make another run: $(diff <(identity plain/p.run) <(identity written/p.run))"
identity plain/p.run > identity.txt
while IFS= read -r line; do
  [ ! -s identity.txt ] || grep -qxF "$line" identity.txt || fail "PonyGE2's defaults are not $line: $(cat identity.txt)"
done <<'X'
match "hello # all"
population 500
initialise pi-grow
codons 200
codon-limit 100000
max-codons 1000000
depth 4..10
tail 0.5
selection tournament 2
crossover one-point 0.75
mutation codons
points used
elites 5
replacement generational
max-depth 90
wraps 0
copies kept
X

# ---- where ramped depths begin, the grammar says, or MIN_INIT_TREE_DEPTH; elites are a hundredth, at least one
read_as() { # WANTED LINE...
  local wanted=$1 found
  shift
  printf '%s\n' "$@" | cat plain/p.txt - > plain/q.txt
  rm -rf plain/q.run
  (cd plain && "$TARTAN" evolve --ponyge q.txt -g 0 > /dev/null 2> err.txt) || fail "$*: $(cat plain/err.txt)"
  found=$(identity plain/q.run | grep -E '^(depth|tree-depth|elites|initialise|mutation|max-depth|replacement) ' | tr '\n' ';')
  [ -z "$found" ] || [ "$found" = "$wanted" ] || fail "$* is read as $found, not $wanted"
}
read_as 'initialise pi-grow;depth 3..10;mutation codons;elites 1;replacement generational;max-depth 90;' 'POPULATION_SIZE: 60'
read_as 'initialise ramped;depth 4..14;mutation codons;elites 5;replacement generational;max-depth 90;' 'INITIALISATION: rhh' 'MAX_INIT_TREE_DEPTH: 14'
read_as 'initialise pi-grow;depth 7..10;mutation codons;elites 2;replacement generational;max-depth 90;' 'MIN_INIT_TREE_DEPTH: 6' 'POPULATION_SIZE: 250'
read_as 'initialise grow;depth 1..17;mutation codons;elites 5;replacement generational;max-depth 17;' 'INITIALISATION: uniform_tree' \
  'MAX_TREE_DEPTH: 17' 'MIN_INIT_TREE_DEPTH: 6'
read_as 'initialise pi-grow;depth 4..10;mutation subtree;elites 5;replacement generational;max-depth 17;tree-depth 17;' 'MUTATION: subtree' 'MAX_TREE_DEPTH: 17'
read_as 'initialise pi-grow;depth 4..10;mutation codons;elites 1;replacement steady-state;max-depth 0;' 'MAX_TREE_DEPTH: None' 'REPLACEMENT: steady_state'
read_as 'initialise pi-grow;depth 4..10;mutation genome 1;elites 7;replacement generational;max-depth 90;' 'MUTATION: int_flip_per_ind' 'ELITE_SIZE: 7'

# ---- PonyGE2's own problem, where it is there; otherwise what lacks is said
printf 'FITNESS_FUNCTION: string_match\nTARGET: abc\n' > lacks.txt
"$TARTAN" evolve --ponyge lacks.txt > /dev/null 2> err.txt && fail "runs without a grammar"
grep -q '^lacks.txt:1:1: error\[E1232\].*no GRAMMAR_FILE.*supervised_learning/Vladislavleva4.bnf, is not here' err.txt ||
  fail "does not say that a grammar lacks: $(cat err.txt)"
printf 'GRAMMAR_FILE: plain/letters.bnf\nTARGET: abc\n' > goal.txt
"$TARTAN" evolve --ponyge goal.txt > /dev/null 2> err.txt && fail "fits no data"
grep -q 'E1232.*no DATASET_TRAIN' err.txt && grep -q 'FITNESS_FUNCTION: string_match and TARGET' err.txt ||
  fail "does not say what to evolve towards: $(cat err.txt)"
mkdir -p datasets/Vladislavleva4 grammars/supervised_learning
printf '<e> ::= x[:, 0] | 1 | <e>+<e>\n' > grammars/supervised_learning/Vladislavleva4.bnf
fitted() { # LINE...: the error that is measured
  printf '%s\n' 'POPULATION_SIZE: 20' 'GENERATIONS: 1' "$@" > all.txt
  rm -rf all.run
  "$TARTAN" evolve --ponyge all.txt > /dev/null 2> err.txt || fail "$*: the default problem is not fitted: $(cat err.txt)"
  identity all.run | grep '^error '
}
printf 'x0\ty\n1\t0\n2\t1\n3\t1\n' > datasets/Vladislavleva4/Train.txt
[ "$(fitted)" = 'error rmse' ] || fail "numbers are not fitted by rmse"
[ "$(fitted 'FITNESS_FUNCTION: supervised_learning.classification')" = 'error f1' ] || fail "classes are not learned by f1"
[ "$(fitted 'FITNESS_FUNCTION: supervised_learning.classification' 'ERROR_METRIC: f1_score')" = 'error f1' ] || fail "f1_score is not f1"
[ "$(fitted 'ERROR_METRIC: mae')" = 'error mae' ] || fail "mae is not mae"
exit "$failed"
