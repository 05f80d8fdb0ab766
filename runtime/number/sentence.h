/* Sentences that are arithmetic, as grammars write them for `fit` (docs/evolution.md), read into code.
 *
 *   expression: term {(+|-) term}   term: factor {(*|/) factor}
 *   factor: number | name | function(expression, ...) | (expression) | -factor
 *
 * The operations are the protected ones of operations.def, which have a value for all numbers.
 */
#ifndef TARTAN_NUMBER_SENTENCE_H
#define TARTAN_NUMBER_SENTENCE_H

#include "runtime/number/formula.h"

#define TN_SENTENCE_NEST 1000u /* how deep parentheses may nest */

/* Begins the formula and ends it. A name's term is its index. TN_INVALID with the column (E1242), TN_LIMIT where the
 * sentence nests too deep, TN_MEMORY. */
tn_status tn_sentence_read(const char *text, size_t size, const char *const *names, size_t name_count,
                           tn_formula *formula, tn_error *error);

#endif
