#!/bin/sh
# The length of each line from the sentence on, one line at a time.
while IFS= read -r line; do
    line=${line#*sentence}
    echo ${#line}
done
