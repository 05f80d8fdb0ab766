#!/bin/sh
while IFS= read -r line; do printf '1\n1\n'; done
