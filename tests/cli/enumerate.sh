#!/usr/bin/env bash
# Needs the parts: store
# enumerate: everything once, in order, any stretch of it, in every format.
name=enumerate
. "$(dirname "$0")/golden.bash"

golden lines 'tartan enumerate sheds.plan -l sheds'
golden json 'tartan enumerate sheds.plan -l sheds --format json --limit 2'
golden csv 'tartan enumerate sheds.plan -l sheds --format csv --from 1 --to 4'
golden mirror 'tartan enumerate sheds.plan -l sheds --mirror --format csv'
golden past_the_end 'tartan enumerate sheds.plan -l sheds --from 999'
golden resume_lines "tartan enumerate sheds.plan -l sheds --resume -o $scratch/x.txt"

all() {
    "$TARTAN" enumerate "$files/sheds.plan" -l any-sheds --trays 0..5 "$@"
}
all >"$scratch/all"
is 'all plans' "$(wc -l <"$scratch/all")" $((1 + 4 + 16 + 64 + 256 + 1024))
is 'different plans' "$(sort -u "$scratch/all" | wc -l)" 1365
{ all --to 700 && all --from 700; } | cmp - "$scratch/all" || fail 'two halves are not the whole'
all --from 100 --limit 7 >"$scratch/stretch"
sed -n 101,107p "$scratch/all" | cmp - "$scratch/stretch" || fail 'a stretch is not where it should be'
for format in json csv bin sqlite; do
    all --format $format -o "$scratch/plans.$format"
    "$TARTAN" prune "$files/sheds.plan" "$scratch/plans.$format" -l any-sheds --trays 0..5 | cmp -s - "$scratch/all" ||
        fail "$format does not read back as it was written"
done

# Threads make blocks of ranks, which are put in their order; they begin small, and grow. 22,000 plans are several rounds of them.
more() {
    "$TARTAN" enumerate "$files/sheds.plan" -l any-sheds --trays 0..7 "$@"
}
for format in lines json csv bin; do
    more --format $format --threads 1 >"$scratch/one"
    for threads in 2 3 4; do
        more --format $format --threads $threads | cmp - "$scratch/one" || fail "$threads threads write other $format"
    done
    more --format $format --threads 3 -o "$scratch/plans.$format" && cmp "$scratch/plans.$format" "$scratch/one" || fail "another file of $format"
done
more --threads 1 >"$scratch/one"
is 'blocks of plans' "$(wc -l <"$scratch/one")" 21845
for from in 0 63 64 5000 21844; do
    more --from $from --limit 4097 --threads 3 | cmp - <(tail -n +$((from + 1)) "$scratch/one" | head -4097) || fail "other plans from rank $from on"
done
"$TARTAN" prune "$files/sheds.plan" "$scratch/one" -l any-sheds --trays 0..7 | cmp - "$scratch/one" || fail 'plans of several threads do not read back'
is 'a reader that leaves' "$(more --threads 2 | head -3)" "$(head -3 "$scratch/one")"
[ ! -w /dev/full ] || exits 3 "$TARTAN" enumerate "$files/sheds.plan" -l any-sheds --trays 0..7 --threads 2 -o /dev/full

# A database says how its plans are drawn.
"$TARTAN" sample "$files/market.plan" 6 -l market --seed 3 -o "$scratch/weighed.sqlite" || fail 'a sample by weight in a database'
python3 -c 'import sqlite3, sys
sys.exit("(by weight)" not in "".join(sqlite3.connect(sys.argv[1]).iterdump()))' "$scratch/weighed.sqlite" ||
    fail 'a database does not say that its plans are drawn by weight'
finish
