/* What a tn_houses is made of: the sections and their layers of nodes, and the steps between them. For the files that
 * answer the questions of houses.h, and those that look for single houses. */
#ifndef TARTAN_HOUSE_COUNT_DATA_H
#define TARTAN_HOUSE_COUNT_DATA_H

#include "runtime/automata/walk.h"
#include "runtime/house/count/section.h"
#include "runtime/house/frontier/states.h"
#include "runtime/house/rule/asked.h"
#include "runtime/house/rule/furnish.h"
#include "runtime/plan/measure/weighed.h"

typedef struct tn_houses tn_houses; /* houses.h */

/* How many there are of each value, in steps of each measure, by the first measure, then the next: ascending. */
typedef struct tn_value_count {
    tn_house_gain value;
    mpz_t count;
} tn_value_count;

typedef struct tn_value_counts {
    tn_value_count *items;
    size_t count, room;
} tn_value_counts;

void tn_value_counts_clear(tn_value_counts *counts);

/* counts += times, at the value. False: out of memory. */
bool tn_value_counts_add(tn_value_counts *counts, const tn_house_gain *value, const mpz_t times);
bool tn_value_counts_has(const tn_value_counts *counts, const tn_house_gain *value);

/* Drops what is not among the least values that so many houses have; what another value betters in one measure, and
 * none in another. */
void tn_value_counts_keep_least(tn_value_counts *counts, uint64_t wanted);
void tn_value_counts_keep_front(tn_value_counts *counts);

/* to += each value of `from`, more by `gain`, so many times. False: out of memory. */
bool tn_value_counts_add_shifted(tn_value_counts *to, const tn_value_counts *from, const tn_house_gain *gain,
                                 const mpz_t times);
int tn_house_gain_compare(const tn_house_gain *a, const tn_house_gain *b);
tn_house_gain tn_house_gain_sum(const tn_house_gain *a, const tn_house_gain *b);

/* The plan states after so many trays from which plans of the library go on. */
typedef struct tn_houses_plan_layer {
    tn_numbering states;
    uint32_t *alike; /* [states]: the first from which the same goes on */
} tn_houses_plan_layer;

/* Steps that counting went to the next layer, in how many ways; `all`: none is left out. slice: 0 if none is taken.
 */
typedef struct tn_kept_step {
    uint32_t from, to, slice;
    uint64_t times;
} tn_kept_step;

typedef struct tn_kept_steps {
    tn_kept_step *items;
    size_t count, room;
    bool all;
} tn_kept_steps;

/* The nodes after so many trays, or within a step: {state of the library of plans, state of the frontier or (within a
 * step) its exit, entry or slice state}. */
typedef struct tn_houses_layer {
    tn_numbering nodes; /* plan state << 32 | state */
    mpz_t *ahead;    /* [nodes][lengths]: houses on plans of each length that go on from there; NULL: not asked for */
    mpz_t **by_tray; /* [nodes][lengths]: NULL, or [trays] houses that go on by each; or NULL */
    tn_value_counts *best; /* [nodes][lengths]: the values that these add, as far as they are looked for; or NULL */
    tn_kept_steps kept;
} tn_houses_layer;

/* A way on from a plan state: a slice, the plan state after it, how many choices of trays and of their insides. */
typedef struct tn_houses_way {
    uint32_t slice, entry, group, plan; /* entry, group: of the slice */
    uint64_t times;
    tn_house_gain gain; /* what the tray adds to the plan's part of the measures */
    tn_tray tray;       /* 0 if it does not matter which one it is */
} tn_houses_way;

/* The sections that nothing tells apart. */
typedef struct tn_houses_kind {
    tn_section_key key;
    uint32_t sections; /* how many */
    tn_frontier *frontier;
    tn_houses_layer *layers; /* [high * stages + 1] */
    mpz_t *houses;           /* [lengths], of one section */
    mpz_t faced;
    tn_value_counts spread; /* houses of one section, by the measures */
    tn_interner beginnings; /* of plans: {length, trays so far} */
    mpz_t **by_beginning;   /* [beginnings]: NULL, or [trays] houses of one section that go on by each */
    size_t beginning_room;
    size_t kept_steps; /* in all layers */
} tn_houses_kind;

struct tn_houses {
    const tn_house_form *form;
    const tn_house_library_record *library;
    const tn_library *plans;
    uint32_t max_states, low, high;     /* trays */
    const tn_frontier_without *without; /* or NULL; only while they are counted */
    tn_houses_plan_layer *plan_layers;  /* [high + 1] */
    tn_sections sections;
    tn_houses_kind *kinds;
    size_t kind_count, kind_room;
    size_t by_tray_count;                        /* numbers that are kept there */
    bool ranked;                                 /* what is ahead of each node is known */
    const tn_tray *only;                         /* [high]: the one plan that is looked at, or NULL */
    const tn_house_measures *measures;           /* or NULL; else plans are those of `weighed` */
    tn_house_added added;                        /* these, and what clauses compare */
    tn_house_weights *compared[TN_COMPARED_MAX]; /* the latter; owned */
    uint32_t compared_count;
    tn_weighed *weighed;
    tn_frontier_units units; /* that values are in */
    bool trays_matter;       /* to whom steps are shown */
    bool keep_trays;         /* ways are by tray, though steps have stages */
    uint32_t many_slices;    /* along one plan, with fewer, a step as a whole is quicker than one in stages */
    bool whole_steps;        /* these are so few that stages would cost more */
    bool aimed;              /* values are looked for: */
    bool front;              /* those of the front, else the least */
    uint64_t wanted;         /* houses, of the least values */
    tn_value_counts best;    /* of all houses, as far as they are aimed at */
    tn_furnisher *furnisher; /* or NULL: not asked for */
};

/* The kind that a section is of, NULL if no such is known. */
tn_houses_kind *tn_houses_kind_of(const tn_houses *houses, const tn_house *section);

/* Layers from one tray to the next: 4, or 1 if a step is not divided, as something is added up on the way, trays
 * matter, or steps are few. Layers that are multiples of it are of states after trays. */
static inline uint32_t tn_houses_stages(const tn_houses *houses, const tn_houses_kind *kind)
{
    return tn_frontier_has_stages(kind->frontier) && !houses->trays_matter && !houses->whole_steps ? 4 : 1;
}

/* TN_LIMIT (E1640) if more can stand between two trays than the limit of states allows. */
tn_status tn_houses_check_interfaces(const tn_houses *houses, const tn_houses_kind *kind, tn_error *error);

/* A step from a node: `from` among those of the layer. */
typedef struct tn_houses_edge {
    uint32_t from, plan, state, slice; /* slice: 0 if none is taken */
    uint64_t ways, times, faced;       /* ways: of trays and slices; times: of what is at the interface, and tiles */
    tn_house_gain gain;                /* what it adds to the measures */
    tn_tray tray;                      /* 0 if it does not matter */
} tn_houses_edge;
typedef tn_status tn_houses_edge_seen(void *context, const tn_houses_edge *edge, tn_error *error);

/* Shows all steps from the nodes of a layer to plans of the library; with `end`, from a layer of states, those to the
 * end of the row. `state` of a step is what the next layer is of. */
tn_status tn_houses_expand(const tn_houses *houses, tn_houses_kind *kind, uint32_t layer, bool end,
                           tn_houses_edge_seen *seen, void *context, tn_error *error);

/* The layers of a kind as a graph of keys (walk.h); the labels of its edges are tn_houses_edge. */
typedef struct tn_houses_layers {
    const tn_houses *houses;
    tn_houses_kind *kind;
    tn_key_walk walk;
} tn_houses_layers;

/* Makes the layers ready for a walk, with the first node; if they are there already, the walk is over their nodes. */
tn_status tn_houses_layers_begin(tn_houses_layers *layers, const tn_houses *houses, tn_houses_kind *kind,
                                 tn_error *error);

/* The same forwards, from the first node on, once. */
tn_status tn_houses_go_forward(const tn_houses *houses, tn_houses_kind *kind, const tn_key_question *question,
                               tn_error *error);

/* Keeps a step of a layer that counting goes, since ranks go the same ones backwards. If there are too many, those
 * of the layer are forgotten. */
tn_status tn_houses_keep_step(const tn_houses *houses, tn_houses_kind *kind, uint32_t layer, uint32_t to,
                              const tn_houses_edge *edge, tn_error *error);
void tn_houses_forget_steps(tn_houses_kind *kind, uint32_t layer);

/* Frees the layers of the kind. */
void tn_houses_layers_clear(const tn_houses *houses, tn_houses_kind *kind);

/* Finds the plan states, and the trays that stand in some plan. trays: zeroed; clear them also after a failure. */
tn_status tn_houses_plans_find(tn_houses *houses, tn_frontier_trays *trays, tn_error *error);
void tn_frontier_trays_clear(tn_frontier_trays *trays);
void tn_houses_plans_clear(tn_houses *houses);

/* The plans that are looked at: where a tray leads, and what it adds; TN_FRONTIER_NONE: to none of them. layer: the
 * trays before it. */
tn_status tn_houses_plan_next(const tn_houses *houses, uint32_t layer, uint32_t plan, tn_tray tray, uint32_t *next,
                              tn_house_gain *gain, tn_error *error);
bool tn_houses_plan_alive(const tn_houses *houses, uint32_t left, uint32_t plan);
tn_house_gain tn_houses_plan_start(const tn_houses *houses);
tn_house_gain tn_houses_plan_rest(const tn_houses *houses, uint32_t plan); /* what the end of the plan adds */

/* The same from those nodes alone of which `here` [nodes of the layer] is not 0. */
tn_status tn_houses_expand_from(const tn_houses *houses, tn_houses_kind *kind, uint32_t layer, mpz_t *here,
                                tn_houses_edge_seen *seen, void *context, tn_error *error);

/* Finds what is added up (added.c). TN_LIMIT (E1640) if a clause compares what cannot be. */
tn_status tn_houses_find_added(tn_houses *houses, tn_error *error);
void tn_houses_added_clear(tn_houses *houses);

void tn_houses_units_init(tn_frontier_units *units);
void tn_houses_units_clear(tn_frontier_units *units);

/* Finds the steps that the numbers of all measures are whole numbers of, once all sections are scouted. E0424. */
tn_status tn_houses_settle(tn_houses *houses, tn_error *error);

/* A value as it is given out, in steps of the measure's `shown`: costs are rounded half up. */
int64_t tn_houses_shown(const tn_houses *houses, uint32_t measure, tn_int128 value);

/* Counts the houses of one section by the values of the measure. */
tn_status tn_houses_spread_kind(const tn_houses *houses, tn_houses_kind *kind, tn_error *error);

/* What completes houses by their tiles; made when it is asked for first. */
tn_status tn_houses_furnisher(tn_houses *houses, tn_furnisher **furnisher, tn_error *error);

/* Finds the values that are aimed at, from the nodes that counting has met (best.c). */
tn_status tn_houses_aim_kind(const tn_houses *houses, tn_houses_kind *kind, tn_error *error);
tn_status tn_houses_aim_all(tn_houses *houses, tn_error *error);

/* Reports that there are too many values. */
tn_status tn_houses_too_many_values(const tn_houses *houses, tn_error *error);

/* Holds the count to going through the houses, if these and the plans are at most so many and that is no more than the
 * limit of work; TN_INTERNAL if they differ. For builds for tests. */
tn_status tn_houses_recount(const tn_houses *houses, uint64_t most, tn_error *error);

/* May a plan state after so many trays lead to a plan of the library? */
bool tn_houses_plan_lives(const tn_houses *houses, uint32_t layer, uint32_t plan);

static inline uint32_t tn_houses_lengths(const tn_houses *houses)
{
    return houses->high - houses->low + 1;
}

#endif
