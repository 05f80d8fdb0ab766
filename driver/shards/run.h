/* Writes the shards of a set that are not there yet, together with whoever else does. */
#ifndef TARTAN_DRIVER_SHARDS_RUN_H
#define TARTAN_DRIVER_SHARDS_RUN_H

#include "driver/shards/set.h"

typedef struct tn_shards_job {
    const tn_shard_set *set;
    const tn_opened *opened; /* the set's module and library, which agree with it */
    const tn_ready_library *ready;
    uint32_t begin, end; /* which shards */
    unsigned threads;
    double stale;   /* seconds after which a claim that nobody touches is taken over */
    double seconds; /* after which no shard is begun, nor one that would take longer; 0: any number */
    tn_watch *watch;
} tn_shards_job;

typedef struct tn_shards_done {
    uint32_t written; /* by this call */
    uint32_t left;    /* of those asked for */
    bool out_of_time;
} tn_shards_done;

/* Returns when all those shards are there, time is up, the watch stops it (TN_STOPPED), or one could not be written:
 * then those that were begun are finished, and the error names the shard. Shards that others hold are waited for.
 * `done` is filled in any case. */
tn_status tn_shards_run(const tn_shards_job *job, tn_shards_done *done, tn_error *error);

#endif
