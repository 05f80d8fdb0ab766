/* Plans of a library without its automaton: each length of plans is a question to a solver that learns clauses. For
 * libraries whose clauses together pass the limits of automata.
 *
 * The clauses of a library become gates over the trays of a plan (unroll.h, letters.h). A clause whose gates pass a
 * limit is left out, and the interpreter judges each plan that is found, of all clauses: so a plan that is given is
 * always a plan of the library. In the literature's words this is lazy clause generation of the coarsest kind, with the
 * interpreter as the propagator.
 *
 * Plans are found in the order of their ranks as lexicographic optimisation with assumptions does it: what is before a
 * value is assumed, and whether the value may be a smaller one is asked.
 *
 * What is found depends on the library and the options alone. A tn_plan_search borrows the schema, and is used by one
 * thread. */
#ifndef TARTAN_PLAN_SEARCH_SEARCH_H
#define TARTAN_PLAN_SEARCH_SEARCH_H

#include "runtime/plan/schema/schema.h"

typedef struct tn_plan_search tn_plan_search;

typedef struct tn_search_options {
    bool override_trays; /* take the lengths below in place of the library's */
    uint32_t trays_min, trays_max;
    bool all_generated;     /* leave pruning out */
    uint32_t max_gates;     /* of one clause, on plans of one length; 0: TN_SEARCH_GATES_DEFAULT */
    uint64_t max_conflicts; /* of one question to the solver; 0: TN_SEARCH_CONFLICTS_DEFAULT (E0833 past it) */
} tn_search_options;

#define TN_SEARCH_GATES_DEFAULT (UINT32_C(4) << 20)
#define TN_SEARCH_CONFLICTS_DEFAULT UINT64_C(1000000)

/* Is there a solver to search with? */
bool tn_plan_search_is_there(void);

/* index: of the LIBRARY record. */
tn_status tn_plan_search_new(const tn_schema *schema, uint32_t index, const tn_search_options *options,
                             tn_plan_search **search, tn_error *error);
void tn_plan_search_free(tn_plan_search *search);

/* The plan of the next rank, from rank 0 on: *trays is valid until the next call, NULL: there is no other. TN_LIMIT
 * (E0809, E0833): it was not found within the limits, and neither is it known that there is none. */
tn_status tn_plan_search_next(tn_plan_search *search, const tn_tray **trays, uint32_t *length, tn_error *error);

/* Do all clauses that apply keep the plan? By the interpreter. */
tn_status tn_plan_search_keeps(tn_plan_search *search, const tn_tray *trays, uint32_t length, bool *keeps,
                               tn_error *error);

#endif
