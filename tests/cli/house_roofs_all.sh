#!/usr/bin/env bash
# Needs the parts: mesh
# More roofs at random; cli.house_roofs has some of them.
# Takes long
TARTAN_SEEDS=$(seq -s ' ' 1 20) exec bash "$(dirname "$0")/house_roofs.sh"
