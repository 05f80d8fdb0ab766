#!/usr/bin/env bash
# test: passes silently, and says of failures what was expected, of which plan, by which rule.
name=test
. "$(dirname "$0")/golden.bash"

golden passing 'tartan test sheds.plan'
golden failing 'tartan test failing.plan'
golden failing_json 'tartan test failing.plan --diagnostics json'
golden two_files 'tartan test sheds.plan failing.plan 2>/dev/null'
golden module "tartan build sheds.plan -o $scratch/sheds.tnb; tartan test $scratch/sheds.tnb"
golden missing 'tartan test nowhere.plan'
finish
