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

/* What a text has, from its tokens, so that an editor can list it also while it is being typed. */

typedef enum tn_listing_kind {
    TN_LISTING_RULE,
    TN_LISTING_SETTING,
    TN_LISTING_CONSTANT,
    TN_LISTING_BLOCK, /* what is `inside` comes after it */
} tn_listing_kind;

typedef struct tn_listing_entry {
    tn_listing_kind kind;
    bool inside;    /* the block before it */
    tn_span name;   /* what it is called */
    tn_span whole;  /* all of it */
    tn_span detail; /* what is said of it, on the line of its name; empty: nothing */
} tn_listing_entry;

/* Lives in the arena, which remembers where memory ran out. */
typedef struct tn_listing {
    tn_arena *arena;
    const char *text;
    const tn_token *tokens; /* without comments */
    size_t count;
    tn_listing_entry *entries;
    size_t entry_count, capacity;
    tn_listing_entry forgotten; /* for which there was no memory */
} tn_listing;

/* Makes a listing of a text's tokens, with no entries yet. False if out of memory. */
bool tn_listing_start(tn_listing *listing, const char *text, const tn_tokens *tokens);

/* Is token i this, in capitals or not? */
bool tn_listing_is(const tn_listing *listing, size_t i, const char *text);

/* The next line end from token i on, or `last`. */
size_t tn_listing_line_end(const tn_listing *listing, size_t i, size_t last);

/* From the first to the last of tokens [first, last). */
tn_span tn_listing_span(const tn_listing *listing, size_t first, size_t last);

/* Adds an entry: tokens [first, named) are its name, the rest up to `last` its detail. Never NULL: where memory runs
 * out, one that is forgotten. Valid until the next is added. */
tn_listing_entry *tn_listing_add(tn_listing *listing, tn_listing_kind kind, size_t first, size_t named, size_t last);

#endif
