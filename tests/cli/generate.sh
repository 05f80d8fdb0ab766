#!/usr/bin/env bash
# Libraries that say what plans are made of, `repeat`, and rules that use themselves: counted, sampled, explained, drawn, exported.
name=generate
. "$(dirname "$0")/golden.bash"

golden check 'tartan check bays.plan'
golden count 'tartan count bays.plan -l bays'
golden count_made_from 'tartan count bays.plan -l quiet'
golden count_middle 'tartan count bays.plan -l wings'
golden count_both_ends 'tartan count bays.plan -l lines --json | head -12'
golden sample 'tartan sample bays.plan 3 -l bays'
golden explain 'tartan explain bays.plan "hall | room | stair | hall | hall" -l bays'
golden explain_end 'tartan explain bays.plan "hall | room | hall | room | hall" -l bays'
golden explain_first 'tartan explain bays.plan "stair | hall | room | hall | room" -l bays'
golden explain_made 'tartan explain bays.plan "hall | room | stair | hall | room" -l bays --full'
golden explain_nested 'tartan explain bays.plan "room | room | hall | room | room" -l wings --full'
golden explain_json 'tartan explain bays.plan "hall | room | stair | hall | hall" -l bays --json | sed -n "/\"beginning\"/,/}/p"'
golden explain_rule 'tartan explain bays.plan "room | hall | room" --rule nested'
golden match 'printf "room | hall | room\nhall | room | hall | room | stair\n" | tartan match bays.plan'
golden schema 'tartan schema bays.plan | sed -n "/bays/,\$p"'
golden regex 'tartan export bays.plan --regex --rule zigzag'
golden prolog 'tartan export bays.plan --prolog | sed -n "/^% .*nested/,/^\$/p"'
golden draw "tartan draw bays.plan --rule bay -o $scratch/bay.svg; grep -o \"<text[^>]*>[^<]*\" $scratch/bay.svg | sed \"s/.*>//\""
golden rule 'tartan rule bays.plan bay'
golden diff "sed 's/1\\.\\.2/1..3/' bays.plan >$scratch/bays.plan; tartan diff bays.plan $scratch/bays.plan -l bays --sample 1"
golden again_disasm 'tartan disasm bays.plan | grep -E "AGAIN|REPEATED|circle|generate"'

finish
