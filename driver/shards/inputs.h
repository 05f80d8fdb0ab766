/* The files of plans that a set of answers is about, and the pieces that its shards have of them.
 *
 * Plan lines and JSON lines are divided at ends of lines near equal numbers of bytes, packed plans between plans, and
 * Parquet between row groups. What is compressed as a whole, CSV and databases are one piece each.
 */
#ifndef TARTAN_DRIVER_SHARDS_INPUTS_H
#define TARTAN_DRIVER_SHARDS_INPUTS_H

#include "driver/shards/set.h"

/* Fills inputs.items but for their formats. TN_IO (E0901) where there is no such file, TN_INVALID (E1732) where it is
 * no regular one or has a name that a manifest cannot hold, TN_LIMIT (E1705). */
tn_status tn_shard_inputs_find(tn_shard_set *set, const char *const *paths, size_t count, tn_error *error);

/* Divides them among about `shards` shards, with at least one for each file: fills formats, count and pieces. `format`
 * as for readers. TN_LIMIT (E1705), and what opening the files fails with. */
tn_status tn_shard_inputs_divide(tn_shard_set *set, const tn_schema *schema, tn_plan_format format, uint64_t shards,
                                 tn_error *error);

/* Opens what a shard is about: only its piece is read. TN_INVALID (E1733) where the file is not as it was when the set
 * was made. */
tn_status tn_shard_input_open(const tn_shard_set *set, const tn_schema *schema, uint32_t shard, tn_plan_reader **reader,
                              tn_error *error);

/* How many lines (plans, where the format has none) the file has before those of the shard: as the records of shards
 * say, and counted where there is none. */
tn_status tn_shard_lines_before(const tn_shard_set *set, const tn_schema *schema, uint32_t shard, uint64_t *lines,
                                tn_error *error);

#endif
