#!/bin/sh
# Writes the shards of a set by a Slurm array: sbatch slurm.sh SET
# Every task is a worker. Where shards are left when time is up, submit it again: it goes on.
#SBATCH --job-name=shards
#SBATCH --array=1-4
#SBATCH --cpus-per-task=1
#SBATCH --time=60
#SBATCH --requeue
#SBATCH --output=shards-%A-%a.log
#SBATCH --open-mode=append
exec tartan shards run "$1" --threads "${SLURM_CPUS_PER_TASK:-1}" --for 55m
