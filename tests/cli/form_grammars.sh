#!/usr/bin/env bash
# What the standard library's grammars of forms promise holds of 60 sentences each; Genr8's own systems are sentences of one.
# Slow under sanitizers.
set -euo pipefail
python3 -B tests/form_grammars.py
square="A + B + A + B ; A -> A [ [ + B ] - B ] A ; B -> B [ [ + A ] - A ] B ; Angle 90 ; BranchAngle 90"
triangle="A + B + C ; A -> A [ [ [ [ + C ] + + B ] - B ] - - C ] A ; B -> B [ [ [ [ + A ] + + C ] - C ] - - A ] B ; \
C -> C [ [ [ [ + B ] + + A ] - A ] - - B ] C ; Angle 60 ; Sync"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for name in square triangle; do
  genome=$("$TARTAN" map genr8-dividing --invert "${!name}")
  "$TARTAN" map genr8-dividing --genome "$genome" | grep -v '^#' >"$scratch/bred.hemls"
  [ "$(cat "$scratch/bred.hemls")" = "${!name}" ]
  # edges of the same kinds, in the same places
  cmp <("$TARTAN" grow "$scratch/bred.hemls" -n 4 -o - --format obj | grep '^[vf]') <("$TARTAN" grow "$name" -n 4 -o - --format obj | grep '^[vf]')
done
