/* Text laid out in lines: what a formatter writes into. It counts columns, indents lines when something is put on them,
 * so that none ends in blanks, and lines up the comments at the ends of neighbouring lines.
 *
 * Everything lives in the arena; running out of memory is remembered by it.
 */
#ifndef TARTAN_COMPILER_COMMON_LAYOUT_H
#define TARTAN_COMPILER_COMMON_LAYOUT_H

#include <stdbool.h>
#include <stdint.h>

#include "compiler/common/arena.h"

#define TN_FORMAT_WIDTH 100u /* characters of a line, where it can be broken */

/* A comment at the end of a line. */
typedef struct tn_remark {
    size_t offset; /* of the line's end in the text */
    size_t line, column;
    const char *text;
    size_t size;
} tn_remark;

typedef struct tn_layout {
    tn_arena *arena;
    char *text;
    size_t size, capacity;
    size_t line;   /* from 1 */
    size_t indent; /* of this line */
    size_t column; /* where the next character comes, from 0 */
    size_t gap;    /* blanks that are counted but not yet put: none end a line */
    bool fresh;    /* nothing is on this line yet */
    bool remarked; /* a comment ends this line */
    bool blank;    /* the line before is empty, or there is none */
    tn_remark *remarks;
    size_t remark_count, remark_capacity;
} tn_layout;

void tn_layout_start(tn_layout *layout, tn_arena *arena);

/* Puts a text without line ends. */
void tn_layout_put(tn_layout *layout, const char *text, size_t size);
void tn_layout_spaces(tn_layout *layout, size_t count);

/* Goes on in a new line, indented so; a line on which nothing is yet is used. */
void tn_layout_line(tn_layout *layout, size_t indent);

/* Leaves so many lines empty before the next, where empty lines mean something. */
void tn_layout_feed(tn_layout *layout, size_t count);

/* Leaves one line empty before the next, but not at the start. The cursor is on a fresh line. */
void tn_layout_blank(tn_layout *layout);

/* Ends the line with a comment. */
void tn_layout_remark(tn_layout *layout, const char *text, size_t size);

/* The text, with its size; NULL where out of memory. */
char *tn_layout_finish(tn_layout *layout, size_t *size);

/* Characters in a UTF-8 text. */
size_t tn_text_width(const char *text, size_t size);

#endif
