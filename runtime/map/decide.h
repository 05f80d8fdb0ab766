/* What becomes of each face, before anything of the new map is written (internal to the growth engine). */
#ifndef TARTAN_MAP_DECIDE_H
#define TARTAN_MAP_DECIDE_H

#include "runtime/map/pattern.h"

/* What a thread decides with; kept from step to step. */
typedef struct tn_decider {
    tn_loop loop;
    tn_patterns patterns;
    tn_cuts cuts;        /* of single faces, in this pass */
    tn_pending *pending; /* branches that wait for the next pass */
    uint32_t *later;     /* faces that wait until all others are done */
    size_t pending_count, pending_room, later_count, later_room;
    bool failed; /* out of memory */
} tn_decider;

/* TN_CHUNK_FACES faces: what they become, counted; then where the first of each goes. */
typedef struct tn_face_chunk {
    uint64_t darts, faces, joins;
    int decider; /* that its faces' cuts are in */
} tn_face_chunk;

/* As many deciders as threads, ready for a pass. False: out of memory. */
bool tn_deciders_prepare(tn_workspace *space, int count);

/* The next pass is another system's. */
void tn_deciders_forget(tn_workspace *space);
void tn_deciders_clear(tn_workspace *space);

/* A face's cut, unless it is plain. */
static inline const tn_cuts *tn_cuts_of(const tn_pass *pass, const tn_face_chunk *chunk, uint32_t *index)
{
    const tn_decider *decider = &pass->growth->space.deciders[chunk->decider];
    bool of_pattern = *index & TN_CUT_OF_PATTERN;
    *index &= ~TN_CUT_OF_PATTERN;
    return of_pattern ? &decider->patterns.cuts : &decider->cuts;
}

#define TN_AHEAD 32u /* darts */

/* What some darts further on than first .. end will need lies all over memory: asked for now, it is there in time.
 * `items` are of `size` bytes, one a record. Always inlined: a call that only asks is taken for one without effect. */
static inline __attribute__((always_inline)) void tn_ask_ahead(const tn_pass *pass, uint32_t first, uint32_t end,
                                                               const void *items, size_t size)
{
    const uint32_t *side = pass->old->side, *slots = pass->slot;
    if (end + 2 * TN_AHEAD > 2 * pass->old->edge_count)
        return;
    for (size_t i = first; i < end; i++) {
        __builtin_prefetch(&slots[side[i + 2 * TN_AHEAD] / 2]);
        uint32_t slot = slots[side[i + TN_AHEAD] / 2];
        if (!(slot & TN_KEPT))
            __builtin_prefetch((const char *)items + slot * size);
    }
}

#endif
