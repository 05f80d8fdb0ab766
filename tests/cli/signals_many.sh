#!/usr/bin/env bash
# A hundred interrupts at random moments of each command; SIGNALS=N sends so many.
# Takes long
SIGNALS=${SIGNALS:-100} exec bash "$(dirname "$0")/signals.sh"
