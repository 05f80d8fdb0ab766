#!/usr/bin/env bash
# The grammar of .plan for tree-sitter: it reads every file of rules, highlights each of its names once and folds its items; it does not read what
# the compiler does not, and has every word of the language.
name=tree_sitter
. "$(dirname "$0")/golden.bash"
for program in tree-sitter node cc; do
    command -v "$program" >/dev/null || { echo "skipped: $program is not installed" && exit 77; }
done
root=$(cd "$here/../.." && pwd)
export HOME=$scratch XDG_CACHE_HOME=$scratch/cache XDG_CONFIG_HOME=$scratch/config
small=$goldens/small.plan
grammar=$scratch/grammar
cp -r "$root/editors/tree-sitter" "$grammar"
cd "$grammar" || exit
tree-sitter generate >"$scratch/said" 2>&1 || { cat "$scratch/said" && exit 1; }

# failed: which of the files that standard input names have an ERROR or a MISSING node.
failed() {
    cat >"$scratch/list"
    tree-sitter parse --quiet --stat --paths "$scratch/list" >"$scratch/parsed" 2>"$scratch/said" || true
    grep -q "^Total parses: $(wc -l <"$scratch/list");" "$scratch/parsed" || fail "not all files were read: $(tail -n 1 "$scratch/said")"
    grep -E '\((ERROR|MISSING)' "$scratch/parsed" || true
}
# captures QUERY FILES: line, column, capture and first line of the text of what a query finds in the files that are listed.
captures() {
    tree-sitter query --captures "$1" --paths "$2" 2>"$scratch/said" >"$scratch/captured" || fail "$1: $(tail -n 2 "$scratch/said")"
    awk '/^[^ ]/ { file = $0; next }
        match($0, /capture: [^,]*/) {
            capture = substr($0, RSTART + 9, RLENGTH - 9); sub(/^[0-9]+ - /, "", capture)
            match($0, /start: \([0-9]+, [0-9]+\)/); split(substr($0, RSTART + 8, RLENGTH - 9), start, ", ")
            match($0, /end: \([0-9]+, [0-9]+\)/); split(substr($0, RSTART + 6, RLENGTH - 7), end, ", ")
            text = $0; if (!sub(/.*text: /, "", text)) text = "to line " end[1] + 1
            printf "%s\t%d:%d\t%s\t%s\n", file, start[1] + 1, start[2] + 1, capture, text
        }' "$scratch/captured"
}

find "$root/stdlib" "$root/examples" "$files" "$root/bench" "$goldens" "$here/word_tables" -name '*.plan' | LC_ALL=C sort >"$scratch/files"
[ "$(wc -l <"$scratch/files")" -gt 100 ] || fail 'files are missing'
is 'files with errors' "$(failed <"$scratch/files")" ''

# Each name has one colour: editors differ in which of two they take.
echo '(name) @name' >names.scm
captures names.scm "$scratch/files" | cut -f 1,2,4 | sort >"$scratch/names"
captures queries/highlights.scm "$scratch/files" | cut -f 1,2,4 | sort >"$scratch/coloured"
[ "$(wc -l <"$scratch/names")" -gt 10000 ] || fail 'names are missing'
is 'names without a colour' "$(comm -23 "$scratch/names" "$scratch/coloured" | head)" ''
is 'colours on colours' "$(uniq -d "$scratch/coloured" | head)" ''

echo "$small" >"$scratch/one"
exits 0 "$TARTAN" check "$small"
captures queries/highlights.scm "$scratch/one" | cut -f 2- >"$scratch/highlights"
captures queries/folds.scm "$scratch/one" | cut -f 2- >"$scratch/folds"
tree-sitter parse "$small" 2>/dev/null | sed -E 's/ \[[0-9]+, [0-9]+\] - \[[0-9]+, [0-9]+\]//g' >"$scratch/tree"
golden highlights 'cat "$scratch/highlights"'
golden folds 'cat "$scratch/folds"'
golden tree 'cat "$scratch/tree"'

# Every word that the lexer takes for one is a word of the grammar, and has a colour.
sed -nE 's/^WORD\("([a-z-]+)", ([A-Z_]+),.*/\1 \2/p' "$root/compiler/plan/syntax/words.def" | grep -v ' NAME$' | cut -d ' ' -f 1 | sort -u >"$scratch/words"
[ "$(wc -l <"$scratch/words")" -gt 100 ] || fail 'words are missing'
while read -r word; do
    grep -q "\"$word\"" grammar.js || fail "grammar.js lacks the word $word"
    grep -q "\"$word\"" queries/highlights.scm || fail "highlights.scm lacks the word $word"
done <"$scratch/words"

# What the compiler takes for wrong syntax has an error here, too.
mkdir "$scratch/wrong"
wrongs=0
while IFS= read -r text; do
    printf '%s\n' "$text" >"$scratch/wrong/$((++wrongs)).plan"
    exits 1 "$TARTAN" check "$scratch/wrong/$wrongs.plan"
    grep -q 'error\[E0001\]' "$scratch/err" || fail "the compiler reads: $text"
done <<'WRONG'
rule = tray(a)
rule a tray(a)
rule a = tray(a
rule a = and tray(a)
rule a = tray(a) tray(b)
rule a = 1 +
rule a = neighbour()
rule a = plan [a | ]
measure m = sum()
schema s { a = }
schema s { a | b }
schema s { a = b forbid }
library l using s { trays }
library l using s { require }
library l using s { storey a 3m }
form f { storey a 3m }
form f of s { storey 3m }
form f of s { option a = }
form f of s { tile t for a { wide 3m } }
test a { [b] }
test a { match b }
use lahave
tray(a)
WRONG
ls "$scratch"/wrong/*.plan >"$scratch/all"
failed <"$scratch/all" | cut -d ' ' -f 1 | cut -f 1 | sort >"$scratch/found"
is 'wrong files that are read' "$(sort "$scratch/all" | comm -23 - "$scratch/found" | xargs -r cat)" ''

# Random files that the compiler reads. What `only` and `forbid` may hold is told by the checker (E0207), and by this grammar.
mkdir "$scratch/made"
for kind in plans searched houses; do
    python3 -B "$here/../differential/made.py" "$kind" 60 "$scratch/made"
done
for file in "$scratch"/made/*.plan; do
    "$TARTAN" check "$file" >"$scratch/said" 2>&1 || true
    grep -qE 'error\[(E00|E0207)' "$scratch/said" || echo "$file"
done >"$scratch/read"
[ "$(wc -l <"$scratch/read")" -ge 100 ] || fail "$(wc -l <"$scratch/read") random files are read"
is 'random files with errors' "$(failed <"$scratch/read")" ''

# As docs for Neovim say.
if command -v nvim >/dev/null; then
    mkdir -p "$XDG_CONFIG_HOME/nvim/parser" "$XDG_CONFIG_HOME/nvim/queries/plan"
    cc -shared -fPIC -O2 -I src -o "$XDG_CONFIG_HOME/nvim/parser/plan.so" src/parser.c
    cp queries/*.scm "$XDG_CONFIG_HOME/nvim/queries/plan"
    got=$(timeout 60 nvim --headless -i NONE -n -u NONE -c "luafile $here/../tree_sitter.lua" "$small" 2>&1 </dev/null | tr -d '\r')
    is 'in Neovim' "$got" "highlights $(wc -l <"$scratch/highlights"), folds $(wc -l <"$scratch/folds")"
fi
finish
