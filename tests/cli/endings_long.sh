#!/usr/bin/env bash
# Needs the parts: draw mesh store
# Files are what their names promise, whatever command writes them; other names are refused, with the endings that there are: every command with every ending.
# Takes long.
name=endings_long
. "$(dirname "$0")/golden.bash"
is 'files of every ending' "$(python3 "$here/../endings.py" "$TARTAN")" fine
finish
