#!/bin/sh
while IFS= read -r line; do echo '{"error": "it would fall over"}'; done
