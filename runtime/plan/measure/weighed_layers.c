/* Layers of states by the trays before them, and by the trays to come. */
#include "runtime/plan/measure/weighed_layers.h"

#include "runtime/plan/library/library_data.h"

uint32_t tn_weighed_last_layer(const tn_weighed *weighed)
{
    return tn_weighed_library(weighed)->max;
}

bool tn_weighed_ends(const tn_weighed *weighed, uint32_t state)
{
    return tn_weighed_alive(weighed, 0, state) && tn_weighed_valued(weighed, state);
}

/* ---- after n trays */

/* Does a kept plan of the library's lengths follow, after n trays? */
static bool leads_on(const tn_weighed *weighed, uint32_t n, uint32_t state)
{
    const tn_library *library = tn_weighed_library(weighed);
    uint32_t low = n < library->min ? library->min - n : 0;
    for (uint32_t left = low; left <= library->max - n; left++)
        if (tn_weighed_alive(weighed, left, state))
            return true;
    return false;
}

static tn_status edges_after(void *context, uint32_t layer, uint32_t state, tn_walk_seen *seen, void *walk,
                             tn_error *error)
{
    const tn_weighed_edge *edges;
    size_t count;
    tn_status status = tn_weighed_edges(context, state, &edges, &count, error);
    for (size_t e = 0; status == TN_OK && e < count; e++)
        if (leads_on(context, layer + 1, edges[e].target))
            status = seen(walk, edges[e].target, &edges[e], error);
    return status;
}

const tn_walk_graph tn_weighed_after = {tn_walk_starts_first, edges_after};

/* ---- with max - n trays to come */

static bool starts_length(void *context, uint32_t layer)
{
    const tn_library *library = tn_weighed_library(context);
    uint32_t length = library->max - layer;
    return length >= library->min && tn_weighed_alive(context, length, 0);
}

static tn_status edges_to_come(void *context, uint32_t layer, uint32_t state, tn_walk_seen *seen, void *walk,
                               tn_error *error)
{
    uint32_t left = tn_weighed_library(context)->max - layer;
    const tn_weighed_edge *edges;
    size_t count;
    tn_status status = tn_weighed_edges(context, state, &edges, &count, error);
    for (size_t e = 0; status == TN_OK && e < count; e++)
        if (tn_weighed_alive(context, left - 1, edges[e].target))
            status = seen(walk, edges[e].target, &edges[e], error);
    return status;
}

const tn_walk_graph tn_weighed_to_come = {starts_length, edges_to_come};
