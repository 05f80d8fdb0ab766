/* Finds the order in which faces are painted. */
#include "runtime/geometry/hidden/hidden.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/watch.h"
#include "runtime/geometry/hidden/hidden_parts.h"
#include "runtime/geometry/mesh.h"

#define EDGE_ON 1e-7 /* of the square of its longest side: a triangle with less area in the picture is a line */

void tn_painting_clear(tn_painting *painting)
{
    free(painting->patches);
    free(painting->points);
    free(painting->sides);
    *painting = (tn_painting){0};
}

tn_status tn_painting_add(tn_painting *painting, tn_patch patch, tn_error *error)
{
    if (!tn_array_reserve(&painting->patches, &painting->patch_room, painting->patch_count, 1,
                          sizeof *painting->patches))
        return tn_fail_memory(error);
    painting->patches[painting->patch_count++] = patch;
    return TN_OK;
}

/* ---- triangles */

static void look_at(const tn_scene *scene, tn_seen_triangle *t)
{
    const double *p = scene->points[t->corner[0]], *q = scene->points[t->corner[1]], *r = scene->points[t->corner[2]];
    double ux = q[0] - p[0], uy = q[1] - p[1], uz = q[2] - p[2], vx = r[0] - p[0], vy = r[1] - p[1], vz = r[2] - p[2];
    double area = ux * vy - uy * vx, wx = vx - ux, wy = vy - uy;
    double longest = fmax(ux * ux + uy * uy, fmax(vx * vx + vy * vy, wx * wx + wy * wy));
    t->edge_on = !(fabs(area) > EDGE_ON * longest);
    t->slope[0] = t->edge_on ? 0 : (uz * vy - uy * vz) / area;
    t->slope[1] = t->edge_on ? 0 : (ux * vz - uz * vx) / area;
    t->height = p[2] - t->slope[0] * p[0] - t->slope[1] * p[1];
    if (area < 0) {
        uint32_t swap = t->corner[1];
        t->corner[1] = t->corner[2];
        t->corner[2] = swap;
    }
}

/* Every face in triangles, each corner of a face a vertex of its own. */
static tn_status cut_faces(const tn_scene *scene, tn_seen_triangle **result, size_t *count, tn_error *error)
{
    uint32_t corners = scene->first[scene->face_count];
    tn_mesh mesh;
    tn_status status = tn_mesh_new(corners, scene->face_count, corners, &mesh, error);
    if (status != TN_OK)
        return status;
    memcpy(mesh.positions, scene->points, corners * sizeof *scene->points);
    memcpy(mesh.face_first, scene->first, (scene->face_count + 1) * sizeof *scene->first);
    for (uint32_t c = 0; c < corners; c++)
        mesh.corners[c] = c;
    status = tn_mesh_triangulate(&mesh, error);
    tn_seen_triangle *triangles = status == TN_OK ? malloc((mesh.face_count + 1) * sizeof *triangles) : NULL;
    if (status == TN_OK && !triangles)
        status = tn_fail_memory(error);
    uint32_t face = 0;
    for (size_t t = 0; status == TN_OK && t < mesh.face_count; t++) {
        memcpy(triangles[t].corner, mesh.corners + 3 * t, sizeof triangles[t].corner);
        while (triangles[t].corner[0] >= scene->first[face + 1])
            face++;
        triangles[t].face = face;
        look_at(scene, &triangles[t]);
    }
    *count = mesh.face_count;
    *result = triangles;
    tn_mesh_clear(&mesh);
    return status;
}

/* ---- painting */

typedef struct work {
    const tn_scene *scene;
    tn_seen_triangle *triangles;
    uint32_t *triangle_first; /* [face + 1] */
    tn_order order;
    tn_painting *painting;
} work;

typedef struct face_at {
    double depth;
    uint32_t face;
} face_at;

static int farther_first(const void *a, const void *b)
{
    const face_at *x = a, *y = b;
    if (x->depth != y->depth)
        return x->depth < y->depth ? -1 : 1;
    return x->face < y->face ? -1 : x->face > y->face;
}

static tn_status paint_face(work *w, uint32_t face, tn_error *error)
{
    uint32_t first = w->scene->first[face], end = w->scene->first[face + 1];
    return tn_painting_add(w->painting, (tn_patch){face, first, end - first, false}, error);
}

static tn_status paint_by_depth(work *w, const uint32_t *faces, size_t count, tn_error *error)
{
    face_at *sorted = malloc(count * sizeof *sorted);
    if (!sorted)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        sorted[i] = (face_at){w->order.depth[faces[i]], faces[i]};
    qsort(sorted, count, sizeof *sorted, farther_first);
    tn_status status = TN_OK;
    for (size_t i = 0; i < count && status == TN_OK; i++)
        status = paint_face(w, sorted[i].face, error);
    w->painting->by_depth += (uint32_t)count;
    free(sorted);
    return status;
}

static tn_status cut_knot(work *w, const uint32_t *faces, size_t count, tn_error *error)
{
    size_t triangles = 0, n = 0;
    for (size_t i = 0; i < count; i++)
        triangles += w->triangle_first[faces[i] + 1] - w->triangle_first[faces[i]];
    uint32_t *list = malloc((triangles + 1) * sizeof *list);
    if (!list)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        for (uint32_t t = w->triangle_first[faces[i]]; t < w->triangle_first[faces[i] + 1]; t++)
            list[n++] = t;
    tn_painting *painting = w->painting;
    size_t patches = painting->patch_count, corners = painting->corner_count;
    tn_status status = tn_painting_cut(w->scene, w->triangles, list, n, painting, error);
    free(list);
    if (status != TN_LIMIT)
        return status;
    painting->patch_count = patches;
    painting->corner_count = corners;
    return paint_by_depth(w, faces, count, error);
}

static tn_status paint_knot(void *user, uint32_t knot, tn_error *error)
{
    work *w = user;
    const tn_order *o = &w->order;
    if (tn_watch_stopped(w->scene->watch))
        return tn_fail_stopped(w->scene->watch, error);
    const uint32_t *faces = o->members + o->knot_first[knot];
    uint32_t count = o->knot_first[knot + 1] - o->knot_first[knot];
    return count == 1 ? paint_face(w, faces[0], error) : cut_knot(w, faces, count, error);
}

static tn_status find_order(work *w, size_t triangle_count, tn_error *error)
{
    tn_face_pairs befores;
    tn_status status = tn_overlaps_find(w->scene, w->triangles, triangle_count, &befores, error);
    if (status == TN_OK)
        status = tn_order_make(w->scene, &befores, &w->order, error);
    free(befores.items);
    if (status != TN_OK)
        return status;
    w->triangle_first = calloc((size_t)w->scene->face_count + 1, sizeof *w->triangle_first);
    if (!w->triangle_first)
        return tn_fail_memory(error);
    for (uint32_t f = 0; f < w->scene->face_count; f++)
        w->triangle_first[f + 1] = w->triangle_first[f] + w->scene->first[f + 1] - w->scene->first[f] - 2;
    return TN_OK;
}

tn_status tn_painting_make(const tn_scene *scene, tn_painting *painting, tn_error *error)
{
    work w = {.scene = scene, .painting = painting};
    size_t triangle_count;
    *painting = (tn_painting){0};
    tn_status status = cut_faces(scene, &w.triangles, &triangle_count, error);
    if (status == TN_OK)
        status = find_order(&w, triangle_count, error);
    if (status == TN_OK)
        status = tn_order_walk(&w.order, paint_knot, &w, error);
    free(w.triangles);
    free(w.triangle_first);
    tn_order_clear(&w.order);
    return status;
}
