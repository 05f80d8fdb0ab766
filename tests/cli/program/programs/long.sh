#!/bin/sh
while IFS= read -r line; do head -c 100000 /dev/zero | tr '\0' 7; done
