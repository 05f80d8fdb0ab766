#!/usr/bin/env bash
# Every command answers an interrupt soon, whatever it is at, and says what is missing. SIGNALS=N sends N of them to each.
# Slow under sanitizers.
name=signals
. "$(dirname "$0")/golden.bash"
python3 "$here/signals.py" "$TARTAN" "$here/../.." "$scratch" "${SIGNALS:-1}" || fail 'see above'
finish
