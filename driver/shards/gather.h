/* Puts the shards of a set together into one file. */
#ifndef TARTAN_DRIVER_SHARDS_GATHER_H
#define TARTAN_DRIVER_SHARDS_GATHER_H

#include "driver/shards/set.h"

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

/* The same of a set of answers that is complete. */
tn_status tn_shards_gather_answers(const tn_gathering *gathering, tn_error *error);

#endif
