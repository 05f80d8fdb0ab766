#!/usr/bin/env bash
# check, build and disasm.
name=build
. "$(dirname "$0")/golden.bash"

golden check_good 'tartan check sheds.plan'
golden check_two "printf 'rule x = tray(door\n' >$scratch/bad.plan; tartan check sheds.plan $scratch/bad.plan"
golden check_missing 'tartan check nowhere.plan'
golden check_folder "tartan check $scratch"
golden build_module "tartan build sheds.plan -o $scratch/a.tnb; tartan build $scratch/a.tnb -o $scratch/b.tnb"
golden disasm_rule 'tartan disasm sheds.plan --rule door-pair'
golden damaged "printf 'XX' | dd of=$scratch/a.tnb bs=1 seek=60 conv=notrunc 2>/dev/null; tartan count $scratch/a.tnb"

(cd "$scratch" && "$TARTAN" build "$files/sheds.plan")
[ -f "$scratch/sheds.tnb" ] || fail 'the module is not named after the rule file'
cp "$scratch/sheds.tnb" "$scratch/again.tnb"
(cd "$scratch" && "$TARTAN" build "$files/sheds.plan")
cmp -s "$scratch/sheds.tnb" "$scratch/again.tnb" || fail 'building twice gives two modules'
cmp -s <("$TARTAN" disasm "$scratch/sheds.tnb") <("$TARTAN" disasm "$files/sheds.plan") || fail 'a module lists otherwise than its source'
"$TARTAN" build - -o "$scratch/in.tnb" <"$files/sheds.plan"
[ -s "$scratch/in.tnb" ] || fail 'nothing is built from standard input'
finish
