#!/usr/bin/env bash
# Designs of boxes: the table in three readings, with the volumes and parts that the notation's paper trail gives; requirements that
# fail; meshes of every kind, the same bytes twice, read again by a program that knows nothing of boxes.
set -euo pipefail
: "${TARTAN:?the binary to test}"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() {
    echo "$1"
    exit 1
}

stdlib=$PWD/stdlib
sed 's/ rigid;/;/' "$stdlib/table.solid" >"$scratch/flexible.solid"
sed 's/ rigid;/;/; s/^  symmetry.*/&\n  correct penetration;/' "$stdlib/table.solid" >"$scratch/penetration.solid"
cd "$scratch"
volume() { "$TARTAN" mesh "$1" --stats | awk '$1 == "volume" || $1 == "parts" { printf "%s %s ", $1, $2 } END { print "" }'; }
[ "$(volume table)" = 'parts 1 volume 84.982 ' ] || fail "the table: $(volume table)"
case $(volume flexible.solid) in 'parts 3 volume 52.19775 ') ;; *) fail "a flexible top: $(volume flexible.solid)" ;; esac
case $(volume penetration.solid) in 'parts 1 volume 66.55733333 ') ;; *) fail "by least penetration: $(volume penetration.solid)" ;; esac

# Requirements: what is met is counted, what is not is an error with the value that was found.
[ "$("$TARTAN" test table | tail -1)" = '2 passed, 0 failed' ] || fail 'the table fails its own requirements'
status=0
"$TARTAN" test flexible.solid >out 2>err || status=$?
[ "$status" = 1 ] || fail "a requirement that is not met gives $status"
grep -q 'error\[E1514\].*parts is 3' err || fail "it does not say what was found: $(cat err)"
"$TARTAN" test --json table | python3 -c 'import json, sys; assert json.load(sys.stdin)["solids"][0]["measures"]["parts"] == 1' || fail 'test --json'
"$TARTAN" explain table | grep -qx 'leg  by top  high y  7.4 -> 7' || fail 'explain does not say what the top does to the leg'
"$TARTAN" explain --json table | python3 -c 'import json, sys; assert json.load(sys.stdin)[0]["box"] == "leg"' || fail 'explain --json'

# Meshes: the same bytes twice, all kinds, cells with their names.
for kind in obj ply stl off om glb scad; do
    "$TARTAN" mesh table -o one.$kind && "$TARTAN" mesh table -o two.$kind
    cmp -s one.$kind two.$kind || fail "two meshes .$kind differ"
done
"$TARTAN" mesh table --cells -o cells.obj
grep -qx "g leg'xz" cells.obj || fail 'cells have no names'
"$TARTAN" mesh table --up y -o up.obj
python3 - one.obj up.obj cells.obj <<'PY' || fail 'a mesh is not closed, not outward, or not turned'
import collections, sys
def read(path):
    points, faces = [], []
    for line in open(path):
        words = line.split()
        if words[:1] == ["v"]: points.append(tuple(map(float, words[1:4])))
        if words[:1] == ["f"]: faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return points, faces
def volume(points, faces):
    total = 0
    for f in faces:
        for i in range(1, len(f) - 1):
            a, b, c = points[f[0]], points[f[i]], points[f[i + 1]]
            total += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return total
for path, axis in zip(sys.argv[1:], (2, 1, 2)):
    points, faces = read(path)
    edges = collections.Counter((f[i - 1], f[i]) for f in faces for i in range(len(f)))
    assert all(n == 1 and edges[b, a] == 1 for (a, b), n in edges.items()), path
    assert abs(volume(points, faces) - 84.982) < 1e-9, path
    assert max(p[axis] for p in points) == 7.5, path
PY

# A module does what its source does; one that was tampered with is refused.
"$TARTAN" build table -o table.tnb
"$TARTAN" mesh table.tnb -o module.obj && cmp -s one.obj module.obj || fail 'the module gives another mesh'
status=0
"$TARTAN" mesh table --solid chair -o no.obj 2>err || status=$?
[ "$status" = 1 ] && grep -q 'E1513' err || fail 'a design that is not there'
status=0
"$TARTAN" mesh lahave -o no.obj 2>err || status=$?
[ "$status" = 1 ] && grep -q 'E1413' err || fail 'a file without designs'
status=0
"$TARTAN" mesh table --grid 20 2>err || status=$?
[ "$status" = 2 ] && grep -q 'for fields' err || fail 'an option of fields that a design does not heed'
printf 'solid "no name" {}\nsolid x { box a from (0,0,0) to (1,1,1) ; }' >broken.solid
"$TARTAN" check broken.solid 2>err && fail 'a broken file passes'
{
    echo 'solid many {'
    for ((i = 0; i <= 100000; i++)); do echo "genes ($i, 0, 0, 1, 1, 1, 9, 0, 0);"; done
    echo '}'
} >many.solid
"$TARTAN" check many.solid 2>err && fail 'too many boxes pass'
grep -q 'error\[E1515\]' err || fail "too many boxes: $(head -1 err)"
"$TARTAN" fmt --check "$stdlib/table.solid" || fail 'the table is not laid out'
