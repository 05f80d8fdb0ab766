#!/usr/bin/env bash
# What is said, and what is not: folders that may not be written, files that are no rule files, pictures of the same run.
# Needs the parts: store
name=words
. "$(dirname "$0")/golden.bash"

# A folder that is there and may not be written is not called missing. (Whoever may do everything becomes somebody else.)
mkdir "$scratch/ro"
chmod 755 "$scratch"
chmod 555 "$scratch/ro"
cp "$files/sheds.plan" "$scratch"
as_somebody() {
    python3 -c 'import os, sys
if os.getuid() == 0:
    os.setuid(65534)
os.execv(sys.argv[1], sys.argv[1:])' "$@"
}
for output in x.sqlite x.txt; do
    exits 3 as_somebody "$TARTAN" enumerate "$scratch/sheds.plan" -l sheds -n 5 -o "$scratch/ro/$output"
    grep -q 'no right to write there' "$scratch/err" || fail "$output: $(head -n 1 "$scratch/err")"
done
exits 3 as_somebody "$TARTAN" enumerate "$scratch/sheds.plan" -l sheds -n 5 -o "$scratch/none/x.sqlite"
grep -q 'its folder is not there' "$scratch/err" || fail "a missing folder: $(head -n 1 "$scratch/err")"

# Nothing of a file that is no rule file is quoted.
printf 'secret:x:0:0\n' >"$scratch/passwd"
for used in "$scratch/passwd" ./passwd ../"$(basename "$scratch")"/passwd; do
    for notation in plan bnf; do
        printf 'use "%s"\n' "$used" >"$scratch/uses.$notation"
        exits 1 "$TARTAN" check "$scratch/uses.$notation"
        grep -q secret "$scratch/err" && fail "a line of $used is quoted"
    done
    exits 1 "$TARTAN" check "$scratch/uses.plan"
    grep -q 'is not a rule file' "$scratch/err" || fail "$used: $(head -n 1 "$scratch/err")"
done

# Two runs alike have pictures alike, whatever their folders are called.
printf 'evolution {\n  grammar "words"\n  match "hi"\n  population 20\n  generations 3\n}\n' >"$scratch/hi.study"
for run in one another; do "$TARTAN" evolve "$scratch/hi.study" -o "$scratch/$run" >/dev/null; done
cmp -s "$scratch/one/fitness.svg" "$scratch/another/fitness.svg" || fail 'the name of the folder is in fitness.svg'
finish
