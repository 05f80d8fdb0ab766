#!/usr/bin/env bash
# Individuals inserted, edited and taken out while a run is bred, and populations of another size: the same bytes at any number of
# threads, whether interrupted or not, by the prompt or by command; what a grammar cannot make is refused with its place.
# Slow under sanitizers.
# Needs the parts: draw store
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
failed=0
fail() { echo "breed_by_hand: $*" >&2; failed=1; }

cat > grow.study <<'X'
rules "square"
steps 3
scale 1.2
gravity 0 0 -0.05
boundary sphere at 0 0 -1 radius 0.8
fitness undulation target 2
X
cat > garden.study <<'X'
evolution {
  grammar "genr8-dividing"
  grow "grow.study"
  population 8
  generations 4
  seed 5
}
X
# Table 2 of the Genr8 paper, laid out by hand
cat > square.hemls <<'X'
// the square
A+B+A+B        # its seed
A -> A [[+B]-B] A
B -> B [[+A]-A] B
Angle 90
BranchAngle 90
X
printf 'A + B + A + B\nA -> A [ + B ] A\nAngle 90\n' > other.hemls

# ---- Genr8's square and triangle are sentences of a grammar of ours
square='A + B + A + B ; A -> A [ [ + B ] - B ] A ; B -> B [ [ + A ] - A ] B ; Angle 90 ; BranchAngle 90'
triangle='A + B + C ; A -> A [ [ [ [ + C ] + + B ] - B ] - - C ] A ; B -> B [ [ [ [ + A ] + + C ] - C ] - - A ] B ; C -> C [ [ [ [ + B ] + + A ] - A ] - - B ] C ; Angle 60 ; Sync'
for sentence in "$square" "$triangle"; do
  genome=$("$TARTAN" map genr8-dividing --invert "$sentence") || fail "not a sentence of genr8-dividing: $sentence"
  [ "$("$TARTAN" map genr8-dividing --genome "$genome" | tail -n 1)" = "$sentence" ] || fail "its genome is another's: $sentence"
done

# ---- the prompt
lines='insert other.hemls\ninsert none.hemls\ninsert square.hemls\nout 3\nset population 6\nedit 1 square.hemls\nout #999\nset population 1\n1 2\nset population 10\n1\n\n'
# shellcheck disable=SC2059
for threads in 1 2; do printf "$lines" | "$TARTAN" breed garden.study -o "hand$threads" --threads $threads > "hand$threads.txt" || fail "cannot breed"; done
cmp -s hand1/run.sqlite hand2/run.sqlite || fail "two threads make another run than one"
grep -q 'the sentence cannot be derived: `\[` does not fit here' hand1.txt || fail "what the grammar cannot make is not said"
grep -A 1 '^.*A + B + A + B ; A -> A \[ + B \]' hand1.txt | grep -q '^ *^$' || fail "its place is not shown"
grep -q '#999. is nobody here' hand1.txt && grep -q 'cannot have a population of 1$' hand1.txt || fail "what cannot be done is not said"
"$TARTAN" runs show hand1 > shown.txt
for words in 'inserted in place of 7: 4$' 'taken out: 2$' 'changed: population 6$' 'edited, in place of 0: 4$' 'changed: population 10$'; do
  grep -q "$words" shown.txt || fail "the run does not say: $words"
done
[ "$(sqlite3 hand1/run.sqlite 'SELECT count(*) FROM birth WHERE kind=5')" = 2 ] || fail "not every insertion is in the genealogy"
[ "$(sqlite3 hand1/run.sqlite 'SELECT parent FROM birth WHERE id=9')" = 0 ] || fail "what was edited has not its parent"
[ "$(sqlite3 hand1/run.sqlite 'SELECT length(members)/8 FROM generation' | tr '\n' ' ')" = '8 6 10 ' ] || fail "populations are not as large as was said"
[ "$("$TARTAN" runs replay hand1 8 | tail -n 1)" = "$square" ] || fail "what was inserted is not replayed"
for id in 0 10 20 24; do "$TARTAN" runs replay hand1 $id > /dev/null || fail "$id is not replayed"; done

# the page: whole, without the network, with as many forms as are scored
grep -q 'sheet-0002.svg, hand1/sheet.html$' hand1.txt && cmp -s hand1/sheet.html hand2/sheet.html || fail "there is no page, or it is another at two threads"
printf '1 2\n\n' | "$TARTAN" breed garden.study -o page > /dev/null
python3 - page/sheet.html <<'X' || fail "the page does not hold its forms"
import base64, json, re, sys
text = open(sys.argv[1]).read()
assert 'http' not in text and 'src=' not in text and text.count('<canvas>') == text.count('<summary>genealogy')
forms = json.loads(re.search(r'id="forms">(.*?)</script>', text, re.S).group(1))
assert len(forms) == text.count('<canvas>') > 0
for form in forms:
    points, triangles = len(base64.b64decode(form['p'])) // 6, base64.b64decode(form['t'])
    each = 4 if form['wide'] else 2
    ends = [int.from_bytes(triangles[i:i + each], 'little') for i in range(0, len(triangles), each)]
    assert len(ends) % 3 == 0 and ends and max(ends) == points - 1
    assert any(guide['k'] == 'arrow' and guide['n'].startswith('gravity') for guide in form['guides'])
assert re.search(r'<li>#\d+ is of #\d', text)
X

# resumed between any two lines
printf 'insert square.hemls\nout 3\nset population 6\n1 2\n' | "$TARTAN" breed garden.study -o parts > /dev/null
printf 'set population 10\n1\n' | "$TARTAN" breed garden.study -o parts --resume --threads 2 > /dev/null || fail "cannot go on"
printf 'insert square.hemls\nout 3\nset population 6\n1 2\nset population 10\n1\n' | "$TARTAN" breed garden.study -o whole > /dev/null
cmp -s parts/run.sqlite whole/run.sqlite || fail "a resumed run is another than one without interruption"

# ---- an editor
cat > editor.sh <<'X'
#!/bin/sh
grep -q '^Angle' "$2" && cp square.hemls "$2" && [ "$1" = -x ]
X
chmod +x editor.sh
printf 'edit 2\n1\n' | EDITOR='./editor.sh -x' VISUAL='' "$TARTAN" breed garden.study -o edited > edited.txt || fail "cannot edit"
printf 'edit 2 square.hemls\n1\n' | "$TARTAN" breed garden.study -o filed > /dev/null
cmp -s edited/run.sqlite filed/run.sqlite || fail "an editor's text is another than a file's"
ls edited | grep -q edited- && fail "the edited file is left behind"
printf 'edit 2\n\n' | EDITOR='' VISUAL='' "$TARTAN" breed garden.study -o alone | grep -q 'there is no editor: set EDITOR' || fail "no editor is not said"
printf 'edit 2\n\n' | VISUAL=false "$TARTAN" breed garden.study -o failing | grep -q 'did not end well: nothing is changed' || fail "a failed editor is not said"
ls failing | grep -q edited- || fail "what was written is lost"

# ---- by command: done when the run goes on
"$TARTAN" evolve garden.study -o left > /dev/null
"$TARTAN" runs insert left square.hemls 2> err && grep -q 'when the run goes on' err || fail "cannot insert: $(cat err)"
members=$(sqlite3 left/run.sqlite 'SELECT hex(members) FROM generation WHERE number=4')
first=$((16#${members:2:2}${members:0:2})); second=$((16#${members:18:2}${members:16:2}))
"$TARTAN" runs remove left $second 2> err || fail "cannot remove: $(cat err)"
"$TARTAN" runs remove left $second 2> err; grep -q "E1241.*no member with the id $second" err || fail "removes twice"
"$TARTAN" runs insert left square.hemls --in-place-of $first 2> err || fail "cannot edit: $(cat err)"
"$TARTAN" runs insert left other.hemls 2> err; [ $? -eq 1 ] && grep -q 'other.hemls:1:24: .*E1222' err || fail "inserts what cannot be: $(cat err)"
"$TARTAN" runs remove left 5 2> err; [ $? -eq 1 ] || fail "removes who is none"
"$TARTAN" runs insert left 2> err; [ $? -eq 2 ] || fail "inserts nothing"
"$TARTAN" runs show left --in-place-of 3 2> err; [ $? -eq 2 ] || fail "shows in the place of somebody"
"$TARTAN" runs insert left square.hemls -o x 2> err; [ $? -eq 2 ] || fail "takes an output that it has not"
cp -r left left2
"$TARTAN" evolve garden.study -o left --resume --generations 6 --threads 1 > /dev/null || fail "does not do what was left"
"$TARTAN" evolve garden.study -o left2 --resume --generations 6 --threads 2 > /dev/null
cmp -s left/run.sqlite left2/run.sqlite || fail "what was left is done otherwise by two threads"
"$TARTAN" evolve garden.study -o left --resume --generations 7 > /dev/null || fail "does not go on past what was left"
[ "$(sqlite3 left/run.sqlite 'SELECT count(*) FROM event WHERE generation=5')" = 3 ] || fail "what was left is stored twice"

# changed goals and insertions before one generation
"$TARTAN" evolve garden.study -o mixed > /dev/null
"$TARTAN" runs insert mixed square.hemls 2> /dev/null
"$TARTAN" evolve garden.study -o mixed --resume --generations 6 --set "undulation target 1" --set "population 12" > /dev/null || fail "cannot change both"
"$TARTAN" evolve garden.study -o mixed --resume --generations 7 > /dev/null || fail "cannot go on past both"
"$TARTAN" runs replay mixed 60 > /dev/null || fail "cannot replay past both"

# ---- forms have no sentences of a grammar
printf 'evolution {\nparent "heart"\nparent "klein"\npopulation 4\ngrid 12\n}\n' > forms.study
printf 'insert square.hemls\nset population 6\nout 3\n1 2\n\n' | "$TARTAN" breed forms.study -o forms > forms.txt || fail "cannot breed forms"
grep -q 'only sentences of a grammar can be inserted' forms.txt || fail "a form is inserted"
[ "$(sqlite3 forms/run.sqlite 'SELECT length(members)/8 FROM generation WHERE number=1')" = 6 ] || fail "forms do not have another population"
exit $failed
