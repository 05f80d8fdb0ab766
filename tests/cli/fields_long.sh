#!/usr/bin/env bash
# The nine primitives on 256 samples: the same bytes with one thread and four, and from the interpreter, which skips no samples.
# Takes long: some minutes.
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for surface in ${SURFACES:-sphere torus crosscap heart hunt klein roman tetrahedral blobby}; do
    "$TARTAN" mesh primitives --surface "$surface" --grid 256 --threads 1 -o "$work/one.ply" 2>/dev/null || exit 1
    for other in '--threads 4' '--engine vm'; do
        # shellcheck disable=SC2086 # two words
        "$TARTAN" mesh primitives --surface "$surface" --grid 256 $other -o "$work/other.ply" 2>/dev/null || exit 1
        cmp "$work/one.ply" "$work/other.ply" || { echo "fields_long: $surface differs with $other" >&2; exit 1; }
    done
done
