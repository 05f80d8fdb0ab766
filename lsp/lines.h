/* Places as the protocol counts them: lines from 0, and in them UTF-16 code units; lines end with \n, \r\n or \r. */
#ifndef TARTAN_LSP_LINES_H
#define TARTAN_LSP_LINES_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

/* Where the lines of a text start. Borrows the text, owns the table. */
typedef struct tn_lines {
    const char *text;
    size_t size;
    size_t *starts;
    size_t count; /* at least 1 */
} tn_lines;

bool tn_lines_make(tn_lines *lines, const char *text, size_t size); /* false where out of memory */
void tn_lines_clear(tn_lines *lines);

/* The byte at a place; places past a line's end or the text's are cut there. */
size_t tn_lines_offset(const tn_lines *lines, size_t line, size_t character);

/* {"line", "character"} of a byte; {"start", "end"} of a stretch. */
json_t *tn_lines_position(const tn_lines *lines, size_t offset);
json_t *tn_lines_range(const tn_lines *lines, size_t begin, size_t end);

/* Reads a position; false where it is none. */
bool tn_lines_read(const tn_lines *lines, const json_t *position, size_t *offset);

#endif
