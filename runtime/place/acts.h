/* Alternatives worked out once: what each does, and where, from the frame at which it begins.
 *
 * An act is a step that does more than move the head. Where every symbol leaves the frame as it was, or nothing needs
 * the frame after it, each act of an alternative lies at a fixed place from its start, whatever was expanded before it:
 * the steps in between need not be taken, and no stack of frames is kept. A symbol with one alternative is replaced by
 * its acts. Rules that are not so are derived step by step. The acts own their memory and borrow nothing. */
#ifndef TARTAN_PLACE_ACTS_H
#define TARTAN_PLACE_ACTS_H

#include "runtime/place/heads.h"
#include "runtime/place/trace.h"

typedef struct tn_act {
    tn_step_kind kind;
    uint32_t step;                     /* of the rules */
    uint32_t symbol;                   /* EXPAND */
    uint32_t depth;                    /* frames pushed since the alternative began */
    bool fresh;                        /* some step was taken since the act before it */
    uint32_t idle;                     /* expansions since that step, or since that act */
    int32_t colour;                    /* or TN_COLOUR_KEPT */
    uint8_t heading[TN_UPRIGHT_TURNS]; /* by that at the start, as the boxes are */
    tn_cell_box box[TN_UPRIGHT_TURNS]; /* its cells from the start; of an act without cells, its place is `low` */
} tn_act;

typedef struct tn_act_list {
    uint32_t first, count; /* acts */
    uint32_t steps;        /* that it stands for, those that only move the head too */
    uint32_t depth;        /* most frames that it pushes */
    uint32_t expansions;   /* of symbols that were replaced by their acts */
} tn_act_list;

typedef struct tn_acts {
    bool known;    /* otherwise the rules are derived step by step, and the rest is empty */
    int32_t reach; /* no frame of an alternative is farther from its start on any axis */
    tn_act *acts;
    tn_act_list *lists; /* [alternative] */
} tn_acts;

/* TN_OK or TN_MEMORY. The traces are those of the rules. */
tn_status tn_acts_make(const tn_place_rules *rules, const tn_traces *traces, tn_acts *acts, tn_error *error);
void tn_acts_clear(tn_acts *acts);

/* Where an act is whose alternative began at a frame. */
static inline tn_frame tn_act_frame(const tn_act *act, const tn_frame *start)
{
    tn_cell_box box = tn_cell_box_of(act->box, start->heading);
    tn_frame frame = {.colour = act->colour == TN_COLOUR_KEPT ? start->colour : act->colour};
    frame.heading = start->heading < TN_UPRIGHT_TURNS ? act->heading[start->heading]
                                                      : tn_turn_after(start->heading, act->heading[0]);
    for (int k = 0; k < 3; k++)
        frame.at[k] = start->at[k] + box.low[k];
    return frame;
}

#endif
