#!/usr/bin/env bash
# rank and unrank: inverse to each other; plans that are not there are refused with the reason.
name=rank
. "$(dirname "$0")/golden.bash"

golden unrank 'tartan unrank sheds.plan 0 -l sheds; tartan unrank sheds.plan 3 -l sheds --json'
golden rank "tartan rank sheds.plan '3m door | 6m - | 3m door' -l sheds"
golden rank_json "tartan rank sheds.plan '{\"trays\":[{\"door\":true}]}' -l sheds"
golden dropped "tartan rank sheds.plan '3m door | 3m door | 6m -' -l sheds"
golden too_long "tartan rank sheds.plan '3m - | 3m - | 3m - | 3m -' -l sheds"
golden not_a_plan "tartan rank sheds.plan '3m dor' -l sheds"
golden no_such_rank 'tartan unrank sheds.plan 99999999999999999999999999 -l sheds'
golden empty_plan "tartan rank sheds.plan '' -l any-sheds; tartan unrank sheds.plan 0 -l any-sheds"

kept=$("$TARTAN" enumerate "$files/sheds.plan" -l sheds | wc -l)
for ((rank = 0; rank < kept; rank++)); do
    is "rank of unrank $rank" "$("$TARTAN" rank "$files/sheds.plan" "$("$TARTAN" unrank "$files/sheds.plan" $rank -l sheds)" -l sheds)" "$rank"
done
big=123456789012345678901234567890
is 'a big rank' "$("$TARTAN" rank "$files/sheds.plan" "$("$TARTAN" unrank "$files/sheds.plan" $big -l any-sheds --trays 0..60)" -l any-sheds --trays 0..60)" $big
finish
