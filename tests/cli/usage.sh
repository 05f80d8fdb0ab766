#!/usr/bin/env bash
# Wrong usage is told in words, with what was probably meant, and exits with 2.
name=usage
. "$(dirname "$0")/golden.bash"

# No command has an option twice.
for command in $("$TARTAN" help | sed -n 's/^  \([a-z-]*\)  .*/\1/p'); do
    twice=$("$TARTAN" help "$command" | grep -oE '^ +(-[a-zA-Z], )?--[a-z-]+' | grep -oE -- '--[a-z-]+' | sort | uniq -d)
    [ -z "$twice" ] || fail "$command has options twice: $twice"
done

golden no_command 'tartan'
golden unknown_command 'tartan cuont sheds.plan'
golden hopeless_command 'tartan xyzzy'
golden unknown_global_option 'tartan --verison'
golden file_before_command 'tartan sheds.plan'
golden command_after 'tartan --json count sheds.plan'
golden shortened_option 'tartan count sheds.plan --lib sheds'
golden unknown_option 'tartan count sheds.plan --librry x'
golden unknown_option_with_value 'tartan count sheds.plan --librry=x'
golden unknown_letter 'tartan count -q sheds.plan'
golden negative_number 'tartan sample sheds.plan -1'
golden number_as_option 'tartan sample sheds.plan -n 4'
golden number_as_long_option 'tartan best sheds.plan --count=3 --least price'
golden option_by_other_name 'tartan best sheds.plan --min price'
golden plan_before_file 'tartan explain "3m shed | 6m shed" sheds.plan'
golden empty_name 'tartan count sheds.plan -o ""'
golden text_twice 'tartan count sheds.plan -o a.svg --output b.svg'
golden missing_argument 'tartan count sheds.plan --library'
golden option_as_argument 'tartan count sheds.plan --library --json'
golden option_as_number 'tartan count sheds.plan --threads -l sheds'
golden flag_with_argument 'tartan count sheds.plan --json=yes'
golden bad_choice 'tartan match sheds.plan --format bit'
golden bad_number 'tartan count sheds.plan --threads many'
golden number_out_of_range 'tartan count sheds.plan --threads 0'
golden huge_number 'tartan count sheds.plan --max-states 99999999999999999999999999'
golden bad_range 'tartan count sheds.plan --trays 1-3'
golden empty_range 'tartan count sheds.plan --trays 3..1'
golden empty_stretch 'tartan enumerate sheds.plan -l sheds --from 5 --to 3'
golden bad_rank 'tartan enumerate sheds.plan --from -1'
golden bad_rank_operand 'tartan unrank sheds.plan twelve'
golden missing_operand 'tartan count'
golden missing_operand_of_forms 'tartan check'
golden too_many_operands 'tartan count sheds.plan sheds.plan'
golden operands_exchanged 'tartan sample 5 sheds.plan'
golden no_sample_size 'tartan sample sheds.plan'
golden bad_sample_size 'tartan sample sheds.plan some'
golden sample_length_and_per_length 'tartan sample sheds.plan --per-length 2 --length 3'
golden two_inputs 'tartan match - -'
golden text_as_picture 'tartan enumerate sheds.plan -l sheds -o plans.svg'
golden nothing_to_relate 'tartan check ../../../stdlib/words.bnf --relations'
golden unknown_runs 'tartan runs sow hello.run'
golden resume_without_output 'tartan enumerate sheds.plan --resume'
golden draw_without_output 'tartan draw sheds.plan --sample 2 --library sheds'
golden draw_extension 'tartan draw sheds.plan --sample 2 --library sheds -o sheet.gif'
golden draw_two_sources 'tartan draw sheds.plan plans.txt --sample 2 -o sheet.svg'
golden unknown_library 'tartan count sheds.plan --library shed'
golden several_libraries 'tartan count sheds.plan'
golden unknown_rule 'tartan match sheds.plan --rule door-pairs'
golden json 'tartan count sheds.plan --diagnostics json --librry x'
golden json_afterwards 'tartan count sheds.plan --librry x --diagnostics=json'
golden json_no_command 'tartan cuont sheds.plan --diagnostics json'
golden help_unknown 'tartan help rnak'

# A file of another notation than the command is about: which command takes it.
golden no_coverage_of_kits 'for file in bricks table; do tartan test $file --coverage; tartan test $file --write-tests; done'
golden no_tests_in_growth 'tartan test ../../../stdlib/square.hemls --coverage'
golden no_tests_in_grammar 'tartan test ../../../stdlib/words.bnf'
golden no_library_in_growth 'tartan count ../../../stdlib/square.hemls'
golden no_rules_in_study 'tartan match ../../../examples/learning-a-rule/learn.study -'
golden no_growth_in_rules 'tartan grow sheds.plan -o x.obj'
golden no_schema_in_grammar 'tartan draw ../../../stdlib/words.bnf - -o x.svg'
: >"$scratch/empty.plan"
golden nothing_to_check "tartan check $scratch/empty.plan"

# Everything after -- is an operand.
exits 3 "$TARTAN" count -- --json
exits 0 "$TARTAN" count "$files/sheds.plan" -l sheds
exits 0 "$TARTAN" count "$files/sheds.plan" -lsheds
exits 0 "$TARTAN" count "$files/sheds.plan" --library=sheds
exits 0 "$TARTAN" --version
finish
