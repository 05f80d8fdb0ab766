/* A derivation under way: what choosing, looking ahead and taking steps share. Internal to this folder. */
#ifndef TARTAN_PLACE_DERIVATION_H
#define TARTAN_PLACE_DERIVATION_H

#include <stdint.h>

#include "runtime/place/acts.h"
#include "runtime/place/grow.h"

/* The random numbers of the published connection-grammar program: MT19937 (Matsumoto and Nishimura 1998), seeded by
 * init_genrand, 53 bits a draw. Only .pcfg grammars use it, so that a seed gives that program's models; everything else
 * in Tartan draws from runtime/base/random.h. */

typedef struct tn_mersenne {
    uint32_t state[624];
    uint32_t next;
} tn_mersenne;

void tn_mersenne_seed(tn_mersenne *generator, uint32_t seed);

/* At least 0 and below 1. */
double tn_mersenne_draw(tn_mersenne *generator);

/* Where an alternative is being read. */
typedef struct cursor {
    uint32_t next, end; /* steps */
    uint32_t alternative;
} cursor;

typedef struct frame_stack {
    tn_frame *items;
    size_t count, capacity;
} frame_stack;

typedef struct cursor_stack {
    cursor *items;
    size_t count, capacity;
} cursor_stack;

/* An alternative whose acts are being done. */
typedef struct begun {
    const tn_act *next, *end;
    tn_frame frame; /* at which it began */
    uint32_t depth; /* frames at its start, with that one */
    uint32_t alternative;
} begun;

typedef struct begun_stack {
    begun *items;
    size_t count, capacity;
} begun_stack;

/* A box that a step filled, kept where somebody asks what is in the way. */
typedef struct filled_box {
    tn_cell_box box;
    uint32_t step, parts;
} filled_box;

typedef struct filled_boxes {
    filled_box *items;
    size_t count, capacity;
} filled_boxes;

/* The step at which a lookahead failed, and its box. */
typedef struct refusal {
    uint32_t step;
    tn_cell_box box;
} refusal;

typedef struct derivation {
    const tn_place_rules *rules;
    tn_place_options options;
    tn_traces traces;
    tn_acts acts;
    tn_cells *cells;
    tn_mersenne random;
    frame_stack frames, trial; /* trial: frames of the lookahead above the lowest that it kept */
    cursor_stack pending, ahead;
    begun_stack begun;
    filled_boxes boxes;
    refusal refused;
    const char **ahead_parts; /* placed by the lookahead at hand, where alternatives have values */
    size_t ahead_count, ahead_capacity;
    uint64_t idle; /* expansions since the last step */
    tn_placed_model *model;
    tn_place_fault *fault;
    tn_error *error;
} derivation;

tn_status tn_pending_push(derivation *d, cursor_stack *stack, uint32_t alternative);

/* Steps between two looks at whether to go on. */
enum { TN_PLACE_ASK_EVERY = 4096 };

/* Tells how many parts there are, and asks whether to go on. */
tn_status tn_look_up(const derivation *d);

/* The next step of the topmost alternative that has one; NULL if all are done. */
const tn_step *tn_pending_next(const derivation *d, cursor_stack *stack, uint32_t *index, uint32_t *alternative);

tn_status tn_frame_push(derivation *d, frame_stack *stack, const tn_frame *frame);
tn_status tn_past_limit(derivation *d, const char *what, uint64_t limit, const char *option);
/* A derivation, or the lookahead of an alternative, that does not come to an end: names the symbols that lead to one
 * another. */
tn_status tn_no_end(derivation *d, uint32_t alternative, bool lookahead);

/* Is nothing filled yet, so that a bound comes of itself? Not with a kit, which has its space. */
static inline bool tn_world_is_empty(const derivation *d)
{
    return !d->rules->space && tn_cells_count(d->cells) == 0;
}

tn_status tn_no_frame(derivation *d, uint32_t step, uint32_t alternative);
tn_status tn_too_far(derivation *d, uint32_t step, uint32_t alternative);
tn_status tn_bound_empty_world(derivation *d);
tn_status tn_set_bound(derivation *d, const tn_frame *frame, const tn_step *step);

/* What is in the way of a step's box: its cell that is filled, and what filled that, where boxes are kept. */
tn_place_obstacle tn_obstacle_find(derivation *d, const tn_cell_box *box);

#endif
