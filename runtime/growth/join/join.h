/* One face of a rewriting pass: its loop of pieces and branches, and the branches that join (internal to growth). */
#ifndef TARTAN_GROWTH_JOIN_JOIN_H
#define TARTAN_GROWTH_JOIN_JOIN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "runtime/growth/pass/pass.h"

/* Sets of pairs of vertices (internal to the growth engine). A set that is all zero is empty. */

typedef struct tn_pair_set {
    uint64_t *slots; /* low vertex << 32 | high vertex; 0 is free (no pair has two equal vertices) */
    size_t count, capacity;
} tn_pair_set;

void tn_pair_set_clear(tn_pair_set *set);

/* The order of the two does not matter. */
bool tn_pair_set_has(const tn_pair_set *set, uint32_t u, uint32_t v);

/* Adds two different vertices. False: out of memory. */
bool tn_pair_set_add(tn_pair_set *set, uint32_t u, uint32_t v);

/* Something on a face's loop: a dart, or a branch that hangs into the face at a corner. */
typedef struct tn_loop_item {
    uint32_t vertex; /* where it starts */
    uint32_t value;  /* a dart's side (2 * edge + against), or a branch's index in the loop's branches */
    uint32_t region; /* 0: what keeps the face's number; n: the face that the n-th join made */
    bool is_branch;
    bool seen;
} tn_loop_item;

typedef struct tn_loop_branch {
    tn_vector direction, at;
    uint32_t id, label, item;
    int32_t age;
    int32_t partner; /* index of the branch it joined, or -1 */
    uint32_t edge;   /* that it comes from, or the first of its chain; TN_NONE: from an earlier pass */
    uint32_t point;  /* the path's point it leaves from */
    uint32_t beyond; /* the face on the other side of its edge, where its vertex is new; TN_NONE: an old vertex */
    uint32_t corner; /* a dart of the old face: it starts at the old vertex, or is the edge that the new one divides */
    uint32_t dart;   /* of the cut: the joined edge's dart that leaves here */
    bool reversed;
} tn_loop_branch;

typedef struct tn_candidate {
    double distance;    /* quantised */
    uint32_t low, high; /* indices of branches; low has the lower id */
} tn_candidate;

typedef struct tn_loop_join {
    uint32_t start, end; /* branches: the new edge runs from start to end */
    uint32_t low;        /* the lower id's branch */
} tn_loop_join;

typedef struct tn_loop {
    tn_loop_item *items;
    tn_loop_branch *branches;
    tn_candidate *candidates;
    tn_loop_join *joins;
    uint32_t item_count, branch_count, candidate_count, join_count;
    size_t item_room, branch_room, candidate_room, join_room;
} tn_loop;

typedef enum tn_join_outcome {
    TN_JOINED,
    TN_JOIN_REFUSED, /* a pair: its vertices are linked already */
    TN_JOIN_LATER,   /* needs to know what lower faces joined: ask again in order, with `taken` */
    TN_JOIN_MEMORY
} tn_join_outcome;

static inline tn_vector tn_branch_direction(tn_vector heading, tn_vector up, const tn_template_branch *branch)
{
    tn_vector left = tn_cross(up, heading), h = tn_scale(heading, branch->direction[0]);
    return tn_along(tn_along(h, left, branch->direction[1]), up, branch->direction[2]);
}

/* Do two branches' directions let them join? */
static inline bool tn_branches_oppose(const tn_growth *growth, tn_vector a, tn_vector b)
{
    return !(tn_dot(a, b) > growth->branch_cosine);
}

/* A distance in whole 2^-20 of the current length, so that equal ones are equal in spite of rounding. */
static inline double tn_quantised(const tn_growth *growth, double length)
{
    double quanta = length / growth->length * 0x1p20 + 0.5;
    return quanta < 0x1p62 ? (double)(int64_t)quanta : quanta;
}

/* How far branches may be from each other. */
static inline double tn_branch_reach(const tn_growth *growth)
{
    double multiples = growth->options.branch_length;
    return multiples >= 0 ? multiples * growth->length * (1 + 1e-9) : INFINITY;
}

/* TN_JOIN_FAILURE_COUNT if they lie so that they may join; then their distance, quantised. */
tn_join_failure tn_branches_measure(const tn_growth *growth, tn_vector a_direction, tn_vector a_at,
                                    tn_vector b_direction, tn_vector b_at, double *distance);

/* How far two branches of one label at different vertices come: TN_JOIN_FAILURE_COUNT if nothing but the topology
 * could stand against it. */
tn_join_failure tn_branches_compare(const tn_growth *growth, const tn_loop_branch *a, const tn_loop_branch *b,
                                    double *distance);

/* Nearest first, then by the branches' numbers. */
static inline bool tn_candidate_before(const tn_loop *loop, const tn_candidate *a, const tn_candidate *b)
{
    if (a->distance != b->distance)
        return a->distance < b->distance;
    uint32_t x = loop->branches[a->low].id, y = loop->branches[b->low].id;
    if (x != y)
        return x < y;
    return loop->branches[a->high].id < loop->branches[b->high].id;
}

void tn_loop_clear(tn_loop *loop);

/* The loop of a face: what its darts become, and (where `branches`) the branches on its side. False: out of memory. */
bool tn_loop_expand(tn_loop *loop, const tn_pass *pass, uint32_t face, bool branches);

/* Joins its branches, nearest pairs first. `taken` (vertices that joined although two faces share them) NULL: give up
 * where another face might matter. */
tn_join_outcome tn_loop_join_branches(tn_loop *loop, const tn_pass *pass, uint32_t face, tn_pair_set *taken);

/* The two ways to do that: looking at all pairs, which is quick where there are few branches, and asking each branch
 * for its nearest (branch_tree.c). */
tn_join_outcome tn_loop_join_few(tn_loop *loop, const tn_pass *pass, uint32_t face, tn_pair_set *taken);
tn_join_outcome tn_loop_join_many(tn_loop *loop, const tn_pass *pass, uint32_t face, tn_pair_set *taken);

#define TN_EVEN_BRANCHES_MAX                                                                                           \
    2048u /* of a face: where there are more, ties go by the branches' numbers all the same                            \
           */

/* May these two join, whose vertices no join of this face links yet? */
tn_join_outcome tn_loop_may_join(const tn_loop *loop, const tn_pass *pass, uint32_t face, const tn_candidate *pair,
                                 tn_pair_set *taken);

/* Notes that two branches join; the regions are the caller's to cut. False: out of memory. */
bool tn_loop_add_join(tn_loop *loop, uint32_t low, uint32_t high);

/* Adds to failures why the branches that remain did not join. False: out of memory. */
bool tn_loop_explain(const tn_loop *loop, const tn_pass *pass, uint64_t failures[TN_JOIN_FAILURE_COUNT]);

#endif
