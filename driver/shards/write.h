/* Writes one shard, from its beginning to its end: it is there whole or not at all. */
#ifndef TARTAN_DRIVER_SHARDS_WRITE_H
#define TARTAN_DRIVER_SHARDS_WRITE_H

#include "driver/shards/claim.h"
#include "driver/shards/record.h"
#include "runtime/base/file.h"

/* Which shard, and what is looked at meanwhile. */
typedef struct tn_shard_writing_now {
    uint32_t shard;
    tn_claim *claim; /* touched */
    double stale;
    tn_watch *watch;              /* TN_STOPPED by it */
    const tn_seen_bytes *written; /* sees its bytes */
} tn_shard_writing_now;

/* Plans of the library. `ranks`: how many it has. */
tn_status tn_shard_enumerate(const tn_shard_set *set, const tn_ready_library *ready, const tn_plan_metadata *metadata,
                             mpz_srcptr ranks, const tn_shard_writing_now *now, tn_error *error);

/* What is said of the plans of a piece of a file; fills `read`, which is zero. A plan that cannot be read is what the
 * failure is about, with its line in the whole file, unless the set skips such plans. TN_IO; E1733 as of
 * tn_shard_input_open. */
tn_status tn_shard_answer(const tn_shard_set *set, const tn_answering *answering, const tn_shard_writing_now *now,
                          tn_shard_read *read, tn_error *error);

#endif
