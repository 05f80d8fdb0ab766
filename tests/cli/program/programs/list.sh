#!/bin/sh
while IFS= read -r line; do echo '[1, 2, 3]'; done
