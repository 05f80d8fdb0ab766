/* Keeps source texts and finds lines and columns in them, also as editors count them (UTF-16). */
#include "compiler/common/source.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

/* ---- keeps source texts and finds lines and columns in them */

static const char *const byte_order_mark = "\xEF\xBB\xBF";

tn_status tn_sources_add(tn_sources *sources, const char *path, const char *text, size_t size, uint32_t *file,
                         tn_error *error)
{
    if (size > TN_SOURCE_BYTES_MAX)
        return tn_fail(error, TN_LIMIT, E_FILE_TOO_LARGE, "%s is %zu bytes long; the limit for a source file is %u",
                       path, size, TN_SOURCE_BYTES_MAX);
    if (size > TN_SOURCES_BYTES_MAX - sources->bytes)
        return tn_fail(error, TN_LIMIT, E_FILE_TOO_LARGE,
                       "with %s the source files together pass the limit of %u bytes", path, TN_SOURCES_BYTES_MAX);
    if (!tn_array_reserve_from(&sources->files, &sources->capacity, 8, sources->count, 1, sizeof *sources->files))
        return tn_fail_memory(error);
    tn_source source = {.path = strdup(path), .text = calloc(size + 2, 1), .size = size};
    if (!source.path || !source.text) {
        free(source.path);
        free(source.text);
        return tn_fail_memory(error);
    }
    if (size > 0)
        memcpy(source.text, text, size);
    sources->bytes += size;
    *file = (uint32_t)sources->count;
    sources->files[sources->count++] = source;
    return TN_OK;
}

void tn_sources_keep(tn_sources *sources, size_t count)
{
    while (sources->count > count) {
        tn_source *last = &sources->files[--sources->count];
        sources->bytes -= last->size;
        free(last->path);
        free(last->text);
        free(last->line_starts);
    }
}

void tn_sources_clear(tn_sources *sources)
{
    tn_sources_keep(sources, 0);
    free(sources->files);
    *sources = (tn_sources){0};
}

/* A byte order mark is no part of the first line: editors do not count it either. */
static size_t first_line(const tn_source *source)
{
    return source->size >= 3 && memcmp(source->text, byte_order_mark, 3) == 0 ? 3 : 0;
}

/* Finds where the lines start. Out of memory leaves the table empty, and find_line then walks the text. */
static void index_lines(tn_source *source)
{
    size_t count = 1;
    for (size_t i = 0; i < source->size; i++)
        count += source->text[i] == '\n';
    uint32_t *starts = malloc(count * sizeof *starts);
    if (!starts)
        return;
    starts[0] = (uint32_t)first_line(source);
    size_t line = 1;
    for (size_t i = 0; i < source->size; i++)
        if (source->text[i] == '\n')
            starts[line++] = (uint32_t)(i + 1);
    source->line_starts = starts;
    source->line_count = count;
}

/* The line (from 0) that holds an offset, and where it starts. */
static size_t find_line(const tn_source *source, size_t offset, size_t *start)
{
    if (!source->line_starts) {
        size_t line = 0;
        *start = first_line(source);
        for (size_t i = 0; i < offset; i++) {
            if (source->text[i] == '\n') {
                line++;
                *start = i + 1;
            }
        }
        return line;
    }
    size_t low = 0, high = source->line_count; /* starts[low] <= offset < starts[high] */
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (source->line_starts[middle] <= offset)
            low = middle;
        else
            high = middle;
    }
    *start = source->line_starts[low];
    return low;
}

/* Bytes of the line that starts there, without its line end ("\n" or "\r\n"). */
static size_t line_size(const tn_source *source, size_t start)
{
    const char *text = source->text + start;
    const char *end = memchr(text, '\n', source->size - start);
    size_t size = end ? (size_t)(end - text) : source->size - start;
    return size > 0 && text[size - 1] == '\r' ? size - 1 : size;
}

tn_place tn_sources_place(tn_sources *sources, tn_span span)
{
    if (span.file >= sources->count)
        return (tn_place){.path = "", .line_text = ""};
    tn_source *source = &sources->files[span.file];
    if (!source->line_starts)
        index_lines(source);
    size_t begin = span.begin < source->size ? span.begin : source->size;
    size_t end = span.end < source->size ? span.end : source->size;
    if (end < begin)
        end = begin;
    size_t start, end_start;
    size_t line = find_line(source, begin, &start);
    size_t end_line = find_line(source, end, &end_start);
    return (tn_place){
        .path = source->path,
        .line = line + 1,
        .column = (begin > start ? begin - start : 0) + 1,
        .end_line = end_line + 1,
        .end_column = (end > end_start ? end - end_start : 0) + 1,
        .line_text = source->text + start,
        .line_size = line_size(source, start),
    };
}

/* ---- converts editors' places (UTF-16) to bytes, and back */

static bool ends_line(const char *text, size_t size, size_t i)
{
    return text[i] == '\n' || (text[i] == '\r' && (i + 1 == size || text[i + 1] != '\n'));
}

bool tn_lines_make(tn_lines *lines, const char *text, size_t size)
{
    size_t count = 1;
    for (size_t i = 0; i < size; i++)
        count += ends_line(text, size, i);
    *lines = (tn_lines){text, size, malloc(count * sizeof *lines->starts), 1};
    if (!lines->starts)
        return false;
    lines->starts[0] = 0;
    for (size_t i = 0; i < size; i++)
        if (ends_line(text, size, i))
            lines->starts[lines->count++] = i + 1;
    return true;
}

void tn_lines_clear(tn_lines *lines)
{
    free(lines->starts);
    *lines = (tn_lines){0};
}

/* Bytes of the character at the start of a text, and its UTF-16 units. What is not UTF-8 counts as one of each. */
static size_t character_at(const char *text, size_t size, size_t *units)
{
    unsigned char first = (unsigned char)*text;
    size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 1;
    *units = bytes == 4 ? 2 : 1;
    if (bytes <= size)
        return bytes;
    *units = 1;
    return 1;
}

static size_t line_end(const tn_lines *lines, size_t line)
{
    size_t end = line + 1 < lines->count ? lines->starts[line + 1] : lines->size;
    while (end > lines->starts[line] && (lines->text[end - 1] == '\n' || lines->text[end - 1] == '\r'))
        end--;
    return end;
}

size_t tn_lines_offset(const tn_lines *lines, size_t line, size_t character)
{
    if (line >= lines->count)
        return lines->size;
    size_t at = lines->starts[line], end = line_end(lines, line), units;
    while (at < end && character > 0) {
        size_t bytes = character_at(lines->text + at, end - at, &units);
        if (units > character)
            break;
        at += bytes;
        character -= units;
    }
    return at;
}

void tn_lines_place(const tn_lines *lines, size_t offset, size_t *line, size_t *character)
{
    size_t low = 0, high = lines->count, units;
    if (offset > lines->size)
        offset = lines->size;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (lines->starts[middle] <= offset)
            low = middle;
        else
            high = middle;
    }
    *line = low;
    *character = 0;
    for (size_t at = lines->starts[low]; at < offset; *character += units)
        at += character_at(lines->text + at, lines->size - at, &units);
}
