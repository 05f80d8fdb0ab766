#!/usr/bin/env bash
# Needs the parts: draw mesh
# tartan grow: every format read back, options in the words of studies, limits, rest, sheets, the same bytes at any number of threads.
# Slow under sanitizers.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
source=$PWD
cd "$scratch"
fail() {
    echo "$1"
    exit 1
}
run() {
    "$TARTAN" "$@" 2>stderr || { cat stderr; fail "tartan $*"; }
}

cp "$source/stdlib/square.hemls" "$source/examples/growing-surfaces/draped.study" .

# Each format holds the same surface: 256 faces of a square after four steps (512 triangles).
for format in obj ply stl off om glb; do
    run grow square.hemls -n 4 -o "four.$format"
    run grow square.hemls -n 4 -f "$format" -o - >"piped"
    cmp "four.$format" piped
    [ ! -s stderr ] || fail "writing $format says something"
done

# Cut into triangles, two faces of this mesh share a diagonal: files that take any triangles hold them, and what reworks
# a mesh refuses it with a number.
printf 'A + A + A\nA -> [+ A] [& A] ~ A B\nB -> [/ \\ A] - & A ^ + [^ A] B\nAngle 36\nBranchAngle 180\n' >shared.hemls
for format in obj ply stl; do run grow shared.hemls -n 3 --triangulate -o "shared.$format"; done
triangles=$(grep -c '^f ' shared.obj)
[ "$(stat -c %s shared.stl)" = $((84 + 50 * triangles)) ] || fail "the STL file does not hold $triangles triangles"
for options in '-f off --triangulate' '-f om --triangulate' '-f stl --decimate 10'; do
    # shellcheck disable=SC2086 # words of options
    "$TARTAN" grow shared.hemls -n 3 $options -o refused 2>said && fail "$options takes a mesh that is no surface"
    grep -q 'error\[E0845\]' said || { cat said; fail "$options: the error has no number"; }
    [ ! -e refused ] || fail "$options: the file is half written"
done
if command -v assimp >/dev/null; then
    for format in obj ply stl off glb; do
        assimp info "four.$format" >info || fail "assimp cannot read $format"
        grep -qE '^Faces: +512' info || { cat info; fail "assimp finds other faces in $format"; }
    done
fi

# OpenMesh reads each back as a boundary: a closed box of it would be a solid, this sheet is a membrane that stops a fall.
for format in obj ply stl off om; do
    run grow square.hemls -n 3 --start '0 0 1' --gravity '0 0 -0.4' --boundary "mesh \"four.$format\" stop" --stats json >stats
    python3 - <<'CHECK' || fail "the boundary read from $format does not stop what falls"
import json
last = json.load(open("stats"))[-1]
assert last["F"] == 64 and last["fitness"]["undulation"] < 1.3, last
CHECK
done

# DXF: every edge once, in polylines as long as they go; an outline is one closed line; what is not level is in space.
run grow koch -n 3 --scale 1 --lines -o koch.obj
run grow koch -n 3 --scale 1 -o koch.dxf
run grow square.hemls -n 3 --lines -o grid.obj
run grow square.hemls -n 3 -o grid.dxf
run grow draped.study -n 3 --lines -o hung.obj
run grow draped.study -n 3 -o hung.dxf
run grow timed -n 3 --groups -o timed.dxf
python3 - <<'CHECK' || fail 'a DXF does not hold what the mesh holds'
def read_obj(name):
    vertices, lines = [], []
    for row in open(name):
        word, *rest = row.split()
        if word == "v":
            vertices.append(tuple(round(1e8 * float(c) + 0.123) for c in rest))
        elif word == "l":
            lines.append(frozenset(vertices[int(i) - 1] for i in rest))
    return lines
def read_dxf(name):
    rows = open(name).read().splitlines()
    pairs = list(zip((int(c) for c in rows[::2]), rows[1::2]))
    assert len(rows) % 2 == 0 and pairs[-1] == (0, "EOF") and (1, "AC1009") in pairs
    layers, polylines, kind = set(), [], None
    for i, (code, value) in enumerate(pairs):
        if code == 0:
            kind = value
            if kind == "POLYLINE":
                polylines.append({"points": []})
            elif kind == "VERTEX":
                polylines[-1]["points"].append([None] * 3)
        elif kind == "LAYER" and code == 2:
            layers.add(value)
        elif kind == "POLYLINE" and code in (8, 70):
            polylines[-1][code] = value if code == 8 else int(value)
        elif kind == "VERTEX" and code in (10, 20, 30):
            polylines[-1]["points"][-1][code // 10 - 1] = round(1e8 * float(value) + 0.123)
    assert {p[8] for p in polylines} <= layers
    return polylines
def edges(polylines):
    out = []
    for p in polylines:
        points = [tuple(q) for q in p["points"]]
        out += [frozenset(e) for e in zip(points, points[1:] + points[:1] if p[70] & 1 else points[1:])]
    return out
for name in "koch", "grid", "hung":
    lines, found = read_obj(name + ".obj"), edges(read_dxf(name + ".dxf"))
    assert len(found) == len(set(found)) == len(lines) and set(found) == set(lines), name
koch, grid, hung, timed = (read_dxf(n + ".dxf") for n in ("koch", "grid", "hung", "timed"))
assert len(koch) == 1 and koch[0][70] == 1 and len(koch[0]["points"]) == 192
assert len(grid) == 18 and {p[8] for p in grid} == {"A", "B"} and {p[70] for p in grid} == {0}
assert {p[70] & 8 for p in hung} == {0, 8} or {p[70] & 8 for p in hung} == {8}
assert {p[8] for p in timed} == {"Edge0_2", "Edge0_3", "Edge1_2", "Edge1_3"}, {p[8] for p in timed}
CHECK

# A mesh as it is read: closed face loops, one orientation, Euler's number 1.
run grow draped.study --lines --normals --groups -o cloth.obj
python3 - <<'CHECK'
vertices, normals, faces, lines = [], [], [], []
for row in open("cloth.obj"):
    word, *rest = row.split()
    {"v": vertices, "vn": normals, "f": faces, "l": lines}.get(word, []).append(rest)
faces = [[int(c.split("/")[0]) for c in f] for f in faces]
darts = {(a, b) for f in faces for a, b in zip(f, f[1:] + f[:1])}
assert len(darts) == sum(map(len, faces)), "an edge twice in one direction"
assert len(vertices) == len(normals) == 4225 and len(faces) == 4096 and len(lines) == 8320
assert len(vertices) - len(lines) + len(faces) == 1
assert max(darts)[0] <= len(vertices)
CHECK

# Threads change nothing.
for threads in 1 2 3 4; do
    run grow draped.study --threads "$threads" -o "cloth-$threads.ply"
    cmp cloth-1.ply "cloth-$threads.ply"
done

# What a study says can be said by options.
cat >said.study <<'STUDY'
rules "square.hemls"
steps 3
scale 1.2 1.3 1
seed 4
attractor at 2 2 2 strength 0.5 exponent 1
boundary plane at 0 0 -0.1 normal 0 0 1 stop
fixed-centre
STUDY
run grow said.study -o by-study.ply
run grow square.hemls -n 3 --scale '1.2 1.3 1' --seed 4 --attractor 'at 2 2 2 strength 0.5 exponent 1' \
    --boundary 'plane at 0 0 -0.1 normal 0 0 1 stop' --fixed-centre -o by-options.ply
cmp <(tail -c 1000 by-study.ply) <(tail -c 1000 by-options.ply)
if "$TARTAN" grow square.hemls --scale 0 -o no.obj 2>stderr; then fail 'a scale of 0 is accepted'; fi
grep -q 'E1103' stderr || fail 'a scale of 0 is not explained'

# Seeds have 64 bits.
run grow square.hemls -n 2 --seed 18446744073709551615 -o seed.obj
printf 'rules "square"\nseed 18446744073709551615\n' >seed.study
run disasm seed.study -o seed.txt
grep -q 'seed 18446744073709551615' seed.txt || fail 'a seed of 64 bits is not the one that was said'
for seed in 18446744073709551616 2.5 -1 1e3; do
    if "$TARTAN" grow square.hemls --seed $seed -o no.obj 2>stderr; then fail "the seed $seed is accepted"; fi
    grep -q '18446744073709551615' stderr || fail "the seed $seed is not explained"
done

# A module grows as its source does.
run build said.study -o said.tnb
run grow said.tnb -o by-module.ply
cmp by-study.ply by-module.ply

# A mesh that bounds a study is found beside it, also from other folders, as a module, and where both are moved together.
mkdir -p site/parts elsewhere
run grow square.hemls -n 2 --scale 1 --start '0 0 -1' -o site/ground.ply
cp site/ground.ply site/parts/low.ply
printf 'boundary mesh "low.ply" stop\n' >site/parts/more.study
printf 'rules "square"\nuse "parts/more.study"\ngravity 0 0 -0.6\nstart 0 0 1\nscale 1\nboundary mesh "ground.ply" stop\n' >site/fall.study
run grow site/fall.study >landed
run grow site/fall.study --steps 4 >as_used
cmp landed as_used
run build site/fall.study -o site/fall.tnb
run build site/fall.study -o elsewhere/fall.tnb
for module in site/fall.tnb elsewhere/fall.tnb; do
    run grow "$module" >by_module
    cmp landed by_module
done
(cd site && run grow fall.study >../by_folder && cmp ../landed ../by_folder)
mv site moved
run grow moved/fall.tnb >by_module
cmp landed by_module
code=0
"$TARTAN" grow elsewhere/fall.tnb 2>stderr || code=$?
[ "$code" = 3 ] && grep -q 'no mesh elsewhere/parts/low.ply' stderr && grep -q 'it was site/parts/low.ply' stderr || fail 'a lost mesh is not explained'
echo 'no mesh at all' >moved/ground.ply
code=0
"$TARTAN" grow moved/fall.study 2>stderr || code=$?
[ "$code" = 3 ] && grep -q 'cannot read a mesh from moved/ground.ply' stderr || fail 'a broken mesh is not explained'

# Steps over one another: each adds its faces to the picture; a step that is not reached is said.
for steps in 2 1,2 0,1,2; do
    run grow draped.study -n 2 --overlay "$steps" -o over.svg
    cp over.svg "over-$steps.svg"
    run grow draped.study -n 2 --overlay "$steps" -o over.svg
    cmp over.svg "over-$steps.svg" || fail 'an overlay is not the same twice'
done
[ "$(grep -c '<path' over-0,1,2.svg)" -gt "$(grep -c '<path' over-1,2.svg)" ] && [ "$(grep -c '<path' over-1,2.svg)" -gt "$(grep -c '<path' over-2.svg)" ] ||
    fail 'an overlay does not have the faces of its steps'
"$TARTAN" grow draped.study -n 2 --overlay 1,9 -o over.svg 2>stderr || fail 'a step too many ends an overlay'
grep -q 'later ones of --overlay are not drawn' stderr || fail 'a step that is not there is not said'
for words in '--overlay 9 -o x.svg' '--overlay x -o x.svg' '--overlay 1, -o x.obj' '--overlay 1 --sheet -o x.svg' '--overlay 1'; do
    if "$TARTAN" grow draped.study -n 2 $words 2>stderr >/dev/null; then fail "accepted: $words"; fi
    grep -q 'E0904' stderr || fail "not said what is wrong: $words"
done

# What a surface grows in is drawn where there is any, or where it is asked for.
filled() { grep -c "fill-opacity=\"$2\"" "$1"; }
run grow square.hemls -n 2 -o plain.svg
run grow square.hemls -n 2 --surroundings no -o none.svg
cmp plain.svg none.svg || fail 'a surface in no surroundings is drawn with some'
run grow square.hemls -n 2 --surroundings yes -o ground.svg
[ "$(filled ground.svg .1)" = 1 ] && [ "$(filled plain.svg .1)" = 0 ] || fail 'the ground is not drawn'
run grow square.hemls -n 2 --boundary 'sphere at 0 0 -1 radius 1' --attractor 'at 2 0 1 strength 0.2' --repeller 'at 90 0 0' --gravity '0 0 -0.1' -o said.svg
[ "$(filled said.svg .14)" = 1 ] || fail 'a sphere is not one shape'
[ "$(filled said.svg .95)" = 1 ] || fail 'an attractor is not one mark'
[ "$(filled said.svg .9)" = 2 ] || fail 'gravity and the far repeller are not two arrows'
run grow square.hemls -n 2 --boundary 'sphere at 0 0 -1 radius 1' --surroundings no -o bare.svg
if grep -q 'fill-opacity' bare.svg; then fail 'surroundings are drawn all the same'; fi

# From all around: files of one size, or one picture that moves. The same bytes at any number of threads.
run grow square.hemls -n 3 --gravity '0 0 -0.1' --turn 5 --width 120 -o around
[ "$(ls around | tr '\n' ' ')" = 'turn-000.png turn-001.png turn-002.png turn-003.png turn-004.png ' ] || fail 'not every side is drawn'
for threads in 1 2; do run grow square.hemls -n 3 --gravity '0 0 -0.1' --turn 5 --width 120 --threads $threads -o "turn$threads.png"; done
cmp turn1.png turn2.png
python3 - <<'EOF' || fail 'the moving picture is not what its frames are'
import struct, zlib
def chunks(path):
    data, at = open(path, 'rb').read(), 8
    while at < len(data):
        size, = struct.unpack('>I', data[at:at + 4])
        name, body = data[at + 4:at + 8], data[at + 8:at + 8 + size]
        assert zlib.crc32(name + body) == struct.unpack('>I', data[at + 8 + size:at + 12 + size])[0]
        yield name, body
        at += 12 + size
frames, sizes, number = [], [], 0
for name, body in chunks('turn1.png'):
    if name == b'acTL':
        assert struct.unpack('>II', body) == (5, 0)
    if name in (b'fcTL', b'fdAT'):
        assert struct.unpack('>I', body[:4])[0] == number
        number += 1
    if name == b'fcTL':
        frames.append(b'')
        sizes.append(body[4:12])
    if name == b'IDAT' or name == b'fdAT':
        frames[-1] += body if name == b'IDAT' else body[4:]
for i in range(5):
    single = list(chunks('around/turn-%03d.png' % i))
    assert single[0][1][:8] == sizes[i]
    assert b''.join(body for name, body in single if name == b'IDAT') == frames[i]
assert len(set(frames)) == 5
EOF
for words in '--turn 5' '--turn 5 -o x.svg' '--turn 1 -o x' '--turn 5 --sheet -o x' '--turn 5 -o x.obj' '--turn 5 -o x.gif' '--surroundings yes' '--surroundings yes -o x.obj'; do
    if "$TARTAN" grow square.hemls -n 2 $words 2>stderr >/dev/null; then fail "accepted: $words"; fi
    grep -q 'E0904' stderr || fail "not said what is wrong: $words"
done

# Each step, and a sheet of all; the same bytes twice.
run grow square.hemls -n 2 --each-step -o step.obj
[ -e step-000.obj ] && [ -e step-001.obj ] && [ -e step-002.obj ] && [ ! -e step.obj ] || fail 'not every step is there'
for picture in svg png pdf; do
    run grow draped.study --sheet -o "one.$picture" --azimuth=-20 --elevation 50
    run grow draped.study --sheet -o "two.$picture" --azimuth=-20 --elevation 50
    cmp "one.$picture" "two.$picture"
    run grow square.hemls -n 3 -o "view.$picture"
    [ "$(wc -c <"view.$picture")" -gt 1000 ] || fail "nothing is drawn in $picture"
done

# OpenMesh's own algorithms.
run grow square.hemls -n 2 --subdivide 1 -o finer.ply
grep -qa 'element face 64' finer.ply || fail 'subdividing does not make four faces of one'
run grow square.hemls -n 4 --gravity '0 0 -0.3' --attractor 'at 3 0 3' --smooth 5 -o smooth.ply
grep -qa 'element face 256' smooth.ply || fail 'smoothing changes the faces'
run grow square.hemls -n 4 --decimate 100 -o coarse.ply
faces=$(grep -a 'element face' coarse.ply | cut -d' ' -f3)
[ "$faces" -le 110 ] && [ "$faces" -ge 50 ] || fail "decimating to 100 leaves $faces"

# Limits end at the last complete step, which is written; exit 4.
code=0
"$TARTAN" grow square.hemls -n 9 --edge-limit 1000 -o limited.ply 2>stderr || code=$?
[ "$code" = 4 ] || fail "the edge limit exits with $code"
grep -q 'E0840' stderr && grep -q 'step 4' stderr || fail 'the edge limit is not explained'
grep -qa 'element face 256' limited.ply || fail 'the last complete step is not written'

# Faces that cross themselves or are turned over are counted, with their place; --werror takes them for errors.
run grow square.hemls -n 4 --scale 1.3 --attractor 'at 1 1 1 strength 9' --attractor 'at -1 0 1 strength 9' -o pulled.obj
grep -q "W105.*after step 4, .* faces' outlines cross themselves.*first is around (" stderr || { cat stderr; fail 'crossed faces are not told'; }
grep -q 'W106.*after step 4, .* turned over onto' stderr || { cat stderr; fail 'faces turned over are not told'; }
code=0
"$TARTAN" grow square.hemls -n 4 --scale 1.3 --attractor 'at 1 1 1 strength 9' --attractor 'at -1 0 1 strength 9' --werror -o pulled.obj 2>stderr || code=$?
[ "$code" = 1 ] || fail "--werror lets crossed faces pass with $code"

# Until so many faces; rest.
[ "$(run grow square.hemls --until faces=1000 | tail -1 | awk '{print $4}')" = 1024 ] || fail '--until stops elsewhere'
[ "$(run grow square.hemls -n 3 --until faces=1000 | tail -1 | awk '{print $4}')" = 64 ] || fail '--until goes past -n'
grep -q 'after 3 steps there are 64 faces, fewer than 1000' stderr || fail 'what --until does not reach is not told'
printf 'A + A + A; A -> A_i+1; Angle 60\n' >older.hemls
run grow older.hemls --until faces=5 --scale 1 -o older.obj
grep -q '100 steps have made no face' stderr || fail '--until goes on for ever'
printf 'A + A + A; A -> B; Angle 60\n' >rest.hemls
run grow rest.hemls -n 50 --scale 1 >/dev/null
grep -q 'changes nothing any more' stderr || fail 'rest is not noticed'

# The statistics' form.
run grow square.hemls -n 1 --stats json >stats
cat >expected <<'JSON'
[
{"step": 0, "V": 4, "E": 4, "F": 1, "labels": {"Edge0": 2, "Edge1": 2}, "ages": {"Edge0_0": 2, "Edge1_0": 2}, "face_sides": {"4": 1}, "fitness": {"size": 2, "smoothness": 0, "soft_boundary_nodes": 0, "subdivisions": 1, "symmetry": 1, "undulation": 0}, "measures": {"width": 1, "depth": 1, "height": 0, "area": 1, "volume": 0, "planarity": 0, "worst-planarity": 0, "edge-spread": 0, "smallest-angle": 90, "span": 0, "crossed-faces": 0, "turned-faces": 0, "crossings": 0, "sunlit": 1}},
{"step": 1, "V": 9, "E": 12, "F": 4, "labels": {"Edge0": 6, "Edge1": 6}, "ages": {"Edge0_0": 6, "Edge1_0": 6}, "face_sides": {"4": 4}, "fitness": {"size": 3, "smoothness": 0, "soft_boundary_nodes": 0, "subdivisions": 0.75, "symmetry": 1, "undulation": 0}, "measures": {"width": 1.5, "depth": 1.5, "height": 0, "area": 2.25, "volume": 0, "planarity": 0, "worst-planarity": 0, "edge-spread": 0, "smallest-angle": 90, "span": 0, "crossed-faces": 0, "turned-faces": 0, "crossings": 0, "sunlit": 1}}
]
JSON
diff -u expected stats
run grow square.hemls -n 1 --explain -o x.obj
grep -q '4 branches point out of the surface' stderr || fail '--explain does not say why'

# Interpreting the rules' code makes the same surface, and says the same of it.
for file in "$source"/stdlib/*.hemls "$source"/examples/*/*.hemls "$source"/examples/growing-surfaces/*.study; do
    [ -e "$file" ] && ! grep -q '^boundary mesh' "$file" || continue # a mesh has to be grown first
    for engine in templates vm; do
        run grow "$file" -n 4 --engine="$engine" --groups --lines --stats json -o "$engine.ply" >"$engine.json"
        mv stderr "$engine.txt"
    done
    cmp templates.ply vm.ply && cmp templates.json vm.json && cmp templates.txt vm.txt || fail "$file grows otherwise when interpreted"
done
"$TARTAN" disasm square.hemls >listing
grep -q '^  ; square.hemls:[0-9]*: A -> A ' listing && grep -q '^ *[0-9]*  TURN        -90$' listing || fail 'the listing has no turtle moves beside the source'

# Nineteen labels have nineteen colours, in the picture and its legend, which takes more than one row; the bar of the scale has one more.
printf 'A' >labels.hemls
for letter in B C D E F G H I J K L M N O P Q R S; do printf ' + %s' "$letter" >>labels.hemls; done
printf '; Angle 90\n' >>labels.hemls
run grow labels.hemls -n 0 -o labels.svg
[ "$(grep -o ' stroke="[^"]*"' labels.svg | sort -u | wc -l)" = 20 ] || fail 'labels share colours'
[ "$(grep -o ' stroke="[^"]*"' labels.svg | sort | uniq -c | awk '$1 < 2' | wc -l)" = 1 ] || fail 'the legend leaves labels out'

# Wrong usage.
for words in '--smooth 3' '--sheet' '--smooth 3 -o x.png' '--subdivide 1 --lines -o x.ply' '--title T -o x.ply' '--normals -o x.stl' '--up y -o x.glb' \
    '--triangulate -o x.dxf' '--each-step --sheet -o x.svg' '-f obj' '-o x' '-o x.txt' '--until sides=3' '-o - --stats' '--sheet -o x.obj' '--azimuth north -o x.svg' 'said.tnb --scale 2'; do
    code=0
    case $words in said*) file=() ;; *) file=(square.hemls) ;; esac
    eval "\"\$TARTAN\" grow \"\${file[@]}\" $words" >/dev/null 2>stderr || code=$?
    [ "$code" = 2 ] || { cat stderr; fail "grow $words exits with $code"; }
done
