#!/usr/bin/env bash
# The plugin for Neovim knows the files of every notation, and starts the language server for them, once; its comments are what the notation has.
name=neovim
. "$(dirname "$0")/golden.bash"
command -v nvim >/dev/null || { echo 'skipped: Neovim is not installed' && exit 0; }
cd "$scratch" || exit
for notation in $(sed -nE 's/^(FIRST_)?NOTATION\([a-z]+, "\.([a-z]+)".*/\2/p' "$here/../../compiler/notations.def"); do
    cp "$(find "$here/../../stdlib" "$here/../../examples" "$files" -name "*.$notation" | LC_ALL=C sort | head -n 1)" "a.$notation"
    comment='#'
    [ "$notation" != hemls ] || comment='//'
    echo "./a.$notation $notation $comment %s attached answered 0"
done | LC_ALL=C sort >wanted
printf 'rule = = 3\n' >wrong.plan
echo './wrong.plan plan # %s attached answered 1' >>wanted
echo 'servers: tartan' >>wanted
# opened HOW...: what Neovim says of each file. Messages of warnings come later, and are not counted.
opened() {
    XDG_CONFIG_HOME=$scratch XDG_DATA_HOME=$scratch XDG_STATE_HOME=$scratch timeout 120 nvim --headless -i NONE -n "$@" \
        --cmd "let g:tartan_command='$TARTAN'" -c "luafile $here/../neovim.lua" ./a.* ./wrong.plan 2>&1 </dev/null | tr -d '\r'
}
is 'as the settings' "$(opened -u "$here/../../editors/neovim/plugin/tartan.lua")" "$(cat wanted)"
# In a folder of plugins, which are read after Neovim's own.
mkdir -p nvim/plugin
cp "$here/../../editors/neovim/plugin/tartan.lua" nvim/plugin
is 'as a plugin' "$(opened)" "$(cat wanted)"
is 'without the command' "$(TARTAN=/nowhere/tartan opened | grep -c ' alone ')" "$(($(wc -l <wanted) - 1))"
finish
