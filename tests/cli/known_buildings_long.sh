#!/usr/bin/env bash
# Buildings of six 2 x 4 bricks: 915,103,765 (OEIS A112389).
# Takes long: some seconds, and minutes where nothing is optimised.
set -euo pipefail
[ "$("$TARTAN" count bricks --part 3001 --parts 6 --json)" = '{"parts":6,"buildings":915103765,"fixed":3660383696,"half_turn":31364,"quarter_turn":0}' ]
