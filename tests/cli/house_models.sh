#!/usr/bin/env bash
# Needs the parts: mesh draw
# Models of houses with names: the .glb and the .obj have the same parts and materials, glass is seen through, and facts are those of the tables.
name=house_models
. "$(dirname "$0")/golden.bash"
stdlib=$here/../../stdlib

# model WHAT FILE HOUSE OPENING...: those are glazed.
model() {
    local what=$1 file=$2 house=$3
    shift 3
    rm -rf "$scratch/made"
    "$TARTAN" house "$file" "$house" -o "$scratch/made/" 2>"$scratch/said" || fail "$what: no model: $(cat "$scratch/said")"
    is "$what" "$(python3 "$here/../house_models.py" "$scratch/made" "$@")" fine
}
# drawn FILE LIBRARY SEED
drawn() {
    "$TARTAN" sample "$1" 1 --library "$2" --seed "$3" 2>/dev/null
}

model 'panes without a material' "$files/cabins.plan" '#10:77' window
model 'no glass' "$files/cabins.plan" "14' room:14' none ; 1 gable(9:12) 1 flat ; kitchen ; wall wall wall wall ; counter.back" window
model 'flights' "$files/stairs.plan" "22' rooms:14' well:7'6\" | 22' rooms:14' deep:12' ; gable(9:12,eaves-1',across) flat ; living living living climb climb climb | living living living climb climb climb ; dogleg dogleg winding winding" window
model 'materials without prices' "$stdlib/cottage.plan" "$(drawn "$stdlib/cottage.plan" cottages 4)" window strip
model 'prices, and doors of glass' "$stdlib/row-houses.plan" "$(drawn "$stdlib/row-houses.plan" row-houses 2)" sash casement french
model 'a hundred rooms' "$stdlib/apartments.plan" "$(drawn "$stdlib/apartments.plan" apartments 3)" window french entrance

# Names: beyond ASCII, longer than others keep, taken twice; a material of panes and of other parts; materials that are called as kinds of parts.
cat >"$scratch/haus.plan" <<'PLAN'
schema haus { bay = 4m | 5m  zone wohnen = none | room(5m) }
library häuser using haus { trays 1..3 }
form gebäude of haus {
  storey erdgeschoß 2700mm
  spine wohnen
  wall 300mm  partition 100mm  floor 300mm  roof 250mm
  option wohnen roof = flat
  function küche at cell(any)
  opening fenster-nach-süden-mit-einem-sehr-langen-namen-und-noch-mehr wide 1m high 1m sill 900mm
  opening tür wide 900mm high 2m passage
  opening glastür wide 900mm high 2m passage glazed
  face cell(any) outside = fenster-nach-süden-mit-einem-sehr-langen-namen-und-noch-mehr | glastür | wall
  face cell(any) beside cell(any) = tür | glastür
  material pane "#804020" for wall, fenster-nach-süden-mit-einem-sehr-langen-namen-und-noch-mehr
  material glass "#a0c0e0" for tür
}
library alle from häuser in gebäude { }
PLAN
long=fenster-nach-süden-mit-einem-sehr-langen-namen-und-noch-mehr
"$TARTAN" check "$scratch/haus.plan" >"$scratch/said" 2>&1 || fail "$(cat "$scratch/said")"
model 'names' "$scratch/haus.plan" "4m room:5m | 5m room:5m ; flat ; küche | küche ; $long $long glastür tür wall $long glastür" $long glastür
is 'materials' "$(sed -n 's/^newmtl //p' "$scratch/made/house.mtl" | sort | paste -sd ' ')" 'deck glass glass-plain pane pane-glass partition post roof roofdeck'
is 'its room' "$(grep -c '^o erdgeschoß/0.02-küche/' "$scratch/made/house.obj")" "$(sed -n 's/^o erdgeschoß.0.02-küche.//p' "$scratch/made/house.obj" | wc -l)"

# An .obj cites the .mtl beside it, whatever it is called; another .obj has one of its own. One that is asked for is made once.
cd "$scratch" || exit
"$TARTAN" house "$files/cabins.plan" '#10:77' -o 'a b.obj' -o other/c.OBJ -o c.mtl 2>/dev/null || true
mkdir -p other
"$TARTAN" house "$files/cabins.plan" '#10:77' -o 'a b.obj' -o other/c.obj -o c.mtl -o other/c.mtl || fail 'no files'
is 'cited' "$(sed -n 's/^mtllib //p' 'a b.obj' other/c.obj | paste -sd ,)" 'a b.mtl,c.mtl'
is 'made' "$(cmp 'a b.mtl' other/c.mtl && cmp c.mtl other/c.mtl && echo same)" same
is 'the line' "$(sed -n '1s/^# //p' 'a b.obj')" "$("$TARTAN" house "$files/cabins.plan" '#10:77')"

# A line longer than what is written at once.
long=$(printf "5m room:5m | %.0s" $(seq 600))
"$TARTAN" house "$scratch/haus.plan" "${long% | }" -o "$scratch/long.obj" 2>"$scratch/said" ||
    fail "a long house: $(head -2 "$scratch/said")"
is 'a long line' "$(sed -n '1s/^# //p' "$scratch/long.obj" | md5sum)" "$("$TARTAN" house "$scratch/haus.plan" "${long% | }" 2>/dev/null | md5sum)"
finish
