#!/usr/bin/env bash
# Needs the parts: store
# shards: a library in parts, by several workers, with the bytes of one enumerate; wrong sets, wrong shards, wrong use.
# Slow under sanitizers.
name=shards
. "$(dirname "$0")/golden.bash"

sheds=$files/sheds.plan
enumerate() { "$TARTAN" enumerate "$sheds" -l any-sheds "$@"; }
# new SET OPTIONS...: a set of all plans with at most five trays.
new() {
    local set=$scratch/$1
    shift
    rm -rf "$set"
    "$TARTAN" shards new "$sheds" -l any-sheds --trays 0..5 -o "$set" "$@" 2>"$scratch/err" ||
        fail "cannot make $set: $(cat "$scratch/err")"
}
run() { "$TARTAN" shards run "$scratch/$1" "${@:2}" 2>"$scratch/err" || fail "cannot run $1: $(cat "$scratch/err")"; }
cat_is() { # SET WHAT...: its bytes are those of the plans asked for
    "$TARTAN" shards cat "$scratch/$1" | cmp - <(enumerate --trays 0..5 "${@:2}") || fail "$1 is not enumerate ${*:2}"
}

# ---- the same bytes, in each format, for any division
for format in lines json csv bin; do
    for shards in 1 3 64; do
        new set --format $format --shards $shards
        run set --threads 3
        cat_is set --format $format
        exits 0 "$TARTAN" shards check "$scratch/set"
        is "$format, $shards shards" "$(cat "$scratch/out")" "all $shards shards are there and whole: 1,365 plans"
    done
    new set --format $format --plans 100 --from 5 --to 777
    run set
    cat_is set --format $format --from 5 --to 777
    "$TARTAN" shards merge "$scratch/set" -o "$scratch/merged.sqlite" && enumerate --trays 0..5 --from 5 --to 777 -o "$scratch/one.sqlite"
    is "$format: the database" "$(sqlite3 "$scratch/merged.sqlite" .dump | md5sum)" "$(sqlite3 "$scratch/one.sqlite" .dump | md5sum)"
done
# ---- a sample: the plans of one `tartan sample`, also where more than half of all are wanted
for format in lines json csv bin; do
    for plans in 0 40 900 5000; do
        new set --format $format --sample $plans --seed 6 --shards 5
        run set --threads 3
        "$TARTAN" shards cat "$scratch/set" |
            cmp - <("$TARTAN" sample "$sheds" $plans -l any-sheds --trays 0..5 --seed 6 --format $format) ||
            fail "$format: the set is not the sample of $plans"
        exits 0 "$TARTAN" shards check "$scratch/set"
    done
done
new set --format bin --sample 300 --shards 4
run set
"$TARTAN" shards merge "$scratch/set" -o "$scratch/merged.sqlite" &&
    "$TARTAN" sample "$sheds" 300 -l any-sheds --trays 0..5 -o "$scratch/one.sqlite"
is "the database of a sample" "$(sqlite3 "$scratch/merged.sqlite" .dump | md5sum)" "$(sqlite3 "$scratch/one.sqlite" .dump | md5sum)"
new set --sample 300 --shards 4
run set
sed -i 1d "$scratch/set/shards/000/000001.plans"
rm "$scratch/set/shards/000/000001.plans.record"
exits 1 "$TARTAN" shards check "$scratch/set"
"$TARTAN" sample "$sheds" 300 -l any-sheds --trays 0..5 --seed 6 --shards 4 -o "$scratch/drawn" 2>"$scratch/err" || fail "sample --shards: $(cat "$scratch/err")"
run drawn
"$TARTAN" shards cat "$scratch/drawn" | cmp - <("$TARTAN" sample "$sheds" 300 -l any-sheds --trays 0..5 --seed 6) || fail "the set of sample --shards is not the sample"
golden sample_shards_nowhere 'tartan sample sheds.plan 9 -l any-sheds --shards 2'
golden sample_shards_length 'tartan sample sheds.plan 9 -l any-sheds --shards 2 --length 3 -o $scratch/other'
golden sample_shards_columns 'tartan sample sheds.plan 9 -l any-sheds --shards 2 --format csv --columns -o $scratch/other'
golden sample_shards_database 'tartan sample sheds.plan 9 -l any-sheds --shards 2 --format sqlite -o $scratch/other'
golden sample_shards_houses 'tartan sample huts.plan 9 -l huts --shards 2 -o $scratch/other'
golden sample_from 'tartan shards new sheds.plan -l any-sheds -o $scratch/other --sample 9 --from 3 --shards 2'
golden sample_each 'tartan shards new sheds.plan -l any-sheds -o $scratch/other --sample 9 --plans 2'
golden sample_seed 'tartan shards new sheds.plan -l any-sheds -o $scratch/other --seed 9 --shards 2'
golden sample_match 'tartan shards new sheds.plan -o $scratch/other --task match --input a.plans --sample 9 --shards 2'

# ---- compressed: the same bytes again, and files that match and prune read
for format in lines json csv bin; do
    new set --format $format --shards 5 --compress
    run set --threads 2
    exits 0 "$TARTAN" shards check "$scratch/set"
    cat_is set --format $format
    for shard in "$scratch"/set/shards/000/*.zst; do "$TARTAN" prune "$sheds" "$shard" -l any-sheds --trays 0..5; done |
        cmp - <(enumerate --trays 0..5) || fail "compressed $format does not read back"
    "$TARTAN" prune "$sheds" -l any-sheds --trays 0..5 <"$(echo "$scratch"/set/shards/000/000004.*.zst)" | cmp - <(enumerate --trays 0..5 --from 1092) || fail "compressed $format from a pipe"
done
golden compress_other "tartan shards new sheds.plan -l sheds --shards 2 --compress gzip -o $scratch/never"
new set --format bin --shards 2 --compress --from 100
run set
packed=$scratch/set/shards/000/000000.bin.zst
head -c 40 "$packed" >"$scratch/cut.zst"
golden compressed_cut "tartan prune sheds.plan -l any-sheds $scratch/cut.zst"
{ head -c 200 "$packed" && printf 'not what was there before' && tail -c +226 "$packed"; } >"$scratch/changed.zst"
exits 1 "$TARTAN" prune "$sheds" -l any-sheds --trays 0..5 "$scratch/changed.zst"
grep -q 'E0604' "$scratch/err" || fail "a changed compressed file: $(cat "$scratch/err")"
{ cat "$packed" && printf '\x28\xb5\x2f\xfd'; } >"$scratch/more.zst"
exits 1 "$TARTAN" prune "$sheds" -l any-sheds --trays 0..5 "$scratch/more.zst"
rm "$packed.record" && head -c 100 "$packed" >"$scratch/cut.zst" && mv "$scratch/cut.zst" "$packed"
golden compressed_shard_cut "tartan shards check $scratch/set; tartan shards run $scratch/set; tartan shards check $scratch/set"

# ---- edges
new set --shards 4000 # more than there are plans
is 'as many shards as plans' "$(grep -c '"name"' "$scratch/set/manifest.json")" 1365
is 'a thousand in a folder' "$(ls "$scratch/set/shards" | xargs)" '000 001'
run set --threads 2
cat_is set
new set --shards 8 --from 2000
run set
is 'a set without plans' "$("$TARTAN" shards cat "$scratch/set" | wc -c)" 0

# ---- ranks of any size, and requirements of the command line
"$TARTAN" shards new "$sheds" -l any-sheds --trays 60 --from 1000000000000000000000000000000 --to 1000000000000000000000000000500 \
    --shards 3 -o "$scratch/far" --format csv 2>/dev/null
run far
"$TARTAN" shards cat "$scratch/far" |
    cmp - <(enumerate --trays 60 --from 1000000000000000000000000000000 --to 1000000000000000000000000000500 --format csv) || fail 'ranks of 31 digits'
"$TARTAN" build "$sheds" -o "$scratch/sheds.tnb"
"$TARTAN" shards new "$scratch/sheds.tnb" -l sheds --shards 2 -o "$scratch/module" 2>/dev/null
run module
"$TARTAN" shards cat "$scratch/module" | cmp - <("$TARTAN" enumerate "$sheds" -l sheds) || fail 'a set of a module'

# ---- several workers, parts, single shards
new set --shards 60
for part in 1 2 3 4; do "$TARTAN" shards run "$scratch/set" --part $part/4 2>>"$scratch/said" & done
wait
is 'four parts' "$(grep -c '15 shards written' "$scratch/said")" 4
cat_is set
new set --shards 80 --format bin
for worker in 1 2 3 4; do "$TARTAN" shards run "$scratch/set" --threads 2 2>"$scratch/said.$worker" & done
wait
is 'each shard is written once' "$(sed -nE 's/^note: ([0-9]+) shards? written.*/\1/p' "$scratch"/said.? | awk '{ sum += $1 } END { print sum }')" 80
cat_is set --format bin
new set --shards 3
run set --shard 1
is 'one shard' "$(find "$scratch/set/shards" -name '*.plans')" "$scratch/set/shards/000/000001.plans"
golden status "tartan shards status $scratch/set"
golden incomplete "tartan shards cat $scratch/set"
golden incomplete_check "tartan shards check $scratch/set"
golden merge_incomplete "tartan shards merge $scratch/set -o $scratch/x.sqlite; ls $scratch/x.sqlite 2>&1 | sed 's/.*: No/No/'"
golden run "tartan shards run $scratch/set && tartan shards run $scratch/set"

# ---- claims: one of a worker that is gone is taken over at once, another when it is stale
claim="$scratch/set/shards/000/000002.plans.claim"
drop() { rm -f "$scratch/set/shards/000/000002.plans"*; }
drop
sleep 0 & gone=$!
wait $gone
printf '{"host": "h", "boot": "%s", "space": "%s", "process": %s, "since": "s"}' "$(cat /proc/sys/kernel/random/boot_id)" \
    "$(readlink /proc/self/ns/pid)" $gone >"$claim"
exits 0 timeout 60 "$TARTAN" shards run "$scratch/set"
[ ! -e "$claim" ] || fail 'the claim of a process that is gone stays'
for when in '-1 hour' '+1 hour'; do # of a machine with another clock
    drop
    echo '{"host": "elsewhere", "boot": "b", "space": "s", "process": 17, "since": "2026-01-01T00:00:00Z"}' >"$claim"
    touch -d "$when" "$claim"
    exits 0 timeout 60 "$TARTAN" shards run "$scratch/set"
    cat_is set
done
drop
echo '{"host": "else\u001bwhere", "boot": "b", "space": "s", "process": 17, "since": "2026-01-01T00:00:00Z"}' >"$claim"
golden part_done "tartan shards run $scratch/set --shard 1; tartan shards run $scratch/set --part 2/3"
golden claimed "tartan shards status $scratch/set | sed 's/touched [0-9]* s/touched N s/'"
exits 0 "$TARTAN" shards run "$scratch/set" --for 0.2 # does not wait for the other longer than that
grep -q '1 to go: time is up' "$scratch/err" || fail "--for: $(cat "$scratch/err")"
exits 0 timeout 60 "$TARTAN" shards run "$scratch/set" --stale 0.3s # garbled or not touched: taken over
cat_is set
drop
printf 'no claim' >"$claim"
golden unsaid "tartan shards status $scratch/set | sed 's/touched [0-9]* s/touched N s/'"
exits 0 timeout 60 "$TARTAN" shards run "$scratch/set" --stale 0.3s
cat_is set
drop
: >"$claim" # its worker was killed while it made it
touch -d '-9 seconds' "$claim"
exits 0 timeout 60 "$TARTAN" shards run "$scratch/set"
cat_is set

# ---- shards without records are written again
rm "$scratch/set"/shards/000/*.record
golden no_records "tartan shards cat $scratch/set"
run set
grep -q '3 shards written' "$scratch/err" || fail "records: $(cat "$scratch/err")"
cat_is set

# ---- a full disk: said with the shard, and nothing half is there
new set --shards 4
code=0 && (ulimit -f 1 && exec "$TARTAN" shards run "$scratch/set" 2>"$scratch/err") || code=$?
is 'a limit of sizes' "$code" 3
is 'said once' "$(grep -c 'error' "$scratch/err")" 1
grep -q 'shards/000/000000.plans' "$scratch/err" || fail "a limit of sizes: $(cat "$scratch/err")"
is 'nothing is half there' "$(find "$scratch/set/shards" -type f | wc -l)" 0
mv "$scratch/set/shards/000" "$scratch/set/shards/away"
golden folder_gone "tartan shards run $scratch/set --threads 1"

# ---- interrupted: what is done stays, and it goes on
"$TARTAN" shards new lahave-houses -o "$scratch/long" --plans 2000000 --format bin --to 40000000 2>/dev/null
cat >"$scratch/signalled.py" <<'PYTHON'
import glob, os, signal, subprocess, sys, time
number, code = getattr(signal, sys.argv[4]), int(sys.argv[5])
signal.signal(signal.SIGINT, signal.SIG_DFL)
with open(sys.argv[3], "w") as said:
    run = subprocess.Popen([sys.argv[1], "shards", "run", sys.argv[2], "--threads", "1"], stderr=said)
    while run.poll() is None and not glob.glob(sys.argv[2] + "/shards/000/*.claim"):
        time.sleep(0.01)
    run.send_signal(number)
    sys.exit(run.wait() != code)
PYTHON
signalled() { # SET SIGNAL CODE: a worker is sent the signal while it writes, and ends with that code
    python3 "$scratch/signalled.py" "$TARTAN" "$scratch/$1" "$scratch/said" "$2" "$3" || fail "$2: $(cat "$scratch/said")"
}
signalled long SIGINT 130
grep -q 'interrupted; .* to go' "$scratch/said" || fail "an interrupt says: $(cat "$scratch/said")"
is 'an interrupt leaves nothing behind' "$(find "$scratch/long/shards" -name '*.claim' -o -name '.*' | wc -l)" 0

# ---- SIGUSR1: the shard that was begun is finished, and no other is begun
"$TARTAN" shards new lahave-houses -o "$scratch/asked" --plans 2000000 --format bin --to 40000000 2>/dev/null
signalled asked SIGUSR1 0
grep -qE '^note: 1 shard written, 19 to go: a signal asked for the end' "$scratch/said" || fail "SIGUSR1 says: $(cat "$scratch/said")"
is 'SIGUSR1 leaves whole shards' "$(find "$scratch/asked/shards" -type f | sort | xargs -n1 basename | xargs)" '000000.bin 000000.bin.record'

# ---- wrong sets
new right --shards 3
run right
wrong() { rm -rf "$scratch/wrong" && cp -r "$scratch/right" "$scratch/wrong"; }
manifest=$scratch/wrong/manifest.json
seal() { # as a manifest that was made so
    sed -i '/^  "hash": /,$d' "$manifest"
    printf '  "hash": "%s"\n}\n' "$(xxhsum -H128 <"$manifest" | cut -d' ' -f1)" >>"$manifest"
}
changed() { # NAME SED: a manifest that was changed and sealed again
    wrong
    sed -i "$2" "$manifest"
    seal
    golden "$1" "tartan shards run $scratch/wrong"
}
wrong && seal
exits 0 "$TARTAN" shards run "$scratch/wrong"
wrong && sed -i 's/"to": "455"/"to": "456"/' "$manifest"
golden edited "tartan shards run $scratch/wrong"
changed overlapping '/000001/s/"from": "455"/"from": "450"/'
changed gap '/000001/s/"from": "455"/"from": "460"/'
changed backwards '/000002/s/"to": "1365"/"to": "3"/'
changed beyond '/000002/s/"to": "1365"/"to": "9999"/'
changed no_rank '/000002/s/"to": "1365"/"to": "-3"/'
changed outside 's|shards/000/000001|../../000001|'
changed another_version 's/"tartan_shards": 1/"tartan_shards": 2/'
changed older 's/"version": "[^"]*"/"version": "0.0.1"/'
changed another_library 's/"library_hash": "./"library_hash": "z/'
changed other_library 's/"library_hash": ".\{8\}/"library_hash": "00000000/'
changed no_library '/"library":/d'
changed bad_format 's/"format": "lines"/"format": "sqlite"/'
changed bad_compression 's/"format": "lines",/&\n  "compress": "lzma",/'
changed bad_trays 's/"trays": .*/"trays": [0, -1],/'
changed no_manifest '1,5d;s/^/{/'
wrong && echo >>"$scratch/wrong/rules.tnb"
golden changed_module "tartan shards run $scratch/wrong"
wrong && "$TARTAN" build lahave -o "$scratch/wrong/rules.tnb"
golden another_module "tartan shards cat $scratch/wrong"
wrong && rm "$scratch/wrong/rules.tnb"
golden module_gone "tartan shards check $scratch/wrong"
golden no_set "tartan shards status $scratch/nothing"
python3 - "$manifest" <<'PYTHON'
import sys
head = open(sys.argv[1]).read().split('  "shards"')[0]
with open(sys.argv[1], "w") as out:
    out.write(head + '  "shards": [\n')
    out.write(",\n".join('{"name": "x", "from": "0", "to": "0"}' for i in range(100001)) + "\n],\n")
PYTHON
printf '  "hash": "%s"\n}\n' "$(xxhsum -H128 <"$manifest" | cut -d' ' -f1)" >>"$manifest"
golden too_many_read "tartan shards status $scratch/wrong"

# ---- wrong shards
shard=$scratch/wrong/shards/000/000001.plans
wrong && truncate -s 100 "$shard"
golden cut_short "tartan shards check $scratch/wrong; tartan shards cat $scratch/wrong -o $scratch/x.plans; ls $scratch/x.plans 2>&1 | sed 's/.*: No/No/'"
wrong && rm "$shard.record" && truncate -s 7000 "$shard"
golden cut_without_record "tartan shards check $scratch/wrong; tartan shards run $scratch/wrong; tartan shards check $scratch/wrong"
wrong && sed -i '3s/.*/odd/' "$shard"
golden changed_shard "tartan shards check $scratch/wrong"
wrong && rm "$shard.record" && sed -i '3s/.*/odd/' "$shard"
golden not_a_plan "tartan shards check $scratch/wrong"
wrong && cp "$scratch/wrong/shards/000/000000.plans" "$shard" && rm "$shard.record"
golden other_plans "tartan shards check $scratch/wrong"
wrong && echo '{' >"$shard.record"
golden bad_record "tartan shards check $scratch/wrong"
wrong && touch "$scratch/wrong/shards/000/000003.plans" && rm "$shard"
golden stranger "tartan shards check $scratch/wrong"

# ---- wrong use
golden there "tartan shards new sheds.plan -l sheds --shards 2 -o $scratch/right"
golden too_many "tartan shards new sheds.plan -l any-sheds --trays 30 --shards 1000000000 -o $scratch/x"
golden too_many_for_few "tartan shards new sheds.plan -l any-sheds --trays 1 --shards 1000000000 -o $scratch/x"
golden too_small "tartan shards new sheds.plan -l any-sheds --trays 30 --plans 3 -o $scratch/x"
golden no_size "tartan shards new sheds.plan -l sheds -o $scratch/x"
golden two_sizes "tartan shards new sheds.plan -l sheds -o $scratch/x --plans 3 --shards 2"
golden no_folder 'tartan shards new sheds.plan -l sheds --shards 2'
golden database "tartan shards new sheds.plan -l sheds --shards 2 --format sqlite -o $scratch/x"
golden backwards_ranks "tartan shards new sheds.plan -l sheds --shards 2 --from 5 --to 3 -o $scratch/x"
golden houses "tartan shards new cabins.plan -l cottages --shards 2 -o $scratch/x"
golden not_there "tartan shards new none.plan --shards 2 -o $scratch/x"
golden unwritable "tartan shards new sheds.plan -l sheds --shards 2 -o $scratch/none/x"
golden unknown "tartan shards chek $scratch/right"
golden what "tartan shards $scratch/right run"
golden foreign "tartan shards check $scratch/right --plans 3"
golden several "tartan shards run $scratch/right $scratch/right"
golden unnamed "tartan shards run; tartan shards new"
golden no_shard "tartan shards run $scratch/right --shard 3"
golden both "tartan shards run $scratch/right --shard 1 --part 1/2"
golden part "tartan shards run $scratch/right --part 0/4"
golden time "tartan shards run $scratch/right --for 5x"
golden stale_time "tartan shards run $scratch/right --stale soon"
golden merge_nowhere "tartan shards merge $scratch/right"
golden merge_picture "tartan shards merge $scratch/right -o x.svg"
finish
