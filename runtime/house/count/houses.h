/* All houses of a library: counted without going through plans or houses. Their ranks: runtime/house/rank/rank.h.
 *
 * The row is read tray by tray. What has to be known between two trays is a state; the states that plans and houses
 * reach together are counted, layer by layer (runtime/house/frontier says what a state is). Sections that nothing tells
 * apart share the work. Past a limit of states it is TN_LIMIT (E1640), which names the clause that makes the most of
 * them; houses beyond it can only be gone through (listing.h).
 *
 * A tn_houses belongs to one thread, and borrows the form and the library of plans.
 */
#ifndef TARTAN_HOUSE_COUNT_HOUSES_H
#define TARTAN_HOUSE_COUNT_HOUSES_H

#include <gmp.h>

#include "runtime/house/count/listing.h"
#include "runtime/house/frontier/frontier.h"
#include "runtime/house/house_names.h"
#include "runtime/house/measure/measure.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/measure/complete.h"
#include "runtime/plan/measure/distribution.h"

#define TN_HOUSES_STATES_DEFAULT 3000000u

typedef struct tn_houses tn_houses;

/* max_states: of a section, with plans; 0 is the default. */
tn_status tn_houses_new(const tn_house_form *form, const tn_house_library_record *library, const tn_library *plans,
                        uint32_t max_states, tn_houses **houses, tn_error *error);

/* TN_INVALID (E1610) if two trays that are side by side in a plan of the library cannot stand so in the form. Ask this
 * first: of a library that passes, every plan stands. */
tn_status tn_houses_check_walls(const tn_house_form *form, const tn_house_library_record *library,
                                const tn_library *plans, tn_error *error);

/* TN_LIMIT (E1687) if a clause of the library, or one of the measures (NULL: none), asks for walks or ways out: states
 * would hold a length for each pair of doors between two trays. Such houses are gone through, on one plan (listing.h). */
tn_status tn_houses_check_walks(const tn_house_form *form, const tn_house_library_record *library,
                                const tn_house_measures *measures, tn_error *error);

/* What is found out by measures: how the houses are spread over the values of the first, the least values of so many
 * houses (measure by measure in their order), or the values that no house betters in one measure without losing in
 * another; or what completes an open plan, and the best that the first measure, if there is one, still can be. */
typedef enum tn_houses_aim { TN_HOUSES_SPREAD, TN_HOUSES_LEAST, TN_HOUSES_FRONT, TN_HOUSES_COMPLETE } tn_houses_aim;

/* The houses on one plan of the library (only, of that length; NULL: on all; without a library of plans, NULL, any
 * plan will do), and the measures that they are counted
 * by (NULL: none). Both are borrowed. With measures only what they are for may be asked: tn_houses_spread, or
 * tn_houses_points.
 */
typedef struct tn_houses_what {
    const tn_tray *only;
    uint32_t length;
    const tn_house_measures *measures;
    tn_houses_aim aim;
    uint64_t wanted;                    /* houses, by TN_HOUSES_LEAST */
    const tn_frontier_without *without; /* or NULL */
} tn_houses_what;
tn_status tn_houses_of(const tn_house_form *form, const tn_house_library_record *library, const tn_library *plans,
                       const tn_houses_what *what, uint32_t max_states, tn_houses **houses, tn_error *error);
void tn_houses_free(tn_houses *houses);

/* A library that differs from another in its clauses alone: in a copy of its form's module, which borrows the clauses
 * and all else. It must not be moved, as `form` points into it. */
typedef struct tn_other_clauses {
    tn_module module;
    tn_house_library_record library;
    tn_house_form form;
} tn_other_clauses;
void tn_other_clauses_set(const tn_house_form *form, const tn_house_library_record *library,
                          const tn_house_clause_record *clauses, uint32_t count, tn_other_clauses *other);

/* How the houses are spread over the values of the first measure; `distribution` is initialised. */
tn_status tn_houses_spread(const tn_houses *houses, tn_distribution *distribution, tn_error *error);

/* What the houses on plans that complete an open one have in its written trays, made with TN_HOUSES_COMPLETE: `plans`
 * and counts are of houses; `best` in steps of the first measure. Clear with tn_completions_clear in any case. */
tn_status tn_houses_complete(tn_houses *houses, const tn_open_plan *open, tn_completions *completions, tn_error *error);

/* How many there are on plans of a length, or (TN_ALL_LENGTHS) in all; faced: without tiles, of those with any. */
void tn_houses_count(const tn_houses *houses, uint32_t length, mpz_t count);
void tn_houses_faced(const tn_houses *houses, mpz_t faced);

/* Is the latter known? It is not if clauses compare what tiles add to: sums of tiles are counted one by one then. */
bool tn_houses_faced_known(const tn_houses *houses);

/* How many have a section (a value for each choice of the form). */
void tn_houses_of_section(const tn_houses *houses, const uint32_t *shapes, mpz_t count);

/* How many plans have a house; how many sections of each plan, and how many functions of the cells in these, in all. */
typedef struct tn_houses_projected {
    mpz_t plans, sections, functions;
} tn_houses_projected;
void tn_houses_projected_init(tn_houses_projected *counts);
void tn_houses_projected_clear(tn_houses_projected *counts);

/* Counts them, without measures; counts: of 0. TN_LIMIT (E1640) if it takes too many steps: choices that lead to one
 * plan have to be followed together. */
tn_status tn_houses_project(tn_houses *houses, tn_houses_projected *counts, tn_error *error);

/* States of all sections. */
uint64_t tn_houses_states(const tn_houses *houses);

/* ---- the best houses by measures: the values that were aimed at. The houses that have them: rank/rank.h */

/* How many values there are: of houses by measures, made with an aim of TN_HOUSES_LEAST or TN_HOUSES_FRONT. */
size_t tn_houses_points(const tn_houses *houses);

/* Value `point`, in steps of each measure, and how many houses have it. The values are in order, the best first; by
 * TN_HOUSES_LEAST so many that the wanted number of houses has one of them, if there are so many houses. */
void tn_houses_point(const tn_houses *houses, size_t point, int64_t *values, mpz_t count);

#endif
