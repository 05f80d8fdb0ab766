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
    local file=$goldens/$1.golden command=$2 code=0 out err got expected=
    (cd "$files" && tartan() { "$TARTAN" "$@"; } && eval "$command") >"$scratch/out" 2>"$scratch/err" </dev/null || code=$?
    # In the shell itself: programs that do it would take longer than most commands.
    IFS= read -r -d '' out <"$scratch/out" || true
    IFS= read -r -d '' err <"$scratch/err" || true
    got="\$ $command"$'\n'"$out${err:+"[stderr]"$'\n'"$err"}[exit $code]"$'\n'
    got=${got//"$scratch"/SCRATCH}
    [ ! -e "$file" ] || IFS= read -r -d '' expected <"$file" || true
    if [ "${TARTAN_UPDATE:-}" = 1 ]; then
        mkdir -p "$goldens"
        printf '%s' "$got" >"$file"
    elif [ "$got" != "$expected" ]; then
        fail "$1 is not as expected:"
        diff -u "$file" - <<<"${got%$'\n'}" || true
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
