#!/usr/bin/env bash
# tartan mesh: the nine primitives have the measures that two other implementations found; files, limits, wrong use.
# Slow under sanitizers.
name=mesh
source "$(dirname "$0")/golden.bash"

# name vertices triangles volume area, at 50 samples and at 256
primitives='sphere 5712 11420 522.791008007 313.922120781 156240 312476 523.568092974 314.150225590
torus 4672 9344 201.142049973 252.379322172 121032 242064 202.091655689 252.651058950
crosscap 3720 7436 195.186182330 208.801894562 103752 207500 196.303906983 214.348477780
heart 3448 6892 226.403069093 189.564978316 93836 187668 227.048096970 189.998086141
hunt 4376 8708 183.415109755 257.742669068 132744 264244 185.604400801 283.298760118
klein 4792 9620 226.003263840 260.544869016 130168 260492 226.689298356 261.351356700
roman 5712 11408 164.158245606 313.826239649 156240 312464 166.568598173 319.067207145
tetrahedral 8112 16208 371.798243305 434.627231843 219672 439328 373.787095433 436.045802596
blobby 7536 15088 237.282528710 403.117809643 203088 406192 239.464410913 403.742203498'

# measures WANTED SURFACE OPTION...: the counts exactly, the sums to eleven digits.
measures() {
    local wanted=$1 said
    shift
    said=$("$TARTAN" mesh primitives --surface "$@" --stats json 2>/dev/null | python3 -c '
import json, sys
m, wanted = json.load(sys.stdin), [float(word) for word in sys.argv[1].split()]
got = [m[name] for name in ("vertices", "triangles", "volume", "area")]
print("" if got[:2] == wanted[:2] and all(abs(a - b) < 1e-11 * b for a, b in zip(got, wanted)) else got)' "$wanted")
    [ -z "$said" ] || fail "$*: $said, not $wanted"
}
while read -r surface v50 t50 volume50 area50 v256 t256 volume256 area256; do
    measures "$v50 $t50 $volume50 $area50" "$surface" --threads 4
    measures "$v50 $t50 $volume50 $area50" "$surface" --engine vm
    measures "$v256 $t256 $volume256 $area256" "$surface" --grid 256
done <<<"$primitives"

cd "$scratch"
printf 'x*x + y*y + z*z - 9\n' >ball.field
printf 'surface cut = x*x + y*y - 4\nsurface wall = 1/x\nsurface specks = noise(9*x, 9*y, 9*z) + 0.45\ngrid 20\n' >odd.field
printf 'abs(distance("hull.obj")) - 0.4\n' >shell.field
printf 'fn f(a) = a\n' >library.field
printf 'sqrt(x*x + y*y + z*z - 400) - 1\n' >none.field
golden ball "tartan mesh $scratch/ball.field --grid 30 --stats"
# ---- volumes that are known lie between what is proven, and the two come together
python3 - "$TARTAN" <<'END' || failed=1
import json, math, subprocess, sys
for name, volume in (("sphere", 4 / 3 * math.pi * 5**3), ("torus", 2 * math.pi**2 * 4 * 1.6**2)):
    widths = []
    for grid in (10, 50, 120):
        said = subprocess.run([sys.argv[1], "mesh", "primitives", "--surface", name, "--grid", str(grid), "--bounds", "--stats", "json"],
                              capture_output=True, text=True, check=True).stdout
        low, high = json.loads(said)["volume_bounds"]
        if not low < volume < high:
            sys.exit("mesh: %s has a volume of %.9g, not between %.9g and %.9g" % (name, volume, low, high))
        widths.append(high - low)
    if not widths[0] > 2 * widths[1] > 3 * widths[2]:
        sys.exit("mesh: the bounds of %s do not come together: %s" % (name, widths))
END
printf 'surface shell = abs(sqrt(x*x + y*y + z*z) - 4) - 0.25\nsurface slab = max(abs(x) - 3, max(abs(y) - 3, abs(z) - 0.35))\n' > "$scratch/walls.field"
golden thickness "tartan mesh $scratch/walls.field --surface shell --grid 61 --thickness"
golden slab "tartan mesh $scratch/walls.field --surface slab --grid 60 --thickness --stats json"
golden open_thickness "tartan mesh $scratch/walls.field --surface shell --thickness --open"
golden bounds "tartan mesh $scratch/ball.field --grid 100 --bounds"
golden cut "tartan mesh $scratch/odd.field --surface cut"
golden wall "tartan mesh $scratch/odd.field --surface wall --stats json"
golden none "tartan mesh $scratch/none.field --grid 20"
golden specks "tartan mesh $scratch/odd.field --surface specks"
golden open "tartan mesh $scratch/odd.field --surface cut --open --stats json"
golden jumps_open "tartan mesh $scratch/odd.field --surface wall --jumps open --stats json"
golden unknown_surface "tartan mesh $scratch/odd.field --surface wal"
golden no_surface "tartan mesh $scratch/library.field"
golden no_field "tartan mesh square"
golden samples "tartan mesh $scratch/ball.field --grid 200 --max-samples 1000000"
golden triangles "tartan mesh $scratch/ball.field --max-triangles 1000"
golden missing_mesh "tartan mesh $scratch/shell.field"
printf 'no mesh at all' >broken.obj
printf 'distance("broken.obj") - 1\n' >broken.field
golden broken_mesh "tartan mesh $scratch/broken.field"
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >broken.obj
golden flat_mesh "tartan mesh $scratch/broken.field"
golden large_grid "tartan mesh $scratch/ball.field --grid 9000"
exits 4 "$TARTAN" mesh ball.field --grid 1200 --memory-limit 40
golden wrong_output "tartan mesh $scratch/ball.field -o $scratch/ball.svg"
golden wrong_normals "tartan mesh $scratch/ball.field -o $scratch/ball.stl --normals"
golden points "printf '0 0 0\n3 0 0\n1,2,3\n' >$scratch/places && tartan mesh $scratch/ball.field --points $scratch/places"
golden wrong_points "printf '0 0\n' >$scratch/places && tartan mesh $scratch/ball.field --points $scratch/places"
golden tape "tartan disasm $scratch/odd.field --tape"
golden no_tape "tartan disasm square --tape"
golden werror "tartan mesh primitives --surface heart --grid 12 --werror --stats json"

# A shell of a mesh that was written before; a module does as its file does.
"$TARTAN" mesh ball.field -o hull.obj || fail "a mesh is not written"
golden shell "tartan mesh $scratch/shell.field --grid 40"
"$TARTAN" build ball.field -o ball.tnb
for format in obj ply stl off om glb 3mf; do
    "$TARTAN" mesh ball.field --grid 20 -o a.$format && "$TARTAN" mesh ball.tnb --grid 20 -o b.$format
    cmp a.$format b.$format || fail "the module gives another $format"
    printf 'abs(distance("a.%s")) - 0.3\n' "$format" >again.field
    [ "$format" = glb ] || [ "$format" = 3mf ] || exits 0 "$TARTAN" mesh again.field --grid 30
done

# A 3MF is a sound archive with the mesh and its unit; of a design of boxes with --cells, each box is an object.
printf 'surface ball = x*x + y*y + z*z - 9 unit cm' >unit.field
"$TARTAN" mesh unit.field --grid 20 -o unit.3mf
"$TARTAN" mesh unit.field --grid 20 -o unit.obj --normals
python3 - unit.3mf unit.obj <<'PYTHON' || fail "a wrong 3MF"
import sys, xml.etree.ElementTree as tree, zipfile
archive = zipfile.ZipFile(sys.argv[1])
assert archive.testzip() is None and archive.namelist()[0] == "[Content_Types].xml"
name = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
model = tree.fromstring(archive.read("3D/3dmodel.model"))
assert model.get("unit") == "centimeter" and len(model.findall(f".//{name}item")) == 1
places = sorted(tuple(round(float(v.get(axis)), 9) for axis in "xyz") for v in model.iter(name + "vertex"))
triangles = [tuple(int(t.get(v)) for v in ("v1", "v2", "v3")) for t in model.iter(name + "triangle")]
lines = [line.split() for line in open(sys.argv[2])]
wanted = sorted(tuple(round(float(c), 9) for c in line[1:]) for line in lines if line[0] == "v")
assert places == wanted and len(triangles) == sum(line[0] == "f" for line in lines)
assert max(map(max, triangles)) == len(places) - 1
# Normals are by differentiation: on a ball they point from its middle.
vertices = [list(map(float, line[1:])) for line in lines if line[0] == "v"]
normals = [list(map(float, line[1:])) for line in lines if line[0] == "vn"]
assert len(normals) == len(vertices)
assert max(abs(v / 3 - n) for at, normal in zip(vertices, normals) for v, n in zip(at, normal)) < 1e-7
PYTHON
# Where the box closes a form, the normal is the wall's.
printf 'x*x + y*y - 4' >cut.field
"$TARTAN" mesh cut.field --grid 31 --normals -o cut.obj 2>/dev/null
python3 - cut.obj <<'PYTHON' || fail "wrong normals at the box"
import sys
lines = [line.split() for line in open(sys.argv[1])]
vertices = [list(map(float, line[1:])) for line in lines if line[0] == "v"]
normals = [list(map(float, line[1:])) for line in lines if line[0] == "vn"]
caps = [n for v, n in zip(vertices, normals) if v[2] > 6.9 and v[0] ** 2 + v[1] ** 2 < 2]
assert len(caps) > 20 and all(n[2] > 0.999 for n in caps), len(caps)
PYTHON
# ---- sharp edges
printf 'surface block = max(max(abs(x) - 4.1, abs(y) - 3.2), abs(z) - 2.3) grid 30' >block.field
golden sharp "tartan mesh $scratch/block.field --sharp"
golden sharp_crossing "tartan mesh primitives --surface klein --grid 30 --sharp --stats json"
"$TARTAN" mesh block.field --times --stats json | grep -q '"seconds": {"samples": 0' || fail "no times"
exits 2 "$TARTAN" mesh table --sharp

# ---- reworked meshes: what is measured is what is written; decimated, a block keeps all of it
"$TARTAN" mesh block.field --sharp --decimate 200 --stats json -o few.obj >few.json || fail "a block is not decimated"
python3 - few.json few.obj <<'PYTHON' || fail "a decimated block is not the block"
import json, sys
m, lines = json.load(open(sys.argv[1])), open(sys.argv[2]).read().splitlines()
assert m["triangles"] == 200 == sum(line.startswith("f ") for line in lines), m["triangles"]
assert m["vertices"] == sum(line.startswith("v ") for line in lines)
assert abs(m["volume"] - 8 * 4.1 * 3.2 * 2.3) < 1e-6 and abs(m["area"] - 8 * (4.1 * 3.2 + 3.2 * 2.3 + 2.3 * 4.1)) < 1e-6
PYTHON
is 'a subdivided ball' "$("$TARTAN" mesh ball.field --grid 12 --subdivide 1 | grep triangles)" \
    "triangles  $((4 * $("$TARTAN" mesh ball.field --grid 12 | sed -n 's/^triangles *//p')))"
is 'a subdivided table' "$("$TARTAN" mesh table --subdivide 1 | grep triangles)" \
    "triangles  $((4 * $("$TARTAN" mesh table | sed -n 's/^triangles *//p')))"
golden keeps_more "tartan mesh $scratch/ball.field --grid 12 --decimate 1 -o $scratch/least.obj"

# ---- between the samples
printf 'surface wall = max(abs(x - 0.1) - 0.001, max(abs(y), abs(z)) - 3)\nsurface fin = min(wall, square(x - 5) + y*y + z*z - 1)\n' >thin.field
printf 'surface none = x*x + 1\nsurface sheet = x*x + y*y - 1\nbox (-2, -2, -0.01)..(2, 2, 0.01)\n' >sheet.field
golden between "tartan mesh $scratch/thin.field --surface wall -o $scratch/wall.obj"
golden fin "tartan mesh $scratch/thin.field --surface fin --grid 20"
golden proven_empty "tartan mesh $scratch/sheet.field --surface none"
golden thin_box "tartan mesh $scratch/sheet.field"
exits 1 "$TARTAN" draw thin.field --surface wall -o wall.png
golden up_3mf "tartan mesh $scratch/unit.field -o $scratch/x.3mf --up y"
# What is written for a function of another language can be written.
count=0
while read -r text; do
    printf 'surface s = %s + z\n' "${text//\"/}" | sed -E 's/\<a\>/x/g; s/\<b\>/y/g; s/\<c\>/z/g' >"$scratch/written.field"
    exits 0 "$TARTAN" check "$scratch/written.field"
    count=$((count + 1))
done < <(sed -nE 's/^        \{"[a-z0-9]+", "[a-z0-9]+", (".*")\},$/\1/p' "$here/../../compiler/common/expression.c")
[ $count -gt 20 ] || fail "only $count functions of other languages"
finish
