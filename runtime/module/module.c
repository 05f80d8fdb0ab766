/* What can be said of a module's file before it is read, and the end of a module that was. */
#include "runtime/module/module.h"

#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/module/layout.h"

tn_module_limits tn_module_limits_default(void)
{
    return (tn_module_limits){.bytes = (size_t)256 << 20, .records = 1000000, .stack = 4096};
}

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

bool tn_module_has_magic(const void *bytes, size_t size)
{
    return size >= TN_MAGIC_SIZE && memcmp(bytes, TN_MAGIC, TN_MAGIC_SIZE) == 0;
}

void tn_module_free(tn_module *module)
{
    free(module);
}
