/* The tokens of a file as a formatter sees them, and the laying out of expressions, which the notations share. Internal
 * to format*.c. */
#ifndef TARTAN_COMPILER_FORMAT_TOKENS_H
#define TARTAN_COMPILER_FORMAT_TOKENS_H

#include "compiler/layout.h"
#include "compiler/token.h"

typedef struct tn_format_comment {
    const char *text;
    size_t size;
    bool blank; /* an empty line is before it */
} tn_format_comment;

typedef struct tn_format_token {
    tn_token_kind kind;
    const char *text;
    size_t size, width;
    const tn_format_comment *comments; /* on lines of their own before it */
    size_t comment_count;
    tn_format_comment remark; /* after it on its line; text NULL where there is none */
    bool blank;               /* an empty line is before it, and after its comments */
    bool breaks;              /* on the same line as the token before it, the two would be one */
    size_t match;             /* of a bracket: the other one */
    size_t offset;            /* in the source */
    size_t line;              /* where it was put */
} tn_format_token;

typedef struct tn_format {
    tn_layout layout;
    tn_format_token *tokens; /* followed by one of no text, which has the comments at the end */
    size_t count;
} tn_format;

#define TN_FORMAT_TOO_WIDE ((size_t)1 << 30)

/* Is token i this word of the language or sign? */
bool tn_format_is(const tn_format *format, size_t i, const char *text);

/* The columns that tokens [first, last) take on one line; TN_FORMAT_TOO_WIDE where they do not fit any, or have
 * comments between them. A comment before the first counts, one after the last does not. */
size_t tn_format_width(const tn_format *format, size_t first, size_t last);

/* Puts one token at the cursor, `gap` blanks after what is there, with its comments. */
void tn_format_put(tn_format *format, size_t i, size_t gap);
/* Puts tokens [first, last) on this line. */
void tn_format_flat(tn_format *format, size_t first, size_t last);

/* How a stretch can be split. */
typedef bool tn_format_split(const tn_format *format, size_t i);

/* Lays out tokens [first, last) from the cursor on, on one line where `tail` more columns fit after it; otherwise at
 * its weakest operators, then inside its brackets. */
void tn_format_expression(tn_format *format, size_t first, size_t last, size_t tail);

/* Lays out tokens [first, last) in as few lines as they take: parts begin where `splits` says (or, where `after`, end
 * there), and new lines are indented so. */
void tn_format_fill(tn_format *format, size_t first, size_t last, tn_format_split *splits, bool after, size_t indent,
                    size_t tail);

/* Puts the comments before token i on lines of their own, with the empty lines between; `blank`: at least one. */
void tn_format_gap(tn_format *format, size_t i, size_t indent, bool blank);

/* format_plan.c: lays out a .plan file. */
void tn_format_plan(tn_format *format);

#endif
