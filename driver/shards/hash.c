/* Hashes files and texts. */
#include "driver/shards/hash.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#define XXH_INLINE_ALL
#include "runtime/base/file.h"
#include "runtime/plan/library/hash_text.h"

enum { CHUNK = 1 << 16 };

void tn_hash_bytes(const void *bytes, size_t size, char hex[33])
{
    tn_hash_text(XXH3_128bits(bytes, size), hex);
}

/* ---- of a file while it is written */

struct tn_hashing {
    XXH3_state_t *state;
    uint64_t size;
};

tn_hashing *tn_hashing_new(void)
{
    tn_hashing *hashing = calloc(1, sizeof *hashing);
    if (hashing && !(hashing->state = XXH3_createState())) {
        free(hashing);
        return NULL;
    }
    if (hashing)
        XXH3_128bits_reset(hashing->state);
    return hashing;
}

void tn_hashing_free(tn_hashing *hashing)
{
    if (hashing)
        XXH3_freeState(hashing->state);
    free(hashing);
}

static void see(void *context, const void *bytes, size_t size)
{
    tn_hashing *hashing = context;
    XXH3_128bits_update(hashing->state, bytes, size);
    hashing->size += size;
}

tn_seen_bytes tn_hashing_seen(tn_hashing *hashing)
{
    return (tn_seen_bytes){see, hashing};
}

void tn_hashing_end(const tn_hashing *hashing, char hex[33], uint64_t *size)
{
    tn_hash_text(XXH3_128bits_digest(hashing->state), hex);
    *size = hashing->size;
}

/* ---- of a file that is there */

tn_status tn_hash_file(const char *path, char hex[33], uint64_t *size, tn_error *error)
{
    uint8_t bytes[CHUNK];
    XXH3_state_t hash;
    int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return tn_cannot_read(path, errno, error);
    XXH3_128bits_reset(&hash);
    ssize_t got = 0;
    *size = 0;
    while ((got = read(file, bytes, sizeof bytes)) > 0 || (got < 0 && errno == EINTR)) {
        if (got < 0)
            continue;
        XXH3_128bits_update(&hash, bytes, (size_t)got);
        *size += (uint64_t)got;
    }
    int reason = errno;
    close(file);
    if (got < 0)
        return tn_cannot_read(path, reason, error);
    tn_hash_text(XXH3_128bits_digest(&hash), hex);
    return TN_OK;
}
