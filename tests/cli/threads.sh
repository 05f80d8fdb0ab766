#!/usr/bin/env bash
# The same bytes at any number of threads, bad plans and interpreted rules included, and where no thread can be had; shards put together are
# the whole.
# Slow under sanitizers.
name=threads
. "$(dirname "$0")/golden.bash"
stdlib=$(cd "$here/../../stdlib" && pwd)
shapes=$(cd "$here/../../bench" && pwd)/ten.plan

# Some chunks of plans of all lengths, with mistakes, comments and empty plans among them.
"$TARTAN" sample "$shapes" --trays 1..10 --per-length 700 --seed 5 >"$scratch/kept"
"$TARTAN" sample "$files/sheds.plan" -l any-sheds 20000 --trays 0..9 --seed 5 >"$scratch/sheds"
awk 'NR % 997 == 0 { print "3m roof | 3m" } NR % 1009 == 0 { print "# between" } { print }' "$scratch/sheds" >"$scratch/flawed"
[ "$(wc -c <"$scratch/sheds")" -gt 600000 ] || fail 'too few plans for several chunks'

# A machine that has no thread left.
echo 'int pthread_create(void *thread, const void *with, void *(*run)(void *), void *argument) { (void)thread, (void)with, (void)run, (void)argument; return 11; }' >"$scratch/alone.c"
cc -shared -fPIC -o "$scratch/alone.so" "$scratch/alone.c"
alone() {
    ASAN_OPTIONS="${ASAN_OPTIONS:-}:verify_asan_link_order=0" LD_PRELOAD="$scratch/alone.so" "$@"
}

# same COMMAND...: the same output, errors and exit code at 1 to 8 threads, and where 8 cannot be had.
same() {
    local threads code
    for threads in 1 2 3 4 5 6 7 8; do
        code=0
        "$@" --threads "$threads" >"$scratch/out.$threads" 2>"$scratch/err.$threads" || code=$?
        echo "exit $code" >>"$scratch/out.$threads"
        cmp -s "$scratch/out.1" "$scratch/out.$threads" || fail "$* differs with $threads threads"
        cmp -s "$scratch/err.1" "$scratch/err.$threads" || fail "$* complains differently with $threads threads"
    done
    code=0
    alone "$@" --threads 8 >"$scratch/out.none" 2>"$scratch/err.none" || code=$?
    echo "exit $code" >>"$scratch/out.none"
    cmp -s "$scratch/out.1" "$scratch/out.none" && cmp -s "$scratch/err.1" "$scratch/err.none" || fail "$* differs where threads cannot be had"
}
for format in bits names json; do
    same "$TARTAN" match "$shapes" "$scratch/kept" --format "$format"
    same "$TARTAN" match "$files/sheds.plan" "$scratch/flawed" --format "$format" --on-error skip
done
grep -q '^exit 1$' "$scratch/out.1" || fail 'bad plans are not noticed'
is 'bad plans' "$(grep -c 'error\[E06' "$scratch/err.1")" "$(grep -c roof "$scratch/flawed")"
same "$TARTAN" match "$files/sheds.plan" "$scratch/flawed" --format bits
is 'up to the first bad plan' "$(wc -l <"$scratch/out.1")" "$(($(grep -n roof "$scratch/flawed" | head -1 | cut -d: -f1)))"
same "$TARTAN" match "$files/sheds.plan" "$scratch/flawed" --format bits --on-error skip --engine vm
same "$TARTAN" prune "$files/sheds.plan" "$scratch/flawed" --library sheds --dropped - --on-error skip
same "$TARTAN" count "$shapes"
same "$TARTAN" check "$shapes" --relations
same "$TARTAN" check "$files/sheds.plan" --library any-sheds --count
same "$TARTAN" grow "$stdlib/square.hemls" -n 6 --explain
same "$TARTAN" grow "$stdlib/ruffle.hemls" -n 5 -o - --format ply
same "$TARTAN" mesh "$stdlib/primitives.field" --surface torus -o - --format ply

# A file is read by all threads side by side, a pipe by one after another: the same answers, and the same lines are
# complained about. Lines longer than what a thread takes at a time, and one past the limit, at its own place.
{
    cat "$scratch/flawed"
    head -c 700000 /dev/zero | tr '\0' '#' && echo
    cat "$scratch/flawed"
    head -c 1500000 /dev/zero | tr '\0' '#' && echo
    head -c 600000 "$scratch/flawed"
} >"$scratch/long"
same "$TARTAN" match "$files/sheds.plan" "$scratch/long" --format json --on-error skip
grep -q "long:$(($(wc -l <"$scratch/flawed") * 2 + 2)):.*E0605" "$scratch/err.1" || fail 'the longest line is not named'
for threads in 1 2 5; do
    "$TARTAN" match "$files/sheds.plan" <"$scratch/long" --format json --on-error skip --threads $threads >"$scratch/redirected" 2>"$scratch/redirected.err" || true
    cat "$scratch/long" | "$TARTAN" match "$files/sheds.plan" --format json --on-error skip --threads $threads >"$scratch/piped" 2>"$scratch/piped.err" || true
    grep -v '^exit' "$scratch/out.1" | cmp -s - "$scratch/redirected" || fail "redirected, $threads threads answer differently"
    cmp -s "$scratch/redirected" "$scratch/piped" || fail "from a pipe, $threads threads answer differently"
    cmp -s "$scratch/redirected.err" "$scratch/piped.err" || fail "from a pipe, $threads threads complain differently"
done
{ head -n 1 >/dev/null && "$TARTAN" match "$files/sheds.plan" --format bits --threads 3 && cat; } <"$scratch/sheds" >"$scratch/rest"
"$TARTAN" match "$files/sheds.plan" "$scratch/sheds" --format bits | tail -c "$(wc -c <"$scratch/rest")" | cmp -s - "$scratch/rest" ||
    fail 'from the middle of a redirected file'

# Other formats are read by one thread, and matched by several.
for format in json csv bin; do
    "$TARTAN" sample "$files/sheds.plan" -l any-sheds 20000 --trays 0..9 --seed 5 --format "$format" -o "$scratch/sheds.$format"
    "$TARTAN" match "$files/sheds.plan" "$scratch/sheds.$format" --format bits --threads 4 >"$scratch/bits.$format"
    "$TARTAN" match "$files/sheds.plan" "$scratch/sheds" --format bits --threads 1 | cmp -s - "$scratch/bits.$format" ||
        fail "$format is matched differently"
done

# Shards of an enumeration, put together.
"$TARTAN" enumerate "$files/sheds.plan" -l any-sheds --trays 0..7 >"$scratch/whole"
for range in 0:1 1:1000 1000:20000 20000:9999999; do
    "$TARTAN" enumerate "$files/sheds.plan" -l any-sheds --trays 0..7 --from "${range%:*}" --to "${range#*:}"
done | cmp -s - "$scratch/whole" || fail 'shards put together are not the whole'
finish
