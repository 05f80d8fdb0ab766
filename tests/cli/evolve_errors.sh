#!/usr/bin/env bash
# Needs the parts: store
# What evolve says of studies whose files are not there or hold something else, and of wrong use: each at its place.
name=evolve_errors
source "$(dirname "$0")/golden.bash"
cd "$scratch"

study() { printf 'evolution {\n%s\n}\n' "$2" >"$scratch/$1.study"; }
study seeds '  grammar "words"; match "x"; seeds "none.txt"'
study codon '  grammar "words"; match "x"; seeds "genomes"'
printf '# first genomes\n1 2 3\n4 five\n' >genomes
study keep '  grammar "plan-rules"; keep "none.plans"; drop "drop.plans"'
study drop '  grammar "plan-rules"; keep "keep.plans"; drop "none.plans"'
study empty '  grammar "plan-rules"; keep "keep.plans"; drop "empty.plans"'
study tray '  grammar "plan-rules"; keep "keep.plans"; drop "drop.plans"'
study schema '  grammar "plan-rules"; keep "keep.plans"; drop "drop.plans"; schema "lahav"'
printf "4' single - - dense:4' open:8' empty\n" >keep.plans
printf "4' single - - dense:4' open:8' empty\n4' nine\n" >drop.plans
: >empty.plans
study fit '  grammar "arithmetic"; fit "none.csv"'
study data '  grammar "arithmetic"; fit "data.csv"'
printf 'x0,y\n1,2\n2,two\n' >data.csv
study grow '  grammar "genr8"; grow "none.study"'
study wants '  grammar "genr8"; grow "wants.growth.study"'
printf 'rules "square"\n' >wants.growth.study
study wrong '  grammar "genr8"; grow "wrong.growth.study"'
printf 'rules "square"\nfitness sise target 3\n' >wrong.growth.study
study hello '  grammar "words"; match "hi"; population 10; generations 2'
printf 'rules "square"\n' >growth.study
study build '  grammar "boxes"; build "none.solid"'
study goals '  grammar "boxes"; build "plain.solid"'
printf 'solid plain { box all from (0, 0, 0) to (1, 1, 1); }\n' >plain.solid
study designs '  grammar "boxes"; build "designs.solid"'
printf 'solid one { box all from (0, 0, 0) to (1, 1, 1); }\nsolid two { box all from (0, 0, 0) to (1, 1, 1); }\n' >designs.solid
study kit '  grammar "kit-rules"; place "none.kit"'
study nokit '  grammar "kit-rules"; place "plain.solid"'
study models '  grammar "kit-rules"; place "bricks"'
study modelwants '  grammar "kit-rules"; place "room.kit"'
printf 'use "bricks";\nrule bred at stud, tube = 3005;\nmodel room { inside box(2 studs, 1 brick, 2 studs); start stud at (10, 0, 10) by bred; }\n' >room.kit
study wrongkit '  grammar "kit-rules"; place "wrong.kit"'
printf 'use "bricks";\nrule bred at stud, tube = 3006;\n' >wrong.kit
study stranger '  parent "sphere"; crossover subtree 0.5'
study parent '  parent "spere"'
study weight '  parent "sphere" weight 2'
study distance '  parent "far.field"'
printf 'surface far = distance("hull.obj") - 1\n' >far.field
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' >hull.obj
study surface '  parent "two.field:thre"'
printf 'surface one = x\nsurface three = y\nbox (-1, -1, -1)..(1, 1, 1)\n' >two.field
study measure '  parent "sphere"; fitness volme target 3'
study wish '  parent "sphere"; fitness volume 3'
study like '  parent "sphere"; likeness "none.obj"'
study box '  parent "sphere"; fitness volume target 3; box "(1, 2, 3)"'
study goalless '  parent "sphere"'
study many '  parent "sphere"; parent "torus"; parent "heart"; population 2'
study nodesign '  design "none.solid"'
study region '  design "top.solid"; region "(0, 0)"'
study narrow '  design "top.solid"; sizes 3..4; region "(0, 0, 0)..(2, 9, 9)"'
study boxes '  design "top.solid"; boxes 4..6'
study sizes '  design "top.solid"; sizes 4..2'
study both '  design "top.solid"; parent "sphere"'
printf 'solid top { box top from (0, 7, 0) to (9, 8, 9) rigid; box leg from (0, 0, 0) to (1, 7, 1); fitness volume target 3; }\n' >top.solid
for wrong in nodesign region narrow boxes sizes both stranger parent weight distance surface measure wish like box goalless many; do
    golden "$wrong" "cd $scratch && tartan evolve $wrong.study"
done
for wrong in seeds codon keep drop empty tray schema fit data grow wants wrong growth nothing build goals designs kit nokit models modelwants wrongkit; do
    golden "$wrong" "cd $scratch && tartan evolve $wrong.study"
done
golden no_study "tartan evolve"
golden not_a_study "cd $scratch && tartan evolve genr8"
golden set_too_early "cd $scratch && tartan evolve hello.study --set 'length-weight 1'"
golden set_nothing "cd $scratch && tartan evolve hello.study -o other && tartan evolve hello.study -o other --resume --set 'length-weight 1'"
golden twice "cd $scratch && tartan evolve hello.study -o other"
golden folder "cd $scratch && tartan evolve hello.study -o genomes/there"
golden run_file "cd $scratch && tartan evolve hello.study -o genomes"
golden other_seed "cd $scratch && tartan evolve hello.study -o other --resume --seed 9"
golden no_run "cd $scratch && tartan runs show nowhere"
mkdir damaged
printf 'garbage' >damaged/run.sqlite
golden damaged "cd $scratch && tartan evolve hello.study -o damaged --resume"
[ "$(cat damaged/run.sqlite)" = garbage ] || fail "--resume throws away what is no run"
: >damaged/run.sqlite # as a run that is killed at once leaves it
"$TARTAN" evolve hello.study -o damaged --resume >/dev/null || fail "a run that was killed while it began does not begin again"
printf '3 3 1\n\n' | "$TARTAN" breed hello.study -o chosen >/dev/null
golden chosen "cd $scratch && tartan runs show chosen"
finish

# ---- data: a wrong number is at its place, also where the grammar counts the columns; names and numbers that are separated otherwise are
# read, and a first line of numbers is no line of names
study numbers '  grammar "vars.bnf"; fit "numbers.csv"'
printf '<e> ::= x[:, <i>]\n<i> ::= GE_RANGE:dataset_n_vars\n' >vars.bnf
printf 'x0,y\n1,abc\n2,3\n' >numbers.csv
study absent '  grammar "vars.bnf"; fit "none.csv"'
study gap '  grammar "arithmetic"; fit "gap.csv"'
printf 'x0;y\n1;\n' >gap.csv
study decimal '  grammar "arithmetic"; fit "decimal.csv"'
printf 'x0;y\n1,5;2\n' >decimal.csv
study spaced '  grammar "arithmetic"; fit "spaced.csv"; population 10; generations 1; stop 1000'
printf '# x0 x1 y\n1,2,3\n2,3,5\n4,1,5\n' >spaced.csv
study headless '  grammar "arithmetic"; fit "headless.csv"; population 10; generations 1; stop 1000; seed 3'
printf '1,2\n3,4\n5,6\n' >headless.csv
for wrong in numbers absent gap decimal; do
    golden "data_$wrong" "cd $scratch && tartan evolve $wrong.study"
done
golden data_spaced "cd $scratch && tartan evolve spaced.study | grep -c ^best:"
golden data_headless "cd $scratch && tartan evolve headless.study | grep -c ^best:"

# ---- what is said at the end: the best lacks what is required; all sentences have been scored
printf 'rules "square"\nsteps 2\nfitness height target 0.4\nrequire faces >= 1000 and crossings = 0\n' >large.growth.study
study lacking '  grammar "genr8-quads"; grow "large.growth.study"; population 6; generations 1'
printf 'solid goal { fitness volume target 3; require height >= 900; box all from (0, 0, 0) to (1, 1, 1); }\n' >tall.solid
study lower '  grammar "boxes"; build "tall.solid"; population 6; generations 1; initialise pi-grow'
printf 'use "bricks";\nrule bred at stud, tube = 3005;\nmodel room { inside box(2 studs, 1 brick, 2 studs); start stud at (10, 0, 10) by bred; require elements = 7; }\n' >seven.kit
study fewer '  grammar "kit-rules"; place "seven.kit"; population 6; generations 1'
printf '<a> ::= <b><b>\n<b> ::= p | q | r\n' >nine.bnf
study nine '  grammar "nine.bnf"; match "pqr"; population 10; generations 30'
for lacks in lacking lower fewer; do
    golden "lacks_$lacks" "cd $scratch && tartan evolve $lacks.study 2>&1 >/dev/null | grep -v '^  *[0-9]* |'"
done
golden exhausted "cd $scratch && tartan evolve nine.study | head -n 1 | cut -d, -f 2"
golden exhausted_again "cd $scratch && cp nine.run/run.sqlite before && tartan evolve nine.study --resume -g 40 | head -n 1 | cut -d, -f 2 && cmp before nine.run/run.sqlite"
if command -v flock >/dev/null; then # the run's folder is locked as a command that writes it locks it
    golden in_use "cd $scratch && flock nine.run \"\$TARTAN\" evolve nine.study --resume"
    golden in_use_insert "cd $scratch && echo pp >pp && flock nine.run \"\$TARTAN\" runs insert nine.run pp"
fi
