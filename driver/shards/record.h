/* What a shard holds, and whether it is what it should be.
 *
 * A record is a small file beside a shard. It says which set the shard belongs to, which of its shards it is, and its
 * size and hash. A shard with such a record is done. A shard without one is written again: nothing else could say
 * that it is not that of another set.
 */
#ifndef TARTAN_DRIVER_SHARDS_RECORD_H
#define TARTAN_DRIVER_SHARDS_RECORD_H

#include "driver/shards/set.h"

typedef struct tn_shard_file {
    uint64_t bytes;
    char hash[33];
} tn_shard_file;

/* files: as many as tn_shard_files says. */
typedef struct tn_shard_record {
    tn_shard_file files[TN_HOUSE_TABLES];
    uint64_t lines, unread; /* answers: of the piece, and plans of it that could not be read */
} tn_shard_record;

#define TN_COMPLAINTS_KEPT 100u /* of a shard */

/* What was found while a shard of answers was written. */
typedef struct tn_shard_read {
    uint64_t lines, unread;
    tn_error complaints[TN_COMPLAINTS_KEPT]; /* about the first that could not be read; lines count from the shard's */
} tn_shard_read;

/* Is the shard's own file there? A file is a regular one here: no worker waits for what is no file. */
bool tn_shard_exists(const tn_shard_set *set, uint32_t shard);

/* Is it there, with a record of any kind? */
bool tn_shard_recorded(const tn_shard_set *set, uint32_t shard);

/* Is a shard that is there with a record done: is the record of this set and this shard, and is the shard as long as it
 * says? TN_INVALID (E1706). */
tn_status tn_shard_done(const tn_shard_set *set, uint32_t shard, tn_error *error);

/* Writes the record of a shard, with what was read for it (NULL: it holds no answers). TN_IO (E0902). */
tn_status tn_shard_record_write(const tn_shard_set *set, uint32_t shard, const tn_shard_record *record,
                                const tn_shard_read *read, tn_error *error);

/* Fills it by the files that are there. */
tn_status tn_shard_record_files(const tn_shard_set *set, uint32_t shard, tn_shard_record *record, tn_error *error);

/* Reads what the record says was found. TN_INVALID (E1706) as of tn_shard_record_read. */
tn_status tn_shard_read_of(const tn_shard_set *set, uint32_t shard, tn_shard_read *read, tn_error *error);

/* Reads the record: TN_INVALID (E1706) where it is none, of another set, of another shard or of another version. */
tn_status tn_shard_record_read(const tn_shard_set *set, uint32_t shard, tn_shard_record *record, tn_error *error);

/* Is the shard's file that of its record? TN_INVALID (E1706). */
tn_status tn_shard_same_as_record(const tn_shard_set *set, uint32_t shard, tn_error *error);

/* Reads the shard through: as many plans as it should have, the first and the last those of its ranks? TN_INVALID
 * (E1706), TN_STOPPED by the watch. */
tn_status tn_shard_read_through(const tn_shard_set *set, const tn_ready_library *ready, uint32_t shard, tn_watch *watch,
                                tn_error *error);

/* E1706 with what is wrong with a shard, and what to do about it. Returns TN_INVALID. */
tn_status tn_shard_wrong(const tn_shard_set *set, uint32_t shard, tn_error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
