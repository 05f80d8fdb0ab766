#!/usr/bin/env bash
# Needs the parts: store
# Houses as tables: columns that `tartan house` confirms, the same in CSV and in SQLite, and questions answered by sqlite3, by DuckDB
# where node finds it (NODE_PATH), and by Python alone.
name=house_tables
. "$(dirname "$0")/golden.bash"

golden packed "tartan sample row-houses 3 -l row-houses --columns -o $scratch/x.bin"
golden parquet "tartan sample row-houses 3 -l row-houses --columns --row-group 5 -o $scratch/x.parquet"
golden lines 'tartan sample row-houses 3 -l row-houses --columns'
golden resumed "tartan enumerate row-houses -l row-houses --columns --limit 3 --resume -o $scratch/x.sqlite"
golden standard_output 'tartan enumerate cabins.plan -l cottages --columns --limit 2 -f csv'
golden best 'tartan best house-measures.plan 3 -l cottages --least bedrooms -f csv | cut -d , -f 1-8'
golden no_database 'tartan best house-measures.plan 3 -l cottages --least bedrooms -f sqlite'
golden other_file "printf 'not a library, but 512 bytes of something else%0512d' 0 >$scratch/y.sqlite; tartan sample row-houses 1 -l row-houses --columns -o $scratch/y.sqlite"

"$TARTAN" sample row-houses 120 -l row-houses --seed 3 --columns -o "$scratch/h.csv"
"$TARTAN" sample row-houses 120 -l row-houses --seed 3 --columns -o "$scratch/h.sqlite"
"$TARTAN" sample row-houses 120 -l row-houses --seed 3 --columns -o "$scratch/again.csv" --threads 1
for table in '' .rooms .faces; do
    cmp "$scratch/h$table.csv" "$scratch/again$table.csv" || fail "other rows of houses$table"
done
"$TARTAN" sample row-houses 120 -l row-houses --seed 3 --columns -o "$scratch/h.parquet"
"$TARTAN" prune row-houses "$scratch/h.parquet" -l rows | cmp - <(python3 -c 'import csv, sys; [print(r["plan"]) for r in csv.DictReader(open(sys.argv[1]))]' "$scratch/h.csv") ||
    fail 'the plans of houses in Parquet are not read back'
"$TARTAN" sample row-houses 120 -l row-houses --seed 3 -f csv >"$scratch/plain.csv"
"$TARTAN" enumerate cottage -l cottages --limit 5 --columns -o "$scratch/h.sqlite.2.sqlite"
"$TARTAN" sample row-houses 120 -l row-houses --seed 3 --columns -o "$scratch/h.sqlite.2.sqlite" # in place of other houses
is 'a database that is replaced' "$(sqlite3 "$scratch/h.sqlite.2.sqlite" .dump | sort | md5sum)" "$(sqlite3 "$scratch/h.sqlite" .dump | sort | md5sum)"
for house in 3 40 77; do
    python3 -c 'import csv, sys; print(list(csv.DictReader(open(sys.argv[1])))[int(sys.argv[2]) - 1]["line"], end="")' "$scratch/h.csv" $house >"$scratch/line"
    "$TARTAN" house row-houses "$(cat "$scratch/line")" -o "$scratch/$house.json" -o "$scratch/$house.rooms.csv" -o "$scratch/$house.parts.csv" >/dev/null 2>&1
done
"$TARTAN" best cottage 40 -l cottages --most floor-area --then-least bedrooms -o "$scratch/best.json"
"$TARTAN" best cottage 40 -l cottages --most floor-area --then-least bedrooms -o "$scratch/best.csv"

cat >"$scratch/questions.sql" <<'SQL'
SELECT bedroom_rooms, garden_roof, AVG(net_m2) FROM houses GROUP BY bedroom_rooms, garden_roof ORDER BY bedroom_rooms, garden_roof;
SELECT house, cost FROM houses WHERE bath_rooms >= 2 ORDER BY cost, house LIMIT 10;
SELECT f.side, SUM(f.glazed_m2) / (SELECT SUM(net_m2) FROM rooms WHERE function = 'parlour') FROM faces f WHERE f.function = 'parlour' AND f.outside = 1 GROUP BY f.side ORDER BY f.side;
SELECT finish, COUNT(*), MIN(cost), AVG(cost), MAX(cost) FROM houses GROUP BY finish ORDER BY finish;
SELECT plan_rank, COUNT(*) FROM houses GROUP BY plan_rank HAVING COUNT(*) > 1 ORDER BY COUNT(*) DESC, plan_rank;
SQL
while IFS= read -r question; do
    sqlite3 -separator , "$scratch/h.sqlite" "$question"
    echo --
done <"$scratch/questions.sql" >"$scratch/sqlite.txt"
if node -e 'require("@duckdb/node-api")' 2>/dev/null; then
    node - "$scratch" <<'NODE' >"$scratch/duckdb.txt" || fail 'DuckDB does not answer'
const {DuckDBInstance} = require('@duckdb/node-api'), {readFileSync} = require('fs'), folder = process.argv[2]
async function ask() {
  const connection = await (await DuckDBInstance.create(':memory:')).connect()
  for (const [table, file] of [['houses', 'h'], ['rooms', 'h.rooms'], ['faces', 'h.faces']])
    await connection.run(`CREATE TABLE ${table} AS SELECT * FROM read_csv('${folder}/${file}.csv'${table === 'houses' ? ", types = {'rank': 'VARCHAR', 'plan_rank': 'VARCHAR'}" : ''})`)
  for (const file of ['h', 'h.rooms', 'h.faces']) { // Parquet holds what CSV does
    const types = file === 'h' ? ", types = {'rank': 'VARCHAR', 'plan_rank': 'VARCHAR'}" : ''
    const both = [`SELECT * FROM read_csv('${folder}/${file}.csv'${types})`, `SELECT * FROM read_parquet('${folder}/${file}.parquet')`]
    for (const [a, b] of [both, [...both].reverse()])
      if ((await connection.runAndReadAll(`${a} EXCEPT ALL ${b}`)).getRows().length) throw new Error(file)
  }
  for (const question of readFileSync(folder + '/questions.sql', 'utf8').trim().split('\n')) {
    for (const row of (await connection.runAndReadAll(question)).getRows()) console.log(row.join(','))
    console.log('--')
  }
}
ask()
NODE
else
    cp "$scratch/sqlite.txt" "$scratch/duckdb.txt"
fi
python3 - "$scratch" <<'PYTHON' || fail 'tables of houses are not as they should be'
import collections, csv, json, sqlite3, sys

folder = sys.argv[1]
read = lambda name: list(csv.DictReader(open(f"{folder}/{name}.csv", newline="")))
houses, rooms, faces, plain = read("h"), read("h.rooms"), read("h.faces"), read("plain")
near = lambda a, b: abs(float(a) - float(b)) <= 1e-6 * max(1, abs(float(b)))

# The tables are those of the database; every house is one that `sample` gives.
database = sqlite3.connect(f"{folder}/h.sqlite")
for table, rows in ("houses", houses), ("rooms", rooms), ("faces", faces):
    cursor = database.execute(f"SELECT * FROM {table} ORDER BY rowid")
    assert [c[0] for c in cursor.description] == list(rows[0]), table
    for got, row in zip(cursor, rows, strict=True):
        for value, text in zip(got, row.values(), strict=True):
            assert (value is None and text == "") or (isinstance(value, str) and value == text) or (
                isinstance(value, (int, float)) and near(value, text)), (table, value, text)
assert len(houses) == 120
for row, line in zip(houses, plain, strict=True):
    assert (row["rank"], row["plan_rank"], row["plan"], row["line"]) == (line["rank"], line["plan_rank"], line["plan"], line["house"])

# What three houses come to, by `tartan house`.
NM = 10**9
for number in ("3", "40", "77"):
    house = houses[int(number) - 1]
    its = lambda table: [row for row in table if row["house"] == number]
    model, schedule, parts = json.load(open(f"{folder}/{number}.json")), read(f"{number}.rooms"), read(f"{number}.parts")
    for got, row in zip(its(rooms), schedule, strict=True):
        assert got["function"] == row["function"] and got["storey"] == row["storey"] and got["cells"] == row["cells"]
        assert all(near(got[k], row[k]) for k in ("gross_m2", "net_m2", "glazed_m2")), (got, row)
    assert int(house["rooms"]) == len(schedule) and near(house["net_m2"], sum(float(r["net_m2"]) for r in schedule))
    for function in {c[:-6] for c in house if c.endswith("_rooms")}:
        of = [float(r["net_m2"]) for r in schedule if r["function"] == function]
        assert int(house[function + "_rooms"]) == len(of) and near(house[function + "_net_m2"], sum(of)), function
    assert near(house["cost"], parts[-1]["cost"]) and int(house["trays"]) == len(house["plan"].split(" | "))
    section = house["line"].split(" ; ")[1].split()
    assert [house[c] for c in ("wing_storeys", "street_roof", "garden_roof", "wing_roof", "finish") if house[c] in section], section
    for got, face in zip(its(faces), model["faces"], strict=True):
        assert [float(got[k]) * NM for k in ("x0_m", "x1_m", "y0_m", "y1_m")] == face["at"] and got["kind"] == face["kind"], (got, face)
        cells = {model["cells"][c]["function"] for c in (face["a"], face["b"]) if c is not None}
        assert {got["function"], got["other_function"]} - {""} == cells, (got, cells)
        assert got["outside"] == ("1" if face["rel"] == "outside" else "0") and got["side"] == face["side"]
    per_room = collections.defaultdict(float)
    for got in its(faces):
        per_room[got["room"]] += float(got["glazed_m2"])
    assert all(near(per_room[r["room"]], r["glazed_m2"]) for r in its(rooms))

# Measures are those that `best` goes by.
best, found = read("best"), [json.loads(line) for line in open(f"{folder}/best.json")]
for row, one in zip(best, found, strict=True):
    assert row["line"] == one["house"] and near(row["floor_area_sf"], one["values"][0]) and near(row["bedrooms"], one["values"][1])

# The questions, answered here from the CSV files.
number = lambda h, c: float(h[c])
groups = lambda key: sorted({tuple(h[k] for k in key) for h in houses}, key=lambda k: tuple(int(x) if x.isdigit() else x for x in k))
mean = lambda values: sum(values) / len(values)
parlours = sum(float(r["net_m2"]) for r in rooms if r["function"] == "parlour")
sides = collections.defaultdict(float)
for f in faces:
    if f["function"] == "parlour" and f["outside"] == "1":
        sides[f["side"]] += float(f["glazed_m2"])
plans = collections.Counter(h["plan_rank"] for h in houses)
wanted = [
    [[*k, mean([number(h, "net_m2") for h in houses if (h["bedroom_rooms"], h["garden_roof"]) == k])] for k in groups(("bedroom_rooms", "garden_roof"))],
    sorted(([h["house"], number(h, "cost")] for h in houses if int(h["bath_rooms"]) >= 2), key=lambda r: (r[1], int(r[0])))[:10],
    [[side, sides[side] / parlours] for side in sorted(sides)],
    [[k[0], len(c), min(c), mean(c), max(c)] for k in groups(("finish",)) for c in [[number(h, "cost") for h in houses if h["finish"] == k[0]]]],
    [[p, n] for p, n in sorted(plans.items(), key=lambda i: (-i[1], i[0])) if n > 1],
]
assert all(wanted) and len(wanted[3]) == 2 and len(wanted[2]) >= 2, wanted
for who in ("sqlite", "duckdb"):
    answers = [list(csv.reader(part.strip().splitlines())) for part in open(f"{folder}/{who}.txt").read().split("--\n")[:-1]]
    for answer, rows in zip(answers, wanted, strict=True):
        answer = [",".join(a).replace("(back,", "(back;").replace("(front,", "(front;").split(",") for a in answer]
        for got, row in zip(answer, rows, strict=True):
            row = [str(v).replace(",", ";") if isinstance(v, str) else v for v in row]
            assert len(got) == len(row), (who, got, row)
            for a, b in zip(got, row):
                assert a == str(b) or (not isinstance(b, str) and near(a, b)), (who, got, row)
PYTHON
finish
