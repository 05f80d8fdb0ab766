/* Automata without their dead state, transitions in rows of edges: what a library is combined in.
 *
 * A library's automaton may have a hundred thousand states and hundreds of columns, but most letters lead nowhere from
 * most states (a library of two dozen rules kept 13 of 100 transitions), so products and minimising run over the live
 * ones alone. Every state is reached from state 0 and reaches an accepting one; an automaton that accepts nothing has
 * no states.
 *
 * An automaton of words of bounded length has no cycle. Then products need not be minimised after they are made: walked
 * depth first, states are finished children first, and a finished state equal to an earlier one becomes that one
 * (sparse_fold.c).
 *
 * A tn_sparse is owned by its holder and immutable once made.
 */
#ifndef TARTAN_AUTOMATA_SPARSE_H
#define TARTAN_AUTOMATA_SPARSE_H

#include "runtime/automata/dfa.h"

typedef struct tn_sparse {
    uint32_t letters, columns, states;
    uint32_t *column; /* [letters] */
    size_t *first;    /* [states + 1]: a state's edges are a run of label and target */
    uint32_t *label;  /* columns; each at most once in a row */
    uint32_t *target;
    uint8_t *accept; /* [states] */
    bool folded;     /* minimal, and without a cycle: every edge leads to a state behind its own */
} tn_sparse;

void tn_sparse_free(tn_sparse *sparse);

/* What `dfa` accepts from state `start`. */
tn_status tn_sparse_make(const tn_dfa *dfa, uint32_t start, tn_sparse **out, tn_error *error);

/* The same language, states and columns, with a dead state after the others. */
tn_status tn_sparse_fill(const tn_sparse *sparse, tn_dfa **out, tn_error *error);

/* The same language with its dead state (if it has one), canonical; minimal where `sparse` is. */
tn_status tn_sparse_complete(const tn_sparse *sparse, tn_dfa **out, tn_error *error);

/* What a accepts and b accepts too (TN_DFA_AND) or does not (TN_DFA_MINUS); trimmed, but not minimal. */
tn_status tn_sparse_product(const tn_sparse *a, const tn_dfa *b, tn_dfa_operation operation, const char *what,
                            tn_bounds *bounds, tn_sparse **out, tn_error *error);

/* The words of min..max letters; folded. */
tn_status tn_sparse_words(uint32_t letters, uint32_t min, uint32_t max, tn_sparse **out, tn_error *error);

/* As tn_sparse_product, of a folded a; folded. The bounds' states and transitions are of what is made, the work is of
 * the pairs walked. */
tn_status tn_sparse_fold(const tn_sparse *a, const tn_dfa *b, tn_dfa_operation operation, const char *what,
                         tn_bounds *bounds, tn_sparse **out, tn_error *error);

/* By tn_sparse_fold where a is folded, else by tn_sparse_product. */
static inline tn_status tn_sparse_combine(const tn_sparse *a, const tn_dfa *b, tn_dfa_operation operation,
                                          const char *what, tn_bounds *bounds, tn_sparse **out, tn_error *error)
{
    return (a->folded ? tn_sparse_fold : tn_sparse_product)(a, b, operation, what, bounds, out, error);
}

tn_status tn_sparse_copy(const tn_sparse *sparse, tn_sparse **out, tn_error *error);

/* The same language with the fewest states, columns merged (sparse_minimise.c). Of what is folded: a copy. */
tn_status tn_sparse_minimise(const tn_sparse *sparse, tn_sparse **out, tn_error *error);

/* *sparse := what of it b accepts (TN_DFA_AND) or does not (TN_DFA_MINUS), minimal: by folding where it is folded, else
 * by product and minimising. */
tn_status tn_sparse_apply(tn_sparse **sparse, const tn_dfa *b, tn_dfa_operation operation, const char *what,
                          tn_bounds *bounds, tn_error *error);

/* Pairs of columns of two automata that some letter has, numbered in the order of first letters. Free with
 * tn_splits_clear, also after a failure. */
typedef struct tn_split {
    uint32_t label; /* of the product */
    uint32_t other; /* column of the second operand */
} tn_split;

typedef struct tn_splits {
    uint32_t columns; /* of the product */
    uint32_t *column; /* [letters] */
    size_t *first;    /* [columns of a + 1]: what a column of the first operand splits into is a run of splits */
    tn_split *splits;
} tn_splits;

bool tn_splits_make(tn_splits *splits, const tn_sparse *a, const tn_dfa *b);
void tn_splits_clear(tn_splits *splits);

/* Room for an automaton, its arrays' contents to be filled in; first is zeroed. NULL where out of memory. */
tn_sparse *tn_sparse_new(uint32_t letters, uint32_t columns, uint32_t states, size_t edges);

/* Edges by target: those into a state are a run of label and source. Free the arrays with tn_inverse_clear. */
typedef struct tn_inverse {
    size_t *first; /* [states + 1] */
    uint32_t *label;
    uint32_t *source;
} tn_inverse;

tn_status tn_inverse_make(const tn_sparse *sparse, tn_inverse *sources, tn_error *error);
void tn_inverse_clear(tn_inverse *sources);

#endif
