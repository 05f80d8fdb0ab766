#!/usr/bin/env bash
# tartan_place of the C interface places what `tartan place` does: every kit and connection grammar of the examples and the standard library,
# with each of its models, and some of the test's own. Where the command refuses, the interface does, by the same number.
set -euo pipefail
shopt -s nullglob
program=$(dirname "$TARTAN")/tests/place_interface
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
    echo "place_interface: $1" >&2
    exit 1
}
placed=0 refused=0

# agree SEED MODEL FILE...: connection grammars may be several files, which are one text.
agree() {
    local seed=$1 model=$2 file=$3 how=placed said=0
    shift 2
    if [ $# -gt 1 ]; then
        file=$work/joined.pcfg
        cat "$@" >"$file"
    fi
    rm -f "$work/model.ldr" "$work/list.csv"
    "$TARTAN" place "$@" --seed "$seed" ${model:+--model "$model"} -o "$work/model.ldr" -o "$work/list.csv" >"$work/out" 2>"$work/errors" || said=$?
    if [ $said -eq 0 ]; then
        cat "$work/model.ldr" "$work/list.csv" >"$work/command"
        placed=$((placed + 1))
    else
        how=refused
        [ $said -ne 70 ] || fail "the command fails for $* $model: $(cat "$work/errors")"
        grep -oE 'error\[E[0-9]+\]' "$work/errors" | head -n 1 | grep -oE 'E[0-9]+' >"$work/command"
        refused=$((refused + 1))
    fi
    said=0
    "$program" stdlib "$seed" "$model" "$file" >"$work/interface" || said=$?
    [ $said -le 1 ] || fail "the program ends with $said for $file"
    cmp "$work/command" "$work/interface" || fail "the command has $how $*${model:+, model $model}, seed $seed; the interface gives otherwise: \
$(head -n 3 "$work/interface")"
}

models_of() {
    sed -nE 's/^[[:space:]]*model[[:space:]]+([A-Za-z][A-Za-z0-9_-]*).*/\1/p' "$1"
}

files=(examples/*/*.kit examples/*/*.pcfg stdlib/*.kit stdlib/*.pcfg)
[ ${#files[@]} -gt 10 ] || fail 'there are hardly any files'
for file in "${files[@]}"; do
    agree 0 '' "$file"
    for model in $(case $file in *.kit) models_of "$file" ;; esac); do
        agree 1 "$model" "$file"
    done
done
for folder in examples/*/; do
    set -- "$folder"*.pcfg
    [ $# -lt 2 ] || agree 3 '' "$(ls "$folder"*.pcfg | tail -n 1)" "$(ls "$folder"*.pcfg | head -n 1)"
done

# What the files above may not have: two models, searches of every kind, steps by parts, requirements that hold and do not.
cat >"$work/own.kit" <<'END'
unit 10 x 8 x 10;
connector stud joins tube every 20;
connector tube joins stud every 20;
part two "two" { fill 40 x 24 x 20; studs up 2 x 1; tubes down 2 x 1 at (0, -24, 0); mass 2; }
space room = box(100, 72, 60) and not sphere(20);
rule wall at stud, tube = (two in 4 [0.5] | two [0.5]);
model hut { inside room; start stud at (30, 0, 10) by wall; steps 2; require count(two) > 0; }
model never { inside room; start stud at (30, 0, 10) by wall; require count(two) = 0; }
model beam { inside box(60, 48, 20); start stud at (20, 0, 0) by wall; minimize elements + cuts; search beam 2; stock two <= 4; steps part; }
model turned { inside box(80, 48, 20); start stud at (10, 0, 0) by wall; minimize cuts; search anneal 1; symmetry turn 2; }
model all { inside box(60, 48, 20); start stud at (20, 0, 0) by wall; maximize joints; search exact; }
END
"$TARTAN" check "$work/own.kit" || fail 'the kit is wrong'
for model in '' $(models_of "$work/own.kit") other; do
    agree 5 "$model" "$work/own.kit"
done
# A search that passes its limit leaves the best model until then, and the number of the limit, or that number alone.
cut=0
limited() { # MODEL LIMIT
    local said=0
    rm -f "$work/model.ldr" "$work/list.csv"
    "$TARTAN" place "$work/own.kit" --seed 5 --model "$1" --search-limit "$2" -o "$work/model.ldr" -o "$work/list.csv" >"$work/out" 2>"$work/errors" || said=$?
    [ $said -eq 0 ] || [ $said -eq 4 ] || fail "$1 with the limit $2 ends with $said"
    { [ ! -e "$work/model.ldr" ] || cat "$work/model.ldr" "$work/list.csv"; grep -oE 'error\[E[0-9]+\]' "$work/errors" | head -n 1 | grep -oE 'E[0-9]+'; } >"$work/command" || true
    [ $said -eq 0 ] || [ ! -e "$work/model.ldr" ] || cut=$((cut + 1))
    "$program" stdlib 5 "$1" "$work/own.kit" "$2" >"$work/interface" || true
    cmp "$work/command" "$work/interface" || fail "$1 with the limit $2: the command gives $(cat "$work/command") and the interface $(cat "$work/interface")"
}
for limit in 1 2 5 20; do
    for model in beam turned all; do
        limited "$model" "$limit"
    done
done
[ $cut -ge 2 ] || fail "hardly any search left a model when it passed its limit"
printf "Wall -> 'FillRect(2,2,2)' 'Place(1)' 'FillRect(2,2,2)'\n" >"$work/full.pcfg"
agree 0 '' "$work/full.pcfg"
printf "Wall -> 'Move(1,0,0)'\n" >"$work/nothing.pcfg"
agree 0 '' "$work/nothing.pcfg"
[ $placed -ge 15 ] && [ $refused -ge 5 ] || fail "$placed were placed and $refused refused: the test compares too little"
