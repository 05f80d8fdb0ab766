#!/usr/bin/env bash
# Needs the parts: mesh store
# The example of surfaces that a program scores by finite elements: against the theory of beams, and a small population.
set -euo pipefail
if ! command -v ccx >/dev/null; then
    echo 'skipped: CalculiX is not here (Debian package calculix-ccx)'
    exit 0
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export TMPDIR=$work
cp "$(dirname "$0")"/../../examples/standing-surfaces/{sag.py,*.study} "$work"
cd "$work"

# A strip of 4 m that sticks out from a low wall sags by w l^4 / (8 E I) = 47.1 mm; shells that hardly bend across are near to that.
python3 - <<'PY'
points, faces = [], []
def at(*place):
    if place not in points:
        points.append(place)
    return points.index(place) + 1
for i in range(20):
    for j in range(5):
        x, y = (i / 5, (i + 1) / 5), (j / 5, (j + 1) / 5)
        faces.append((at(x[0], y[0], 0.01), at(x[1], y[0], 0.01), at(x[1], y[1], 0.01), at(x[0], y[1], 0.01)))
for j in range(5):
    faces.append((at(0.0, j / 5, 0), at(0.0, (j + 1) / 5, 0), at(0.0, (j + 1) / 5, 0.01), at(0.0, j / 5, 0.01)))
with open("strip.obj", "w") as out:
    for point in points:
        print("v %.9g %.9g %.9g" % point, file=out)
    for face in faces:
        print("f", *face, file=out)
PY
sagged=$(printf '{"id": 1, "mesh": "%s/strip.obj"}\n' "$work" | ./sag.py)
echo "$sagged" | python3 -c 'import json, sys; sag = json.load(sys.stdin)["score"]; sys.exit(not 47.1 * 0.95 < sag < 47.1 * 1.12)' || { echo "the strip: $sagged"; exit 1; }

# What cannot stand says so.
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n' >flat.obj
printf '{"id": 7, "mesh": "%s/flat.obj"}\n' "$work" | ./sag.py | grep -q '"error": "most of it lies on the ground"'
printf 'v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 5 3\nv 1 5 3\nv 1 5 4\nf 1 2 3 4\nf 5 6 7\n' >apart.obj
printf '{"id": 8, "mesh": "%s/apart.obj"}\n' "$work" | ./sag.py | grep -q '"error": "some faces do not stand on anything"'

# The same run at one thread and at two; the mean of what has a score is not that of the run without the program.
sed -i 's/population .*/population 8/; s/generations .*/generations 1/' breed.study
for threads in 1 2; do
    "$TARTAN" evolve breed.study -o $threads --run-programs --threads $threads >said
done
cmp 1/run.sqlite 2/run.sqlite || { echo 'another run at 2 threads'; exit 1; }
grep -v 'fitness program' breed.study >free.study
"$TARTAN" evolve free.study -o free >/dev/null
! cmp -s 1/stats.csv free/stats.csv || { echo 'the program counts for nothing'; exit 1; }
rm -rf 1 2 free
[ -z "$(ls -d tartan-* 2>/dev/null)" ] || { echo "left behind: $(ls -d tartan-*)"; exit 1; }
