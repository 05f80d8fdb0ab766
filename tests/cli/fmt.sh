#!/usr/bin/env bash
# fmt: in place, to standard output, as a difference, as a question; a file with errors is not touched.
name=fmt
. "$(dirname "$0")/golden.bash"

printf 'RULE a=tray(  8'"'"' )# why\nrule b "two"=a\n' >"$scratch/wild.plan"
printf 'rule a = tray(\n' >"$scratch/broken.plan"
cp "$scratch/broken.plan" "$scratch/kept.plan"

golden stdin "tartan fmt - <$scratch/wild.plan"
golden check "tartan fmt --check $scratch/wild.plan sheds.plan"
golden diff "tartan fmt --diff $scratch/wild.plan"
golden diff_json "tartan fmt --check --diagnostics json $scratch/wild.plan"
golden broken "tartan fmt $scratch/broken.plan $scratch/wild.plan"
golden missing 'tartan fmt nowhere.plan'
printf 'A+B+A;A->A[+B]A Weight 2;->B // B\nangle 90' >"$scratch/wild.hemls"
printf 'rules "square" scale (1,2,3) # why\nattractor at 1 2.5 3 repeller at -1 2 3' >"$scratch/wild.study"
printf 'evolution { grammar "words"; match "x" # why\n}' >"$scratch/evolution.study"
printf '<a> ::= x <b>|\n"y" # why\n<b>::=GE_RANGE:3' >"$scratch/wild.bnf"
for notation in hemls study bnf; do
    golden "stdin_$notation" "tartan fmt --notation $notation - <$scratch/wild.$notation"
done
golden notation_name 'tartan fmt --notation hemsl -'
golden notation_unsaid 'printf "<a> ::= x\n" | tartan fmt -'
golden all "tartan fmt --diff $scratch/wild.hemls $scratch/evolution.study $scratch/wild.bnf"
golden plain "cp $scratch/wild.bnf $scratch/grammar; tartan fmt --notation bnf $scratch/grammar; cat $scratch/grammar"
printf '<a> ::= it'"'"'s\n' >"$scratch/broken.bnf"
cp "$scratch/broken.bnf" "$scratch/kept.bnf"
golden broken_bnf "tartan fmt $scratch/broken.bnf"
# Quotes that have no partner before the next blank would find one of another line, and hide what tells the dialect.
printf '<a> ::= Edge '"'"' { x\n  } '"'"' y\n' >"$scratch/quotes.bnf"
golden open_quotes_bnf "tartan fmt $scratch/quotes.bnf"
cmp -s "$scratch/broken.bnf" "$scratch/kept.bnf" || fail 'a grammar with errors was changed'
# Replaced as a whole: the file that was there is another one, and nothing is left beside it.
ln "$scratch/wild.study" "$scratch/old.study"
chmod 640 "$scratch/wild.study"
exits 0 "$TARTAN" fmt "$scratch/wild.study"
cmp -s "$scratch/wild.study" "$scratch/old.study" && fail 'the file was written over, not replaced'
is 'permissions' "$(stat -c %a "$scratch/wild.study")" 640
is 'files left over' "$(find "$scratch" -name '*.tmp' | wc -l)" 0
cmp -s "$scratch/broken.plan" "$scratch/kept.plan" || fail 'a file with errors was changed'
exits 0 "$TARTAN" fmt --check "$scratch/wild.plan"
touch -d '2001-01-01' "$scratch/wild.plan"
exits 0 "$TARTAN" fmt "$scratch/wild.plan"
is 'a formatted file' "$(stat -c %y "$scratch/wild.plan" | cut -c 1-4)" 2001
cd "$here/../.."
# What ships is laid out so, in every notation.
exits 0 "$TARTAN" fmt --check stdlib/*.{plan,hemls,bnf,kit} examples/*/*.{plan,study,kit} bench/*.plan
# `trays` begins a line of a library as a clause, and none in a sum, however long the line is.
cat >"$scratch/sums.plan" <<'END'
schema s { width = 5' | 12' tag = blue | red }
library l using s { require trays = 2 trays 1..2 require trays + occurrences(any) = 1 - 5 / 3 * trays prune trays in 3..4
require (occurrences(tray(not 5', blue)) + quantity(any) + quantity(tray(red)) + quantity(any) = quantity(tray(5')) - trays) }
END
golden sums "tartan fmt - <$scratch/sums.plan"
# Codes of classifications go on in lines that end with a comma; `deck` is `floor` there, too.
cat >"$scratch/classes.plan" <<'END'
schema s { width = 5' | 12' zone hall = room(14') }
form f of s { storey ground 9' wall 8" partition 4" floor 1' roof 10" function living at cell(any)
classification "DIN 276" for deck "350" "Floors and stairs", wall "330" "Outside walls", # all of them
roof "360" "Roofs and all that is upon them", living"W1" classification "Rooms" for living "L" }
END
golden classes "tartan fmt - <$scratch/classes.plan"
# Words that are called otherwise now are written so, once said for a file; what is called so by the author stays.
golden older_words 'tartan fmt - <older-words.plan'
golden older_words_checked 'tartan fmt --check older-words.plan own-floor.plan'
golden own_names 'tartan fmt - <own-floor.plan'
for file in older-words own-floor; do
    "$TARTAN" fmt - <"$files/$file.plan" >"$scratch/$file.plan" 2>/dev/null
    golden "newer_$file" "tartan fmt - <$scratch/$file.plan"
    for made in "$files" "$scratch"; do
        "$TARTAN" house "$made/$file.plan" '#25' --library all -o "$scratch/$file.parts.csv"
        "$TARTAN" count "$made/$file.plan" --library all --no-effects | cat - "$scratch/$file.parts.csv" >"$scratch/said"
        cp "$scratch/said" "$scratch/said.${made##*/}"
    done
    cmp "$scratch/said.files" "$scratch/said.${scratch##*/}" || fail "$file has other houses with the newer words"
done
golden own_parts "cat $scratch/own-floor.parts.csv"
# Forms and houses that are laid out at random.
python3 tests/fmt_houses.py "$TARTAN" "$scratch" stdlib/{cottage,lahave-form,lahave-complete,row-houses,apartments}.plan \
    tests/cli/files/house-coverage.plan || fail 'forms are formatted wrongly'
# What --diff says, patch can do.
if command -v patch >/dev/null; then
    cp tests/cli/files/sheds.plan "$scratch/a.plan"
    cp tests/cli/files/sheds.plan "$scratch/b.plan"
    "$TARTAN" fmt --diff "$scratch/a.plan" | patch -s "$scratch/a.plan" >/dev/null
    "$TARTAN" fmt "$scratch/b.plan"
    cmp -s "$scratch/a.plan" "$scratch/b.plan" || fail 'the difference does not make the formatted file'
fi
finish
