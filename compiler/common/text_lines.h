/* Places as editors count them (Language Server Protocol): lines from 0, and in them UTF-16 code units; lines end with
 * \n, \r\n or \r. */
#ifndef TARTAN_COMPILER_COMMON_TEXT_LINES_H
#define TARTAN_COMPILER_COMMON_TEXT_LINES_H

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

/* The place of a byte, which is cut at the text's end. */
void tn_lines_place(const tn_lines *lines, size_t offset, size_t *line, size_t *character);

#endif
