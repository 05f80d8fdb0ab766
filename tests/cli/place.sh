#!/usr/bin/env bash
# tartan place: models from connection grammars, and what is said where a run cannot go on.
# Slow under sanitizers.
name=place
source "$(dirname "$0")/golden.bash"

wall=../../../examples/brick-wall/wall.pcfg bricks=../../../examples/brick-wall/bricks.pcfg
golden summary "tartan place $wall $bricks --seed 3"
golden stats "tartan place $wall $bricks --seed 3 --stats"
golden stats_json "tartan place $wall $bricks --seed 3 --stats json"
golden list "tartan place $wall $bricks --seed 3 -o $scratch/wall.csv && cat $scratch/wall.csv"
golden header "tartan place $wall $bricks --header -o - | head -n 4 | sed 's/tartan .*/tartan/'"
golden trace "tartan place $wall $bricks --trace | head -n 60"
golden disasm "tartan build $wall $bricks -o $scratch/wall.tnb && tartan disasm $scratch/wall.tnb | tail -n +3"
golden no_rule_alone "tartan check $wall"
golden wrong_order "tartan check $bricks $wall"
golden format "printf \" Wall   ->'Place(1)'[.5]\\n\\n\\n  # why\\nWall ->  'Place(2)'|[.5]\\n\" | tartan fmt --notation pcfg -"
golden format_lost "printf \"Wall -> 'Place(1)' [.5] \\nWall -> 'Place(2)' | [.5]\\n\" | tartan fmt --notation pcfg -"

# Both ways of looking ahead, a module and its sources: the same bytes.
cd "$scratch"
source=$OLDPWD
wall=("$source/examples/brick-wall/wall.pcfg" "$source/examples/brick-wall/bricks.pcfg")
for seed in 0 1 4294967295; do
    "$TARTAN" place "${wall[@]}" --seed $seed -o auto.ldr -o auto.csv --program auto.txt
    "$TARTAN" place "${wall[@]}" --seed $seed -o vm.ldr --engine vm --program vm.txt
    "$TARTAN" place wall.tnb --seed $seed -o module.ldr --program module.txt
    for one in vm module; do
        cmp auto.ldr $one.ldr || fail "seed $seed: $one is another model"
        cmp auto.txt $one.txt || fail "seed $seed: $one is another program"
    done
done
is 'parts of the list' "$(awk -F, 'NR > 1 {n += $3} END {print n}' auto.csv)" "$(grep -c '^1 ' auto.ldr)"
# The program, as a grammar of one rule, makes the model again.
sed "s/[^ ]*/'&'/g; s/^/All -> /" auto.txt >again.pcfg
"$TARTAN" place again.pcfg -o again.ldr
cmp auto.ldr again.ldr || fail 'a program placed again is another model'
# No two bricks of the wall take the same room, and none lies outside or in a window.
awk '$1 == 1 {wide = $NF == "3010.dat" ? 8 : $NF == "3004.dat" ? 4 : 2
    for (x = $3 / 10 - wide / 2; x < $3 / 10 + wide / 2; x++) {
        if (filled[x, $4 / 8]++ || x < -20 || x >= 20) exit 1
        if (x >= -14 && x < -6 && ($4 / 8 == -3 || $4 / 8 == 0)) exit 1
    }}' auto.ldr || fail 'bricks overlap, or lie where they must not'

# ---- what cannot go on
write() { cat >"$scratch/$1.pcfg"; }
write blocked <<'X'
Start -> 'PlaceBoundingBox(4,4,4)' 'FillRect(4,3,4)' 'Place(3003)' 'Move(1,1,0)' A
A -> 'FillRect(2,3,2)' 'Place(3005)' [1]
X
write bound <<'X'
Start -> 'PlaceBoundingBox(4,4,4)' 'Place(3003)' 'Move(4,0,0)' 'FillRect(2,3,2)'
X
write touch <<'X'
Start -> 'PlaceBoundingBox(4,4,4)' 'Place(3003)' 'AssertFilled()'
X
write frame <<'X'
Start -> 'PlaceBoundingBox(4,4,4)' 'Place(3003)' '(' ')' ')' 'Move(1,0,0)'
X
write nothing <<'X'
Start -> 'PlaceBoundingBox(4,4,4)' 'Move(1,0,0)'
X
write forced <<'X'
Start -> 'PlaceBoundingBox(4,4,4)' 'Place(3003)' A
A -> 'Move(4,0,0)' 'FillRect(2,3,2)' | 'FillRectNoCheck(2,3,2)' 'AssertFilled()'
X
write lookahead <<'X'
Start -> 'PlaceBoundingBox(4,4,4)' 'Place(3003)' A
A -> 'Move(0,0,1)' B | 'Move(0,0,0)' B
B -> 'Rotate(90)' A
X
write idle <<'X'
Start -> 'PlaceBoundingBox(4,4,4)' 'Place(3003)' A
A -> B |
B -> A |
X
write endless <<'X'
Start -> 'PlaceBoundingBox(4,4,4)' A
A -> 'Place(3003)' A |
X
write far <<'X'
Start -> 'PlaceBoundingBox(4,4,4)' 'Place(3003)' 'Move(67108864,0,0)' 'Move(1,0,0)'
X
write large <<'X'
Start -> 'PlaceBoundingBox(4,4,4)' 'Place(3003)' 'FillRectNoCheck(1000000,1000000,1000000)'
X
for name_ in blocked bound touch frame nothing forced lookahead idle far; do
    golden "$name_" "tartan place $scratch/$name_.pcfg -o $scratch/none.ldr"
done
golden parts "tartan place $scratch/endless.pcfg --part-limit 100"
golden steps "tartan place $scratch/endless.pcfg --step-limit 100"
golden memory "tartan place $scratch/large.pcfg --memory-limit 300"
[ ! -e "$scratch/none.ldr" ] || rm "$scratch/none.ldr" # of `forced`, which is written
golden keep_partial "tartan place $scratch/blocked.pcfg --keep-partial -o $scratch/partial.ldr; cat $scratch/partial.ldr"
golden other_file "tartan place ../../../stdlib/square.hemls"
golden not_joined "tartan place $scratch/touch.pcfg ../../../stdlib/square.hemls"
golden map_places "tartan map $scratch/touch.pcfg --genome 1"
golden missing "tartan place $scratch/tuch.pcfg"
golden output_ending "tartan place $scratch/touch.pcfg -o $scratch/x.txt"
golden output_twice "tartan place $scratch/touch.pcfg -o - --stats"
# By a value: the first alternative of at least 1, else the largest, the last of equals.
printf "%s\n" "S -> 'PlaceBoundingBox(9,9,9)' 'Move(0,-3,0)' 'Place(3001)' S | 'Move(0,-3,0)' 'Place(3003)' S |" >"$scratch/value.pcfg"
golden fitness "tartan place $scratch/value.pcfg --fitness 'elements <= 3'"
golden fitness_counts "tartan place $scratch/value.pcfg --fitness 'count(3001) <= 2 and elements <= 5'"
golden fitness_equals "tartan place $scratch/value.pcfg --fitness '0'"
golden fitness_below "tartan place $scratch/value.pcfg --fitness '0 - elements - 1'"
golden fitness_term "tartan place $scratch/value.pcfg --fitness 'fill'"
golden fitness_wrong "tartan place $scratch/value.pcfg --fitness 'elements < '"
golden fitness_several "tartan place $scratch/value.pcfg --fitness 'elements < 3, elements > 1'"
golden fitness_of_kit "tartan place ../../../examples/gatehouse/gatehouse.kit --fitness elements"
golden fitness_traced "tartan place $scratch/value.pcfg --fitness elements --trace"
golden header_alone "tartan place $scratch/touch.pcfg --header"

# ---- reading: ends of lines, a byte order mark, blank lines, names and quotes; and the rules that no published run shows
room="'PlaceBoundingBox(9,9,9)'"
reads() { # WHAT PCFG NAMES... : the grammar, a format of printf, places the parts of these names without a word
    local what=$1 found
    printf "$2" >"$scratch/read.pcfg"
    found=$("$TARTAN" place "$scratch/read.pcfg" -o - 2>&1 | sed -n 's/^1 .* 0 0 0 1 \(.*\)\.dat$/\1/p; /warning\|error/p' | paste -sd' ')
    is "$what" "$found" "$3"
}
for end in '\n' '\r\n' '\r'; do reads 'ends of lines' "S -> $room A$end$end  # none${end}A -> 'Place(1)'$end" 1; done
reads 'no end of the last line' "S -> $room 'Place(1)'" 1
reads 'a byte order mark' "\xef\xbb\xbfS -> $room 'Place(1)'\n" 1
reads 'blanks before rules, and lines of blanks' "  S -> $room A\n \t \n\tA -> 'Place(1)'\n" 1
reads 'no blank behind the arrow' "S ->$room A\nA ->'Place(1)'\n" 1
reads 'names' "S -> $room Ä^<-> /b_9 \nÄ^<-> -> 'Place(1)'\n/b_9 -> 'Place(2)'\n" '1 2'
reads 'quotes' "S -> $room 'Place(a\"#|]b)'\"Place(c'd)\"\n" "a\"#|]b c'd"
reads 'numbers with blanks and signs' "S -> $room 'Move( -1 ,+1,01)' 'Place(1)'\n" 1
# A symbol that another leads with, or that stands behind one that is now empty, is expanded.
reads 'symbols side by side' "S -> $room A B 'Place(9)'\nA -> B 'Place(1)'\nB -> C\nC ->\n" '1 9'
# A probability of 0 is never drawn.
reads 'an alternative of probability 0' "S -> $room A\nA -> 'Place(1)' [1]\nA -> [0]\n" 1
reads 'sums within 2^-26 of 1' "S -> $room A\nA -> 'Place(1)' [.5]\nA -> 'Place(1)' [.500000014]\n" 1
# A bound of an alternative that is not taken stays; a step before the first bound makes a ball of radius 8.
printf "S -> 'PlaceBoundingBox(4,4,4)' 'Place(9)' A 'Move(3,0,0)' 'FillRect(2,3,2)'\nA -> 'PlaceBoundingBox(2,2,2)' 'FillRect(50,1,2)' |\n" >"$scratch/stays.pcfg"
golden stays "tartan place $scratch/stays.pcfg"
printf "S -> 'Move(0,0,0)' 'PlaceBoundingBox(40,40,40)' 'Place(9)' 'Move(8,0,0)' 'FillRect(2,3,2)'\n" >"$scratch/ball.pcfg"
golden ball "tartan place $scratch/ball.pcfg"
# Files are one grammar; each message has its own file and line, of whatever command.
printf "S -> $room A\n" >"$scratch/first.pcfg"
printf "# its rules\nA -> 'Place(1)' Miss 'Mve(1)'\n" >"$scratch/second.pcfg"
for command in check place build; do golden "files_$command" "tartan $command $scratch/first.pcfg $scratch/second.pcfg"; done
golden files_fmt "tartan fmt - <$scratch/first.pcfg --notation pcfg"
printf "S -> $room A\nA -> '(' 'Place(1)' A |\n" >"$scratch/nested.pcfg"
golden frames "tartan place $scratch/nested.pcfg --frame-limit 100"
golden seed "tartan place $scratch/first.pcfg --seed 4294967296; tartan place $scratch/first.pcfg --seed -1"

# ---- the published program
if [ -n "${TARTAN_ORACLES:-}" ] && [ -e "$TARTAN_ORACLES/place/model.py" ]; then
    oracle=$TARTAN_ORACLES/place
    published() {
        local model=$1 seed=$2 figures=$3 said
        shift 3
        said=$(cd "$oracle/grammars" && "$TARTAN" place "$@" --seed "$seed" -o "$scratch/$model.ldr" --program "$scratch/$model.txt" \
            --stats json 2>"$scratch/$model.err") || fail "$model does not end"
        cmp "$scratch/$model.ldr" "$oracle/expected/$model.ldr" || fail "$model is not the published program's"
        [ ! -e "$oracle/expected/$model.program.txt" ] || cmp "$scratch/$model.txt" "$oracle/expected/$model.program.txt" ||
            fail "$model has another program"
        (cd "$oracle/grammars" && "$TARTAN" place "$@" --seed "$seed" -o "$scratch/$model.again.ldr" >/dev/null 2>&1) || fail "$model does not end without --program"
        cmp "$scratch/$model.again.ldr" "$oracle/expected/$model.ldr" || fail "$model is not the published program's without --program"
        is "figures of $model" "$(sed -E 's/.*"elements":([0-9]+),"terminals":([0-9]+),.*"tries":([0-9]+),.*/\1 \2 \3/' <<<"$said")" "$figures"
        is "alternatives of $model that miss their place" "$(grep -c 'W187' "$scratch/$model.err")" 2
    }
    published box 0 '83 3455 1942' box_constraints.pcfg brick.pcfg brick_defs.pcfg close.pcfg
    published sphere8 0 '24 782 1026' sphere8.pcfg brick.pcfg brick_defs.pcfg close.pcfg
    published castle_plain 0 '310 5888 6193' castle/wall_constraints.pcfg brick.pcfg brick_defs.pcfg tile.pcfg close.pcfg
    published castle_s0 0 '321 6310 6182' castle/wall_constraints.pcfg brick.pcfg castle/brick_defs.pcfg tile.pcfg close.pcfg
    for model in stack_readme rotation_translation; do
        "$TARTAN" place "$oracle/grammars/$model.pcfg" --fitness 'elements <= 3' -o "$scratch/$model.ldr" 2>"$scratch/$model.err" || fail "$model does not end"
        cmp "$scratch/$model.ldr" "$oracle/expected/$model.ldr" || fail "$model is not the published program's"
    done
    python3 -B "$source/tests/place_oracle.py" "$oracle/model.py" "$TARTAN" 0 60 || fail 'random grammars differ'
fi
exit "$failures"
