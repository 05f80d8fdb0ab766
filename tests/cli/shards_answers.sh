#!/usr/bin/env bash
# Slow under sanitizers.
# Needs the parts: store
# shards --task match, prune: large files in pieces, with the bytes of one command; lines of whole files; wrong inputs, wrong sets.
name=shards_answers
. "$(dirname "$0")/golden.bash"

sheds=$files/sheds.plan
plans() { "$TARTAN" enumerate "$sheds" -l any-sheds --trays 0..5 "$@"; }
# new SET TASK OPTIONS...
new() {
    local set=$scratch/$1 task=$2
    shift 2
    rm -rf "$set"
    "$TARTAN" shards new "$sheds" --task "$task" -o "$set" "$@" 2>"$scratch/err" ||
        fail "cannot make $set: $(cat "$scratch/err")"
}
run() { "$TARTAN" shards run "$scratch/$1" "${@:2}" 2>"$scratch/err" || fail "cannot run $1: $(cat "$scratch/err")"; }
one() { # TASK OPTIONS... -- FILES...: what one command after another says
    local words=()
    while [ "$1" != -- ]; do words+=("$1") && shift; done
    for file in "${@:2}"; do "$TARTAN" "${words[0]}" "$sheds" "$file" "${words[@]:1}"; done
}

# ---- the same bytes: each format of plans and of answers, several files, any number of shards
for format in lines json csv bin sqlite; do plans --format $format -o "$scratch/plans.$format"; done
plans -o "$scratch/plans.parquet" --row-group 100
zstd -q "$scratch/plans.lines" "$scratch/plans.bin" 2>/dev/null || python3 -c 'import sys; sys.exit("zstd is missing")'
{ printf '\xEF\xBB\xBF# first\r\n' && sed 's/$/\r/' "$scratch/plans.lines" && printf '# no end'; } >"$scratch/plans.odd"
: >"$scratch/empty"
for format in lines json csv bin sqlite parquet lines.zst bin.zst odd; do
    inputs=("$scratch/plans.$format" "$scratch/empty" "$scratch/plans.lines")
    new set match --input "${inputs[@]}" --shards 4 --format json
    run set --threads 2
    "$TARTAN" shards cat "$scratch/set" | cmp - <(one match --format json -- "${inputs[@]}") || fail "match of $format"
    exits 0 "$TARTAN" shards check "$scratch/set"
    new set prune --input "${inputs[@]}" --shards 4 --library sheds --trays 1..4 --where "sum(width) >= 3m"
    run set
    "$TARTAN" shards cat "$scratch/set" | cmp - <(one prune -l sheds --trays 1..4 --where "sum(width) >= 3m" -- "${inputs[@]}") || fail "prune of $format"
done
is 'Parquet is divided at row groups' "$(new set match -i "$scratch/plans.parquet" --shards 5 && grep -c '"name"' "$scratch/set/manifest.json")" 5
for format in lines json bin; do
    new set match -i "$scratch/plans.$format" --shards 100000 # more than there are plans
    is "a shard a plan of $format" "$(grep -c '"name"' "$scratch/set/manifest.json")" 1365
done
rule=$(sed -nE 's/^rule ([a-z-]+).*/\1/p' "$sheds" | tail -1)
for format in names bits any json; do
    new set match -i "$scratch/plans.lines" --shards 3 --rule "$rule" --format $format
    run set
    "$TARTAN" shards cat "$scratch/set" | cmp - <(one match --rule "$rule" --format $format -- "$scratch/plans.lines") || fail "one rule as $format"
done
new set prune -i "$scratch/plans.json" --shards 3 --library sheds --format json
run set
"$TARTAN" shards cat "$scratch/set" -o "$scratch/out.json"
cmp "$scratch/out.json" <(one prune -l sheds --format json -- "$scratch/plans.json") || fail 'prune as JSON'

# ---- several workers, and a set that stands in another folder than its worker
new set match -i "$scratch/plans.lines" --shards 12 --format json
for worker in 1 2 3; do "$TARTAN" shards run "$scratch/set" --threads 2 2>"$scratch/said.$worker" & done
wait
is 'each shard is written once' "$(sed -nE 's/^note: ([0-9]+) shards? written.*/\1/p' "$scratch"/said.? | awk '{ sum += $1 } END { print sum }')" 12
"$TARTAN" shards cat "$scratch/set" | cmp - <(one match --format json -- "$scratch/plans.lines") || fail 'three workers'
rm "$scratch/set"/shards/000/00000*.record # what was read for a shard is not known without: it is written again
(cd / && "$TARTAN" shards run "$scratch/set" 2>"$scratch/err") || fail 'records are not made again'
grep -q '10 shards written' "$scratch/err" || fail "records: $(cat "$scratch/err")"
golden status "tartan shards status $scratch/set"

# ---- bad plans: their lines are those of the whole file
{ head -700 "$scratch/plans.lines" && echo 'odd' && tail -n +701 "$scratch/plans.lines" && echo "ends badly"; } >"$scratch/bad.lines"
new set match -i "$scratch/bad.lines" --shards 4
golden stops "tartan shards run $scratch/set --threads 1; ls $scratch/set/shards/000"
golden stops_alone "tartan shards run $scratch/set --threads 1 --shard 3" # no shard before it is there
new set match -i "$scratch/plans.lines" "$scratch/bad.lines" --shards 8 --on-error skip --format json
golden skips "tartan shards run $scratch/set && echo; tartan shards status $scratch/set"
"$TARTAN" shards cat "$scratch/set" | cmp - <(one match --format json --on-error skip -- "$scratch/plans.lines" "$scratch/bad.lines" 2>/dev/null || true) || fail 'skipping'
rm "$scratch"/set/shards/000/00000[45]*
golden skips_missing "tartan shards status $scratch/set"
{ for i in $(seq 300); do echo "odd $i"; done; } >"$scratch/worse.lines"
new set prune -i "$scratch/worse.lines" --shards 2 -l sheds --on-error skip
golden skips_many "tartan shards run $scratch/set; tartan shards status $scratch/set | sed -n '4,6p;\$p'"

# ---- a full disk: said with the shard, and nothing half is there
new set prune -i "$scratch/plans.lines" --shards 2 --library any-sheds --trays 0..5
code=0 && (ulimit -f 1 && exec "$TARTAN" shards run "$scratch/set" 2>"$scratch/err") || code=$?
is 'a limit of sizes' "$code" 3
is 'said once' "$(grep -c 'error' "$scratch/err")" 1
is 'nothing is half there' "$(find "$scratch/set/shards" -type f | wc -l)" 0
run set
"$TARTAN" shards cat "$scratch/set" | cmp - "$scratch/plans.lines" || fail 'with room again'

# ---- wrong inputs
wrong_input() { golden "$1" "tartan shards new sheds.plan --task match --shards 3 -o $scratch/wrong --input $2; ls $scratch/wrong 2>&1 | sed 's/.*: No/No/'"; }
wrong_input missing "$scratch/plans.line"
wrong_input standard_input -
mkfifo "$scratch/pipe"
wrong_input pipe "$scratch/plans.lines $scratch/pipe"
wrong_input folder "$scratch"
head -c 100 "$TARTAN" >"$scratch/junk"
wrong_input unknown "$scratch/junk"
"$TARTAN" enumerate lahave-houses --to 10 --format bin -o "$scratch/houses.bin"
wrong_input other_schema "$scratch/houses.bin"
"$TARTAN" enumerate lahave-houses --to 10 -o "$scratch/houses.parquet"
wrong_input other_columns "$scratch/houses.parquet"
head -c 200 "$scratch/plans.bin" >"$scratch/cut.bin"
wrong_input cut_packed "$scratch/cut.bin"
printf '3m\n' >"$scratch/"$'caf\xe9'
wrong_input not_utf8 "$scratch/caf*"
wrong_input wrong_format "$scratch/plans.lines --input-format parquet"
new set match -i "$scratch/empty" --shards 3
golden empty "tartan shards run $scratch/set; tartan shards cat $scratch/set; tartan shards status $scratch/set"
cp "$scratch/plans.lines" "$scratch/changing"
new changed match -i "$scratch/changing" --shards 3
run changed --shard 0
echo >>"$scratch/changing"
golden changed "tartan shards run $scratch/changed --threads 1; tartan shards status $scratch/changed"
rm "$scratch/changing"
golden gone "tartan shards run $scratch/changed --threads 1"

# ---- wrong use
golden too_many "tartan shards new sheds.plan --task match --shards 1000000000 -o $scratch/x -i $scratch/plans.lines"
golden no_input "tartan shards new sheds.plan --task match --shards 3 -o $scratch/x"
golden no_task "tartan shards new sheds.plan -l sheds --shards 3 -o $scratch/x --input $scratch/plans.lines"
golden not_named "tartan shards new sheds.plan $scratch/plans.lines --task match --shards 3 -o $scratch/x"
golden no_size "tartan shards new sheds.plan --task match -o $scratch/x -i $scratch/plans.lines"
golden no_folder "tartan shards new sheds.plan --task match --shards 2 -i $scratch/plans.lines"
golden foreign "tartan shards new sheds.plan --task match --shards 2 -o $scratch/x -i $scratch/plans.lines --library sheds"
golden foreign_plans "tartan shards new sheds.plan --task prune -l sheds --plans 2 -o $scratch/x -i $scratch/plans.lines"
golden format "tartan shards new sheds.plan --task match --shards 2 -o $scratch/x -i $scratch/plans.lines --format bin"
golden format_pruned "tartan shards new sheds.plan --task prune -l sheds --shards 2 -o $scratch/x -i $scratch/plans.lines --format bits"
golden format_plans "tartan shards new sheds.plan -l sheds --shards 2 -o $scratch/x --format bits"
golden on_error "tartan shards new sheds.plan -l sheds --shards 2 -o $scratch/x --on-error skip"
golden no_rule "tartan shards new sheds.plan --task match --rule narow --shards 2 -o $scratch/x -i $scratch/plans.lines"
golden houses "tartan shards new cabins.plan --task match --shards 2 -o $scratch/x -i $scratch/plans.lines"
new set match -i "$scratch/plans.lines" --shards 2 --format json
run set
golden merge "tartan shards merge $scratch/set -o $scratch/x.sqlite"

# ---- wrong sets
manifest=$scratch/wrong/manifest.json
changed() { # NAME SED: a manifest that was changed and sealed again
    rm -rf "$scratch/wrong" && cp -r "$scratch/right" "$scratch/wrong"
    sed -i "$2" "$manifest"
    sed -i '/^  "hash": /,$d' "$manifest"
    printf '  "hash": "%s"\n}\n' "$(xxhsum -H128 <"$manifest" | cut -d' ' -f1)" >>"$manifest"
    golden "$1" "tartan shards run --threads 1 $scratch/wrong"
}
new right match -i "$scratch/plans.lines" "$scratch/plans.bin" "$scratch/plans.csv" --shards 6 --rule "$rule"
changed bad_task 's/"task": "match"/"task": "merge"/'
changed bad_answer 's/"answer": "names"/"answer": "lines"/'
changed bad_rules 's/"rules": .*/"rules": [3],/'
changed other_rule 's/"rules": .*/"rules": ["none"],/'
changed no_inputs 's/"inputs"/"input"/'
changed relative 's|"path": "/|"path": "|'
changed bad_size 's/"size": [0-9]*/"size": -1/'
changed bad_input_format 's/"format": "bin"/"format": "auto"/'
changed other_format 's/"format": "bin"/"format": "csv"/'
changed no_such_input '/000003/s/"input": 2/"input": 3/'
changed overlapping '/000001/s/"from": [0-9]*/"from": 3/'
changed past_the_end '/000001/s/"to": [0-9]*/"to": 99999999/'
changed left_out '/000003/s/"input": 2/"input": 1, "from": 1, "to": 2/'
changed whole_of_lines '/000000/s/, "from": .*"to": [0-9]*//'
sed -i 's/{"line"/{"lin"/' "$scratch/set/shards/000/000001.jsonl"
sed -i "s/\"bytes\": [0-9]*, \"hash\": \"[0-9a-f]*\"/\"bytes\": $(wc -c <"$scratch/set/shards/000/000001.jsonl"), \"hash\": \"$(
    xxhsum -H128 <"$scratch/set/shards/000/000001.jsonl" | cut -d' ' -f1)\"/" "$scratch/set/shards/000/000001.jsonl.record"
golden not_answers "tartan shards cat $scratch/set | tail -n 1; tartan shards cat $scratch/set -o $scratch/none.json; ls $scratch/none.json 2>&1 | sed 's/.*: No/No/'"
sed -i 's/"unread": 0/"unread": 3/' "$scratch/set/shards/000/000000.jsonl.record"
golden bad_record "tartan shards status $scratch/set; tartan shards check $scratch/set"
finish
