/* Compresses pages and writes their heads. */
#include <stdlib.h>
#include <zstd.h>

#include "driver/parquet/page.h"

#define LEVEL 3 /* as for other files of plans */

tn_status tn_page_packer_new(tn_page_packer *packer, tn_error *error)
{
    ZSTD_CCtx *context = ZSTD_createCCtx();
    packer->context = context;
    if (!context)
        return tn_fail_memory(error);
    ZSTD_CCtx_setParameter(context, ZSTD_c_compressionLevel, LEVEL);
    ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, 1);
    return TN_OK;
}

void tn_page_packer_free(tn_page_packer *packer)
{
    ZSTD_freeCCtx(packer->context);
    free(packer->packed.data);
}

static bool compress(tn_page_packer *packer, const tn_buffer *body)
{
    tn_buffer *packed = &packer->packed;
    packed->size = 0;
    if (!tn_buffer_reserve(packed, ZSTD_compressBound(body->size)))
        return false;
    size_t size = ZSTD_compress2(packer->context, packed->data, packed->capacity, body->data, body->size);
    if (ZSTD_isError(size))
        return false; /* the one thing that can be lacking is memory */
    packed->size = size;
    return true;
}

static void write_head(tn_page_kind kind, size_t size, size_t packed, tn_buffer *out)
{
    tn_thrift_out t = tn_thrift_to(out);
    bool dictionary = kind.page == TN_PAGE_DICTIONARY;
    tn_thrift_number(&t, 1, TN_THRIFT_I32, kind.page);
    tn_thrift_number(&t, 2, TN_THRIFT_I32, (int64_t)size);
    tn_thrift_number(&t, 3, TN_THRIFT_I32, (int64_t)packed);
    tn_thrift_begin(&t, dictionary ? 7 : 5);
    tn_thrift_number(&t, 1, TN_THRIFT_I32, (int64_t)kind.values);
    tn_thrift_number(&t, 2, TN_THRIFT_I32, kind.encoding);
    if (!dictionary) {
        tn_thrift_number(&t, 3, TN_THRIFT_I32, TN_ENCODING_RLE); /* of the levels of definition */
        tn_thrift_number(&t, 4, TN_THRIFT_I32, TN_ENCODING_RLE); /* and repetition */
    }
    tn_thrift_end(&t);
    tn_thrift_end(&t);
}

bool tn_page_write(tn_page_packer *packer, tn_page_kind kind, const tn_buffer *body, tn_buffer *out, uint64_t *loose)
{
    size_t before = out->size;
    if (body->failed || !compress(packer, body))
        return false;
    write_head(kind, body->size, packer->packed.size, out);
    *loose += out->size - before + body->size;
    tn_buffer_append(out, packer->packed.data, packer->packed.size);
    return !out->failed;
}
