/* Words for a syntax error: what was found, what could have stood there, and what was probably meant. */
#ifndef TARTAN_COMPILER_COMMON_SYNTAX_ERROR_H
#define TARTAN_COMPILER_COMMON_SYNTAX_ERROR_H

#include "compiler/common/lexical.h"
#include "compiler/plan/syntax/parse.h"

/* The token that no rule of the grammar takes. */
typedef struct tn_syntax_found {
    tn_span span;
    const char *name; /* the grammar's: "`rule`", "a name" */
    tn_span after;    /* the name that it comes directly after; empty where it comes after something else */
} tn_syntax_found;

/* Reports E0001, at the token or, where that was a misspelled word of the language, at the name before it. `expected`
 * are the grammar's names of the tokens that it takes there. */
void tn_syntax_error(tn_parse *parse, const tn_syntax_found *found, const char *const *expected, size_t count);

#endif
