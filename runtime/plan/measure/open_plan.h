/* Open plans: a row of written trays and gaps, and the machine that places the written trays in a plan.
 *
 * A written tray is a rule function that looks at that tray alone, or the trays that it may be; a gap is any number of
 * trays. If a plan fits in several ways the leftmost counts: the first written tray as early as can be, then the
 * second, and so on.
 *
 * The machine reads a plan from left to right. It guesses where a run of written trays after a gap starts, and
 * remembers the runs that started earlier: none of them may come to its end, so that the guess is the leftmost. Each
 * plan is then read in one way only.
 */
#ifndef TARTAN_PLAN_MEASURE_OPEN_PLAN_H
#define TARTAN_PLAN_MEASURE_OPEN_PLAN_H

#include "runtime/plan/measure/weighed.h"

#define TN_PATTERN_MAX 60u /* written trays */

/* A place of an open plan by its trays instead of by a rule. */
typedef struct tn_open_tray {
    const bool *fits; /* [trays of the schema]; NULL: every tray */
    bool gap;
} tn_open_tray;

typedef struct tn_open_plan {
    const uint32_t *functions; /* of M, or TN_NO_RECORD for a gap; NULL: `trays` says it */
    const tn_open_tray *trays;
    size_t count;
    tn_weighed *weighed; /* by its first measure, of the same library, choices are weighed; or NULL */
    bool most;           /* more of it is better, else less */
    bool first;          /* find a plan that completes it, too */
} tn_open_plan;

/* A run of written trays without a gap between them. */
typedef struct tn_open_segment {
    uint32_t first, count;
    bool floats; /* after a gap, and not bound to the plan's end */
} tn_open_segment;

typedef struct tn_open_pattern {
    const tn_schema *schema;
    uint32_t items; /* written trays */
    tn_open_segment segments[TN_PATTERN_MAX + 1];
    uint32_t segment_of[TN_PATTERN_MAX + 1];
    uint32_t segment_count;
    bool gap_first, gap_last;
    uint64_t *fits; /* [trays]: bit i: the tray fits written tray i */
} tn_open_pattern;

/* Reads what is written, and which trays fit which of its places. Clear in any case. TN_LIMIT (E0801) if more than
 * TN_PATTERN_MAX trays are written. */
tn_status tn_open_pattern_read(tn_open_pattern *pattern, const tn_schema *schema, const tn_open_plan *open,
                               tn_error *error);
void tn_open_pattern_clear(tn_open_pattern *pattern);

/* Where the machine is: so many written trays are placed; it is in the gap before the next run; runs that started
 * earlier, bit k: k + 1 of their trays have been met. */
typedef struct tn_open_machine {
    uint32_t placed;
    bool gap;
    uint64_t earlier;
} tn_open_machine;

/* One way on: where the machine is after it, and whether the tray read is a written one. */
typedef struct tn_open_way {
    tn_open_machine to;
    bool places;
} tn_open_way;

tn_open_machine tn_open_start(const tn_open_pattern *pattern);

/* The ways on with a tray that fits so: at most two. */
size_t tn_open_ways(const tn_open_pattern *pattern, tn_open_machine at, uint64_t fits, tn_open_way ways[2]);

#endif
