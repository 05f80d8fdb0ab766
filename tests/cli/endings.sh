#!/usr/bin/env bash
# Needs the parts: draw mesh store
# Files are what their names promise, whatever command writes them; other names are refused, with the endings that there are.
# Slow under sanitizers.
name=endings
. "$(dirname "$0")/golden.bash"
is 'files of every ending' "$(python3 "$here/../endings.py" "$TARTAN" 4)" fine
finish
