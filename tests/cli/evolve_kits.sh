#!/usr/bin/env bash
# Needs the parts: store
# Rules of kits are bred: scored by what the kit's model becomes, the same with any number of threads, resumed and replayed.
name=evolve_kits
source "$(dirname "$0")/golden.bash"
cd "$scratch"
mkdir parts
cat >parts/few.kit <<'K'
use "bricks";
space room = box(6 studs, 3 bricks, 3 studs);
rule trim at stud, tube = 3005 in 15;
K
cat >parts/wall.kit <<'K'
# Whose rule is bred.
use "few.kit";
rule bred at stud, tube = 3005 # one; by one
  ;
rule kept at stud, tube = 3004;
model wall {
  inside room and not box(2 studs, 2 bricks, 1 stud);
  start stud at (10, 0, 20) by bred;
  search greedy;
  require fill = 1, components = 1;
  minimize elements;
}
test wall { expect elements < 54; }
K
cat >rules.bnf <<'G'
%dialect ge
<rules> ::= 'rule bred at stud, tube = '<all>';\n'
<all> ::= <one> | <one>' | '<all>
<one> ::= 3001 | 3003 | 3004 | 3005 | '3010 with kept' | '3004 with trim' | 3006
G
cat >wall.study <<'S'
evolution {
  grammar "rules.bnf"
  place "parts/wall.kit"
  population 24
  generations 6
  seed 5
}
S
"$TARTAN" evolve wall.study -o one --threads 1 >one.txt || fail 'rules cannot be bred'
"$TARTAN" evolve wall.study -o two --threads 2 >/dev/null || fail 'rules cannot be bred by two threads'
cmp -s one/run.sqlite two/run.sqlite || fail 'two threads breed other rules than one'
for file in 1.kit 1.svg scores.csv; do cmp -s "one/best/$file" "two/best/$file" || fail "two threads write another $file"; done
"$TARTAN" evolve wall.study -o parted --generations 2 >/dev/null && "$TARTAN" evolve wall.study -o parted --resume >/dev/null || fail 'breeding rules is not resumed'
cmp -s one/run.sqlite parted/run.sqlite || fail 'resuming breeds other rules'
best=$(sed -n '2s/1.kit,\([0-9]*\),.*/\1/p' one/best/scores.csv) score=$(sed -n '2s/.*,//p' one/best/scores.csv)
"$TARTAN" runs replay one "$best" >replayed || fail 'rules cannot be replayed'
grep -q '^rule bred at stud, tube = ' replayed || fail 'what is replayed is no rule'
is 'codes of the best kit' "$("$TARTAN" check one/best/1.kit 2>&1 | grep -oE '(error|warning)\[[EW][0-9]+\]' || true)" 'warning[W193]' # nothing comes to `kept'
is 'rules of the name' "$(grep -c '^rule bred' one/best/1.kit)" 1
grep -q '^rule kept' one/best/1.kit || fail 'another rule is gone'
is 'parts of the best' "$("$TARTAN" place one/best/1.kit | head -n 1)" "$score parts"
"$TARTAN" test one/best/1.kit >/dev/null || fail 'the best kit does not pass its test'
grep -q '<path' one/best/1.svg || fail 'the best has no picture'
sed 's/seed 5/selection nsga2/' wall.study >front.study
"$TARTAN" evolve front.study -o front --generations 2 >/dev/null || fail 'length is not weighed apart'
is 'objectives' "$(head -n 1 front/best/scores.csv)" 'file,individual,objective,length'
printf '1 2*3\n\n' | "$TARTAN" breed wall.study -o chosen >/dev/null || fail 'rules cannot be chosen by hand'
grep -q '<path' chosen/sheet-0001.svg || fail 'no models on the sheet'
# What scores depend on: the kit, and what it uses.
printf '# changed\n' >>parts/few.kit
"$TARTAN" evolve wall.study -o one --resume --generations 8 >/dev/null 2>err && fail 'a changed kit goes unseen'
grep -q 'few.kit' err || fail "the changed file is not named: $(cat err)"
"$TARTAN" evolve wall.study -o one --resume --rescore --generations 8 >/dev/null || fail 'a changed kit cannot be scored anew'
sed -i 's/elements;/elements \/ (cells - cells);/' parts/wall.kit
"$TARTAN" evolve wall.study -o none --generations 1 >none.txt || fail 'an objective without a value ends the run'
grep -q 'no individual has a score' none.txt || fail "it does not say that nothing has a value: $(cat none.txt)"
exit $((failures > 0))
