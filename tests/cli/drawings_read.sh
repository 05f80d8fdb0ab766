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
read_back "$scratch/feet.dxf" LWPOLYLINE=50
read_back "$scratch/iso.dxf" LWPOLYLINE=50
read_back "$scratch/table.dxf" TEXT=49
"$TARTAN" house "$files/cabins.plan" "#10:77" -o "$scratch/house.dxf" || fail "house.dxf is not written"
read_back "$scratch/house.dxf" DIMENSION=10 HATCH=2 LWPOLYLINE=20
refused() {
    local words=$1
    shift
    "$TARTAN" "$@" 2>"$scratch/said" && fail "$* is not refused"
    grep -q "$words" "$scratch/said" || fail "$*: $(cat "$scratch/said")"
}
refused 'a DXF is made of plans' draw lahave --rule stranded -o "$scratch/rule.dxf"
refused 'a DXF is made of plans' draw table -o "$scratch/table.dxf"
refused 'names the layers of a DXF' draw lahave-houses --sample 1 --profile us -o "$scratch/feet.svg"
finish
