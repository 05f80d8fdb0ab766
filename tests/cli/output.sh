#!/usr/bin/env bash
# Output that cannot be written is an error (3); a reader that goes away is not.
name=output
. "$(dirname "$0")/golden.bash"
sheds=$files/sheds.plan
printf '3m door\n3m -\n' >"$scratch/plans"

commands=("help" "--version" "count $sheds -l sheds" "count $sheds -l sheds --json" "test $sheds" "disasm $sheds" "match $sheds $scratch/plans"
    "prune $sheds $scratch/plans -l sheds" "enumerate $sheds -l sheds" "sample $sheds 3 -l sheds" "unrank $sheds 0 -l sheds")
for command in "${commands[@]}"; do
    if [ -w /dev/full ]; then
        code=0
        # shellcheck disable=SC2086
        "$TARTAN" $command >/dev/full 2>"$scratch/err" || code=$?
        is "full disk, $command" "$code" 3
        grep -q 'E0902' "$scratch/err" || fail "full disk, $command: no E0902"
    fi
    code=0
    # The reader is gone before anything is written.
    # shellcheck disable=SC2086
    { sleep 0.2; "$TARTAN" $command 2>"$scratch/err" || echo $? >"$scratch/code"; } | true
    [ ! -e "$scratch/code" ] || fail "closed pipe, $command: exit $(cat "$scratch/code")"
    rm -f "$scratch/code"
    [ ! -s "$scratch/err" ] || fail "closed pipe, $command: $(head -n 1 "$scratch/err")"
done
# A file beyond the limit of the shell is an error too, and nothing of it stays but the plans that were enumerated.
for out in "export lahave --prolog -o $scratch/big.pl" "enumerate lahave-houses -n 5000 -o $scratch/big.plans" "grow koch -n 5 -o $scratch/big.obj"; do
    # shellcheck disable=SC2086
    code=0 && (ulimit -f 1 && exec "$TARTAN" $out 2>"$scratch/err") || code=$?
    is "a limit of files' sizes, $out" "$code" 3
    grep -q 'larger than is allowed' "$scratch/err" || fail "a limit of files' sizes, $out: $(head -n 1 "$scratch/err")"
done
[ "$(find "$scratch" -name 'big.*' ! -name big.plans | wc -l)" = 0 ] || fail "a limit of files' sizes: $(ls "$scratch")"
rm -f "$scratch"/big.*
# Closed descriptors are not those of the next file that is opened.
for command in "${commands[@]}"; do
    # shellcheck disable=SC2086
    code=0 && "$TARTAN" $command >&- 2>"$scratch/err" || code=$?
    is "closed output, $command" "$code" 3
    grep -q 'it is closed' "$scratch/err" || fail "closed output, $command: $(head -n 1 "$scratch/err")"
done
"$TARTAN" enumerate "$sheds" -l sheds -o "$scratch/open.plans"
"$TARTAN" enumerate "$sheds" -l sheds -o "$scratch/closed.plans" <&- >&- 2>&-
cmp "$scratch/open.plans" "$scratch/closed.plans" || fail 'with all descriptors closed, a file is written otherwise'
code=0 && timeout 60 "$TARTAN" lsp <&- 2>"$scratch/err" || code=$?
is 'a language server without input' "$code" 1

# A reader that goes away in the middle of much output.
"$TARTAN" enumerate "$sheds" -l any-sheds --trays 0..9 2>"$scratch/err" | head -n 3 >/dev/null
is 'closed pipe in the middle' "${PIPESTATUS[0]}" 0
[ ! -s "$scratch/err" ] || fail "closed pipe in the middle: $(head -n 1 "$scratch/err")"

for output in "$scratch/no/such/folder/x" "$scratch"; do
    exits 3 "$TARTAN" build "$sheds" -o "$output"
    exits 3 "$TARTAN" enumerate "$sheds" -l sheds -o "$output"
    exits 3 "$TARTAN" count "$sheds" -l sheds -o "$output"
done
exits 3 "$TARTAN" draw "$sheds" --sample 2 -l sheds -o "$scratch/no/such/folder/x.svg"

# What was there stays as it was where writing fails, and nothing is left beside it.
mkdir "$scratch/folder"
echo old >"$scratch/folder/x.tnb"
exits 1 "$TARTAN" build "$scratch/plans" -o "$scratch/folder/x.tnb"
is 'the old file' "$(cat "$scratch/folder/x.tnb")" old
is 'files in the folder' "$(ls "$scratch/folder")" x.tnb
finish
