/* A rule file's text as it is edited: its tokens with the comments, and its syntax tree before anything is worked out.
 * Immutable once read. */
#ifndef TARTAN_COMPILER_PLAN_EDIT_RULE_TEXT_H
#define TARTAN_COMPILER_PLAN_EDIT_RULE_TEXT_H

#include "compiler/plan/syntax/ast.h"

typedef struct tn_rule_text {
    tn_arena *arena;
    tn_sources sources; /* the text is the first */
    const char *text;
    size_t size;
    const tn_ast_file *tree;
    const tn_token *tokens; /* without comments */
    size_t token_count;
    const tn_token *comments;
    size_t comment_count;
    bool parses;         /* without errors */
    const char *mistake; /* the first error, or NULL */
} tn_rule_text;

/* Reads a text. TN_MEMORY, TN_LIMIT; a text with mistakes is read as far as it can be. Clear in any case. */
tn_status tn_rule_text_read(const char *text, size_t size, tn_rule_text *to, tn_error *error);
void tn_rule_text_clear(tn_rule_text *text);

/* The rule of this name that stands in the text with a body, or NULL. */
const tn_ast_rule *tn_rule_text_find(const tn_rule_text *text, const char *name);

/* The rule that the byte stands in, or NULL. */
const tn_ast_rule *tn_rule_text_at(const tn_rule_text *text, size_t offset);

/* How many tokens begin before the byte. */
size_t tn_rule_text_token(const tn_rule_text *text, size_t offset);

#endif
