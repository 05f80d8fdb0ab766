#!/usr/bin/env bash
# Functions in the open: walls beside their cells, what is in them, daylight, files; the same by brute force (tests/house_outdoor.py).
# Slow under sanitizers.
name=house_outdoor
. "$(dirname "$0")/golden.bash"
tests=$(cd "$here/.." && pwd)
cd "$scratch"
porch=$files/porch.plan

"$TARTAN" enumerate "$porch" --library all >all
awk 'NR % 7 == 1' all >some
is 'walls, doors and posts' "$(python3 -B "$tests/house_outdoor.py" "$TARTAN" "$porch" some)" '156 houses, 0 differ'
is 'as many houses as are counted' "$(wc -l <all)" "$("$TARTAN" count "$porch" --library all | awk '/^houses/ {print $2}')"

# Daylight comes in from yards, if they are in the open. Without the word they are rooms beside rooms.
sed 's/ outdoor at/ at/' "$porch" >rooms.plan
bright() { "$TARTAN" count "$1" --library bright 2>/dev/null | awk '/^houses/ {print $2}'; }
is 'houses with daylight' "$(bright "$porch") $(bright rooms.plan)" '544 144'
is 'the same one by one' "$("$TARTAN" enumerate "$porch" --library bright | wc -l) $("$TARTAN" enumerate rooms.plan --library bright 2>/dev/null | wc -l)" '544 144'
golden check "tartan check $scratch/rooms.plan"

# Walls beside porches are external in IFC, and outside walls in the table of parts.
python=python3
/usr/bin/python3 -c 'import ezdxf' 2>/dev/null && python=/usr/bin/python3
for number in 5 700; do
    "$TARTAN" house "$porch" "$(sed -n "${number}p" all)" -o house.json -o house.ifc --profile us -o house.dxf -o house.parts.csv >/dev/null
    is "files of house $number" "$($python "$tests/house_files.py" .)" fine
done
is 'spaces in the open' "$(grep -c 'IFCSPACE.*EXTERNAL' house.ifc)" "$(sed -n 700p all | cut -d';' -f3 | grep -oE 'porch|yard' | wc -l)"
finish
