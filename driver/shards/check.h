/* Looks a shard set over: which shards are there, and whether they are what they should be. */
#ifndef TARTAN_DRIVER_SHARDS_CHECK_H
#define TARTAN_DRIVER_SHARDS_CHECK_H

#include "driver/shards/set.h"

/* Is the shard that of its record (where that is there), and does it hold the plans of its ranks, if any? TN_INVALID
 * (E1706), TN_STOPPED. */
tn_status tn_shard_check(const tn_shard_set *set, const tn_ready_library *ready, uint32_t shard, tn_watch *watch,
                         tn_error *error);

/* Are all shards there with their records? TN_INVALID (E1707) says how many are not. */
tn_status tn_shards_complete(const tn_shard_set *set, tn_error *error);

/* Is there no file among the shards that the set does not know? TN_INVALID (E1708): a program that reads all files of
 * the folder would take it for a shard. */
tn_status tn_shards_no_strangers(const tn_shard_set *set, tn_error *error);

#endif
