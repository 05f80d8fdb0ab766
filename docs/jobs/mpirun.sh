#!/bin/sh
# Writes the shards of a set by many ranks: mpirun.sh SET RANKS [options of mpirun, as --hostfile HOSTS]
# Every rank is a worker with one thread. Where the job is killed, start it again: it goes on.
set=$1 ranks=$2
shift 2
exec "${MPIRUN:-mpirun}" -n "$ranks" "$@" tartan shards run "$set" --threads 1
