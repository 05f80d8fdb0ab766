/* One parsing of a source, by the lexer and the parser of a notation other than `.plan`: what these share with the
 * constructors of the syntax tree, and what is the same in all of these lexers.
 *
 * A tn_parsing lives on the caller's stack; everything that is made goes into the arena.
 */
#ifndef TARTAN_COMPILER_COMMON_PARSING_H
#define TARTAN_COMPILER_COMMON_PARSING_H

#include "compiler/common/arena.h"
#include "compiler/common/diagnostic.h"
#include "compiler/common/lexical.h"
#include "compiler/common/token.h"

/* A number as these lexers read it; `whole` is that of tn_parsing_whole. */
typedef struct tn_decimal {
    double value;
    tn_span span;
    uint64_t whole;
} tn_decimal;

typedef struct tn_parsing {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    const char *text;
    size_t size;
    uint32_t file;
    uint32_t offset;      /* of the next byte */
    uint32_t token_start; /* of a token that is read in pieces */
    uint32_t stray_end;   /* where the last stray character ended: a run of them is reported once */
    int last_token, token_before;
    const char *meant; /* what an unknown word was probably meant to be, or NULL */
    const char *named; /* the same of the last name, where the lexer remembers it; or NULL */
    tn_span name_span;
    bool evolves;      /* the last unknown word is a setting of an evolution */
    bool asks;         /* of a .kit text: it is conditions alone */
    bool reported;     /* the line at hand was complained of already */
    bool damaged;      /* something of the file is missing because of errors already reported */
    void *result;      /* the file of the notation, such as a tn_hemls_file */
    tn_tokens *tokens; /* where the lexer leaves what it read, or NULL */
    tn_lexer_pool pool;
} tn_parsing;

/* Is the source text at all (E0004)? */
bool tn_parsing_is_text(tn_parsing *parse);

/* Moves on to a token of `size` bytes; its place in *span. */
void tn_parsing_place(tn_parsing *parse, tn_span *span, size_t size);

/* A decimal number; an error (E0005) if it is too large. */
tn_decimal tn_parsing_number(tn_parsing *parse, tn_span span);

/* A whole number of 64 bits, exactly; the value is -1 where it is none. */
tn_decimal tn_parsing_whole(tn_parsing *parse, tn_span span);

/* Reports a character that no token starts with. */
void tn_parsing_stray(tn_parsing *parse, tn_span span, const char *help);

/* Reports E0001: what was found, what could have stood there. */
void tn_parsing_syntax_error(tn_parsing *parse, tn_span span, const char *found, const char *const *expected,
                             size_t count, const char *help);

#endif
