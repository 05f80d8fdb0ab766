#!/usr/bin/env bash
# Parts that are read from an LDraw library are those that a kit tells by hand: cells, studs and tubes; and modules need no library.
name=kit_ldraw
source "$(dirname "$0")/golden.bash"
library=$scratch/library
mkdir -p "$library/parts/s" "$library/p"
cp "$here"/../diagnostics/kit-parts/{stud,stud4,box}.dat "$library/p"
printf '0 Stud Tube Solid\n' >"$library/p/stud3.dat"
# Bricks of ours: WIDTH of studs, TITLE, NAME; two-wide ones have tubes, the others thin ones.
brick() {
    local wide=$1 deep=$2 file=$3 x z
    echo "0 Brick $deep x $wide"
    echo "1 16 0 0 0 $((10 * wide)) 0 0 0 24 0 0 0 $((10 * deep)) box.dat"
    for ((z = 0; z < deep; z++)); do
        for ((x = 0; x < wide; x++)); do
            echo "1 16 $((20 * x - 10 * wide + 10)) 0 $((20 * z - 10 * deep + 10)) 1 0 0 0 1 0 0 0 1 s\\$file.dat"
        done
    done
    for ((x = 1; x < wide; x++)); do
        if [ "$deep" = 2 ]; then
            echo "1 16 $((20 * x - 10 * wide)) 4 0 1 0 0 0 -5 0 0 0 1 stud4.dat"
        else
            echo "1 16 $((20 * x - 10 * wide)) 4 0 1 0 0 0 -5 0 0 0 1 stud3.dat"
        fi
    done
}
printf '0 One stud, in a sub-file of its own\n1 16 0 0 0 1 0 0 0 1 0 0 0 1 stud.dat\n' >"$library/parts/s/one.dat"
brick 4 2 one >"$library/parts/3001.dat"
brick 2 2 one >"$library/parts/3003.dat"
brick 2 1 one >"$library/parts/3004.dat"
brick 1 1 one >"$library/parts/3005.dat"
cat >"$scratch/own.kit" <<'K'
unit 10 x 8 x 10;
length stud = 20; length brick = 24;
connector stud joins tube turns 4; connector tube joins stud turns 4;
part 3001 from ldraw "3001.dat";
part 3003 from ldraw "3003.dat" { mass 1.1; }
part 3004 from ldraw "3004.dat";
part 3005 from ldraw "3005.dat";
model it { inside box(8 studs, 3 bricks, 4 studs); start stud at (-10, 0, 30) by any; }
rule any at stud, tube = 3001 | 3003 | 3004 | 3005;
K
export LDRAWDIR=$library
golden measured "tartan place $scratch/own.kit -o $scratch/own.ldr && tartan inspect $scratch/own.ldr --kit bricks && tartan count $scratch/own.kit --parts 3 --part 3001"
"$TARTAN" build "$scratch/own.kit" -o "$scratch/own.tnb"
export LDRAWDIR=$scratch/none
# The option goes before the variable, in every command that reads a kit.
for words in "place --ldraw $library $scratch/own.kit" "check --ldraw $library $scratch/own.kit" "disasm --ldraw $library $scratch/own.kit" \
    "build --ldraw $library $scratch/own.kit -o $scratch/optioned.tarm" "count --ldraw $library $scratch/own.kit --parts 1" \
    "enumerate --ldraw $library $scratch/own.kit --parts 1 -o -" "export --ldraw $library $scratch/own.kit --pcfg -o -" \
    "inspect --ldraw $library $scratch/own.ldr --kit $scratch/own.kit" \
    "report --ldraw $library $scratch/own.kit -o $scratch/page.html" "test --ldraw $library $scratch/own.kit"; do
    $TARTAN $words >"$scratch/said" 2>&1
    grep -qE "LDRAWDIR|no option" "$scratch/said" && fail "tartan $words does not look in the library: $(cat "$scratch/said")"
done
# A name that the library lacks has the nearest of its parts.
printf 'use "bricks";\npart long from ldraw "3O01.dat";\n' >"$scratch/near.kit"
golden near_part "tartan check --ldraw $library $scratch/near.kit"
golden no_folder "tartan place --ldraw $scratch/nowhere $scratch/own.kit"
"$TARTAN" place "$scratch/own.tnb" -o "$scratch/module.ldr"
cmp "$scratch/own.ldr" "$scratch/module.ldr" || fail 'the module places other parts'
golden no_library "tartan check $scratch/own.kit"
exit $((failures > 0))
