#!/usr/bin/env bash
# diff: what an edit removes, adds and keeps.
name=diff
. "$(dirname "$0")/golden.bash"

golden text 'tartan diff sheds.plan sheds-edited.plan --library sheds --seed 4'
golden back 'tartan diff sheds-edited.plan sheds.plan --library sheds --sample 0'
golden json 'tartan diff sheds.plan sheds-edited.plan --library sheds --json --sample 1'
golden same 'tartan diff sheds.plan sheds.plan --library sheds --sample 0'
golden other_library 'tartan diff sheds.plan rows.plan --library sheds'
sed '/^library any-sheds/,$d' "$files/sheds.plan" >"$scratch/alone.plan"
golden other_schema "tartan diff $scratch/alone.plan rows.plan"
golden picture_extension 'tartan diff sheds.plan sheds-edited.plan -l sheds -o sheet.gif'
golden one_file 'tartan diff sheds.plan'
sed 's/^  trays 2..4/  trays 2..3/' "$files/measures.plan" >"$scratch/shorter.plan"
golden measures "tartan diff measures.plan $scratch/shorter.plan -l strips --sample 0"
golden measures_json "tartan diff measures.plan $scratch/shorter.plan -l strips --sample 0 --json | sed -n '/\"measures\"/,/^  ]/p'"
sed 's/cafe) 7/cafe) 9/; /weight busy/d; s/prune tray(hall, 3m)/weight tray(hall) 2/' "$files/market.plan" >"$scratch/market.plan"
golden weights "tartan diff market.plan $scratch/market.plan -l lively --sample 0"
golden weights_json "tartan diff market.plan $scratch/market.plan -l lively --sample 0 --json | sed -n '/\"weights\"/,/^  ]/p'"
sed 's/6m/7m/g' "$files/sheds.plan" >"$scratch/wider.plan"
golden other_value "tartan diff sheds.plan $scratch/wider.plan -l sheds"
sed '/^test/,$d; 0,/^}/s//  forbid tray(3m, door)\n}/' "$files/sheds.plan" >"$scratch/fewer.plan"
golden other_forbid "tartan diff sheds.plan $scratch/fewer.plan -l sheds"

# The counts are those of the plans themselves.
"$TARTAN" enumerate "$files/sheds.plan" -l sheds | sort >"$scratch/old"
"$TARTAN" enumerate "$files/sheds-edited.plan" -l sheds |
    python3 -c 'import sys
for line in sys.stdin:
    trays = [tray.split() for tray in line.split("|")]
    print(" | ".join({"3000mm": "3m", "600cm": "6m"}[width] + " " + door for door, width in trays))' | sort >"$scratch/new"
"$TARTAN" diff "$files/sheds.plan" "$files/sheds-edited.plan" -l sheds --json >"$scratch/json"
counts=$(python3 -c 'import json, sys; t = json.load(open(sys.argv[1]))["total"]; print(t["removed"], t["added"], t["kept"])' "$scratch/json")
is counts "$counts" "$(comm -23 "$scratch/old" "$scratch/new" | wc -l) $(comm -13 "$scratch/old" "$scratch/new" | wc -l) $(comm -12 "$scratch/old" "$scratch/new" | wc -l)"

# A picture; and the same bytes at any number of threads.
"$TARTAN" diff "$files/sheds.plan" "$files/sheds-edited.plan" -l sheds -o "$scratch/sheet.svg" >/dev/null
grep -q '<svg' "$scratch/sheet.svg" || fail 'no picture'
for threads in 1 3; do
    "$TARTAN" diff --threads "$threads" "$files/sheds.plan" "$files/sheds-edited.plan" -l sheds >"$scratch/$threads"
done
cmp -s "$scratch/1" "$scratch/3" || fail 'threads change the plans shown'
finish
