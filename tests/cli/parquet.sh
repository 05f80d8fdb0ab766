#!/usr/bin/env bash
# Needs the parts: store
# Parquet: written by enumerate, sample and best, read back by match and prune; files of another program; damaged files.
name=parquet
. "$(dirname "$0")/golden.bash"

sheds=$files/sheds.plan
enumerate() { "$TARTAN" enumerate "$sheds" -l any-sheds "$@"; }
back() { "$TARTAN" prune "$sheds" -l any-sheds --trays 0..60 "$@"; }

# ---- what is written is read back, whatever the row groups; the empty plan is among them
for options in '' '--row-group 1' '--row-group 100' '--plan-lines --row-group 7' '--plan-lines'; do
    # shellcheck disable=SC2086
    enumerate --trays 0..5 -o "$scratch/x.parquet" $options
    back "$scratch/x.parquet" | cmp - <(enumerate --trays 0..5) || fail "$options: not what was written"
    back <"$scratch/x.parquet" | cmp - <(enumerate --trays 0..5) || fail "$options: not what was written, from standard input"
    # shellcheck disable=SC2086
    enumerate --trays 0..5 --format parquet $options | cmp - "$scratch/x.parquet" || fail "$options: other bytes to standard output"
done
enumerate --trays 0..5 --from 1365 -o "$scratch/none.parquet"
is 'no plans' "$(back "$scratch/none.parquet" | wc -c)" 0
back "$scratch/x.parquet" --threads 2 | cmp - <(enumerate --trays 0..5) || fail 'threads change what is read'
far='--trays 60 --from 1000000000000000000000000000000 --limit 40'
# shellcheck disable=SC2086
enumerate $far -o "$scratch/far.parquet" --row-group 9
# shellcheck disable=SC2086
back "$scratch/far.parquet" | cmp - <(enumerate $far) || fail 'ranks of 31 digits'
grep -q rank_text "$scratch/far.parquet" && fail 'ranks of 31 digits are texts, too'

# Ranks past the 38 digits of decimal numbers are texts, too: what DuckDB reads of them, where node finds it, is what CSV has.
farther='--trays 80 --from 1000000000000000000000000000000000000000000000 --limit 40000'
# shellcheck disable=SC2086
enumerate $farther -o "$scratch/farther.parquet" --plan-lines --row-group 35000
# shellcheck disable=SC2086
enumerate $farther -f csv | cut -d , -f 1 | tail -n +2 >"$scratch/ranks"
# shellcheck disable=SC2086
back --trays 0..80 "$scratch/farther.parquet" | cmp - <(enumerate $farther) || fail 'ranks of 46 digits'
grep -q rank_text "$scratch/farther.parquet" || fail 'ranks of 46 digits are no texts'
if node -e 'require("@duckdb/node-api")' 2>/dev/null; then
    node - "$scratch/farther.parquet" <<'NODE' | cmp - "$scratch/ranks" || fail 'DuckDB reads other ranks'
const {DuckDBInstance} = require('@duckdb/node-api')
async function ask() {
  const connection = await (await DuckDBInstance.create(':memory:')).connect()
  const rows = (await connection.runAndReadAll(`SELECT rank_text FROM read_parquet('${process.argv[2]}')`)).getRows()
  console.log(rows.map((row) => row[0]).join('\n'))
}
ask()
NODE
fi
"$TARTAN" sample "$sheds" 30 -l any-sheds --trays 0..20 --seed 3 -o "$scratch/some.parquet"
back "$scratch/some.parquet" | cmp - <("$TARTAN" sample "$sheds" 30 -l any-sheds --trays 0..20 --seed 3) || fail 'sample'
is 'match reads it' "$("$TARTAN" match "$sheds" "$scratch/some.parquet" --rule door-pair | wc -l)" \
    "$("$TARTAN" match "$sheds" <("$TARTAN" sample "$sheds" 30 -l any-sheds --trays 0..20 --seed 3) --rule door-pair | wc -l)"

# ---- more plans than fit in one page, and more than one row group of them
"$TARTAN" enumerate lahave-houses --from 3000000000 --limit 150000 -o "$scratch/many.parquet" --row-group 80000
"$TARTAN" prune lahave-houses "$scratch/many.parquet" | cmp - <("$TARTAN" enumerate lahave-houses --from 3000000000 --limit 150000) ||
    fail 'many plans'
[ "$(stat -c %s "$scratch/many.parquet")" -lt 300000 ] || fail 'many plans take more than two bytes each'

# ---- files that DuckDB wrote: pages of both versions, a column of plan lines alone
for file in zstd v2 lines; do
    back "$files/parquet/duckdb-$file.parquet" | cmp - <(enumerate --trays 0..4 --from 3 --limit 40) || fail "duckdb-$file"
done
for file in snappy encoding wrong less kind; do
    golden "theirs_$file" "tartan prune sheds.plan -l any-sheds parquet/duckdb-$file.parquet"
done

# ---- shards
for options in '' '--row-group 100 --plan-lines'; do
    rm -rf "$scratch/set"
    # shellcheck disable=SC2086
    "$TARTAN" shards new "$sheds" -l any-sheds --trays 0..5 --format parquet --shards 7 -o "$scratch/set" $options 2>/dev/null
    "$TARTAN" shards run "$scratch/set" --threads 2 2>/dev/null
    exits 0 "$TARTAN" shards check "$scratch/set"
    # shellcheck disable=SC2086
    "$TARTAN" shards cat "$scratch/set" | cmp - <(enumerate --trays 0..5 --format parquet $options) || fail "shards $options: other bytes"
    "$TARTAN" shards merge "$scratch/set" -o "$scratch/merged.sqlite"
    is 'the database' "$(sqlite3 "$scratch/merged.sqlite" 'SELECT count(*) FROM plans')" 1365
done

# ---- wrong files
enumerate --trays 0..3 -o "$scratch/x.parquet"
head -c 6 "$scratch/x.parquet" >"$scratch/short.parquet"
golden short "tartan prune sheds.plan -l any-sheds $scratch/short.parquet"
head -c 300 "$scratch/x.parquet" >"$scratch/cut.parquet"
golden cut "tartan prune sheds.plan -l any-sheds $scratch/cut.parquet"
size=$(stat -c %s "$scratch/x.parquet")
wrong=0
for ((at = 4; at < size; at += 29)); do
    { head -c $at "$scratch/x.parquet" && printf '\xa5' && tail -c +$((at + 2)) "$scratch/x.parquet"; } >"$scratch/changed.parquet"
    code=0
    back "$scratch/changed.parquet" >"$scratch/out" 2>"$scratch/err" || code=$?
    [ $code -le 1 ] || fail "byte $at changed: exit code $code"
    wrong=$((wrong + code))
done
[ $wrong -gt 10 ] || fail "changed bytes were noticed $wrong times"
golden pipe "cat $scratch/x.parquet | tartan prune sheds.plan -l any-sheds"
golden none "tartan prune sheds.plan -l any-sheds --input-format parquet sheds.plan"
golden other_schema "tartan prune lahave-houses $scratch/x.parquet"

# ---- wrong use
golden use_lines 'tartan enumerate sheds.plan -l sheds --plan-lines'
golden use_columns 'tartan enumerate sheds.plan -l sheds --format parquet --columns'
golden use_compress "tartan shards new sheds.plan -l sheds --format parquet --compress --shards 2 -o $scratch/never"
golden use_shards "tartan shards new sheds.plan -l sheds --row-group 5 --shards 2 -o $scratch/never"
finish
