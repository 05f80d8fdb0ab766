/* What a tn_houses is made of, for the files that implement houses.h. */
#ifndef TARTAN_HOUSE_STRIP_HOUSES_DATA_H
#define TARTAN_HOUSE_STRIP_HOUSES_DATA_H

#include "runtime/house/strip/houses.h"
#include "runtime/house/strip/parts.h"
#include "runtime/house/variant/section.h"

/* The nodes after so many trays: {state of the library of plans, state of the strip}. */
typedef struct tn_houses_layer {
    tn_numbering nodes; /* plan state << 32 | state */
    mpz_t *ahead; /* [nodes][lengths]: houses on plans of each length that go on from there; NULL: not asked for */
} tn_houses_layer;

/* A way on from a plan state: a slice, the plan state behind it, how many choices of trays and of their insides. */
typedef struct tn_houses_way {
    uint32_t slice, plan;
    uint64_t times;
} tn_houses_way;

/* The sections that nothing tells apart. */
typedef struct tn_houses_kind {
    tn_section_key key;
    uint32_t sections; /* how many */
    tn_strip *strip;
    tn_houses_layer *layers; /* [max + 1] */
    mpz_t *houses;           /* [lengths], of one section */
    mpz_t faced;
} tn_houses_kind;

struct tn_houses {
    const tn_house_form *form;
    const tn_house_library_record *library;
    const tn_library *plans;
    uint32_t max_states, low, high; /* trays */
    tn_sections sections;
    tn_houses_kind *kinds;
    size_t kind_count, kind_room;
    bool ranked; /* what is ahead of each node is known */
};

/* A step from a node: `from` among those of the layer. */
typedef struct tn_houses_edge {
    uint32_t from, plan, state;
    uint64_t ways, times, faced; /* ways: of trays and slices; times: of what is at the plane, and tiles */
} tn_houses_edge;
typedef tn_status tn_houses_edge_seen(void *context, const tn_houses_edge *edge, tn_error *error);

/* Shows all steps from the nodes of a layer to plans of the library; with `end`, those to the end of the row. */
tn_status tn_houses_expand(const tn_houses *houses, tn_houses_kind *kind, uint32_t layer, bool end,
                           tn_houses_edge_seen *seen, void *context, tn_error *error);

/* May a plan state after so many trays lead to a plan of the library? */
bool tn_houses_plan_lives(const tn_houses *houses, uint32_t layer, uint32_t plan);

static inline uint32_t tn_houses_lengths(const tn_houses *houses)
{
    return houses->high - houses->low + 1;
}

#endif
