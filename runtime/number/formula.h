/* An expression's code as it is made, operands before what is done with them: opcodes of engine MEASURE (opcodes.def),
 * as functions of modules hold them.
 *
 * Every notation's expressions become code here, and here alone constants are folded: an operation whose operands are
 * all numbers is computed at once, by the function that would compute it later, and its value stands in its place where
 * it is finite. Code that would run into what has no value stays as it is, and does so when it is run.
 */
#ifndef TARTAN_NUMBER_FORMULA_H
#define TARTAN_NUMBER_FORMULA_H

#include "runtime/base/error.h"
#include "runtime/number/operation.h"

/* Zero it to begin with; it may be begun again and again. */
typedef struct tn_formula {
    uint8_t *code; /* owned */
    size_t size, capacity;
    uint32_t height; /* of the stack behind the code so far */
    uint32_t depth;  /* the most that it was */
    size_t numbers;  /* instructions at the code's end that are numbers */
    bool failed;     /* out of memory; tn_formula_end says so */
} tn_formula;

void tn_formula_clear(tn_formula *formula);

/* Forgets the code and keeps its memory. */
void tn_formula_begin(tn_formula *formula);

void tn_formula_number(tn_formula *formula, double number); /* finite */
void tn_formula_term(tn_formula *formula, uint32_t term);   /* what whoever runs the code gives under this number */
void tn_formula_operation(tn_formula *formula, tn_opcode opcode, uint32_t arity);

/* Of fields: a coordinate; a number that is kept under the next local, instead of on the stack; one that was kept; the
 * distance of the place on the stack from a mesh. */
void tn_formula_coordinate(tn_formula *formula, uint32_t axis);
void tn_formula_keep(tn_formula *formula, uint32_t local);
void tn_formula_kept(tn_formula *formula, uint32_t local);
void tn_formula_mesh_distance(tn_formula *formula, uint32_t mesh);

/* Appends once more what stands from `begin` to `end`, the whole code of one number. False if the code would be
 * longer than `most`. */
bool tn_formula_repeat(tn_formula *formula, size_t begin, size_t end, size_t most);

/* Ends the code: TN_OK, or TN_MEMORY if something before this failed. */
tn_status tn_formula_end(tn_formula *formula, tn_error *error);

/* The terms that it asks for, of the first 64: bit i is that of term i. It has been ended. */
uint64_t tn_formula_terms(const tn_formula *formula);

/* Does it ask for any term? It has been ended. */
bool tn_formula_has_terms(const tn_formula *formula);

/* Is all of it one number? It has been ended. */
bool tn_formula_is_constant(const tn_formula *formula, double *number);

/* Sentences that are arithmetic, as grammars write them for `fit` (docs/evolution.md), read into code.
 *
 *   expression: either [(< <= > >= == !=) either]   either: both {| both}   both: sum {& sum}
 *   sum: term {(+|-) term}   term: factor {(*|/) factor}   factor: -factor | simple [** factor]
 *   simple: number | name | x[:, column] | function(expression, ...) | (expression) | ~factor | +factor
 *
 * The operations are the protected ones of operations.def, which have a value for all numbers. Sentences for Python are
 * read too: with NumPy's functions (`np.sin`) and those of PonyGE2 (`pdiv`, `psqrt`, `plog`, `rlog`, `aq`). */

#define TN_SENTENCE_CODE ((size_t)1 << 24) /* bytes of code that repeating conditions may come to */
#define TN_SENTENCE_NEST 1000u             /* how deep parentheses may nest */

/* Begins the formula and ends it. A name's term is its index. TN_INVALID with the column (E1242), TN_LIMIT if the
 * sentence nests too deep, TN_MEMORY. */
tn_status tn_sentence_read(const char *text, size_t size, const char *const *names, size_t name_count,
                           tn_formula *formula, tn_error *error);

#endif
