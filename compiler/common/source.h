/* Source texts and places in them.
 *
 * A tn_sources holds every file of a compilation. A span is a byte range in one of them; line and column are found
 * only when a diagnostic is shown. The set owns the texts; spans are plain values.
 */
#ifndef TARTAN_COMPILER_COMMON_SOURCE_H
#define TARTAN_COMPILER_COMMON_SOURCE_H

#include <stdbool.h>
#include <stddef.h>

#include "runtime/base/error.h"

typedef struct tn_span {
    uint32_t file;  /* index into the sources */
    uint32_t begin; /* byte offsets */
    uint32_t end;
} tn_span;

typedef struct tn_source {
    char *path; /* what diagnostics call it */
    char *text; /* followed by two zero bytes (flex scans in place) */
    size_t size;
    uint32_t *line_starts; /* byte offset of each line; found when first needed */
    size_t line_count;
} tn_source;

typedef struct tn_sources {
    tn_source *files;
    size_t count, capacity;
    size_t bytes; /* of all texts */
} tn_sources;

#define TN_SOURCE_BYTES_MAX (16u << 20)  /* of one text */
#define TN_SOURCES_BYTES_MAX (64u << 20) /* of all together: with it, a compilation's memory is bounded */

/* Adds a copy of a text; its index in *file. TN_LIMIT (E0804) past TN_SOURCE_BYTES_MAX or
 * TN_SOURCES_BYTES_MAX. */
tn_status tn_sources_add(tn_sources *sources, const char *path, const char *text, size_t size, uint32_t *file,
                         tn_error *error);
void tn_sources_clear(tn_sources *sources);

/* Forgets all but the first `count`. */
void tn_sources_keep(tn_sources *sources, size_t count);

typedef struct tn_place {
    const char *path;
    size_t line, column;         /* of the span's begin, from 1; columns count bytes */
    size_t end_line, end_column; /* of its end */
    const char *line_text;       /* the line of `begin`, without its line end, not zero-ended */
    size_t line_size;
} tn_place;

/* Where a span is. Spans past the end of the text are cut there; a byte order mark is not counted; the place in a file
 * that is not there is line 0. */
tn_place tn_sources_place(tn_sources *sources, tn_span span);

static inline tn_span tn_span_join(tn_span first, tn_span last)
{
    return (tn_span){first.file, first.begin, last.end > first.end ? last.end : first.end};
}

/* Places as editors count them (Language Server Protocol): lines from 0, and in them UTF-16 code units; lines end with
 * \n, \r\n or \r. */

/* Where the lines of a text start. Borrows the text, owns the table. */
typedef struct tn_lines {
    const char *text;
    size_t size;
    size_t *starts;
    size_t count; /* at least 1 */
} tn_lines;

bool tn_lines_make(tn_lines *lines, const char *text, size_t size); /* false if out of memory */
void tn_lines_clear(tn_lines *lines);

/* The byte at a place; places past a line's end or the text's are cut there. */
size_t tn_lines_offset(const tn_lines *lines, size_t line, size_t character);

/* The place of a byte, which is cut at the text's end. */
void tn_lines_place(const tn_lines *lines, size_t offset, size_t *line, size_t *character);

#endif
