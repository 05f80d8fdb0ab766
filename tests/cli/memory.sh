#!/usr/bin/env bash
# Needs the parts: mesh
# Every command has a limit of memory, and keeps to it whatever takes the memory: exit 4, what the limit is, and what to do; no file is left
# half written. Where the system itself gives no more, it ends as well in order.
name=memory
. "$(dirname "$0")/golden.bash"
stdlib=$(cd "$here/../../stdlib" && pwd)
bench=$(cd "$here/../../bench" && pwd)
sheds=$files/sheds.plan
case $(nm -D "$TARTAN" | grep -o '__[at]san_init' | head -n 1) in
__asan_init | __tsan_init) # most of what the process holds is the sanitizer's then
    echo 'the limit of memory is tested in builds without sanitizers'
    exit 77
    ;;
esac

# within LIMIT COMMAND...: ends with E0841 and holds at most the limit, its grace, and what two measurements are apart.
within() {
    local limit=$1 code=0 peak
    shift
    rm -f "$scratch"/o.*
    /usr/bin/time -f %M -o "$scratch/peak" "$TARTAN" "$@" --memory-limit "$limit" >"$scratch/out" 2>"$scratch/err" || code=$?
    peak=$(($(tail -n 1 "$scratch/peak") / 1024))
    [ $code = 4 ] || fail "exit $code: $* ($(tail -n 2 "$scratch/err"))"
    is "errors of $*" "$(grep -c '^error\[E0841\]' "$scratch/err")" 1
    grep -q 'help: .*--memory-limit' "$scratch/err" || fail "no help: $*"
    [ "$peak" -le $((limit + limit / 8 + 32 + 150)) ] || fail "$peak MB with a limit of $limit MB: $*"
    ! ls "$scratch"/o.* >/dev/null 2>&1 || fail "a file is written: $*"
}
"$TARTAN" sample "$bench/ten.plan" 400000 --seed 1 >"$scratch/plans"
cat >"$scratch/large.pcfg" <<'GRAMMAR'
Start -> 'PlaceBoundingBox(4,4,4)' 'Place(3003)' 'FillRectNoCheck(1000000,1000000,1000000)'
GRAMMAR
cat >"$scratch/large.study" <<'STUDY'
evolution { grammar "arithmetic"; match "x"; initialise random; population 1000000; generations 2; codons 500 }
STUDY
within 100 count "$sheds" -l any-sheds --trays 2..20000 --max-length 20000
within 200 count "$sheds" -l any-sheds --trays 2..20000 --max-length 20000
within 100 enumerate "$sheds" -l any-sheds --trays 2..20000 --max-length 20000 -o "$scratch/o.txt"
within 100 sample "$bench/ten.plan" 40000000 -o "$scratch/o.txt"
within 60 grow "$stdlib/square.hemls" -n 11 -o "$scratch/o.obj" --each-step
within 70 grow "$stdlib/square.hemls" -n 9 -o "$scratch/o.svg"
within 70 grow "$stdlib/square.hemls" -n 8 --subdivide 5 -o "$scratch/o.obj"
within 150 mesh "$stdlib/primitives.field" --surface torus --grid 1000 -o "$scratch/o.obj"
within 150 mesh "$stdlib/primitives.field" --surface torus --grid 200 --subdivide 6 -o "$scratch/o.obj"
within 60 place "$scratch/large.pcfg" -o "$scratch/o.ldr"
within 200 evolve "$scratch/large.study" -o "$scratch/run"

# The limit is the most, not a step on the way: what fits is done.
"$TARTAN" grow "$stdlib/square.hemls" -n 6 -o "$scratch/o.obj" --memory-limit 200 2>"$scratch/err" || fail 'what fits is refused'
[ ! -s "$scratch/err" ] || fail "what fits is complained about: $(head -n 1 "$scratch/err")"

# In JSON it is a diagnostic like others.
exits 4 "$TARTAN" count "$sheds" -l any-sheds --trays 2..20000 --max-length 20000 --memory-limit 100 --diagnostics json
python3 -c 'import json, sys; found = json.load(sys.stdin); assert any(d["code"] == "E0841" and "--memory-limit" in d["help"] for d in found), found' <"$scratch/err" ||
    fail 'no E0841 in JSON'

# The system's own limit: half of what it leaves is the command's, and GMP, which ends a program that gets no memory, is asked nothing large.
for limit in 60000 80000 120000 200000 400000; do
    for command in "count $sheds -l any-sheds --trays 2..20000 --max-length 20000" "sample $bench/ten.plan 4000000" \
        "grow $stdlib/square.hemls -n 10 --threads 2" "mesh $stdlib/primitives.field --surface torus --grid 600" \
        "match $bench/ten.plan $scratch/plans --threads 2"; do
        code=0
        # shellcheck disable=SC2086
        (ulimit -v $limit && exec "$TARTAN" $command >/dev/null 2>"$scratch/err") || code=$?
        case $code in
        0 | 4) ;;
        *) fail "exit $code with $limit kB of addresses: $command ($(tail -n 1 "$scratch/err"))" ;;
        esac
    done
done
finish
