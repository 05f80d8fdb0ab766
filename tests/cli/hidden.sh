#!/usr/bin/env bash
# What a file holds does not get to tell a terminal what to do: control characters and turned text are shown as escapes.
name=hidden
export NO_COLOR=1
. "$(dirname "$0")/golden.bash"
esc=$'\e' csi=$'\xc2\x9b' turn=$'\xe2\x80\xae'
bad="${esc}[31mred${esc}]0;pwn"$'\a'"${csi}2J${turn}txt"
cat >"$scratch/bad.plan" <<PLAN
schema s "$bad" {
  k "$bad" = x "$bad" | y
}
rule r "$bad" = tray(x)
rule twice = tray(x) and tray(x)
library l "$bad" using s {
  trays 1..3
  prune r
}
test r {
  match [y] "$bad"
}
PLAN
sed 's/1\.\.3/1..4/' "$scratch/bad.plan" >"$scratch/other.plan"
printf '<s> ::= "%s" | "b"\n' "$bad" >"$scratch/bad.bnf"

# A byte of C0 but tab and line end, one of C1, or a character that turns text.
raw() { LC_ALL=C grep -qaP '[\x00-\x08\x0b-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80[\x8e\x8f\xa8-\xae]|\xe2\x81[\xa6-\xa9]' "$1"; }
raw "$scratch/bad.plan" || fail 'the test looks for nothing'

# people WORDS...: what people read, in a file.
people() {
    "$TARTAN" "$@" >"$scratch/out" 2>&1 </dev/null || true
    [ -s "$scratch/out" ] || fail "$* says nothing"
    raw "$scratch/out" && fail "$* writes control characters"
    return 0
}
people check "$scratch/bad.plan"
people check --relations "$scratch/bad.plan"
people check --count --test --diff "$scratch/other.plan" "$scratch/bad.plan"
people test "$scratch/bad.plan"
people test --coverage "$scratch/bad.plan"
people count "$scratch/bad.plan"
people explain "$scratch/bad.plan" 'x'
people explain "$scratch/bad.plan" 'y' --rule r
people diff "$scratch/bad.plan" "$scratch/other.plan"
people rank "$scratch/bad.plan" 'x'
people disasm "$scratch/bad.plan"
"$TARTAN" count "$scratch/bad.plan" | grep -qF 'l: \x1b[31mred\x1b]0;pwn\x07\u009b2J\u202etxt' || fail 'count does not show escapes'
"$TARTAN" report "$scratch/bad.plan" -o "$scratch/report" >/dev/null
raw "$scratch/report/index.html" && fail 'the report holds control characters'
grep -qF '\x1b[31mred' "$scratch/report/index.html" || fail 'the report does not show escapes'

# Data keep their bytes in a file, and not on a terminal.
"$TARTAN" map "$scratch/bad.bnf" --genome '0' >"$scratch/sentence"
grep -qaF "$bad" "$scratch/sentence" || fail 'a sentence in a file is not what the grammar says'
terminal() {
    python3 - "$TARTAN" "$@" >"$scratch/seen" <<'PYTHON'
import os, pty, sys
pid, terminal = pty.fork()
if pid == 0:
    os.execv(sys.argv[1], sys.argv[1:])
text = b""
while True:
    try:
        part = os.read(terminal, 4096)
    except OSError:
        break
    if not part:
        break
    text += part
os.waitpid(pid, 0)
sys.stdout.buffer.write(text.replace(b"\r\n", b"\n"))
PYTHON
    [ -s "$scratch/seen" ] || fail "$* shows nothing on a terminal"
    raw "$scratch/seen" && fail "$* writes control characters to a terminal"
    return 0
}
terminal map "$scratch/bad.bnf" --genome '0'
grep -qF '\x1b[31mred' "$scratch/seen" || fail 'a sentence on a terminal is not shown with escapes'
terminal fmt --diff "$scratch/bad.plan"
terminal count --json "$scratch/bad.plan"
terminal build "$scratch/bad.plan" -o -
terminal sample "$scratch/bad.plan" 5 --format bin
printf 'schema s { k = x "\xe2\x82\xac" | y }\nlibrary l "%s" using s { trays 1 }\n' "$(printf '\xe2\x82\xac%.0s' $(seq 3000))" >"$scratch/euro.plan"
terminal count "$scratch/euro.plan"
is 'characters across writes' "$(grep -o $'\xe2\x82\xac' "$scratch/seen" | wc -l)" 3000

# A spreadsheet does not compute what a plan begins with.
cat >"$scratch/cells.plan" <<'PLAN'
schema s {
  door = flag
  k = x | y
}
library l using s { trays 1..2 }
PLAN
"$TARTAN" enumerate "$scratch/cells.plan" --format csv --csv-safe >"$scratch/safe.csv"
"$TARTAN" enumerate "$scratch/cells.plan" --format csv >"$scratch/plain.csv"
cut -d, -f3 "$scratch/safe.csv" | grep -q "^[=+@-]" && fail 'a cell begins with a formula'
for csv in safe plain; do
    "$TARTAN" rank "$scratch/cells.plan" "$scratch/$csv.csv" >/dev/null 2>&1 || true
    "$TARTAN" prune "$scratch/cells.plan" "$scratch/$csv.csv" >"$scratch/$csv.kept"
done
cmp -s "$scratch/safe.kept" "$scratch/plain.kept" || fail 'marked cells are read back as other plans'
[ "$(wc -l <"$scratch/safe.kept")" -gt 3 ] || fail 'nothing was read back'
finish
