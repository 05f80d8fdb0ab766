/* Puts the pages of a file of plans together. */
#include <stdlib.h>
#include <string.h>

#include "driver/parquet/encoding.h"
#include "driver/parquet/writing.h"
#include "runtime/base/bytes.h"

/* Compresses what is in w->body as a page of that column. */
static tn_status end_body(tn_parquet_writing *w, unsigned column, enum tn_parquet_encoding encoding, size_t values,
                          tn_error *error)
{
    tn_chunk *chunk = &w->chunks[column];
    tn_page_kind kind = {TN_PAGE_DATA, encoding, values};
    bool done = tn_page_write(&w->packer, kind, &w->body, &chunk->pages, &chunk->loose);
    chunk->values += values;
    w->body.size = 0;
    return done ? TN_OK : tn_fail_memory(error);
}

/* ---- ranks, lengths, totals */

static enum tn_parquet_encoding write_ranks(tn_parquet_writing *w)
{
    if (w->rank_bytes == 0) {
        tn_delta_end(&w->ranks, &w->body);
        return TN_ENCODING_DELTA;
    }
    tn_buffer_append(&w->body, w->wide_ranks.data, w->wide_ranks.size);
    w->wide_ranks.size = 0;
    return TN_ENCODING_PLAIN;
}

static tn_status end_numbers(tn_parquet_writing *w, tn_error *error)
{
    tn_status status = end_body(w, 0, write_ranks(w), w->in_page, error);
    if (status == TN_OK)
        status = end_body(w, 1, tn_numbers_page(&w->length, &w->body), w->in_page, error);
    if (status == TN_OK && w->has_total)
        status = end_body(w, 2, tn_numbers_page(&w->total, &w->body), w->in_page, error);
    return status;
}

/* ---- lists */

/* Levels stand behind their size. */
static void end_levels(tn_buffer *body, size_t begin)
{
    if (!body->failed)
        tn_put_u32((uint8_t *)body->data + begin, (uint32_t)(body->size - begin - 4));
}

/* The levels of a list, which are those of all lists: where a plan begins, and where it has no tray. */
static void write_levels(tn_parquet_writing *w)
{
    tn_buffer *body = &w->body;
    size_t begin = body->size;
    tn_buffer_append(body, "\0\0\0", 4);
    tn_bits_write(body, w->goes_on, w->places);
    end_levels(body, begin);
    begin = body->size;
    tn_buffer_append(body, "\0\0\0", 4);
    if (w->some_empty)
        tn_bits_write(body, w->holds, w->places);
    else
        tn_run_write(body, 1, 1, w->places);
    end_levels(body, begin);
}

/* The field's values of the page's trays. */
static void write_field(tn_parquet_writing *w, uint32_t field)
{
    const uint8_t *number = w->tray_numbers;
    uint32_t mask = UINT32_MAX >> (32 - 8 * w->tray_bytes);
    size_t begin = w->body.size;
    uint8_t *values = tn_bytes_begin(&w->body, w->trays);
    if (!values)
        return;
    for (size_t i = 0; i < w->trays; i++, number += w->tray_bytes) {
        values[i] = (uint8_t)tn_tray_value(w->schema, tn_get_u32(number) & mask, field);
        w->seen[field][values[i]] = 1;
    }
    tn_bytes_end(&w->body, begin, w->trays);
}

static tn_status end_lists(tn_parquet_writing *w, tn_error *error)
{
    static const char width[] = {8};
    tn_status status = TN_OK;
    for (uint32_t f = 0; status == TN_OK && f < w->schema->field_count; f++) {
        write_levels(w);
        tn_buffer_append(&w->body, width, 1);
        write_field(w, f);
        status = end_body(w, tn_first_field_column(w) + f, TN_ENCODING_RLE_DICTIONARY, w->places, error);
    }
    return status;
}

/* ---- */

tn_status tn_parquet_end_lines(tn_parquet_writing *w, tn_error *error)
{
    if (w->line_count == 0)
        return TN_OK;
    tn_buffer_append(&w->body, w->lines.data, w->lines.size);
    size_t count = w->line_count;
    w->lines.size = w->line_count = 0;
    return end_body(w, tn_column_count(w) - 1, TN_ENCODING_PLAIN, count, error);
}

tn_status tn_parquet_end_page(tn_parquet_writing *w, tn_error *error)
{
    if (w->in_page == 0)
        return TN_OK;
    tn_status status = end_numbers(w, error);
    if (status == TN_OK)
        status = end_lists(w, error);
    memset(w->goes_on, 0, w->places_room / 8);
    memset(w->holds, 0, w->places_room / 8);
    w->in_page = w->trays = w->places = 0;
    w->some_empty = false;
    return status;
}

static size_t write_values(tn_parquet_writing *w, uint32_t field)
{
    const tn_schema *schema = w->schema;
    uint32_t first = schema->value_start[field], count = schema->value_start[field + 1] - first;
    for (uint32_t v = first; v < first + count; v++) {
        const char *text = tn_text(schema->module, schema->values[v].spelling);
        size_t size = strlen(text);
        tn_plain_write(&w->body, (int64_t)size, 4);
        tn_buffer_append(&w->body, text, size);
    }
    return count;
}

bool tn_parquet_dictionary(tn_parquet_writing *w, unsigned column, size_t *values)
{
    unsigned first = tn_first_field_column(w);
    bool is_number = column > 0 && column < first,
         is_field = column >= first && column - first < w->schema->field_count;
    w->body.size = 0;
    if (is_field)
        *values = write_values(w, column - first);
    if (is_number) {
        const tn_numbers *numbers = column == 1 ? &w->length : &w->total;
        *values = numbers->known;
        tn_numbers_dictionary(numbers, &w->body);
    }
    return is_number || is_field;
}
