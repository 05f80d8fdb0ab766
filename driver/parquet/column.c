/* Reads a column's places: a level of repetition, a level of definition, and a value where there is one. */
#include <stdlib.h>
#include <string.h>

#include "driver/parquet/reading.h"
#include "runtime/base/array.h"
#include "runtime/base/bytes.h"

/* ---- reads the pages of a column */

#define WINDOW ((size_t)1 << 18)    /* bytes of the file that are read at a time */
#define HEAD_FIRST ((size_t)1 << 9) /* bytes of a head that are looked at; where it is longer, HEAD_MOST */
#define HEAD_MOST ((size_t)1 << 20)
#define PAGE_MOST (INT64_C(1) << 28) /* bytes of a page */

/* ---- bytes */

/* Makes `size` bytes from column->at on stand in the window. They are within the chunk. */
static tn_status look(tn_plan_reader *reader, tn_read_column *column, size_t size, const uint8_t **bytes,
                      tn_error *error)
{
    tn_buffer *window = &column->window;
    uint64_t behind = column->at - column->window_at, left = column->chunk.end - column->at;
    if (window->size == 0 || behind > window->size || window->size - behind < size) {
        size_t wanted = size > WINDOW ? size : WINDOW;
        wanted = wanted < left ? wanted : (size_t)left;
        window->size = 0;
        if (!tn_buffer_reserve(window, wanted))
            return tn_fail_memory(error);
        tn_status status = tn_parquet_bytes(reader, column->at, window->data, wanted, error);
        if (status != TN_OK)
            return status;
        window->size = wanted;
        column->window_at = column->at;
        behind = 0;
    }
    *bytes = (const uint8_t *)window->data + behind;
    return TN_OK;
}

/* Reads the head of the next page, and passes over it. */
static tn_status read_head(tn_plan_reader *reader, tn_read_column *column, tn_page_head *head, tn_error *error)
{
    uint64_t left = column->chunk.end - column->at;
    const uint8_t *bytes = NULL;
    for (size_t most = HEAD_FIRST; most <= HEAD_MOST; most *= HEAD_MOST / HEAD_FIRST) {
        size_t size = left < most ? (size_t)left : most;
        tn_status status = look(reader, column, size, &bytes, error);
        if (status != TN_OK)
            return status;
        tn_thrift_in in = {bytes, bytes + size, false};
        if (!tn_page_head_read(&in, head))
            continue;
        column->at += (uint64_t)(in.at - bytes);
        if ((uint64_t)head->packed > column->chunk.end - column->at)
            return tn_parquet_damaged(reader, "a page is larger than what holds it", error);
        if (head->size > PAGE_MOST || head->packed > PAGE_MOST)
            return tn_parquet_unknown(reader, "write it again in smaller row groups", error,
                                      "a page takes more than %lld MiB", (long long)(PAGE_MOST >> 20));
        return TN_OK;
    }
    return tn_parquet_damaged(reader, "a page does not begin as one does", error);
}

/* Reads the page's bytes into `out`, and undoes their compression: `head->size` of them. The levels of a page of the
 * second version are before what is compressed. */
static tn_status read_body(tn_plan_reader *reader, tn_read_column *column, const tn_page_head *head, tn_buffer *out,
                           tn_error *error)
{
    const uint8_t *bytes = NULL;
    size_t size = (size_t)head->size, packed = (size_t)head->packed;
    bool second = head->page == TN_PAGE_DATA_V2;
    uint64_t levels = second ? (uint64_t)head->levels[0] + (uint64_t)head->levels[1] : 0;
    out->size = 0;
    if (levels > size || levels > packed)
        return tn_parquet_damaged(reader, "a page's levels are larger than the page", error);
    tn_status status = look(reader, column, packed, &bytes, error);
    if (status == TN_OK && !tn_buffer_reserve(out, size))
        status = tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    bool compressed = column->chunk.codec == TN_CODEC_ZSTD && head->packs;
    memcpy(out->data, bytes, (size_t)levels);
    uint8_t *rest = (uint8_t *)out->data + levels;
    bool whole = compressed ? tn_page_unpack(&tn_reading_of(reader)->unpacker, bytes + levels, packed - (size_t)levels,
                                             rest, size - (size_t)levels)
                            : size == packed;
    if (!whole)
        return tn_parquet_damaged(reader, "what is compressed in a page is not as large as it says", error);
    if (!compressed)
        memcpy(rest, bytes + levels, size - (size_t)levels);
    out->size = size;
    column->at += packed;
    return TN_OK;
}

/* ---- dictionaries */

/* The values of the dictionary's page, one behind another. */
static tn_status split_dictionary(tn_plan_reader *reader, tn_read_column *column, size_t count, tn_error *error)
{
    const uint8_t *bytes = (const uint8_t *)column->dictionary.data, *end = bytes + column->dictionary.size;
    bool text = column->leaf.type == TN_PARQUET_TEXT;
    size_t fixed = column->leaf.type == TN_PARQUET_INT32   ? 4
                   : column->leaf.type == TN_PARQUET_INT64 ? 8
                                                           : (size_t)column->leaf.type_length;
    size_t least = text ? 4 : fixed;
    if (count > column->dictionary.size / least)
        return tn_parquet_damaged(reader, "a dictionary is cut off", error);
    if (!tn_array_reserve(&column->words, &column->word_room, 0, count, sizeof *column->words))
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++) {
        if ((size_t)(end - bytes) < least)
            return tn_parquet_damaged(reader, "a dictionary is cut off", error);
        size_t size = text ? tn_get_u32(bytes) : fixed;
        bytes += text ? 4 : 0;
        if (size > (size_t)(end - bytes))
            return tn_parquet_damaged(reader, "a dictionary is cut off", error);
        column->words[i] = (tn_thrift_string){bytes, size};
        bytes += size;
    }
    column->word_count = count;
    return TN_OK;
}

/* Which values of the field the dictionary's texts are. */
static tn_status find_codes(tn_plan_reader *reader, tn_read_column *column, tn_error *error)
{
    if (!tn_array_reserve(&column->codes, &column->code_room, 0, column->word_count, sizeof *column->codes))
        return tn_fail_memory(error);
    for (size_t i = 0; i < column->word_count; i++) {
        const tn_word word = {.text = (const char *)column->words[i].bytes, .size = column->words[i].size};
        uint32_t value = tn_value_find(reader->schema, column->field, &word);
        column->codes[i] = value == TN_NO_VALUE ? TN_NO_CODE : (uint16_t)value;
    }
    return TN_OK;
}

static tn_status read_dictionary(tn_plan_reader *reader, tn_read_column *column, const tn_page_head *head,
                                 tn_error *error)
{
    if (column->word_count > 0)
        return tn_parquet_damaged(reader, "a column has two dictionaries", error);
    tn_status status = read_body(reader, column, head, &column->dictionary, error);
    if (status == TN_OK)
        status = split_dictionary(reader, column, (size_t)head->values, error);
    return status == TN_OK && column->field != UINT32_MAX ? find_codes(reader, column, error) : status;
}

/* ---- pages of values */

static unsigned bits_for(unsigned most)
{
    return most ? 32 - (unsigned)__builtin_clz(most) : 0;
}

/* Begins levels, and takes them from *bytes: so many bytes, or (-1) what stands before them. */
static bool begin_levels(tn_runs *runs, unsigned most, int64_t size, tn_thrift_in *bytes)
{
    size_t left = (size_t)(bytes->end - bytes->at);
    if (most == 0 && size < 0)
        return true;
    if (size < 0) {
        if (left < 4)
            return false;
        size = tn_get_u32(bytes->at);
        bytes->at += 4;
        left -= 4;
    }
    if ((uint64_t)size > left)
        return false;
    tn_runs_begin(runs, bits_for(most), bytes->at, (size_t)size);
    bytes->at += size;
    return true;
}

static const char *encoding_name(int64_t encoding)
{
    static const char *const names[] = {
        "PLAIN",          "GROUP_VAR_INT",       "PLAIN_DICTIONARY",        "RLE",
        "BIT_PACKED",     "DELTA_BINARY_PACKED", "DELTA_LENGTH_BYTE_ARRAY", "DELTA_BYTE_ARRAY",
        "RLE_DICTIONARY", "BYTE_STREAM_SPLIT"};
    return encoding >= 0 && encoding < (int64_t)(sizeof names / sizeof *names) ? names[encoding] : "unknown";
}

static tn_status begin_values(tn_plan_reader *reader, tn_read_column *column, const tn_thrift_in *rest, tn_error *error)
{
    size_t size = (size_t)(rest->end - rest->at);
    bool integer = column->leaf.type == TN_PARQUET_INT32 || column->leaf.type == TN_PARQUET_INT64;
    column->plain = *rest;
    switch (column->encoding) {
    case TN_ENCODING_PLAIN:
        return TN_OK;
    case TN_ENCODING_PLAIN_DICTIONARY:
    case TN_ENCODING_RLE_DICTIONARY:
        if (size == 0) /* a page of no values */
            tn_runs_begin(&column->places, 0, rest->at, 0);
        else if (*rest->at > 32)
            return tn_parquet_damaged(reader, "the places in a dictionary have more than 32 bits", error);
        else
            tn_runs_begin(&column->places, *rest->at, rest->at + 1, size - 1);
        return TN_OK;
    case TN_ENCODING_DELTA:
        if (integer && tn_deltas_begin(&column->deltas, rest->at, size))
            return TN_OK;
        if (integer)
            return tn_parquet_damaged(reader, "the differences of a page do not begin as they should", error);
        break;
    default:
        break;
    }
    return tn_parquet_unknown(reader, "write it again with dictionaries, or with PLAIN values", error,
                              "a column is encoded as %s", encoding_name(column->encoding));
}

static tn_status begin_page(tn_plan_reader *reader, tn_read_column *column, const tn_page_head *head, tn_error *error)
{
    tn_status status = read_body(reader, column, head, &column->page, error);
    if (status != TN_OK)
        return status;
    const uint8_t *bytes = (const uint8_t *)column->page.data;
    tn_thrift_in rest = {bytes, bytes + column->page.size, false};
    bool second = head->page == TN_PAGE_DATA_V2;
    if (!begin_levels(&column->repetition, column->leaf.max_repetition, second ? head->levels[0] : -1, &rest) ||
        !begin_levels(&column->definition, column->leaf.max_definition, second ? head->levels[1] : -1, &rest))
        return tn_parquet_damaged(reader, "the levels of a page are cut off", error);
    column->encoding = head->encoding;
    column->left = (uint64_t)head->values;
    return begin_values(reader, column, &rest, error);
}

tn_status tn_column_page(tn_plan_reader *reader, tn_read_column *column, tn_error *error)
{
    tn_page_head head;
    column->ended = column->at >= column->chunk.end;
    if (column->ended)
        return TN_OK;
    tn_status status = read_head(reader, column, &head, error);
    if (status != TN_OK)
        return status;
    if (head.has_values && head.page == TN_PAGE_DICTIONARY)
        return read_dictionary(reader, column, &head, error);
    if (head.has_values && (head.page == TN_PAGE_DATA || head.page == TN_PAGE_DATA_V2))
        return begin_page(reader, column, &head, error);
    column->at += (uint64_t)head.packed; /* a page that says nothing of values */
    return TN_OK;
}

void tn_column_begin(tn_read_column *column, const tn_read_chunk *chunk)
{
    column->chunk = *chunk;
    column->at = chunk->begin;
    column->window.size = 0;
    column->left = 0;
    column->word_count = 0;
    column->peeked = column->ended = false;
}

void tn_column_free(tn_read_column *column)
{
    free(column->window.data);
    free(column->page.data);
    free(column->dictionary.data);
    free(column->words);
    free(column->codes);
}

/* A level, of which there are none where it can only be 0. */
static bool read_level(tn_runs *runs, unsigned most, unsigned *level)
{
    uint32_t read = 0;
    if (most > 0 && !tn_runs_next(runs, &read))
        return false;
    *level = read;
    return read <= most;
}

tn_status tn_column_peek(tn_plan_reader *reader, tn_read_column *column, tn_error *error)
{
    while (!column->peeked && !column->ended) {
        if (column->left == 0) {
            tn_status status = tn_column_page(reader, column, error);
            if (status != TN_OK)
                return status;
            continue;
        }
        if (!read_level(&column->repetition, column->leaf.max_repetition, &column->next_repetition) ||
            !read_level(&column->definition, column->leaf.max_definition, &column->next_definition))
            return tn_parquet_damaged(reader, "a page has too few levels", error);
        column->left--;
        column->peeked = true;
    }
    return TN_OK;
}

/* ---- values */

static size_t plain_size(const tn_read_column *column)
{
    return column->leaf.type == TN_PARQUET_INT32   ? 4
           : column->leaf.type == TN_PARQUET_INT64 ? 8
                                                   : (size_t)column->leaf.type_length;
}

/* A value as it is: a text behind its size, or so many bytes. */
static bool take_plain(const tn_read_column *column, tn_thrift_in *in, tn_thrift_string *text)
{
    size_t left = (size_t)(in->end - in->at), size = plain_size(column);
    if (column->leaf.type == TN_PARQUET_TEXT) {
        if (left < 4)
            return false;
        size = tn_get_u32(in->at);
        in->at += 4;
        left -= 4;
    }
    if (size > left)
        return false;
    *text = (tn_thrift_string){in->at, size};
    in->at += size;
    return true;
}

static bool take_value(tn_read_column *column, tn_read_value *value)
{
    *value = (tn_read_value){.place = UINT32_MAX};
    switch (column->encoding) {
    case TN_ENCODING_PLAIN:
        return take_plain(column, &column->plain, &value->text);
    case TN_ENCODING_DELTA:
        return tn_deltas_next(&column->deltas, &value->number);
    default:
        if (!tn_runs_next(&column->places, &value->place) || value->place >= column->word_count)
            return false;
        value->text = column->words[value->place];
        return true;
    }
}

tn_status tn_column_take(tn_plan_reader *reader, tn_read_column *column, tn_read_value *value, tn_error *error)
{
    column->peeked = false;
    if (column->next_definition < column->leaf.max_definition)
        return TN_OK;
    if (!take_value(column, value))
        return tn_parquet_damaged(reader, "a page has too few values, or one that its dictionary does not have", error);
    return TN_OK;
}
