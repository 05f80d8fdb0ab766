/* What a sum asks of the whole plan, as automata over classes: the rules that `matches` counts, what has to hold for
 * the sum to have a value, and how long gaps are. Internal to weighed.c and weighed_whole.c. */
#ifndef TARTAN_PLAN_MEASURE_WEIGHED_WHOLE_H
#define TARTAN_PLAN_MEASURE_WEIGHED_WHOLE_H

#include "runtime/plan/match/lower.h"
#include "runtime/plan/schema/sum.h"

#define TN_GAPS_MAX 1000u /* different lengths of gaps: more are E0802 */

typedef struct tn_weighed_asked {
    tn_dfa *dfa;
    int64_t each; /* steps of a plan that it accepts */
    bool needed;  /* of one that it does not accept the sum has no value */
} tn_weighed_asked;

typedef struct tn_weighed_whole {
    tn_weighed_asked *items;
    size_t count, room;
} tn_weighed_whole;

/* Adds what term i of the sum asks (tn_term_of_whole). max_trays: of the plans. */
tn_status tn_weighed_ask_whole(tn_weighed_whole *whole, tn_lowering *lowering, const tn_sum *sum, uint32_t i,
                               uint32_t max_trays, tn_error *error);
void tn_weighed_whole_clear(tn_weighed_whole *whole);

#endif
