#!/bin/sh
while IFS= read -r line; do echo 1e999; done
