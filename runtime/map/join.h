/* One face of a rewriting pass: its loop of pieces and branches, and the branches that join (internal to growth). */
#ifndef TARTAN_MAP_JOIN_H
#define TARTAN_MAP_JOIN_H

#include "runtime/map/pass.h"

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
    uint32_t record; /* of the edge it comes from; TN_NONE: from an earlier pass */
    uint32_t point;  /* the path's point it leaves from */
    uint32_t beyond; /* the face on the other side of its edge, where its vertex is new; TN_NONE: an old vertex */
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

/* Pairs of vertices that joined although two faces share them, so that the other face may not join them again. */
typedef struct tn_pair_set {
    uint64_t *slots; /* low vertex << 32 | high vertex; 0 is free (no pair has two equal vertices) */
    size_t count, capacity;
} tn_pair_set;

typedef enum tn_join_outcome {
    TN_JOINED,
    TN_JOIN_LATER, /* needs to know what lower faces joined: ask again in order, with `taken` */
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

/* TN_JOIN_FAILURE_COUNT where they lie so that they may join; then their distance, quantised. */
tn_join_failure tn_branches_measure(const tn_growth *growth, tn_vector a_direction, tn_vector a_at,
                                    tn_vector b_direction, tn_vector b_at, double *distance);

void tn_loop_clear(tn_loop *loop);

/* The loop of a face: what its darts become, and (where `branches`) the branches on its side. False: out of memory. */
bool tn_loop_expand(tn_loop *loop, const tn_pass *pass, uint32_t face, bool branches);

/* Joins its branches, nearest pairs first. `taken` NULL: give up where another face might matter. */
tn_join_outcome tn_loop_join_branches(tn_loop *loop, const tn_pass *pass, uint32_t face, tn_pair_set *taken);

/* Adds to failures why the branches that remain did not join. */
void tn_loop_explain(const tn_loop *loop, const tn_pass *pass, uint64_t failures[TN_JOIN_FAILURE_COUNT]);

#endif
