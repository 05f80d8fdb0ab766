/* Does any of the rules match? One automaton of their union, walked on eight plans side by side.
 *
 * A plan is decided as soon as the automaton is in its accepting sink, and of plans made at random most are after a few
 * trays. So the eight are looked at every TN_ANY_STEPS trays, and left when all are decided: that is one branch for
 * eight plans, and well guessed. Until the shortest plan ends its trays are read where they are.
 */
#ifndef TARTAN_PLAN_MATCH_MATCH_ANY_H
#define TARTAN_PLAN_MATCH_MATCH_ANY_H

#include "runtime/plan/match/match_lanes.h"

#define TN_ANY_STEPS 4
#define TN_ANY_STATES_MAX 4096u

typedef struct tn_any {
    uint8_t shift;
    uint16_t sink;   /* the accepting one; UINT16_MAX where there is none */
    uint16_t *table; /* [row << shift | state]; NULL: there is no such automaton */
    uint8_t *accept; /* by state */
} tn_any;

/* The union of the automata. Where it passes TN_ANY_STATES_MAX, or where the table would be too large to be fast, it is
 * left without a table. Free with tn_any_clear, also after a failure. */
tn_status tn_any_make(tn_any *any, const tn_row_map *map, tn_dfa *const *dfas, size_t count, tn_error *error);
void tn_any_clear(tn_any *any);

/* Decides plans [first, first + TN_LANES), where none is shorter than TN_ANY_STEPS and trays are rows, by their first
 * TN_ANY_STEPS trays; false where that is not enough for all of them. */
bool tn_any_glance(const tn_any *any, const tn_plan_array *plans, size_t first, uint8_t *matches);

/* Decides the plans in the lanes. */
void tn_any_walk(const tn_any *any, const tn_lanes *lanes, uint8_t matches[TN_LANES]);

#endif
