/* Words for a syntax error: what was found, what could have stood there, and what was probably meant. */
#ifndef TARTAN_COMPILER_SYNTAX_ERROR_H
#define TARTAN_COMPILER_SYNTAX_ERROR_H

#include "compiler/lexical.h"
#include "compiler/parse.h"

/* Reports E0001 or a code of its own for a mistake that is known. `found` and `expected` are the grammar's names of
 * tokens
 * ("`rule`", "a name"). */
void tn_syntax_error(tn_parse *parse, tn_span span, const char *found, const char *const *expected, size_t count);

#endif
