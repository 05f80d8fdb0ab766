#!/usr/bin/env bash
# Meshes of fields and elementary functions have the same bits with vectors of any width, and without: programs built for each say so.
set -u
tests=$(dirname "$TARTAN")/tests
[ -x "$tests/widths_none" ] || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/all.field" <<'END'
use "primitives"
surface p1 = sphere
surface p2 = klein
surface p3 = hunt
surface p4 = roman
surface waves = sin(x)*cos(y) + tan(z/4)*sin(z) + 0.2*noise(x, y, z)
surface powers = pow(abs(x), 1.7) + exp(y/3) + tanh(z)*log(abs(x) + 1) + atan2(y, x) - 6
surface cuts = max(min(abs(x) - 3, floor(y*1.3) - 1, sqrt(z) - 1.2), x % 2 - 1.5)
surface mixed = blend(clamp(x, -2, 3)*x + square(y) - 4, mix(z, x, 0.3), 0.8)
surface poles = 1/x + 0.05*y
surface crumbs = floor(3*sin(91*x + 37*y*x)*cos(77*y + 53*z) + 2*sin(83*z + 41*x))
grid 45
END
"$TARTAN" build "$work/all.field" -o "$work/all.tnb" || exit 1
"$tests/widths_none" none "$work/all.tnb" >"$work/none" || exit 1
[ "$(wc -l <"$work/none")" -gt 25 ] || { echo 'widths: too little is compared' >&2; exit 1; }
compared=0
for width in avx2 avx512f; do
    [ -x "$tests/widths_$width" ] || continue
    "$tests/widths_$width" "$width" "$work/all.tnb" >"$work/$width"
    status=$?
    [ $status = 77 ] && continue
    [ $status = 0 ] || exit 1
    diff "$work/none" "$work/$width" >&2 || { echo "widths: $width gives other bits" >&2; exit 1; }
    compared=$((compared + 1))
done
[ $compared -gt 0 ] || exit 77
