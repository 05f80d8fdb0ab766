/* The calls that compress files of plans and read them again. They lie elsewhere, so that programs which do not want
 * them need no library for it; whoever opens a reader or writer hands them over.
 */
#ifndef TARTAN_PLAN_TEXT_COMPRESSION_H
#define TARTAN_PLAN_TEXT_COMPRESSION_H

#include <stdio.h>

#include "runtime/plan/text/stream.h"

struct tn_plan_compression {
    /* Begins to compress: *state is freed by end_writing. */
    tn_status (*begin_writing)(void **state, tn_error *error);
    /* Compresses the bytes and writes what comes of it so far; with `last`, all that is left. False where writing
     * failed: errno says why. */
    bool (*write)(void *state, const void *bytes, size_t size, bool last, FILE *out);
    void (*end_writing)(void *state);

    /* Do these first bytes of a file say that it is compressed so? */
    bool (*knows)(const void *bytes, size_t size);
    /* Begins to read a file whose first bytes have been read: *state is freed by end_reading. */
    tn_status (*begin_reading)(const void *bytes, size_t size, void **state, tn_error *error);
    /* Reads up to `room` bytes of what was compressed; *size is 0 at the end. TN_IO, or TN_INVALID (E0604) where the
     * file is damaged. `path` stands in messages. */
    tn_status (*read)(void *state, int file, const char *path, void *bytes, size_t room, size_t *size, tn_error *error);
    void (*end_reading)(void *state);
};

#endif
