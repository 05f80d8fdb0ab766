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

#include <gmp.h>

#include "runtime/plan/measure/open_plan.h"

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

/* How many trays its plans may have; least > most: there are none. */
void tn_plan_search_lengths(const tn_plan_search *search, uint32_t *least, uint32_t *most);

/* Plans that were found, which the owner frees. */
typedef struct tn_searched_plan {
    tn_tray *trays;
    uint32_t length;
    mpq_t value; /* of a best plan: in the measure's unit of nanometres to its power */
} tn_searched_plan;

typedef struct tn_searched_plans {
    tn_searched_plan *items;
    size_t count, capacity;
} tn_searched_plans;

void tn_searched_plans_clear(tn_searched_plans *plans);

/* Adds so many different plans of `min` to `max` trays, or all that there are, in the order of their ranks, after those
 * that are there. Values are guessed at random as the solver goes, by seed alone: not each plan is as likely as each.
 * The search is used up. */
tn_status tn_plan_search_sample(tn_plan_search *search, uint64_t seed, uint32_t min, uint32_t max, size_t count,
                                tn_searched_plans *plans, tn_error *error);

/* Whether it is proven that no other plan is better. */
typedef struct tn_search_proof {
    bool proven;
    mpq_t bound; /* if not: no plan of the library has more (or less, if the least is the best); of the owner,
                    initialised */
} tn_search_proof;

/* Adds the `count` plans, or all that there are, that have most (or least) of a SUM record's value, the best first. The
 * sum must not be about gaps. plans: empty. The search is used up. */
tn_status tn_plan_search_best(tn_plan_search *search, uint32_t sum, bool most, size_t count, tn_searched_plans *plans,
                              tn_search_proof *proof, tn_error *error);

/* Why a library has no plan. */
typedef struct tn_search_conflict {
    bool empty;        /* it has none */
    uint32_t *clauses; /* [count], of the library's, ascending: together they leave no plan of its lengths, and none can
                          be left out */
    size_t count;
    tn_searched_plans plans; /* [count]: which all of them but one keep */
} tn_search_conflict;

/* Clear it in any case. TN_LIMIT (E0833): it is not known whether the library is empty, or why. The search is used up.
 */
tn_status tn_plan_search_conflict(tn_plan_search *search, tn_search_conflict *conflict, tn_error *error);
void tn_search_conflict_clear(tn_search_conflict *conflict);

/* ---- narrower: before the first plan, and what is borrowed has to stay */

/* Only plans that complete an open plan, whose trays are given. */
void tn_plan_search_narrow(tn_plan_search *search, const tn_open_plan *open);

/* Another library, and what fields, values and trays of the search's schema are in its own (tn_field_map_make
 * and tn_tray_map, runtime/plan/library/diff.h). */
typedef struct tn_search_other {
    tn_plan_search *search;
    const uint32_t *fields;
    const uint8_t *values; /* of a field's value, in the schema's order: which of the other field's */
    const tn_tray *trays;  /* NULL: the same */
} tn_search_other;

/* Only plans that the other library does not keep. */
void tn_plan_search_leave_out(tn_plan_search *search, const tn_search_other *other);

/* ---- other questions */

/* With how many parts of an open plan, from its first on, a plan of the library can begin, whatever follows. *any:
 * there is a plan at all. The search is used up. */
tn_status tn_plan_search_beginning(tn_plan_search *search, const tn_open_plan *open, bool *any, size_t *parts,
                                   tn_error *error);

/* Adds the first `most` plans, in the order of their ranks, of those nearest to a plan (runtime/plan/library/near.h
 * says how distances are); none: the library has none. *more: others are as near. plans: empty. The search is used up.
 */
tn_status tn_plan_search_near(tn_plan_search *search, const tn_tray *trays, size_t length, size_t most,
                              tn_searched_plans *plans, uint32_t *distance, bool *more, tn_error *error);

/* The best trade-offs of some measures, as far as they were found. */
typedef struct tn_searched_point {
    tn_tray *trays; /* the first plan that has these values */
    uint32_t length;
    mpq_t values[TN_WEIGHED_MAX]; /* in the measures' units of nanometres to their powers */
} tn_searched_point;

typedef struct tn_searched_front {
    tn_searched_point *points; /* best first by the measures in their order */
    size_t count, capacity;
    bool proven; /* no plan betters one of them, and none is missing */
} tn_searched_front;

/* sums: SUM records, up to TN_WEIGHED_MAX, none about gaps; most: more of it is better, else less. front: empty; clear
 * it in any case. The search is used up. */
tn_status tn_plan_search_front(tn_plan_search *search, const uint32_t *sums, const bool *most, uint32_t count,
                               tn_searched_front *front, tn_error *error);
void tn_searched_front_clear(tn_searched_front *front);

/* Do all clauses that apply keep the plan? By the interpreter. */
tn_status tn_plan_search_keeps(tn_plan_search *search, const tn_tray *trays, uint32_t length, bool *keeps,
                               tn_error *error);

#endif
