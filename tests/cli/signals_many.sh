#!/usr/bin/env bash
# A hundred interrupts at random moments of every command; SIGNALS=N sends so many.
# Takes long
SIGNALS=${SIGNALS:-100} SHARE=${SHARE:-0} exec bash "$(dirname "$0")/signals.sh"
