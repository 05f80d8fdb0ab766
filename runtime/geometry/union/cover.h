/* Areas in a plane: of what convex polygons cover, and of what they leave of another. */
#ifndef TARTAN_GEOMETRY_UNION_COVER_H
#define TARTAN_GEOMETRY_UNION_COVER_H

#include <stdbool.h>
#include <stddef.h>

#include "runtime/geometry/union/box_tree.h"

enum { TN_COVER_CORNERS = 10 }; /* of a polygon: a cell of a union has no more corners */

/* Corners are counter-clockwise. Polygons of fewer than three cover nothing. */
typedef struct tn_cover {
    double at[TN_COVER_CORNERS][2];
    size_t count;
    double low[2], high[2]; /* its bounds */
} tn_cover;

/* The hull of points, and its bounds; count is at most TN_COVER_CORNERS. False if out of memory. */
bool tn_cover_of(const double (*points)[2], size_t count, tn_cover *cover);

/* As a box of no height. */
tn_box_bounds tn_cover_bounds(const tn_cover *cover);

/* Pieces of polygons: memory that is used again and again. Starts all zero; free `pieces` afterwards. */
typedef struct tn_cover_pieces {
    struct tn_cover_piece *pieces;
    size_t count, room;
    bool failed; /* out of memory */
} tn_cover_pieces;

/* Lays down one polygon, takes others away from it one by one, and says what is left. */
void tn_cover_begin(tn_cover_pieces *work, const tn_cover *cover);
void tn_cover_less(tn_cover_pieces *work, const tn_cover *other);
double tn_cover_left(const tn_cover_pieces *work);

/* What polygons cover together; they come to be in another order. Negative where out of memory. */
double tn_cover_area(tn_cover *covers, size_t count);

/* What a solid stands on: the convex hull of points in the plane. */

/* Leaves of the points the corners of their hull, counter-clockwise: one or two where they have no area. False where
 * out of memory. */
bool tn_hull(double (*points)[2], size_t *count);

double tn_hull_area(const double (*hull)[2], size_t count);

/* How far a point lies inside the hull; below 0: how far outside. */
double tn_hull_depth(const double (*hull)[2], size_t count, const double point[2]);

#endif
