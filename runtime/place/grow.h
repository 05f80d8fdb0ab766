/* Deriving a model from a connection grammar, as the published program does: the leftmost symbol is expanded by the
 * first of its alternatives that fits, or by a draw.
 *
 * Whether an alternative fits is found by a lookahead: its steps, each symbol in it replaced by its last alternative,
 * against the cells that were filled so far. The derivation keeps one stack of frames and one set of cells, and runs
 * each step once when it is taken for good.
 *
 * A model owns its parts; texts are borrowed from the rules. Not for several threads at once. */
#ifndef TARTAN_PLACE_GROW_H
#define TARTAN_PLACE_GROW_H

#include "runtime/place/cells.h"

typedef struct tn_placed_part {
    tn_frame frame;
    const char *name;
} tn_placed_part;

typedef struct tn_place_counts {
    uint64_t parts, steps, expansions, draws, tries, fallbacks;
    uint64_t cells, bounds;
    uint64_t looked_at; /* models that a search looked at; 0 without one */
    bool proved;        /* none of all the rules allow is better */
} tn_place_counts;

typedef struct tn_placed_model {
    tn_placed_part *parts;
    size_t count, capacity;
    tn_place_counts counts;
    uint32_t *steps; /* those taken, by index into the rules' steps, where asked for; owned */
    size_t step_capacity;
} tn_placed_model;

/* What is in the way of a box: a filled cell, and the step that filled it, where boxes are watched. Where that is no
 * box, it is a bound. */
typedef struct tn_place_obstacle {
    bool known, has_step;
    int32_t cell[3];
    uint32_t step;
    uint32_t parts; /* placed when it was filled */
} tn_place_obstacle;

/* What became of an alternative: for whoever looks on. */
typedef enum tn_place_outcome {
    TN_PLACE_REFUSED, /* it does not fit */
    TN_PLACE_TAKEN,   /* it fits, or is the only one */
    TN_PLACE_DRAWN,
    TN_PLACE_FORCED, /* nothing fits, and it is the last */
} tn_place_outcome;

typedef struct tn_place_event {
    tn_place_outcome outcome;
    uint32_t alternative;
    const tn_frame *frame;      /* where its symbol is expanded; NULL if there is none left */
    uint32_t step;              /* REFUSED: that failed */
    tn_place_obstacle obstacle; /* REFUSED: not known where there is nothing to touch */
    size_t parts;               /* placed so far */
} tn_place_event;

/* What a derivation may take; 0 is the default of each. */
typedef struct tn_place_options {
    uint32_t seed;
    uint64_t part_limit;      /* 1,000,000 */
    uint64_t step_limit;      /* 1,000,000,000 */
    uint64_t frame_limit;     /* 1,000,000 */
    uint64_t lookahead_limit; /* steps of one lookahead, and expansions without a step: 1,000,000 */
    uint64_t search_limit;    /* models that a search looks at or gives up: 10,000,000 */
    unsigned threads;         /* of a search; 0: as many as there are processors */
    bool keep_steps;
    bool keep_filled; /* to say what is in the way */
    bool interpret;   /* run every lookahead step by step rather than as tests that were worked out once */
    /* How good an alternative is, after whose lookahead the model would have these parts more; NULL: 1 where it fits.
     * The first of at least 1 is taken, else the best, the last of equals; what does not fit is worth 0. */
    double (*value)(void *context, const tn_placed_model *model, const char *const *ahead, size_t ahead_count);
    tn_watch *watch; /* borrowed, or NULL: the work gives up (TN_STOPPED) once this says so */
    void *context;
    void (*report)(void *context,
                   const tn_place_event *event); /* of every alternative; lookaheads are run step by step */
} tn_place_options;

/* Where a derivation came to its end too early: what was placed stays in the model. */
typedef struct tn_place_fault {
    bool has_step;
    uint32_t step;        /* of the rules */
    uint32_t alternative; /* that put it there */
    tn_place_obstacle obstacle;
} tn_place_fault;

/* Derives a model. TN_INVALID: a step could not be done (E1310: a box that is not free, nothing to touch; E1311: a
 * frame that is not there), with its place in *fault. TN_LIMIT: what an option limits. The model is the caller's to
 * clear in any case. */
tn_status tn_place_derive(const tn_place_rules *rules, const tn_place_options *options, tn_placed_model *model,
                          tn_place_fault *fault, tn_error *error);

void tn_placed_model_clear(tn_placed_model *model);

#endif
