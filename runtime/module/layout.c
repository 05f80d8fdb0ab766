/* Reads and writes a module's header and table of sections. */
#include "runtime/module/layout.h"

#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/base/bytes.h"
#include "runtime/module/builder.h"

uint64_t tn_module_hash_bytes(const uint8_t *bytes, size_t size)
{
    XXH3_state_t state;
    static const uint8_t zeros[8];
    XXH3_INITSTATE(&state);
    XXH3_64bits_reset(&state);
    XXH3_64bits_update(&state, bytes, TN_HEADER_HASH);
    XXH3_64bits_update(&state, zeros, sizeof zeros);
    XXH3_64bits_update(&state, bytes + TN_HEADER_BYTES, size - TN_HEADER_BYTES);
    return XXH3_64bits_digest(&state);
}

void tn_module_rehash(uint8_t *bytes, size_t size)
{
    if (size >= TN_HEADER_BYTES)
        tn_put_u64(bytes + TN_HEADER_HASH, tn_module_hash_bytes(bytes, size));
}

bool tn_module_has_magic(const void *bytes, size_t size)
{
    return size >= TN_MAGIC_SIZE && memcmp(bytes, TN_MAGIC, TN_MAGIC_SIZE) == 0;
}
