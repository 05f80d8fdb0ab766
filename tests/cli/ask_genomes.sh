#!/usr/bin/env bash
# Needs the parts: draw mesh store
# Questions about genomes and runs of evolution through the C interface: answers are those of the commands, and follow the schema.
name=ask_genomes
. "$(dirname "$0")/golden.bash"
program=$(dirname "$TARTAN")/tests/ask_interface
stdlib=$here/../../stdlib
cd "$scratch"

# asks QUESTION FILE REQUEST...; of QUESTION FILE REQUEST PATH: what stands there in the answer.
asks() {
    "$program" "$stdlib" "$2" "$1" "${@:3}"
}
of() {
    asks "$1" "$2" "$3" | python3 -c 'import base64, json, sys
answer = json.load(sys.stdin)
for key in sys.argv[1].split("."):
    answer = answer[int(key) if key.isdigit() else key]
sys.stdout.buffer.write(base64.b64decode(answer) if key == "base64" else answer.encode() if isinstance(answer, str) else json.dumps(answer, separators=(",", ":")).encode() + b"\n")' "$4"
}
# said WORDS...: the sentence of the command's error.
said() {
    "$TARTAN" "$@" 2>&1 >/dev/null | sed -nE '0,/^(.*: )?error(\[E[0-9]+\])?: /s/^(.*: )?error(\[E[0-9]+\])?: (.*)$/error \3/p' | head -n 1
}

# ---- map and invert
words=$stdlib/words.bnf genr8=$stdlib/genr8.bnf
genome='17 4 99 3 8 2 1 0 5 7 12 31'
long=$(seq -s ' ' 7 13 2000)
rows() {
    python3 -c 'import json, sys
for row in json.load(sys.stdin)["genomes"]:
    print(json.dumps(row, ensure_ascii=False, separators=(",", ":")))'
}
printf '%s\n' "$genome" "$long" >genomes
for grammar in "$words" "$genr8"; do
    is 'given' "$(asks map "$grammar" "{\"genomes\": [\"$genome\", \"$long\"]}" | rows)" "$("$TARTAN" map "$grammar" --genomes genomes --format json)"
    is 'random' "$(asks map "$grammar" '{"random": 5, "seed": 3, "codons": 40, "wraps": 1, "max_depth": 9, "max_steps": 500}' | rows)" \
        "$("$TARTAN" map "$grammar" --random 5 --seed 3 --codons 40 --wraps 1 --max-depth 9 --max-steps 500 --format json)"
    is 'from the fourth on' "$(asks map "$grammar" '{"random": 2, "first": 3}' | rows)" "$("$TARTAN" map "$grammar" --random 5 --format json | tail -n 2)"
    request="{\"genomes\": [\"$long\"], \"trace\": true, \"tree\":"
    is 'a tree' "$(of map "$grammar" "$request \"json\"}" genomes.0.tree)" "$("$TARTAN" map "$grammar" --genome "$long" --tree json)"
    of map "$grammar" "$request \"text\"}" genomes.0.trace >shown
    of map "$grammar" "$request \"text\"}" genomes.0.tree_text >>shown
    "$TARTAN" map "$grammar" --genome "$long" --trace --tree text | grep -v '^# genome' >wanted
    tail -n "$(wc -l <shown)" wanted | cmp - shown || fail 'a trace and a tree as texts'
    for format in svg png pdf; do
        content=base64
        [ $format != svg ] || content=text
        of map "$grammar" "{\"genomes\": [\"$long\"], \"tree\": \"$format\"}" genomes.0.picture.$content >picture
        "$TARTAN" map "$grammar" --genome "$long" --tree wanted.$format >/dev/null
        cmp picture wanted.$format || fail "a picture: $format"
    done
done
is 'in pairs' "$(asks map "$words" "{\"genomes\": [\"$long\"], \"mapping\": \"position-independent\"}" | rows)" \
    "$("$TARTAN" map "$words" --genome "$long" --mapping position-independent --format json)"
is 'no genomes' "$(asks map "$words" '{"random": 0}')" '{"genomes":[]}'
is 'nothing to map' "$(asks map "$words" '{}')" 'error say what to map: genomes, or how many random ones'
is 'both' "$(asks map "$words" '{"genomes": ["1"], "random": 1}')" 'error say what to map: genomes, or how many random ones'
is 'no codon' "$(asks map "$words" '{"genomes": ["1", "1 two"], "file": "here", "line": 7}')" "$(said map "$words" --genome '1 two')"
is 'in pairs of genr8' "$(asks map "$genr8" '{"random": 1, "mapping": "position-independent"}')" "$(said map "$genr8" --random 1 --mapping position-independent)"
is 'no grammar' "$(asks map "$stdlib/koch.hemls" '{"random": 1}' | sed 's/.*koch.hemls //')" "$(said map "$stdlib/koch.hemls" --random 1 | sed 's/.*koch.hemls //')"
is 'a word' "$(of invert "$words" '{"sentence": "hello"}' genome)" "$("$TARTAN" map "$words" --invert hello)"
is 'a word in pairs' "$(of invert "$words" '{"sentence": "hello", "mapping": "position-independent"}' genome)" \
    "$("$TARTAN" map "$words" --invert hello --mapping position-independent)"
is 'no word' "$(asks invert "$words" '{"sentence": "HELLO"}')" "$(said map "$words" --invert HELLO)"
is 'too deep' "$(asks invert "$words" '{"sentence": "hello", "max_depth": 2}')" "$(said map "$words" --invert hello --max-depth 2)"
is 'too many states' "$(asks invert "$words" '{"sentence": "hello", "max_items": 3}')" "$(said map "$words" --invert hello --max-items 3)"

# ---- runs
printf 'evolution {\n  grammar "words"\n  match "hello"\n  population 20\n  generations 4\n  seed 7\n}\n' >hello.study
"$TARTAN" evolve hello.study >/dev/null
is 'a run' "$(asks runs hello.study '{"runs": ["hello.run"]}')" "$("$TARTAN" runs show hello.run --json)"
is 'runs' "$(asks runs hello.study '{"runs": ["hello.run", "hello.run"]}')" "$("$TARTAN" runs compare hello.run hello.run --json)"
is 'no run' "$(asks runs hello.study '{"runs": ["hello"]}')" "$(said runs show hello)"
is 'an individual' "$(asks individual hello.study '{"run": "hello.run", "individual": 30}')" "$("$TARTAN" runs replay hello.run 30 --json)"
is 'no individual' "$(asks individual hello.study '{"run": "hello.run", "individual": 3000}')" "$(said runs replay hello.run 3000)"
cp -r hello.run other.run
printf 'helo\n' >helo
printf 'HELLO\n' >wrong
is 'an insertion' "$(asks change_run hello.study '{"run": "hello.run", "sentence": "helo"}' | cut -c 1-31)" '{"generation":5,"kind":"insert"'
asks change_run hello.study '{"run": "hello.run", "sentence": "hel\n", "in_place_of": 81}' '{"run": "hello.run", "remove": 82}' >answers
"$TARTAN" runs insert other.run helo 2>/dev/null
printf 'hel\n' >hel
"$TARTAN" runs insert other.run hel --in-place-of 81 2>wanted; "$TARTAN" runs remove other.run 82 2>>wanted
cmp <("$TARTAN" runs show hello.run | sed 1d) <("$TARTAN" runs show other.run | sed 1d) || fail "changes of runs differ: $(cat answers wanted)"
is 'a sentence of another grammar' "$(asks change_run hello.study '{"run": "hello.run", "sentence": "HELLO"}')" "$(said runs insert other.run wrong)"
is 'nothing to change' "$(asks change_run hello.study '{"run": "hello.run"}')" \
    'error say what is changed: a sentence that is inserted, or a member that is taken out'
is 'a change without output' "$(said runs remove hello.run 3 --json)" 'error `tartan runs remove` has no output: leave --json out'

# ---- evolve
export TARTAN_PATH=$stdlib # of what the studies name
"$TARTAN" evolve hello.study -o whole.run --json >whole.json
is 'gone on with' "$(asks evolve hello.study '{"run": "whole.run", "resume": true}')" "$("$TARTAN" evolve hello.study -o whole.run --resume --json)"
is 'goes further' "$(asks evolve hello.study '{"run": "whole.run", "resume": true, "generations": 6, "threads": 1}' >/dev/null; "$TARTAN" runs show whole.run | sed 1d)" \
    "$("$TARTAN" evolve hello.study -o at-once.run -g 6 >/dev/null; "$TARTAN" runs show at-once.run | sed 1d)"
is 'another seed' "$(of evolve hello.study '{"seed": 5, "generations": 3}' newest)" "$("$TARTAN" evolve hello.study --seed 5 -g 3 -o seed.run --json >seed.json
    python3 -c 'import json; print(json.dumps(json.load(open("seed.json"))["newest"], separators=(",", ":")))')"
is 'a run in the way' "$(asks evolve hello.study '{"run": "whole.run"}')" "$(said evolve hello.study -o whole.run)"
is 'a change of no run' "$(asks evolve hello.study '{"set": ["length-weight 1"]}')" "$(said evolve hello.study --set 'length-weight 1')"
is 'rescored without a run' "$(asks evolve hello.study '{"rescore": true}')" "$(said evolve hello.study --rescore)"
is 'resumed without a folder' "$(asks evolve hello.study '{"resume": true}')" 'error --resume goes on with the run of a folder: say which'
is 'open words' "$(asks evolve hello.study '{"open": true}')" "$(said evolve hello.study --open -o another)"
is 'no study' "$(asks evolve "$words" '{}' | sed 's/.*has no/no/')" "$(said evolve "$words" | sed 's/.*has no/no/')"
# Without a folder: the files that the command writes, with the same bytes; and a page.
printf 'rules "square"\nsteps 3\ngravity 0 0 -0.1\nfitness undulation target 3\nfitness size target 6\nedge-limit 2000\n' >tent.study
printf 'evolution {\n  grammar "genr8-dividing"\n  grow "tent.study"\n  population 16\n  generations 2\n  seed 5\n}\n' >grown.study
cp "$here/../../examples/breeding-fields/four.study" "$here/../../examples/solids/seat.study" "$here/../../examples/solids/"*.solid .
printf 'evolution {\n  parent "ball.field"\n  fitness volume target 20\n  population 6\n  generations 1\n}\n' >bred.study
cp "$here/files/ball.field" .
for study in hello grown seat bred; do
    asks evolve $study.study '{"generations": 1, "page": true}' >$study.json
    "$TARTAN" evolve $study.study -o $study.files -g 1 >/dev/null 2>&1 || fail "$study is not evolved"
    is "files of $study" "$(python3 -c 'import base64, json, os, sys
study = sys.argv[1]
answer, named = json.load(open(study + ".json")), set()
for file in answer["files"]:
    path = os.path.join(study + ".files", file["name"])
    content = file["text"].encode() if "text" in file else base64.b64decode(file["base64"])
    named.add(path)
    if file["name"] == "sheet.html":
        print("page" if content.startswith(b"<!") else content[:20])
    elif open(path, "rb").read() != content:
        print(path)
print({os.path.join(folder, name) for folder, _, names in os.walk(study + ".files") for name in names} - named)' $study)" \
        "$([ $study = hello ] || echo page; echo "{'$study.files/run.sqlite'}")"
done

# ---- breed
first='{"does": "breed", "parents": "1 2*3"}'
changes='{"does": "set", "change": "population 12"}, {"does": "out", "member": "2"}'
second="$changes, {\"does\": \"breed\", \"parents\": \"#3 4\"}"
third='{"does": "edit", "member": "3", "sentence": "hel"}, {"does": "insert", "sentence": "helo\n"}'
one_by_one() {
    asks breed $1.study '{}' "{\"actions\": [$first]}" "{\"actions\": [$first, $second]}" "{\"actions\": [$first, $second, $third]}"
}
one_by_one hello >bred.json
is 'at once' "$(asks breed hello.study "{\"actions\": [$first, $second, $third]}")" "$(tail -n 1 bred.json)"
is 'other actions' "$(asks breed hello.study "{\"actions\": [$second]}" "{\"actions\": [$first]}" | tail -n 1)" "$(sed -n 2p bred.json)"
is 'after what is refused' "$(asks breed hello.study "{\"actions\": [$first]}" "{\"actions\": [$first, {\"does\": \"breed\", \"parents\": \"#99999\"}]}" \
    "{\"actions\": [$first, {\"does\": \"breed\", \"parents\": \"3 x\"}]}" "{\"actions\": [$first, $second, $third]}")" "$(sed -n 2p bred.json)
error nobody with the id 99999 was born so far
error \`x\` is not a choice: write numbers from 1 to 20, as 3 7 12; 3*2 counts twice, 3@0.4 gives less of it (0 to 1), and #41 is the individual with that id
$(tail -n 1 bred.json)"
# The same at the prompt, and in a folder.
printf '1 2*3\nset population 12\nout 2\n#3 4\nedit 3 hel\ninsert helo\n\n' | "$TARTAN" breed hello.study -o typed.run >/dev/null || fail 'cannot be bred'
{ sed -n 1p bred.json; asks breed hello.study "{\"actions\": [$first, $changes]}"; sed -n 4p bred.json; } >sheets.json
for i in 0 1 2; do
    sed -n $((i + 1))p sheets.json | python3 -c 'import json, sys
for file in json.load(sys.stdin)["files"]:
    print(file["text"], end="")' >sheet
    cmp sheet typed.run/sheet-000$i.svg || fail "sheet $i is another"
done
asks breed hello.study '{"run": "asked.run"}' "{\"run\": \"asked.run\", \"actions\": [$first]}" "{\"run\": \"asked.run\", \"actions\": [$first, $changes]}" \
    "{\"run\": \"asked.run\", \"actions\": [$first, $second, $third]}" \
    "{\"run\": \"asked.run\", \"actions\": [$first, $second, $third], \"results\": true}" >/dev/null
diff -rq typed.run asked.run || fail 'a run in a folder is another'
is 'results' "$(of breed hello.study "{\"actions\": [$first, $second, $third], \"results\": true}" files.0.text)" "$(cat typed.run/best/1.txt)"
is 'another member' "$(asks breed hello.study '{"actions": [{"does": "out", "member": "21"}]}')" \
    'error `21` is nobody here: write a number from 1 to 20, or # and the id of one on the sheet'
is 'no sentence' "$(asks breed hello.study '{"actions": [{"does": "insert"}]}')" 'error say which sentence is inserted'
is 'no parents' "$(asks breed hello.study '{"actions": [{"does": "breed"}]}')" 'error say who has children: the numbers of parents'
is 'no more' "$(asks breed hello.study "{\"generations\": 0, \"actions\": [$first]}")" 'error all generations are bred'
printf 'evolution {\n  grammar "words"\n  match "hello"\n  population 20\n  islands 2\n}\n' >islands.study
is 'islands' "$(asks breed islands.study '{}')" "$(said breed islands.study)"
is 'a page' "$(of breed seat.study '{}' page)" 'sheet.html'

# ---- answers follow the schema
"$TARTAN" help --requests schema >schema.json
if python3 -c 'import jsonschema' 2>/dev/null; then
    asks map "$genr8" '{"random": 3, "tree": "json", "trace": true}' >map.json
    asks invert "$words" '{"sentence": "hello"}' >invert.json
    asks change_run hello.study '{"run": "hello.run", "sentence": "hello"}' >change_run.json
    cp grown.json evolve.json
    tail -n 1 bred.json >breed.json
    is 'schema' "$(python3 -c 'import json, jsonschema, sys
schema = json.load(open("schema.json"))
for question in sys.argv[1:]:
    kind = {"$defs": schema["$defs"], **schema["answers"][question]}
    for error in jsonschema.Draft202012Validator(kind).iter_errors(json.load(open(question + ".json"))):
        print(question, error.message[:300])' map invert change_run evolve breed)" ''
fi
finish
