#!/usr/bin/env bash
# Needs the parts: mesh
# Each roof over one storey and over two; cli.house_solids takes them in turns.
# Takes long
ALL_ROOFS=1 exec bash "$(dirname "$0")/house_solids.sh"
