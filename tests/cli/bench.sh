#!/usr/bin/env bash
# Slow under sanitizers.
# Needs the parts: draw mesh
# The programs of the benchmarks still run, and all peers that are here decide as Tartan does. Times are not looked at.
# (bench_gene and bench_breeding are only built: the least they do takes too long for a test.)
name=bench
. "$(dirname "$0")/golden.bash"
bench=$(dirname "$TARTAN")/bench

# runs NAME ARGUMENT...: a line at least, of words and numbers.
runs() {
    "$bench/bench_$1" "${@:2}" >"$scratch/$1.out" 2>"$scratch/$1.err" || fail "bench_$1 failed: $(cat "$scratch/$1.err")"
    [ -s "$scratch/$1.out" ] || fail "bench_$1 printed nothing"
}

"$TARTAN" build bench/ten.plan -o "$scratch/ten.tnb"
runs plan "$scratch/ten.tnb" 300 "$scratch"
for way in 'all tartan' 'all avx2' 'all portable' 'all single' 'all vm' 'all plain' 'any tartan' 'any plain'; do
    grep -q "^$way [0-9.]*$" "$scratch/plan.out" || fail "bench_plan did not time '$way'"
done
is 'plans' "$(wc -l <"$scratch/mask.txt")" 300
for peer in re2 pcre2 hyperscan; do # they compare what they decide with mask.txt
    [ ! -e "$bench/bench_$peer" ] || runs "$peer" "$scratch"
done
if command -v swipl >/dev/null; then
    swipl -q -g main bench/ten.pl -- "$scratch" >/dev/null || fail 'the Prolog rules do not run'
    head -n "$(wc -l <"$scratch/prolog.txt")" "$scratch/mask.txt" | cmp -s - "$scratch/prolog.txt" || fail 'the Prolog rules decide differently'
fi
sed -i '1s/.*/1023/' "$scratch/mask.txt" # which no plan can be: a peer must see that
for peer in re2 pcre2 hyperscan; do
    if [ -e "$bench/bench_$peer" ] && "$bench/bench_$peer" "$scratch" >/dev/null 2>&1; then
        fail "bench_$peer does not compare what it decides"
    fi
done

python3 tests/cli/many_rules.py 20 1 1..3 >"$scratch/many.plan"
python3 bench/editor.py "$TARTAN" "$scratch/many.plan" 1 >"$scratch/editor.out" || fail 'the language server is not timed'
is 'questions' "$(wc -l <"$scratch/editor.out")" 10

runs library "$scratch/ten.tnb" 1000
"$TARTAN" build stdlib/primitives.field -o "$scratch/primitives.tnb"
runs field "$scratch/primitives.tnb" 20 1 1
is 'surfaces that are timed' "$(grep -c '^[a-z]* [0-9]* [0-9.]*$' "$scratch/field.out")" 9
[ ! -e "$bench/bench_vtk" ] || runs vtk 20 1
runs numeric 1
is 'functions that are timed' "$(wc -l <"$scratch/numeric.out")" 9
runs curve "$scratch/ten.tnb" 100 4 10 2
for x in 1 10 100; do echo "plans $x $x"; done >"$scratch/points"
"$bench/bench_plot" "$scratch/points" "$scratch/plot.png" || fail 'bench_plot failed'
[ -s "$scratch/plot.png" ] || fail 'bench_plot drew nothing'

for scene in square triangle forces boundary; do
    runs growth "$scene" 2 2 1
done
"$TARTAN" build examples/brick-wall/wall.pcfg examples/brick-wall/bricks.pcfg -o "$scratch/place.tnb" 2>/dev/null
runs derive "$scratch/place.tnb" 2
runs derive "$scratch/place.tnb" 2 vm
runs solid crowded 30 1
runs solid sphere 30 1
runs solid tables 10 1

for file in huts lofts; do "$TARTAN" build "bench/$file.plan" -o "$scratch/$file.tnb"; done
runs house count "$scratch/huts.tnb" "$scratch/lofts.tnb"
is 'houses that are counted' "$(tail -n 2 "$scratch/house.out" | xargs)" '479616 5450528'
runs house unrank "$scratch/lofts.tnb" 3
runs house glb "$scratch/lofts.tnb" 2 "$scratch"
[ -s "$scratch/1.glb" ] || fail 'bench_house wrote no house'
one="8' room:12' | 8' room:12' | 8' room:12'"
runs house plan "$scratch/lofts.tnb" "$one" 1
two=$("$TARTAN" sample bench/lofts.plan 1 --library loft-rows --plan "$one")
runs house solids "$scratch/lofts.tnb" "$two" 1
runs house vary "$scratch/lofts.tnb" "$two" 1
is 'all that differ in one choice are listed' "$(cut -d' ' -f5 "$scratch/house.out")" "$(cut -d' ' -f6 "$scratch/house.out")"
if command -v swipl >/dev/null; then # on plans of the LaHave House, in all their sections, without tiles and ways
    {
        sed -e '/^  tile /,/^  }/d' -e '/^  way /d' -e '/^  material/d' stdlib/lahave-form.plan
        sed -e '/^use "lahave-form"/d' -e '/^test /,$d' stdlib/lahave-complete.plan
    } >"$scratch/bare.plan"
    sed -i 's/lahave-form/bare-form/' "$scratch/bare.plan"
    while read -r plan; do
        python3 bench/house_facts.py "$plan" >"$scratch/facts.pl"
        is "houses that Prolog counts on $plan" "$(swipl -q -g main bench/house.pl -- "$scratch/facts.pl" </dev/null | cut -d' ' -f1)" \
            "$("$TARTAN" count "$scratch/bare.plan" --library lahave-complete --plan "$plan" 2>/dev/null | sed -n 's/^houses *//p')"
    done <<'END'
8' double public great dense:8' open:12' open:4' | 12' single - great dense:8' open:8' open:3' | 12' single - - dense:8' dense:12' empty | 4' single - - dense:8' open:12' empty | 12' single - - empty open:12' open:3'
8' double public great empty open:12' open:4' | 12' single - great dense:8' open:8' open:3' | 12' single - - dense:8' dense:12' empty | 4' single - - dense:8' open:12' empty | 8' single - - empty open:12' open:4'
12' single - - empty open:12' open:4' | 4' single - - dense:8' open:8' empty | 8' single - - dense:8' dense:12' empty | 12' single - great dense:8' open:12' empty | 8' double public great empty open:12' open:4'
END
fi
runs openmesh cc 2 1
runs openmesh loop 2 1
finish
