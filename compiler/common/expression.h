/* Expressions of numbers, of whatever notation: the tree that a parser's actions build, what its names mean, its code.
 *
 * A notation says which names there are and which functions (tn_expression_scope); operations, folding and code are
 * those of runtime/number. Trees live in an arena.
 */
#ifndef TARTAN_COMPILER_COMMON_EXPRESSION_H
#define TARTAN_COMPILER_COMMON_EXPRESSION_H

#include "compiler/common/arena.h"
#include "compiler/common/diagnostic.h"
#include "compiler/common/words.h"
#include "runtime/module/builder.h"
#include "runtime/number/formula.h"

typedef struct tn_expression {
    tn_opcode
        op; /* TN_OP_NUMBER, TN_OP_TERM, an operation's; TN_OPCODE_COUNT: a function that is yet to be looked up */
    tn_span span;
    double number;
    const char *name; /* of a term or function */
    tn_span name_span;
    uint32_t term;                      /* index of the name in the scope, once it was checked */
    struct tn_expression *first, *last; /* operands */
    struct tn_expression *next;         /* operand of the same */
    uint32_t operand_count;
    uint32_t depth;  /* nodes one inside another */
    uint32_t height; /* numbers that its code holds at once, at most */
} tn_expression;

/* Constructors. NULL if out of memory, which the arena remembers. */
tn_expression *tn_expression_number(tn_arena *arena, tn_span span, double number);
tn_expression *tn_expression_name(tn_arena *arena, tn_span span, const char *name);
tn_expression *tn_expression_call(tn_arena *arena, tn_span span, const char *name, tn_expression *first);
tn_expression *tn_expression_of(tn_arena *arena, tn_opcode op, tn_span span, tn_expression *a, tn_expression *b,
                                tn_expression *c); /* b and c: NULL past the operation's arity */

/* Adds an operand behind the others; nothing if one of both is NULL. */
void tn_expression_add(tn_expression *expression, tn_expression *operand);

/* What the expressions of a notation can speak of. */
typedef struct tn_expression_scope {
    const char *const *names; /* of terms */
    uint32_t count;
    tn_words words;                     /* whose functions */
    const char *what;                   /* a name is the name of: "term" */
    const char *examples[TN_ARITY_MAX]; /* arguments of a function of one, two, three */
    const char *split;                  /* help where an expression nests too deep */
    tn_code unknown, wrong;             /* codes of errors: a name that is not there, anything else */
    const tn_vocabulary *vocabulary;    /* of the notation: some of its words are written as functions are; or NULL */
    uint64_t places;                    /* of the vocabulary: where its expressions stand */
} tn_expression_scope;

/* How a function that other languages have is written by these words: of the arguments a and b. Empty: it cannot be.
 * NULL: no other language is known to have a function of this name. */
const char *tn_function_elsewhere(tn_words words, const char *name);

/* Does a name mean something in expressions, so that nothing else should be called so? */
bool tn_expression_reserves(const tn_expression_scope *scope, const char *name);

/* Looks up the names, and says what is wrong. Code is for expressions of which nothing was. */
void tn_expression_check(tn_diagnostics *diagnostics, const tn_expression_scope *scope, tn_expression *expression);

/* The code of the expression's value: begins the formula and ends it. TN_OK or TN_MEMORY. */
tn_status tn_expression_code(const tn_expression *expression, tn_formula *formula, tn_error *error);

/* Is it a comparison, or made of some by `and`, `or` and `not`? */
bool tn_expression_is_condition(const tn_expression *expression);

/* The code of how far the expression, taken for a condition, is from holding: 0 if it holds, else above 0, and no
 * value where it has none. Of a <= b it is max(0, a - b), of a = b |a - b|, of `and` the sum, of `or` the least; `not`
 * is pushed inward, to the opposite comparisons; a strict comparison that fails, and `!=`, give at least 1e-9. What is
 * no condition holds where it is not 0. For searching, which wants a slope. With `shares`, the distance of a comparison
 * is a share of its bound's size, or of 1 where that is larger, so that degrees, counts and lengths can be added to one
 * another and to goals; the bound is the side that is a number, or the right one. */
tn_status tn_expression_violation(const tn_expression *expression, bool shares, tn_formula *formula, tn_error *error);

/* Adds the formula to a module as a function of this kind and name, and returns its index. */
uint32_t tn_formula_emit(tn_builder *builder, tn_function_kind kind, const char *name, const tn_formula *formula);

#endif
