#!/bin/sh
trap '' TERM INT HUP
while IFS= read -r line; do sleep 1000; done
