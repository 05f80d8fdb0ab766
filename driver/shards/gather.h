/* The shards of a set together: which are there and whether they are what they should be, and all of them as one file.
 */
#ifndef TARTAN_DRIVER_SHARDS_GATHER_H
#define TARTAN_DRIVER_SHARDS_GATHER_H

#include "driver/shards/set.h"

/* Looks a shard set over: which shards are there, and whether they are what they should be. */

/* Is the shard that of its record (where that is there), and does it hold the plans of its ranks, if any? TN_INVALID
 * (E1706), TN_STOPPED. */
tn_status tn_shard_check(const tn_shard_set *set, const tn_ready_library *ready, uint32_t shard, tn_watch *watch,
                         tn_error *error);

/* Are all shards there with their records? TN_INVALID (E1707) says how many are not. */
tn_status tn_shards_complete(const tn_shard_set *set, tn_error *error);

/* Is there no file among the shards that the set does not know? TN_INVALID (E1708): a program that reads all files of
 * the folder would take it for a shard. */
tn_status tn_shards_no_strangers(const tn_shard_set *set, tn_error *error);

typedef struct tn_gathering {
    const tn_shard_set *set;
    const tn_opened *opened; /* the set's module and library */
    const tn_ready_library *ready;
    const char *output;    /* "-": standard output */
    tn_plan_format format; /* that of the shards: copied byte by byte where they are not compressed. Otherwise the plans
                              are read and written again */
    tn_watch *watch;
} tn_gathering;

/* Writes what one `tartan enumerate` of the set's ranks would write, or one `tartan match` or `tartan prune` of each of
 * its files, byte for byte. Each shard is held against its
 * record before. A file is put in place whole or not at all; a database keeps its whole batches where it is stopped.
 * TN_INVALID (E1706, E1707), TN_STOPPED, TN_IO. */
tn_status tn_shards_gather(const tn_gathering *gathering, tn_error *error);

#endif
