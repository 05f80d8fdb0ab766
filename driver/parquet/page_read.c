/* Reads the heads of pages, and undoes their compression. */
#include <zstd.h>

#include "driver/parquet/page.h"

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
