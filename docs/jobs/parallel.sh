#!/bin/sh
# Writes the shards of a set by GNU parallel: parallel.sh SET WORKERS [options of parallel, as --sshlogin HOST,HOST --workdir .]
set=$1 workers=$2
shift 2
seq "$workers" | exec parallel --will-cite -N0 --jobs "$workers" "$@" tartan shards run "$set" --threads 1
