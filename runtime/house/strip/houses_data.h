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
    int64_t gain; /* what the tray adds to the plan's part of the measure */
} tn_houses_way;

/* How many there are of each value, in steps: ascending. */
typedef struct tn_value_count {
    int64_t value;
    mpz_t count;
} tn_value_count;

typedef struct tn_value_counts {
    tn_value_count *items;
    size_t count, room;
} tn_value_counts;

void tn_value_counts_clear(tn_value_counts *counts);

/* The sections that nothing tells apart. */
typedef struct tn_houses_kind {
    tn_section_key key;
    uint32_t sections; /* how many */
    tn_strip *strip;
    tn_houses_layer *layers; /* [max + 1] */
    mpz_t *houses;           /* [lengths], of one section */
    mpz_t faced;
    tn_value_counts spread; /* houses of one section, by the measure */
} tn_houses_kind;

struct tn_houses {
    const tn_house_form *form;
    const tn_house_library_record *library;
    const tn_library *plans;
    uint32_t max_states, low, high; /* trays */
    tn_sections sections;
    tn_houses_kind *kinds;
    size_t kind_count, kind_room;
    bool ranked;                     /* what is ahead of each node is known */
    const tn_tray *only;             /* [high]: the one plan that is looked at, or NULL */
    const tn_house_weights *weights; /* of a measure, or NULL; then plans are those of `weighed` */
    tn_weighed *weighed;
};

/* A step from a node: `from` among those of the layer. */
typedef struct tn_houses_edge {
    uint32_t from, plan, state;
    uint64_t ways, times, faced; /* ways: of trays and slices; times: of what is at the plane, and tiles */
    int64_t gain;                /* what it adds to the measure */
} tn_houses_edge;
typedef tn_status tn_houses_edge_seen(void *context, const tn_houses_edge *edge, tn_error *error);

/* Shows all steps from the nodes of a layer to plans of the library; with `end`, those to the end of the row. */
tn_status tn_houses_expand(const tn_houses *houses, tn_houses_kind *kind, uint32_t layer, bool end,
                           tn_houses_edge_seen *seen, void *context, tn_error *error);

/* The plans that are looked at: where a tray leads, and what it adds; TN_STRIP_NONE: to none of them. */
tn_status tn_houses_plan_next(const tn_houses *houses, uint32_t layer, uint32_t plan, tn_tray tray, uint32_t *next,
                              int64_t *gain, tn_error *error);
bool tn_houses_plan_alive(const tn_houses *houses, uint32_t left, uint32_t plan);
int64_t tn_houses_plan_rest(const tn_houses *houses, uint32_t plan); /* what the end of the plan adds */

/* Counts the houses of one section by the values of the measure. */
tn_status tn_houses_spread_kind(const tn_houses *houses, tn_houses_kind *kind, tn_error *error);

/* May a plan state after so many trays lead to a plan of the library? */
bool tn_houses_plan_lives(const tn_houses *houses, uint32_t layer, uint32_t plan);

static inline uint32_t tn_houses_lengths(const tn_houses *houses)
{
    return houses->high - houses->low + 1;
}

#endif
