#!/usr/bin/env bash
# Needs python3-ezdxf: what is written as DXF is read, and is what was drawn.
name=drawings_read
. "$(dirname "$0")/golden.bash"
meanings=$(dirname "$TARTAN")/tests/drawn_meanings
python=/usr/bin/python3
"$python" -c 'import ezdxf' 2>/dev/null || { echo 'there is no ezdxf (python3-ezdxf)'; exit 77; }

# read_back FILE [TYPE=COUNT]...
read_back() {
    "$python" -B tests/drawing_read.py "$@" >"$scratch/read" || fail "$(basename "$1"): $(cat "$scratch/read")"
}

"$meanings" "$scratch/meanings.dxf" || fail 'meanings.dxf is not drawn'
read_back "$scratch/meanings.dxf" INSERT=17 HATCH=7 DIMENSION=5 LWPOLYLINE=8

"$TARTAN" draw lahave-houses --sample 6 --seed 7 -o "$scratch/feet.dxf" || fail 'feet.dxf is not drawn'
"$TARTAN" draw lahave-houses --sample 6 --seed 7 --profile iso -o "$scratch/iso.dxf" || fail 'iso.dxf is not drawn'
"$TARTAN" draw "$files/sheds.plan" --library sheds --sample 5 --seed 1 -o "$scratch/table.dxf" || fail 'table.dxf is not drawn'
"$TARTAN" draw "$files/stalls.plan" --sample 6 --seed 1 -o "$scratch/tones.dxf" || fail 'tones.dxf is not drawn'
# Every tray is measured, and every plan; contours and zones are closed lines, fills hatches, marks blocks.
read_back "$scratch/feet.dxf" meant LWPOLYLINE@A-AREA=50 LWPOLYLINE@A-WALL=6 A-WALL:A-AREA DIMENSION@A-ANNO-DIMS=45 HATCH@A-AREA-PATT=30 INSERT@A-ANNO-SYMB=6
read_back "$scratch/iso.dxf" meant LWPOLYLINE@A-99----E-=50 LWPOLYLINE@A-21C---E-=6 DIMENSION@A-------D-=45 HATCH@A-99----H-=30 INSERT@A-------S-=6
read_back "$scratch/tones.dxf" meant DIMENSION@A-------D-=30 HATCH@A-99----H-=40
read_back "$scratch/table.dxf" meant TEXT=49
"$TARTAN" house "$files/cabins.plan" "#10:77" -o "$scratch/house.dxf" || fail "house.dxf is not written"
read_back "$scratch/house.dxf" meant DIMENSION=10 HATCH=2 LWPOLYLINE=20
"$TARTAN" best lahave-houses 5 --least cost -o "$scratch/best.dxf" || fail 'best.dxf is not drawn'
read_back "$scratch/best.dxf" meant LWPOLYLINE@A-WALL=5 DIMENSION@A-ANNO-DIMS=20
refused() {
    local words=$1
    shift
    "$TARTAN" "$@" 2>"$scratch/said" && fail "$* is not refused"
    grep -q "$words" "$scratch/said" || fail "$*: $(cat "$scratch/said")"
}
refused 'a DXF is made of plans' draw lahave --rule stranded -o "$scratch/rule.dxf"
refused '`tartan mesh` writes a form as .dxf' draw table -o "$scratch/table.dxf"
refused 'in .svg, .png or .pdf; of plans also in .dxf' draw table -o "$scratch/table.jpg"
refused 'cannot be written as' best "$files/cabins.plan" 3 --library cottages --least bedrooms -o "$scratch/best.dxf"
refused 'names the layers of a DXF' draw lahave-houses --sample 1 --profile us -o "$scratch/feet.svg"
finish
