#!/usr/bin/env bash
# Needs the parts: draw mesh store
# tartan_ask of the C interface answers what commands write with --json, byte by byte, whatever was asked of the session before; where the command
# refuses, it does, with the same sentence.
name=ask_interface
. "$(dirname "$0")/golden.bash"
program=$(dirname "$TARTAN")/tests/ask_interface
source=$(cd "$here/../.." && pwd)
cd "$source"

requests=()
json=(--json)
: >"$scratch/wanted"
# as REQUEST WORDS...: the request asks for what the words of the command do.
as() {
    requests+=("$1")
    shift
    "$TARTAN" "${command[@]}" "$file" "$@" "${json[@]}" >"$scratch/one" 2>"$scratch/said" ||
        sed -nE '0,/^(.*: )?error(\[E[0-9]+\])?: /s/^(.*: )?error(\[E[0-9]+\])?: (.*)$/error \3/p' "$scratch/said" | head -n 1 >"$scratch/one"
    cat "$scratch/one" >>"$scratch/wanted"
}
# as_rows REQUEST WORDS...: the same of a question that is answered with a list: the command writes a line of JSON for each of it.
as_rows() {
    requests+=("$1")
    shift
    local json=(--format json)
    [ "$question" != vary ] || json=(--json)
    "$TARTAN" "${command[@]}" "$file" "$@" "${json[@]}" >"$scratch/one" 2>"$scratch/said" ||
        sed -nE '0,/^(.*: )?error(\[E[0-9]+\])?: /s/^(.*: )?error(\[E[0-9]+\])?: (.*)$/error \3/p' "$scratch/said" | head -n 1 >"$scratch/one"
    cat "$scratch/one" >>"$scratch/wanted"
    rows=row_by_row
}
row_by_row() {
    python3 -c 'import json, sys
for line in sys.stdin:
    answer = json.loads(line) if line.startswith("{") else None
    for row in next(answer[key] for key in ("plans", "houses", "buildings") if key in answer) if answer else [line[:-1]]:
        print(json.dumps(row, ensure_ascii=False, separators=(",", ":")) if answer else row)'
}
rows=cat
# asked: all requests since the last one, of one session.
asked() {
    "$program" stdlib "$file" "$question" "${requests[@]}" | "$rows" >"$scratch/got"
    rows=cat
    diff "$scratch/wanted" "$scratch/got" || fail "$file: the command and the interface differ"
    requests=()
    : >"$scratch/wanted"
}

question=count command=(count)
file=stdlib/lahave-houses.plan
as '{}'
as '{"mirror": true, "no_effects": true, "trays": {"from": 4, "to": 5}}' --mirror --no-effects --trays 4..5
as '{"by": "cost", "trays": {"from": 4, "to": 5}, "values": true}' --by cost --trays 4..5
as '{"by": "cost", "trays": {"from": 4, "to": 5}, "bins": 7}' --by cost --trays 4..5 --bins 7
as '{"by": "cost", "trays": {"from": 4, "to": 5}, "step": "5000"}' --by cost --trays 4..5 --step 5000
as '{"by": "cost", "step": "-1"}' --by cost --step -1
as '{"by": "costs"}' --by costs
as '{"where": ["trays = 4"], "no_effects": true}' --where 'trays = 4' --no-effects
as '{"where": ["trays = 4", "not tray(public)"], "no_effects": true}' --where 'trays = 4' --where 'not tray(public)' --no-effects
as '{"where": ["trays = 4"], "no_effects": true, "mirror": true}' --where 'trays = 4' --no-effects --mirror
as '{"library": "hauses"}' --library hauses
as '{"parts": 2}' --parts 2
as '{"max_states": 3}' --max-states 3
as '{"threads": 3}' --threads 3
asked

file=tests/cli/files/cabins.plan
as '{"library": "cottages"}' --library cottages
as '{"library": "cottages", "clauses": true, "plan": "#10"}' --library cottages --clauses --plan '#10'
as '{"library": "cottages", "plan": "#10", "by": "floor-area", "values": true}' --library cottages --plan '#10' --by floor-area
as '{"library": "cottages", "plan": "#1000000"}' --library cottages --plan '#1000000'
as '{"library": "cottages", "where": ["houses-by-the-sea"]}' --library cottages --where houses-by-the-sea
as '{"plan": "#10", "library": "cottage"}' --plan '#10' --library cottage
asked

file=stdlib/bricks.kit
as '{"parts": 2}' --parts 2
as '{"parts": 2, "fixed": true, "part": ["3001", "3004"]}' --parts 2 --fixed --part 3001 --part 3004
as '{"parts": 2, "part": ["3099999"]}' --parts 2 --part 3099999
as '{}'
as '{"parts": 2, "by": "cost"}' --parts 2 --by cost
asked

question=explain command=(explain)
file=stdlib/terrace.plan
plan=$("$TARTAN" unrank "$file" 1000)
as '{"plan": "#1000"}' '#1000'
as "{\"plan\": \"$plan\", \"where\": [\"trays = 1\"]}" "$plan" --where 'trays = 1'
as "{\"plan\": \"$plan\", \"rules\": [\"step\", \"unhanded\"]}" "$plan" --rule step --rule unhanded
as "{\"plan\": \"${plan#* | }\", \"nearest\": 7}" "${plan#* | }" --nearest 7
as "{\"plan\": \"${plan#* | }\"}" "${plan#* | }"
as "{\"plan\": \"${plan#* | }\", \"max_states\": 3}" "${plan#* | }" --max-states 3
as '{"plan": "#99999999999999999"}' '#99999999999999999'
as '{"plan": "#1000", "rules": ["unhanded"]}' '#1000' --rule unhanded
as '{"plan": "4m one | no"}' '4m one | no'
as '{"plan": "#1000", "max_states": 3}' '#1000' --max-states 3
asked

file=tests/cli/files/cabins.plan
as '{"house": "#10:3"}' '#10:3'
as '{"house": "#500", "library": "cottages"}' '#500' --library cottages
as '{"house": "#500", "library": "cottages", "where": ["trays = 3"]}' '#500' --library cottages --where 'trays = 3'
as '{"plan": "#10:"}' '#10:'
as '{"plan": "#10", "library": "cottage-rows"}' '#10' --library cottage-rows
as '{"house": "a; b"}' 'a; b'
asked

question=rank command=(rank)
file=stdlib/terrace.plan
as "{\"plan\": \"$plan\"}" "$plan"
as "{\"plan\": \"$plan\", \"where\": [\"trays = 1\"]}" "$plan" --where 'trays = 1'
as "{\"plan\": \"${plan#* | }\"}" "${plan#* | }"
as '{"plan": "4m one | no"}' '4m one | no'
as '{"plan": "[6m end | 4m | 4m | 6m end right]"}' '[6m end | 4m | 4m | 6m end right]'
as '{"plan": "6m end | ... | end"}' '6m end | ... | end'
as "{\"plan\": \"$plan\", \"of_all\": true}" "$plan" --of-all
as "{\"plan\": \"$plan\", \"max_states\": 3}" "$plan" --max-states 3
asked
file=tests/cli/files/apart.plan
apart=$("$TARTAN" unrank "$file" 1000000000)
as "{\"plan\": \"$apart\", \"max_states\": 5000}" "$apart" --max-states 5000
as "{\"plan\": \"$apart\", \"max_states\": 5000, \"ways\": true}" "$apart" --max-states 5000 --ways
as "{\"plan\": \"${apart#* | }\", \"max_states\": 5000}" "${apart#* | }" --max-states 5000
as "{\"plan\": \"$apart\", \"max_states\": 300}" "$apart" --max-states 300
asked
file=tests/cli/files/cabins.plan
house=$("$TARTAN" unrank "$file" '#10:77')
as "{\"house\": \"$house\"}" "$house"
as "{\"house\": \"$house\", \"of_all\": true}" "$house" --of-all
as "{\"house\": \"$house\", \"library\": \"cottage\"}" "$house" --library cottage
as '{"house": "a; b"}' 'a; b'
asked

question=unrank command=(unrank)
as '{"rank": "#10:77"}' '#10:77'
as '{"rank": "77", "library": "cottages"}' 77 --library cottages
as '{"rank": "7"}' 7
as '{"rank": "99999999999"}' 99999999999
as '{"rank": "#99999999999:1"}' '#99999999999:1'
as '{"rank": "1", "trays": {"from": 2, "to": 2}}' 1 --trays 2..2
as '{"rank": "one"}' one
asked

question=relations command=(check --relations)
file=stdlib/terrace.plan
as '{}'
as '{"examples": true, "threads": 2}' --examples --threads 2
asked
file=tests/cli/files/cabins.plan
as '{"max_states": 40, "examples": true}' --max-states 40 --examples
asked
file=stdlib/bricks.kit
as '{}'
asked

question=sample command=(sample)
file=stdlib/terrace.plan
as_rows '{"count": 5}' 5
as_rows '{"count": 5, "seed": 7, "trays": {"from": 2, "to": 4}}' 5 --seed 7 --trays 2..4
as_rows '{"per_length": 2, "seed": 1}' --per-length 2 --seed 1
as_rows '{"count": 3, "length": 2, "diverse": true}' 3 --length 2 --diverse
as_rows '{"count": 3, "where": ["trays = 2"]}' 3 --where 'trays = 2'
as_rows '{"per_length": 2, "length": 2}' --per-length 2 --length 2
as_rows '{"count": 2000, "diverse": true}' 2000 --diverse
asked
file=tests/cli/files/cabins.plan
as_rows '{"count": 3, "library": "cottages"}' 3 --library cottages
as_rows '{"count": 3, "plan": "#10", "seed": 5}' 3 --plan '#10' --seed 5
as_rows '{"count": 3, "plan": "#1000000"}' 3 --plan '#1000000'
as_rows '{"count": 3, "library": "cottages", "diverse": true}' 3 --library cottages --diverse
as_rows '{"count": 2, "library": "cottage-rows"}' 2 --library cottage-rows
asked

question=enumerate command=(enumerate)
file=stdlib/terrace.plan
as_rows '{"limit": 5}' --limit 5
as_rows '{"from": "1000", "to": "1004"}' --from 1000 --to 1004
as_rows '{"from": "1004", "to": "1000"}' --from 1004 --to 1000
as_rows '{"from": "99999999999999999999"}' --from 99999999999999999999
as_rows '{"mirror": true, "limit": 4, "where": ["trays = 3"]}' --mirror --limit 4 --where 'trays = 3'
asked
file=tests/cli/files/cabins.plan
as_rows '{"library": "cottages", "limit": 3}' --library cottages --limit 3
as_rows '{"library": "cottages", "from": "1000000", "to": "1000002"}' --library cottages --from 1000000 --to 1000002
as_rows '{"plan": "#10", "from": "5", "limit": 2}' --plan '#10' --from 5 --limit 2
as_rows '{"plan": "#10", "mirror": true}' --plan '#10' --mirror
asked

question=best command=(best)
file=stdlib/lahave-houses.plan
as_rows '{"by": [{"measure": "cost"}], "trays": {"from": 4, "to": 4}}' --least cost --trays 4..4
as_rows '{"by": [{"measure": "cost", "most": true}, {"measure": "area"}], "count": 4, "mirror": true, "trays": {"from": 4, "to": 4}}' 4 --most cost --then-least area --mirror --trays 4..4
as_rows '{"by": [{"measure": "costs"}]}' --least costs
asked
file=tests/cli/files/cabins.plan
as_rows '{"by": [{"measure": "floor-area", "most": true}], "count": 2, "library": "cottages"}' 2 --most floor-area --library cottages
as_rows '{"by": [{"measure": "floor-area"}, {"measure": "bedrooms"}], "count": 2, "plan": "#3"}' 2 --least floor-area --then-least bedrooms --plan '#3'
as_rows '{"by": [{"measure": "floor-area"}], "plan": "#1000000"}' --least floor-area --plan '#1000000'
asked

question=pareto command=(pareto)
file=stdlib/lahave-houses.plan
as '{"by": [{"measure": "cost"}, {"measure": "area", "most": true}], "trays": {"from": 4, "to": 4}}' --least cost --most area --trays 4..4
as '{"by": [{"measure": "cost"}], "trays": {"from": 4, "to": 5}}' --least cost --trays 4..5
as '{"by": [{"measure": "cost"}, {"measure": "are"}]}' --least cost --least are
asked
# Past the limit plans are searched.
file=stdlib/terrace.plan
as '{"by": [{"measure": "homes", "most": true}, {"measure": "floor-area"}], "trays": {"from": 1, "to": 2}, "max_states": 3}' --most homes --least floor-area --trays 1..2 --max-states 3
as '{"by": [{"measure": "homes"}, {"measure": "frontage"}], "trays": {"from": 2, "to": 3}, "max_states": 3, "max_conflicts": 1}' --least homes --least frontage --trays 2..3 --max-states 3 --max-conflicts 1
asked
file=tests/cli/files/cabins.plan
as '{"by": [{"measure": "floor-area"}, {"measure": "bedrooms", "most": true}], "plan": "#3"}' --least floor-area --most bedrooms --plan '#3'
asked

question=complete command=(complete)
file=stdlib/terrace.plan
as '{"pattern": "? | ... | ?"}' '? | ... | ?'
as '{"pattern": "... | end"}' '... | end'
as '{"pattern": "? | nothing"}' '? | nothing'
as '{"pattern": "[end | end]"}' '[end | end]'
as '{"pattern": "? | ...", "where": ["trays = 2"]}' '? | ...' --where 'trays = 2'
as '{"pattern": "? | ...", "trays": {"from": 1, "to": 2}}' '? | ...' --trays 1..2
as '{"pattern": "end | ... | end", "max_states": 3}' 'end | ... | end' --max-states 3
as '{"pattern": "mid | ... | mid", "max_states": 3}' 'mid | ... | mid' --max-states 3
asked
file=stdlib/lahave-houses.plan
as '{"pattern": "? | great | ... | ?", "trays": {"from": 4, "to": 4}, "by": [{"measure": "cost"}]}' '? | great | ... | ?' --trays 4..4 --least cost
as '{"pattern": "? | great | ... | ?", "trays": {"from": 4, "to": 4}, "by": [{"measure": "cost", "most": true}]}' '? | great | ... | ?' --trays 4..4 --most cost
asked
file=tests/cli/files/cabins.plan
as '{"pattern": "... | ?", "library": "cottages"}' '... | ?' --library cottages
asked

# The file before the edit is the first operand of the command.
question=diff
files=tests/cli/files
command=(diff "$files/sheds.plan") file=$files/sheds-edited.plan
as "{\"before\": \"$files/sheds.plan\", \"library\": \"sheds\"}" --library sheds
as "{\"before\": \"$files/sheds.plan\", \"library\": \"sheds\", \"sample\": 1, \"seed\": 4, \"no_measures\": true}" --library sheds --sample 1 --seed 4 --no-measures
as "{\"before\": \"$files/sheds.plan\", \"library\": \"sheds\", \"where\": [\"trays = 2\"]}" --library sheds --where 'trays = 2'
as "{\"before\": \"$files/sheds.plan\", \"library\": \"shed\"}" --library shed
as "{\"before\": \"$files/sheds.plan\", \"library\": \"sheds\", \"max_states\": 1, \"sample\": 5}" --library sheds --max-states 1 --sample 5
asked
command=(diff "$files/rows.plan")
as "{\"before\": \"$files/rows.plan\", \"library\": \"sheds\"}" --library sheds
asked
command=(diff "$files/none.plan")
as "{\"before\": \"$files/none.plan\"}"
asked
command=(diff tests/cli/files/cabins.plan) file=tests/cli/files/cabins.plan library=cottages
as "{\"before\": \"$file\", \"library\": \"$library\"}" --library "$library"
as "{\"before\": \"$file\", \"library\": \"$library\", \"max_houses\": 1, \"sample\": 0}" --library "$library" --max-houses 1 --sample 0
asked

question=test command=(test)
file=stdlib/terrace.plan
as '{}'
as '{"coverage": true}' --coverage
as '{"coverage": true, "library": "streets"}' --coverage --library streets
as '{"max_states": 3}' --max-states 3
asked
file=stdlib/table.solid
as '{}'
as '{"max_boxes": 2}' --max-boxes 2
asked
file=stdlib/bricks.kit
as '{}'
asked
file=stdlib/koch.hemls
as '{}'
asked
is 'coverage' "$("$program" stdlib stdlib/terrace.plan coverage '{}')" \
    "$("$TARTAN" test stdlib/terrace.plan --coverage --json | sed -E 's/^.*"coverage":\[(.*)\]\}$/\1/')"
is 'no coverage' "$("$program" stdlib stdlib/bricks.kit coverage '{}')" 'error only a .plan file has tests whose coverage is measured'

# What place prints besides its files is in its answer.
member() { # NAME...: the member of an answer by that path; a text as it is, others as JSON
    python3 -c 'import functools, json, sys
found = functools.reduce(lambda value, key: value[key], sys.argv[1:], json.load(sys.stdin))
print(found.rstrip() if isinstance(found, str) else json.dumps(found, separators=(",", ":")))' "$@"
}
placed() { # FILE REQUEST MEMBER WORDS...
    is "place $1 $3" "$("$program" stdlib "$1" place "$2" | member $3)" "$("$TARTAN" place "$1" "${@:4}" 2>/dev/null)"
}
gatehouse=examples/gatehouse/gatehouse.kit
placed tests/cli/files/stack.pcfg '{"seed": 4}' figures --seed 4 --stats json
placed tests/cli/files/stack.pcfg '{"program": true}' 'program text' --program -
placed tests/cli/files/stack.pcfg '{"trace": true, "seed": 4}' 'trace text' --seed 4 --trace
placed $gatehouse '{"program": true, "seed": 2}' 'program text' --seed 2 --program -
placed $gatehouse '{"trace": true, "part_limit": 9, "keep_partial": true}' figures --part-limit 9 --keep-partial -o "$scratch/nine.ldr" --stats json
is 'how it ended' "$("$program" stdlib $gatehouse place '{"part_limit": 9, "keep_partial": true}' | member ended)" partial
is 'whole' "$("$program" stdlib $gatehouse place '{}' | member ended)" whole
"$program" stdlib $gatehouse place '{}' | python3 -c 'import csv, json, sys
answer = json.load(sys.stdin)["parts"]
listed = list(csv.DictReader(open(sys.argv[1], encoding="utf-8")))
same = [{**row, "colour": int(row["colour"]), "number": int(row["number"]), "mass": float(row["mass"]), "price": float(row["price"])} for row in listed]
near = all(abs(a["mass"] - b["mass"]) + abs(a["price"] - b["price"]) < 1e-6 for a, b in zip(answer, same))
print("same" if near and [{**a, "mass": 0, "price": 0} for a in answer] == [{**b, "mass": 0, "price": 0} for b in same] else (answer, same))' \
    <("$TARTAN" place $gatehouse -o "$scratch/list.csv"; cat "$scratch/list.csv") >"$scratch/same"
is 'the list of parts' "$(cat "$scratch/same")" same
is 'another format' "$("$program" stdlib $gatehouse place '{"formats": ["scad"]}')" 'error there is no `scad` of this'

# A model that was drawn: the command opens its file, and the session that of the kit.
drawn=examples/drawn-gate/gate.ldr
text_of() { python3 -c 'import json, sys; print(json.dumps(open(sys.argv[1], encoding="utf-8").read()))' "$1"; }
printf '0 FILE a.ldr\n1 4 0 0 0 1 0 0 0 1 0 0 0 1 3001.dat\n1 4 3 -12 0 1 0 0 0 1 0 0 0 1 b.ldr\n0 FILE b.ldr\n1 2 0 0 0 1 0 0 0 0 1 0 -1 0 3002.dat\n1 7 0 -240 0 1 0 0 0 1 0 0 0 1 none.dat\n' >"$scratch/bad.mpd"
question=inspect command=(inspect)
inspected() { # MODEL REQUEST WORDS...
    is "inspect $1 $2" "$("$program" stdlib "$file" inspect "{\"path\": \"$1\"$2}" | sed -E 's/,"meets":(true|false)\}$/}/')" \
        "$("$TARTAN" inspect "$1" --kit "$file" --json "${@:3}" 2>"$scratch/said" || [ ! -s "$scratch/said" ] || true)$(first_error)"
}
first_error() { grep -qE '^(.*: )?error' "$scratch/said" && ! grep -q E1316 "$scratch/said" && sed -nE '0,/^(.*: )?error(\[E[0-9]+\])?: /s/^(.*: )?error(\[E[0-9]+\])?: (.*)$/error \3/p' "$scratch/said" | head -n 1; }
for file in stdlib/bricks.kit $gatehouse; do
    for model in $drawn "$scratch/bad.mpd"; do
        inspected "$model" ''
        inspected "$model" ', "require": "components = 1, floating = 0"' --require 'components = 1, floating = 0'
        inspected "$model" ', "require": "components ="' --require 'components ='
        inspected "$model" ', "require": "count(nothing) = 1"' --require 'count(nothing) = 1'
        inspected "$model" ', "model": "gatehouse"' --model gatehouse
    done
    inspected "$scratch/no.ldr" ''
    is 'by its text' "$("$program" stdlib $file inspect "{\"ldraw\": $(text_of "$scratch/bad.mpd")}")" "$("$TARTAN" inspect "$scratch/bad.mpd" --kit $file --json 2>/dev/null)"
done
is 'meets' "$("$program" stdlib $gatehouse inspect "{\"ldraw\": $(text_of "$scratch/bad.mpd"), \"require\": \"elements = 2\"}" | member meets)" false
is 'no model' "$("$program" stdlib $gatehouse inspect '{}')" 'error say which model is inspected: its text, or the name of its file'
is 'no kit' "$("$program" stdlib stdlib/terrace.plan inspect '{"path": "a.ldr"}')" 'error stdlib/terrace.plan is no kit'
is 'no parts' "$("$program" stdlib $gatehouse inspect '{"ldraw": "0 nothing\n"}')" 'error the drawn model has no parts'
is 'no picture' "$("$program" stdlib $gatehouse inspect '{"ldraw": "0 nothing\n", "formats": ["ldr"]}')" 'error there is no `ldr` of this'
for ending in svg png pdf; do
    "$TARTAN" inspect "$scratch/bad.mpd" --kit $gatehouse -o "$scratch/drawn.$ending" >/dev/null 2>&1
    "$program" stdlib $gatehouse inspect "{\"path\": \"$scratch/bad.mpd\", \"formats\": [\"$ending\"]}" |
        python3 -c 'import base64, json, sys
file = json.load(sys.stdin)["files"][0]
sys.stdout.buffer.write(file["text"].encode() if "text" in file else base64.b64decode(file["base64"]))' | cmp - "$scratch/drawn.$ending" || fail "inspect draws another .$ending"
done

exported() { # WHAT FILE REQUEST WORDS...: of the answer the file, or what is wrong
    is "export $1" "$("$program" stdlib "$2" export "$3" | python3 -c 'import json, sys
said = sys.stdin.read().rstrip()
print(said if said.startswith("error") else json.loads(said)["files"][0]["text"].rstrip())')" "$("$TARTAN" export "${@:4}" 2>"$scratch/said")$(first_error)"
}
exported 'a drawn grammar' stdlib/bricks.kit "{\"as\": \"pcfg\", \"ldraw\": $(text_of $drawn)}" $drawn --pcfg
exported 'a drawn grammar, of any file' stdlib/terrace.plan "{\"as\": \"pcfg\", \"path\": \"$drawn\", \"init\": \"Wall\"}" $drawn --pcfg --init Wall
exported 'sub-files' stdlib/terrace.plan "{\"as\": \"pcfg\", \"path\": \"$scratch/bad.mpd\"}" "$scratch/bad.mpd" --pcfg
exported 'a drawn kit' stdlib/bricks.kit "{\"as\": \"kit\", \"ldraw\": $(text_of $drawn)}" $drawn --kit stdlib/bricks.kit
exported 'a drawn kit of another' $gatehouse "{\"as\": \"kit\", \"path\": \"$drawn\"}" $drawn --kit $gatehouse
exported 'no kit' stdlib/terrace.plan "{\"as\": \"kit\", \"path\": \"$drawn\"}" $drawn --kit stdlib/terrace.plan
exported 'a drawn program' stdlib/terrace.plan "{\"path\": \"$drawn\"}" $drawn --prolog
exported 'lines' stdlib/terrace.plan "{\"as\": \"pcfg\", \"path\": \"$drawn\", \"init\": \"a\\nb\"}" $drawn --pcfg --init $'a\nb'
exported 'no drawing' stdlib/terrace.plan "{\"as\": \"kit\"}" stdlib/terrace.plan --kit bricks
is 'needless' "$("$program" stdlib stdlib/terrace.plan export '{"max_length": 4}')" 'error --max-length says nothing about what is exported'

question=enumerate command=(enumerate)
file=stdlib/bricks.kit
as_rows '{"parts": 2, "part": ["3001"]}' --parts 2 --part 3001
as_rows '{"parts": 2, "part": ["3001"], "fixed": true, "from": "3", "to": "9"}' --parts 2 --part 3001 --fixed --from 3 --to 9
as_rows '{"parts": 3, "part": ["3003", "3005"], "limit": 4}' --parts 3 --part 3003 --part 3005 --limit 4
as_rows '{"parts": 2, "from": "9", "to": "3"}' --parts 2 --from 9 --to 3
as_rows '{"parts": 2, "mirror": true}' --parts 2 --mirror
as_rows '{"parts": 2, "part": ["300"]}' --parts 2 --part 300
as_rows '{"parts": 2, "inside": "room"}' --parts 2 --inside room
as_rows '{}'
asked
file=$gatehouse
as_rows '{"parts": 2, "part": ["3001"], "inside": "gatehouse", "limit": 9}' --parts 2 --part 3001 --inside gatehouse --limit 9
as_rows '{"parts": 2, "inside": "gatehouse", "fixed": true}' --parts 2 --inside gatehouse --fixed
asked
file=stdlib/terrace.plan
as_rows '{"parts": 2}' --parts 2
as_rows '{"inside": "room"}' --inside room
asked
next() { "$program" stdlib stdlib/bricks.kit enumerate "$1" | python3 -c 'import json, sys
answer = json.load(sys.stdin)
print(len(answer["buildings"]), answer.get("next"))'; }
is 'more buildings' "$(next '{"parts": 3, "part": ["3001"]}')" '1000 1000'
is 'all that were asked for' "$(next '{"parts": 2, "part": ["3001"], "to": "7"}')" '7 None'
is 'all buildings' "$(next '{"parts": 2, "part": ["3001"], "from": "20"}')" '4 None'
is 'no more buildings' "$(next '{"parts": 2, "part": ["3001"], "limit": 24}')" '24 None'

question=match command=(match)
file=stdlib/terrace.plan
short=${plan#* | }
printf '%s\n' "$plan" "$short" >"$scratch/plans"
as_rows "{\"plans\": [\"$plan\", \"$short\"]}" "$scratch/plans"
as_rows "{\"plans\": [\"$plan\", \"$short\"], \"rules\": [\"closed\", \"step\"], \"max_states\": 3}" "$scratch/plans" --rule closed --rule step --max-states 3
as_rows "{\"plans\": [\"$plan\"], \"rules\": [\"close\"]}" "$scratch/plans" --rule close
as_rows "{\"plans\": [\"$plan\"], \"max_length\": 2}" "$scratch/plans" --max-length 2
asked
question=prune command=(prune)
as_rows "{\"plans\": [\"$plan\", \"$short\"]}" "$scratch/plans" --dropped -
as_rows "{\"plans\": [\"$plan\", \"$short\"], \"where\": [\"trays = 4\"], \"trays\": {\"from\": 4, \"to\": 4}}" "$scratch/plans" --dropped - --where 'trays = 4' --trays 4..4
as_rows "{\"plans\": [\"$plan\"], \"library\": \"streets\"}" "$scratch/plans" --library streets
asked
question=match command=(match)
file=tests/cli/files/cabins.plan
printf '%s\n' "$house" >"$scratch/houses"
as_rows "{\"plans\": [\"$house\"]}" "$scratch/houses"
as_rows "{\"plans\": [\"$house\"], \"rules\": [\"dark-living\", \"narrow\"]}" "$scratch/houses" --rule dark-living --rule narrow
as_rows "{\"plans\": [\"$house\"], \"rules\": [\"dark-livin\"]}" "$scratch/houses" --rule dark-livin
asked

question=schema command=(schema)
for file in stdlib/terrace.plan tests/cli/files/cabins.plan stdlib/row-houses.plan stdlib/koch.hemls; do
    as '{}'
    as '{"used": true}' --used
    asked
done

question=vary command=(vary)
file=tests/cli/files/cabins.plan
as_rows '{"house": "#10:77"}' '#10:77'
as_rows '{"house": "#10:77", "at": "1.body.ground"}' '#10:77' --at 1.body.ground
as_rows '{"house": "#10:77", "at": "1.body.grund"}' '#10:77' --at 1.body.grund
as_rows "{\"house\": \"$house\"}" "$house"
as_rows '{"house": "a; b"}' 'a; b'
asked

# What is made goes into files (tests/ask_files.py); what is measured is JSON.
question=mesh command=(mesh) json=(--stats json)
file=stdlib/table.solid
as '{}'
as '{"cells": true}' --cells
as '{"decimate": 50, "smooth": 1}' --decimate 50 --smooth 1
as '{"sharp": true}' --sharp
as '{"solid": "tabel"}' --solid tabel
asked
file=tests/cli/files/ball.field
as '{"grid": 12}' --grid 12
as '{"grid": 12, "sharp": true, "bounds": true, "thickness": true}' --grid 12 --sharp --bounds --thickness
as '{"grid": 12, "open": true, "jumps": "open", "engine": "vm"}' --grid 12 --open --jumps open --engine vm
as '{"grid": 12, "exact": true}' --grid 12 --exact
as '{"open": true, "thickness": true}' --open --thickness
asked
for file in stdlib/terrace.plan stdlib/koch.hemls; do
    as '{}'
    asked
done
# What the command writes for each line of a file is a list of the answer.
printf '0 0 0\n3 0 0.5\n-1 2 7\n' >"$scratch/places"
"$program" stdlib tests/cli/files/ball.field mesh '{"points": [[0, 0, 0], [3, 0, 0.5], [-1, 2, 7]]}' | python3 -c 'import json, sys
for point in json.load(sys.stdin)["points"]:
    print(*("%.17g" % number for number in [point["value"], *point["gradient"]]), "inside" if point["inside"] else "outside")' >"$scratch/got"
"$TARTAN" mesh tests/cli/files/ball.field --points "$scratch/places" | diff - "$scratch/got" || fail 'points are valued otherwise'
question=explain command=(explain) json=(--json)
file=stdlib/table.solid
as '{}'
as '{"solid": "table"}' --solid table
as '{"solid": "tble"}' --solid tble
as '{"max_boxes": 2}' --max-boxes 2
as '{"library": "table"}' --library table
as '{"nearest": 2}' --nearest 2
asked
file=stdlib/terrace.plan
as "{\"plan\": \"$plan\", \"solid\": \"table\"}" "$plan" --solid table
as "{\"plan\": \"$plan\", \"max_boxes\": 2}" "$plan" --max-boxes 2
asked
json=(--stats json)

question=grow command=(grow)
for file in stdlib/square.hemls stdlib/koch.hemls examples/growing-surfaces/draped.study; do
    as '{}'
    as '{"steps": 2}' -n 2
    as '{"steps": 3, "scale": "1.5", "mirror": true, "seed": "18446744073709551615", "fitness": ["size target 10"]}' -n 3 --scale 1.5 --mirror --seed 18446744073709551615 \
        --fitness 'size target 10'
    as '{"steps": 5, "until_faces": 20}' -n 5 --until faces=20
    as '{"start_length": "-1"}' --start-length -1
    as '{"seed": "2.5"}' --seed 2.5
    as '{"statements": ["scale 0"]}' --scale 0
    as '{"edge_limit": "20", "steps": 4}' --edge-limit 20 -n 4
    as '{"sheet": true}' --sheet
    as '{"steps": 1}' -n 1
    asked
done
file=stdlib/terrace.plan
as '{}'
as '{"steps": 2}' -n 2
asked
is 'why branches did not join' "$("$program" stdlib stdlib/square.hemls grow '{"steps": 1, "explain": true}' | python3 -c 'import json, sys
joins = json.load(sys.stdin)["joins"]
for step in joins:
    print("step %(step)d: %(replaced)d edges replaced, %(joined)d pairs of branches joined" % step)
    for some in step["unjoined"]:
        print("  %(branches)d branches %(reason)s" % some)')" "$("$TARTAN" grow stdlib/square.hemls -n 1 --explain 2>&1 >/dev/null)"
json=(--json)

# What only requests can get wrong.
wrong() { # REQUEST MESSAGE
    is "$1" "$("$program" stdlib stdlib/terrace.plan count "$1")" "error $2"
}
wrong '{"libary": "street"}' 'a count_request has no `libary`'
wrong '{"library": 3}' "\`library\` is a text: the library's name; needed if the file has more than one"
wrong '{"parts": 33}' '`parts` is from 1 to 32, not 33'
wrong '{"mirror": "yes"}' '`mirror` is true or false: of plans: also one of each pair of plans that mirror each other'
wrong '{"where": "trays = 4"}' '`where` is a list of texts: only plans, or houses, that meet these requirements too, in the words of the file'
wrong '{"trays": {"from": 4}}' 'a tray_range needs `to`: the most trays'
wrong '{"trays": 4}' '`trays` is an object: how many trays a plan has, instead of what the library says'
wrong '{"bins": -3}' '`bins` is a whole number from 0: with `by`: at most so many bins'
wrong '{"picture": "svg"}' 'only how plans are spread over a measure is drawn'
wrong '{"picture": "gif"}' '`picture` cannot be `gif`'
wrong '[]' 'the request is no JSON object: it is another value'
is 'no rank' "$("$program" stdlib stdlib/terrace.plan unrank '{}')" 'error an unrank_request needs `rank`: a whole number from 0; of houses also the name of one, such as #10:3'
is 'no plan' "$("$program" stdlib stdlib/terrace.plan rank '{}')" "error say whose number is asked for: a plan's or a house's"
wrong_to_explain() { # REQUEST MESSAGE
    is "$1" "$("$program" stdlib tests/cli/files/cabins.plan explain "$1")" "error $2"
}
wrong_to_explain '{}' 'say which plan or which house is explained: one of them'
wrong_to_explain '{"plan": "#1", "house": "#1:1"}' 'say which plan or which house is explained: one of them'
wrong_to_explain '{"plan": "#1", "trays": {"from": 1, "to": 2}}' '--trays is for all plans of a library, and one is explained'
wrong_to_explain '{"house": "#1:1", "nearest": 2}' '--nearest is about plans that a library of plans drops'
wrong_to_mesh() { # REQUEST MESSAGE
    is "$1" "$("$program" stdlib stdlib/table.solid mesh "$1")" "error $2"
}
wrong_to_mesh '{"points": [[0, 0]]}' '`points` is a list of lists: of a field: places that it is evaluated at, instead of being meshed'
wrong_to_mesh '{"points": [[0, 0, "1"]]}' '`points` is a list of lists: of a field: places that it is evaluated at, instead of being meshed'
wrong_to_mesh '{"points": [[0, 0, 0]]}' '--points does nothing for a design of boxes'
wrong_to_mesh '{"format": "svg"}' '`format` cannot be `svg`'
wrong_to_grow() { # REQUEST MESSAGE
    is "$1" "$("$program" stdlib stdlib/square.hemls grow "$1")" "error $2"
}
wrong_to_grow '{"steps": 100001}' '`steps` is from 0 to 100000, not 100001'
wrong_to_grow '{"overlay": [1, -1]}' '`overlay` is a list of whole numbers from 0: draw these over one another, in one picture; 32 at most'
wrong_to_grow '{"format": "svg", "overlay": [200000]}' '--overlay takes up to 32 steps'
wrong_to_grow '{"format": "svg", "turn": 3}' '--turn writes PNG pictures, and svg is none'
wrong_to_grow '{"format": "png", "moving": true}' 'what moves is a turn'
is 'another question' "$("$program" stdlib stdlib/terrace.plan cuont '{}')" 'error there is no question `cuont`'
finish
