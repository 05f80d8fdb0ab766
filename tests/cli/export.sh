#!/usr/bin/env bash
# export: Prolog programs decide as the interpreter does, in SWI-Prolog where that is installed; patterns with their legends.
# Slow under sanitizers.
name=export
. "$(dirname "$0")/golden.bash"

golden regex 'tartan export sheds.plan --regex --rule wide-end'
golden regex_several 'tartan export parts.plan --regex --rule far-sum'
golden regex_never 'tartan export never.plan --regex --rule never'
golden regex_long 'tartan export never.plan --regex --rule long'
golden prolog 'tartan export never.plan --prolog | sed -n "/length_of/,\$p"'
golden nothing_asked 'tartan export sheds.plan'
golden two_asked 'tartan export sheds.plan --regex --prolog'
golden no_rule 'tartan export sheds.plan --regex'
golden rule_of_prolog 'tartan export sheds.plan --prolog --rule wide-end'
golden fetch_alone 'tartan export sheds.plan --regex --rule wide-end --fetch'

if ! command -v swipl >/dev/null; then
    echo 'swipl is not installed: the Prolog programs are not run'
    finish
    exit
fi

# compare FILE LIBRARY PLANS RULE...: every rule and the library on every plan of a file.
compare() {
    local file=$1 library=$2 plans=$3
    shift 3
    "$TARTAN" export "$file" --prolog --library "$library" -o "$scratch/rules.pl"
    awk -v q="'" 'function atom(t) { gsub(q, q q, t); return q t q }
        { n = split($0, trays, / \| /); line = ""
          for (i = 1; i <= n; i++) {
              m = split(trays[i], words, " "); if (m == 0) continue
              term = atom(words[1]); for (k = 2; k <= m; k++) term = term "," atom(words[k])
              line = line (line == "" ? "" : ",") "tray(" term ")" }
          print "[" line "]." }' "$plans" >"$scratch/plans.pl"
    local rules=
    for rule in "$@"; do rules="$rules${rules:+,}'$rule'"; done
    cat >"$scratch/run.pl" <<END
% A rule's own predicate decides as match_plan/2 does.
own_names(P) :- forall(( member(R, [$rules]), \\+ member(R, [atom, halt, ground]) ),
                       ( match_plan(R, P) -> call(R, P) ; \\+ call(R, P) )), !.
own_names(_) :- write(' a rule by its own name decides otherwise').
run :- open('$scratch/plans.pl', read, S), all(S), close(S).
all(S) :- read(S, P), ( P == end_of_file -> true ; decide(P), nl, all(S) ).
decide(P) :- forall(member(R, [$rules]), ( match_plan(R, P) -> write(1) ; write(0) )), own_names(P),
    write(' '), ( keep_plan('$library', P) -> write(1) ; write(0) ).
END
    swipl -q -f "$scratch/rules.pl" -l "$scratch/run.pl" -g run -g halt >"$scratch/prolog" 2>"$scratch/errors" ||
        fail "SWI-Prolog failed on $file: $(head -n 3 "$scratch/errors")"
    [ -s "$scratch/errors" ] && fail "SWI-Prolog says of $file: $(head -n 3 "$scratch/errors")"
    local args=()
    for rule in "$@"; do args+=(--rule "$rule"); done
    "$TARTAN" match "$file" "$plans" "${args[@]}" --engine vm --format bits >"$scratch/bits"
    : >"$scratch/kept"
    while IFS= read -r plan; do
        "$TARTAN" prune "$file" <(printf '%s\n' "$plan") --library "$library" 2>/dev/null | wc -l >>"$scratch/kept"
    done <"$plans"
    paste -d ' ' "$scratch/bits" "$scratch/kept" | tr -d '\t' >"$scratch/wanted"
    cmp "$scratch/wanted" "$scratch/prolog" || fail "Prolog decides otherwise about $file"
    [ "$(wc -l <"$scratch/prolog")" -gt 20 ] || fail "too few plans of $file"
}

names() { sed -n 's/^rule \([^ ]*\).*/\1/p' "$1"; }
{ cat "$files/parts.plan"; printf '\nlibrary all { trays 0..7 }\nlibrary some { trays 1..5\n  total 3m..9m\n  prune a-row, far, not a-choice\n}\n'; } >"$scratch/parts.plan"
"$TARTAN" sample "$scratch/parts.plan" --library all --per-length 8 --seed 3 >"$scratch/random" 2>/dev/null
# shellcheck disable=SC2046
compare "$scratch/parts.plan" some "$scratch/random" $(names "$files/parts.plan")
# Names, values and texts that Prolog would read otherwise; lengths of every spelling.
"$TARTAN" sample "$files/odd-names.plan" --library every --per-length 12 --seed 2 >"$scratch/random" 2>/dev/null
# shellcheck disable=SC2046
compare "$files/odd-names.plan" Lib-1 "$scratch/random" $(names "$files/odd-names.plan")
cat >"$scratch/lahave.plan" <<'END'
use "lahave"
library all { trays 1..5 }
library paper { trays 1..4
  prune narrow-pair, dense-end, thin-totem, stranded
}
END
"$TARTAN" sample "$scratch/lahave.plan" --library all --per-length 12 --seed 5 >"$scratch/random"
# shellcheck disable=SC2046
compare "$scratch/lahave.plan" paper "$scratch/random" $(names stdlib/lahave.plan | grep -vx few-machines)
# Sums that are compared, what lies around a stretch, extremes, quotients, calls; which trays there are.
cat >"$scratch/sums.plan" <<'END'
schema s {
  width = 1m | 2m | 3m
  height = one < two
  sun = flag
  zone north = shut | open(1m, 2m)
  number load = 2 where tray(width > 2 * north) | 0
  only tray(width >= north) or tray(sun)
}
rule above(x, y) = tray(x > 2 * y)
rule a = sum(width) > 2 * sum(north depth)
rule b = sum(width * height of tray(sun)) - 2m * quantity(tray(open)) >= 1m
rule c = above(width, north) and quantity(any) mod 2 = 1
rule d = sum(load) in 2..4 or matches(c) + quantity(tray(sun)) >= 2
rule e = tray(sun) where sum(width before) = sum(width of any after) and occurrences(tray(two) after) >= 1
rule f = mirrored(height) and values(width) >= 2
rule g = max(width of tray(sun)) - min(width) >= 1m
rule h = max(gap from tray(sun) to tray(two) by width) <= 2m
rule i = sum(width) / quantity(any) > 2m
rule j = neighbour(a, tray(sun)) or not symmetric neighbour(tray(1m), b)
rule prune_plan = tray(load >= 2, height * 1m < width)
library all { trays 0..5 }
library l { trays 1..4  prune c, g  require sum(width) >= 3m, a  prefer b worth 2 }
END
"$TARTAN" sample "$scratch/sums.plan" --library all --per-length 12 --seed 4 >"$scratch/random" 2>/dev/null
compare "$scratch/sums.plan" l "$scratch/random" a b c d e f g h i j prune_plan

# fetch/3 and prune_plan/1, and a rule beside the program that asks as the paper's rules do.
"$TARTAN" export "$scratch/sums.plan" --prolog --library l --fetch -o "$scratch/rules.pl" 2>/dev/null
cat >"$scratch/run.pl" <<'END'
sunny(Trays) :- member(T, Trays), fetch(T, sun, true), fetch(T, width, W), fetch(T, north, open), fetch(T, depth(north), W).
run :- forall(member(P-Wanted, [[tray('2m', one, sun, 'open:2m')]-[sunny, pruned], [tray('3m', two, '-', shut), tray('3m', two, '-', shut)]-[kept],
                                [tray('1m', one, sun, 'open:2m')]-[pruned]]),
              ( findall(S, ( sunny(P), S = sunny ; prune_plan(P), S = pruned ; keep_plan(l, P), S = kept ), Got),
                ( Got == Wanted -> true ; write(P-Got), nl ) )).
END
said=$(swipl -q -f "$scratch/rules.pl" -l "$scratch/run.pl" -g run -g halt 2>&1)
is 'what fetch and prune_plan say otherwise' "$said" ''

# A rule that uses itself twice asks about each stretch in very many ways: what was answered is remembered.
cat >"$scratch/grown.plan" <<'END'
schema row { use = a | b }
rule grown = tray(a) or neighbour(grown, grown)
library l { trays 1..60  generate grown }
END
"$TARTAN" export "$scratch/grown.plan" --prolog -o "$scratch/rules.pl"
cat >"$scratch/run.pl" <<'END'
row(0, []) :- !.
row(N, [tray(a)|Row]) :- M is N - 1, row(M, Row).
run :- row(40, Row), append(Row, [tray(b)], Odd), plan_of(Odd, W),
       ( 'grown whole'(W, 0, 40) -> write(yes) ; write(no) ), ( 'grown whole'(W, 0, 41) -> write(yes) ; write(no) ).
END
is 'a circle of rules in Prolog' "$(timeout 60 swipl -q -f "$scratch/rules.pl" -l "$scratch/run.pl" -g run -g halt 2>&1)" yesno
finish
