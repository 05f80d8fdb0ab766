/* Plans that are drawn from an automaton to find out what clauses do to it. */
#ifndef TARTAN_PLAN_LIBRARY_DRAWN_H
#define TARTAN_PLAN_LIBRARY_DRAWN_H

#include "runtime/automata/numbering.h"
#include "runtime/automata/sparse.h"

#define TN_DRAWN 64u

/* Draws plans of an automaton that is folded and accepts some plan, by random walks: not each is as likely, but the
 * same automaton gives the same ones. Clear in any case. */
typedef struct tn_drawn_plans {
    tn_key plans[TN_DRAWN];
    size_t count;
} tn_drawn_plans;

tn_status tn_drawn_plans_make(const tn_sparse *sparse, tn_drawn_plans *drawn, tn_error *error);
void tn_drawn_plans_clear(tn_drawn_plans *drawn);

/* Which of the plans dfa does not answer so, as bits. */
uint64_t tn_drawn_plans_failing(const tn_drawn_plans *drawn, const tn_dfa *dfa, bool accepts);

#endif
