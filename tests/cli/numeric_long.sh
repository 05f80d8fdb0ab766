#!/usr/bin/env bash
# Every elementary function at 10^7 points is within 1 ulp of MPFR's value.
# Takes long: some minutes.
set -euo pipefail
unit=$(dirname "$TARTAN")/tests/unit_math
[ -e "$unit" ] && nm -D "$unit" | grep -q mpfr_ || exit 77
TARTAN_NUMERIC_POINTS=10000000 "$unit" elementary
