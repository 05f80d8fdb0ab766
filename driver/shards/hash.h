/* Hashes of files and texts: XXH128 in hexadecimal, as `xxhsum -H128` prints it. */
#ifndef TARTAN_DRIVER_SHARDS_HASH_H
#define TARTAN_DRIVER_SHARDS_HASH_H

#include "runtime/base/error.h"

void tn_hash_bytes(const void *bytes, size_t size, char hex[33]);

/* Of a whole file, with its size. TN_IO (E0901). */
tn_status tn_hash_file(const char *path, char hex[33], uint64_t *size, tn_error *error);

#endif
