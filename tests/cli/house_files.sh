#!/usr/bin/env bash
# A house for other programs: its IFC, JSON and DXF agree, each reference leads somewhere, and the same house has the same bytes.
name=house_files
. "$(dirname "$0")/golden.bash"

walk="12' double public great dense:8' open:12' open:4' | 8' single - - dense:8' dense:12' empty | 4' single - - dense:8' open:8' empty | 12' single - - dense:8' open:12' open:4'"
walk="$walk ; 1 flat 2 gable(12:12) 1 flat shingle ; kitchen hall void entry | bath stair stair | store passage passage | store bedroom bedroom seat"
walk="$walk ; glass ; line-kitchen.back long-table.left coats.left bath-room.back closet.back shelves.back day-bed.right bed.front window-seat.front"
hut="14' room:14' none ; 1 gable(9:12) 1 flat ; kitchen ; wall window wall wall ; counter.back"

# made FILE HOUSE FOLDER OPTION...: writes the files that are looked at.
made() {
    mkdir -p "$scratch/$3"
    "$TARTAN" house "$1" "$2" "${@:4}" --profile us -o "$scratch/$3/house.json" -o "$scratch/$3/house.ifc" -o "$scratch/$3/house.dxf" -o "$scratch/$3/house.parts.csv"
}
python=python3
/usr/bin/python3 -c 'import ezdxf' 2>/dev/null && python=/usr/bin/python3 # another Python may come first, without the package
reader=() # IfcPlusPlus reads the model again, where it is installed
if printf '#include <ifcpp/reader/ReaderSTEP.h>\n' | c++ -std=c++17 -w -fsyntax-only -x c++ - 2>/dev/null; then
    c++ -std=c++17 -w "$here/../ifc_read.cc" -o "$scratch/ifc_read" -lIfcPlusPlus
    reader=("$scratch/ifc_read")
fi
made lahave-form "$walk" walk
made "$files/cabins.plan" "$hut" hut
made lahave-form "$walk" again
is 'the walk-through' "$($python "$here/../house_files.py" "$scratch/walk" "${reader[@]}")" fine
climbed="22' rooms:14' well:7'6\" ; gable(9:12,eaves-1',across) flat ; living living living climb climb climb ; dogleg winding"
made "$files/stairs.plan" "$climbed" climbed
is 'a house with flights' "$($python "$here/../house_files.py" "$scratch/climbed" "${reader[@]}")" fine
made "$files/gallery.plan" "$("$TARTAN" sample "$files/gallery.plan" 1 --library inns --seed 2)" gallery
is 'a gallery' "$($python "$here/../house_files.py" "$scratch/gallery" "${reader[@]}")" fine
made "$files/guards.plan" '3m shallow:6m hall:4m | 4m deep:7m hall:4m | 5m shallow:6m hall:4m' guarded
is 'a house with guards' "$($python "$here/../house_files.py" "$scratch/guarded" "${reader[@]}")" fine
is 'the price of its guards' "$(grep ^guard "$scratch/guarded/house.parts.csv" | tr -d '\r')" 'guard,7,22.143000,1.107150,steel,90.000000,m2,1992.87'
is 'a hut' "$($python "$here/../house_files.py" "$scratch/hut" "${reader[@]}")" fine
letters=$("$TARTAN" sample "$files/letters.plan" 1 --library häuser --where 'quantity(tray(gang), n > 1)' --seed 3)
title="it's \\ küche 寝室 𐤀 \"x\""
made "$files/letters.plan" "$letters" letters --title "$title"
is 'letters of many alphabets' "$($python "$here/../house_files.py" "$scratch/letters" "${reader[@]}" --title "$title")" fine

# Layers of walls, posts and decks: those of the JSON are those of the IFC, and the list of parts is worked out from them.
"$TARTAN" sample "$files/layers.plan" 3 --library all --seed 4 >"$scratch/houses"
while read -r house; do
    made "$files/layers.plan" "$house" layers
    is 'a house in layers' "$($python "$here/../house_files.py" "$scratch/layers" "${reader[@]}")" fine
done <"$scratch/houses"
# Codes of parts and rooms, in three systems: what the form says, all of it and nothing else.
"$TARTAN" sample "$files/classes.plan" 3 --library all --seed 4 >"$scratch/coded"
while read -r house; do
    made "$files/classes.plan" "$house" coded-house
    is 'a house with codes' "$($python "$here/../house_files.py" "$scratch/coded-house" "${reader[@]}" --form "$files/classes.plan")" fine
done <"$scratch/coded"
"$TARTAN" house "$files/layers.plan" "$(head -n 1 "$scratch/houses")" --view section:x=5\' --scale 20 -o "$scratch/close.svg"
"$TARTAN" house "$files/layers.plan" "$(head -n 1 "$scratch/houses")" --view section:x=5\' --scale 200 -o "$scratch/far.svg"
cedar='fill="#dfcab9"' # of the boards, light
grep -q "$cedar" "$scratch/close.svg" || fail 'a section does not show layers that are thick enough on paper'
! grep -q "$cedar" "$scratch/far.svg" || fail 'a section shows layers that are too thin on paper'

# Doors of every kind, that hang on either side, in walls of both directions.
for library in row-houses apartments; do
    "$TARTAN" sample $library 1 --library $library --seed 5 >"$scratch/houses"
    while read -r house; do
        made $library "$house" doors
        is "a house of $library" "$($python "$here/../house_files.py" "$scratch/doors")" fine
        cat "$scratch/doors/house.ifc" >>"$scratch/models"
    done <"$scratch/houses"
done
cat "$scratch/letters/house.ifc" >>"$scratch/models"
for operation in SINGLE_SWING_LEFT SINGLE_SWING_RIGHT DOUBLE_DOOR_SINGLE_SWING; do
    grep -q "IFCDOOR.*$operation" "$scratch/models" || fail "no door is $operation"
done
# The rules that the models are held to find what is wrong with one.
for house in walk doors guarded climbed coded-house; do
    is "faults in the model of $house" "$($python "$here/../ifc_file.py" --faults "$scratch/$house/house.ifc")" fine
done

# In the next version of a house all parts keep their identifiers but those that are gone: here a window became a wall.
made "$files/cabins.plan" "${hut/window/wall}" edited
window='IFCOPENINGELEMENT IFCRELFILLSELEMENT IFCRELSPACEBOUNDARY IFCRELVOIDSELEMENT IFCWINDOW'
types='IFCELEMENTQUANTITY IFCPROPERTYSET IFCRELDEFINESBYPROPERTIES IFCRELDEFINESBYTYPE IFCWINDOWTYPE'
is 'a window less' "$($python "$here/../ifc_file.py" --kept "$scratch/hut/house.ifc" "$scratch/edited/house.ifc" | tr ' ' '\n' | sort -u)" \
    "$(printf '%s\n' $window $types IFCRELASSOCIATESMATERIAL | sort)"
is 'and nothing more' "$($python "$here/../ifc_file.py" --kept "$scratch/edited/house.ifc" "$scratch/hut/house.ifc")" ''
two="14' room:14' porch:5' | 14' room:14' porch:5' ; 2 shed(back,4:12) 1 flat ; kitchen bedroom porch-deck | living bedroom porch-deck"
two="$two ; window window door wall window wall wall wall window window wall window window ; counter.back bed.front.m bed.front"
made "$files/cabins.plan" "$two" two
made "$files/cabins.plan" "${two/%window ; counter*/wall ; counter.back bed.front.m bed.front}" fewer
is 'one of several windows less' "$($python "$here/../ifc_file.py" --kept "$scratch/two/house.ifc" "$scratch/fewer/house.ifc")" "$window"
made "$files/cabins.plan" "$two" named --project 'another house'
is 'another project has other identifiers' "$($python "$here/../ifc_file.py" --kept "$scratch/two/house.ifc" "$scratch/named/house.ifc" | wc -w)" \
    "$(grep -oE "IFC[A-Z]+\('[0-3][0-9A-Za-z_\$]{21}'" "$scratch/two/house.ifc" | wc -l)"
# What an office says of a model.
"$TARTAN" house "$files/cabins.plan" "$hut" --date 2028-02-29 --author "Zoë O'Neil" --latitude 44.5 --longitude -64.0001 --north 90 --project 'the lake' \
    --title cabin -o "$scratch/said.ifc"
is 'a model with more of it' "$($python "$here/../ifc_file.py" "$scratch/said.ifc")" fine
says() {
    grep -qF "$2" "$scratch/said.ifc" || fail "the model says no $1: $2"
}
says 'date and author' "FILE_NAME('cabin','2028-02-29T00:00:00',('Zo\\X2\\00EB\\X0\\ O''Neil')"
says place '.ELEMENT.,(44,30,0,0),(-64,0,0,-360000),'
says north '=IFCDIRECTION((-1.,0.))'
says project "\$,'the lake',"
says 'name of the house' "\$,'cabin',"
refused() {
    is "$1" "$("$TARTAN" house "$files/cabins.plan" "$hut" "${@:3}" 2>&1 | sed -n 's/^error\[E0904\]: //p')" "$2"
}
refused 'a date of drawings' '`12 May` is no date as IFC files have them' --date '12 May' -o "$scratch/none.ifc"
refused 'a day that is not' '`2027-02-29` is no date as IFC files have them' --date 2027-02-29 -o "$scratch/none.ifc"
refused 'a place that is not' 'a latitude is from -90 to 90 degrees, not 91' --latitude 91 -o "$scratch/none.ifc"
refused 'a place without a model' '--longitude is about building models, and no file is one' --longitude 3 -o "$scratch/none.svg"
refused 'north without either' '--north is about drawings and building models, and no file is one' --north 3 -o "$scratch/none.obj"
"$TARTAN" house "$files/cabins.plan" "$hut" --date '12 May' -o "$scratch/none.svg" || fail 'drawings have dates as they are written'

cmp "$scratch/walk/house.ifc" "$scratch/again/house.ifc" || fail 'two models of one house differ'
cmp "$scratch/walk/house.dxf" "$scratch/again/house.dxf" || fail 'two drawings of one house differ'
is 'a wrong view leaves no drawing' "$("$TARTAN" house "$files/cabins.plan" "$hut" --view plan:attic -o "$scratch/none.dxf" 2>/dev/null || ls "$scratch/none.dxf" 2>&1 | wc -l)" 1
finish
