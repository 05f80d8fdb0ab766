/* What was probably meant where a token stands that no rule of the grammar takes. Internal to syntax_error.c. */
#ifndef TARTAN_COMPILER_PLAN_SYNTAX_SYNTAX_FIX_H
#define TARTAN_COMPILER_PLAN_SYNTAX_SYNTAX_FIX_H

#include "compiler/plan/syntax/parse.h"

/* The tokens that could have stood there, by the grammar's names. */
typedef struct tn_expected {
    const char *const *tokens;
    size_t count;
    bool said[96]; /* covered by a phrase */
} tn_expected;

bool tn_expects(const tn_expected *e, const char *token);
bool tn_is_keyword(const char *token); /* "`rule`" */
bool tn_starts_expression(const char *found);
/* Is the token a word that stands in one of these places and is one of these uses there? */
bool tn_token_is_word(const char *token, uint64_t places, uint32_t uses);

/* A likely fix, or NULL where none is known. found: the grammar's name of the token. */
const char *tn_syntax_fix(const tn_parse *parse, const char *found, const tn_expected *e);

#endif
