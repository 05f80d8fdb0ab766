/* The kept plans nearest to a plan: a changed field costs 1, a tray added or removed as many as it has fields.
 *
 * Found by a shortest path (A*: Hart, Nilsson, Raphael 1968) over the states of the library's automaton, the places of
 * the plan, and how many trays have been written, not by trying plans.
 */
#ifndef TARTAN_PLAN_NEAR_H
#define TARTAN_PLAN_NEAR_H

#include "runtime/plan/library.h"

/* Nodes that a search may visit; past it E0808. */
#define TN_NEAR_NODES_MAX 8000000u

typedef struct tn_near_plan {
    tn_tray *trays; /* owned */
    uint32_t length;
} tn_near_plan;

typedef struct tn_near {
    uint32_t cost; /* of each */
    tn_near_plan *plans;
    size_t count;
    bool more; /* there are others as near */
} tn_near;

/* The first `most` of the nearest plans, in rank order; none where the library holds none. Clear in any case. */
tn_status tn_library_near(const tn_library *library, const tn_tray *trays, size_t length, size_t most, tn_near *near,
                          tn_error *error);
void tn_near_clear(tn_near *near);

/* How many fields differ. */
uint32_t tn_tray_distance(const tn_schema *schema, tn_tray a, tn_tray b);

#endif
