/* How high roofs rise: planes, and which of them decides where. Exact.
 *
 * A roof's height above its foot is the least of some planes, as a gable's is; where a gable stands across another, it
 * is the greater of two such heights. A rectangle of the plan is cut where another plane begins to decide, at ridges,
 * hips and valleys, into convex facets with rational corners. Nothing here owns memory.
 */
#ifndef TARTAN_HOUSE_SLOPES_H
#define TARTAN_HOUSE_SLOPES_H

#include "runtime/base/int128.h"
#include "runtime/house/house.h"

/* top / bottom, in lowest terms, bottom > 0. */
typedef struct tn_fraction {
    tn_int128 top, bottom;
} tn_fraction;

tn_fraction tn_fraction_new(tn_int128 top, tn_int128 bottom);
double tn_fraction_value(tn_fraction fraction); /* the nearest, but for rounding twice */
bool tn_fraction_less(tn_fraction a, tn_fraction b);

static inline tn_fraction tn_fraction_whole(int64_t number)
{
    return (tn_fraction){number, 1};
}

/* The fraction and a whole number. */
static inline tn_fraction tn_fraction_raised(tn_fraction fraction, tn_int128 by)
{
    fraction.top += by * fraction.bottom;
    return fraction;
}

/* z = (x * X + y * Y + at) / bottom at a point X, Y; `bottom` is that of its tn_slopes. At most one of x and y is not
 * 0. */
typedef struct tn_slope {
    tn_int128 x, y, at;
} tn_slope;

#define TN_SLOPES_MAX 16u      /* of a vault */
#define TN_FACETS_MAX 16u      /* of a rectangle: those of a vault; of two gables 2 * 2 * 2 */
#define TN_FACET_CORNERS 12u   /* each cut of a rectangle adds one */

/* The least of the first `first` planes; where there are more, the greater of that and the least of the others. More
 * than four planes go by their steepness along one axis, so that each need be compared with those beside it only. */
typedef struct tn_slopes {
    tn_slope items[TN_SLOPES_MAX];
    size_t count, first;
    tn_int128 bottom;
} tn_slopes;

/* The roof of a cell, above the top of its slab's foot, over all of the plane: beyond its walls it goes straight on. Only
 * the cell, the section and the form are asked: a hip is the gable that its ends are cut off from. */
tn_slopes tn_roof_slopes(const tn_house *house, const tn_cell *cell);

/* The same of a cell of the house, with what cells beside it have to do with it: where a hip ends. */
tn_slopes tn_roof_slopes_of(const tn_house *house, uint32_t cell);

/* The height at a point, above `base`. */
tn_fraction tn_slopes_at(const tn_slopes *slopes, tn_fraction x, tn_fraction y, int64_t base);

/* The greatest height on a line along an axis, or the whole of a rectangle. */
tn_fraction tn_slopes_highest(const tn_slopes *slopes, tn_rectangle over, int64_t base);

/* A convex polygon, counter-clockwise seen from above, over which one plane decides: that of this number. */
typedef struct tn_facet {
    size_t plane;
    size_t count;
    tn_fraction at[TN_FACET_CORNERS][2];
} tn_facet;

/* Cuts a rectangle into facets, which cover it and do not overlap. Returns how many. */
size_t tn_slopes_cut(const tn_slopes *slopes, tn_rectangle over, tn_facet facets[TN_FACETS_MAX]);

/* Keeps of a facet what is in a rectangle; none of it is left where that has no area. */
void tn_facet_keep(tn_facet *facet, tn_rectangle in);

/* The height of a plane at a point, above `base`. */
tn_fraction tn_slope_at(const tn_slopes *slopes, size_t plane, tn_fraction x, tn_fraction y, int64_t base);

#endif
