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

void tn_loop_clear(tn_loop *loop);

/* Asks for the memory that the faces soon after this one will need. */
void tn_loop_prefetch(const tn_pass *pass, uint32_t face);

/* The loop of a face: what its darts become, and (where `branches`) the branches on its side. False: out of memory. */
bool tn_loop_expand(tn_loop *loop, const tn_pass *pass, uint32_t face, bool branches);

/* Joins its branches, nearest pairs first. `taken` NULL: give up where another face might matter. */
tn_join_outcome tn_loop_join_branches(tn_loop *loop, const tn_pass *pass, uint32_t face, tn_pair_set *taken);

/* Adds to failures why the branches that remain did not join. */
void tn_loop_explain(const tn_loop *loop, const tn_pass *pass, uint64_t failures[TN_JOIN_FAILURE_COUNT]);

#endif
