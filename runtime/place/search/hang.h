/* What hangs on what: which of the puts of a plan are held, through the rules' connectors, by where the model starts.
 *
 * A tn_hang keeps its arrays from one plan to the next; it belongs to one thread. */
#ifndef TARTAN_PLACE_SEARCH_HANG_H
#define TARTAN_PLACE_SEARCH_HANG_H

#include "runtime/place/search/world.h"

/* A connector of what is put. */
typedef struct tn_hang_socket {
    int32_t at[3];
    uint32_t put; /* one more than its index; 0: none */
} tn_hang_socket;

typedef struct tn_hang {
    tn_hang_socket *sockets; /* a hash table by place */
    size_t socket_size;
    uint32_t *order;
    bool *held;
    size_t capacity;
    tn_open_site *sites; /* of the held ones, in order */
    size_t site_count, site_capacity;
} tn_hang;

/* Keeps those puts of the plan that are held, each behind one that it hangs on, and opens the connectors that are near
 * the region: what was taken away lay there. The region grows by what falls. */
tn_status tn_hang_keep(tn_hang *hang, const tn_site_choices *choices, tn_standing *plan, tn_cell_box *region,
                       tn_error *error);
void tn_hang_clear(tn_hang *hang);

#endif
