#!/usr/bin/env bash
# schema: what a rule file has, as text and as JSON; of a module all but what is forbidden.
name=schema
. "$(dirname "$0")/golden.bash"

golden text 'tartan schema sheds.plan'
golden houses 'tartan schema cottage'
golden used 'tartan schema cottage --used'
golden json 'tartan schema sheds.plan --json'
golden weights 'tartan schema market.plan'
golden weights_json 'tartan schema market.plan --json | sed -n "/lively/,/^    }/p"'
{ # millions of combinations, thousands of legal trays
    echo 'schema steps {'
    for field in a b c d e f g h; do
        echo "  $field = ${field}0 < ${field}1 < ${field}2 < ${field}3 < ${field}4 < ${field}5 < ${field}6 < ${field}7"
    done
    for pair in 'a b' 'b c' 'c d' 'd e' 'e f' 'f g' 'g h'; do
        echo "  only tray(${pair% *} - ${pair#* } <= 1, ${pair#* } - ${pair% *} <= 1)"
    done
    printf '}\nrule r = neighbour(tray(a < h), tray(h = 3, a + b > 2 * h))\nrule q = max(a * b + c + d + e + f + g of tray(h < 3)) >= 30\n'
    echo 'library rows { trays 1..2  require q  prune r }'
} >"$scratch/steps.plan"
golden many_combinations "tartan count $scratch/steps.plan && tartan schema $scratch/steps.plan | head -n 1 && tartan sample $scratch/steps.plan 2 --seed 1"
golden no_schema 'tartan schema koch'
golden two_files 'tartan schema sheds.plan rows.plan'
"$TARTAN" build "$files/sheds.plan" -o "$scratch/sheds.tnb"
"$TARTAN" schema "$files/sheds.plan" | grep -v '^  forbid' >"$scratch/wanted"
"$TARTAN" schema "$scratch/sheds.tnb" | diff "$scratch/wanted" - || fail 'a module says something else'
finish
