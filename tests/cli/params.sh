#!/usr/bin/env bash
# Params: values that --set and the heads of tests give, on every command that compiles a .plan file.
name=params
. "$(dirname "$0")/golden.bash"

cat >"$scratch/lots.plan" <<'END'
schema row {
  width role length = 2m | 3m | 4m
  use   = hall | room | stair
}

param lot "how wide the lot is" =
  12m in 9m..20m

param most = 3
param side = left | right
param kind = hall | room
let half = lot / 2

rule wide = sum(width) > lot
rule ends = side = right implies neighbour(beginning, tray(hall))
rule crowd = quantity(tray(kind)) > most
rule last = side != left and neighbour(tray(stair), end)

library rows {
  trays 1..3
}

library fitting from rows {
  prune wide, crowd, last
  require ends
}

measure slack = lot - sum(width)
measure spare = half - sum(width)

test fitting {
  keep [3m | 4m]
}

test fitting with side = right, lot = 9m {
  drop [3m room | 4m] by ends
  keep [3m hall | 4m]
  drop [4m | 4m | 3m] by wide
}

test slack with lot = 20m {
  value [4m] = 16m
}

test wide, crowd with lot = 9m, most = 2 {
  match  match [4m | 4m | 4m]
  reject reject [2m | 2m]
}
END
lots=$scratch/lots.plan

# What a value changes: what --set says, what the file says if it is written there.
golden default "tartan count $lots -l fitting"
golden number "tartan count $lots -l fitting --set lot=9m"
golden word "tartan count $lots -l fitting --set side=right --no-effects"
golden both "tartan count $lots -l fitting --set side=right --set 'lot = 10m - 1m' --no-effects"
golden measured "tartan count $lots -l fitting --by slack --set lot=10m"
golden tested "tartan test $lots"
golden check "tartan check $lots"
golden check_set "tartan check $lots --set side=right --set lot=9m"
golden layout "tartan fmt --check $lots"
for given in lot=9m lot=20m most=0 most=1 side=right kind=room kind=hall; do
    key=${given%%=*} value=${given#*=}
    if [[ $value =~ ^[a-z]+$ ]]; then
        sed "/^test/,\$d; s/^param $key = .*/param $key = $value | other-word/; s/| other-word\$/| $(sed -n "s/^param $key = //p" "$lots" | tr '|' '\n' | tr -d ' ' | grep -vx "$value")/" \
            "$lots" >"$scratch/written.plan"
    else
        sed "/^test/,\$d; /^param $key .*=\$/{N; s/\n//}" "$lots" | sed "s/^param $key .*/let $key = $value/" >"$scratch/written.plan"
    fi
    for threads in 1 4; do
        "$TARTAN" enumerate "$lots" -l fitting --set "$given" --threads $threads >"$scratch/set" 2>&1
        "$TARTAN" enumerate "$scratch/written.plan" -l fitting >"$scratch/written" 2>&1
        cmp -s "$scratch/set" "$scratch/written" || fail "--set $given lists other plans than the file in which it is written"
    done
    for command in "count -l fitting --json" "count -l fitting --by slack --json" "count -l fitting --by spare" \
        "best 3 -l fitting --most slack" "pareto -l fitting --least slack --most spare" "sample 3 -l fitting" "unrank 5 -l fitting" \
        "complete -l fitting ..." "explain -l fitting" "rank -l fitting"; do
        read -r first rest <<<"$command"
        operand=()
        case $first in
        best | sample | unrank) operand=("${rest%% *}") rest=${rest#* } ;;
        complete) operand=(...) rest=${rest% ...} ;;
        explain | rank) operand=("3m hall | 4m hall") ;;
        esac
        # shellcheck disable=SC2086
        one=$("$TARTAN" $first "$lots" ${operand[0]+"${operand[@]}"} $rest --set "$given" 2>&1 | sed 's/[^ ]*\.plan//' || true)
        # shellcheck disable=SC2086
        other=$("$TARTAN" $first "$scratch/written.plan" ${operand[0]+"${operand[@]}"} $rest 2>&1 | sed 's/[^ ]*\.plan//' || true)
        is "$command --set $given" "$one" "$other"
    done
done

# What is wrong with a value is said with the option.
golden no_value "tartan count $lots -l fitting --set lot"
golden no_param "tartan count $lots -l fitting --set lit=9m"
golden a_let "tartan count $lots -l fitting --set half=9m"
golden other_kind "tartan count $lots -l fitting --set lot=9"
golden out_of_range "tartan count $lots -l fitting --set lot=21m"
golden no_constant "tartan count $lots -l fitting --set lot=wide"
golden no_word "tartan count $lots -l fitting --set side=rigth"
golden twice "tartan count $lots -l fitting --set lot=9m --set lot=10m"
golden other_notation "tartan mesh ../../../examples/implicit-surfaces/shell.field --set lot=9m"
golden not_taken "tartan build ../../../examples/implicit-surfaces/shell.field --set lot=9m"
sed 's/lot = 20m {/most = 0 {/; s/> most/> 6 \/ most/' "$lots" >"$scratch/zero.plan"
golden no_sense_in_test "tartan test $scratch/zero.plan"
golden no_sense_checked "tartan check $scratch/zero.plan"
sed 's/drop \[3m room/keep [3m room/; s/ by ends//; s/= 16m/= 15m/' "$lots" >"$scratch/failing.plan"
golden failing "tartan test $scratch/failing.plan"

# A module keeps its values; --set is refused.
golden build "tartan build $lots --set side=right --set lot=9m -o $scratch/lots.tnb"
golden module "tartan count $scratch/lots.tnb -l fitting --no-effects"
golden module_set "tartan count $scratch/lots.tnb -l fitting --set lot=10m"
golden module_rules "tartan disasm $scratch/lots.tnb | sed -n 2,5p"
"$TARTAN" build "$lots" --set lot=9m --set side=right -o "$scratch/turned.tnb"
cmp -s "$scratch/lots.tnb" "$scratch/turned.tnb" || fail 'the order of --set makes another module'

# What is written says the values.
"$TARTAN" enumerate "$lots" -l fitting --set side=right --set lot=9m -o "$scratch/plans.bin"
grep -aq '^params=lot=9m, side=right$' "$scratch/plans.bin" || fail 'packed plans do not say the values'
"$TARTAN" enumerate "$scratch/lots.tnb" -l fitting -o "$scratch/module.bin"
grep -aq '^params=lot=9m, side=right$' "$scratch/module.bin" || fail 'packed plans of a module do not say the values'
"$TARTAN" enumerate "$lots" -l fitting -o "$scratch/default.bin"
if grep -aq '^params=' "$scratch/default.bin"; then fail 'packed plans say values that nobody gave'; fi
if "$TARTAN" enumerate "$lots" -l rows --set lot=9m -o "$scratch/plans.sqlite" 2>/dev/null; then
    golden resumed "tartan enumerate $lots -l rows --set lot=10m -o $scratch/plans.sqlite --resume"
fi
"$TARTAN" report "$lots" -l fitting --set lot=9m -o "$scratch/page.html" 2>/dev/null || true
grep -q 'With <code>lot=9m</code>' "$scratch/page.html" || fail 'a report does not say the values'

# Shards have those with which the set was made.
"$TARTAN" shards new "$lots" -l fitting --set lot=9m --shards 2 -o "$scratch/set-of-lots" 2>/dev/null
golden shards_set "tartan shards run $scratch/set-of-lots --set lot=10m"
"$TARTAN" shards run "$scratch/set-of-lots" 2>/dev/null
is 'plans of shards' "$("$TARTAN" shards cat "$scratch/set-of-lots")" "$("$TARTAN" enumerate "$lots" -l fitting --set lot=9m)"

# Tests that --write-tests writes say the values with which they come out.
sed '/^test/,$d' "$lots" >"$scratch/untested.plan"
"$TARTAN" test "$scratch/untested.plan" -l fitting --set lot=9m --set side=right --write-tests >"$scratch/written" 2>/dev/null || true
grep -q '^test wide with lot = 9m, side = right {$' "$scratch/written" || fail 'tests that are written do not say the values'
cat "$scratch/written" >>"$scratch/untested.plan"
exits 0 "$TARTAN" test "$scratch/untested.plan"
golden coverage "tartan test $lots -l fitting --coverage | grep -A1 'lot\\|side'"

# They are listed, and programs say which they have.
golden listed "tartan schema $lots --set lot=9m | grep ^param"
golden listed_json "tartan schema $lots --json | sed -n '/\"params\"/,\$p'"
cat >"$scratch/halls.plan" <<'END'
schema row {
  use = hall | room
}
param side = left | right
rule ends = side = right and neighbour(beginning, tray(hall))
library halls {
  trays 1..3
  prune ends
}
END
golden prolog "tartan export $scratch/halls.plan --prolog --set side=right | grep -v '^\$' | sed -n '1,2p; /^ends/p'"

# Params of files that are used.
cat >"$scratch/main.plan" <<'END'
use "lots.plan"
library mine from fitting {
  require sum(width) >= half
}
test mine with lot = 10m {
  keep [3m | 2m]
  drop [2m | 2m]
}
END
golden used "tartan count $scratch/main.plan -l mine --set lot=10m --no-effects"
golden used_tested "tartan test $scratch/main.plan"
golden used_open "tartan explain $scratch/main.plan -l mine '[3m | 3m]' --set lot=9m"

# What no tray is with the default may be so with another value, and is no mistake.
cat >"$scratch/widest.plan" <<'END'
param widest = 5m
schema row {
  width = 2m | 3m | 5m
  kind = a | c
}
rule too-wide = tray(c, width > widest) or tray(width > 2 * widest)
library fitting {
  trays 1..2
  prune too-wide
}
END
golden no_tray "tartan check $scratch/widest.plan && tartan count $scratch/widest.plan --no-effects"
golden some_trays "tartan count $scratch/widest.plan --no-effects --set widest=2m"

# Files of earlier versions have these words as names.
cat >"$scratch/old.plan" <<'END'
schema with {
  param = 2m | 3m
  side = in | with
}
rule param = tray(with)
rule with(param-two) = neighbour(param-two, param-two)
rule both = param and with(param)
library set {
  trays 1..3
  prune
    param
  total = 4m
  require not both
}
test param { match [2m with] }
test both, param {
  reject match [2m with]
}
END
golden old "tartan test $scratch/old.plan"
finish
