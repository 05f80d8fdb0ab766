/* The manifest of a shard set: JSON, with a hash of all before it as its last member; and sets made and read by it. */
#ifndef TARTAN_DRIVER_SHARDS_MANIFEST_H
#define TARTAN_DRIVER_SHARDS_MANIFEST_H

#include "driver/shards/set.h"

#define TN_MANIFEST_VERSION 1 /* raised when older programs could not read it rightly */

/* Appends the manifest, whose hash goes to `hash`, too; false where out of memory. */
bool tn_manifest_write(const tn_shard_set *set, tn_buffer *text, char hash[33]);

/* Ends a manifest with the hash of what it holds so far. */
bool tn_manifest_seal(tn_buffer *text, char hash[33]);

/* Fills all but the folder, which is set. Errors as of tn_shard_set_read. */
tn_status tn_manifest_read(const char *text, size_t size, tn_shard_set *set, tn_error *error);

/* Makes the folder, with the module and, last, the manifest. hash, module_hash and version are filled. TN_INVALID
 * (E1701) where a set is there already. */
tn_status tn_shard_set_create(tn_shard_set *set, const uint8_t *module, size_t module_size, tn_error *error);

/* Reads and checks the manifest of a folder: TN_INVALID (E1702) where it is none or was changed, (E1703) where another
 * version of Tartan made it, TN_LIMIT (E1705), TN_IO. Clear the set in any case. */
tn_status tn_shard_set_read(const char *folder, tn_shard_set *set, tn_error *error);

#endif
