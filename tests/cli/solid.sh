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
case $(volume penetration.solid) in 'parts 1 volume 66.5573333333 ') ;; *) fail "by least penetration: $(volume penetration.solid)" ;; esac

# Requirements: what is met is counted, what is not is an error with the value that was found.
[ "$("$TARTAN" test table | tail -1)" = '2 passed, 0 failed' ] || fail 'the table fails its own requirements'
status=0
"$TARTAN" test flexible.solid >out 2>err || status=$?
[ "$status" = 1 ] || fail "a requirement that is not met gives $status"
grep -q 'error\[E1514\].*parts is 3' err || fail "it does not say what was found: $(cat err)"
"$TARTAN" test --json table | python3 -c 'import json, sys; assert json.load(sys.stdin)["solids"][0]["measures"]["parts"] == 1' || fail 'test --json'
# What is asked for twice, by a design and the one that it begins with, is listed once; what has no value has no sign either. A requirement
# that names no measure has nothing to tell of.
cat >twice.solid <<'END'
solid first { box all at (0, 0, 0) size (1, 1, 1); measure sqrt(-1), volume; measure volume; }
solid then from first { measure volume, area; require sqrt(-1) < 2; }
END
[ "$("$TARTAN" test twice.solid 2>err | tr -s ' \n' ' ')" = 'first sqrt(-1) nan volume 1 then sqrt(-1) nan volume 1 area 6 0 passed, 1 failed ' ] ||
    fail 'measures that are asked for twice are not listed once'
[ "$("$TARTAN" test --json twice.solid 2>/dev/null | grep -o '"volume"' | wc -l)" = 2 ] || fail 'measures that are asked for twice are two keys'
# A measure's name is its words, however they are laid out.
printf 'solid wide { box all at (0, 0, 0) size (1, 1, 1); measure volume  # what it takes\n/area , width IN 0 .. 2, min( - width,1 ); }' >wide.solid
[ "$("$TARTAN" test wide.solid | tr -s ' \n' ' ')" = 'wide volume / area 0.1666666667 width in 0..2 1 min(-width, 1) -1 0 passed, 0 failed ' ] ||
    fail "names of measures hang on the layout: $("$TARTAN" test wide.solid)"
grep -q '`then` does not meet this$' err || fail "a requirement without measures: $(cat err)"
"$TARTAN" explain table | grep -qx 'leg  by top  high y  7.4 -> 7' || fail 'explain does not say what the top does to the leg'
"$TARTAN" explain --json table | python3 -c 'import json, sys; assert json.load(sys.stdin)[0]["box"] == "leg"' || fail 'explain --json'

# Meshes: the same bytes twice, all kinds, cells with their names.
for kind in obj ply stl off om glb 3mf scad dxf; do
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

# Vertices that share a place: in STL these move apart, unless --exact leaves them; every other file keeps them. Half of a
# DXF's edges are seen at most, and its layers are boxes.
printf 'solid edge { box a from (0, 0, 0) to (1, 1, 1); box b from (1, 1, 0) to (2, 2, 1); }\n' >edge.solid
"$TARTAN" mesh edge.solid -o edge.stl 2>err
grep -q '^note: 4 vertices that share a place moved' err || fail "vertices that share places: $(cat err)"
"$TARTAN" mesh edge.solid --exact -o exact.stl 2>err && [ ! -s err ] || fail "--exact says $(cat err)"
"$TARTAN" mesh edge.solid -o edge.dxf
python3 - edge.stl exact.stl edge.dxf <<'PY' || fail 'an STL whose boxes do not come apart, or a DXF without its layers'
import collections, struct, sys
def places(path):
    data = open(path, "rb").read()
    assert struct.unpack("<I", data[80:84])[0] == 24
    return [struct.unpack("<12f", data[84 + 50 * i:132 + 50 * i])[3:] for i in range(24)]
for path, most in zip(sys.argv[1:], (1, 2)):
    edges = collections.Counter()
    for t in places(path):
        corners = [t[i:i + 3] for i in (0, 3, 6)]
        for i in range(3):
            edges[corners[i - 1], corners[i]] += 1
    assert max(edges.values()) == most and all(edges[b, a] == n for (a, b), n in edges.items())
lines = [line.strip() for line in open(sys.argv[3])]
pairs = list(zip(lines[::2], lines[1::2]))
assert pairs.count(("0", "3DFACE")) == 24 and pairs[-1] == ("0", "EOF")
assert {value for code, value in pairs if code == "8"} == {"a", "b"}
hidden = sum(bin(int(value)).count("1") for code, value in pairs[pairs.index(("2", "ENTITIES")):] if code == "70")
assert hidden == 24 * 3 - 2 * 24, hidden # 12 edges of each cube are seen, from both sides
PY

# OpenMesh takes every face: also where boxes of a coarse lattice touch along edges and at corners.
python3 - >lattice.solid <<'PY'
import random
r = random.Random(7)
print("solid lattice {\n  symmetry x;")
for _ in range(120):
    print("  genes (%s);" % ", ".join(str(v) for v in [r.randint(0, 12) / 2 for _ in range(3)] + [r.randint(1, 4) / 2 for _ in range(3)] +
                                      [r.choice([0, 0.5, 1, 9]), r.choice([0, 45, 90, 180]), r.choice([0, 45, -45, 90])]))
print("}")
PY
"$TARTAN" mesh lattice.solid -o lattice.om --stats >out || fail 'OpenMesh does not take a design on a lattice'
[ "$(sed -n 's/^doubled *//p' out)" -gt 0 ] || fail 'nothing on a lattice touches along an edge'

# What is measured along an axis: a slope, a roof over half of it, a face that leans out at exactly 45 degrees.
cat >seen.solid <<'SOLID'
solid seen {
  box a from (0, 0, 0) to (1, 1, 1);
  box b from (1, 1, 0) to (2, 2, 1);
  box slope from (4, 0, 0) to (6, 2, 2) clip normal (1, 1, 0) through (5, 1, 0);
  box roof from (4, 3, 0) to (5, 3.5, 2);
  box under from (8, 1, 0) to (10, 3, 2) clip normal (1, -1, 0) through (9, 2, 0);
  measure support, overhang, shadow-x, shadow-y, shadow-z;
  require support = 0.8, overhang = 3, shadow-x = 7, shadow-y = 10, shadow-z = 6.5;
}
SOLID
[ "$("$TARTAN" test seen.solid | tail -1)" = '5 passed, 0 failed' ] || fail "what is seen along an axis: $("$TARTAN" test seen.solid 2>&1)"
"$TARTAN" check --test --json seen.solid 2>/dev/null | python3 -c 'import json, sys; r = json.load(sys.stdin); assert r["passed"] == 5 and r["solids"][0]["measures"]["overhang"] == 3' || fail 'check --test --json'
[ "$("$TARTAN" check --test seen.solid 2>/dev/null)" = "$("$TARTAN" test seen.solid)" ] || fail 'check --test and test differ'

# Pictures: of every kind, the same bytes twice; what is drawn of a module is what is drawn of its source.
if "$TARTAN" draw table -o one.svg 2>err; then
    for what in '' --sheet --before --exploded '--azimuth 30 --elevation 10 --width 200 --dpi 72'; do
        for kind in svg png pdf; do
            "$TARTAN" draw table $what -o one.$kind && "$TARTAN" draw table $what -o two.$kind
            cmp -s one.$kind two.$kind || fail "two pictures .$kind of $what differ"
        done
    done
    "$TARTAN" explain table -o steps.svg
    python3 -c 'import sys, xml.etree.ElementTree as t; [t.parse(f) for f in sys.argv[1:]]' one.svg steps.svg || fail 'a picture is no XML'
    "$TARTAN" build table -o table.tnb
    "$TARTAN" draw table.tnb -o module.svg && "$TARTAN" draw table -o one.svg
    sed 's/rules [0-9a-f]*//' module.svg | cmp -s - <(sed 's/rules [0-9a-f]*//' one.svg) || fail 'a module is drawn otherwise'
    for wrong in '--sheet --before' '--paper a3' '--scale 10' '--solid chair' '--library x'; do
        status=0
        "$TARTAN" draw table $wrong -o no.svg 2>err || status=$?
        [ "$status" != 0 ] && [ -s err ] && [ ! -e no.svg ] || fail "draw table $wrong gives $status"
    done
    status=0
    "$TARTAN" draw lahave-houses --sample 2 --exploded -o no.svg 2>err || status=$?
    [ "$status" = 2 ] && grep -q 'designs of boxes' err || fail "plans that are moved apart: $(cat err)"
    status=0
    "$TARTAN" explain table --json -o no.svg 2>err || status=$?
    [ "$status" = 2 ] || fail 'explain --json -o'
else
    grep -q 'E0907' err || fail "drawing: $(cat err)"
fi

# Slices: closed lines whose areas are the volume; holes turn the other way; a prism at a vertex's height.
"$TARTAN" slice table --layer 0.01 -o table.cli
cat >hollow.solid <<'SOLID'
solid hollow "a ring, a roof, and a foot that touches it along an edge" {
  model mm;
  symmetry x;
  box side from (1, 0, -2) to (2, 2, 2);
  box end from (0, 0, 1) to (1, 2, 2);
  box back from (0, 0, -2) to (1, 2, -1);
  box roof from (0, 2, -2) to (2, 3, 2) clip normal (1, 1, 0) through (2, 2, 0);
  box foot from (2, -1, 0) to (3, 0, 1);
}
SOLID
"$TARTAN" slice hollow.solid --layer 1 -o hollow.cli
python3 -B "$OLDPWD/tests/slices.py" hollow.cli 4 7 || fail 'the lines of a hollow design'
grep -qx '\$\$UNITS/1' hollow.cli || fail 'the unit of slices'
python3 - table.cli 0.01 84.982 <<'PY' || fail 'the areas of slices are not the volume'
import sys
total = 0
for line in open(sys.argv[1]):
    if line.startswith("$$POLYLINE/"):
        v = [float(x) for x in line[11:].split(",")[3:]]
        p = list(zip(v[::2], v[1::2]))
        total += sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(p, p[1:])) / 2
assert abs(total * float(sys.argv[2]) - float(sys.argv[3])) < 1e-3, total
PY
for kind in svg dxf cli; do
    "$TARTAN" slice table --layer 1 -o one.$kind && "$TARTAN" slice table --layer 1 -o two.$kind
    cmp -s one.$kind two.$kind || fail "slices .$kind differ"
done
for wrong in '--grid 9' '--layer 0' '--max-boxes 3' '--solid chair'; do
    status=0
    "$TARTAN" slice table --layer 1 $wrong -o no.svg 2>err || status=$?
    [ "$status" != 0 ] && [ -s err ] && [ ! -e no.svg ] || fail "slice table $wrong gives $status"
done

# A module does what its source does; one that was tampered with is refused.
"$TARTAN" build table -o table.tnb
"$TARTAN" mesh table.tnb -o module.obj && cmp -s one.obj module.obj || fail 'the module gives another mesh'
status=0
"$TARTAN" mesh table --max-boxes 11 --stats >out 2>err || status=$?
[ "$status" = 4 ] && grep -q 'error\[E1515\].*has 12 boxes' err && grep -q -- '--max-boxes 12' err || fail "a limit gives $status: $(cat err)"
for command in check test 'explain' 'mesh --stats'; do
    "$TARTAN" $command --max-boxes 12 table >/dev/null || fail "$command with the limit that it needs"
done
status=0
"$TARTAN" mesh table --exact -o no.obj 2>err || status=$?
[ "$status" = 2 ] && grep -q 'only an .stl' err || fail '--exact for a file that needs none'
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
status=0
"$TARTAN" check many.solid 2>err || status=$?
[ "$status" = 4 ] || fail "too many boxes give $status"
grep -q 'error\[E1515\]' err || fail "too many boxes: $(head -1 err)"
"$TARTAN" fmt --check "$stdlib/table.solid" || fail 'the table is not laid out'
