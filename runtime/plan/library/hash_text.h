/* XXH128 hashes in hexadecimal, as `xxhsum -H128` prints them. Whoever includes this has XXH_INLINE_ALL defined. */
#ifndef TARTAN_PLAN_LIBRARY_HASH_TEXT_H
#define TARTAN_PLAN_LIBRARY_HASH_TEXT_H

#include <xxhash.h>

static inline void tn_hash_text(XXH128_hash_t hash, char hex[33])
{
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, hash);
    for (int i = 0; i < 16; i++) {
        hex[2 * i] = "0123456789abcdef"[canonical.digest[i] >> 4];
        hex[2 * i + 1] = "0123456789abcdef"[canonical.digest[i] & 15];
    }
    hex[32] = '\0';
}

#endif
