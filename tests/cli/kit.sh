#!/usr/bin/env bash
# Kits: what place, test, build and disasm make of them, what is said where a model cannot be placed, and properties of every placed model,
# checked by a program that shares nothing with the engine (kit_check.py).
# Slow under sanitizers.
name=kit
source "$(dirname "$0")/golden.bash"
cp "$here/../fuzz/corpus/kit/tower.kit" "$here/../fuzz/corpus/kit/own.kit" "$scratch"
cat >"$scratch/small.kit" <<'X'
unit 10 x 8 x 10;
connector stud joins tube turns 4 every 20;
connector tube joins stud turns 4 every 20;
part 3005 "Brick 1 x 1" { fill 20 x 24 x 20; stud up; tube down at (0, -24, 0); mass 0.4; price 0.1; }
part 3004 "Brick 1 x 2" { fill 40 x 24 x 20; studs up 2 x 1; tubes down 2 x 1 at (0, -24, 0); mass 0.8; price 0.2; }
space room = box(40, 48, 20);
rule up at stud = 3004 in 4 | 3005;
model post "two parts" { inside room; start stud at (10, 0, 0) by up; require elements = 2, components = 1; }
model high { inside box(20, 72, 20); start stud at (0, 0, 0) by up; require elements = 2, count(3004) > 0 or mass < 1; }
model none { inside box(20, 8, 20); start stud at (0, 0, 0) by up; }
test post { expect price = 0.4 and joints = 2, height = 48, balance = 10; }
X
golden place "tartan place $scratch/small.kit --model post"
golden ldraw "tartan place $scratch/small.kit -m post -o - | sed 's/rules.*//'"
golden list "tartan place $scratch/small.kit -m post -o $scratch/post.csv && cat $scratch/post.csv"
golden trace "tartan place $scratch/small.kit -m post --trace"
golden program "tartan place $scratch/small.kit -m post --program -"
golden test "tartan test $scratch/small.kit"
golden requires "tartan place $scratch/small.kit --model high"
golden nothing "tartan place $scratch/small.kit --model none"
golden no_model "tartan place $scratch/small.kit --model pots"
golden which_model "tartan place $scratch/small.kit"
golden model_of_pcfg "tartan place ../../../examples/brick-wall/wall.pcfg ../../../examples/brick-wall/bricks.pcfg --model post"
golden no_plan "tartan count $scratch/small.kit"
golden disasm "tartan build $scratch/small.kit -o $scratch/small.tnb && tartan disasm $scratch/small.tnb | tail -n +3"
golden format "tartan fmt - --notation kit <../../fuzz/corpus/kit/own.kit"

# As a connection grammar: the same parts in the same order, for plain rules; what cannot be said there is refused.
sed 's/(3004 in 71.*0.1\])/3004/; s/(3005 in 71.*\])/3005/' "$here/../../examples/gatehouse/gatehouse.kit" >"$scratch/plain.kit"
cat >"$scratch/gap.kit" <<'X'
use "bricks";
rule up at stud = 3005;
model gap { inside box(40, 48, 40) and not box(10, 48, 40) at (-5, 0, 0); start stud at (10, 0, 10) by up; }
X
for kit in plain small; do
    "$TARTAN" export "$scratch/$kit.kit" --pcfg -m "$([ $kit = plain ] && echo gatehouse || echo post)" -o "$scratch/exported.pcfg"
    "$TARTAN" place "$scratch/exported.pcfg" -o "$scratch/exported.ldr" || fail "what was exported of $kit is not placed"
    "$TARTAN" place "$scratch/$kit.kit" -m "$([ $kit = plain ] && echo gatehouse || echo post)" -o "$scratch/own.ldr"
    cmp <(grep ^1 "$scratch/own.ldr") <(grep ^1 "$scratch/exported.ldr") || fail "$kit as a connection grammar places other parts"
done
golden export "tartan export $scratch/small.kit --pcfg --model post"
golden export_draws "tartan export $scratch/tower.kit --pcfg"
golden export_gap "tartan export $scratch/gap.kit --pcfg"
# Places in connection grammars count half studs and plates, whatever a kit's cells are.
cat >"$scratch/wide.kit" <<'K'
unit 20 x 24 x 20;
connector stud joins tube;
connector tube joins stud;
part post { fill 40 x 24 x 40; tube down at (0, -24, 0); }
rule up at stud = post;
model wide { inside box(80, 24, 80); start stud at (20, 0, 20) by up; }
K
golden export_unit "tartan export $scratch/wide.kit --pcfg"
golden export_pcfg "tartan export ../../../examples/brick-wall/wall.pcfg --pcfg"
golden export_both "tartan export $scratch/small.kit --pcfg --prolog"

# Three ways to the same bytes, and the same again; another seed draws other colours.
cd "$scratch"
for seed in 0 1 4294967295; do
    "$TARTAN" place tower.kit --seed $seed -o auto.ldr --program auto.txt
    "$TARTAN" build tower.kit -o tower.tnb
    "$TARTAN" place tower.kit --seed $seed -o vm.ldr --engine vm --program vm.txt
    "$TARTAN" place tower.tnb --seed $seed -o module.ldr --program module.txt
    for one in vm module; do
        cmp auto.ldr $one.ldr || fail "seed $seed: $one is another model"
        cmp auto.txt $one.txt || fail "seed $seed: $one is another program"
    done
    cp auto.ldr "seed$seed.ldr"
done
! cmp -s seed0.ldr seed1.ldr || fail 'seeds 0 and 1 draw the same'

# The program of a model, in a grammar of one rule, makes the model again.
{ printf 'All -> %s' "'PlaceBoundingBox(100,100,100)' " && sed "s/[^ ]*/'&'/g" auto.txt; } >again.pcfg
"$TARTAN" place again.pcfg -o again.ldr
cmp <(grep ^1 auto.ldr) <(grep ^1 again.ldr) || fail 'a program placed again is another model'

python3 "$here/kit_check.py" "$TARTAN" "$here/../../stdlib/bricks.kit" || fail 'a model of random kits is wrong'
exit $((failures > 0))
