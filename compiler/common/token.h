/* The tokens of a source in order, with its comments: what formatting and editors work on, where the syntax tree has
 * forgotten how things were written. A lexer leaves them in the parse's list, where there is one. */
#ifndef TARTAN_COMPILER_COMMON_TOKEN_H
#define TARTAN_COMPILER_COMMON_TOKEN_H

#include "compiler/common/arena.h"
#include "compiler/common/source.h"

typedef enum tn_token_kind {
    TN_TOKEN_WORD, /* of the language, in capitals or not */
    TN_TOKEN_NAME,
    TN_TOKEN_FIELD,       /* a name that heads a field of a schema */
    TN_TOKEN_CLAUSE_NAME, /* `require@12` */
    TN_TOKEN_NUMBER,
    TN_TOKEN_LENGTH,
    TN_TOKEN_STRING,
    TN_TOKEN_HOUSE, /* the line of a house in a test: one blank or line end in it is as good as several */
    TN_TOKEN_SIGN,
    TN_TOKEN_TEXT,    /* of a sentence of a grammar, as it is written */
    TN_TOKEN_STRAY,   /* passed over; a warning says so */
    TN_TOKEN_LINE,    /* one line end or several, where they mean something */
    TN_TOKEN_COMMENT, /* without its line end */
} tn_token_kind;

typedef struct tn_token {
    tn_span span;
    tn_token_kind kind;
} tn_token;

/* Lives in the arena. */
typedef struct tn_tokens {
    tn_arena *arena;
    tn_token *items;
    size_t count, capacity;
} tn_tokens;

/* Adds one; an empty span is left out, and so is everything where `tokens` is NULL. Out of memory is remembered by the
 * arena. */
void tn_token_add(tn_tokens *tokens, tn_token_kind kind, tn_span span);

#endif
