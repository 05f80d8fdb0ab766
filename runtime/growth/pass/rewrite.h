/* What both ways of rewriting share: counting, room and numbers for what replaces edges (internal to the growth
 * engine). */
#ifndef TARTAN_GROWTH_PASS_REWRITE_H
#define TARTAN_GROWTH_PASS_REWRITE_H

#include "runtime/growth/pass/pass.h"

/* How many of each, so far or in a chunk. */
typedef struct tn_rewrite_tally {
    uint64_t rewrites, kept, pieces, vertices, branches;
} tn_rewrite_tally;

/* Memory for what the counts say, and the first numbers of each kind. */
tn_status tn_rewrite_make_room(tn_pass *pass, const tn_rewrite_tally *total, tn_error *error);

/* An edge that is not replaced gets this number. */
static inline void tn_rewrite_keep(tn_pass *pass, uint32_t edge, uint32_t number)
{
    pass->records[edge] = (tn_record){2 * number, 0, pass->branch_first, TN_NO_TEMPLATE, 0};
    tn_edge_state state = pass->old->states[edge];
    pass->new->states[number] = pass->joins_last ? state & ~TN_STATE_FRESH : state;
}

/* The record of a chain's first edge becomes that of all. */
void tn_rewrite_along(tn_pass *pass, const tn_edge_replacement *chain);

/* TN_LIMIT: an age or a coordinate left its range. */
tn_status tn_rewrite_out_of_range(const tn_pass *pass, tn_error *error);

#endif
