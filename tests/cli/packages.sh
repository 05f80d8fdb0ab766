#!/usr/bin/env bash
# tools/install-packages installs what is missing and nothing else, and prints the list where it cannot.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() {
    echo "$1"
    exit 1
}

printf '# a comment\nalpha\nbeta # another\n\ngamma\n' >"$scratch/list"
mkdir "$scratch/bin"
for tool in bash env sed grep find cat touch; do
    ln -s "$(command -v $tool)" "$scratch/bin/$tool"
done
make() { # NAME: a tool of ours, its text from standard input
    { echo '#!/usr/bin/env bash'; cat; } >"$scratch/bin/$1"
    chmod +x "$scratch/bin/$1"
}
install() {
    PATH=$scratch/bin tools/install-packages "$scratch/list"
}

# No apt-get: the list, and on with it.
out=$(install) || fail 'where there is no apt-get, the build should go on'
for package in alpha beta gamma; do
    grep -q "^    $package\$" <<<"$out" || fail "the list lacks $package"
done

make dpkg-query <<<'[ "${!#}" = beta ] || [ -e "'"$scratch"'/all" ] || exit 1; printf installed'
make apt-get <<<'echo "$DEBIAN_FRONTEND $*" >>"'"$scratch"'/log"'
make id <<<'echo 0'

# As root: what is missing, without questions.
install >/dev/null
grep -qE '^noninteractive .*install .*alpha gamma$' "$scratch/log" || fail "apt-get was asked: $(cat "$scratch/log")"
! grep -q beta "$scratch/log" || fail 'installs what is there'

# Not root, with sudo and without.
make id <<<'echo 1000'
rm "$scratch/log"
if install >/dev/null 2>"$scratch/errors"; then
    fail 'neither root nor sudo, and no failure'
fi
grep -q 'apt-get install alpha gamma' "$scratch/errors" || fail 'does not say what to run as root'
make sudo <<<'touch "'"$scratch"'/sudo"; exec "$@"'
install >/dev/null
[ -e "$scratch/sudo" ] || fail 'does not use sudo'
grep -q 'alpha gamma$' "$scratch/log" || fail 'sudo does not reach apt-get'

# All there: silence.
touch "$scratch/all"
rm "$scratch/log"
[ -z "$(install)" ] || fail 'talks where there is nothing to do'
[ ! -e "$scratch/log" ] || fail 'calls apt-get where there is nothing to do'
