#!/usr/bin/env bash
# Sheets of houses are drawn as offices draw: widths of lines, lettering, tags, numbers and areas (tests/house_drawn.py).
name=house_drawn
. "$(dirname "$0")/golden.bash"
tests=$(cd "$here/.." && pwd)

for house in '#2:18693' '#2:5' '#2:9001'; do
    "$TARTAN" house row-houses "$house" -o "$scratch/house.svg" -o "$scratch/house.json" 2>"$scratch/said" || fail "no house $house: $(cat "$scratch/said")"
    is "house $house" "$(python3 -B "$tests/house_drawn.py" "$scratch/house.svg" "$scratch/house.json" && echo fine)" fine
    cp "$scratch/house.svg" "$scratch/one.svg"
done
# What an office says of its drawings stands in the title block, of one view below its title, and not without being said.
said=(--project 'Ten houses' --date 2026-11-30 --revision B --north 90)
"$TARTAN" house row-houses '#2:9001' "${said[@]}" -o "$scratch/said.svg" -o "$scratch/said.dxf" || fail 'no title block'
is 'what is said' "$(grep -o '>\(Ten houses\|date 2026-11-30\|revision B\|N\|[a-z]* elevation, [a-z]*\)<' "$scratch/said.svg" | LC_ALL=C sort | uniq -c | tr -s ' \n' ' ')" \
    ' 3 >N< 1 >Ten houses< 1 >back elevation, west< 1 >date 2026-11-30< 1 >front elevation, east< 1 >left elevation, north< 1 >revision B< 1 >right elevation, south< '
is 'the sheet with it' "$(python3 -B "$tests/house_drawn.py" "$scratch/said.svg" && echo fine)" fine
# In a DXF the title block is on the layout (67 and 1), the arrow a block in model space.
is 'a DXF says it' "$(tr -d '\r' <"$scratch/said.dxf" | grep -c '^\(Ten houses\|date 2026-11-30\|revision B\)$')" 3
is 'its arrow' "$(tr -d '\r' <"$scratch/said.dxf" | grep -A12 '^INSERT$' | grep -c '^NORTH$')" 3
"$TARTAN" house row-houses '#2:9001' --view plan:ground "${said[@]}" -o "$scratch/said.svg" || fail 'no view'
is 'one view says it' "$(grep -c '>Ten houses, 2026-11-30, revision B<' "$scratch/said.svg")" 1
is 'nothing is said by itself' "$(grep -c '>\(date.*\|revision.*\|N\)<' "$scratch/one.svg")" 0
"$TARTAN" house row-houses '#2:9001' --north 90 -o "$scratch/said.json" 2>"$scratch/out" && fail 'north of no drawing'
is 'north of no drawing' "$(sed -n 1p "$scratch/out")" 'error[E0904]: --north is about drawings and building models, and no file is one'
cottage="14' none room:14' porch:5' | 10' none room:14' porch:5' | 10' lean-to:7' room:14' none ; 1 2 shed(back,4:12) 1 ; living bedroom porch-deck | stair stair porch-deck | bath kitchen bedroom"
# The plan of a roof: of each plane its slope, and where two meet: a ridge, and four hips at 45 degrees.
sed "s/gable(9:12)/gable(9:12) | hip(9:12, eaves 1'6\")/" "$here/../../stdlib/cottage.plan" >"$scratch/hip.plan"
hip=${cottage/shed(back,4:12)/hip(9:12,eaves-1\'6\")}
"$TARTAN" house "$scratch/hip.plan" "$hip" --view plan:roof -o "$scratch/roof.svg" -o "$scratch/roof.dxf" || fail 'no roof'
is 'slopes of a hip' "$(grep -o '>\(9:12\|flat\)<' "$scratch/roof.svg" | LC_ALL=C sort | uniq -c | tr -s ' \n' ' ')" ' 4 >9:12< 2 >flat< '
is 'its size' "$(grep -c ">37'-8\"<" "$scratch/roof.svg")" 1
is 'its hips' "$(tr -d '\r' <"$scratch/roof.dxf" | python3 -c '
import sys
words = sys.stdin.read().split("\n")
hips = 0
pairs = list(zip(words[::2], words[1::2]))
starts = [i for i, pair in enumerate(pairs) if pair[0].strip() == "0"] + [len(pairs)]
for a, b in zip(starts, starts[1:]):
    if pairs[a][1] not in ("LINE", "LWPOLYLINE") or "A-ROOF" not in [value for _, value in pairs[a:b]] and "A-ROOF-SECT" not in [value for _, value in pairs[a:b]]:
        continue
    x = [float(value) for code, value in pairs[a:b] if code.strip() in ("10", "11")]
    y = [float(value) for code, value in pairs[a:b] if code.strip() in ("20", "21")]
    hips += sum(abs(abs(x[i + 1] - x[i]) - abs(y[i + 1] - y[i])) < 1e-3 and abs(x[i + 1] - x[i]) > 100 for i in range(len(x) - 1))
print(hips)')" 4
# By the custom of another country: units, paper, scales, ends of dimensions.
"$TARTAN" house cottage '#541:77' --profile iso -o "$scratch/iso.svg" -o "$scratch/iso.dxf" || fail 'no cottage by ISO'
"$TARTAN" house row-houses '#2:9001' --profile us -o "$scratch/us.svg" -o "$scratch/us.dxf" 2>"$scratch/out" || fail 'no house in feet'
# drawn FILE: paper in whole millimetres or inches, heavy strokes of dimensions, feet, metres, areas, scales
drawn() {
    sed -n "s/.*<svg [^>]*width=\"\([0-9.]*\)pt\".*/\1/p" "$1" | awk '{ printf "%.1f ", $1 / 72 * 25.4 }'
    grep -c '>[0-9]*'"'"'-[0-9 /]*"<' "$1"
    grep -c '>[0-9]*\.[0-9]\{2,3\}<' "$1"
    grep -c '>[0-9.]* \(SF\|m²\) net<' "$1"
    grep -o '>\(1:[0-9]*\|[0-9/]*" = 1'"'"'-0"\)<' "$1"
}
feet=$(drawn "$scratch/us.svg" | tr '\n' ' ') metres=$(drawn "$scratch/iso.svg" | tr '\n' ' ')
[[ $feet =~ ^914.4\ [1-9][0-9]+\ 0\ [1-9][0-9]*\ \>1/8\"\ =\ 1\'-0\"\<\ $ ]] || fail "a house in feet: $feet"
[[ $metres =~ ^(420.0|594.0|841.0)\ 0\ [1-9][0-9]+\ [1-9][0-9]*\ \>1:[0-9]+\<\ $ ]] || fail "a house in metres: $metres"
is 'eighths of inches' "$(grep -c '[0-9]/\(16\|32\|64\)"<' "$scratch/us.svg")" 0
is 'units of DXF' "$(for f in us iso; do tr -d '\r' <"$scratch/$f.dxf" | grep -A2 '^\$INSUNITS$' | tail -n 1; done | tr '\n' ' ')" '1 4 '
# Windows are blocks, one for each size; walls of brick, partitions of plasterboard and the earth are told apart.
"$TARTAN" house row-houses '#2:18693' -o "$scratch/row.dxf" 2>"$scratch/out" || fail 'no row house'
is 'blocks of windows' "$(tr -d '\r' <"$scratch/row.dxf" | grep -x -A12 INSERT | grep -x 'WINDOW-.*' | LC_ALL=C sort | uniq -c | tr -s ' \n' ' ')" ' 3 WINDOW-1000x25 3 WINDOW-1200x25 '
is 'hatches' "$(tr -d '\r' <"$scratch/row.dxf" | grep -x 'MASONRY\|DOTTED\|EARTH' | LC_ALL=C sort -u | tr '\n' ' ')" 'DOTTED EARTH MASONRY '
is 'texts that are beside their dimensions' "$(tr -d '\r' <"$scratch/row.dxf" | grep -x -A40 DIMENSION | grep -x -A1 ' *70' | grep -cx ' *160')" 7
# Insulation is a batt: a zigzag from one side of its layer to the other.
sed 's/studs 5"/insulation 5"/; s/for studs, joists, rafters/for joists, rafters/' "$files/layers.plan" >"$scratch/batt.plan"
"$TARTAN" house "$scratch/batt.plan" "10' room:14' porch:6' ; gable(9:12) 1" --view plan:ground --scale 24 -o "$scratch/batt.dxf" -o "$scratch/batt.svg" 2>"$scratch/out" || fail 'no batt'
is 'batts' "$(tr -d '\r' <"$scratch/batt.dxf" | python3 -c '
import sys
words = sys.stdin.read().split("\n")
pairs = [(code.strip(), value) for code, value in zip(words[::2], words[1::2])]
starts = [i for i, pair in enumerate(pairs) if pair[0] == "0"] + [len(pairs)]
batts = 0
for a, b in zip(starts, starts[1:]):
    if pairs[a][1] != "LWPOLYLINE" or ("8", "A-WALL-PATT") not in pairs[a:b]:
        continue
    x = [float(value) for code, value in pairs[a:b] if code == "10"]
    y = [float(value) for code, value in pairs[a:b] if code == "20"]
    across = x if max(x) - min(x) < max(y) - min(y) else y
    batts += len(x) > 5 and all(abs(abs(p - q) - 5) < 1e-6 for p, q in zip(across, across[1:]))
print(batts)')" 6
# Small scales leave less room: marks of sections, too, stand apart from dimensions.
"$TARTAN" house cottage "$cottage" --scale 192 -o "$scratch/house.svg" 2>"$scratch/said" || fail "no cottage: $(cat "$scratch/said")"
is 'a cottage at 1/16"' "$(python3 -B "$tests/house_drawn.py" "$scratch/house.svg" && echo fine)" fine
is 'its name is whole' "$(grep -c '>one or two storeys under a gable or a shed<' "$scratch/house.svg")" 1
is 'heights to 1/8"' "$(grep -c '[0-9]/\(16\|32\|64\)"<' "$scratch/house.svg")" 0
# In a small room a number is written over furniture rather than into the circle of a tag.
house="12' single - - empty open:12' open:4' | 12' single - - dense:4' dense:12' empty | 4' single - - dense:4' open:12' empty | 8' single - - dense:4' dense:12' empty | 12' double public great dense:4' open:8' empty ; 1 flat 2 shed(front,3:12) 1 flat shingle ; bedroom bedroom seat | entry stair stair | store passage passage | bath hearth bath | kitchen hall void ; window ; day-bed.left day-bed.left.m window-seat.left coats.right closet.back shower-room.back.m fire.front bath-room.right niche.back gathering.front.m"
"$TARTAN" house lahave-complete "$house" --view plan:ground -o "$scratch/small.svg" 2>"$scratch/said" || fail "no small rooms: $(cat "$scratch/said")"
is 'small rooms' "$(python3 -B "$tests/house_drawn.py" "$scratch/small.svg" && echo fine)" fine
# The floor of a porch is told from the wall beside it along an upright line: only the roof slopes, by 4 in 12.
"$TARTAN" house cottage "$cottage" --view elevation:left -o "$scratch/left.svg" 2>"$scratch/said" || fail "no elevation: $(cat "$scratch/said")"
is 'lines that slope' "$(python3 - "$scratch/left.svg" <<'PY'
import re, sys
slopes = set()
for path in re.findall(r'stroke-width=".992"[^>]* d="([^"]*)"', open(sys.argv[1], encoding="utf-8").read()):
    for command, numbers in re.findall(r"([mlMLhv])([^a-zA-Z]*)", path):
        pairs = [float(n) for n in re.findall(r"-?(?:\d+\.?\d*|\.\d+)", numbers)]
        lines = [] if command in "hv" else list(zip(pairs[::2], pairs[1::2]))[1 if command in "mM" else 0:]
        slopes |= {round(abs(dy / dx), 3) for dx, dy in lines if abs(dx) > 0.01 and abs(dy) > 0.01}
print(*slopes)
PY
)" 0.333
# Three row houses on three storeys are legible on A1, if views in space are smaller; one has room for large ones.
"$TARTAN" house apartments "$("$TARTAN" sample apartments 1 --library apartments --seed 3)" --view plan:first --scale 100 -o "$scratch/between.svg" || fail 'no floor between others'
is 'up and down in one place' "$(grep -o '>\(UP 16R\|DN\)<' "$scratch/between.svg" | LC_ALL=C sort | tr -d '\n')" '>DN<>UP 16R<'
is 'views of one row house' "$(grep -c '>axonometric<' "$scratch/one.svg")" 1
house='2.2m first three room:3m room:4m room:5m | 4m - three none room:4m room:5m | 4m first three none room:4m room:5m | 2.2m - three room:3m room:4m room:5m | 4m first three none room:4m room:5m | 2.2m - three room:3m room:4m room:5m ; 2 flat flat shed(back,1:4) brick'
"$TARTAN" house row-houses "$house" -o "$scratch/house.svg" 2>"$scratch/said" || fail "no row: $(cat "$scratch/said")"
is 'three row houses' "$(grep -o '>1:[0-9]*<' "$scratch/house.svg")" '>1:100<'
is 'their views' "$(grep -c '>axonometric, 1:200<' "$scratch/house.svg")" 1
is 'one hatch of earth in both sections' "$(grep -o '<pattern[^>]*rotate(0)' "$scratch/house.svg" | sed -n 's/.* width="\([0-9.]*\)" height="\1".*/\1/p' | sort -u | wc -l)" 1
is 'their sheet' "$(python3 -B "$tests/house_drawn.py" "$scratch/house.svg" && echo fine)" fine
finish
