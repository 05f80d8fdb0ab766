/* The centre of mass, and its distance to the edge of the hull of what stands on the ground (Andrew's monotone chain,
 * 1979). */
#include "runtime/place/balance.h"

#include <math.h>
#include <stdlib.h>

typedef struct point {
    double x, z;
} point;

static int compare(const void *a, const void *b)
{
    const point *one = a, *other = b;
    if (one->x != other->x)
        return one->x < other->x ? -1 : 1;
    return (one->z > other->z) - (one->z < other->z);
}

static double side(const point *a, const point *b, const point *c)
{
    return (b->x - a->x) * (c->z - a->z) - (b->z - a->z) * (c->x - a->x);
}

/* Points in order around the hull; `hull` has room for one more than there are points. */
static size_t make_hull(point *points, size_t count, point *hull)
{
    size_t n = 0;
    qsort(points, count, sizeof *points, compare);
    for (int half = 0; half < 2; half++) {
        size_t start = n + 1;
        for (size_t k = 0; k < count; k++) {
            const point *p = half == 0 ? &points[k] : &points[count - 1 - k];
            while (n > start && side(&hull[n - 2], &hull[n - 1], p) <= 0)
                n--;
            hull[n++] = *p;
        }
        n--; /* the last is the first of the other half */
    }
    return n;
}

static double box_cells(const tn_cell_box *box)
{
    return ((double)box->high[0] - box->low[0]) * ((double)box->high[1] - box->low[1]) *
           ((double)box->high[2] - box->low[2]);
}

typedef struct weighing {
    const tn_module *module;
    const tn_placed_model *model;
    const tn_placed_joints *joints;
    double unit[3];
    bool by_cells;
} weighing;

static double part_cells(const weighing *w, const tn_kit_part_record *kind, const tn_frame *frame)
{
    double cells = 0;
    for (uint32_t b = 0; b < kind->box_count; b++) {
        tn_cell_box box = tn_part_box_at(&w->module->PART_BOX_records[kind->box_first + b], frame);
        cells += box_cells(&box);
    }
    return cells;
}

/* Adds a part's mass at the middles of its boxes. */
static void weigh(const weighing *w, size_t i, point *sum, double *total)
{
    const tn_kit_part_record *kind = w->joints->kinds[i];
    const tn_frame *frame = &w->model->parts[i].frame;
    double cells = kind ? part_cells(w, kind, frame) : 0;
    for (uint32_t b = 0; cells > 0 && b < kind->box_count; b++) {
        tn_cell_box box = tn_part_box_at(&w->module->PART_BOX_records[kind->box_first + b], frame);
        double mass = box_cells(&box) * (w->by_cells ? 1 : kind->mass / cells);
        sum->x += mass * w->unit[0] * ((double)box.low[0] + box.high[0]) / 2;
        sum->z += mass * w->unit[2] * ((double)box.low[2] + box.high[2]) / 2;
        *total += mass;
    }
}

static bool find_centre(weighing *w, point *centre)
{
    double total = 0;
    for (int by_cells = 0; by_cells < 2 && !(total > 0); by_cells++) {
        w->by_cells = by_cells;
        *centre = (point){0};
        for (size_t i = 0; i < w->model->count; i++)
            weigh(w, i, centre, &total);
    }
    centre->x /= total;
    centre->z /= total;
    return total > 0;
}

static size_t list_feet(const weighing *w, int32_t ground, point *points)
{
    size_t count = 0;
    for (size_t i = 0; i < w->model->count; i++) {
        const tn_kit_part_record *kind = w->joints->kinds[i];
        for (uint32_t b = 0; kind && b < kind->box_count; b++) {
            tn_cell_box box =
                tn_part_box_at(&w->module->PART_BOX_records[kind->box_first + b], &w->model->parts[i].frame);
            if (box.high[1] != ground)
                continue;
            for (int corner = 0; points && corner < 4; corner++)
                points[count + (size_t)corner] = (point){w->unit[0] * (corner & 1 ? box.high[0] : box.low[0]),
                                                         w->unit[2] * (corner & 2 ? box.high[2] : box.low[2])};
            count += 4;
        }
    }
    return count;
}

/* To the nearest edge; below 0 outside of one. */
static double distance(const point *hull, size_t count, const point *p)
{
    double least = INFINITY;
    for (size_t i = 0; i < count; i++) {
        const point *a = &hull[i], *b = &hull[(i + 1) % count];
        double length = sqrt((b->x - a->x) * (b->x - a->x) + (b->z - a->z) * (b->z - a->z));
        double away = length > 0 ? side(a, b, p) / length : INFINITY;
        least = away < least ? away : least;
    }
    return least;
}

tn_status tn_balance(const tn_module *module, const tn_placed_model *model, const tn_placed_joints *joints,
                     int32_t ground, double *balance, tn_error *error)
{
    weighing w = {.module = module, .model = model, .joints = joints};
    point centre;
    *balance = 0;
    tn_place_unit(module, w.unit);
    size_t count = list_feet(&w, ground, NULL);
    if (count == 0 || !find_centre(&w, &centre))
        return TN_OK;
    point *points = calloc(3 * count + 1, sizeof *points);
    if (!points)
        return tn_fail_memory(error);
    list_feet(&w, ground, points);
    point *hull = points + count;
    *balance = distance(hull, make_hull(points, count, hull), &centre);
    free(points);
    return TN_OK;
}
