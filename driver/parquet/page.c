/* Reads the heads of pages, and undoes their compression. */
#include "driver/parquet/page.h"

#include <stdlib.h>
#include <zstd.h>

/* ---- compresses pages and writes their heads */

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

/* The struct about a page's values. Its fields are numbered alike in all kinds of page, as far as these are read. */
static void read_values(tn_thrift_in *in, tn_page_head *head)
{
    bool second = head->page == TN_PAGE_DATA_V2;
    tn_thrift_field field = {0};
    while (tn_thrift_next(in, &field)) {
        if (field.number == 1)
            head->values = tn_thrift_read_number(in, field.type);
        else if (field.number == (second ? 4 : 2))
            head->encoding = tn_thrift_read_number(in, field.type);
        else if (second && field.number == 5)
            head->levels[1] = tn_thrift_read_number(in, field.type);
        else if (second && field.number == 6)
            head->levels[0] = tn_thrift_read_number(in, field.type);
        else if (second && field.number == 7)
            head->packs = field.type != TN_THRIFT_FALSE;
        else
            tn_thrift_skip(in, field.type);
    }
    head->has_values = true;
}

/* The number of the field that holds what is said of the values of such a page; -1: of no page that is read. */
static int values_field(int64_t page)
{
    return page == TN_PAGE_DATA ? 5 : page == TN_PAGE_DICTIONARY ? 7 : page == TN_PAGE_DATA_V2 ? 8 : -1;
}

bool tn_page_head_read(tn_thrift_in *in, tn_page_head *head)
{
    tn_thrift_field field = {0};
    *head = (tn_page_head){.page = -1, .encoding = -1, .size = -1, .packed = -1, .packs = true};
    while (tn_thrift_next(in, &field)) {
        if (field.number == 1)
            head->page = tn_thrift_read_number(in, field.type);
        else if (field.number == 2)
            head->size = tn_thrift_read_number(in, field.type);
        else if (field.number == 3)
            head->packed = tn_thrift_read_number(in, field.type);
        else if (field.number == values_field(head->page) && field.type == TN_THRIFT_STRUCT)
            read_values(in, head);
        else
            tn_thrift_skip(in, field.type);
    }
    return !in->bad && head->size >= 0 && head->packed >= 0 && head->values >= 0 && head->levels[0] >= 0 &&
           head->levels[1] >= 0;
}

tn_status tn_page_unpacker_new(tn_page_unpacker *unpacker, tn_error *error)
{
    unpacker->context = ZSTD_createDCtx();
    return unpacker->context ? TN_OK : tn_fail_memory(error);
}

void tn_page_unpacker_free(tn_page_unpacker *unpacker)
{
    ZSTD_freeDCtx(unpacker->context);
}

bool tn_page_unpack(tn_page_unpacker *unpacker, const uint8_t *packed, size_t packed_size, uint8_t *bytes, size_t size)
{
    return ZSTD_decompressDCtx(unpacker->context, bytes, size, packed, packed_size) == size;
}
