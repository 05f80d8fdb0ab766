/* Lookaheads worked out once: the tests that an alternative's lookahead makes, relative to the head.
 *
 * Where a lookahead is finite, sets no bounds and never drops a frame that it did not push, it is a fixed list of boxes
 * that must be free or must hold something, one list for each heading. Others are run step by step. The traces own
 * their tests and borrow nothing. */
#ifndef TARTAN_PLACE_TRACE_H
#define TARTAN_PLACE_TRACE_H

#include "runtime/place/model/frame.h"

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

#endif
