/* Lines of text taken from a reader a chunk at a time, to be read by another thread. */
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/reader.h"

struct tn_plan_lines {
    tn_plan_scanner *scanner;
    bool json;
    size_t max_length;
    tn_buffer chunk;
    size_t at;     /* in the chunk: what is before is read */
    uint64_t line; /* of the line read last */
    const char *text;
    size_t text_size;
    tn_plan plan;
};

tn_status tn_plan_lines_new(const tn_plan_reader *reader, tn_plan_lines **out, tn_error *error)
{
    tn_plan_lines *lines = calloc(1, sizeof *lines);
    if (!lines)
        return tn_fail_memory(error);
    lines->json = reader->format == TN_FORMAT_JSON;
    lines->max_length = reader->max_length;
    tn_status status = tn_plan_scanner_new(reader->schema, &lines->scanner, error);
    if (status != TN_OK) {
        tn_plan_lines_free(lines);
        return status;
    }
    *out = lines;
    return TN_OK;
}

void tn_plan_lines_free(tn_plan_lines *lines)
{
    if (!lines)
        return;
    tn_plan_scanner_free(lines->scanner);
    free(lines->chunk.data);
    free(lines->plan.trays);
    free(lines);
}

static uint64_t count_lines(const char *text, size_t size)
{
    uint64_t count = 0;
    const char *end = text + size;
    while (text < end && (text = memchr(text, '\n', (size_t)(end - text)))) {
        text++;
        count++;
    }
    return count;
}

/* How much of what was read is whole lines. */
static size_t whole_lines(const tn_plan_reader *reader)
{
    const char *text = reader->data + reader->begin;
    size_t size = reader->end - reader->begin;
    const char *newline = size ? memrchr(text, '\n', size) : NULL;
    if (reader->input_ended)
        return size;
    return newline ? (size_t)(newline - text) + 1 : 0;
}

tn_status tn_plan_lines_take(tn_plan_lines *lines, tn_plan_reader *reader, size_t bytes, bool *taken, tn_error *error)
{
    *taken = false;
    lines->chunk.size = lines->at = 0;
    bool text = reader->format == TN_FORMAT_LINES || reader->format == TN_FORMAT_JSON;
    if (!text || reader->at_end || bytes > reader->max_line)
        return TN_OK;
    tn_status status = tn_reader_fill(reader, bytes, error);
    if (status != TN_OK) {
        reader->at_end = true;
        return status;
    }
    size_t size = whole_lines(reader);
    if (size == 0)
        return TN_OK;
    if (!tn_buffer_append(&lines->chunk, reader->data + reader->begin, size))
        return tn_fail_memory(error);
    reader->begin += size;
    lines->line = reader->line;
    reader->line += count_lines(lines->chunk.data, size);
    *taken = true;
    return TN_OK;
}

static bool next_line(tn_plan_lines *lines)
{
    size_t left = lines->chunk.size - lines->at;
    if (left == 0)
        return false;
    lines->text = lines->chunk.data + lines->at;
    const char *newline = memchr(lines->text, '\n', left);
    lines->text_size = newline ? (size_t)(newline - lines->text) : left;
    lines->at += lines->text_size + (newline ? 1 : 0);
    if (lines->text_size > 0 && lines->text[lines->text_size - 1] == '\r')
        lines->text_size--;
    lines->line++;
    return true;
}

tn_status tn_plan_lines_next(tn_plan_lines *lines, const tn_plan **plan, tn_error *error)
{
    *plan = NULL;
    while (next_line(lines)) {
        char first = tn_reader_first(lines->text, lines->text_size);
        if (first == '#' || (lines->json && !first))
            continue;
        tn_status status = lines->json ? tn_plan_scan_json(lines->scanner, lines->text, lines->text_size,
                                                           lines->max_length, &lines->plan, error)
                                       : tn_plan_scan_line(lines->scanner, lines->text, lines->text_size,
                                                           lines->max_length, &lines->plan, error);
        if (status == TN_OK)
            *plan = &lines->plan;
        else
            error->line = lines->line;
        if (status != TN_OK && error->column == 0)
            error->column = error->column_end = 1;
        return status;
    }
    return TN_OK;
}

uint64_t tn_plan_lines_line(const tn_plan_lines *lines)
{
    return lines->line;
}

const char *tn_plan_lines_text(const tn_plan_lines *lines, size_t *size)
{
    *size = lines->text_size;
    return lines->text;
}
