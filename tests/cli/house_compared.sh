#!/usr/bin/env bash
# Rules that compare what is added up over houses, such as their costs: the same houses by all three engines.
# Slow under sanitizers.
name=house_compared
. "$(dirname "$0")/golden.bash"

cd "$files"

# numbers FILE LIBRARY CONDITION: houses of the interpreter, plan by plan, and counted together
numbers() {
    cp "$1" "$scratch/one.plan"
    printf 'rule asked = %s\n' "$3" >>"$scratch/one.plan"
    "$TARTAN" match "$scratch/one.plan" "$scratch/some" --rule asked --format bits 2>/dev/null | paste - "$scratch/some" |
        sed -n 's/^1\t//p' >"$scratch/matched"
    "$TARTAN" enumerate "$1" -l "$2" --where "$3" >"$scratch/listed"
    grep -Fx -f "$scratch/listed" "$scratch/some" >"$scratch/wanted" || true # perhaps none
    cmp -s "$scratch/matched" "$scratch/wanted" && echo 'the same houses' || echo 'other houses'
    "$TARTAN" count "$1" -l "$2" --where "$3" --by floors --json |
        python3 -c 'import json, sys; print(json.load(sys.stdin)["houses"])'
    wc -l <"$scratch/listed"
}

# compared FILE LIBRARY: with the conditions of standard input, one a line
compared() {
    local condition
    "$TARTAN" enumerate "$1" -l "$2" | awk 'NR % 20 == 1' >"$scratch/some"
    while read -r condition; do
        mapfile -t seen < <(numbers "$1" "$2" "$condition")
        is "$condition: engines" "${seen[0]}" 'the same houses'
        is "$condition: together" "${seen[1]}" "${seen[2]}"
    done
}

compared climbed.plan climbs <<'END'
price <= 16254
price in 17014..17016
price = 17014.92
END
compared priced.plan barns <<'END'
price <= 44000
price < 20000 or price > 55000
price in 40000..46000
not price in 40000..46000
price = 44000
floors >= 30m2
offer <= 60000 and floors > 400sf
price <= 1000 * floors / 1m2
price <= 44000 and not tray(14')
tray(14') implies price > 40000
price + 2000 * quantity(tray(14')) <= 46000
quantity(cell(living)) + 2 * quantity(room(living)) >= 8
END

# Ranks: each house of the library with a requirement by its number, and back.
"$TARTAN" enumerate priced.plan -l barns --where 'price <= 20000' >"$scratch/cheap"
is 'unrank' "$(for i in 0 7 20 $(($(wc -l <"$scratch/cheap") - 1)); do "$TARTAN" unrank priced.plan -l barns --where 'price <= 20000' $i; done)" \
    "$(sed -n '1p;8p;21p;$p' "$scratch/cheap")"

golden count 'tartan count priced.plan -l barns --where "price <= 44000"'
golden best 'tartan best priced.plan 2 -l barns --most floors --where "price <= 44000"'
golden front 'tartan pareto priced.plan -l barns --most floors --least price --where "price > 30000"'
golden kept_apart 'tartan unrank priced.plan -l barns --where "price <= 44000" --max-states 50 4000'
golden places 'tartan count priced.plan -l barns --where "price + occurrences(neighbour(any, any)) <= 44000" --by floors'
golden nothing 'tartan count priced.plan -l barns --where "price < 0"'

cat >"$scratch/rules.plan" <<END
use "$PWD/priced.plan"
rule dear = price > 43000 and floors < 700sf
library cheap from rows in barn-form {
  require option(body roof gable)
  require price <= 44000
  prune 60 * floors / 1sf > price as spacious
}
test cheap {
  keep [10' room:14' porch:6' ; 1 gable(9:12,eaves-1'6",open) 1 flat(eaves-1') ; living porch-deck ; - ; benches.back]
  drop [14' hall:18' porch:6' | 14' hall:18' porch:6' ; 2 gable(9:12,eaves-1'6",open) 1 shed(front,12:12,open) ; living void porch-deck | living void porch-deck ; wall ; benches.back benches.back] by require@5
}
END
golden tests 'tartan test $scratch/rules.plan | tail -n 1'
golden relations 'tartan check --relations $scratch/rules.plan 2>/dev/null'
sed -n 1600p "$scratch/some" >"$scratch/house"
golden explain 'tartan explain $scratch/rules.plan --library cheap --full "$(cat $scratch/house)" 2>/dev/null'
golden explain_json 'tartan explain $scratch/rules.plan --library cheap --json "$(cat $scratch/house)" 2>/dev/null | python3 -c "import json, sys; print([c[\"why\"] for c in json.load(sys.stdin)[\"clauses\"]])"'
golden vary 'tartan vary $scratch/rules.plan --library cheap "$(sed -n 8p $scratch/cheap)" 2>/dev/null'
golden disassembled 'tartan disasm $scratch/rules.plan 2>/dev/null | grep -A 9 "(whole dear)" | grep HOUSE_'

finish
