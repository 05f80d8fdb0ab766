#!/usr/bin/env bash
# Needs the parts: mesh
# Roofs with eaves, open to their ridge, with ridges across the row; flights of stairs. Their solids are apart, without gaps, and their meshes
# closed; other programs read these with the same volume and area.
# Slow under sanitizers. ALL_ROOFS=1 takes each roof over one storey and over two.
name=house_solids
. "$(dirname "$0")/golden.bash"
python=python3
/usr/bin/python3 -c 'import ezdxf' 2>/dev/null && python=/usr/bin/python3

# looked FILE HOUSE WHAT
looked() {
    rm -rf "$scratch/made"
    mkdir "$scratch/made"
    "$TARTAN" house "$1" "$2" -o "$scratch/made/house.json" -o "$scratch/made/house.ifc" -o "$scratch/made/house.dxf" --profile us -o "$scratch/made/house.parts.csv" \
        -o "$scratch/made/house.obj" -o "$scratch/made/house.glb"
    is "$3: solids" "$($python "$here/../house_solids.py" "$scratch/made")" fine
    is "$3: files" "$($python "$here/../house_files.py" "$scratch/made")" fine
}

plan="14' room:14' none | 10' hall:18' porch:6' | 10' hall:18' porch:6' | 14' room:14' porch:6'"
low='living | living porch-deck | living porch-deck | living porch-deck'
high='living living | living void porch-deck | living void porch-deck | living living porch-deck'
porches=("flat(eaves-1')" "shed(front,12:12,open)" "flat(eaves-1')")
at=0
for roof in "gable(9:12,eaves-1'6\",open)" 'gable(12:12,across)' "gable(12:12,open,across,eaves-1')" "vault(4',eaves-6\",open)" \
    "vault(4',across)" "shed(back,4:12,eaves-2',open)" "shed(front,6:12,eaves-1')"; do
    [ $((at % 2)) = 1 ] && [ -z "${ALL_ROOFS:-}" ] ||
        looked "$files/roofs.plan" "$plan ; 1 $roof 1 ${porches[at % 2]} ; $low" "$roof, one storey"
    [ $((at % 2)) = 0 ] && [ -z "${ALL_ROOFS:-}" ] ||
        looked "$files/roofs.plan" "$plan ; 2 $roof 1 ${porches[at % 2 + 1]} ; $high" "$roof, two storeys"
    at=$((at + 1))
done
for flights in 'dogleg dogleg winding winding' 'winding winding run run' 'run dogleg dogleg winding'; do
    looked "$files/stairs.plan" "22' rooms:14' well:7'6\" | 22' rooms:14' deep:12' ; gable(9:12,eaves-1',across) flat ; living living living climb climb climb | living living living climb climb climb ; $flights" "$flights"
done

for flight in half2 half3 quarter3 round; do
    looked "$files/winders.plan" "3m deep:6m | 4m deep:6m ; - ; stair stair | room room ; $flight" "a flight with wedges, $flight"
done
looked "$files/gallery.plan" "$("$TARTAN" sample "$files/gallery.plan" 1 --library inns --seed 2)" 'a gallery'

# Gable ends are walls below the slab, which ends upright above them.
"$TARTAN" house "$files/cabins.plan" "14' room:14' none ; 1 gable(9:12) 1 flat ; living ; window window window" -o "$scratch/cottage.obj" 2>/dev/null || fail 'no cottage'
is 'gable ends' "$(python3 - "$scratch/cottage.obj" <<'PY'
import collections, sys
points, group, ends = [], None, collections.Counter()
for line in open(sys.argv[1]):
    word, *rest = line.split() or [""]
    if word == "v":
        points.append(tuple(map(float, rest)))
    elif word == "g":
        group = rest[-1]
    elif word == "f":
        corners = [points[int(r.split("/")[0]) - 1] for r in rest]
        if len({c[0] for c in corners}) == 1 and min(c[2] for c in corners) >= 2.7432:
            ends[group] += 1
print(*sorted(ends))
PY
)" 'gable roof'

# A roof whose heights are no whole nanometres is one plane over rooms and walls: no corners a few nanometres apart, which draw a line.
cat >"$scratch/lean-to.plan" <<'PLAN'
schema shed { bay = 5m  zone garden = none | room(5.4m)  zone way = path(2.4m) }
library sheds using shed { trays 2..2 }
form lean-to of shed {
  storey ground 3m  spine way  wall 400mm  partition 120mm  floor 350mm  roof 250mm
  option garden roof = shed(front, 1:3)
  function space at cell(any)
}
PLAN
"$TARTAN" house "$scratch/lean-to.plan" '5m none path:2.4m | 5m room:5.4m path:2.4m ; shed(front,1:3) ; space | space space' -o "$scratch/lean-to.obj"
is 'corners side by side' "$(python3 - "$scratch/lean-to.obj" <<'PY'
import sys
points = sorted({tuple(map(float, line.split()[1:])) for line in open(sys.argv[1]) if line.startswith("v ")})
print(sum(0 < max(abs(a - b) for a, b in zip(p, q)) < 1e-6 for i, p in enumerate(points) for q in points[i + 1:]))
PY
)" 0

# Flights are climbed by walks, and fit only where there is room for them.
golden count "tartan count stairs.plan --library towers"
golden no_way "tartan explain stairs.plan \"10' rooms:14' well:7'6\\\" ; gable(9:12,eaves-1',across) flat ; living living living climb climb climb\""
is 'each house that is counted is listed' "$("$TARTAN" enumerate "$files/stairs.plan" --library towers | wc -l)" 552
is 'and counted on its plan' "$("$TARTAN" count "$files/stairs.plan" --library towers --plan "22' rooms:14' well:7'6\" | 14' rooms:14' deep:12'" --json | sed 's/.*"houses":"\([0-9]*\)".*/\1/')" \
    "$("$TARTAN" enumerate "$files/stairs.plan" --library towers --plan "22' rooms:14' well:7'6\" | 14' rooms:14' deep:12'" | wc -l)"
finish
