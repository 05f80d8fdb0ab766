/* Finds cells that touch: their boxes by a tree, then the area that two faces in one plane share. */
#include "runtime/geometry/union/contacts.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/geometry/union/box_tree.h"

/* A convex polygon in a plane; each cut adds a corner at most. */
enum { CORNERS = 8, CUT_CORNERS = 2 * CORNERS };

typedef struct polygon {
    double at[CUT_CORNERS][2];
    uint32_t count;
} polygon;

typedef struct touching {
    const tn_cut_box *cells;
    uint32_t *cell;        /* of each box: those of which something is left */
    tn_box_bounds *bounds; /* of boxes, in whole steps */
    uint32_t count;
    double least; /* area */
    tn_contacts *contacts;
} touching;

/* ---- areas */

static const tn_cut_box_face *face_at(const tn_cut_box *cell, int side)
{
    for (uint32_t f = 0; f < cell->face_count; f++)
        if (cell->faces[f].side == side)
            return &cell->faces[f];
    return NULL;
}

/* Counter-clockwise in u and v, whichever side it looks to. */
static void flatten(const tn_cut_box *cell, const tn_cut_box_face *face, int axis, polygon *out)
{
    out->count = face->count;
    for (uint32_t k = 0; k < face->count; k++) {
        const double *at = cell->at[face->corner[face->side & 1 ? k : face->count - 1 - k]];
        out->at[k][0] = at[(axis + 1) % 3];
        out->at[k][1] = at[(axis + 2) % 3];
    }
}

static double left_of(const double a[2], const double b[2], const double p[2])
{
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/* Keeps what lies left of the line from a to b. */
static void keep_left(polygon *of, const double a[2], const double b[2])
{
    polygon kept = {.count = 0};
    for (uint32_t k = 0; k < of->count && kept.count + 2 <= CUT_CORNERS; k++) {
        const double *p = of->at[k], *q = of->at[(k + 1) % of->count];
        double s = left_of(a, b, p), t = left_of(a, b, q);
        if (s >= 0) {
            kept.at[kept.count][0] = p[0];
            kept.at[kept.count++][1] = p[1];
        }
        if ((s < 0 && t > 0) || (s > 0 && t < 0)) {
            kept.at[kept.count][0] = p[0] + s / (s - t) * (q[0] - p[0]);
            kept.at[kept.count++][1] = p[1] + s / (s - t) * (q[1] - p[1]);
        }
    }
    *of = kept;
}

static double area_of(const polygon *p)
{
    double twice = 0;
    for (uint32_t k = 1; k + 1 < p->count; k++)
        twice += left_of(p->at[0], p->at[k], p->at[k + 1]);
    return twice / 2;
}

/* Below 0: nothing. */
static double shared_area(const touching *t, uint32_t below, uint32_t above, int axis)
{
    const tn_cut_box *p = &t->cells[t->cell[below]], *q = &t->cells[t->cell[above]];
    const tn_cut_box_face *top = face_at(p, 2 * axis + 1), *bottom = face_at(q, 2 * axis);
    if (!top || !bottom)
        return -1;
    polygon a, b;
    flatten(p, top, axis, &a);
    flatten(q, bottom, axis, &b);
    for (uint32_t k = 0; k < b.count && a.count >= 3; k++)
        keep_left(&a, b.at[k], b.at[(k + 1) % b.count]);
    return a.count < 3 ? -1 : fmax(0, area_of(&a));
}

/* ---- pairs */

/* The axis across which two boxes meet, if what they share of it can have area; `below` is the lower one. */
static bool meet(const touching *t, uint32_t i, uint32_t j, int *across, uint32_t *below)
{
    const tn_box_bounds *p = &t->bounds[i], *q = &t->bounds[j];
    int levels = 0;
    for (int k = 0; k < 3; k++) {
        bool over = p->high[k] == q->low[k], under = q->high[k] == p->low[k];
        levels += over || under;
        if (over || under) {
            *across = k;
            *below = over ? i : j;
        }
    }
    return levels == 1;
}

static bool add_pair(touching *t, uint32_t i, uint32_t j)
{
    int axis = 0;
    uint32_t below = i;
    if (!meet(t, i, j, &axis, &below))
        return true;
    double area = shared_area(t, below, i + j - below, axis);
    if (!(area >= t->least))
        return true;
    tn_contacts *c = t->contacts;
    if (!tn_array_reserve(&c->items, &c->capacity, c->count, 1, sizeof *c->items))
        return false;
    uint32_t a = t->cell[i], b = t->cell[j];
    c->items[c->count++] = (tn_contact){a < b ? a : b, a < b ? b : a, area};
    return true;
}

static tn_status find_all(touching *t, tn_error *error)
{
    tn_box_tree tree;
    tn_box_search search;
    tn_status status = tn_box_tree_make(t->bounds, t->count, &tree, error);
    bool room = true;
    for (uint32_t i = 0, j; i < t->count && status == TN_OK && room; i++) {
        tn_box_tree_search(&tree, &t->bounds[i], &search);
        while (room && tn_box_search_next(&search, &j))
            room = j <= i || add_pair(t, i, j);
    }
    tn_box_tree_clear(&tree);
    return status == TN_OK && !room ? tn_fail_memory(error) : status;
}

tn_status tn_contacts_find(const tn_cut_box *cells, size_t count, double least, tn_contacts *contacts, tn_error *error)
{
    double step = tn_cut_boxes_step(cells, count), low[3], high[3], square = 0;
    touching t = {.cells = cells, .contacts = contacts};
    *contacts = (tn_contacts){0};
    t.cell = malloc((count + 1) * sizeof *t.cell);
    t.bounds = malloc((count + 1) * sizeof *t.bounds);
    tn_status status = t.cell && t.bounds ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        if (cells[i].face_count == 0)
            continue;
        for (int k = 0; k < 3; k++) {
            t.bounds[t.count].low[k] = rint(cells[i].low[k] / step);
            t.bounds[t.count].high[k] = rint(cells[i].high[k] / step);
        }
        t.cell[t.count++] = (uint32_t)i;
    }
    tn_cut_boxes_bounds(cells, count, low, high);
    for (int k = 0; k < 3; k++)
        square += (high[k] - low[k]) * (high[k] - low[k]);
    t.least = least * square;
    if (status == TN_OK && t.count)
        status = find_all(&t, error);
    free(t.cell);
    free(t.bounds);
    return status;
}

void tn_contacts_clear(tn_contacts *contacts)
{
    free(contacts->items);
    *contacts = (tn_contacts){0};
}
