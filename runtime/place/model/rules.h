/* A connection grammar as the placing engine runs it: symbols with alternatives, which are lists of steps.
 *
 * A step moves the head, places a part, looks at cells or fills them, or expands another symbol. The grammar owns its
 * arrays; texts are borrowed from the module that it was made of, or from whoever made the steps. Units: x and z in
 * half studs (10 LDU), y in plates (8 LDU), downwards; a heading is a number of quarter turns. */
#ifndef TARTAN_PLACE_MODEL_RULES_H
#define TARTAN_PLACE_MODEL_RULES_H

#include "runtime/module/module.h"

typedef enum tn_step_kind {
    TN_STEP_PUSH,       /* ( : copies the frame */
    TN_STEP_POP,        /* ) : drops it */
    TN_STEP_MOVE,       /* by a[0..2], turned by the heading */
    TN_STEP_TURN,       /* by the turn a[0] (turns.h) */
    TN_STEP_COLOUR,     /* a[0] */
    TN_STEP_PART,       /* records the part `text`; fills nothing */
    TN_STEP_FILL,       /* a box of a[0] x a[1] x a[2], which must be free */
    TN_STEP_FILL_OVER,  /* the same, free or not */
    TN_STEP_BLOCK,      /* the box from corner a to corner b, which must be free and inside of the space */
    TN_STEP_TOUCH,      /* some cell of 2 x 1 x 2 must be filled */
    TN_STEP_BOUND_BOX,  /* the shell of a box */
    TN_STEP_BOUND_BALL, /* the shell of a ball about the origin, radius a[0] */
    TN_STEP_EXPAND,     /* the symbol `index` */
} tn_step_kind;

typedef struct tn_step {
    tn_step_kind kind;
    int32_t a[3], b[3];
    uint32_t index;
    uint32_t offset; /* of its instruction: tn_module_place says where it was written */
    const char *text;
} tn_step;

typedef struct tn_place_alternative {
    uint32_t first, count; /* steps */
    uint32_t offset;       /* of its code */
    double share;          /* where its symbol is drawn: running sum of the probabilities, divided by the last */
    uint32_t member;       /* of a draw among those that fit (records.def), or 0 */
    double weight;         /* in that draw */
} tn_place_alternative;

typedef struct tn_place_symbol {
    const char *name;
    uint32_t first, count; /* alternatives; the last one ends lookaheads */
    bool drawn;            /* by probability; otherwise the first that fits */
} tn_place_symbol;

/* start: what is expanded first. Where `space` is not NULL, the rules are a kit's: nothing bounds but the space. */
typedef struct tn_place_rules {
    const tn_module *module; /* borrowed */
    const tn_kit_model_record *space;
    uint32_t start;
    tn_place_symbol *symbols;
    tn_place_alternative *alternatives;
    tn_step *steps;
    uint32_t symbol_count, alternative_count, step_count;
} tn_place_rules;

/* Decodes the connection grammar of a verified module, which has to outlive the rules. TN_INVALID if it has none. */
tn_status tn_place_rules_make(const tn_module *module, tn_place_rules *rules, tn_error *error);
void tn_place_rules_clear(tn_place_rules *rules);

/* The model of this name of a kit, or its only one where that is NULL. TN_INVALID (E1317) if there is none, or where
 * there are several to choose from, which the help names. */
tn_status tn_kit_model_find(const tn_module *module, const char *name, uint32_t *model, tn_error *error);

/* The same, to place model `index` of a kit. */
tn_status tn_place_rules_of_model(const tn_module *module, uint32_t index, tn_place_rules *rules, tn_error *error);

/* A cell's sides in LDU. */
void tn_place_unit(const tn_module *module, double unit[3]);

/* How many turns parts may have: 4 or 24. */
static inline uint32_t tn_place_turns(const tn_module *module)
{
    return module->KIT_count > 0 ? module->KIT_records[0].turns : 4;
}

/* Does a module hold a connection grammar? */
static inline bool tn_module_has_places(const tn_module *module)
{
    return module->GRAMMAR_count > 0 && module->GRAMMAR_records[0].dialect == TN_DIALECT_PLACE;
}

/* Are the alternatives of a symbol whose probabilities have this sum drawn? Within 2^-26 of 1, as in the published
 * program; the sum is that of the probabilities in their order. */
static inline bool tn_place_draws(double sum)
{
    return sum >= 1 - 0x1p-26 && sum <= 1 + 0x1p-26;
}

/* Does the step need a free place, or something to touch? */
static inline bool tn_step_may_fail(tn_step_kind kind)
{
    return kind == TN_STEP_FILL || kind == TN_STEP_BLOCK || kind == TN_STEP_TOUCH;
}

/* Is the step about cells (tn_frame_box)? */
static inline bool tn_step_has_cells(tn_step_kind kind)
{
    return tn_step_may_fail(kind) || kind == TN_STEP_FILL_OVER;
}

static inline bool tn_step_is_bound(tn_step_kind kind)
{
    return kind == TN_STEP_BOUND_BOX || kind == TN_STEP_BOUND_BALL;
}

/* The symbol that an alternative is of. */
uint32_t tn_place_symbol_of(const tn_place_rules *rules, uint32_t alternative);

#endif
