/* Clauses that are applied one after another to the same plans, when many questions leave out one of them, or turn one
 * round: what the clauses before it keep is kept here as an automaton, and what runs of the clauses after it keep as
 * automata that are applied at once.
 *
 * Borrows the clauses' automata; owns the rest. Once made it is only read, so that threads may share it.
 */
#ifndef TARTAN_PLAN_LIBRARY_SEQUENCE_H
#define TARTAN_PLAN_LIBRARY_SEQUENCE_H

#include "runtime/automata/count.h"

typedef struct tn_sequence_clause {
    const tn_dfa *dfa;
    tn_dfa_operation keeping; /* TN_DFA_AND: keeps what dfa accepts; TN_DFA_MINUS: what it does not */
} tn_sequence_clause;

/* What clauses keep, from one of them to the end of its run. */
typedef struct tn_clause_run {
    tn_dfa *keeps; /* NULL: of one clause alone, or too large */
    size_t end;
} tn_clause_run;

typedef struct tn_sequence {
    tn_sequence_clause *clauses; /* [count], in the order in which they are applied */
    size_t count;
    size_t saved;        /* automata kept */
    tn_sparse **after;   /* [saved + 1]: the plans that the first clauses keep */
    tn_clause_run *runs; /* [count]: from each clause on */
    const char *what;    /* they are called in an error */
} tn_sequence;

/* Room for so many clauses, which the caller fills in; `all` are the plans to begin with and are taken over, also after
 * a failure. Clear in any case. */
tn_status tn_sequence_make(tn_sequence *sequence, size_t count, tn_sparse *all, const char *what, tn_error *error);
void tn_sequence_clear(tn_sequence *sequence);

/* Applies the clauses up to number `to` and keeps what the memory for that holds. */
tn_status tn_sequence_save(tn_sequence *sequence, size_t to, tn_bounds *bounds, tn_error *error);

/* Makes the runs: the bounds are of each; clauses that pass them are in none. */
tn_status tn_sequence_make_runs(tn_sequence *sequence, const tn_bounds *bounds, tn_error *error);

/* *base := the plans that the clauses before a number keep; the caller's. */
tn_status tn_sequence_before(const tn_sequence *sequence, size_t number, tn_bounds *bounds, tn_sparse **base,
                             tn_error *error);

/* *base := what of it the clauses from a number on keep. */
tn_status tn_sequence_apply(const tn_sequence *sequence, size_t from, tn_bounds *bounds, tn_sparse **base,
                            tn_error *error);

/* How many plans of min..max trays of *base the clauses from a number on keep; *base is used up on the way. sizes:
 * trays of each letter (count.h). The last automaton is counted and not made, in steps of its own bounds. */
tn_status tn_sequence_count(const tn_sequence *sequence, size_t from, const uint32_t *sizes, uint32_t min, uint32_t max,
                            tn_bounds *bounds, const tn_bounds *last, tn_sparse **base, mpz_t count, tn_error *error);

#endif
