/* Writes the shards of a set that are not there yet, together with whoever else does. */
#ifndef TARTAN_DRIVER_SHARDS_RUN_H
#define TARTAN_DRIVER_SHARDS_RUN_H

#include <stdatomic.h>

#include "driver/shards/set.h"
#include "runtime/ranks/ranks.h"

typedef struct tn_shards_job {
    const tn_shard_set *set;
    const tn_opened *opened; /* the set's module and library, which agree with it */
    const tn_ready_library *ready;
    const tn_answering *answering; /* what is said of plans; NULL where they are enumerated */
    uint32_t begin, end;           /* which shards */
    unsigned threads;
    double stale;   /* seconds after which a claim that nobody touches is taken over */
    double seconds; /* after which no shard is begun, nor one that would take longer; 0: any number */
    tn_watch *watch;
    const atomic_bool *last; /* or NULL: no shard is begun once it is true; those begun are finished */
    const tn_ranks *ranks;   /* or NULL: they take shards from one counter */
} tn_shards_job;

typedef struct tn_shards_done {
    uint32_t written; /* by this call, on all ranks */
    uint64_t unread;  /* plans that were skipped for them */
    uint32_t left;    /* of those asked for, as this rank sees them */
    bool out_of_time;
    bool ended; /* by `last` */
} tn_shards_done;

/* Returns when all those shards are there, time is up, the watch stops it (TN_STOPPED), or one could not be written:
 * then those that were begun are finished, and the error names the shard. Shards that others hold are waited for.
 * `done` is filled in any case.
 *
 * With several ranks it is called together. A rank that cannot write a shard ends, and the others write all that they
 * can; it fails for all of them alike. TN_IO (E1731) where shards were written in a folder that rank 0 does not see. */
tn_status tn_shards_run(const tn_shards_job *job, tn_shards_done *done, tn_error *error);

#endif
