#!/usr/bin/env bash
# Commands about measures: count --by, best, pareto, complete, --where; what they say to wrong words.
name=measures
. "$(dirname "$0")/golden.bash"

golden by 'tartan count measures.plan -l strips --by area'
golden by_number 'tartan count measures.plan -l strips --by served'
golden by_bins 'tartan count measures.plan -l strips --by cost --bins 6'
golden by_step 'tartan count measures.plan -l strips --by cost --step 500'
golden by_json 'tartan count measures.plan -l strips --by all-beds --json'
golden by_none 'tartan count measures.plan -l strips --by cost --where "trays = 2 and trays = 3"'
golden by_none_json 'tartan count measures.plan -l strips --by cost --where "trays = 2 and trays = 3" --json'
golden best 'tartan best measures.plan 4 -l strips --least cost --then-most all-beds'
golden best_json 'tartan best measures.plan 2 -l strips --most area --then-least cost -f json'
golden best_mirror 'tartan best measures.plan 3 -l strips --most all-beds --mirror'
golden best_csv 'tartan best measures.plan 2 -l strips --most all-beds -f csv'
golden best_all 'tartan best measures.plan 100 -l strips --least area --where "trays = 2 and all-beds >= 4" -f json | wc -l'
golden pareto 'tartan pareto measures.plan -l strips --least cost --most all-beds'
golden pareto_json 'tartan pareto measures.plan -l strips --least cost --most all-beds --json | head -20'
golden complete 'tartan complete measures.plan -l strips "3m room | ? | ... | store"'
golden complete_json 'tartan complete measures.plan -l strips "room | ?" --json'
golden complete_none_later 'tartan complete measures.plan -l strips "room | 3m store | ... | store | ? | room"'
golden complete_none_longer 'tartan complete measures.plan -l strips "room"'
golden complete_none 'tartan complete measures.plan -l strips "store | ?"'
golden complete_none_json 'tartan complete measures.plan -l strips "store | ?" --least area --json'
golden where 'tartan count measures.plan -l strips --where "area <= 20m2" --where "plan [room | ... | store]"'
golden prolog_sums 'tartan export measures.plan --prolog -l strips | grep "few-stores\|^.sum\|^.tally"'

golden regex_sum 'tartan export measures.plan --regex --rule few-stores'
golden explain_call 'tartan explain measures.plan --rule crowded "3m store none | 2m store none" --full'
golden diverse 'tartan sample measures.plan 4 -l strips --diverse --seed 2'
golden diverse_all 'tartan sample measures.plan 500 -l strips --length 2 --diverse | wc -l'
golden diverse_many 'tartan sample measures.plan 501 -l strips --diverse'
golden diverse_lengths 'tartan sample measures.plan -l strips --per-length 3 --diverse'
golden best_diverse 'tartan best measures.plan 3 -l strips --least cost --diverse'
golden best_diverse_json 'tartan best measures.plan 2 -l strips --most area --diverse -f json'
golden best_diverse_many 'tartan best measures.plan 501 -l strips --least cost --diverse'
golden no_measures 'tartan best rows.plan 3 --least cost; tartan count street.plan --library street --by x'
golden by_limit 'tartan count prices.plan --by cost'
golden no_measure 'tartan count measures.plan -l strips --by arae'
golden wrong_step 'tartan count measures.plan -l strips --by area --step 2m2'
golden fine_step 'tartan count measures.plan -l strips --by area --step 0.00001'
golden no_wish 'tartan best measures.plan 3 -l strips'
golden two_wishes 'tartan best measures.plan 3 -l strips --least cost --least area'
golden one_wish 'tartan pareto measures.plan -l strips --least cost'
golden wrong_number 'tartan best 3 measures.plan --least cost'
golden wrong_where 'tartan count measures.plan -l strips --where "area <= 20m"'
golden wrong_where_word 'tartan count measures.plan -l strips --where "quantity(tray(stor)) > 1"'
golden pattern_in_brackets 'tartan complete measures.plan -l strips "[room | ?]"'
golden wrong_pattern 'tartan complete measures.plan -l strips "room | 5m"'
golden half_pattern 'tartan complete measures.plan -l strips "room |"'

"$TARTAN" build "$files/measures.plan" -o "$scratch/measures.tnb"
golden module_by "tartan count $scratch/measures.tnb -l strips --by area | head -4"
golden module_where "tartan count $scratch/measures.tnb -l strips --where 'area <= 20m2'"

# The best are the first of the distribution, and each of them is kept.
"$TARTAN" best "$files/measures.plan" 1000 -l strips --least cost >"$scratch/best"
grep -v '^#' "$scratch/best" | "$TARTAN" prune "$files/measures.plan" - -l strips >"$scratch/kept" 2>/dev/null
cmp <(grep -v '^#' "$scratch/best") "$scratch/kept" || fail 'best writes plans that the library does not keep'
sed -n 's/^# \([^ ]*\) .*/\1/p' "$scratch/best" | tr -d , | sort -n -c || fail 'best is not in order'

# What is proposed where a file has no measures can be written and asked for.
sed -n 's/.*such as `\(.*\)`/\1/p' "$here/measures/no_measures.golden" | head -n 1 >"$scratch/proposed"
cat "$files/rows.plan" "$scratch/proposed" >"$scratch/measured.plan"
exits 0 "$TARTAN" best "$scratch/measured.plan" 3 --least "$(cut -d ' ' -f 2 <"$scratch/proposed")"

# Those of the best that differ, chosen here by the definition: farthest first, of equal ones the better.
"$TARTAN" best "$files/measures.plan" 1000 -l strips --least cost -f json >"$scratch/pool"
for wanted in 1 4 30; do
    "$TARTAN" best "$files/measures.plan" $wanted -l strips --least cost --diverse -f json >"$scratch/diverse"
    python3 - "$scratch/pool" "$scratch/diverse" $wanted <<'PYTHON' || fail "$wanted of the best that differ are others"
import functools, json, sys

pool = [json.loads(line) for line in open(sys.argv[1])]
fields = len(pool[0]["trays"][0])


@functools.lru_cache(None)
def trays_differ(a, b):
    return sum(x != y for x, y in zip(a, b))


def distance(p, q):
    before = [j * fields for j in range(len(q) + 1)]
    for i, a in enumerate(p, 1):
        now = [i * fields]
        for j, b in enumerate(q, 1):
            now.append(min(before[j - 1] + trays_differ(a, b), before[j] + fields, now[-1] + fields))
        before = now
    return before[-1]


plans = [[tuple(sorted((k, json.dumps(v)) for k, v in tray.items())) for tray in plan["trays"]] for plan in pool]
chosen, least = [0], [distance(p, plans[0]) for p in plans]
while len(chosen) < int(sys.argv[3]):
    chosen.append(max(range(len(plans)), key=lambda i: (least[i], -i)))
    least = [min(old, distance(p, plans[chosen[-1]])) for old, p in zip(least, plans)]
got = [json.loads(line) for line in open(sys.argv[2])]
assert got == [pool[i] for i in sorted(chosen)], (chosen, got)
PYTHON
done
finish
