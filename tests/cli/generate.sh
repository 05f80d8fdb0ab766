#!/usr/bin/env bash
# Libraries that say what plans are made of, `repeat`, and rules that use themselves: counted, sampled, explained, drawn, exported.
name=generate
. "$(dirname "$0")/golden.bash"

golden check 'tartan check rows.plan'
golden count 'tartan count rows.plan -l bays'
golden count_made_from 'tartan count rows.plan -l quiet'
golden count_middle 'tartan count rows.plan -l wings'
golden count_both_ends 'tartan count rows.plan -l lines --json | head -12'
golden sample 'tartan sample rows.plan 3 -l bays'
golden explain 'tartan explain rows.plan "hall | room | stair | hall | hall" -l bays'
golden explain_end 'tartan explain rows.plan "hall | room | hall | room | hall" -l bays'
golden explain_first 'tartan explain rows.plan "stair | hall | room | hall | room" -l bays'
golden explain_made 'tartan explain rows.plan "hall | room | stair | hall | room" -l bays --full'
golden explain_nested 'tartan explain rows.plan "room | room | hall | room | room" -l wings --full'
golden explain_json 'tartan explain rows.plan "hall | room | stair | hall | hall" -l bays --json | sed -n "/\"beginning\"/,/}/p"'
golden explain_rule 'tartan explain rows.plan "room | hall | room" --rule nested'
golden match 'printf "room | hall | room\nhall | room | hall | room | stair\n" | tartan match rows.plan'
golden schema 'tartan schema rows.plan | sed -n "/bays/,\$p"'
golden regex 'tartan export rows.plan --regex --rule zigzag'
golden prolog 'tartan export rows.plan --prolog | sed -n "/^% .*nested/,/^\$/p"'
golden draw "tartan draw rows.plan --rule bay -o $scratch/bay.svg; grep -o \"<text[^>]*>[^<]*\" $scratch/bay.svg | sed \"s/.*>//\""
golden rule 'tartan rule rows.plan bay'
golden diff "sed 's/1\\.\\.2/1..3/' rows.plan >$scratch/rows.plan; tartan diff rows.plan $scratch/rows.plan -l bays --sample 1"
golden again_disasm 'tartan disasm rows.plan | grep -E "AGAIN|REPEATED|circle|generate"'

finish
