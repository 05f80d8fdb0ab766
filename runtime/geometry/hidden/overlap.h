/* Pairs of triangles that overlap in the picture, and which of two is the nearer one there. Internal to this folder. */
#ifndef TARTAN_GEOMETRY_HIDDEN_OVERLAP_H
#define TARTAN_GEOMETRY_HIDDEN_OVERLAP_H

#include "runtime/geometry/hidden/hidden.h"

/* A triangle of a face, as seen. */
typedef struct tn_seen_triangle {
    uint32_t corner[3]; /* of the scene, counter-clockwise as seen */
    uint32_t face;
    double slope[2], height; /* its plane: depth = height + slope[0] x + slope[1] y */
    bool edge_on;            /* no plane: it is seen as a line */
} tn_seen_triangle;

typedef struct tn_pair {
    uint32_t a, b;
} tn_pair;

typedef struct tn_face_pairs {
    tn_pair *items;
    size_t count, room;
} tn_face_pairs;

/* Compares all triangles of different faces that overlap in the picture: pairs of faces of which the first is farther
 * somewhere. The caller frees the items. */
tn_status tn_overlaps_find(const tn_scene *scene, const tn_seen_triangle *triangles, size_t count,
                           tn_face_pairs *befores, tn_error *error);

#endif
