/* Relations that are made of themselves: the least solution of linear equations, by elimination.
 *
 * X1 .. Xn are relations over non-empty stretches (marked.h). Of a right-linear system, equation i is
 *
 *     Xi = Ai1 X1 or ... or Ain Xn or Bi
 *
 * if AX says that a stretch is cut into one of A and one of X behind it; of a left-linear one, X comes first. Since an A
 * takes a letter at least, X = A X or B has the one solution A* B (Arden's lemma), and Gauss's elimination solves all
 * of them (Brzozowski and McCluskey, Signal flow graph techniques for sequential circuit state diagrams, 1963).
 *
 * A tn_linear is the right-hand side of an equation while it is put together: `by` for each unknown, and the rest. It
 * owns its automata. Zero one to begin with, and clear it also after a failure.
 */
#ifndef TARTAN_AUTOMATA_EQUATIONS_H
#define TARTAN_AUTOMATA_EQUATIONS_H

#include "runtime/automata/marked.h"

typedef struct tn_linear {
    uint32_t count;
    tn_dfa **by;  /* [count]: what stands beside each unknown; NULL: it does not occur */
    tn_dfa *rest; /* NULL: nothing. Made of the rest, empty stretches may be in it */
} tn_linear;

/* The unknown alone; TN_NO_STATE: none, and nothing. */
tn_status tn_linear_make(const tn_marked *marked, uint32_t count, uint32_t unknown, tn_linear *out, tn_error *error);
void tn_linear_clear(tn_linear *linear);
bool tn_linear_has_unknowns(const tn_linear *linear);

/* to := to or other. */
tn_status tn_linear_or(const tn_marked *marked, tn_linear *to, const tn_linear *other, tn_error *error);

/* Each automaton with `relation` before it, or behind it. */
tn_status tn_linear_chain(const tn_marked *marked, tn_linear *to, const tn_dfa *relation, bool before, tn_error *error);

/* Solves the equations Xi = sides[i]: `out` has an automaton for each, which the caller frees. Empty stretches of the
 * rests, and coefficients that take none, are left out. left: the unknowns come first. Uses the sides up. */
tn_status tn_linear_solve(const tn_marked *marked, tn_linear *sides, uint32_t count, bool left, tn_dfa **out,
                          tn_error *error);

#endif
