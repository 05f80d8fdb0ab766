/* Inside of the reader of manifests. */
#ifndef TARTAN_DRIVER_SHARDS_MANIFEST_READ_H
#define TARTAN_DRIVER_SHARDS_MANIFEST_READ_H

#include <jansson.h>

#include "driver/shards/set.h"

typedef struct tn_manifest_reading {
    tn_shard_set *set;
    json_t *manifest;
    tn_error *error;
} tn_manifest_reading;

/* E1702 with what is wrong. Returns TN_INVALID. */
tn_status tn_manifest_refuse(const tn_manifest_reading *r, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The number of one of these words, which are what `key` can be; NULL words are none. */
tn_status tn_manifest_word(const tn_manifest_reading *r, const char *key, const char *const *words, int count,
                           int *number);

/* Names of formats of plans, as by --format. */
const char *const *tn_manifest_formats(void);

/* What a set of answers is about: all but its shards; and shard i, which is said in `shard`. (manifest_inputs.c) */
tn_status tn_manifest_read_inputs(const tn_manifest_reading *r);
tn_status tn_manifest_read_piece(const tn_manifest_reading *r, uint32_t i, const json_t *shard);
void tn_manifest_write_inputs(const tn_shard_set *set, tn_json *json);
void tn_manifest_write_piece(const tn_shard_piece *piece, tn_json *json);

#endif
