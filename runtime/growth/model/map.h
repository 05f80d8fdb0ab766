/* The map that grows: vertices, edges and faces of a surface that is a disc.
 *
 * Stored face by face: the darts (edge sides) of a face are a run of the dart arrays, in counter-clockwise order, so
 * next and previous are neighbours in memory and every step reads and writes streams. A dart knows the vertex that it
 * leaves and the side of the edge that it is; the side at the other end is found through the edge when it is needed
 * (tn_map_twins). Face 0 is the outer face.
 *
 * Numbers are canonical: vertices in order of creation, edges in the order that docs/growth.md pins down; faces have a
 * canonical rank. What is grown is therefore the same bytes everywhere, at any number of threads.
 *
 * A map borrows its arrays from the growth that holds it. Positions are model units.
 */
#ifndef TARTAN_GROWTH_MAP_H
#define TARTAN_GROWTH_MAP_H

#include "runtime/growth/model/system.h"

#define TN_OUTER_FACE 0u
#define TN_EDGES_MAX (1u << 30)
#define TN_AGE_MAX 32767

/* An edge's state packed in 32 bits: age (16, signed), label (15), fresh (1: drawn in this step, not rewritten again).
 */
typedef uint32_t tn_edge_state;
#define TN_STATE_FRESH 1u

static inline tn_edge_state tn_state(uint32_t label, int32_t age, bool fresh)
{
    return (uint32_t)age << 16 | label << 1 | (fresh ? TN_STATE_FRESH : 0);
}

static inline uint32_t tn_state_label(tn_edge_state state)
{
    return state >> 1 & TN_LABELS_MAX;
}

static inline int32_t tn_state_age(tn_edge_state state)
{
    return (int32_t)(int16_t)(state >> 16);
}

typedef struct tn_map {
    uint32_t vertex_count, edge_count, face_count; /* face_count counts the outer face */
    double *positions;                             /* [vertex][3] */
    uint32_t *origin;                              /* [dart] the vertex that it leaves */
    uint32_t *side;                                /* [dart] 2 * edge, + 1 where the dart runs against the edge */
    tn_edge_state *states;                         /* [edge] */
    uint32_t *face_first; /* [face] its first dart; the next face's first is one past its last; [face_count]: 2 *
                             edge_count */
    uint32_t *face_rank;  /* [face] its place in the order of creation (storage keeps neighbours together instead); NULL
                             as long as no face ever had to wait for another */
} tn_map;

/* How many darts a face has; at least 3. */
static inline uint32_t tn_face_size(const tn_map *map, uint32_t face)
{
    return map->face_first[face + 1] - map->face_first[face];
}

/* Where each edge side is: [2 * edge + against] the dart, and the face it belongs to. Both owned by the caller, freed
 * with free(); either pointer may be NULL. */
tn_status tn_map_twins(const tn_map *map, uint32_t **darts, uint32_t **faces, tn_error *error);

/* Checks every promise of the structure: sides used once, faces closed and simple, vertices of each edge the same seen
 * from both sides, connected, Euler number of a sphere (with the outer face), no face of fewer than three edges, finite
 * positions. TN_INTERNAL with a sentence on the first broken one. */
tn_status tn_map_validate(const tn_map *map, tn_error *error);

#endif
