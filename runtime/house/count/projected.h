/* What the files that project the automaton of houses share (projected.c, projected_classes.c). */
#ifndef TARTAN_HOUSE_COUNT_PROJECTED_H
#define TARTAN_HOUSE_COUNT_PROJECTED_H

#include "runtime/house/count/data.h"

/* Words of a class: may the row end there; then the way on. From one tray to the next, if a step has stages, there are
 * classes that go on without a slice: a word for each. */
enum { CLASS_ENDS, CLASS_ON };
enum { ON_PLAN, ON_SLICE, ON_CLASS, ON_WORDS };
enum { CLASS_DEAD }; /* nothing goes on from there */

/* A way on from a node. Where no slice is taken, plan and slice are 0. */
typedef struct tn_way_on {
    uint32_t words[ON_WORDS];
} tn_way_on;
int tn_way_on_compare(const void *left, const void *right);

/* One kind of section. */
typedef struct tn_projected_kind {
    tn_houses_kind *kind;
    uint32_t stages;
    tn_interner classes; /* of nodes from which houses go on alike */
    tn_interner sets;    /* of classes, ascending; 0: the empty one */
    uint32_t first;      /* the set before the first tray */
    uint32_t *slots;     /* [slices]: scratch, where the ways on by each begin, and one more */
    uint32_t *stamps;    /* the same: of which turn that is */
    uint32_t turn;
} tn_projected_kind;

typedef struct tn_projecting {
    tn_houses *houses;
    tn_projected_kind *kinds; /* [kinds] */
    uint64_t work;
    tn_key key; /* scratch */
} tn_projecting;

/* TN_LIMIT (E1640) where there were too many steps. */
tn_status tn_projecting_spend(tn_projecting *projecting, uint64_t work, tn_error *error);

/* Finds the classes of all nodes, layer by layer from the end. first: that of the node before the first tray. */
tn_status tn_projected_classes(tn_projecting *projecting, tn_projected_kind *of, uint32_t *first, tn_error *error);

#endif
