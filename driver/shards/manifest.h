/* The manifest of a shard set as text: JSON, with a hash of all before it as its last member. */
#ifndef TARTAN_DRIVER_SHARDS_MANIFEST_H
#define TARTAN_DRIVER_SHARDS_MANIFEST_H

#include "driver/shards/set.h"

#define TN_MANIFEST_VERSION 1 /* raised when older programs could not read it rightly */
#define TN_MANIFEST_NAME "manifest.json"
#define TN_MODULE_NAME "rules.tnb"

/* Appends the manifest, whose hash goes to `hash`, too; false where out of memory. */
bool tn_manifest_write(const tn_shard_set *set, tn_buffer *text, char hash[33]);

/* Ends a manifest with the hash of what it holds so far. */
bool tn_manifest_seal(tn_buffer *text, char hash[33]);

/* Fills all but the folder, which is set. Errors as of tn_shard_set_read. */
tn_status tn_manifest_read(const char *text, size_t size, tn_shard_set *set, tn_error *error);

#endif
