/* Steps that are no boxes: wedges around the inner corner of a turn, or around the middle of a spiral. */
#include <math.h>

#include "runtime/house/ways.h"
#include "runtime/math/elementary.h"

static const double whole_turn = 6.283185307179586;

static void set(tn_wedge *wedge, int64_t u, int64_t v)
{
    wedge->at[wedge->count][0] = u;
    wedge->at[wedge->count++][1] = v;
}

/* How far from the outer corners a ray ends that leaves a third of the right angle on one side: 15/26 for the tangent of
 * 30 degrees, rounded down. */
static int64_t third_of(int64_t side)
{
    return (int64_t)((tn_int128)15 * side / 26);
}

/* The places on the outer sides, from the side where one comes in to that where one goes out, at which wedges end:
 * numbers 0 and `count` are ends of these sides. */
static void set_outer(tn_winding winding, const tn_rectangle *q, int64_t count, int64_t number, tn_wedge *wedge)
{
    int64_t d = third_of(q->x1 - q->x0);
    bool first = number == 0, last = number == count, early = number == 1 && count == 3, late = number == 2 && count == 3;
    if (winding == TN_WINDS_RIGHT) /* from x0, y0 by x1, y0 to x1, y1 */
        set(wedge, first ? q->x0 : early ? q->x0 + d : q->x1, last ? q->y1 : late ? q->y1 - d : q->y0);
    else /* from x1, y0 by x1, y1 to x0, y1 */
        set(wedge, last ? q->x0 : late ? q->x0 + d : q->x1, first ? q->y0 : early ? q->y0 + d : q->y1);
}

static void set_outer_corner(tn_winding winding, const tn_rectangle *q, tn_wedge *wedge)
{
    set(wedge, q->x1, winding == TN_WINDS_RIGHT ? q->y0 : q->y1);
}

/* The same with the sine and the cosine of these angles on all machines. */
static void set_round(const tn_rectangle *q, int64_t count, int64_t number, tn_wedge *wedge)
{
    int64_t half = (q->x1 - q->x0) / 2, u = q->x0 + half, v = q->y0 + half;
    if (number == 0 || number == count) {
        set(wedge, q->x0, v);
        return;
    }
    double angle = whole_turn * (double)number / (double)count;
    set(wedge, u - (int64_t)floor((double)half * tn_cos(angle) + 0.5),
        v - (int64_t)floor((double)half * tn_sin(angle) + 0.5));
}

void tn_wedge_plan(tn_winding winding, const tn_rectangle *square, int64_t count, int64_t number, tn_wedge *wedge)
{
    wedge->count = 0;
    if (winding == TN_WINDS_ROUND) {
        int64_t half = (square->x1 - square->x0) / 2;
        set(wedge, square->x0 + half, square->y0 + half);
        set_round(square, count, number, wedge);
        set_round(square, count, number + 1, wedge);
        return;
    }
    set(wedge, square->x0, winding == TN_WINDS_RIGHT ? square->y1 : square->y0);
    set_outer(winding, square, count, number, wedge);
    if (count == 3 && number == 1)
        set_outer_corner(winding, square, wedge);
    set_outer(winding, square, count, number + 1, wedge);
}

tn_box tn_wedge_box(const tn_wedge *wedge)
{
    tn_box box = {wedge->at[0][0], wedge->at[0][0], wedge->at[0][1], wedge->at[0][1], wedge->levels[0], wedge->levels[2]};
    for (size_t i = 1; i < wedge->count; i++) {
        const int64_t *at = wedge->at[i];
        box.x0 = at[0] < box.x0 ? at[0] : box.x0;
        box.x1 = at[0] > box.x1 ? at[0] : box.x1;
        box.y0 = at[1] < box.y0 ? at[1] : box.y0;
        box.y1 = at[1] > box.y1 ? at[1] : box.y1;
    }
    return box;
}
