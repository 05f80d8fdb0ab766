/* Finds out whether a polygon crosses itself. */
#include "runtime/geometry/outline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/watch.h"

#define FEW 40u    /* corners: up to here every side is compared with every other */
#define TOUCH 1e-9 /* of the sides' lengths: what crosses by less only touches */
#define NONE UINT32_MAX

void tn_outline_clear(tn_outline *outline)
{
    free(outline->points);
    free(outline->cells);
    free(outline->next);
    free(outline->side);
    *outline = (tn_outline){0};
}

bool tn_outline_reserve(tn_outline *outline, uint32_t count)
{
    outline->count = count;
    return tn_array_reserve(&outline->points, &outline->point_room, 0, count, sizeof *outline->points);
}

/* On which side of the line from a to b is p: 1 left, -1 right, 0 on it. */
static int side_of(const double *a, const double *b, const double *p)
{
    double ux = b[0] - a[0], uy = b[1] - a[1], vx = p[0] - a[0], vy = p[1] - a[1];
    double area = ux * vy - uy * vx, large = TOUCH * (ux * ux + uy * uy + vx * vx + vy * vy);
    return (area > large) - (area < -large);
}

static bool sides_cross(const tn_outline *o, uint32_t i, uint32_t j)
{
    const double *a = o->points[i], *b = o->points[i + 1 == o->count ? 0 : i + 1];
    const double *c = o->points[j], *d = o->points[j + 1 == o->count ? 0 : j + 1];
    return side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0;
}

static bool any_pair_crosses(const tn_outline *o)
{
    for (uint32_t i = 0; i + 2 < o->count; i++)
        for (uint32_t j = i + 2; j < o->count; j++) /* a side and the next only share a corner */
            if (sides_cross(o, i, j))
                return true;
    return false;
}

/* ---- a grid, its cells as long as a side is on the mean, so that sides pass few; cells share places at times */

typedef struct grid {
    double low[2], cell; /* corner, and the size of a cell */
    uint32_t size[2];
    uint32_t places; /* a power of two */
    size_t links;
} grid;

static double length_of_sides(const tn_outline *o)
{
    double length = 0;
    for (uint32_t i = 0; i < o->count; i++) {
        const double *a = o->points[i], *b = o->points[i + 1 == o->count ? 0 : i + 1];
        length += fabs(b[0] - a[0]) + fabs(b[1] - a[1]);
    }
    return length;
}

static bool lay_grid(tn_outline *o, grid *g)
{
    double length = length_of_sides(o);
    g->cell = length > 0 ? length / o->count : 1;
    for (int k = 0; k < 2; k++) {
        double high = o->points[0][k];
        g->low[k] = high;
        for (uint32_t i = 1; i < o->count; i++) {
            g->low[k] = fmin(g->low[k], o->points[i][k]);
            high = fmax(high, o->points[i][k]);
        }
        double cells = (high - g->low[k]) / g->cell; /* no number where the extent is beyond all numbers */
        g->size[k] = cells < o->count ? (uint32_t)cells + 1 : 1;
    }
    for (g->places = 64; g->places < o->count && g->places <= UINT32_MAX / 2; g->places *= 2)
        continue;
    if (g->places > o->cell_room) {
        free(o->cells);
        o->cells = malloc(g->places * sizeof *o->cells);
        o->cell_room = o->cells ? g->places : 0;
    }
    if (!o->cells)
        return false;
    memset(o->cells, 0xff, g->places * sizeof *o->cells);
    g->links = 0;
    return true;
}

static uint32_t cell_of(const grid *g, int k, double at)
{
    double cell = (at - g->low[k]) / g->cell;
    return cell >= g->size[k] ? g->size[k] - 1 : cell > 0 ? (uint32_t)cell : 0;
}

static size_t place_of(const grid *g, uint32_t row, uint32_t column)
{
    return ((row * 0x9e3779b97f4a7c15u + column) * 0xd1342543de82ef95u >> 32) & (g->places - 1);
}

/* Compares a side with those in a cell, and puts it there. */
static bool enter_cell(tn_outline *o, grid *g, size_t place, uint32_t side, bool *crossed)
{
    for (uint32_t link = o->cells[place]; link != NONE; link = o->next[link])
        *crossed |= o->side[link] + 1 < side && sides_cross(o, o->side[link], side);
    size_t next_room = o->link_room;
    if (!tn_array_reserve_from(&o->next, &next_room, 1024, g->links, 1, sizeof *o->next) ||
        !tn_array_reserve_from(&o->side, &o->link_room, 1024, g->links, 1, sizeof *o->side))
        return false;
    o->next[g->links] = o->cells[place];
    o->side[g->links] = side;
    o->cells[place] = (uint32_t)g->links++;
    return true;
}

/* The cells that a side passes, row by row: in each the columns between where it enters and where it leaves, and one
 * more on either side, for rounding. */
static bool enter_side(tn_outline *o, grid *g, uint32_t side, bool *crossed)
{
    const double *a = o->points[side], *b = o->points[side + 1 == o->count ? 0 : side + 1];
    if (a[1] > b[1]) {
        const double *swap = a;
        a = b;
        b = swap;
    }
    uint32_t last = cell_of(g, 1, b[1]);
    for (uint32_t row = cell_of(g, 1, a[1]); row <= last; row++) {
        double rise = b[1] - a[1], bottom = g->low[1] + row * g->cell, top = bottom + g->cell;
        double from = rise > 0 ? fmin(fmax((bottom - a[1]) / rise, 0), 1) : 0;
        double to = rise > 0 ? fmin(fmax((top - a[1]) / rise, 0), 1) : 1;
        double x = a[0] + from * (b[0] - a[0]), y = a[0] + to * (b[0] - a[0]);
        uint32_t left = cell_of(g, 0, fmin(x, y)), right = cell_of(g, 0, fmax(x, y));
        left -= left > 0;
        right += right + 1 < g->size[0];
        for (uint32_t column = left; column <= right; column++)
            if (!enter_cell(o, g, place_of(g, row, column), side, crossed))
                return false;
    }
    return true;
}

bool tn_outline_crosses(tn_outline *o, bool *crossed)
{
    grid g;
    *crossed = false;
    if (o->count <= FEW) {
        *crossed = any_pair_crosses(o);
        return true;
    }
    if (!lay_grid(o, &g))
        return false;
    for (uint32_t side = 0; side < o->count && !*crossed && !tn_watch_stopped(o->watch); side++)
        if (!enter_side(o, &g, side, crossed))
            return false;
    return true;
}
