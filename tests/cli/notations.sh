#!/usr/bin/env bash
# Whatever lists notations has every row of compiler/notations.def: the editor's package, the helps, the pages of docs. And the
# compiler, which is handed its texts, opens no file.
set -euo pipefail
fail() {
    echo "$1"
    exit 1
}

python3 tests/notations.py compiler/notations.def editors/vscode "$TARTAN" || fail 'a list lacks a row of compiler/notations.def'

# The check itself finds what is missing.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'rm -rf "$scratch"' EXIT
sed 's|^#ifdef TARTAN_EXTRA|NOTATION(other, ".other", "", "it is another", "grow", "growth.md", "", "")\n&|' compiler/notations.def >"$scratch/more.def"
if python3 tests/notations.py "$scratch/more.def" editors/vscode "$TARTAN" >"$scratch/said"; then
    fail 'a row that the editor does not know passes'
fi
for lacks in 'package.json has no language other' 'package.json has no grammar of other' 'the help of fmt does not name .other'; do
    grep -qF "$lacks" "$scratch/said" || fail "of another row it does not say: $lacks"
done

command -v nm >/dev/null || exit 77
archives=$(find "$(dirname "$TARTAN")/compiler" -name '*.a')
[ -n "$archives" ] || fail 'no archives of the compiler'
for name in open fopen realpath readlink access stat opendir getenv getcwd; do
    # shellcheck disable=SC2086
    if nm -u $archives 2>/dev/null | grep -qE " U $name(64)?(@|\$)"; then
        fail "the compiler calls $name"
    fi
done
