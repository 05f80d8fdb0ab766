/* Laying out files: their tokens as a formatter sees them, what the notations share in laying them out, and the text
 * that a formatter writes into. */
#ifndef TARTAN_COMPILER_COMMON_LAYOUT_H
#define TARTAN_COMPILER_COMMON_LAYOUT_H

#include <stdbool.h>
#include <stdint.h>

#include "compiler/common/arena.h"
#include "compiler/common/limits.h"
#include "compiler/common/source.h"
#include "compiler/common/token.h"
#include "compiler/common/words.h"

/* Text laid out in lines: what a formatter writes into. It counts columns, indents lines when something is put on them,
 * so that none ends in blanks, and lines up the comments at the ends of neighbouring lines.
 *
 * Everything lives in the arena; running out of memory is remembered by it. */

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

/* The text, with its size; NULL if out of memory. */
char *tn_layout_finish(tn_layout *layout, size_t *size);

typedef struct tn_format_comment {
    const char *text;
    size_t size;
    bool blank; /* an empty line is before it */
} tn_format_comment;

typedef struct tn_format_token {
    tn_token_kind kind;
    const char *text; /* of a house line, a new line where its author began one and one blank between other words */
    size_t size, width;
    const tn_format_comment *comments; /* on lines of their own before it */
    size_t comment_count;
    tn_format_comment remark; /* after it on its line; text NULL if there is none */
    bool blank;               /* an empty line is before it, and after its comments */
    size_t breaks;            /* line ends that have to be before it; mostly 0 */
    size_t line_ends;         /* those before it that mean something */
    size_t match;             /* of a bracket: the other one */
    size_t offset;            /* in the source */
    size_t line;              /* where it was put */
} tn_format_token;

typedef struct tn_format tn_format;

/* The blanks between token i and the one before it, on one line. */
typedef size_t tn_format_gap_before(const tn_format *format, size_t i);

/* May a new line begin at token i? How a stretch can be split. */
typedef bool tn_format_split(const tn_format *format, size_t i);

struct tn_format {
    tn_layout layout;
    tn_format_gap_before *gap_before;
    tn_format_split *at_part; /* the weakest splits of expressions, weaker than their operators */
    const void *tree;         /* what the notation's `read` made of the text */
    tn_format_token *tokens;  /* followed by one of no text, which has the comments at the end */
    size_t count;
};

/* How a word of the language is written, zero-ended, in the arena; NULL if out of memory. */
typedef const char *tn_format_spell(tn_arena *arena, const char *text, size_t size);
tn_format_spell tn_format_small_letters;

/* Makes the formatter's tokens from the lexer's: comments go to the tokens before or after them. Out of memory is the
 * arena's to remember. */
void tn_format_take(tn_format *format, tn_arena *arena, const tn_source *source, const tn_tokens *tokens,
                    tn_format_spell *spell);

/* Finds the pairs of brackets. False if they are nested too deep, *place is the token. */
#define TN_FORMAT_BRACKETS_MAX (4u * TN_NESTING_MAX) /* those that mean nothing count here too */
bool tn_format_match_brackets(tn_format *format, size_t *place);

#define TN_FORMAT_TOO_WIDE ((size_t)1 << 30)

/* Is token i this word of the language or sign? */
bool tn_format_is(const tn_format *format, size_t i, const char *text);
/* Is it one of these? The list ends in NULL. */
bool tn_format_is_any(const tn_format *format, size_t i, const char *const *texts);
/* Is token i a word of the language that stands in one of these places, and is one of these uses there? */
bool tn_format_is_word(const tn_format *format, size_t i, const tn_vocabulary *words, uint64_t places, uint32_t uses);

/* The columns that tokens [first, last) take on one line; TN_FORMAT_TOO_WIDE if they do not fit any, or have
 * comments between them. A comment before the first counts, one after the last does not. */
size_t tn_format_width(const tn_format *format, size_t first, size_t last);

/* Puts one token at the cursor, `gap` blanks after what is there, with its comments. */
void tn_format_put(tn_format *format, size_t i, size_t gap);
/* Puts tokens [first, last) on this line. */
void tn_format_flat(tn_format *format, size_t first, size_t last);

/* Lays out tokens [first, last) from the cursor on, on one line where `tail` more columns fit after it; otherwise at
 * its weakest operators, then inside its brackets. */
void tn_format_expression(tn_format *format, size_t first, size_t last, size_t tail);

/* Lays out tokens [first, last) in as few lines as they take: parts begin where `splits` says (or, where `after`, end
 * there), and new lines are indented so. */
void tn_format_fill(tn_format *format, size_t first, size_t last, tn_format_split *splits, bool after, size_t indent,
                    size_t tail);

/* Puts the comments before token i on lines of their own, with the empty lines between; `blank`: at least one. */
void tn_format_gap(tn_format *format, size_t i, size_t indent, bool blank);

/* Laying out notations whose statements end with `;` and stand in blocks: a statement a line; one that is too long goes
 * on where its next part begins. */

/* What a notation says of its tokens. */
typedef struct tn_statement_format {
    tn_format_gap_before *gap_before;
    bool (*at_part)(const tn_format *format, size_t i); /* may the statement go on in a new line here? */
    bool (*ends)(const tn_format *format, size_t i);    /* `;`, or a brace of a block of statements */
} tn_statement_format;

/* A minus that stands before what it turns round, not between two. */
bool tn_format_is_minus_sign(const tn_format *format, size_t i);

void tn_format_statements(tn_format *format, const tn_statement_format *how);

#endif
