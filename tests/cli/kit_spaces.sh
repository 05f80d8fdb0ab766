#!/usr/bin/env bash
# Spaces from files: meshes, height maps and models fill the cells that shapes of the same form do, and modules need no file.
name=kit_spaces
source "$(dirname "$0")/golden.bash"
python3 "$here/kit_spaces.py" "$scratch"

# same NAME SPACE OTHER: both spaces have the same cells, which parts of one cell fill.
same() {
    local space
    for space in "$2" "$3"; do
        runs=$((1 - runs))
        cat >"$scratch/it.kit" <<K
unit 10 x 8 x 10;
length stud = 20; length brick = 24;
connector side joins side turns 1;
part dot { fill 10 x 8 x 10 at (5, 0, 5); side up; side down at (0, -8, 0); side left; side right at (10, 0, 0); side front; side back at (0, 0, 10); }
part 3003 { fill 40 x 24 x 40; side up; }
part 3001 { fill 80 x 24 x 40; side up; }
rule any at side = dot;
model it { inside $space; start side at (10, 0, 10) by any; start side at (-30, 0, 10) by any; start side at (0, 0, 0) by any;
  require fill = 1, elements > 5; }
K
        "$TARTAN" place "$scratch/it.kit" -o - | grep '^1' >"$scratch/$runs.ldr" || fail "$1 is not placed in $space"
    done
    [ -s "$scratch/1.ldr" ] && cmp -s "$scratch/0.ldr" "$scratch/1.ldr" || fail "$1 is not as its shape"
}
runs=0
same box 'mesh("cube.obj", 2 bricks)' 'box(48, 2 bricks, 48)'
same inside_out 'mesh("inside_out.obj", 2 bricks)' 'box(48, 2 bricks, 48)'
same in_millimetres 'mesh("long.obj")' 'box(25, 50, 12.5)'
same upright 'mesh("long.obj" y up, 40)' 'box(80, 40, 160)'
same lying 'mesh("long.obj" z up, 42)' 'box(21, 42, 10.5)'
same turned 'mesh("long.obj" y up, 40) turn 1 at (1 stud, 0, 0)' 'box(160, 40, 80) at (1 stud, 0, 0)'
same repeated 'mesh("cube.obj", 2 bricks) repeat 3 by (2 studs, 1 brick, 0)' 'box(48, 2 bricks, 48) repeat 3 by (2 studs, 1 brick, 0)'
same joined 'mesh("crossing.obj", 80)' 'box(80, 40, 80) at (-20, 0, 0) or box(80, 40, 80) at (20, 40, 0) or box(80, 20, 80) at (20, 20, 0)'
same ball 'mesh("ball.obj", 161)' 'sphere(80.5) at (0, 80.5, 0)'
same flat 'heightmap("flat.pgm", 160, 4 bricks, 120)' 'box(160, 2 bricks, 120)'
same steep 'heightmap("steps.pgm", 160, 4 bricks, 80)' 'box(80, 2 bricks, 80) at (-40, 0, 0) or box(80, 4 bricks, 80) at (40, 0, 0)'
same turned_hill 'heightmap("steps.pgm", 160, 4 bricks, 80) turn 1' 'box(80, 2 bricks, 80) at (0, 0, -40) or box(80, 4 bricks, 80) at (0, 0, 40)'
for picture in grey rgb deep deep_rgb clear palette; do
    same $picture "heightmap(\"$picture.png\", 120, 4 bricks, 80)" 'heightmap("grey.pgm", 120, 4 bricks, 80)'
done
same luminance 'heightmap("green.png", 160, 10 bricks, 120)' 'heightmap("luminance.pgm", 160, 10 bricks, 120)'
same model 'model("two.ldr")' 'box(2 studs, 1 brick, 2 studs) or box(4 studs, 1 brick, 2 studs) at (0, 1 brick, 0)'
same model_turned 'model("two.ldr") turn 3' 'box(2 studs, 1 brick, 2 studs) or box(2 studs, 1 brick, 4 studs) at (0, 1 brick, 0)'

cat >"$scratch/on.kit" <<'K'
use "bricks";
rule any at stud = 3003;
model on "goes on" { inside box(4 studs, 4 bricks, 2 studs) or model("two.ldr"); start "two.ldr" by any; colour 4; }
model searched "goes on" { inside box(4 studs, 4 bricks, 2 studs); start "two.ldr" by any; search anneal 20; minimize open; stock 3003 <= 4; }
model above { inside box(4 studs, 4 bricks, 2 studs) at (0, 1 brick, 0); start "two.ldr" by any; }
model above_searched { inside box(4 studs, 4 bricks, 2 studs) at (0, 1 brick, 0); start "two.ldr" by any; search beam 2; }
model many { inside box(4 studs, 4 bricks, 2 studs); start "two.ldr" by any; stock 3003 <= 0; }
K
golden goes_on "tartan place $scratch/on.kit --model on -o - | sed 's/rules.*//'"
golden searched "tartan place $scratch/on.kit --model searched -o $scratch/on.ldr --stats && tartan inspect $scratch/on.ldr --kit bricks"
golden outside "tartan place $scratch/on.kit --model above"
golden outside_searched "tartan place $scratch/on.kit --model above_searched"
golden no_stock "tartan place $scratch/on.kit --model many"

# Pictures that are none.
for picture in short bare vast long wrong; do
    sed "s/two.ldr\" by any; colour 4/two.ldr\" by any/; s/or model(\"two.ldr\")/and heightmap(\"$picture.png\", 120, 4 bricks, 80)/" "$scratch/on.kit" >"$scratch/$picture.kit"
    golden png_$picture "tartan check $scratch/$picture.kit"
done

# A module has the cells in it.
cat >"$scratch/hill.kit" <<'K'
use "bricks";
rule any at stud, tube = 3003 | 3005;
model hill { inside heightmap("steps.pgm", 160, 4 bricks, 80) and mesh("ball.obj", 300) or model("two.ldr") at (0, 0, 1 stud);
  start "two.ldr" by any; }
K
"$TARTAN" build "$scratch/hill.kit" -o "$scratch/hill.tnb"
"$TARTAN" place "$scratch/hill.kit" -o "$scratch/source.ldr"
rm "$scratch"/*.pgm "$scratch"/*.obj "$scratch/two.ldr"
"$TARTAN" place "$scratch/hill.tnb" -o "$scratch/module.ldr"
cmp "$scratch/source.ldr" "$scratch/module.ldr" || fail 'the module places other parts'
golden listed "tartan disasm $scratch/hill.tnb | grep mask"
exit $((failures > 0))
