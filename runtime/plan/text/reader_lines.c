/* Lines of text for a thread of its own: taken from the reader a chunk at a time, or read from the file. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "runtime/base/file.h"
#include "runtime/plan/text/reader.h"

/* Read behind a stretch at once, for the end of its last line, and from then on at a time. */
enum { BEHIND_BYTES = 4 << 10, LONG_LINE_BYTES = 64 << 10 };

struct tn_plan_lines {
    tn_plan_scanner *scanner;
    bool json;
    size_t max_length, max_line;
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
    lines->max_line = reader->max_line;
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

static bool is_text(const tn_plan_reader *reader)
{
    return reader->format == TN_FORMAT_LINES || reader->format == TN_FORMAT_JSON;
}

/* Lines that end in the text, and one more where it ends with none. */
static uint64_t count_lines(const char *text, size_t size)
{
    uint64_t count = 0;
    const char *end = text + size;
    while (text < end) {
        const char *newline = memchr(text, '\n', (size_t)(end - text));
        text = newline ? newline + 1 : end;
        count++;
    }
    return count;
}

/* ---- taken */

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

/* Takes so many bytes: the two change their buffers, and only what the reader is to keep is copied. */
static bool take_buffer(tn_plan_lines *lines, tn_plan_reader *reader, size_t size)
{
    size_t kept = reader->end - reader->begin - size;
    if (!tn_buffer_reserve(&lines->chunk, kept))
        return false;
    tn_buffer mine = lines->chunk;
    lines->chunk = (tn_buffer){.data = reader->data, .size = reader->begin + size, .capacity = reader->capacity};
    lines->at = reader->begin;
    memcpy(mine.data, reader->data + lines->chunk.size, kept);
    reader->data = mine.data;
    reader->capacity = mine.capacity;
    reader->begin = 0;
    reader->end = kept;
    return true;
}

tn_status tn_plan_lines_take(tn_plan_lines *lines, tn_plan_reader *reader, size_t bytes, bool *taken, tn_error *error)
{
    *taken = false;
    lines->chunk.size = lines->at = 0;
    if (!is_text(reader) || reader->decompressing || reader->at_end || bytes > reader->max_line)
        return TN_OK;
    tn_status status = tn_reader_fill(reader, bytes, error);
    if (status != TN_OK) {
        reader->at_end = true;
        return status;
    }
    size_t size = whole_lines(reader);
    if (size == 0)
        return TN_OK;
    lines->line = reader->line;
    reader->line += count_lines(reader->data + reader->begin, size);
    if (!take_buffer(lines, reader, size))
        return tn_fail_memory(error);
    *taken = true;
    return TN_OK;
}

/* ---- read side by side */

uint64_t tn_plan_reader_share(tn_plan_reader *reader)
{
    struct stat known;
    if (!is_text(reader) || reader->at_end || fstat(reader->file, &known) != 0 || !S_ISREG(known.st_mode))
        return 0;
    off_t at = lseek(reader->file, 0, SEEK_CUR);
    size_t unused = reader->end - reader->begin;
    if (at < (off_t)unused || known.st_size <= at - (off_t)unused)
        return 0;
    reader->shared = (uint64_t)at - unused;
    reader->shared_end = (uint64_t)known.st_size;
    if (reader->left < reader->shared_end - (uint64_t)at)
        reader->shared_end = (uint64_t)at + reader->left;
    reader->begin = reader->end = 0;
    reader->at_end = reader->input_ended = true;
    (void)lseek(reader->file, known.st_size, SEEK_SET); /* as if it had been read: standard input is others' too */
    return reader->shared_end - reader->shared;
}

/* Appends `wanted` bytes of the file from `at` on, or what is left of it. */
static tn_status read_at(tn_plan_lines *lines, const tn_plan_reader *reader, uint64_t at, size_t wanted,
                         tn_error *error)
{
    uint64_t left = reader->shared_end > at ? reader->shared_end - at : 0;
    size_t missing = wanted < left ? wanted : (size_t)left;
    if (!tn_buffer_reserve(&lines->chunk, missing))
        return tn_fail_memory(error);
    while (missing > 0) {
        ssize_t count = pread(reader->file, lines->chunk.data + lines->chunk.size, missing, (off_t)at);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return tn_cannot_read(reader->path, errno, error);
        if (count == 0)
            break;
        lines->chunk.size += (size_t)count;
        at += (uint64_t)count;
        missing -= (size_t)count;
    }
    return TN_OK;
}

/* Ends the chunk, which was read from `at` on, with the line that begins last in its first `size` bytes or at their
 * end; reads more where that line does, until it is too long. */
static tn_status end_with_line(tn_plan_lines *lines, const tn_plan_reader *reader, uint64_t at, size_t size,
                               tn_error *error)
{
    tn_buffer *chunk = &lines->chunk;
    if (chunk->size <= size)
        return TN_OK;
    const char *before = memrchr(chunk->data, '\n', size);
    size_t line = before ? (size_t)(before + 1 - chunk->data) : 0, searched = size;
    for (;;) {
        const char *newline = memchr(chunk->data + searched, '\n', chunk->size - searched);
        if (newline) {
            chunk->size = (size_t)(newline + 1 - chunk->data);
            return TN_OK;
        }
        searched = chunk->size;
        if (searched - line > lines->max_line)
            return TN_OK;
        tn_status status = read_at(lines, reader, at + searched, LONG_LINE_BYTES, error);
        if (status != TN_OK || chunk->size == searched)
            return status;
    }
}

tn_status tn_plan_lines_read(tn_plan_lines *lines, const tn_plan_reader *reader, uint64_t begin, size_t size,
                             uint64_t *count, tn_error *error)
{
    tn_buffer *chunk = &lines->chunk;
    chunk->size = lines->at = 0;
    lines->line = *count = 0;
    uint64_t at = reader->shared + begin;
    tn_status status = read_at(lines, reader, at, size + BEHIND_BYTES, error);
    if (status != TN_OK)
        return status;
    if (begin > 0) { /* the line that is cut there is of the stretch before */
        size_t own = size < chunk->size ? size : chunk->size;
        const char *newline = own ? memchr(chunk->data, '\n', own) : NULL;
        if (!newline) {
            chunk->size = 0;
            return TN_OK;
        }
        lines->at = (size_t)(newline + 1 - chunk->data);
    }
    status = end_with_line(lines, reader, at, size, error);
    *count = status == TN_OK ? count_lines(chunk->data + lines->at, chunk->size - lines->at) : 0;
    return status;
}

/* ---- what is held */

static bool next_line(tn_plan_lines *lines)
{
    size_t left = lines->chunk.size - lines->at;
    if (left == 0)
        return false;
    lines->text = lines->chunk.data + lines->at;
    const char *newline = memchr(lines->text, '\n', left);
    lines->text_size = newline ? (size_t)(newline - lines->text) : left;
    lines->at += lines->text_size + (newline ? 1 : 0);
    lines->line++;
    return true;
}

static tn_status refuse_line(tn_plan_lines *lines, tn_error *error)
{
    lines->text = NULL;
    lines->text_size = 0;
    return tn_reader_line_too_long(lines->max_line, lines->line, error);
}

tn_status tn_plan_lines_next(tn_plan_lines *lines, const tn_plan **plan, tn_error *error)
{
    *plan = NULL;
    while (next_line(lines)) {
        if (lines->text_size > lines->max_line)
            return refuse_line(lines, error);
        lines->text_size -= lines->text_size > 0 && lines->text[lines->text_size - 1] == '\r';
        char first = tn_reader_first(lines->text, lines->text_size);
        if (first == '#' || (lines->json && !first))
            continue;
        tn_status status = lines->json ? tn_plan_scan_json(lines->scanner, lines->text, lines->text_size,
                                                           lines->max_length, &lines->plan, error)
                                       : tn_plan_scan_line(lines->scanner, lines->text, lines->text_size,
                                                           lines->max_length, &lines->plan, error);
        if (status == TN_OK)
            *plan = &lines->plan;
        else if (error)
            error->line = lines->line;
        if (status != TN_OK && error && error->column == 0)
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
