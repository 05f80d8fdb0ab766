/* Hashes of files and texts: XXH128 in hexadecimal, as `xxhsum -H128` prints it. */
#ifndef TARTAN_DRIVER_SHARDS_HASH_H
#define TARTAN_DRIVER_SHARDS_HASH_H

#include "runtime/base/error.h"
#include "runtime/base/file.h"

void tn_hash_bytes(const void *bytes, size_t size, char hex[33]);

/* Of a whole file, with its size. TN_IO (E0901). */
tn_status tn_hash_file(const char *path, char hex[33], uint64_t *size, tn_error *error);

/* The hash of a file while it is written, with its size. NULL where out of memory. */
typedef struct tn_hashing tn_hashing;
tn_hashing *tn_hashing_new(void);
void tn_hashing_free(tn_hashing *hashing);

/* For tn_output_open_seen. */
tn_seen_bytes tn_hashing_seen(tn_hashing *hashing);

void tn_hashing_end(const tn_hashing *hashing, char hex[33], uint64_t *size);

#endif
