/* Alternatives worked out once: what each does, and where, from the frame at which it begins.
 *
 * An act is a step that does more than move the head. Where every symbol leaves the frame as it was, or nothing needs
 * the frame after it, each act of an alternative lies at a fixed place from its start, whatever was expanded before it:
 * the steps in between need not be taken, and no stack of frames is kept. A symbol with one alternative is replaced by
 * its acts. Rules that are not so are derived step by step. The acts own their memory and borrow nothing. */
#ifndef TARTAN_PLACE_ACTS_H
#define TARTAN_PLACE_ACTS_H

#include "runtime/place/model/frame.h"

/* Lookaheads worked out once: the tests that an alternative's lookahead makes, relative to the head.
 *
 * Where a lookahead is finite, sets no bounds and never drops a frame that it did not push, it is a fixed list of boxes
 * that must be free or must hold something, one list for each heading. Others are run step by step. The traces own
 * their tests and borrow nothing. */

typedef struct tn_trace_test {
    tn_cell_box box[4]; /* relative to the head, by its heading */
    bool filled;        /* some cell must be filled; otherwise none may be */
} tn_trace_test;

typedef struct tn_trace {
    bool known;            /* the tests say all; otherwise run it step by step */
    bool bounds;           /* sets bounds somewhere, or may: it has to be run even where its answer is not needed */
    uint32_t first, count; /* tests */
} tn_trace;

/* What the traces of a symbol's alternatives have in common: a box that must be free for any of them but the last,
 * which always fits. */
typedef struct tn_common {
    bool traced; /* they are known, and the first that fits is taken: none is of a draw */
    bool known;
    tn_cell_box box[4]; /* relative to the head, by its heading */
} tn_common;

typedef struct tn_traces {
    tn_trace *traces;  /* [alternative] */
    tn_common *common; /* [symbol] */
    tn_trace_test *tests;
    size_t test_count, test_capacity;
} tn_traces;

tn_status tn_traces_make(const tn_place_rules *rules, tn_traces *traces, tn_error *error);
void tn_traces_clear(tn_traces *traces);

/* Four heads that walk the same way, one for each upright turn: where steps lead from a frame that is not known yet. */

enum { TN_HEADS_FRAMES = 64 }; /* at once; and no colour of a part is TN_COLOUR_KEPT */
#define TN_COLOUR_KEPT INT32_MIN

typedef struct tn_heads {
    tn_frame frames[TN_HEADS_FRAMES][TN_UPRIGHT_TURNS]; /* [depth][turn at the start] */
    uint32_t depth;
} tn_heads;

/* The frames at hand, by the turn at the start. */
static inline const tn_frame *tn_heads_frames(const tn_heads *heads)
{
    return heads->frames[heads->depth];
}

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
