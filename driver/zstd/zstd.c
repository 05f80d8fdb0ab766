/* Compresses files of plans by zstd (RFC 8878), and reads such files. */
#include "driver/zstd/zstd.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zstd.h>

#include "runtime/base/file.h"
#include "runtime/plan/text/stream.h"

/* Of the levels that keep up with the writing of packed plans, the one that makes the smallest files. */
#define LEVEL 3

/* ---- writing */

typedef struct writing {
    ZSTD_CCtx *context;
    size_t room;
    char out[];
} writing;

static void end_writing(void *state)
{
    writing *w = state;
    if (w)
        ZSTD_freeCCtx(w->context);
    free(w);
}

static tn_status begin_writing(void **state, tn_error *error)
{
    writing *w = calloc(1, sizeof *w + ZSTD_CStreamOutSize());
    *state = w;
    if (w)
        w->context = ZSTD_createCCtx();
    if (!w || !w->context)
        return tn_fail_memory(error);
    w->room = ZSTD_CStreamOutSize();
    ZSTD_CCtx_setParameter(w->context, ZSTD_c_compressionLevel, LEVEL);
    ZSTD_CCtx_setParameter(w->context, ZSTD_c_checksumFlag, 1);
    return TN_OK;
}

static bool write_some(void *state, const void *bytes, size_t size, bool last, FILE *out)
{
    writing *w = state;
    ZSTD_inBuffer in = {bytes, size, 0};
    bool done = false;
    while (!done) {
        ZSTD_outBuffer made = {w->out, w->room, 0};
        size_t left = ZSTD_compressStream2(w->context, &made, &in, last ? ZSTD_e_end : ZSTD_e_continue);
        if (ZSTD_isError(left)) {
            errno = ENOMEM; /* the one thing that can be lacking */
            return false;
        }
        if (fwrite(made.dst, 1, made.pos, out) != made.pos)
            return false;
        done = last ? left == 0 : in.pos == in.size;
    }
    return true;
}

/* ---- reading */

typedef struct reading {
    ZSTD_DCtx *context;
    ZSTD_inBuffer in;
    size_t room;
    size_t expected; /* 0: between two frames, where the file may end */
    char bytes[];
} reading;

static bool knows(const void *bytes, size_t size)
{
    static const unsigned char magic[] = {0x28, 0xb5, 0x2f, 0xfd};
    return size >= sizeof magic && memcmp(bytes, magic, sizeof magic) == 0;
}

static void end_reading(void *state)
{
    reading *r = state;
    if (r)
        ZSTD_freeDCtx(r->context);
    free(r);
}

static tn_status begin_reading(const void *bytes, size_t size, void **state, tn_error *error)
{
    size_t room = size > ZSTD_DStreamInSize() ? size : ZSTD_DStreamInSize();
    reading *r = calloc(1, sizeof *r + room);
    *state = r;
    if (r)
        r->context = ZSTD_createDCtx();
    if (!r || !r->context)
        return tn_fail_memory(error);
    r->room = room;
    memcpy(r->bytes, bytes, size);
    r->in = (ZSTD_inBuffer){r->bytes, size, 0};
    return TN_OK;
}

static tn_status damaged(const char *path, const char *what, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_PLAN_FILE, "%.300s: the compressed plans are damaged: %.100s", path, what);
    tn_error_help(error, "make the file again, or get another copy of it");
    return TN_INVALID;
}

static tn_status fill(reading *r, int file, const char *path, tn_error *error)
{
    ssize_t got;
    do
        got = read(file, r->bytes, r->room);
    while (got < 0 && errno == EINTR);
    r->in = (ZSTD_inBuffer){r->bytes, got > 0 ? (size_t)got : 0, 0};
    return got < 0 ? tn_cannot_read(path, errno, error) : TN_OK;
}

static tn_status read_some(void *state, int file, const char *path, void *bytes, size_t room, size_t *size,
                           tn_error *error)
{
    reading *r = state;
    ZSTD_outBuffer out = {bytes, room, 0};
    while (out.pos == 0) {
        if (r->in.pos == r->in.size && fill(r, file, path, error) != TN_OK)
            return TN_IO;
        bool ended = r->in.size == 0;
        size_t before = r->in.pos;
        if (!ended || r->expected > 0) {
            r->expected = ZSTD_decompressStream(r->context, &out, &r->in);
            if (ZSTD_isError(r->expected))
                return damaged(path, ZSTD_getErrorName(r->expected), error);
        }
        if (ended && out.pos == 0 && r->in.pos == before) {
            *size = 0;
            return r->expected == 0 ? TN_OK : damaged(path, "the file ends too soon", error);
        }
    }
    *size = out.pos;
    return TN_OK;
}

const tn_plan_compression *tn_plan_zstd(void)
{
    static const tn_plan_compression zstd = {.begin_writing = begin_writing,
                                             .write = write_some,
                                             .end_writing = end_writing,
                                             .knows = knows,
                                             .begin_reading = begin_reading,
                                             .read = read_some,
                                             .end_reading = end_reading};
    return &zstd;
}
