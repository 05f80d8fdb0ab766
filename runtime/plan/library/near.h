/* The kept plans nearest to a plan: a changed field costs 1, a tray added or removed as many as it has fields.
 *
 * Found by a shortest path over states of the library, places of the plan, and how many trays have been written, not by
 * trying plans. The library's automaton is not built: its clauses are combined as long as that is little work, and what
 * they are combined into is walked side by side, led by what each of them alone still costs (A*: Hart, Nilsson, Raphael
 * 1968). So a few plans are explained in less time than building the library would take, and also where it would pass
 * its limits.
 *
 * A tn_near_finder belongs to one thread; it borrows the schema.
 */
#ifndef TARTAN_PLAN_LIBRARY_NEAR_H
#define TARTAN_PLAN_LIBRARY_NEAR_H

#include "runtime/plan/schema/schema.h"

/* Nodes of the search for one plan (and sixteen times as many steps between them); past it E0808. */
#define TN_NEAR_NODES_MAX 500000u

typedef struct tn_near_finder tn_near_finder;

typedef struct tn_near_options {
    uint32_t max_states; /* of any clause's automata; 0: TN_STATES_DEFAULT (E0802 past it) */
    size_t combine;      /* how many edges clauses are combined up to, to begin with; 0: a default */
    uint32_t patience;   /* nodes that a search may visit before more is combined; 0: a default */
} tn_near_options;

/* index: of the LIBRARY record. */
tn_status tn_near_finder_new(const tn_schema *schema, uint32_t index, const tn_near_options *options,
                             tn_near_finder **finder, tn_error *error);
void tn_near_finder_free(tn_near_finder *finder);

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
tn_status tn_near_find(tn_near_finder *finder, const tn_tray *trays, size_t length, size_t most, tn_near *near,
                       tn_error *error);
void tn_near_clear(tn_near *near);

/* How many fields differ. */
uint32_t tn_tray_distance(const tn_schema *schema, tn_tray a, tn_tray b);

#endif
