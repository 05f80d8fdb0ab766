/* Faces alike: the same edges replaced by the same templates, one after another round the face.
 *
 * What joins in such faces, and how they are then cut, depends only on how the branches lie: which pairs are opposed
 * and which are nearer. So the first face of each pattern and order of pairs is worked out by loop.c and join.c, and
 * what they find is kept as a cut of references; of every other face only the directions (and where pairs compete or
 * make several faces, the distances) are worked out. A regular surface of millions of faces has a handful of patterns.
 *
 * A face is no pattern's, and is worked out by itself, where it is long or has many branches, has branches that wait
 * from an earlier pass or at old vertices, or where another face might join the same vertices.
 *
 * Each thread has its own patterns. They depend on the system alone and are kept from step to step.
 */
#ifndef TARTAN_GROWTH_JOIN_PATTERN_H
#define TARTAN_GROWTH_JOIN_PATTERN_H

#include "runtime/growth/join/face_cut.h"

#define TN_PATTERN_DARTS 16u

typedef struct tn_patterns {
    struct tn_pattern *items;
    struct tn_variant *variants;
    size_t count, room, variant_count, variant_room;
    uint32_t *slots; /* hash table of patterns: index + 1, or 0 */
    size_t slot_count;
    tn_cuts cuts;
} tn_patterns;

void tn_patterns_clear(tn_patterns *patterns);

/* No patterns any more; keeps their memory. */
void tn_patterns_forget(tn_patterns *patterns);

/* How an interior face is cut: the index of one of patterns->cuts, its branches that joined noted in pass->joints;
 * TN_NONE where the face has to be worked out by itself. `loop` is used in between. False: out of memory. */
bool tn_patterns_decide(tn_patterns *patterns, const tn_pass *pass, uint32_t face, tn_loop *loop, uint32_t *cut);

#endif
