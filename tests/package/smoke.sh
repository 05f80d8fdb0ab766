#!/usr/bin/env bash
# Runs on a clean root that has the package installed and nothing of the source tree beside this folder: smoke.sh VERSION
set -euo pipefail
cd "$(dirname "$0")"
fail() {
    echo "smoke: $1"
    exit 1
}
version=$1

[ "$(tartan --version)" = "tartan $version" ] || fail "tartan --version says $(tartan --version)"
cat >sheds.plan <<'PLAN'
use "lahave"

rule corridor-end = symmetric neighbour(beginning, tray(4'))

library cabins "two trays" using lahave {
  trays 2
  prune corridor-end
}

test corridor-end {
  match  [4' | 8']
  reject [8' | 8']
}
PLAN
tartan check sheds.plan
[ "$(tartan test sheds.plan)" = '2 passed, 0 failed' ] || fail 'tartan test'
line=$(tartan unrank sheds.plan 1000)
[ "$(tartan rank sheds.plan "$line")" = 1000 ] || fail 'tartan rank and unrank do not agree'
[ "$(tartan enumerate sheds.plan --limit 3 | tartan match sheds.plan | sort -u)" = - ] || fail 'tartan match'
tartan build sheds.plan -o sheds.tnb
[ "$(tartan count sheds.tnb)" = "$(tartan count sheds.plan)" ] || fail 'a module counts otherwise'
tartan enumerate sheds.plan --limit 100 -o sheds.sqlite
[ "$(tartan match sheds.plan sheds.sqlite | wc -l)" = 100 ] || fail 'a SQLite library does not read back'
for picture in svg png pdf; do
    tartan draw sheds.plan --sample 2 -o "sheet.$picture"
    [ -s "sheet.$picture" ] || fail "no sheet.$picture"
done
[ "$(tartan map "$(dirname "$(command -v tartan)")/../share/tartan/stdlib/words.bnf" --random 1 --seed 1 | wc -l)" -ge 1 ] || fail 'tartan map'

# The embedding program, linked to libtartan elsewhere.
printf "8' single public - dense:4' open:8' empty | 4' single - - dense:4' open:8' empty | 8' single - - dense:4' open:8' empty\n" >plans
./embed narrow.plan /usr/share/tartan/stdlib <plans >out
grep -q '^corridor matches 8' out || fail 'the embedding program did not match'
grep -qE '^[0-9]+ plans, three of them:$' out || fail 'the embedding program did not count'

# To be read and completed.
share=/usr/share
for command in $(tartan help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
    gzip -t "$share/man/man1/tartan-$command.1.gz" || fail "no manual page of $command"
done
for file in man/man1/tartan.1.gz man/man5/tartan-plan.5.gz doc/tartan/changelog.gz; do
    gzip -t "$share/$file" || fail "no $file"
done
grep -q 'MIT' $share/doc/tartan/copyright || fail 'no copyright'
. $share/bash-completion/completions/tartan
COMP_WORDS=(tartan cou) COMP_CWORD=1
_tartan
[ "${COMPREPLY[*]}" = count ] || fail 'no completion'
[ -s $share/zsh/vendor-completions/_tartan ] && [ -s $share/fish/vendor_completions.d/tartan.fish ] || fail 'completion for zsh or fish is missing'
