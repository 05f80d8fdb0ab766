#!/usr/bin/env bash
# Needs the parts: store
# Files of plans: every error of docs/plan-files.md, and each format read back by whoever reads plans.
name=plan_files
. "$(dirname "$0")/golden.bash"

match="tartan match sheds.plan $scratch"
skip='--format bits --on-error skip'

# E0601 to E0603 and E0805, in plan lines, JSON lines and CSV
printf '3m -\n3m\n3m - door\n3m - |\n3m - | | 6m -\n9m -\n- 3m\n' >"$scratch/lines"
golden lines "$match/lines $skip"
{
    printf '{"trays":[{"width":"3m","door":true}]}\n'
    printf '{"trays":[{"width":"3m","dor":true}]}\n'
    printf '{"trays":[{"width":"3 m"}]}\n'
    printf '{"trays":[{"width":"3m"}]\n'
    printf '{"rank":"1"}\n'
} >"$scratch/json"
golden json "$match/json $skip"
printf 'rank,plan\n0,3m -\n1,"3m - | 9m -"\n2\n3,"3m -\n' >"$scratch/csv"
golden csv "$match/csv $skip"
cat >"$scratch/forbids.plan" <<'PLAN'
schema shed {
  width = 3m | 6m
  door  = flag
  forbid tray(6m, door)
}
rule wide = tray(6m)
PLAN
printf '6m -\n6m - | 6m door\n' >"$scratch/forbidden"
golden forbidden "tartan match $scratch/forbids.plan $scratch/forbidden $skip"
printf '3m -\n3m - | 3m - | 3m -\n' >"$scratch/long"
golden too_long "$match/long $skip --max-length 2"

# E0604: no known format, damaged, or of another schema
printf '\x7fELF\0\0' >"$scratch/junk"
golden junk "$match/junk"
golden not_csv "$match/lines --input-format csv"
golden not_bin "$match/lines --input-format bin"
golden not_sqlite "$match/lines --input-format sqlite"
"$TARTAN" enumerate "$files/sheds.plan" -l sheds --format bin >"$scratch/bin"
golden other_schema "tartan match $scratch/forbids.plan $scratch/bin"
head -c -1 "$scratch/bin" >"$scratch/cut"
golden cut_off "$match/cut --format bits"

# E0605: a line too long (1 MiB), of which the rest is skipped
{
    echo '3m -'
    head -c 1100000 /dev/zero | tr '\0' ' '
    echo
    echo '3m -'
} >"$scratch/wide"
exits 4 "$TARTAN" match "$files/sheds.plan" "$scratch/wide" --format bits --on-error skip
is 'lines around one too long' "$(cat "$scratch/out")" $'00\n00'
grep -q 'E0605.*longer than the limit of 1048576 bytes' "$scratch/err" || fail "no E0605: $(head -c 200 "$scratch/err")"

# E0807: one relation of so long a plan passes the interpreter's memory; automata need none
{
    echo '3m door | 3m door'
    printf '3m -'
    printf ' | 3m -%.0s' {2..100000}
    echo
} >"$scratch/row"
exits 4 "$TARTAN" match "$files/sheds.plan" "$scratch/row" --format bits --max-length 100000 --engine vm
grep -q 'E0807.*100000 trays needs more memory than the limit of 1073741824 bytes' "$scratch/err" ||
    fail "no E0807: $(head -c 200 "$scratch/err")"
exits 0 "$TARTAN" match "$files/sheds.plan" "$scratch/row" --format bits --max-length 100000 --engine dfa
is 'a long row by automata' "$(cat "$scratch/out")" $'10\n00'

# E0606: a library that cannot be gone on with
"$TARTAN" enumerate "$files/sheds.plan" -l sheds -o "$scratch/sheds.sqlite" --limit 2
golden other_library "tartan enumerate sheds.plan -l any-sheds -o $scratch/sheds.sqlite --limit 2 --resume"
golden not_a_library "tartan enumerate sheds.plan -l sheds -o $scratch/lines --resume"

# Every format says the same to match and prune.
"$TARTAN" enumerate "$files/sheds.plan" -l any-sheds >"$scratch/plans"
"$TARTAN" match "$files/sheds.plan" "$scratch/plans" --format bits >"$scratch/bits"
[ -s "$scratch/bits" ] || fail 'no plans'
for format in lines json csv bin sqlite; do
    if [ "$format" = sqlite ]; then
        "$TARTAN" enumerate "$files/sheds.plan" -l any-sheds -o "$scratch/all.sqlite"
    else
        "$TARTAN" enumerate "$files/sheds.plan" -l any-sheds --format "$format" -o "$scratch/all.$format"
    fi
    "$TARTAN" match "$files/sheds.plan" "$scratch/all.$format" --format bits | cmp -s - "$scratch/bits" ||
        fail "match reads $format otherwise"
    "$TARTAN" prune "$files/sheds.plan" -l sheds "$scratch/all.$format" >"$scratch/kept.$format"
    cmp -s "$scratch/kept.lines" "$scratch/kept.$format" || fail "prune reads $format otherwise"
    [ "$format" = sqlite ] || [ "$format" = bin ] ||
        "$TARTAN" match "$files/sheds.plan" --format bits <"$scratch/all.$format" | cmp -s - "$scratch/bits" ||
        fail "match reads $format otherwise from standard input"
done
finish
