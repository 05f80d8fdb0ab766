/* Whether a grown surface could be built: its extents and area, how plane and even its faces are, and what crosses. */
#ifndef TARTAN_GROWTH_SOUNDNESS_H
#define TARTAN_GROWTH_SOUNDNESS_H

#include "runtime/growth/stats.h"

/* What a surface is measured with. */
typedef struct tn_measuring {
    tn_vector sun;                         /* towards it; not zero */
    const struct tn_boundary_mesh *target; /* or NULL */
} tn_measuring;

/* Fills in what the bits of `asked` (1 << tn_measured) name beyond the fitness terms:
 *   width, depth, height   extent in x, y and z, in model units
 *   area                   of all faces, each half of its Newell's normal long
 *   volume                 between the surface, cut into triangles about the middles of its faces, and the level of its
 *                          lowest vertex
 *   planarity              mean over faces of the largest distance of a corner from the face's plane, over the face's
 *                          size, twice the largest distance of a corner from the middle; 0 if all are plane
 *   worst-planarity        the largest of these
 *   edge-spread            standard deviation of the lengths of edges, over their mean
 *   smallest-angle         between two sides of a face at their corner, in degrees
 *   span                   the largest distance in plan of a vertex from the nearest one that stands on the ground: no
 *                          higher than a hundredth of the height above the lowest
 *   crossed-faces          whose outlines cross themselves (W105)
 *   turned-faces           turned over onto their neighbours (W106)
 *   crossings              pairs of triangles of faces that run through each other
 *   sunlit                 the share of the area that the sun reaches
 *   distance-to            mean over vertices of the distance to the target; no number where there is none
 * TN_OK, TN_MEMORY or TN_STOPPED. */
tn_status tn_soundness_measure(const tn_growth *growth, const tn_measuring *with, uint64_t asked, tn_fitness *fitness,
                               tn_error *error);

#endif
