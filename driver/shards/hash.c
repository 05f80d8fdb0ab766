/* Hashes files and texts. */
#include "driver/shards/hash.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

#define XXH_INLINE_ALL
#include "runtime/base/file_error.h"
#include "runtime/base/hash_text.h"

enum { CHUNK = 1 << 16 };

void tn_hash_bytes(const void *bytes, size_t size, char hex[33])
{
    tn_hash_text(XXH3_128bits(bytes, size), hex);
}

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
