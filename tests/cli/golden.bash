# For the shell tests: compares what commands print with golden files. A test sources this after setting `name`; its goldens lie in
# tests/cli/NAME/, its scratch folder is $scratch, and rule files are in $files. TARTAN_UPDATE=1 writes the goldens anew.
set -euo pipefail
: "${TARTAN:?the binary to test}"
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
files=$here/files
goldens=$here/$name
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0
export LC_ALL=C

fail() {
    printf '%s: %s\n' "$name" "$*"
    failures=$((failures + 1))
}

# golden FILE COMMAND: runs the command line in the folder of rule files, with tartan for $TARTAN; the golden holds the command, what it
# wrote to standard output and (after a line "[stderr]") to standard error, and its exit code.
golden() {
    local file=$goldens/$1.golden got=$scratch/golden command=$2 code=0
    (cd "$files" && tartan() { "$TARTAN" "$@"; } && eval "$command") >"$scratch/out" 2>"$scratch/err" </dev/null || code=$?
    {
        printf '$ %s\n' "$command"
        cat "$scratch/out"
        if [ -s "$scratch/err" ]; then
            echo '[stderr]'
            cat "$scratch/err"
        fi
        printf '[exit %s]\n' "$code"
    } | sed "s|$scratch|SCRATCH|g" >"$got"
    if [ "${TARTAN_UPDATE:-}" = 1 ]; then
        mkdir -p "$goldens"
        cp "$got" "$file"
    elif ! cmp -s "$file" "$got"; then
        fail "$1 is not as expected:"
        diff -u "$file" "$got" || true
    fi
}

# is WHAT GOT WANTED
is() {
    [ "$2" = "$3" ] || fail "$1: got '$2', not '$3'"
}

# exits CODE COMMAND...: runs it silently and looks at the exit code.
exits() {
    local wanted=$1 code=0
    shift
    "$@" >"$scratch/out" 2>"$scratch/err" || code=$?
    [ "$code" = "$wanted" ] || fail "exit $code, not $wanted: $* ($(head -n 1 "$scratch/err"))"
}

finish() {
    [ "$failures" -eq 0 ]
}
