#!/usr/bin/env bash
# Two versions of a library of houses: what is removed, added and kept is what the lists of all houses say.
# Slow under sanitizers.
name=house_diff
. "$(dirname "$0")/golden.bash"
stdlib=$(cd "$here/../../stdlib" && pwd)
cd "$scratch"

# The cottages that `huts` are, with their form in the same file.
{
    cat "$files/cabins.plan"
    sed -n '/^library hut-rows/,$p' "$files/huts.plan"
} >old.plan
sed 's/^  prune touch(cell(kitchen), cell(bedroom) by open)/&\n  prune room(bedroom, not by window) as dark-bed\n  prune cell(bedroom, 10'"'"') as small/' old.plan >more.plan
sed '/^  prune touch(cell(kitchen), cell(bedroom) by open)/d' old.plan >fewer.plan
sed 's/touch(cell(kitchen), cell(bedroom) by open)/room(bedroom, not by window)/' old.plan >other.plan
sed '/^  tile bed/,/^  }/s/against wall or window/against wall/; s/outside = window | wall$/outside = window | wall | door/' old.plan >form.plan
sed 's/^library hut-rows using cottage { trays 1..2 }/library hut-rows using cottage { trays 1..2  prune tray(10'"'"') }/' old.plan >plans.plan
sed 's/^library hut-rows using cottage { trays 1..2 }/library hut-rows using cottage { trays 1..2  prune tray(10'"'"', porch none) }/' more.plan >both.plan

list() { "$TARTAN" enumerate "$1" -l huts >"$1.list"; }
for version in old more fewer other form plans both; do
    list "$version.plan"
done
check() {
    "$TARTAN" diff "$1.plan" "$2.plan" -l huts --json --sample 4 --seed 3 >diff.json
    python3 - "$1.plan.list" "$2.plan.list" diff.json <<'PY' || fail "$1 to $2"
import json, sys
old, new = ({line.rstrip('\n') for line in open(path)} for path in sys.argv[1:3])
found = json.load(open(sys.argv[3]))
wanted = {'removed': old - new, 'added': new - old, 'kept': old & new}
for what, houses in wanted.items():
    assert int(found['total'][what]) == len(houses), (what, found['total'][what], len(houses))
    assert sum(int(row[what]) for row in found['by_length']) == len(houses), what
for clause in found['clauses']:
    for way, said in (('removed', 'removes'), ('added', 'adds')):
        assert set(clause['houses'][way]) <= wanted[way], clause
        assert len(set(clause['houses'][way])) == len(clause['houses'][way])
        assert (int(clause[said]) > 0) == bool(clause['houses'][way]), clause
        assert int(clause[said]) <= len(wanted[way]), clause
for way, said in (('removed', 'removes'), ('added', 'adds')):
    assert sum(int(clause[said]) for clause in found['clauses']) >= len(wanted[way]), way
PY
}
for pair in 'old more' 'more old' 'old fewer' 'old other' 'other more' 'old form' 'form old' 'old plans' 'plans old' 'old both' 'both old' 'plans other' 'form plans'; do
    read -r first second <<<"$pair"
    check "$first" "$second"
done

golden more "tartan diff $scratch/old.plan $scratch/more.plan -l huts --sample 1 --seed 1"
golden other "tartan diff $scratch/old.plan $scratch/other.plan -l huts --sample 1"
golden form "tartan diff $scratch/old.plan $scratch/form.plan -l huts --sample 0"
golden same "tartan diff $scratch/old.plan $scratch/old.plan -l huts"
golden too_many "tartan diff $scratch/old.plan $scratch/other.plan -l huts --max-houses 1000"
golden drawn "tartan diff $scratch/old.plan $scratch/other.plan -l huts -o $scratch/diff.svg"
sed "s/length = 10' | 14'/length = 14' | 10'/" old.plan >turned.plan
list turned.plan
check old turned
check turned plans
golden no_library "tartan diff $scratch/old.plan terrace -l huts"
finish
