#!/usr/bin/env bash
# What the front ends say about wrong rule files: tests/diagnostics/NAME.plan (.hemls, .study, .field, .pcfg, .kit, .solid) is checked, and what is then
# on stderr is NAME.expect. What only another command says is shown by the command in NAME.command. `--update` writes the expectations anew: read the difference before you keep it.
set -euo pipefail
: "${TARTAN:?the binary to test}"
cd "$(dirname "$0")/../diagnostics"
failed=0
seen=$(mktemp)
trap 'rm -f "$seen"' EXIT
for plan in *.plan *.bnf *.hemls *.study *.field *.pcfg *.kit *.solid; do
    name=${plan%.*}
    status=0
    command=(check "$plan")
    [ ! -e "$name.command" ] || read -ra command <"$name.command"
    said=$("$TARTAN" "${command[@]}" 2>&1 >/dev/null) || status=$?
    if [ "${1-}" = --update ]; then
        printf '%s' "${said:+$said$'\n'}" >"$name.expect"
        continue
    fi
    printf '%s\n' "$said" >>"$seen"
    expected=$(<"$name.expect")
    if [ "$said" != "$expected" ]; then
        diff -u "$name.expect" <(printf '%s' "${said:+$said$'\n'}") || true
        echo "FAILED: $plan"
        failed=1
    fi
    wanted=0
    [[ $expected != *'error['* ]] || wanted=1
    [ ! -e "$name.command" ] || [ "$status" = 0 ] || status=1 # it may be that of a limit
    if [ "$status" != "$wanted" ]; then
        echo "FAILED: $plan: exit status $status"
        failed=1
    fi
done
[ "${1-}" != --update ] || exit 0
# Every code that the front ends report is among them, and every warning about a design; solid.sh makes a design of too many boxes.
names=$({
    grep -ohE '\b[EW]_[A-Z0-9_]+' ../../grammar/{plan,hemls,study,field,pcfg,kit,solid}.[ly] ../../compiler/{hemls,study,field,pcfg,kit,solid}/*.c \
        ../../compiler/plan/{syntax,check}/*.c ../../compiler/common/{import,lexical}.c ../../driver/plan/analysis.c
    grep -ohE '\bW_[A-Z0-9_]+' ../../driver/solid/solid.c
} | grep -v E_SOLID_TOO_MANY | sort -u)
missing=$(awk -v names="$names" '
    BEGIN {
        split(names, list, "\n")
        for (i in list)
            wanted[list[i]] = 1
    }
    FNR == NR && match($0, /^(ERROR|WARNING)\([0-9]+, [A-Z0-9_]+/) {
        split(substr($0, RSTART, RLENGTH), part, /[(,] */)
        if ((substr($0, 1, 1) "_" part[3]) in wanted)
            codes[$0 ~ /^E/ ? sprintf("error[E%04d]", part[2]) : sprintf("warning[W%03d]", part[2])] = 1
        next
    }
    FNR != NR {
        while (match($0, /(error|warning)\[[EW][0-9]+\]/)) {
            delete codes[substr($0, RSTART, RLENGTH)]
            $0 = substr($0, RSTART + RLENGTH)
        }
    }
    END {
        for (code in codes)
            print code
    }' ../../runtime/base/codes.def "$seen")
for code in $missing; do
    echo "FAILED: no file shows $code"
    failed=1
done
exit "$failed"
