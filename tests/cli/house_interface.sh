#!/usr/bin/env bash
# Needs the parts: draw mesh store
# The functions of the C interface about houses answer what the command does: counts, numbers, samples, the best, what else a house could be,
# and files, byte by byte.
name=house_interface
. "$(dirname "$0")/golden.bash"
program=$(dirname "$TARTAN")/tests/house_interface
cd "$here/../.."

# asked QUESTION WORD...: of the library at hand.
asked() {
    (IFS=$'\t' && printf '%s\n' "$*") | "$program" stdlib "$file" "$library" ${most:+"$most"}
}
# field NAME: of each line of JSON.
field() {
    python3 -c 'import json, sys
for line in sys.stdin: print(json.loads(line)[sys.argv[1]])' "$1"
}
# first_error COMMAND...: the sentence of it.
first_error() {
    "$@" 2>&1 >"$scratch/out" | sed -nE 's/^(.*: )?error(\[E[0-9]+\])?: /error /p' | head -n 1
}

# library_of FILE LIBRARY MEASURE
library_of() {
    file=$1 library=$2
    local in=(--library "$library") line plan format
    is "$library: how many" "$(asked count)" "$("$TARTAN" count "$file" "${in[@]}" --json | field houses)"
    is "$library: so long" "$(asked count 2)" "$("$TARTAN" count "$file" "${in[@]}" --json | python3 -c 'import json, sys
print(json.load(sys.stdin)["by_length"].get("2", "0"))')"
    is "$library: too long" "$(asked count 4000)" 0
    is "$library: drawn" "$(asked sample 3 5)" "$("$TARTAN" sample "$file" 5 "${in[@]}" --seed 3)"
    line=$("$TARTAN" sample "$file" 1 "${in[@]}" --seed 8)
    plan=${line%% ; *}
    is "$library: on a plan" "$(asked on "$plan")" "$("$TARTAN" count "$file" "${in[@]}" --plan "$plan" --json | field houses)"
    is "$library: its number" "#$(asked number "$line")" "$("$TARTAN" rank "$file" "$line" "${in[@]}")"
    is "$library: its rank" "#$(asked rank "$line")" "$("$TARTAN" rank "$file" "$line" "${in[@]}" --of-all)"
    is "$library: of a number" "$(asked house "$(asked number "$line")")" "$line"
    is "$library: of a rank" "$(asked house "#$(asked rank "$line")")" "$line"
    is "$library: else" "$(asked vary "$line")" "$("$TARTAN" vary "$file" "$line" "${in[@]}" --json | python3 -c 'import json, sys
for c in map(json.loads, sys.stdin): print(c["kind"], c["where"], c["from"], c["to"], c["house"], sep="\t")')"
    is "$library: least" "$(asked least "$3" 4 | cut -f2)" "$("$TARTAN" best "$file" "${in[@]}" 4 --least "$3" | grep -v '^#')"
    is "$library: most" "$(asked most "$3" 4 | cut -f2)" "$("$TARTAN" best "$file" "${in[@]}" 4 --most "$3" | grep -v '^#')"
    for format in json csv parts.csv obj mtl ply glb ifc dxf svg png pdf; do
        asked file $format "$line" >"$scratch/asked"
        "$TARTAN" house "$file" "$line" -o "$scratch/written.$format"
        cmp "$scratch/asked" "$scratch/written.$format" || fail "$library: $format is another file"
    done
    asked file svg "$line" axonometric >"$scratch/asked"
    "$TARTAN" house "$file" "$line" --view axonometric -o "$scratch/written.svg"
    cmp "$scratch/asked" "$scratch/written.svg" || fail "$library: the view is another file"
    is "$library: no view" "$(asked file svg "$line" elevation:up)" "$(first_error "$TARTAN" house "$file" "$line" --view elevation:up -o "$scratch/written.svg")"
    is "$library: no measure" "$(asked least nothing 1 | sed "s:the module:$file:")" "$(first_error "$TARTAN" best "$file" "${in[@]}" --least nothing)"
    is "$library: past the last" "$(asked house '#99999999999999999999999999')" \
        "$(first_error "$TARTAN" house "$file" '#99999999999999999999999999' "${in[@]}" -o "$scratch/past.svg")"
    is "$library: not its own" "$(asked house 'nothing ; at all')" "$(first_error "$TARTAN" rank "$file" 'nothing ; at all' "${in[@]}")"
}
library_of examples/lake-retreat/retreat.plan retreats price
library_of tests/cli/files/priced.plan barns offer

# Walks: what is asked of the houses on one plan, and those of all plans that are tried.
cat >"$scratch/walked.plan" <<'PLAN'
schema row { width role length = 3m | 4m  zone house role band = space(4m) }
form f of row {
  storey ground 2.7m
  wall 200mm
  partition 100mm
  deck 300mm
  roof 200mm
  way 800mm
  function first at cell(3m)
  function second at cell(any)
  opening door wide 900mm high 2m passage sliding
  opening hatch wide 900mm high 2m passage sliding
  face cell(any) beside cell(any) = door | hatch | wall
  face cell(any) outside left = door
  face cell(any) outside = wall
  tile tables for second { item table left 500mm..1.2m, back 500mm..1.2m }
  tile bare for second { }
  material pine "#c0a080" price 100 per m2 for table
}
library rows using row { trays 1..3 }
library all from rows in f { }
library near from rows in f { require walk(cell(second), to outside) <= 5.95m, exits(cell(first)) = 1 }
measure far = walk(cell(any), to outside)
measure shortest = least walk(cell(second), to cell(first))
measure both = far / 1m + sum(cost) / 100 - exits(cell(any))
PLAN
file=$scratch/walked.plan plan='3m space:4m | 4m space:4m | 3m space:4m'
for library in all near; do
    in=("$file" --library "$library" --plan "$plan")
    is "$library: on a plan" "$(asked on "$plan")" "$("$TARTAN" count "${in[@]}" --json | field houses)"
    is "$library: drawn there" "$(asked sample 3 5 "$plan")" "$("$TARTAN" sample "${in[@]:0:1}" 5 "${in[@]:1}" --seed 3)"
    for measure in far shortest both; do
        for wish in least most; do
            "$TARTAN" best "${in[@]:0:1}" 40 "${in[@]:1}" --$wish $measure --format json 2>/dev/null |
                python3 -c 'import json, sys
for line in sys.stdin: print(*(json.loads(line)[name] for name in ("value", "house")), sep="\t")' >"$scratch/wanted"
            [ "$(wc -l <"$scratch/wanted")" = 40 ] || fail "$library: few of $measure: $(wc -l <"$scratch/wanted")"
            asked $wish $measure 40 "$plan" | diff "$scratch/wanted" - || fail "$library: the $wish $measure are others"
        done
    done
    most=20
    is "$library: too many" "$(asked least far 3 "$plan")" "$(first_error "$TARTAN" best "$file" 3 "${in[@]:1}" --least far --max-houses 20)"
    is "$library: of all plans" "$(asked least far 3)" "$(first_error "$TARTAN" best "$file" 3 --library "$library" --least far)"
    most=
done
is 'near: drawn' "$(asked sample 3 9)" "$("$TARTAN" sample "$file" 9 --library near --seed 3 2>/dev/null)"
is 'near: counted' "$(asked count)" "$(first_error "$TARTAN" count "$file" --library near)"
line=$("$TARTAN" sample "$file" 1 --library near --plan "$plan")
is 'near: its number' "#$(asked number "$line")" "$("$TARTAN" rank "$file" "$line" --library near)"
is 'near: of a number' "$(asked house "$(asked number "$line")")" "$line"
is 'near: else' "$(asked vary "$line" | wc -l)" "$("$TARTAN" vary "$file" "$line" --library near --json | wc -l)"
most=3
is 'near: none of so few' "$(asked sample 4 9)" "$(first_error "$TARTAN" sample "$file" 9 --library near --seed 4 --max-houses 3)"
most=

library=none
is 'no library' "$(asked count)" 'error the module has no library of houses `none`'

finish
