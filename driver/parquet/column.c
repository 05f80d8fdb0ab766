/* Reads a column's places: a level of repetition, a level of definition, and a value where there is one. */
#include <stdlib.h>

#include "driver/parquet/reading.h"
#include "runtime/base/bytes.h"

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
