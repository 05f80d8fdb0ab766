#!/bin/sh
# Answers one line, and ends: a new one is started for each.
IFS= read -r line
line=${line#*sentence}
echo ${#line}
