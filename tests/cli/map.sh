#!/usr/bin/env bash
# Needs the parts: draw
# tartan map, and what check says of grammars.
name=map
source "$(dirname "$0")/golden.bash"

cat >"$scratch/e.bnf" <<'X'
<e> ::= <e>+<e> | (<e>) | <v> | <v>
<v> ::= x | y
X
printf '%%single-choice skip\n<e> ::= x | <e>y\n' >"$scratch/single.bnf"
golden text "tartan map $scratch/e.bnf --genome '0 2 0 3 1'"
golden json "tartan map $scratch/e.bnf --genome '0 2 0 3 1' --format json"
golden invalid "tartan map $scratch/e.bnf --genome '0 2 0' --format json"
golden wraps "tartan map $scratch/e.bnf --genome '0 2 0' --wraps 2"
golden too_deep "tartan map $scratch/e.bnf --genome '1 1 1 2 0' --max-depth 4"
golden tree "tartan map $scratch/e.bnf --genome '0 2 0 3 1' --tree text"
golden tree_json "tartan map $scratch/e.bnf --genome '0 2 0 3 1' --tree json"
golden worked_example "tartan map ../../../stdlib/genr8-example.bnf --genome '212 187 632 832 800 517 338 39 878 185 954 863' --wraps 0 --trace"
golden genr8_json "tartan map ../../../stdlib/genr8.bnf --genome '29034 85023 45287 13389 5901 8070 9032 13519 88257 43456 78396 21408 50881 84380 34224 34369 80227 75490 99863 32030 20004 92949 67003 6328 70377 5421 10108 89366' --format json"
golden invert "tartan map $scratch/e.bnf --invert '(x+y)'"
golden not_derivable "tartan map $scratch/e.bnf --invert '(x+z)'"
golden too_shallow "tartan map $scratch/e.bnf --invert '((x))' --max-depth 4"
golden bad_codon "tartan map $scratch/e.bnf --genome '1 two 3'"
golden large_codon "tartan map $scratch/e.bnf --genome '18446744073709551616'"
golden largest_codon "tartan map $scratch/e.bnf --genome '18446744073709551614 18446744073709551615'"
printf '0 2 0 3 1\n# a comment\n\n2 x\n3 1\n' >"$scratch/genomes"
golden file "tartan map $scratch/e.bnf --genomes $scratch/genomes"
golden nothing_to_map "tartan map $scratch/e.bnf"
golden not_a_grammar "tartan map ../../../stdlib/lahave.plan --genome 1"
golden picture_of_many "tartan map $scratch/e.bnf --random 3 --tree x.svg"
golden picture_as_text "tartan map $scratch/e.bnf --random 1 -o $scratch/x.png"
golden tree_without_how "tartan map $scratch/e.bnf --random 1 --tree -o $scratch/x.png"
golden trace_json "tartan map $scratch/e.bnf --genome '0 2 0 3 1' --trace --format json"
golden invert_tree "tartan map $scratch/e.bnf --invert '(x+y)' --tree text"
# position-independent mapping
golden places "tartan map $scratch/e.bnf --genome '0 0 1 3 0 2 0 1 1 0 0 1' --mapping position-independent --trace"
golden places_tree "tartan map $scratch/e.bnf --genome '0 0 1 3 0 2 0 1 1 0 0 1' --mapping position-independent --tree text"
golden places_invalid "tartan map $scratch/e.bnf --genome '0 0 1 3 0' --mapping position-independent --trace --tree text"
golden places_invert "tartan map $scratch/e.bnf --invert '(x+y)' --mapping position-independent"
golden places_genr8 "tartan map ../../../stdlib/genr8-example.bnf --random 1 --mapping position-independent"
{ echo '%mapping position-independent'; cat "$scratch/e.bnf"; } >"$scratch/pairs.bnf"
golden places_disasm "tartan build $scratch/pairs.bnf -o $scratch/pairs.tnb && tartan disasm $scratch/pairs.tnb | grep '^grammar'"
golden places_skip "tartan map $scratch/single.bnf --random 1 --mapping position-independent"
cmp <("$TARTAN" map "$scratch/pairs.bnf" --random 50) <("$TARTAN" map "$scratch/e.bnf" --random 50 --mapping position-independent) ||
    fail "the grammar's %mapping is not that of --mapping"
cmp <("$TARTAN" map "$scratch/pairs.bnf" --random 50 --mapping leftmost) <("$TARTAN" map "$scratch/e.bnf" --random 50) ||
    fail "--mapping leftmost does not stand in place of %mapping"
golden random "tartan map $scratch/e.bnf --random 3 --seed 4 --codons 12"
golden figures "tartan check $scratch/e.bnf --figures"
printf '<e> ::= <e><e> | x\n' >"$scratch/even.bnf"
golden no_growth "tartan check $scratch/even.bnf"
printf '<e> ::= <e><e> | <e><e><e> | x\n' >"$scratch/growing.bnf"
golden growth "tartan check $scratch/growing.bnf"
golden stdlib_name "tartan map genr8-example --genome '212 187 632 832 800 517 338 39' --wraps 0"
golden stdlib_near "tartan map genr9 --random 1"
golden stdlib_extension "tartan map genr8.bnf --random 1"
golden stdlib_other "tartan map lahave --random 1"
golden stdlib_grown "tartan grow squares --steps 2"
golden disasm "tartan disasm ../../../stdlib/words.bnf | head -n 12 | grep -v '^module:\|^written'"

# a grammar as a module maps as its source does
"$TARTAN" build "$scratch/e.bnf" -o "$scratch/e.tnb"
cmp <("$TARTAN" map "$scratch/e.bnf" --random 50) <("$TARTAN" map "$scratch/e.tnb" --random 50) || fail "a module maps otherwise"

# a file of the same name as one of the standard library is meant before it; a module does not say where the standard library is
cp "$scratch/e.bnf" "$scratch/words"
(cd "$scratch" && "$TARTAN" check words >/dev/null 2>&1) && fail "a file without extension is taken for the standard library's"
"$TARTAN" build words -o "$scratch/words.tnb" || fail "cannot build the standard library's words"
grep -qa "$(dirname "$TARTAN")" "$scratch/words.tnb" && fail "a module of the standard library says where it lay"
grown() { "$TARTAN" grow "$1" --steps 2 -o - --format obj | grep -v '^#'; }
cmp <(grown square) <(grown stdlib/square.hemls) || fail "the standard library's square grows otherwise by its name"

# pictures are the same each time
for format in svg png pdf; do
    "$TARTAN" map stdlib/genr8.bnf --genome "$(seq -s ' ' 7 13 2000)" --tree "$scratch/one.$format" >/dev/null
    "$TARTAN" map stdlib/genr8.bnf --genome "$(seq -s ' ' 7 13 2000)" --tree "$scratch/two.$format" >/dev/null
    cmp "$scratch/one.$format" "$scratch/two.$format" || fail "a $format differs"
done

"$TARTAN" map "$scratch/e.bnf" --random 1 --tree "$scratch/random.svg" >/dev/null || fail "no picture of a random genome"

finish
