/* What becomes of each face, before anything of the new map is written (internal to the growth engine). */
#ifndef TARTAN_GROWTH_JOIN_DECIDE_H
#define TARTAN_GROWTH_JOIN_DECIDE_H

#include "runtime/growth/join/pattern.h"

/* What a thread decides with; kept from step to step. */
typedef struct tn_decider {
    tn_loop loop;
    tn_patterns patterns;
    tn_cuts cuts;        /* of single faces, in this pass */
    tn_pending *pending; /* branches that wait for the next pass */
    uint32_t *later;     /* faces that wait until all others are done */
    size_t pending_count, pending_room, later_count, later_room;
    uint64_t failures[TN_JOIN_FAILURE_COUNT]; /* of branches, in this pass */
} tn_decider;

/* TN_CHUNK_FACES faces: what they become, counted; then where the first of each goes. */
typedef struct tn_face_chunk {
    uint64_t darts, faces, joins;
    int decider; /* that its faces' cuts are in */
} tn_face_chunk;

/* The next pass is another system's. */
void tn_deciders_forget(tn_growth_workspace *space);
void tn_deciders_clear(tn_growth_workspace *space);

/* A face's cut, unless it is plain. */
static inline const tn_cuts *tn_cuts_of(const tn_pass *pass, const tn_face_chunk *chunk, uint32_t *index)
{
    const tn_decider *decider = &pass->growth->space.deciders[chunk->decider];
    bool of_pattern = *index & TN_CUT_OF_PATTERN;
    *index &= ~TN_CUT_OF_PATTERN;
    return of_pattern ? &decider->patterns.cuts : &decider->cuts;
}

#define TN_AHEAD 32u   /* darts */
#define TN_TOGETHER 8u /* faces, asked for at once */

/* What the darts some way behind those of this face and the next ones will need lies all over memory: asked for now, it
 * is there in time. Records, and of `items` (of `size` bytes, one for each branch from `first` on) those of the edges'
 * first branches. Always inlined: a call that only asks is taken for one without effect. */
static inline __attribute__((always_inline)) void tn_ask_ahead(const tn_pass *pass, uint32_t face, const void *items,
                                                               size_t size, uint32_t first)
{
    const tn_map *old = pass->old;
    uint32_t last = old->face_count - face < TN_TOGETHER ? old->face_count : face + TN_TOGETHER;
    const uint32_t *side = old->side + old->face_first[face], *end = old->side + old->face_first[last];
    const uint32_t *all = old->side + 2 * (size_t)old->edge_count;
    if (all - end < (ptrdiff_t)(4 * TN_AHEAD))
        return;
    for (; side < end; side++) {
        __builtin_prefetch(&pass->records[side[4 * TN_AHEAD] / 2], 0, 2); /* so far ahead, the second cache does */
        const tn_record *record = &pass->records[side[TN_AHEAD] / 2];
        __builtin_prefetch((const char *)items + (record->branch - first) * size);
    }
}

#endif
