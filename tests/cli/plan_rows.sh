#!/usr/bin/env bash
# Rows of plans: trays that stand for plans of a library, listed, ranked and drawn with the plan of each tray.
name=plan_rows
. "$(dirname "$0")/golden.bash"

golden unrank 'tartan unrank street.plan 0 --library street --plans; tartan unrank street.plan 5824810943 --library street --plans'
golden unrank_json 'tartan unrank street.plan 123456789 --library street --plans --json'
golden rank 'tartan rank street.plan --library street --plans "$(tartan unrank street.plan 123456789 --library street --plans)"'
golden lines 'tartan enumerate street.plan --library street --plans --from 1000 --limit 3'
golden csv 'tartan enumerate street.plan --library street --plans --from 1000 --to 1003 -f csv'
golden json 'tartan sample street.plan 2 --library street --plans --seed 3 -f json'
golden sample 'tartan sample street.plan --per-length 2 --library street --plans'
golden few 'tartan sample street.plan 100 --library street --plans --where "neighbour(beginning, tray(6m, corner, sunny), tray(15m, corner), tray(6m, corner, sunny), end)" --length 3 | tail -n 2'
golden past 'tartan unrank street.plan 5824810944 --library street --plans; tartan enumerate street.plan --library street --plans --from 9999999999'
row='6m corner sunny [3m shop | 3m home]'
golden wrong_rows "for r in '6m corner sunny' '$row | ' '$row 7m' '6m corner sunny [3m shop' '7m corner sunny [3m shop | 3m home]' '6m corner sunny [3m yard | 3m yard]' '6m corner [3m shop | 3m home]' '$row | 6m corner sunny [3m shop | 9m home]' '$row | $row | $row' '$row | $row | $row | $row | $row'; do tartan rank street.plan --library street --plans \"\$r\"; done"
golden refused 'tartan unrank street.plan 0 --library houses --plans; for o in --ways --diverse "--shards 2 -o x"; do tartan sample street.plan 2 --library street --plans $o; done; tartan enumerate street.plan --library street --plans --mirror; tartan enumerate street.plan --library street --plans -o x.bin; tartan rank street.plan --library street --plans --ways "'"$row"'"'
golden of_houses 'tartan unrank cottage 0 --library cottages --plans; tartan sample cottage 1 --library cottages --plans; tartan enumerate bricks --parts 2 --plans'
golden weighted 'tartan sample weighed-street.plan 2 --plans --library street; tartan sample weighed-street.plan 2 --plans --uniform --library street'

# A module has all that it takes.
"$TARTAN" build "$files/street.plan" -o "$scratch/street.tnb"
is 'by the module' "$("$TARTAN" enumerate "$scratch/street.tnb" --library street --plans --limit 50)" \
    "$("$TARTAN" enumerate "$files/street.plan" --library street --plans --limit 50)"
# Databases hold rows of plans, and are gone on with.
"$TARTAN" enumerate "$files/street.plan" --library street --plans --limit 20 -o "$scratch/rows.sqlite"
"$TARTAN" enumerate "$files/street.plan" --library street --plans --limit 30 -o "$scratch/rows.sqlite" --resume 2>"$scratch/notes"
is 'a database' "$(python3 -c 'import sqlite3, sys; print("\n".join(r[0] for r in sqlite3.connect(sys.argv[1]).execute("select row from rows")))' "$scratch/rows.sqlite")" \
    "$("$TARTAN" enumerate "$files/street.plan" --library street --plans --limit 30)"

finish
