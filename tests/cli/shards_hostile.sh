#!/usr/bin/env bash
# Needs the parts: store
# Slow under sanitizers.
# shards: folders in which something lies that is not of the set, or not as it was: what each command says of them.
name=shards_hostile
[ ! -w /dev/shm ] || export TMPDIR=/dev/shm # each shard is flushed to the disk
. "$(dirname "$0")/golden.bash"

# Two sets of plans and two of answers, with shards of the same number and sizes, about rules that differ in a word.
cd "$scratch"
cat >rows.plan <<'PLAN'
schema row { width = 3m | 4m use = shop | home }
rule q = neighbour(tray(shop), tray(shop))
library rows { trays 1..4 prune q }
PLAN
sed 's/shop)/home)/g' rows.plan >other.plan
"$TARTAN" enumerate rows.plan -o plans.lines
for rules in rows other; do
    "$TARTAN" shards new $rules.plan -l rows --shards 4 -o $rules 2>err
    "$TARTAN" shards new $rules.plan --task match --rule q --format bits -i plans.lines --shards 4 -o $rules.bits 2>err
    for set in $rules $rules.bits; do "$TARTAN" shards run $set 2>err || fail "$(cat err)"; done
done

# fresh ENDING COMMAND: a copy of a set, in whose folder of shards the command is run; $other is that of the other set
fresh() {
    ending=$1
    rm -rf "$scratch/set" && cp -r "$scratch/rows$ending" "$scratch/set"
    (cd "$scratch/set/shards/000" && other=$scratch/other$ending/shards/000 && eval "$2")
}
# hostile NAME COMMAND: what each command says of a set of plans, and of one of answers, after that.
each='for word in run check status "cat -o cat.out"; do
    echo "-- $word"
    timeout 60 "$TARTAN" shards $word set 2>&1 || echo "exit $?"
done
ls cat.out 2>&1 | sed "s/.*: No/No/"
rm -f cat.out'
merge='echo "-- merge"
timeout 60 "$TARTAN" shards merge set -o merged.sqlite 2>&1 || echo "exit $?"
ls merged.sqlite 2>&1 | sed "s/.*: No/No/"
rm -f merged.sqlite'
hostile() {
    fresh '' "$2"
    golden "$1" "cd $scratch
$each
$merge"
    fresh .bits "$2"
    golden "$1_answers" "cd $scratch
$each"
}

hostile foreign 'cp $other/000001.* .'
hostile foreign_shard 'for f in 000001.*s; do cp $other/$f .; done' # with the set's own record
hostile swapped 'for f in 000001.*; do mv $f x; mv ${f/1/2} $f; mv x ${f/1/2}; done'
hostile older "sed -i 's/.tartan_record.: 2, .set.: .[0-9a-f]*., .shard.: 1, //' *1.*.record"
hostile newer "sed -i 's/.tartan_record.: 2/\"tartan_record\": 3/' *1.*.record"
hostile nameless "sed -i 's/.set.: .[0-9a-f]*., //' *1.*.record"
hostile numberless "sed -i 's/.shard.: 1/\"shard\": \"1\"/' *1.*.record"
hostile cut 'for f in 000001.*s; do truncate -s 3 $f; done'
hostile cut_record "truncate -s 30 *1.*.record"
hostile linked 'for f in 000001.*; do ln -sf $other/$f $f; done'
hostile linked_folder 'cd .. && rm -r 000 && ln -s $other 000'
hostile another_manifest 'cp $other/../../manifest.json $other/../../rules.tnb ../..'
hostile resealed 'cd ../.. && sed -i "s/\"command\": \"/&tartan /" manifest.json && sed -i "/^  \"hash\": /,\$d" manifest.json &&
    printf "  \"hash\": \"%s\"\n}\n" "$(xxhsum -H128 <manifest.json | cut -d" " -f1)" >>manifest.json'
hostile folder_for_record 'rm *1.*.record; for f in 000001.*; do mkdir $f.record; done'

# ---- a shard without its record, whosever it is, is written again
for ending in '' .bits; do
    for done in 'cp $other/000001.* .; rm 000001.*.record' 'rm *.record' 'rm 000001.*s'; do
        fresh "$ending" "$done"
        exits 1 "$TARTAN" shards cat "$scratch/set"
        exits 0 timeout 60 "$TARTAN" shards run "$scratch/set"
        exits 0 "$TARTAN" shards check "$scratch/set"
        cmp <("$TARTAN" shards cat "$scratch/set") <("$TARTAN" shards cat "$scratch/rows$ending") || fail "without records, $done"
    done
    # what a link leads to is not written, nor waited for
    for place in 'rm 000001.*; ln -s $other/000001.*s .' 'rm 000001.*; mkfifo x; for f in $other/000001.*; do ln -s x $(basename $f); done'; do
        fresh "$ending" "rm 000001.*.record; $place; rm -f 000001.*.record"
        exits 1 timeout 60 "$TARTAN" shards run "$scratch/set"
        grep -q 'no regular file' "$scratch/err" || fail "$place: $(cat "$scratch/err")"
        exits 0 "$TARTAN" shards check "$scratch/other$ending"
    done
    # a claim that is none is taken over
    fresh "$ending" 'for f in 000001.*s; do mkfifo -m 600 $f.claim; touch -d "-9 seconds" $f.claim; rm $f; done'
    exits 0 timeout 60 "$TARTAN" shards run "$scratch/set"
    fresh "$ending" 'for f in 000001.*s; do ln -s nothing $f.claim; touch -h -d "-9 seconds" $f.claim; rm $f; done'
    exits 0 timeout 60 "$TARTAN" shards run "$scratch/set"
    fresh "$ending" 'for f in 000001.*s; do mkdir $f.claim; touch -d "-9 seconds" $f.claim; rm $f; done'
    exits 3 timeout 60 "$TARTAN" shards run "$scratch/set"
done
finish
