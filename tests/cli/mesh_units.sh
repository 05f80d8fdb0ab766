#!/usr/bin/env bash
# Needs the parts: mesh
# Files of forms in every notation and unit: a .glb is in metres with linear colours, a .3mf says its unit and is one closed object with its colours.
name=mesh_units
. "$(dirname "$0")/golden.bash"
cd "$scratch"

# alike METRES FORM ENDING... [--objects N] [--colours N]
alike() {
    is "$2" "$(python3 "$here/../mesh_files.py" "$@")" fine
}

while read -r unit metres; do
    printf '%s\nsurface ball = x*x + y*y + z*z - 9\nbox (-5, -4, -4)..(3, 4, 4)\ngrid 12\n' "$([ "$unit" = none ] || echo "unit $unit")" >"ball-$unit.field"
    for ending in obj glb 3mf ply; do "$TARTAN" mesh "ball-$unit.field" -o "ball-$unit.$ending"; done
    alike "$metres" "ball-$unit" glb ply --colours 1
    [ "$unit" = none ] || alike "$metres" "ball-$unit" 3mf
done <<<'mm 0.001
cm 0.01
m 1
in 0.0254
ft 0.3048
none 1'
alike 0.001 ball-none 3mf # where there is no unit it says millimetres

while read -r metres unit; do
    printf 'solid two {\n  %s\n  box low from (0, 0, 0) to (4, 2, 3);\n  box high from (3, 0, 1) to (7, 2, 4);\n}\n' "$unit" >"two-$metres.solid"
    for ending in obj glb 3mf ply; do "$TARTAN" mesh "two-$metres.solid" -o "two-$metres.$ending"; done
    alike "$metres" "two-$metres" glb ply 3mf
done <<<'0.001 model mm;
0.01 model cm;
1 model m;'
"$TARTAN" mesh two-1.solid --cells -o cells.obj
"$TARTAN" mesh two-1.solid --cells -o cells.3mf
alike 1 cells 3mf --objects 2

for kit in "$here/../../examples/gatehouse/gatehouse.kit" "$here/../../examples/lighthouse/lighthouse.kit"; do
    form=$(basename "$kit" .kit)
    "$TARTAN" place "$kit" -o "$form.obj" -o "$form.glb" -o "$form.3mf" -o "$form.ply"
    alike 0.001 "$form" glb 3mf ply
    colours=$(grep -aoE 'displaycolor="#[0-9A-F]{6}"' <(python3 -c 'import sys, zipfile; print(zipfile.ZipFile(sys.argv[1]).read("3D/3dmodel.model").decode())' "$form.3mf") | sort -u | wc -l)
    [ "$colours" -gt 1 ] || fail "$form has one colour"
done

"$TARTAN" house "$files/cabins.plan" "14' room:14' none ; 1 gable(9:12) 1 flat ; kitchen ; wall window wall wall ; counter.back" -o hut.obj -o hut.glb -o hut.ply
alike 1 hut glb ply

cp "$here/../../stdlib/square.hemls" sheet.hemls
for ending in obj glb ply; do "$TARTAN" grow sheet.hemls --steps 2 --groups -o "sheet.$ending"; done
alike 1 sheet glb
finish
