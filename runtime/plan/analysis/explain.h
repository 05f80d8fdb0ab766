/* Why a rule matches a plan or does not: the rule's parts as a tree, each with the trays it matched.
 *
 * Everything comes from the interpreter's own relations (vm.h), so that an explanation cannot disagree with a decision.
 * An explanation owns its memory and borrows the schema. Trays are numbered from 0 here; a stretch is [begin, end).
 */
#ifndef TARTAN_PLAN_ANALYSIS_EXPLAIN_H
#define TARTAN_PLAN_ANALYSIS_EXPLAIN_H

#include <gmp.h>

#include "runtime/plan/match/parts.h"
#include "runtime/plan/match/vm.h"
#include "runtime/plan/schema/schema.h"

#define TN_NO_WHY UINT32_MAX
#define TN_NO_NUMBER INT64_MIN

/* Bounds of an explanation: a longer plan is E0805; past the nodes or the nesting, rules are named and not opened. */
#define TN_EXPLAIN_LENGTH_DEFAULT 1000u
#define TN_EXPLAIN_NODES_MAX 10000u
#define TN_EXPLAIN_DEPTH_MAX 400u

typedef struct tn_stretch {
    uint32_t begin, end;
} tn_stretch;

/* What a distance looked at: a source, a destination, and what separates them. */
typedef struct tn_gap {
    tn_stretch source, destination, between;
    int64_t number; /* what the separator counts or adds in the gap; TN_NO_NUMBER where it is not a count */
    bool fits;      /* the gap meets the separator */
} tn_gap;

/* What the sides of a comparison of sums come to on the whole plan, in nanometres to the power: the left one, and what
 * it is compared with, two numbers of `in A..B`; or, as `difference`, how much more the left one is. Neither: that
 * cannot be said. */
#define TN_SIDES_MAX 2u
typedef struct tn_sides {
    mpq_t left, right[TN_SIDES_MAX];
    uint32_t right_count;
    bool difference; /* left is that */
    int power;       /* of a length; below 0 as in amount.h */
    bool percent;    /* the author compares with a percentage */
} tn_sides;

/* One part of a rule on one stretch of the plan. */
typedef struct tn_why {
    uint32_t tree, part; /* which tn_parts of the explanation, and which part of it */
    bool matched;
    bool mirrored; /* read from the other end of the plan: the second half of a symmetric */
    bool whole;    /* asked of the region as a whole, not somewhere in it */
    bool absent;   /* an optional part that was left out */
    bool cut;      /* its parts are not shown: the explanation is at its limit */
    tn_stretch region;
    /* Where it matched, in order: the shortest stretches; of what is counted, what counts. */
    uint32_t stretch_first, stretch_count;
    int64_t number;                /* quantity, occurrences: how many; sum: nanometres; elsewhere TN_NO_NUMBER */
    uint32_t gap_first, gap_count; /* distance */
    /* A neighbour that did not match: its longest run of parts that stand side by side; count 0: none. A run of all
     * parts: only the plan's beginning or end is missing. */
    uint32_t run_first, run_count;
    tn_stretch run;
    uint32_t sides;   /* a comparison: which of the explanation's, or TN_NO_WHY */
    uint32_t closest; /* a tray specifier that did not match: the tray with the fewest wrong fields; or TN_NO_WHY */
    uint32_t parent, first, next;
} tn_why;

typedef struct tn_explanation {
    const tn_schema *schema;
    const tn_tray *trays; /* borrowed */
    uint32_t length;
    tn_why *nodes; /* the rule is node 0 */
    uint32_t node_count;
    size_t node_capacity;
    tn_stretch *stretches;
    uint32_t stretch_count;
    size_t stretch_capacity;
    tn_gap *gaps;
    uint32_t gap_count;
    size_t gap_capacity;
    tn_sides *sides;
    uint32_t sides_count;
    size_t sides_capacity;
    tn_parts *trees;
    uint32_t *functions; /* [tree_count]: of which function */
    uint32_t tree_count;
    size_t tree_capacity;
} tn_explanation;

/* Explains a HOLDS function on a plan. max_length: see above; 0 is the default. TN_STOPPED once
 * the module's watch says so. Clear in any case. */
tn_status tn_explain(const tn_schema *schema, uint32_t function, const tn_tray *trays, size_t length, size_t max_length,
                     tn_explanation *explanation, tn_error *error);
void tn_explanation_clear(tn_explanation *explanation);

static inline const tn_part *tn_why_part(const tn_explanation *explanation, const tn_why *why)
{
    return &explanation->trees[why->tree].parts[why->part];
}

/* The largest part that matched, by what it is made of (tn_part_size), not counting what stands under a `not`: the
 * node, or TN_NO_WHY. For a neighbour that did not match, its run is meant. */
uint32_t tn_explanation_largest(const tn_explanation *explanation);

/* Which fields of a tray do not meet a specifier: bit f of the result (fields past 63 are left out). */
uint64_t tn_spec_failing(const tn_schema *schema, uint32_t spec, tn_tray tray);

/* The node whose gaps are those of the node: itself, or a step of what is written as one; TN_NO_WHY if it is about
 * none. */
uint32_t tn_explanation_gaps(const tn_explanation *explanation, uint32_t node);

/* What a gap of that node says of the part as it is written. */
typedef enum tn_gap_verdict { TN_GAP_GOOD, TN_GAP_TOO_NEAR, TN_GAP_TOO_FAR } tn_gap_verdict;
tn_gap_verdict tn_explanation_gap(const tn_explanation *explanation, uint32_t node, const tn_gap *gap);

/* The sides of a part that is a comparison of sums, on the plan that the vm has; `sides` is initialised, and says
 * nothing of other parts, and of a comparison whose sides cannot be told apart. */
void tn_sides_init(tn_sides *sides);
void tn_sides_clear(tn_sides *sides);
tn_status tn_explain_sides(tn_plan_vm *vm, const tn_parts *parts, uint32_t part, tn_sides *sides, tn_error *error);

#endif
