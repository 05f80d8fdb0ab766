#!/usr/bin/env bash
# More sentences of the standard library's grammars of forms; cli.form_grammars has some of them.
# Takes long
TARTAN_SENTENCES=400 exec bash "$(dirname "$0")/form_grammars.sh"
