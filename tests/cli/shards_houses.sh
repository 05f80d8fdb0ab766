#!/usr/bin/env bash
# Needs the parts: store
# Shard sets of houses: their tables together are what one `tartan enumerate --columns` writes, byte by byte as CSV and row by row in a database and in
# Parquet, also if workers are killed; what is damaged is said; the questions of houses as tables are answered alike, by DuckDB where node finds it.
name=shards_houses
. "$(dirname "$0")/golden.bash"
cd "$scratch" || exit
cabins=$files/cabins.plan

# set_of NAME OPTIONS...
set_of() {
    local to=$1
    shift
    "$TARTAN" shards new "$cabins" --library cottages -o "$to" "$@" 2>said || fail "no set: $(cat said)"
}
# same_rows A B: of all tables of two databases, with the kinds of their values.
same_rows() {
    local table
    for table in houses rooms faces; do
        cmp <(sqlite3 -cmd '.mode quote' "$1" "SELECT * FROM $table ORDER BY rowid") <(sqlite3 -cmd '.mode quote' "$2" "SELECT * FROM $table ORDER BY rowid") ||
            fail "other $table in $1 and $2"
    done
}
# gathered SET ENUMERATE-OPTIONS...
gathered() {
    local of=$1 table
    shift
    rm -f one* cat* merged*
    "$TARTAN" enumerate "$cabins" --library cottages --columns -o one.csv "$@" 2>said
    "$TARTAN" shards cat "$of" -o cat.csv || fail "$of is not put together"
    for table in '' .rooms .faces; do
        cmp "one$table.csv" "cat$table.csv" || fail "$of: other rows of houses$table"
    done
    "$TARTAN" enumerate "$cabins" --library cottages --columns -o one.sqlite "$@" 2>said
    "$TARTAN" shards merge "$of" -o merged.sqlite || fail "$of is not merged"
    same_rows one.sqlite merged.sqlite
}

set_of some.set --from 4990 --to 5093 --shards 7
is 'made' "$(cat said)" 'note: some.set has 7 shards for 103 houses; `tartan shards run some.set` writes them'
is 'not there yet' "$("$TARTAN" shards cat some.set 2>&1 | head -1)" 'error[E1707]: 7 of the 7 shards of some.set are not there, or without a record; the first is shards/000/000000.houses.csv'
for worker in 1 2 3; do "$TARTAN" shards run some.set 2>/dev/null & done
wait
is 'written' "$("$TARTAN" shards run some.set 2>&1)" 'note: all shards are there already; `tartan shards check` reads whether they are whole'
is 'whole' "$("$TARTAN" shards check some.set)" 'all 7 shards are there and whole: 103 houses'
is 'status' "$("$TARTAN" shards status some.set | head -2 | paste -sd ,)" 'shards  7 of 7,houses  103 of 103'
gathered some.set --from 4990 --to 5093
total=$("$TARTAN" count "$cabins" --library cottages --json | sed 's/.*"houses":"\([0-9]*\)".*/\1/')
set_of last.set --from $((total - 13)) --plans 4 # to the last one
"$TARTAN" shards run last.set 2>/dev/null
gathered last.set --from $((total - 13))
set_of none.set --from 9 --to 9 --shards 3
"$TARTAN" shards run none.set 2>/dev/null
gathered none.set --from 9 --to 9

# Of a library with further requirements, and of a module.
"$TARTAN" shards new "$cabins" --library cottages --where 'quantity(cell(porch-deck)) = 0' --to 40 --shards 3 -o where.set 2>said || fail "$(cat said)"
"$TARTAN" shards run where.set 2>/dev/null
gathered where.set --where 'quantity(cell(porch-deck)) = 0' --to 40
"$TARTAN" build "$cabins" -o cabins.tnb
"$TARTAN" shards new cabins.tnb --library cottages --from 4990 --to 5093 --shards 7 -o built.set 2>/dev/null
"$TARTAN" shards run built.set 2>/dev/null
"$TARTAN" shards cat built.set -o built.csv
"$TARTAN" shards cat some.set -o cat.csv
cmp built.rooms.csv cat.rooms.csv || fail 'a module has other rooms'

# Workers that are killed at any moment leave whole shards, and others go on.
set_of killed.set --to 400 --shards 40
for after in 0.02 0.05 0.1 0.15 0.2 0.3; do
    "$TARTAN" shards run killed.set 2>/dev/null &
    sleep $after
    kill -9 $! 2>/dev/null || true
    wait $! 2>/dev/null || true
done
"$TARTAN" shards run killed.set 2>/dev/null || fail 'a set of killed workers is not finished'
gathered killed.set --to 400
is 'whole' "$("$TARTAN" shards check killed.set)" 'all 40 shards are there and whole: 400 houses'

# What is damaged is said, and written again.
first=some.set/shards/000/000001
damaged() {
    local what=$1 command=$2 wanted=$3
    is "$what" "$("$TARTAN" shards "$command" some.set 2>&1 | head -1)" "error[E1706]: some.set/shards/000/000001.houses.csv $wanted"
}
cp $first.rooms.csv kept.csv
sed 's/living/bedoom/' kept.csv >$first.rooms.csv
damaged 'a byte' check 'was changed after it was written: its hash is another, in rooms'
damaged 'a byte, put together' cat 'was changed after it was written: its hash is another, in rooms'
head -c 100 kept.csv >$first.rooms.csv
damaged 'shorter' run "has 100 bytes, and had $(stat -c %s kept.csv) when it was written, in rooms"
rm $first.rooms.csv
damaged 'a table' run 'lacks its table of rooms'
damaged 'a table, looked at' check 'lacks its table of rooms'
rm $first.*
"$TARTAN" shards run some.set 2>/dev/null
cmp kept.csv $first.rooms.csv || fail 'another shard'
touch some.set/shards/000/000001.walls.csv
is 'a stranger' "$("$TARTAN" shards check some.set 2>&1 | head -1)" 'error[E1708]: some.set/shards/000/000001.walls.csv is no shard of this set'
rm some.set/shards/000/000001.walls.csv

# Parquet: of one shard the bytes are those of one command, of several the rows are.
set_of one.parquet.set --to 60 --shards 1 --format parquet
set_of some.parquet.set --to 60 --shards 5 --format parquet
"$TARTAN" shards run one.parquet.set 2>/dev/null
"$TARTAN" shards run some.parquet.set 2>/dev/null
"$TARTAN" enumerate "$cabins" --library cottages --columns --to 60 -o one.parquet
for table in houses rooms faces; do
    to=.$table
    [ $table != houses ] || to=
    cmp one$to.parquet one.parquet.set/shards/000/000000.$table.parquet || fail "$table of one shard in Parquet"
done
golden parquet "tartan shards cat $scratch/some.parquet.set -o $scratch/x.parquet"
golden parquet_merged "tartan shards merge $scratch/some.parquet.set -o $scratch/x.sqlite"
golden backwards "tartan shards new cabins.plan --library cottages -o x.set --shards 2 --from 9 --to 4"
golden lines "tartan shards new cabins.plan --library cottages -o x.set --shards 2 --format lines"
golden compressed "tartan shards new cabins.plan --library cottages -o x.set --shards 2 --compress"
golden sampled "tartan shards new cabins.plan --library cottages -o x.set --shards 2 --sample 9"
if node -e 'require("@duckdb/node-api")' 2>/dev/null; then
    "$TARTAN" shards new row-houses --library row-houses --from 100000 --to 100300 --shards 6 --format parquet -o rows.set 2>/dev/null
    "$TARTAN" shards run rows.set 2>/dev/null
    "$TARTAN" enumerate row-houses --library row-houses --columns --from 100000 --to 100300 -o rows.sqlite
    cat >questions.sql <<'SQL'
SELECT bedroom_rooms, garden_roof, ROUND(AVG(net_m2), 6) FROM houses GROUP BY bedroom_rooms, garden_roof ORDER BY bedroom_rooms, garden_roof;
SELECT house, cost FROM houses WHERE bath_rooms >= 1 ORDER BY cost, house LIMIT 10;
SELECT f.side, ROUND(SUM(f.glazed_m2) / (SELECT SUM(net_m2) FROM rooms WHERE function = 'parlour'), 6) FROM faces f WHERE f.function = 'parlour' AND f.outside = 1 GROUP BY f.side ORDER BY f.side;
SELECT finish, COUNT(*), MIN(cost), ROUND(AVG(cost), 3), MAX(cost) FROM houses GROUP BY finish ORDER BY finish;
SELECT plan_rank, COUNT(*) FROM houses GROUP BY plan_rank HAVING COUNT(*) > 1 ORDER BY COUNT(*) DESC, plan_rank;
SQL
    while IFS= read -r question; do
        sqlite3 -separator , rows.sqlite "$question"
        echo --
    done <questions.sql | sed -E 's/\.0+(,|$)/\1/g' >wanted
    node - <<'NODE' | sed -E 's/\.0+(,|$)/\1/g' >answered || fail 'DuckDB does not answer'
const {DuckDBInstance} = require('@duckdb/node-api'), {readFileSync} = require('fs')
async function ask() {
  const connection = await (await DuckDBInstance.create(':memory:')).connect()
  for (const table of ['houses', 'rooms', 'faces'])
    await connection.run(`CREATE VIEW ${table} AS SELECT * FROM 'rows.set/shards/*/*.${table}.parquet'`)
  for (const question of readFileSync('questions.sql', 'utf8').trim().split('\n')) {
    for (const row of (await connection.runAndReadAll(question)).getRows()) console.log(row.join(','))
    console.log('--')
  }
}
ask()
NODE
    cmp wanted answered || fail "DuckDB answers otherwise"
    [ "$(grep -c . wanted)" -gt 12 ] || fail 'the questions have no answers'
fi
finish
