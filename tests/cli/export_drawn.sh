#!/usr/bin/env bash
# Models that were drawn, written as connection grammars and as kits: these place them again, and what cannot be said is told.
name=export_drawn
source "$(dirname "$0")/golden.bash"
cd "$scratch"
drawn() { printf '%s\n' "${@:2}" >"$1.ldr"; }
drawn two '0 two bricks' '' '1 4 0 0 0 1 0 0 0 1 0 0 0 1 3005.dat' '0 STEP' '1 14 10 24 0 1 0 0 0 1 0 0 0 1 3004.DAT' '1 71 -100 8 -10 0 0 1 0 1 0 -1 0 0 3024.dat'
drawn odd '1 0x2FF0000 0 0 0 -1.0 0 0 0 1 0 0 0 -1 my part.dat' '1 4 5 3 0 1 0 0 0 1 0 0 0 1 Brick.dat' "1 4 0 0 0 1 0 0 0 1 0 0 0 1 (odd).dat" '1 4 0 48 0 1 0 0 0 1 0 0 0 1 3001.dat' '1 4 3 96 0 1 0 0 0 1 0 0 0 1 3001.dat' '1 4 0 96 0 1 0 0 0 0 1 0 1 0 3001.dat'
drawn over '1 4 0 0 0 1 0 0 0 1 0 0 0 1 3001.dat' '1 4 0 0 0 0 0 -1 0 1 0 1 0 0 3001.dat'
drawn turned '1 4 0 0 0 0 0 -1 0 1 0 1 0 0 3001.dat' '1 4 0 -24 0 0 0 -1 0 1 0 1 0 0 3001.dat'
drawn short '1 4 0 0 0' '1 4 0 0 0 1 0 0 0 1 0 0 0 1 3001.dat'
drawn far '1 4 9e9 0 0 1 0 0 0 1 0 0 0 1 3001.dat'
drawn colour '1 red 0 0 0 1 0 0 0 1 0 0 0 1 3001.dat'
drawn none '0 nothing'
drawn smooth '1 4 0 0 0 1 0 0 0 1 0 0 0 1 block.dat'
printf 'unit 10 x 8 x 10;\npart block { fill 20 x 8 x 20; }\n' >smooth.kit
printf '0 FILE a.ldr\n1 4 0 0 0 1 0 0 0 1 0 0 0 1 b.ldr\n1 4 40 0 0 0 0 -1 0 1 0 1 0 0 b.ldr\n0 FILE b.ldr\n1 16 0 0 0 1 0 0 0 1 0 0 0 1 3004.dat\n' >sub.mpd
golden pcfg "cd $scratch && tartan export two.ldr --pcfg"
golden init "cd $scratch && tartan export two.ldr --pcfg --init \"'PlaceBoundingBox(8,9,8)' Wall\""
golden kit "cd $scratch && tartan export two.ldr --kit bricks"
golden odd_pcfg "cd $scratch && tartan export odd.ldr --pcfg"
golden odd_kit "cd $scratch && tartan export odd.ldr --kit bricks"
for wrong in over turned smooth; do golden "$wrong" "cd $scratch && tartan export $wrong.ldr --kit $([ $wrong = smooth ] && echo smooth.kit || echo bricks)"; done
for wrong in short far colour none; do golden "$wrong" "cd $scratch && tartan export $wrong.ldr --pcfg"; done
golden sub "cd $scratch && tartan export sub.mpd --pcfg; tartan export sub.mpd --kit bricks"
golden usage "cd $scratch && tartan export two.ldr; tartan export two.ldr --pcfg --kit bricks; tartan export two.ldr --kit lahave; tartan export bricks --kit bricks; tartan export two.ldr --kit bricks --init x; tartan export two.ldr --pcfg --init 'a
b'; tartan export missing.ldr --pcfg; tartan export two.ldr --kit smooth.kit"

# Exported, placed: the same parts. With its rules for the two bricks, the published program's line is a grammar too.
same() { cmp <(grep '^1 ' "$1" | sort) <(grep '^1 ' "$2" | sort) || fail "$3 places other parts"; }
cp "$here"/../../examples/{gatehouse/gatehouse.kit,drawn-gate/gate.ldr} .
"$TARTAN" place gatehouse.kit -o gatehouse.ldr
for model in gatehouse gate; do
    "$TARTAN" export $model.ldr --pcfg -o $model.pcfg
    is "$model is well written" "$("$TARTAN" check $model.pcfg 2>&1)" ''
    "$TARTAN" place $model.pcfg -o again.ldr && same $model.ldr again.ldr "the grammar of $model"
    "$TARTAN" export $model.ldr --kit bricks -o $model.drawn.kit
    is "the kit of $model is well written" "$("$TARTAN" check $model.drawn.kit 2>&1)" ''
    "$TARTAN" place $model.drawn.kit -o again.ldr && same $model.ldr again.ldr "the kit of $model"
done
{
    "$TARTAN" export gatehouse.ldr --pcfg --init "'PlaceBoundingBox(99,99,99)'"
    printf "B1x1NoCheck -> 'Place(3005)'\nB1x2NoCheck -> 'Place(3004)'\n"
} >joined.pcfg
"$TARTAN" place joined.pcfg -o again.ldr && same gatehouse.ldr again.ldr 'the line of the program'
# Towers at random, turned and coloured, in no order.
python3 - <<'P'
import random
turns = "1 0 0 0 1 0 0 0 1", "0 0 -1 0 1 0 1 0 0", "-1 0 0 0 1 0 0 0 -1", "0 0 1 0 1 0 -1 0 0"
for number in range(12):
    draw = random.Random(number)
    lines = ["1 %d %d %d %d %s %s.dat" % (draw.choice([1, 4, 14, 71]), 100 * (i % 7), -24 * (i // 7), 10 * draw.randrange(3), draw.choice(turns), draw.choice(["3001", "3003", "3005", "3004", "3010"]))
             for i in draw.sample(range(60), 1 + draw.randrange(50))]
    if not any("1 0 0 0 1 0 0 0 1" in line for line in lines):
        lines.append("1 4 -200 0 0 1 0 0 0 1 0 0 0 1 3005.dat")
    open("random%d.ldr" % number, "w").write("0 random\n" + "\n".join(lines) + "\n")
P
for number in 0 1 2 3 4 5 6 7 8 9 10 11; do
    for way in '--pcfg -o again.pcfg' '--kit bricks -o again.kit'; do
        "$TARTAN" export random$number.ldr $way && "$TARTAN" place "again.${way##*.}" -o again.ldr && same random$number.ldr again.ldr "random model $number, $way,"
    done
done
exit $((failures > 0))
