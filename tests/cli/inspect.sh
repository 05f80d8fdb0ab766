#!/usr/bin/env bash
# tartan inspect: what `place` wrote has nothing to be said of; models made by hand, with sub-files and all that can be wrong with them.
# Needs the parts: draw mesh
name=inspect
source "$(dirname "$0")/golden.bash"
cp "$here/../fuzz/corpus/kit/tower.kit" "$here/../../examples/gatehouse/gatehouse.kit" "$scratch"
cat >"$scratch/hand.mpd" <<'X'
0 FILE hand.ldr
0 Two posts, a beam, one brick too many
1 4 0 0 0 1 0 0 0 1 0 0 0 1 post.ldr
1 1 60 0 0 1 0 0 0 1 0 0 0 1 POST.LDR
1 14 30 -48 0 1 0 0 0 1 0 0 0 1 3010.dat
1 14 30 -56 40 0.0001 0 -1 0 1 0 1 0 0.0001 3005.DAT
1 15 20.4 -24 0 1 0 0 0 1 0 0 0 1 3004.dat
1 15 33 -24 0 1 0 0 0 1 0 0 0 1 3004.dat
1 15 0 -24 0 1 0 0 0 0 -1 0 1 0 3004.dat
1 0x2112233 100 -24 0 1 0 0 0 1 0 0 0 1 s\4073.dat
0 FILE post.ldr
1 16 0 -24 0 1 0 0 0 1 0 0 0 1 3005.dat
0 STEP
1 16 0 0 0 1 0 0 0 1 0 0 0 1 3005.dat
X
golden hand "tartan inspect $scratch/hand.mpd --kit bricks"
golden json "tartan inspect $scratch/hand.mpd --kit bricks --json"
golden model "tartan inspect $scratch/hand.mpd --kit $scratch/gatehouse.kit --model gatehouse"
golden no_kit "tartan inspect $scratch/hand.mpd"
golden no_such_kit "tartan inspect $scratch/hand.mpd --kit brick"
golden plan_for_kit "tartan inspect $scratch/hand.mpd --kit table"
write() { printf "$2" >"$scratch/$1.ldr"; }
write colour '1 red 0 0 0 1 0 0 0 1 0 0 0 1 3005.dat\n'
write short '0 a model\n1 4 0 0 0 1 0 0 0 1 0 0 0 3005.dat\n'
write nameless '1 4 0 0 0 1 0 0 0 1 0 0 0 1\n'
write empty '0 nothing\n'
write itself '0 FILE a.ldr\n1 16 0 0 0 1 0 0 0 1 0 0 0 1 b.ldr\n0 FILE b.ldr\n1 16 0 0 0 1 0 0 0 1 0 0 0 1 b.ldr\n'
{
    printf '0 FILE main.ldr\n1 16 0 0 0 1 0 0 0 1 0 0 0 1 f0.ldr\n'
    for i in {0..9}; do
        printf '0 FILE f%d.ldr\n' "$i"
        for _ in {1..9}; do printf '1 16 0 0 0 1 0 0 0 1 0 0 0 1 f%d.ldr\n' $((i + 1)); done
    done
    printf '0 FILE f10.ldr\n0 nothing\n'
} >"$scratch/many.ldr"
for one in colour short nameless empty itself many; do
    golden $one "tartan inspect $scratch/$one.ldr --kit bricks"
done

# Sub-files that lie beside a model are read, also of one another; what a text holds itself comes first, and nothing is read from elsewhere.
mkdir "$scratch/beside" "$scratch/beside/inner"
cat >"$scratch/beside/outer.ldr" <<'X'
1 4 0 0 0 1 0 0 0 1 0 0 0 1 Wing.ldr
1 1 80 0 0 1 0 0 0 1 0 0 0 1 Wing.ldr
1 2 160 0 0 1 0 0 0 1 0 0 0 1 own.ldr
1 2 200 0 0 1 0 0 0 1 0 0 0 1 inner\gate.mpd
1 2 300 0 0 1 0 0 0 1 0 0 0 1 ../far.ldr
1 2 400 0 0 1 0 0 0 1 0 0 0 1 nowhere.ldr
0 FILE own.ldr
1 16 0 0 0 1 0 0 0 1 0 0 0 1 3005.dat
X
echo '1 16 0 0 0 1 0 0 0 1 0 0 0 1 3001.dat' | tee "$scratch/far.ldr" "$scratch/beside/own.ldr" >/dev/null
printf '1 16 0 0 0 1 0 0 0 1 0 0 0 1 3001.dat\n1 16 0 -24 0 1 0 0 0 1 0 0 0 1 tip.ldr\n' >"$scratch/beside/Wing.ldr"
echo '1 16 0 0 0 1 0 0 0 1 0 0 0 1 3003.DAT' >"$scratch/beside/tip.ldr"
printf '0 FILE gate.ldr\n1 16 0 0 0 1 0 0 0 1 0 0 0 1 post.ldr\n0 FILE post.ldr\n1 16 0 0 0 1 0 0 0 1 0 0 0 1 3004.dat\n' >"$scratch/beside/inner/gate.mpd"
golden beside "tartan inspect $scratch/beside/outer.ldr --kit bricks"
cat >"$scratch/beside/stands.kit" <<'X'
use "bricks";
rule none at stud = 3005 stop;
model pair { inside box(400, 200, 200) at (0, -24, 0); start "pair.ldr" by none; }
X
printf '1 4 0 0 0 1 0 0 0 1 0 0 0 1 wing.ldr\n' >"$scratch/beside/pair.ldr"
cp "$scratch/beside/Wing.ldr" "$scratch/beside/wing.ldr"
golden beside_kit "cd $scratch/beside && tartan place stands.kit -o - | grep ^1"
printf '1 4 0 0 0 1 0 0 0 1 0 0 0 1 again.ldr\n' >"$scratch/beside/again.ldr"
golden beside_itself "tartan inspect $scratch/beside/again.ldr --kit bricks"
printf '0 a wing\n1 16 0 0 0 1 0 0 0 1 0 0 0 3001.dat\n' >"$scratch/beside/Wing.ldr"
golden beside_wrong "tartan inspect $scratch/beside/outer.ldr --kit bricks"

# Of what was placed: the same figures, no overlaps, and its conditions hold; the pictures are the same twice.
cd "$scratch"
for kit in tower gatehouse; do
    "$TARTAN" place $kit.kit -o $kit.ldr -o one.svg -o one.png -o one.obj -o one.stl -o one.ply -o one.glb
    "$TARTAN" place $kit.kit -o two.svg -o two.png -o two.obj -o two.stl -o two.ply -o two.glb
    for ending in svg png obj stl ply glb; do
        cmp one.$ending two.$ending || fail "two files .$ending of $kit differ"
    done
    "$TARTAN" inspect $kit.ldr --kit $kit.kit --model $kit -o found.svg >found.txt || fail "$kit does not meet its own conditions"
    is "overlaps of $kit" "$(awk '$2 == "overlaps" { print $1 }' found.txt)" 0
    is "parts of $kit" "$(awk '$2 == "elements" { print $1 }' found.txt)" "$(grep -c '^1 ' $kit.ldr)"
    grep -q '<svg' found.svg || fail "no picture of $kit"
done
# The mesh is closed, and as large as the cells that are filled: 10 x 8 x 10 LDU of 0.4 mm.
python3 - one.obj found.txt <<'PY' || fail 'the mesh is not closed, or of another volume'
import sys
points, edges, volume = [], {}, 0
for line in open(sys.argv[1]):
    word, *rest = line.split() or [""]
    if word == "v":
        points.append([float(x) for x in rest])
    elif word == "f":
        corners = [int(x.split("/")[0]) - 1 for x in rest]
        for a, b in zip(corners, corners[1:] + corners[:1]):
            edges[a, b] = edges.get((a, b), 0) + 1
        p = [points[c] for c in corners]
        for b, c in zip(p[1:], p[2:]):
            a = p[0]
            volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
cells = float(next(line.split()[0] for line in open(sys.argv[2]) if line.split()[-1] == "cells"))
assert all(n == 1 and edges.get((b, a)) == 1 for (a, b), n in edges.items())
assert abs(volume - cells * 4 * 3.2 * 4) < 1e-6 * volume, (volume, cells)
PY
"$TARTAN" place "$here/../../examples/brick-wall/wall.pcfg" "$here/../../examples/brick-wall/bricks.pcfg" -o wall.svg 2>err && fail 'a picture of parts without a shape'
grep -q E1318 err || fail "it does not say why: $(cat err)"
"$TARTAN" place "$here/../../examples/brick-wall/wall.pcfg" "$here/../../examples/brick-wall/bricks.pcfg" -o wall.ldr
is 'pieces of the wall of a connection grammar' "$("$TARTAN" inspect wall.ldr --kit bricks --json | python3 -c 'import json, sys; r = json.load(sys.stdin); print(r["components"], r["overlaps"], r["unknown"])')" '1 0 0'
printf '1 4 0 0 0 1 0 0 0 1 0 0 0 1 3005.dat\n1 4 0 -24 0 1 0 0 0 1 0 0 0 1 3005.dat\n' >"$scratch/two.ldr"
golden required "tartan inspect $scratch/two.ldr --kit bricks --require 'components = 1, floating = 0 and count(3005) = 2' | tail -n 1"
golden required_not "tartan inspect $scratch/two.ldr --kit bricks --require 'components = 1, count(3004) > 0 or height > 48, mass in 1..2' | tail -n 1"
golden required_unknown "tartan inspect $scratch/two.ldr --kit bricks --require 'count(3006) = 1'"
golden required_wrong "tartan inspect $scratch/two.ldr --kit bricks --require 'components ='"
# Names in LDraw files are the same in capitals or not; what is made of them has the kit's.
cat >"$scratch/capitals.kit" <<'K'
unit 10 x 8 x 10;
connector stud joins tube;
connector tube joins stud;
part Beam { fill 20 x 24 x 20; stud up; tube down at (0, -24, 0); }
rule up at stud = Beam;
model taller { inside model("capitals.ldr") or box(20, 120, 20); start "capitals.ldr" by up; }
K
printf '1 1 0 -24 0 1 0 0 0 1 0 0 0 1 BEAM.DAT\n1 1 0 -48 0 1 0 0 0 1 0 0 0 1 Beam.dat\n' >"$scratch/capitals.ldr"
golden capitals "tartan inspect $scratch/capitals.ldr --kit $scratch/capitals.kit --require 'count(Beam) = 2, joints = 1' | head -n 1; tartan export $scratch/capitals.ldr --kit $scratch/capitals.kit | grep -c Beam; tartan place $scratch/capitals.kit --model taller"
golden required_json "tartan inspect $scratch/two.ldr --kit bricks --json --require 'components = 2' --diagnostics json"
exit $((failures > 0))
