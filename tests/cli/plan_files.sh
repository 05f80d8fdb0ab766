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

# Fields that are called like other columns: no two columns have one name, and every format is read back
cat >"$scratch/names.plan" <<'PLAN'
schema odd {
  rank   = 3m | 6m
  tray   = a | b
  plan   = x | y
  length = flag
  total  = flag
  number = flag
  plan_2 = flag
  Plan   = flag
}
library all { trays 0..2 }
PLAN
names=$scratch/names.plan
"$TARTAN" enumerate "$names" --limit 300 -o "$scratch/names.plans"
for format in csv parquet sqlite json; do
    for columns in '' --columns; do
        [ "$format$columns" = parquet--columns ] || [ "$format$columns" = json--columns ] && continue
        file=$scratch/names$columns.$format
        "$TARTAN" enumerate "$names" --limit 300 $columns -o "$file" || fail "$file is not written"
        "$TARTAN" prune "$names" "$file" | cmp -s - "$scratch/names.plans" || fail "$file is not read back"
        [ "$format" != csv ] || is "two columns of $file" "$(head -n 1 "$file" | tr , '\n' | sort -f | uniq -di)" ''
    done
done
is 'columns of fields' "$(head -n 1 "$scratch/names--columns.csv")" 'rank,tray,rank_2,tray_2,plan_3,length,total,number,plan_2,Plan_4'

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

# With --columns a row is a tray: what is written so is read again, at any spelling of the cells.
"$TARTAN" enumerate "$files/sheds.plan" -l any-sheds --format csv --columns -o "$scratch/columns.csv"
"$TARTAN" match "$files/sheds.plan" "$scratch/columns.csv" --format bits | cmp -s - "$scratch/bits" || fail 'match reads columns otherwise'
"$TARTAN" prune "$files/sheds.plan" -l sheds - <"$scratch/columns.csv" | cmp -s "$scratch/kept.lines" - || fail 'prune reads columns otherwise'
python3 - "$scratch/columns.csv" >"$scratch/turned.csv" <<'PY'
import csv, sys
rows = list(csv.reader(open(sys.argv[1])))
writer = csv.writer(sys.stdout, quoting=csv.QUOTE_ALL, lineterminator="\r\n")
for row in rows: # the columns turned round, one more among them, and all in quotes
    writer.writerow(row[::-1] + ["more"])
PY
"$TARTAN" prune "$files/sheds.plan" -l sheds "$scratch/turned.csv" | cmp -s "$scratch/kept.lines" - || fail 'turned columns are read otherwise'
"$TARTAN" enumerate lahave-houses --limit 3000 --format csv --columns --csv-safe |
    "$TARTAN" prune lahave-houses - | cmp -s - <("$TARTAN" enumerate lahave-houses --limit 3000) || fail 'houses are read otherwise'
cat >"$scratch/wrong.csv" <<'CSV'
tray,width,door,rank,more
1,3m,-,7,x
2,3m,dor,7,x
3,3m,-,7,x

1,3m,,8
2,"3m",door,8
4,3m,-,8
1,3000mm,-,9
x,3m,-,10
0,,,12
2,3m,-,13
1,"3m,-,11
1,6m,door,14
2,3m,-,14
CSV
golden columns "$match/wrong.csv $skip"
printf 'tray,widht,door\n1,6m,-\n' >"$scratch/misspelled.csv"
golden columns_misspelled "$match/misspelled.csv"
printf 'tray,width,door\n1,6m,door\n2,3m,-\n3,3m,-\n' >"$scratch/long.csv"
golden columns_too_long "$match/long.csv --max-length 2 $skip"
golden columns_of_lines 'tartan enumerate sheds.plan -l sheds --columns'

# A database with columns answers questions in SQL; it goes on, and is read, as one without.
"$TARTAN" enumerate "$files/sheds.plan" -l any-sheds --columns -o "$scratch/columns.sqlite"
"$TARTAN" match "$files/sheds.plan" "$scratch/columns.sqlite" --format bits | cmp -s - "$scratch/bits" || fail 'match reads a database with columns otherwise'
is 'the trays of a database' "$(sqlite3 "$scratch/columns.sqlite" 'SELECT count(*) FROM trays')" "$(sqlite3 "$scratch/columns.sqlite" 'SELECT sum(length) FROM plans')"
is 'their lengths' "$(sqlite3 "$scratch/columns.sqlite" 'SELECT count(*) FROM plans WHERE width_total != 1e6 * coalesce((SELECT sum(width_mm) FROM trays WHERE trays.number = plans.number), 0)')" 0
is 'their doors' "$(sqlite3 "$scratch/columns.sqlite" "SELECT group_concat(CASE door WHEN 1 THEN 'door' ELSE '-' END, ' ') FROM (SELECT * FROM trays ORDER BY number, tray)")" \
    "$(sqlite3 "$scratch/columns.sqlite" 'SELECT plan FROM plans ORDER BY number' | tr '|' '\n' | awk 'NF { printf "%s%s", sep, $2; sep = " " }')"
sqlite3 "$scratch/columns.sqlite" "EXPLAIN QUERY PLAN SELECT number FROM trays WHERE width = '3m'" | grep -q 'USING.*INDEX trays_width' || fail 'a question does not use the index'
"$TARTAN" enumerate "$files/sheds.plan" -l any-sheds --columns -o "$scratch/part.sqlite" --limit 2
"$TARTAN" enumerate "$files/sheds.plan" -l any-sheds --columns -o "$scratch/part.sqlite" --resume 2>"$scratch/said"
is 'the trays of a database that was gone on with' "$(sqlite3 "$scratch/part.sqlite" 'SELECT * FROM trays' | sum)" "$(sqlite3 "$scratch/columns.sqlite" 'SELECT * FROM trays' | sum)"
golden columns_resumed_without "tartan enumerate sheds.plan -l any-sheds -o $scratch/part.sqlite --resume"
printf 'schema s { number = 1m | 2m  Tray = a | b  tray = c | d }\nlibrary l using s { trays 1 }\n' >"$scratch/names.plan"
exits 0 "$TARTAN" enumerate "$scratch/names.plan" --columns -o "$scratch/names.sqlite"
is 'columns of taken names' "$(sqlite3 "$scratch/names.sqlite" "SELECT group_concat(name, ' ') FROM pragma_table_info('trays')")" 'number tray number_2 number_mm Tray_2 tray_3'
exits 0 "$TARTAN" enumerate "$scratch/names.plan" --columns --format csv -o "$scratch/names.csv"
"$TARTAN" prune "$scratch/names.plan" "$scratch/names.csv" | cmp -s - <("$TARTAN" enumerate "$scratch/names.plan") || fail 'a field called tray is read otherwise'
finish
