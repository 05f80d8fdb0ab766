/* Eight plans side by side, as the fast matchers walk them.
 *
 * A step of an automaton has to wait for the one before it (a load, or a shuffle: 3 to 5 cycles). Eight plans that do
 * not wait for one another keep the processor busy meanwhile. Plans of different lengths are padded to the longest with
 * a tray that changes no state, so that the eight are walked by one loop without a branch a plan: a branch that ends a
 * plan at its own length would be guessed wrong about once a plan, which costs more than the steps saved.
 */
#ifndef TARTAN_PLAN_MATCH_MATCH_LANES_H
#define TARTAN_PLAN_MATCH_MATCH_LANES_H

#include "runtime/automata/dfa.h"
#include "runtime/plan/schema/classes.h"

#define TN_LANES 8
#define TN_LANES_CHUNK 16 /* trays copied at a time */

/* DO(k) for each lane: written out, so that the lanes' states are in registers. */
#define TN_EACH_LANE(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7)

/* Walks `lanes` to the end of the longest plan: START(k) and FINISH(k) for each lane, between them STEP(k) for tray
 * `i`. */
#define TN_WALK_LANES(lanes, START, STEP, FINISH)                                                                      \
    if ((lanes)->alone) {                                                                                              \
        START(0)                                                                                                       \
        for (size_t i = 0; i < (lanes)->longest; i++)                                                                  \
            STEP(0)                                                                                                    \
        FINISH(0)                                                                                                      \
    } else {                                                                                                           \
        size_t longest = (lanes)->longest;                                                                             \
        TN_EACH_LANE(START)                                                                                            \
        for (size_t i = 0; i < longest; i++) {                                                                         \
            TN_EACH_LANE(STEP)                                                                                         \
        }                                                                                                              \
        TN_EACH_LANE(FINISH)                                                                                           \
    }

/* What the tables of the matchers have a row for: each tray, or where those are many, each class of trays. One row more
 * stands for padding. */
typedef struct tn_row_map {
    uint32_t rows;             /* without the padding, whose number this is */
    const uint32_t *letter;    /* [rows]: the automata's letter */
    const tn_classes *classes; /* a tray's row is its class; NULL: a tray is its own row */
} tn_row_map;

/* Owned by a matcher. `rows` has the plans' rows: lane k's are at rows + k * stride, `longest` of them are walked. */
typedef struct tn_lanes {
    uint32_t *rows;
    size_t stride;
    size_t longest;
    bool alone;      /* there is one plan, in lane 0, and the others have nothing in them: they need not be walked */
    size_t capacity; /* of rows */
    bool masked;     /* the processor has AVX-512, and it may be used */
} tn_lanes;

/* Many plans: plan i is trays[i ? ends[i - 1] : begin] up to but without trays[ends[i]]. */
typedef struct tn_plan_array {
    const tn_tray *trays;
    size_t begin;
    const size_t *ends;
    size_t count;
} tn_plan_array;

/* Puts plans [first, first + TN_LANES) into lanes; where those are fewer, the lanes left are empty. false where out of
 * memory. */
bool tn_lanes_fill(tn_lanes *lanes, const tn_row_map *map, const tn_plan_array *plans, size_t first);

#endif
