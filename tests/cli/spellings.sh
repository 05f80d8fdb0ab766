#!/usr/bin/env bash
# A plan in each of its spellings, where a command takes one: a line, in brackets, an open plan that stands for one; and what is said of
# those that stand for several or for none.
name=spellings
. "$(dirname "$0")/golden.bash"

line='2m fish - wood:600mm | 3m fruit covered none'
literal='[2m | 3m fruit covered counter none]'
open='front 2m, fish, not covered, counter wood 600mm | 3m fruit covered counter none'
in_rule='tray(2m, fish, not covered, counter wood 600mm) | tray(3m, fruit, covered, counter none)'

# All of them are one plan to each command.
for command in explain rank 'explain --json' 'rank --json' complete 'complete --json'; do
    read -r verb option <<<"$command"
    expected=$("$TARTAN" $verb "$files/spellings.plan" "$line" $option)
    for text in "$literal" "$open" "plan [$open]" "[$in_rule]" "$in_rule"; do
        [ "$("$TARTAN" $verb "$files/spellings.plan" "$text" $option 2>/dev/null)" = "$expected" ] ||
            fail "$command says something else of $text"
    done
done
bays="14' room:14' porch:5' | 14' room:14' none"
for command in 'count --library cottages' 'enumerate --library cottages' 'sample 2 --library cottages' 'best 2 --library cottages --least floor-area'; do
    read -r verb option <<<"$command"
    [ "$("$TARTAN" "$verb" "$files/cabins.plan" $option --plan "[14' | 14' porch none]")" = "$("$TARTAN" "$verb" "$files/cabins.plan" $option --plan "$bays")" ] ||
        fail "$command does not take a plan in brackets"
done

golden several "tartan explain spellings.plan '2m | 3m fruit'"
golden several_in_brackets "tartan rank spellings.plan '[2m | ? | fruit]'"
golden gap "tartan explain spellings.plan '2m | ... | covered'"
golden gap_alone "tartan rank spellings.plan '...'"
golden left_out "tartan rank spellings.plan 'plan [2m fish | fruit, covered]'"
golden none "tartan explain spellings.plan '3m fish | ?'"
golden forbidden "tartan explain spellings.plan '[3m fish | 2m]'"
golden wrong_line "tartan rank spellings.plan '2m fsh - none'"
golden wrong_brackets "tartan rank spellings.plan '[2m fsh | fruit]'"
golden wrong_open "tartan rank spellings.plan '2m fsh | ?'"
golden not_closed "tartan explain spellings.plan '[2m | fruit'"
golden not_opened "tartan explain spellings.plan '2m | fruit]'"
golden complete_brackets "tartan complete spellings.plan '[2m | fruit]'"
golden complete_line "tartan complete spellings.plan '$line'"
golden complete_wrong_line "tartan complete spellings.plan '2m fsh - none'"
golden complete_empty "tartan complete spellings.plan ''"
golden complete_a_house "tartan complete spellings.plan '[2m | fruit ; gable]'"
golden star "tartan complete spellings.plan 'fish | * | fish'"
golden tray_between "tartan complete spellings.plan '2m ? fish'"
golden commas_between "tartan complete spellings.plan 'fish, ..., fish'"
golden plan_as_file "tartan match spellings.plan '$line'"
golden trays_dash "tartan count spellings.plan --trays 2-4"
golden rank_comma "tartan unrank spellings.plan 1,000"
golden in_a_file "echo '[2m | fruit]' | tartan prune spellings.plan"
"$TARTAN" build "$files/spellings.plan" -o "$scratch/spellings.tnb"
golden module "tartan explain $scratch/spellings.tnb '[2m | fruit]'"
golden module_line "tartan rank $scratch/spellings.tnb '$line'"

finish
