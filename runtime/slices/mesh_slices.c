/* Slices a closed mesh: in each layer, from triangle to triangle over the edges that cross its height. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/geometry/crease.h"
#include "runtime/geometry/twin.h"
#include "runtime/slices/slices.h"

#define NONE TN_NO_TWIN

typedef struct tracing {
    const tn_mesh *mesh;
    bool *creases;
    uint32_t *twin;  /* [corner] of the other triangle that has the edge to the next corner */
    bool *done;      /* [triangle], of the layer at hand */
    uint32_t *order; /* triangles by their lowest height */
    double *lowest;  /* [triangle] */
    tn_slices *slices;
    size_t point_room, line_room;
} tracing;

static uint32_t next_corner(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

static double height_of(const tracing *t, uint32_t corner)
{
    return t->mesh->positions[3 * (size_t)t->mesh->corners[corner] + 2];
}

/* ---- lines */

/* Where the edge crosses the height, the same seen from both of its triangles. */
static void crossing(const tracing *t, uint32_t corner, double height, double point[2])
{
    const double *a = t->mesh->positions + 3 * (size_t)t->mesh->corners[corner],
                 *b = t->mesh->positions + 3 * (size_t)t->mesh->corners[next_corner(corner)];
    if (a[2] > b[2]) {
        const double *other = a;
        a = b;
        b = other;
    }
    double share = (height - a[2]) / (b[2] - a[2]);
    for (int k = 0; k < 2; k++)
        point[k] = share >= 1 ? b[k] : a[k] + share * (b[k] - a[k]);
}

static tn_status add_point(tracing *t, const double point[2], tn_error *error)
{
    tn_slices *s = t->slices;
    if (s->point_count > s->line_first[s->line_count] &&
        memcmp(s->points[s->point_count - 1], point, sizeof *s->points) == 0)
        return TN_OK;
    if (s->point_count >= NONE || !tn_array_reserve(&s->points, &t->point_room, s->point_count, 1, sizeof *s->points))
        return tn_fail_memory(error);
    memcpy(s->points[s->point_count++], point, sizeof *s->points);
    return TN_OK;
}

/* Of the triangle's edges the one that rises through the height, or falls; NONE where it does not cross it. */
static uint32_t edge_through(const tracing *t, uint32_t face, double height, bool rises)
{
    for (uint32_t c = 3 * face; c < 3 * face + 3; c++) {
        bool from = height_of(t, c) >= height, to = height_of(t, next_corner(c)) >= height;
        if (from != to && to == rises)
            return c;
    }
    return NONE;
}

/* Seen from above, with the inside on the left, a line enters a triangle by the edge that falls and leaves it by the
 * one that rises. Lines of fewer than three corners have no inside, and are left out. */
static tn_status trace_line(tracing *t, uint32_t face, double height, tn_error *error)
{
    tn_slices *s = t->slices;
    tn_status status = TN_OK;
    for (uint32_t at = face; at != NONE && !t->done[at] && status == TN_OK;) {
        uint32_t leaves = edge_through(t, at, height, true);
        double point[2];
        t->done[at] = true;
        crossing(t, leaves, height, point);
        if (t->creases[leaves])
            status = add_point(t, point, error);
        at = t->twin[leaves] == NONE ? NONE : t->twin[leaves] / 3;
    }
    uint32_t first = s->line_first[s->line_count];
    while (s->point_count > first + 1 &&
           memcmp(s->points[first], s->points[s->point_count - 1], sizeof *s->points) == 0)
        s->point_count--;
    if (s->point_count < first + 3u)
        s->point_count = first;
    if (status != TN_OK || s->point_count == first)
        return status;
    if (!tn_array_reserve(&s->line_first, &t->line_room, s->line_count, 2, sizeof *s->line_first))
        return tn_fail_memory(error);
    s->line_first[++s->line_count] = (uint32_t)s->point_count;
    return TN_OK;
}

static double highest_of(const tracing *t, uint32_t face)
{
    return fmax(height_of(t, 3 * face), fmax(height_of(t, 3 * face + 1), height_of(t, 3 * face + 2)));
}

/* Triangles that reach from below a layer into it are open; they come in order of their lowest heights. */
static tn_status trace_layers(tracing *t, tn_error *error)
{
    tn_slices *s = t->slices;
    size_t faces = t->mesh->face_count, come = 0, open_count = 0;
    uint32_t *open = malloc((faces + 1) * sizeof *open);
    tn_status status = open ? TN_OK : tn_fail_memory(error);
    for (size_t layer = 0; layer < s->layer_count && status == TN_OK; layer++) {
        double height = s->heights[layer];
        size_t kept = 0;
        for (; come < faces && t->lowest[t->order[come]] < height; come++)
            open[open_count++] = t->order[come];
        for (size_t i = 0; i < open_count; i++)
            if (highest_of(t, open[i]) >= height)
                open[kept++] = open[i];
        open_count = kept;
        for (size_t i = 0; i < open_count; i++)
            t->done[open[i]] = false;
        for (size_t i = 0; i < open_count && status == TN_OK; i++)
            if (!t->done[open[i]])
                status = trace_line(t, open[i], height, error);
        s->layer_first[layer + 1] = (uint32_t)s->line_count;
    }
    free(open);
    return status;
}

typedef struct by_height {
    double lowest;
    uint32_t face;
} by_height;

static int lower_first(const void *a, const void *b)
{
    const by_height *x = a, *y = b;
    if (x->lowest != y->lowest)
        return x->lowest < y->lowest ? -1 : 1;
    return x->face < y->face ? -1 : x->face > y->face;
}

static tn_status order_faces(tracing *t, tn_error *error)
{
    size_t faces = t->mesh->face_count;
    by_height *list = malloc((faces + 1) * sizeof *list);
    if (!list)
        return tn_fail_memory(error);
    for (uint32_t f = 0; f < faces; f++) {
        t->lowest[f] = fmin(height_of(t, 3 * f), fmin(height_of(t, 3 * f + 1), height_of(t, 3 * f + 2)));
        list[f] = (by_height){t->lowest[f], f};
    }
    qsort(list, faces, sizeof *list, lower_first);
    for (size_t f = 0; f < faces; f++)
        t->order[f] = list[f].face;
    free(list);
    return TN_OK;
}

static tn_status begin(tracing *t, double thickness, tn_error *error)
{
    size_t faces = t->mesh->face_count;
    double low = INFINITY, high = -INFINITY;
    for (size_t v = 0; v < t->mesh->vertex_count; v++) {
        low = fmin(low, t->mesh->positions[3 * v + 2]);
        high = fmax(high, t->mesh->positions[3 * v + 2]);
    }
    tn_status status = tn_slices_layers(low, high, thickness, t->slices, error);
    if (status != TN_OK)
        return status;
    t->twin = tn_mesh_twins(t->mesh);
    t->done = malloc(faces + 1);
    t->order = malloc((faces + 1) * sizeof *t->order);
    t->lowest = malloc((faces + 1) * sizeof *t->lowest);
    t->line_room = 16;
    t->slices->line_first = calloc(t->line_room, sizeof *t->slices->line_first);
    if (!t->twin || !t->done || !t->order || !t->lowest || !t->slices->line_first)
        return tn_fail_memory(error);
    return order_faces(t, error);
}

/* Groups do not matter to outlines: only where the mesh bends do they turn. */
static tn_status find_creases(tracing *t, tn_error *error)
{
    tn_mesh plain = *t->mesh;
    plain.face_group = NULL;
    return tn_mesh_creases(&plain, &t->creases, error);
}

tn_status tn_slices_of_mesh(const tn_mesh *mesh, double thickness, tn_slices *slices, tn_error *error)
{
    tracing t = {.mesh = mesh, .slices = slices};
    *slices = (tn_slices){0};
    tn_status status = begin(&t, thickness, error);
    if (status == TN_OK)
        status = find_creases(&t, error);
    if (status == TN_OK)
        status = trace_layers(&t, error);
    free(t.creases);
    free(t.twin);
    free(t.done);
    free(t.order);
    free(t.lowest);
    return status;
}
