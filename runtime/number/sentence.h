/* Sentences that are arithmetic, as grammars write them for `fit` (docs/evolution.md), read into code.
 *
 *   expression: either [(< <= > >= == !=) either]   either: both {| both}   both: sum {& sum}
 *   sum: term {(+|-) term}   term: factor {(*|/) factor}   factor: -factor | simple [** factor]
 *   simple: number | name | x[:, column] | function(expression, ...) | (expression) | ~factor | +factor
 *
 * The operations are the protected ones of operations.def, which have a value for all numbers. Sentences for Python are
 * read too: with NumPy's functions (`np.sin`) and those of PonyGE2 (`pdiv`, `psqrt`, `plog`, `rlog`, `aq`).
 */
#ifndef TARTAN_NUMBER_SENTENCE_H
#define TARTAN_NUMBER_SENTENCE_H

#include "runtime/number/formula.h"

#define TN_SENTENCE_CODE ((size_t)1 << 24) /* bytes of code that repeating conditions may come to */
#define TN_SENTENCE_NEST 1000u             /* how deep parentheses may nest */

/* Begins the formula and ends it. A name's term is its index. TN_INVALID with the column (E1242), TN_LIMIT where the
 * sentence nests too deep, TN_MEMORY. */
tn_status tn_sentence_read(const char *text, size_t size, const char *const *names, size_t name_count,
                           tn_formula *formula, tn_error *error);

#endif
