#!/usr/bin/env bash
# tartan slice: outlines are closed, do not cross and turn the right way, whatever the field; files, limits, wrong use.
name=slice
source "$(dirname "$0")/golden.bash"
cd "$scratch"
cat >odd.field <<'FIELD'
use "shapes"
surface wall = max(gyroid(x, y, z, 1, 0.3), block(x, y, z, 6, 6, 6))
surface ring = pow(sqrt(x*x + y*y) - 4, 2) + z*z - 1.5
surface noisy = noise(3*x, 3*y, 3*z)
surface steps = floor(x)*floor(y) + 0.1*z - floor(z)%2
surface checks = sin(5*x)*sin(5*y)
surface none = x*x + 1
grid 60
unit mm
FIELD
# lines SURFACE LAYERS LINES LAYER: checked line by line, by both engines and any number of threads.
lines() {
    "$TARTAN" slice odd.field --surface "$1" --layer "$4" -o a.cli --threads 4 2>/dev/null || fail "$1 is not sliced"
    python3 -B "$here/../slices.py" a.cli "$2" "$3" || fail "$1: wrong lines"
    "$TARTAN" slice odd.field --surface "$1" --layer "$4" -o b.cli --threads 1 --engine vm 2>/dev/null
    cmp a.cli b.cli || fail "$1: another engine gives other slices"
}
lines wall 14 114 1
lines ring 28 8 0.5
lines noisy 10 1874 1.5
lines steps 10 13 1.5
lines checks 10 2420 1.5

# On a ball every point lies on the circle of its layer, to a ten-millionth of the grid's spacing.
printf 'surface ball = x*x + y*y + z*z - 25 box (-6, -6, -6)..(6, 6, 6) grid 41 unit in' >ball.field
"$TARTAN" slice ball.field --layer 0.75 -o ball.cli
python3 - ball.cli <<'PYTHON' || fail "points off the ball"
import math, sys
for line in open(sys.argv[1]):
    if line.startswith("$$LAYER/"):
        z = float(line[8:])
    if line.startswith("$$POLYLINE/"):
        numbers = [float(word) for word in line[11:].split(",")[3:]]
        moved = sum(abs(math.hypot(*p) - math.sqrt(25 - z * z)) > 1e-7 * 0.3 for p in zip(numbers[0::2], numbers[1::2]))
        assert moved == 0, (z, moved)
PYTHON
golden ball "tartan slice $scratch/ball.field --layer 4 --grid 6 -o - --format cli"
golden svg "tartan slice $scratch/ball.field --layer 6 --grid 5 -o - --format svg"
"$TARTAN" slice ball.field --layer 3 -o ball.dxf
is 'polylines' "$(grep -c '^POLYLINE' ball.dxf)" 4
grep -q '^layer_0004' ball.dxf || fail 'a layer of the drawing is missing'
"$TARTAN" slice ball.field --layer 3 -o layers/
is 'files' "$(ls layers)" "$(printf 'layer-000%s.svg\n' 1 2 3 4)"
"$TARTAN" slice ball.field --layer 3 -o layers --format dxf
is 'more files' "$(ls layers/*.dxf | wc -l)" 4
if command -v xmllint >/dev/null; then
    xmllint --noout layers/*.svg || fail 'an SVG is not well-formed'
fi
"$TARTAN" build ball.field -o ball.tnb
"$TARTAN" slice ball.tnb --layer 3 -o module.dxf
cmp module.dxf ball.dxf || fail 'the module gives other slices'
golden cut "tartan slice $scratch/odd.field --surface noisy --layer 5 -o $scratch/x.svg"
golden jumps "tartan slice $scratch/odd.field --surface steps --layer 5 -o $scratch/x.svg"
golden none "tartan slice $scratch/odd.field --layer 5 -o - --format cli"
golden no_layer "tartan slice $scratch/ball.field -o $scratch/x.svg"
golden no_output "tartan slice $scratch/ball.field --layer 1"
golden wrong_output "tartan slice $scratch/ball.field --layer 1 -o $scratch/x.obj"
golden wrong_layer "tartan slice $scratch/ball.field --layer 0 -o $scratch/x.svg"
golden thin_layer "tartan slice $scratch/ball.field --layer 1e-7 -o $scratch/x.svg"
golden samples "tartan slice $scratch/ball.field --layer 0.001 --max-samples 1000000 -o $scratch/x.svg"
golden no_surface "tartan slice square --layer 1 -o $scratch/x.svg"
finish
