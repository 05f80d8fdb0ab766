#!/usr/bin/env bash
# A run that breeds fields, killed at random moments and resumed each time, ends with the same individuals, scores and results as one
# that nobody disturbed; so does one by hand. Replayed, individuals are the same text.
# Needs the parts: draw mesh store
# Slow under sanitizers.
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
fail() { echo "breed_fields_killed: $*" >&2; exit 1; }

cat >forms.study <<'END'
evolution {
  parent "klein"
  parent "heart" weight 0.4
  parent "torus"
  population 24
  generations 10
  grid 20
  mutation-rate 0.4
  nudge 4
  fitness volume target 200
  fitness cut target 0
  seed 11
}
END
contents() {
    python3 - "$1" <<'PYTHON'
import sqlite3, sys
db = sqlite3.connect(sys.argv[1])
for (table,) in sorted(db.execute("select name from sqlite_master where type = 'table'")):
    sys.stdout.write("\n".join(map(repr, db.execute(f'select * from "{table}" order by 1, 2'))) + "\n")
PYTHON
}

started=$(date +%s%N)
"$TARTAN" evolve forms.study -o whole >/dev/null 2>&1 || fail 'cannot evolve'
took=$((($(date +%s%N) - started) / 1000000))
contents whole/run.sqlite >whole.txt
[ "$(wc -l <whole.txt)" -gt 240 ] || fail 'the run has too little in it'

RANDOM=${SEED:-$$}
seed=$RANDOM
RANDOM=$seed
kills=0
for run in 1 2 3; do
    rm -rf part
    resume=
    for attempt in 1 2 3 4; do
        "$TARTAN" evolve forms.study -o part $resume >/dev/null 2>&1 &
        pid=$!
        sleep "$(awk -v ms=$((RANDOM % (took / 2 + 1))) 'BEGIN { printf "%.3f", ms / 1000 }')"
        kill -KILL "$pid" 2>/dev/null && kills=$((kills + 1))
        wait "$pid" 2>/dev/null
        [ -e part/run.sqlite ] && resume=--resume
    done
    # Killed before its database was complete, a run begins anew.
    "$TARTAN" evolve forms.study -o part --resume >/dev/null 2>said.txt || {
        grep -q 'E12' said.txt || fail "SEED=$seed: cannot resume: $(cat said.txt)"
        rm -rf part
        "$TARTAN" evolve forms.study -o part >/dev/null 2>&1
    }
    contents part/run.sqlite | cmp - whole.txt || fail "SEED=$seed: run $run has other individuals or scores"
    diff -r part/best whole/best || fail "SEED=$seed: run $run has other results"
done
[ $kills -gt 0 ] || echo 'note: every run ended before it was killed'
for id in 0 30 100 200; do
    "$TARTAN" runs replay part $id >part.field && "$TARTAN" runs replay whole $id | cmp - part.field || fail "individual $id is replayed as another"
done

# ---- by hand: what was chosen before the kill is made again
sed '/fitness/d' forms.study >hand.study
printf '1 3@0.4\n2 5\n\n' | "$TARTAN" breed hand.study -o hand >/dev/null 2>&1 || fail 'cannot breed by hand'
contents hand/run.sqlite >hand.txt
mkfifo said
exec 3<>said
"$TARTAN" breed hand.study -o hand2 <said >/dev/null 2>&1 &
pid=$!
echo '1 3@0.4' >&3
for _ in $(seq 200); do
    [ -e hand2/sheet-0001.png ] && break
    sleep 0.1
done
[ -e hand2/sheet-0001.png ] || fail 'no second sheet'
kill -KILL $pid
wait $pid 2>/dev/null
printf '2 5\n\n' | "$TARTAN" breed hand.study -o hand2 --resume >/dev/null 2>&1 || fail 'cannot go on by hand'
contents hand2/run.sqlite | cmp - hand.txt || fail 'what was chosen by hand is made otherwise'
