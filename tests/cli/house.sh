#!/usr/bin/env bash
# Houses: lines read and written again, tables and models, and lines that are no houses.
name=house
. "$(dirname "$0")/golden.bash"
cp "$files/cabins.plan" "$scratch" # for edited copies of files that use it

golden line "tartan house cabins.plan \"14' room:14' none ; 1 gable(9:12) 1 flat ; living ; window wall window\""
golden bad_face "tartan house cabins.plan \"14' room:14' none ; 1 gable(9:12) 1 flat ; living ; window window door window\""
golden short "tartan house cabins.plan \"10' room:14' porch:5' | 14' room:14' none ; 2 shed(back,4:12) 1 flat ; living bedroom porch-deck | kitchen bedroom ; wall wall open window wall window wall window wall window window wall wall window ; bed.back counter.back bed.back.m\""
golden rooms "tartan house cabins.plan \"14' room:14' none ; 1 gable(9:12) 1 flat ; kitchen ; wall window wall wall ; counter.back\" -o $scratch/rooms.csv && cat $scratch/rooms.csv"
golden no_plan "tartan house cabins.plan ''"
golden elsewhere_function "tartan house cabins.plan \"14' room:14' none ; 1 gable(9:12) 1 flat ; porch-deck ; wall window wall wall\""
golden unknown_kind "tartan house cabins.plan \"14' room:14' none ; 1 gable(9:12) 1 flat ; kitchen ; wall window wall gate\""
golden other_tile "tartan house cabins.plan \"14' room:14' none ; 1 gable(9:12) 1 flat ; kitchen ; wall window wall wall ; bed.back\""
golden bad_value "tartan house cabins.plan \"13' room:14' none\""
golden no_section "tartan house cabins.plan \"14' room:14' none\""
golden bad_function "tartan house cabins.plan \"14' room:14' none ; 1 gable(9:12) 1 flat ; study\""
golden too_many "tartan house cabins.plan \"14' room:14' none ; 1 gable(9:12) 1 flat ; living living\""
golden six_parts "tartan house cabins.plan ';;;;;'"
golden bad_tile "tartan house cabins.plan \"14' room:14' none ; 1 gable(9:12) 1 flat ; kitchen ; wall window wall wall ; oven.back\""
golden forbidden_section "tartan house row-houses '2.2m first two room:3m room:4m room:5m | 4m - two none room:4m room:5m ; 1 flat shed(back,3:4) flat brick'"
golden missing_bar "tartan house cabins.plan \"14' room:14' none | 14' room:14' none ; 1 gable(9:12) 1 flat ; living kitchen\""
golden misplaced_bar "tartan house cabins.plan \"14' room:14' none | 14' room:14' porch:5' ; 1 gable(9:12) 1 flat ; living | kitchen | porch-deck\""
golden early_bar "tartan house cabins.plan \"14' room:14' porch:5' | 14' room:14' none ; 1 gable(9:12) 1 flat ; living | porch-deck kitchen\""
golden json_function "tartan house cabins.plan '{\"house\": \"14\\u0027 room:14\\u0027 none ; 1 gable(9:12) 1 flat ; study\"}'"
golden json_no_house "tartan house cabins.plan '{\"rank\": \"3\"}'"
golden json_twice "tartan house cabins.plan '{\"house\": \"\", \"house\": \"\"}'"
golden no_form "tartan house sheds.plan ''"
golden no_format "tartan house cabins.plan '' -o house.stl"
golden too_near "tartan house near.plan \"9' open:9' | 9' open:9'6\\\" ; - ; hall | hall\""
printf "schema s { width = 4'  zone body = room(6') }\nlibrary none using s { trays 0 }\nform f of s { storey low 8' wall 8\" partition 8\" floor 8\" roof 8\" }\nlibrary h from none in f { }\n" >"$scratch/none.plan"
golden no_cell "tartan house $scratch/none.plan '#0' --library h -o $scratch/none.dxf"

# Values that are left out: the first house that has the others; the value that leaves none; all mistakes at once.
two="14' room:14' none | 14' room:14' none"
golden typed_plan "tartan house cabins.plan \"$two\""
golden typed_values "tartan house cabins.plan \"$two ; 2 _ _ _ ; living _ | kitchen _ ; - ; bed.left _ _\""
golden typed_form "tartan house cabins.plan \"$two ; 1 gable(9:12) 1 flat ; _ | bedroom\""
golden typed_other_plan "tartan house cabins.plan \"10' room:14' none ; _ _ _ _ ; living\""
golden typed_none "tartan house cabins.plan \"$two ; 2 _ _ _ ; - ; - ; bed.left counter.back.m bed.right\""
golden typed_function "tartan house cabins.plan \"$two ; 1 _ _ _ ; porch-deck | _\""
golden typed_mistakes "tartan house cabins.plan \"$two ; 2 gabel _ flat ; livin bedroom | kitchen bedrom ; windw _ ; bd.left\""
golden typed_known_mistakes "tartan house cabins.plan \"$two ; 1 gable(9:12) 1 flat ; living | kitchen ; door window open gate wall wall ; oven.back\""
golden typed_short "tartan house cabins.plan \"$two ; 1\""
golden typed_in_plan "tartan house cabins.plan \"14' _ none ; 1 _ _ _ ; bath\""
golden typed_json "tartan house cabins.plan '{\"house\": \"14\\u0027 room:14\\u0027 none ; 1 _ _ _ ; study ; wnidow\"}'"
golden typed_rank "tartan rank cabins.plan \"$two ; 2 _ _ _ ; living _ | kitchen _\""
golden typed_rank_dropped "tartan rank cabins.plan \"$two ; 2 _ _ _ ; living _ | bedroom _\""
golden typed_vary "tartan vary cabins.plan \"$two ; 2 _ _ _ ; living _ | kitchen _\" --at 1.body.ground"
golden typed_explained "tartan explain cabins.plan \"$two ; 2 _ _ _ ; living _ | bedroom _\""
golden typed_explained_json "tartan explain cabins.plan \"$two ; 2 _ _ _ ; living _ | kitchen _\" --json | head -n 4"
golden typed_matched "printf '%s\n' \"$two ; 1 _ _ _ ; bedroom | _\" \"$two ; 1 _ _ _ ; living | cellar\" | tartan match cabins.plan"
is 'the first house that has all of a line is its own' "$("$TARTAN" house "$files/cabins.plan" "$("$TARTAN" unrank "$files/cabins.plan" '#10:77' | sed 's/ ; [^;]*;/ ; _ _ _ _ ;/')" | cut -d ';' -f 3-)" "$("$TARTAN" unrank "$files/cabins.plan" '#10:77' | cut -d ';' -f 3-)"

bedrooms="14' room:14' none | 14' room:14' none ; 1 gable(9:12) 1 flat ; bedroom | bedroom ; wall wall wall wall wall wall"
golden dropped "tartan explain cabins.plan \"$bedrooms\""
golden dropped_json "tartan explain cabins.plan \"$bedrooms\" --json"

# `through` may come before `by` or behind it.
for parts in 'through cell(any), by door or open' 'by door or open, through cell(any)'; do
    file=$scratch/${parts%% *}.plan
    cat "$files/cabins.plan" >"$file"
    printf 'library walked from cottage-rows in cottage-form {\n  prune apart(cell(bedroom), from cell(living), %s) as cut-off\n}\n' "$parts" >>"$file"
    "$TARTAN" count "$file" --library walked >"$scratch/${parts%% *}.count"
done
cmp -s "$scratch/through.count" "$scratch/by.count" || fail 'apart says something else with by before through'
grep -q '^houses  *[1-9]' "$scratch/by.count" || fail 'no houses with by before through'
golden explained_rule "tartan explain cabins.plan \"$bedrooms\" --rule far-bed --rule dark-living"

# Why a house is dropped is drawn: both bedrooms shine red, and no clause that keeps the house is there unless all are.
"$TARTAN" explain "$files/cabins.plan" "$bedrooms" -o "$scratch/why.svg" >"$scratch/said"
[ -s "$scratch/said" ] && fail 'a picture is written, and a text, too'
shines() { grep -o 'fill="#c7332b" fill-opacity' "$1" | wc -l; }
is 'bedrooms that are at fault' "$(shines "$scratch/why.svg")" 2
for words in 'cottages drops this house' 'far-bed: matches, and is pruned' 'require@65: does not hold' 'plan, ground'; do
    grep -qF "$words" "$scratch/why.svg" || fail "the picture does not say: $words"
done
grep -q dark-living "$scratch/why.svg" && fail 'a clause that keeps the house is drawn'
"$TARTAN" explain "$files/cabins.plan" "$bedrooms" --full -o "$scratch/full.svg"
grep -q dark-living "$scratch/full.svg" || fail 'a clause that keeps the house is not drawn with --full'
"$TARTAN" explain "$files/cabins.plan" "$bedrooms" --rule far-bed -o "$scratch/rule.svg"
grep -q 'fill="#5ca861" fill-opacity' "$scratch/rule.svg" || fail 'what a rule finds does not shine green'
(cd "$files" && "$TARTAN" explain bare.plan "8' open ; - ; hall" -o "$scratch/tiles.svg" && "$TARTAN" explain bare.plan '#0:' --library halls -o "$scratch/bare.svg")
is 'a cell without a tile' "$(shines "$scratch/tiles.svg")" 1
is 'a cell that keeps houses off its plan' "$(shines "$scratch/bare.svg")" 1
"$TARTAN" explain "$files/cabins.plan" '#10:77' -o "$scratch/kept.svg"
grep -qF 'cottages keeps this house' "$scratch/kept.svg" || fail 'a kept house is not drawn'
is 'what is at fault in a kept house' "$(shines "$scratch/kept.svg")" 0
golden explained_tiles "tartan explain bare.plan \"8' open ; - ; hall\""
golden explained_plan "tartan explain bare.plan '#0:' --library halls"
golden explained_plan_json "tartan explain bare.plan '#1:' --library halls --json"
golden explained_plan_bare "tartan explain no-function.plan '#0:' --library halls"
golden explained_plan_high "tartan explain too-high.plan '#0:' --library barns"
golden explained_plan_well "tartan explain cabins.plan \"14' room:14' none\" --library cottages"
golden explained_plan_wrong "tartan explain cabins.plan \"14' room:14'\" --library cottages"
golden explained_plan_none "tartan explain cabins.plan '#4000000:' --library cottages"
golden explained_number "tartan explain cabins.plan '#10:77' --full"
golden explained_rank "tartan explain cabins.plan '#77' --library cottages"
golden explained_rank_past "tartan explain cabins.plan '#99999999' --library cottages"
golden explained_number_past "tartan explain cabins.plan '#10:x'"
golden sample_none_on_plan "tartan sample bare.plan 1 --library halls --plan '#0'"
golden sample_none "tartan sample bare.plan 1 --library halls"
golden sample_few "tartan sample cabins.plan 100 --library cottages --plan \"14' room:14' none | 14' room:14' none | 14' room:14' none\" --where 'option(body storeys 1) and option(body roof gable)' --where 'room(kitchen, not by window)' --where 'room(bedroom, not by window or open)' --where 'room(living, not by open)' --seed 1 | wc -l"
golden explained_near "tartan explain lahave-complete \"12' double public great dense:8' open:12' open:4' | 8' single - - dense:8' dense:12' empty | 4' single - - dense:8' open:8' empty | 12' single - - dense:8' open:12' open:4' ; 1 flat 2 gable(12:12) 1 flat shingle ; kitchen hall void entry | bath stair stair | store passage passage | bath bedroom bedroom seat ; glass\""
golden explained_line "tartan explain cabins.plan \"14' room:14' none ; 3\""
golden behind_roof "tartan explain lean-to.plan \"12' room:10' open:6' ; 2 1 shed(front,4:12) ; living bedroom veranda ; window window window window\""
golden behind_roof_shifted "tartan explain lean-to.plan \"12' room:10' open:6' ; 2 1 shed(front,4:12) ; living bedroom veranda ; window window slot window window\""
golden behind_roof_full "tartan explain lean-to.plan \"12' room:10' open:6' ; 2 1 shed(front,4:12) ; living bedroom veranda ; window window slot window\" --full"
golden behind_roof_json "tartan explain lean-to.plan \"12' room:10' open:6' ; 2 1 shed(front,4:12) ; living bedroom veranda ; window window slot window\" --json"
golden behind_roof_metres 'sed "s/4:12/1:3/; s/12. | 16./3.6m/; s/(10.)/(3m)/; s/open(6.)/open(1.8m)/" lean-to.plan > $scratch/metres.plan && tartan explain $scratch/metres.plan "3.6m room:3m open:1.8m ; 2 1 shed(front,1:3) ; living bedroom veranda ; window window window"'
golden explained_nothing "tartan explain sheds.plan ';'"
golden library_of_plans "tartan unrank cabins.plan '#1' --library cottage-rows"
golden library_near "tartan vary cabins.plan '#1' --library cottage"
golden library_near_of_both 'tartan count cabins.plan --library cottage'
golden open_plan_depth "tartan complete cabins.plan \"14' room:14' porch | ...\" --library cottages"
golden measure_cost 'tartan best row-houses 1 --library row-houses --least cost'
cat >"$scratch/cells.plan" <<'PLAN'
schema row { bay = 4m  zone rooms = room(4m) }
form cells of row {
  storey ground 3m
  wall 300mm
  partition 100mm
  floor 250mm
  roof 200mm
  function bedroom at cell(rooms)
  opening sash wide 1m high 1m sill 1m
  face cell(any) along cell(any) = party
  face cell(any) outside = sash
  tile bed for bedroom { against wall or open  item bed left 1m..2m, back 0..2m }
}
library rows using row { trays 2 }
library houses from rows in cells { }
PLAN
golden explained_no_side "tartan explain $scratch/cells.plan '#0:' --library houses"

# A section along the side of a flight, where the parts of the decks meet: they are cut, as they are a little beside.
cat >"$scratch/tower.plan" <<'PLAN'
schema tower { side = 6m  zone well = shaft(6m) }
form tower-form of tower {
  storey cellar 2.8m
  storey hall 2.8m
  wall 600mm
  partition 150mm
  floor 300mm
  roof 250mm
  function stair at cell(well)
  flight dogleg wide 1.2m rise 150mm..190mm going 260mm turn half
  face cell(stair) under cell(stair) = dogleg
}
PLAN
for at in 1.5m 1.49m; do
    "$TARTAN" house "$scratch/tower.plan" '6m shaft:6m' --view "section:x=$at" -o "$scratch/$at.dxf"
    grep -c '^HATCH' "$scratch/$at.dxf" || true
done >"$scratch/hatched"
is 'decks that are hatched along a flight' "$(head -n 1 "$scratch/hatched")" "$(tail -n 1 "$scratch/hatched")"
golden matched "printf '%s\n' '# two' \"$bedrooms\" | tartan match cabins.plan --rule far-bed --rule dark-living"
golden matched_any "printf '%s\n' \"$bedrooms\" | tartan match cabins.plan --rule far-bed --rule dark-living --format any"
golden matched_badly "printf '%s\n' '' \"14' room:14' none ; 3\" | tartan match cabins.plan --rule far-bed"
golden failed_test "tartan test houses-wrong.plan"

golden count_plan "tartan count cabins.plan --library cottages --plan \"14' room:14' none | 14' room:14' none | 14' room:14' none\" --json"
golden count_no_plan "tartan count cabins.plan --plan \"10' room:14' none\""
golden count_bad_plan "tartan count cabins.plan --plan '#600'"
golden unrank "tartan unrank cabins.plan '#10:77'"
golden unrank_no_house "tartan unrank lahave-complete '#99:0'"
golden unrank_no_number "tartan unrank cabins.plan '#10:x'"
golden rank "tartan rank cabins.plan \"\$(tartan unrank cabins.plan '#10:77')\""
"$TARTAN" sample "$files/cabins.plan" 4 --library cottages --seed 6 --format json >"$scratch/houses.jsonl"
is 'houses that JSON lines hold' "$(while read -r line; do "$TARTAN" rank "$files/cabins.plan" "$line" | sed 's/^#//'; done <"$scratch/houses.jsonl")" \
    "$(sed 's/.*"plan_rank":"\([0-9]*\)","variant":"\([0-9]*\)".*/\1:\2/' "$scratch/houses.jsonl")"
golden matched_json "tartan sample cabins.plan 2 --library cottages --seed 6 --format json | tartan match cabins.plan --rule far-bed --rule dark-living"
golden rank_dropped "tartan rank cabins.plan \"$bedrooms\""

# Drawings: what is asked wrongly, and that the same house gives the same picture.
room="14' room:14' none ; 1 gable(9:12) 1 flat ; kitchen ; wall window wall wall ; counter.back"
golden view_unknown "tartan house cabins.plan \"$room\" -o $scratch/h.svg --view perspective"
golden view_storey "tartan house cabins.plan \"$room\" -o $scratch/h.svg --view plan:attic"
golden view_section "tartan house cabins.plan \"$room\" -o $scratch/h.svg --view section:z=3\'"
golden view_side "tartan house cabins.plan \"$room\" -o $scratch/h.svg --view elevation:north"
golden view_of_nothing "tartan house cabins.plan \"$room\" -o $scratch/h.ifc --view plan:ground"
golden cut_of_nothing "tartan house cabins.plan \"$room\" --cut ground"
golden view_cut "tartan house cabins.plan \"$room\" -o $scratch/h.svg --cut cellar"
golden no_number "tartan house cabins.plan '#ten'"
row="2.2m first two room:3m room:4m room:5m | 4m - two none room:4m room:5m ; 2 shed(front,3:5) shed(back,3:4) flat brick"
"$TARTAN" house row-houses "$row ; larder bath lobby landing stair stair | kitchen bedroom parlour bedroom" -o "$scratch/row.dxf"
is 'sections of a sheet that are beside the wall in the middle' "$(sed -n 's/^.-.  section/section/p' "$scratch/row.dxf" | tr -d '\r' | tr '\n' ' ')" 'section x = 1.55m section y = -1m '
# leftmost_cuts FILE: of each drawing the least x of what is cut.
leftmost_cuts() {
    python3 - "$1" <<'PYTHON'
import re, sys
for path in re.findall(r'<path fill="#ededed" d="([^"]*)"', open(sys.argv[1]).read()):
    x = start = 0
    least = []
    for letter, numbers in re.findall(r"([A-Za-z])([^A-Za-z]*)", path):
        across = [float(n) for n in re.findall(r"-?[0-9]*\.?[0-9]+", numbers)][:1]
        if letter in "MmLlHh" and across:
            x = across[0] + (0 if letter.isupper() else x)
        start = x if letter in "Mm" else start
        x = start if letter in "Zz" else x
        least.append(x)
    print(round(min(least), 2))
PYTHON
}

if grep -q '^TARTAN_WITH_DRAW:BOOL=ON' "$(dirname "$TARTAN")/CMakeCache.txt"; then
    golden view_empty "tartan house cabins.plan \"$room\" -o $scratch/h.svg --view plan:loft"
    golden view_outside "tartan house cabins.plan \"$room\" -o $scratch/h.svg --view section:x=99\'"
    golden view_too_large "tartan house cabins.plan \"$room\" -o $scratch/h.svg --scale 1"
    for view in plan:ground section:x=5\' section:y=3\' elevation:front axonometric sheet; do
        "$TARTAN" house "$files/cabins.plan" "$room" --view "$view" -o "$scratch/one.svg"
        "$TARTAN" house "$files/cabins.plan" "$room" --view "$view" -o "$scratch/two.svg"
        cmp "$scratch/one.svg" "$scratch/two.svg" || fail "two pictures of $view differ"
    done
    "$TARTAN" house apartments '#0:0' -o "$scratch/flats.svg"
    is 'a block of flats, drawn at 1:200, is on A1' \
        "$(grep -o -m1 ' width="[^"]*" height="[^"]*"' "$scratch/flats.svg")" ' width="2383.937pt" height="1683.78pt"'
    # Both drawings have the same x at the same place: what is cut of the walls begins there.
    "$TARTAN" house "$files/cabins.plan" '#10:77' --view plan:ground --view section:y=1m -o "$scratch/above.svg"
    is 'one above the other' "$(leftmost_cuts "$scratch/above.svg" | wc -l)" 2
    is 'walls stand one above the other' "$(leftmost_cuts "$scratch/above.svg" | sort -u | wc -l)" 1
    # The bricks of the row houses, #a4553f: in elevations, and not in plans.
    for view in elevation:back plan:ground; do
        "$TARTAN" house row-houses '#0:0' --library row-houses --view "$view" -o "$scratch/bricks.svg"
        is "bricks in $view" "$(grep -q '"#a4553f"' "$scratch/bricks.svg" && echo yes)" \
            "$([ "$view" = plan:ground ] || echo yes)"
    done
    "$TARTAN" house "$files/cabins.plan" '#10:77' -o "$scratch/all/"
    is 'a folder of all files' "$(cd "$scratch/all" && echo *)" 'house.csv house.dxf house.glb house.ifc house.json house.mtl house.obj house.parts.csv house.pdf house.ply house.png house.svg'
fi

# Houses drawn at random, from all plans and from one; libraries of too many plans.
golden sample "tartan sample cabins.plan 3 --library cottages --seed 3"
golden sample_plan "tartan sample cabins.plan 2 --plan '#10' --library cottages"
golden sample_diverse "tartan sample cabins.plan 3 --library cottages --diverse"
golden sample_diverse_many "tartan sample cabins.plan 600 --library cottages --diverse"
"$TARTAN" draw "$files/cabins.plan" --library cottages --sample 3 --diverse -o "$scratch/diverse.svg" && [ -s "$scratch/diverse.svg" ] || fail "houses that differ are not drawn"
golden sample_no_plan "tartan sample cabins.plan 2 --library cottages --plan '#14'"
golden too_many_states "tartan count lahave-complete --library lahave-complete --max-states 20000"
golden rooms_in_row "tartan count cabins.plan --library cottages --trays 9..10 --where 'neighbour(room(bedroom), room(kitchen))'"
golden count_clauses "tartan count cabins.plan --plan '#10' --clauses"
golden count_clauses_together 'tartan count cabins.plan --library cottages --trays 9..10 --clauses'
lengths="$("$TARTAN" count "$files/cabins.plan" --library cottages --trays 2..9 | grep ' of . trays')"
is 'each length counted by itself, and all together' "$lengths" \
    "$(for trays in 2 3 4 5 6 7 8 9; do "$TARTAN" count "$files/cabins.plan" --library cottages --trays $trays | grep ' of . trays'; done)"
golden rank_of_all "tartan rank cabins.plan \"\$(tartan unrank cabins.plan '#10:77')\" --of-all"
golden rank_of_all_plan "tartan rank cabins.plan \"14' room:14' none\" --of-all"
is 'a rank among all, and back' "$("$TARTAN" rank "$files/cabins.plan" "$("$TARTAN" unrank "$files/cabins.plan" -l cottages 4999999)" --of-all)" "#4999999"
plan="10' room:14' none | 14' room:14' none"
is 'all houses on a plan, each once' "$("$TARTAN" sample "$files/huts.plan" 100000 --library huts --plan "$plan" | sort -u | wc -l)" \
    "$("$TARTAN" count "$files/huts.plan" --library huts --plan "$plan" --json | sed 's/.*"houses":"\([0-9]*\)".*/\1/')"

# How much there may be: forms of many storeys and functions, ranks past the end, files that cannot be written.
# many STOREYS FUNCTIONS
many() {
    printf 'schema s { width = 8'"'"'\n zone body = open(8'"'"') }\nform f of s {\n'
    for ((i = 0; i < $1; i++)); do printf '  storey s%s 9'"'"'\n' "$i"; done
    printf "  wall 6\" partition 4\" floor 1' roof 10\"\n"
    for ((i = 0; i < $2; i++)); do printf '  function f%s at cell(body)\n' "$i"; done
    printf '}\nlibrary rows using s { trays 1..1 }\nlibrary tall from rows in f { }\n'
}
many 65 1 >"$scratch/tower.plan"
many 1 1001 >"$scratch/busy.plan"
many 40 1 >"$scratch/forty.plan"
many 2 200 >"$scratch/offices.plan"
golden storeys_past "tartan check $scratch/tower.plan"
golden functions_past "tartan check $scratch/busy.plan"
golden forty_storeys "tartan count $scratch/forty.plan --library tall"
golden many_functions "tartan count $scratch/offices.plan --library tall"
golden unrank_past "tartan unrank cabins.plan -l cottages 99999999999"
golden variant_past "tartan unrank cabins.plan '#10:99999999'"
golden plan_past "tartan house cabins.plan '#99999999:0'"
golden no_folder "tartan house cabins.plan '#10:77' -o $scratch/none/house.ifc"
golden folder_refuses "tartan house cabins.plan \"14' room:14' none ; 1 gable(9:12) 1 flat ; living ; window wall window\" -o /proc/x.obj" # as if it were not there
golden not_a_folder "tartan house cabins.plan '#10:77' -o $scratch/forty.plan/"

# A sheet of small pictures.
golden sheet_no_sample "tartan draw cabins.plan --library cottages -o $scratch/h.svg"
golden sheet_best "tartan draw cabins.plan --library cottages --best 4 -o $scratch/h.svg"
golden sheet_mirror "tartan draw cabins.plan --library cottages --best 4 --least floor-area --mirror -o $scratch/h.svg"
golden sheet_length "tartan draw cabins.plan --library cottages --sample 3 --length 2 -o $scratch/h.svg"
golden sheet_scale "tartan draw cabins.plan --library cottages --sample 3 --scale 100 -o $scratch/h.svg"
golden sample_length "tartan sample cabins.plan 2 --library cottages --length 2"
golden sheet_too_many "tartan draw cabins.plan --library cottages --sample 201 -o $scratch/h.svg"
if grep -q '^TARTAN_WITH_DRAW:BOOL=ON' "$(dirname "$TARTAN")/CMakeCache.txt"; then
    "$TARTAN" draw "$files/cabins.plan" --library cottages --sample 3 --seed 4 -o "$scratch/one.svg"
    "$TARTAN" draw "$files/cabins.plan" --library cottages --sample 3 --seed 4 -o "$scratch/two.svg"
    cmp "$scratch/one.svg" "$scratch/two.svg" || fail 'two sheets of the same houses differ'
    "$TARTAN" draw "$files/cabins.plan" --library cottages --sample 3 --seed 5 --columns 1 -o "$scratch/two.svg"
    ! cmp -s "$scratch/one.svg" "$scratch/two.svg" || fail 'sheets of other houses are the same'
fi

# What else a house could be.
golden vary "tartan vary cabins.plan '#10:77'"
golden vary_cell "tartan vary cabins.plan '#10:77' --at 3.body.ground --json"
golden vary_storeys "tartan vary cabins.plan \"\$(tartan unrank cabins.plan '#2:0')\" --at 2.body.ground"
golden vary_near_cell "tartan vary cabins.plan '#10:77' --at 2.bodi.ground"
golden vary_no_cell "tartan vary cabins.plan '#10:77' --at 9.body.ground"
golden vary_dropped "tartan vary cabins.plan \"$bedrooms ; bed.back bed.back\""

# The house is one closed mesh: each edge is there twice, once in each direction.
"$TARTAN" house "$files/cabins.plan" "14' room:14' none ; 1 gable(9:12) 1 flat ; kitchen ; wall window wall wall ; counter.back" -o "$scratch/h.obj" \
    -o "$scratch/h.json" -o "$scratch/h.ply" -o "$scratch/h.glb"
is 'closed, and as large as its parts' "$(
    python3 - "$scratch" <<'PY'
import json, sys
from collections import Counter
from fractions import Fraction as F

points, edges, volume = [], Counter(), F(0)
for line in open(sys.argv[1] + "/h.obj"):
    word, *rest = line.split() or [""]
    if word == "v":
        points.append([F(x) for x in rest])
    if word == "f":
        face = [int(x.split("/")[0]) - 1 for x in rest]
        edges.update(zip(face, face[1:] + face[:1]))
        for b, c in zip(face[1:], face[2:]):
            p, q, r = points[face[0]], points[b], points[c]
            volume += sum(p[i] * (q[i - 2] * r[i - 1] - q[i - 1] * r[i - 2]) for i in range(3)) / 6
house = json.load(open(sys.argv[1] + "/h.json"))
wanted = F(0)
for s in house["solids"]:
    x0, x1, y0, y1, z0, z1 = s["box"]
    wanted += (x1 - x0) * (y1 - y0) * (z1 - z0)
for r in house["roofs"]:
    a, *rest = [[F(n) for n in corner] for corner in r["corners"]]
    for b, c in zip(rest, rest[1:]):
        plan = ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2
        wanted += plan * sum(p[3] - p[2] for p in (a, b, c)) / 3
wanted += 36 * 48 * 25400000**3  # the window's pane
closed = all(edges[b, a] == 1 == n for (a, b), n in edges.items())
print(closed, abs(volume - wanted / 10**27) < F(1, 10**6))
PY
)" 'True True'
# Houses in the order of their ranks: the number of each is its place.
golden listed 'tartan enumerate cabins.plan -l cottages --limit 2'
golden listed_on_plan "tartan enumerate cabins.plan --plan '#10' --from 3 --to 5"
golden listed_past 'tartan enumerate cabins.plan -l cottages --trays 3..3 --from 300000'
golden listed_backwards 'tartan enumerate cabins.plan -l cottages --from 5 --to 3'
golden listed_json 'tartan enumerate cabins.plan -l cottages --format json --from 4999999 --limit 1'
golden listed_csv "tartan enumerate cabins.plan --plan '#10' --format csv --limit 3"
golden listed_packed "tartan enumerate cabins.plan -l cottages --limit 1 --format bin -o $scratch/houses.bin"
golden listed_tray_by_tray "tartan enumerate cabins.plan -l cottages --limit 1 --format csv --columns"
golden listed_mirrored "tartan enumerate cabins.plan -l cottages --limit 1 --mirror"
golden listed_resumed "tartan enumerate cabins.plan -l cottages --limit 1 --resume -o $scratch/houses.txt"
golden sample_json "tartan sample cabins.plan 1 --library cottages --seed 3 --format json"
golden unrank_json "tartan unrank cabins.plan '#10:77' --json"
golden count_trays 'tartan count cabins.plan -l cottages --trays 3..3'
is 'houses on a plan' "$("$TARTAN" enumerate "$files/cabins.plan" --plan '#10' | sort -u | wc -l)" \
    "$("$TARTAN" count "$files/cabins.plan" --plan '#10' --json | python3 -c 'import json, sys; print(json.load(sys.stdin)["houses"])')"
is 'a house by its rank' "$("$TARTAN" enumerate "$files/cabins.plan" -l cottages --from 4999999 --limit 1)" \
    "$("$TARTAN" unrank "$files/cabins.plan" -l cottages 4999999)"
if grep -q '^TARTAN_WITH_STORE:BOOL=ON' "$(dirname "$TARTAN")/CMakeCache.txt"; then
    golden listed_database "tartan enumerate cabins.plan --plan '#10' --to 40 -o $scratch/houses.sqlite && tartan prune cabins.plan $scratch/houses.sqlite"
    is 'the same houses in a database and as lines' "$(python3 - "$scratch/houses.sqlite" <<'PY'
import sqlite3, sys
for rank, variant, house in sqlite3.connect(sys.argv[1]).execute('select rank, variant, house from houses order by number'):
    assert rank == variant
    print(house)
PY
)" "$("$TARTAN" enumerate "$files/cabins.plan" --plan '#10' --to 40)"
fi
# What says which house it is names it: its rank, and its plan with its variant.
"$TARTAN" sample "$files/cabins.plan" 20 -l cottages --seed 9 --format json >"$scratch/sample.json"
python3 - "$scratch/sample.json" >"$scratch/names" <<'PY'
import json, sys
for house in map(json.loads, open(sys.argv[1])):
    print(house['rank'], f"#{house['plan_rank']}:{house['variant']}", house['house'], sep='\t')
PY
while IFS=$'\t' read -r rank number line; do
    is "house $rank by its rank" "$("$TARTAN" unrank "$files/cabins.plan" -l cottages "$rank")" "$line"
    is "house $rank by its plan" "$("$TARTAN" unrank "$files/cabins.plan" -l cottages "$number")" "$line"
done <"$scratch/names"
is 'houses sampled' "$(wc -l <"$scratch/names")" 20

# A page about a library of houses: all of the form is on it, the counts are those of `count`, and it is the same again.
if grep -q '^TARTAN_WITH_DRAW:BOOL=ON' "$(dirname "$TARTAN")/CMakeCache.txt"; then
    "$TARTAN" report "$files/huts.plan" -l huts --seed 2 --sample 3 -o "$scratch/page"
    "$TARTAN" report "$files/huts.plan" -l huts --seed 2 --sample 3 -o "$scratch/again.html"
    cmp "$scratch/page/index.html" "$scratch/again.html" || fail 'another page'
    "$TARTAN" count "$files/huts.plan" -l huts --clauses --json >"$scratch/counts.json"
    python3 - "$scratch/again.html" "$scratch/counts.json" <<'PY' || fail 'the page of houses'
import json, re, sys
from html.parser import HTMLParser
page, counts = open(sys.argv[1]).read(), json.load(open(sys.argv[2]))
assert f"<b>{int(counts['houses']):,}</b> houses" in page
for which in ('kept_out', 'only'):
    for clause, number in counts[which].items():
        assert f'<td class="number">{int(number):,}</td>' in page, clause
for word in ('ground', 'loft', 'living', 'porch-deck', 'a sash', 'cell(body, ground, 14'):
    assert word in page, word
assert page.count('<div class="card">') == 2 and page.count('kept free</title>') == 2  # tiles, and what they keep free
assert page.count('<section class="card house">') == 3 and page.count('<h4>Parts and prices</h4>') == 3
open_tags, void = [], {'meta', 'br', 'input', 'img', 'path', 'rect', 'use'}
class Check(HTMLParser):
    def handle_starttag(self, tag, attrs):
        if tag not in void:
            open_tags.append(tag)
    def handle_startendtag(self, tag, attrs):
        pass
    def handle_endtag(self, tag):
        if tag not in void:
            assert tag in open_tags, tag
Check().feed(page)
assert not re.search(r'(src|href)="https?:', page)
PY
    golden report_nowhere "tartan report cabins.plan -l cottage -o $scratch/page"
fi

# Questions about plans leave what a file says of houses alone, or say that it is about houses.
golden library_of_houses 'tartan prune cabins.plan -l cottages </dev/null'
golden rule_of_houses 'tartan export cabins.plan --regex --rule far-bed'
golden where_of_houses 'tartan count cabins.plan --where "cell(kitchen)"'
golden where_of_plans 'tartan count cabins.plan --where "quantity(any) = 2" | tail -n 8'
golden where_in_houses 'tartan count cabins.plan -l cottages --where "quantity(any) = 2"'
golden coverage 'tartan test cabins.plan --coverage'
golden coverage_used 'tartan test huts.plan --coverage'
golden coverage_json 'tartan test house-coverage.plan --coverage --json'
golden coverage_depends 'tartan test house-depends.plan --coverage | head -n 24'
golden coverage_states 'tartan test house-depends.plan --coverage --max-states 60 | head -n 12'

# How many houses depend on a part is what counting says of three libraries: as it is written, with the part as one that never matches, and
# with the clauses of both (what is in just one of two sets is all of both less twice what they share).
never='(option(body storeys 1) and option(body storeys 2))'
small() { "$TARTAN" count "$1" --library small --json | sed 's/.*"houses":"\([0-9]*\)".*/\1/'; }
depends() { # LINE PART N: the N-th of that text in the table
    said=$("$TARTAN" test "$files/house-depends.plan" --coverage | awk -v part="  $2  " -v n="$3" 'index($0, part) && --n == 0 { gsub(",", "", $(NF - 2)); print $(NF - 2); exit }')
    sed '/^test/,$d' "$files/house-depends.plan" >"$scratch/before.plan"
    sed "$1s/$(sed 's/[.*]/[&]/g' <<<"$2")/$never/" "$scratch/before.plan" >"$scratch/after.plan"
    sed -E 's/(open-plan|one-bed|as [a-z-]+$)/\12/g' "$scratch/after.plan" >"$scratch/again.plan"
    grep '^rule' "$scratch/again.plan" >"$scratch/rules"
    { sed '/^library/,$d' "$scratch/before.plan"; cat "$scratch/rules"; sed -n '/^library/,/^}/p' "$scratch/before.plan" | grep -v '^}'; grep '^  ' "$scratch/again.plan"; echo '}'; } >"$scratch/both.plan"
    is "houses that depend on $2" "$said" "$(($(small "$scratch/before.plan") + $(small "$scratch/after.plan") - 2 * $(small "$scratch/both.plan")))"
}
depends 4 'touch(cell(living), cell(kitchen) by open)' 1
depends 5 'quantity(cell(bedroom), n = 1)' 1
depends 5 'not cell(porch-deck)' 1
depends 8 'room(living, by window)' 1
depends 8 'one-bed' 1
depends 9 'open-plan' 1

golden relations 'tartan check house-coverage.plan --relations --examples 2>/dev/null'
golden relations_json 'tartan check cabins.plan --relations --json'
golden relations_few 'tartan check cabins.plan --relations --max-states 40 | head -n 4'

# Two clauses are what counting says of libraries with them.
printf '%s\n' "use \"$files/cabins.plan\"" 'library all from cottage-rows in cottage-form { }' >"$scratch/all.plan"
matched() { "$TARTAN" count "$scratch/all.plan" --library all --where "$1" --json | sed 's/.*"houses":"\([0-9]*\)".*/\1/'; }
is 'far-bed is inside of bedroom' "$(matched far-bed)" "$(matched 'far-bed and cell(bedroom)')"
is 'far-bed is apart from kitchen' 0 "$(matched 'far-bed and cell(kitchen)')"
is 'cramped is apart from bedroom' 0 "$(matched 'sum(area of cell(bedroom), a < 140sf) and cell(bedroom)')"
is 'dark-living is not inside of bedroom' no "$([ "$(matched dark-living)" = "$(matched 'dark-living and cell(bedroom)')" ] && echo yes || echo no)"

# What a test notices is what makes one fail where the part is written as one that never matches.
never='(option(body storeys 1) and option(body storeys 2))'
noticed() { # PART LINE
    verdict=$("$TARTAN" test "$files/cabins.plan" --coverage | awk -v part="  $1  " 'index($0, part) { print $NF; exit }')
    sed "$2s/$(sed 's/[.*]/[&]/g' <<<"$1")/$never/" "$files/cabins.plan" >"$scratch/cottage.plan"
    grep -qF "$never" "$scratch/cottage.plan" || fail "no $1 in line $2 of the cottage"
    fails=no
    "$TARTAN" test "$scratch/cottage.plan" >/dev/null 2>&1 || fails=yes
    is "a test notices $1" "$verdict" "$fails"
}
noticed 'apart(cell(bedroom, ground), from cell(living or kitchen))' 59
noticed 'room(living, not by window)' 62
noticed 'cell(kitchen)' 65
noticed 'cell(bedroom)' 65
noticed 'quantity(room(living), n = 1)' 66
noticed 'sum(area of cell(bedroom), a < 140sf)' 68
golden prolog 'tartan export cabins.plan --prolog | tail -n 2'
exits 0 "$TARTAN" report "$files/cabins.plan" -o "$scratch/report"
[ -s "$scratch/report/index.html" ] || fail 'no report of plans that houses are built on'

golden count_by "tartan count house-measures.plan --library cottages --by rooms-value"
golden count_by_plan "tartan count house-measures.plan --library cottages --by doubled --plan '#3' --json"
golden count_by_of_plans "tartan count house-measures.plan --library cottages --by bedrooms --step 5"
golden count_by_cost "tartan count priced.plan --library barns --by price --bins 6"
golden count_by_cost_json "tartan count priced.plan --library barns --by offer --plan '#1' --json"
golden count_by_cost_across "tartan count priced.plan --library across --by price"
golden count_by_cost_narrow 'sed "s/eaves 1.6./eaves 6'\''/" priced.plan > $scratch/wide.plan && tartan count $scratch/wide.plan --library barns --by price'
golden count_by_unknown "tartan count house-measures.plan --library cottages --by bedroom"
# Windows of voids count for the room below. Those over rooms that no clause asks for are not gone through.
bays="3m room:6m open:2m | 6m room:6m open:2m"
"$TARTAN" enumerate "$files/clerestory.plan" --library all --plan "$bays" >"$scratch/bays"
is 'houses under voids that are not dark, one by one' \
    "$("$TARTAN" count "$files/clerestory.plan" --library light --plan "$bays" | awk '$1 == "houses" { print $2 }')" \
    "$("$TARTAN" match "$files/clerestory.plan" "$scratch/bays" --rule dark --format any | grep -c 0)"
long=$(printf '3m none open:2m | %.0s' 1 2 3 4 5 6 7 8 9 10 11)"3m room:6m open:2m"
"$TARTAN" sample "$files/clerestory.plan" 1 --library light --plan "$long" --seed 1 >"$scratch/bays"
is 'a house of many voids and its rank' \
    "$("$TARTAN" unrank "$files/clerestory.plan" "$("$TARTAN" rank "$files/clerestory.plan" --library light "$(cat "$scratch/bays")")" --library light)" \
    "$(cat "$scratch/bays")"
golden count_long_plan "tartan count row-houses --library row-houses --plan '#1' && tartan sample row-houses 1 --library row-houses --seed 5"

# A gallery has no walls outside, but posts, in which no furniture stands; an arch has no leaf, and nothing is open behind a lower roof.
golden gallery_count "tartan count gallery.plan --library inns"
inn="3.6m none room:4.2m gallery:1.5m | 3.6m lean:1.5m room:4.2m gallery:1.5m ; gable(2:3,eaves-400mm,open) 1 shed(back,1:1) shed(front,1:4) ; parlour loft walk walk | shed parlour loft walk walk"
golden gallery_parts 'tartan house gallery.plan "$(tartan sample gallery.plan 1 --library inns --seed 4)" -o $scratch/inn.parts.csv && cat $scratch/inn.parts.csv'
golden gallery_behind "tartan house gallery.plan '$inn ; open open'"
golden gallery_behind_full "tartan explain gallery.plan '$inn ; open' --full | grep -A 2 roofs"
is 'houses with galleries, one by one' "$("$TARTAN" enumerate "$files/gallery.plan" --library inns | wc -l)" 14312
# Doors hang and open where nothing stands; names stand where nothing is below them.
leaves_and_names() {
    tartan house "$1" "$2" --view plan:ground -o "$scratch/plan.dxf" && tr -d '\r' <"$scratch/plan.dxf" | awk '
        NR % 2 { code = $1; next }
        code == 0 { if (kind == "INSERT" || layer == "A-99----T-") print kind, text, x, y, mirrored, turned; kind = $0; text = mirrored = turned = "" }
        code == 8 { layer = $0 } code == 1 || code == 2 { text = $0 } code == 10 { x = $0 } code == 20 { y = $0 }
        code == 41 { mirrored = $0 } code == 50 { turned = $0 }'
}
for number in 0 1 2; do
    golden "swing_$number" "leaves_and_names swing.plan \"\$(tartan unrank swing.plan '#0:$number')\""
done
finish
