#!/bin/sh
while IFS= read -r line; do echo '{"id": 123456, "score": 1}'; done
