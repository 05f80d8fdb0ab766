#!/bin/sh
# Answers short lines; long ones are the end of it.
while IFS= read -r line; do
    line=${line#*sentence}
    [ ${#line} -lt 8 ] || { echo 'out of stones' >&2; exit 3; }
    echo ${#line}
done
