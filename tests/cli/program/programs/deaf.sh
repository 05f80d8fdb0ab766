#!/bin/sh
# Writes without reading.
while echo 1; do :; done
