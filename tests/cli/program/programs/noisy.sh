#!/bin/sh
# Says more on standard error than a pipe holds, and answers all the same.
while IFS= read -r line; do
    head -c 200000 /dev/zero | tr '\0' x >&2
    line=${line#*sentence}
    echo ${#line}
done
