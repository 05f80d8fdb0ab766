/* Where the cursor is, and what is offered there. Internal to complete*.c. */
#ifndef TARTAN_LSP_COMPLETE_PARTS_H
#define TARTAN_LSP_COMPLETE_PARTS_H

#include "compiler/plan/syntax/words.h"
#include "lsp/features.h"

/* CompletionItemKind of the protocol. */
enum {
    KIND_FUNCTION = 3,
    KIND_FIELD = 5,
    KIND_MODULE = 9,
    KIND_KEYWORD = 14,
    KIND_FILE = 17,
    KIND_VALUE = 20,
    KIND_STRUCT = 22
};

enum { DEPTH_MAX = 1024 }; /* brackets around the cursor that are told apart */

/* Where the cursor is. */
typedef struct tn_lsp_cursor {
    const tn_file_analysis *analysis;
    const char *text;
    const tn_vocabulary *words; /* of the notation */
    const tn_token *tokens;
    size_t count; /* tokens before the cursor; not the word that it is in or just behind */
    size_t item;  /* the word that starts the item; `count` where there is none */
    bool in_braces;
    size_t braces;              /* how many are open */
    size_t clause;              /* the last word at the level of the braces that starts a clause, field or case */
    size_t brackets[DEPTH_MAX]; /* open ones */
    size_t depth;
    uint64_t places; /* where a word of the language may stand here */
    json_t *list;
} tn_lsp_cursor;

/* ---- complete.c */

/* Is token i this word? */
bool tn_cursor_is(const tn_lsp_cursor *c, size_t i, const char *text);
/* Is it a word of the language that stands in one of these places, and is one of these uses there? */
bool tn_cursor_is_word(const tn_lsp_cursor *c, size_t i, uint64_t places, uint32_t uses);
char *tn_cursor_word(const tn_lsp_cursor *c, size_t i); /* a copy for the caller; or NULL */
/* The field of the schema that the part at the cursor begins with, or NULL. */
const tn_symbol *tn_cursor_field(const tn_lsp_cursor *c, const tn_symbol *schema);

/* Offers one more; those of an earlier group come first. */
void tn_offer(tn_lsp_cursor *c, const char *label, int kind, const char *detail, const char *group);
void tn_offer_words(tn_lsp_cursor *c, uint64_t places); /* that stand in these places */
/* What a schema declares; of the field alone, where there is one. */
void tn_offer_declared(tn_lsp_cursor *c, const tn_symbol *schema, const tn_symbol *field);
void tn_complete_codes(tn_lsp_cursor *c); /* of warnings */

/* ---- complete_houses.c */

/* In `cell(` and `room(`, whose bracket is that token. */
void tn_complete_cell(tn_lsp_cursor *c, size_t bracket, bool room);
/* In `section(`, whose bracket is that token: the choices of the form, then their values. */
void tn_complete_section(tn_lsp_cursor *c, size_t bracket);
/* In the braces of a form, outside of parentheses. */
void tn_complete_form(tn_lsp_cursor *c);

#endif
