#!/bin/sh
while IFS= read -r line; do printf 'what \033[31m a pity\n'; done
