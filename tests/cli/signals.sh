#!/usr/bin/env bash
# Commands answer an interrupt soon, whatever they are at, and say what is missing: a fixed share of all commands, which ones the seed
# says. SIGNALS=N sends N of them to each, SHARE=N chooses so many commands (0: all), SEED=N others.
# Slow under sanitizers.
name=signals
. "$(dirname "$0")/golden.bash"
python3 "$here/signals.py" "$TARTAN" "$here/../.." "$scratch" "${SIGNALS:-1}" "${SHARE:-6}" "${SEED:-26}" || fail 'see above'
finish
