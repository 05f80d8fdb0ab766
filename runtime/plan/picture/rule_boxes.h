/* A rule as nested boxes, which is all that drawing it needs to know: where they come from, from the code of a module
 * or from the text that somebody edits, is no matter. */
#ifndef TARTAN_PLAN_PICTURE_RULE_BOXES_H
#define TARTAN_PLAN_PICTURE_RULE_BOXES_H

#include "runtime/module/module.h"
#include "runtime/plan/match/condition.h"

#define TN_NO_BOX UINT32_MAX
#define TN_NO_BOX_NUMBER SIZE_MAX
#define TN_RULE_WORDS_MAX (TN_CONDITION_TEXT_MAX + 80)

typedef enum tn_rule_box_kind {
    TN_BOX_TRAY,      /* the symbol of a specifier */
    TN_BOX_LABEL,     /* a tray that has no symbol: its words, a line each */
    TN_BOX_TAG,       /* words, with round corners */
    TN_BOX_ROW,       /* its boxes side by side, dashed lines between */
    TN_BOX_STACK,     /* its boxes one above the other */
    TN_BOX_NEIGHBOUR, /* its boxes side by side, as trays are */
    TN_BOX_SYMMETRIC, /* its one box, and below it this mirrored */
    TN_BOX_DISTANCE,  /* source, destination, separator */
} tn_rule_box_kind;

typedef struct tn_rule_box {
    tn_rule_box_kind kind;
    char *words;         /* owned: on top of its frame, or what it is; NULL: none */
    size_t number;       /* of the part that it shows, for who clicks on it; TN_NO_BOX_NUMBER: none of its own */
    uint32_t spec;       /* of a tray: its SPEC record */
    bool framed;         /* drawn as a box around what is in it */
    bool centred;        /* its words are a condition, which stands in the middle of the frame */
    bool separator;      /* its words stand on top of its section of a distance */
    bool optional;       /* may be left out */
    bool alone;          /* it is made of one part */
    bool beginning, end; /* of neighbours: tied to the plan's */
    size_t beginning_number, end_number; /* the parts that say so; TN_NO_BOX_NUMBER */
    uint32_t parent, first, last, next;  /* boxes */
} tn_rule_box;

/* Boxes, each before those in it; the first is the rule. Starts as zeros. */
typedef struct tn_rule_boxes {
    tn_rule_box *items;
    uint32_t count;
    size_t capacity;
} tn_rule_boxes;

/* Adds a box to its parent (TN_NO_BOX: the rule). Its words are copied. *added: its number. TN_MEMORY. */
tn_status tn_rule_box_add(tn_rule_boxes *boxes, uint32_t parent, tn_rule_box box, const char *words, uint32_t *added,
                          tn_error *error);
void tn_rule_boxes_clear(tn_rule_boxes *boxes);

/* The boxes of a rule function of a module: numbers are those of its parts (runtime/plan/match/parts.h). TN_INVALID as
 * from tn_parts_read. Clear in any case. */
tn_status tn_rule_boxes_read(const tn_module *module, uint32_t function, tn_rule_boxes *boxes, tn_error *error);

#endif
