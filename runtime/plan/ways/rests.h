/* Derivations from left to right: what is left of one when some trays of a plan are read.
 *
 * A rest is a stack of what is still to be derived, and what the trays to come have to be besides. A plan is derived in
 * as many ways as there are ways through rests from its first tray to its end. So rests are the states of an automaton
 * that is not deterministic, which is made as it is read.
 *
 * What uses itself at its left end is derived from the first tray on (a left-corner derivation: Rosenkrantz, Lewis,
 * Deterministic left corner parsing, 1970): so no derivation goes on without a tray, and rules that use themselves only
 * at their left end, or only at their right end, have a bounded number of rests.
 *
 * Some facts depend on what lies before their stretch: an `ahead` is what is known of the trays read so far.
 * A tn_rests borrows the derivation, and belongs to one thread; it grows while it is read.
 */
#ifndef TARTAN_PLAN_WAYS_RESTS_H
#define TARTAN_PLAN_WAYS_RESTS_H

#include <gmp.h>

#include "runtime/plan/match/lower.h"
#include "runtime/plan/ways/derivation.h"
#include "runtime/plan/ways/projected.h"

typedef struct tn_rests tn_rests;

/* Rests, and in how many ways each comes about. Sorted by rest, each once. */
typedef struct tn_rest_list {
    uint32_t *rests;
    mpz_t *ways;
    uint32_t count;
    size_t rest_room, ways_room;
} tn_rest_list;

/* Adds so many ways to those of a rest. */
tn_status tn_rest_list_add(tn_rest_list *list, uint32_t rest, const mpz_t ways, tn_error *error);
void tn_rest_list_clear(tn_rest_list *list);

#define TN_RESTS_MAX (UINT32_C(1) << 21) /* E0802 past it */

/* lowering: for the library's classes and lengths; not needed any more when this returns. longest: the most trays that
 * a plan has. TN_LIMIT (E0802) if a fact's automaton passes the bounds. */
tn_status tn_rests_new(const tn_derivation *derivation, tn_lowering *lowering, uint32_t longest, tn_rests **out,
                       tn_error *error);

/* Of a projected library: the letters are those of `projected`, which is borrowed. */
tn_status tn_rests_projected(const tn_projected *projected, uint32_t longest, tn_rests **out, tn_error *error);
void tn_rests_free(tn_rests *rests);

/* Before the first tray. The list is the rests'. A plan without trays is not asked about. */
#define TN_AHEAD_START 0u
tn_status tn_rests_begin(tn_rests *rests, const tn_rest_list **list, tn_error *error);

/* What is known ahead with one letter more. */
tn_status tn_rests_ahead(tn_rests *rests, uint32_t ahead, uint32_t letter, uint32_t *next, tn_error *error);

/* The rests behind a letter; ahead: with that letter. The list is the rests'. */
tn_status tn_rests_read(tn_rests *rests, uint32_t rest, uint32_t letter, uint32_t ahead, const tn_rest_list **list,
                        tn_error *error);

/* How many trays have to come at least, and whether the plan may end here. */
uint32_t tn_rests_least(const tn_rests *rests, uint32_t rest);
bool tn_rests_end(const tn_rests *rests, uint32_t rest);

#endif
