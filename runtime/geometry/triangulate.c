/* Faces cut into triangles by cutting off ears (Meisters 1975): a corner that turns inwards and whose triangle holds no
 * other corner is cut off, until three are left.
 *
 * Only corners that turn outwards can lie in an ear; a tree (corner_tree.h) tells whether one does. Cutting an ear off
 * changes what can be said of its two neighbours alone, so that each corner is looked at when it may have become an ear
 * and not otherwise. Outlines that touch or cross themselves can run out of ears: then all corners are looked at again,
 * which is worth it once an eighth of them went since the last time, or else a corner is cut off as it is. So a face of
 * n corners takes about n log n steps, whatever its outline. */
#include <math.h>
#include <stdlib.h>

#include "runtime/base/watch.h"
#include "runtime/geometry/bit_tree.h"
#include "runtime/geometry/corner_tree.h"
#include "runtime/geometry/mesh.h"

#define FEW 24u /* corners of a face: up to here all that turn outwards are looked at */

/* The outline of the face at hand, in the plane of its normal. Arrays are as long as the largest face. */
typedef struct ring {
    uint32_t count;
    double (*points)[2];
    uint32_t *before, *after; /* the corners that are left */
    bool *outward;            /* turns outwards, so that it may lie in an ear; never set for one that is cut */
    tn_corner_tree tree;      /* of the outward corners, where they are many */
    tn_bit_tree maybe;        /* the corners that may be ears */
    uint32_t looked_left;     /* corners that were left when all were last looked at */
} ring;

static void clear_ring(ring *r)
{
    free(r->points);
    free(r->before);
    free(r->after);
    free(r->outward);
    tn_corner_tree_clear(&r->tree);
    tn_bit_tree_clear(&r->maybe);
}

static tn_status reserve(ring *r, uint32_t room, tn_error *error)
{
    r->points = malloc(room * sizeof *r->points);
    r->before = malloc(room * sizeof *r->before);
    r->after = malloc(room * sizeof *r->after);
    r->outward = malloc(room * sizeof *r->outward);
    if (!r->points || !r->before || !r->after || !r->outward || !tn_bit_tree_new(&r->maybe, room))
        return tn_fail_memory(error);
    return tn_corner_tree_new(&r->tree, room, error);
}

/* ---- the plane of a face */

static void lay_out(ring *r, const tn_mesh *mesh, const uint32_t *corners, uint32_t count)
{
    double n[3], x[3] = {0, 0, 0}, y[3];
    const double *first = mesh->positions + 3 * (size_t)corners[0];
    tn_mesh_face_normal(mesh, corners, count, n);
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++)
        n[k] = length > 1e-300 ? n[k] / length : k == 2;
    int least = fabs(n[0]) <= fabs(n[1]) ? fabs(n[0]) <= fabs(n[2]) ? 0 : 2 : fabs(n[1]) <= fabs(n[2]) ? 1 : 2;
    x[(least + 1) % 3] = n[(least + 2) % 3]; /* across the normal, not unit: only signs count */
    x[(least + 2) % 3] = -n[(least + 1) % 3];
    for (int k = 0; k < 3; k++)
        y[k] = n[(k + 1) % 3] * x[(k + 2) % 3] - n[(k + 2) % 3] * x[(k + 1) % 3];
    r->count = count;
    for (uint32_t i = 0; i < count; i++) {
        const double *p = mesh->positions + 3 * (size_t)corners[i];
        r->points[i][0] = r->points[i][1] = 0;
        for (int k = 0; k < 3; k++) {
            r->points[i][0] += (p[k] - first[k]) * x[k];
            r->points[i][1] += (p[k] - first[k]) * y[k];
        }
        r->before[i] = i == 0 ? count - 1 : i - 1;
        r->after[i] = i + 1 == count ? 0 : i + 1;
    }
}

static double area(const ring *r, uint32_t a, uint32_t b, uint32_t c)
{
    return tn_corner_area((const double(*)[2])r->points, a, b, c);
}

static bool turns_outward(const ring *r, uint32_t i)
{
    return area(r, r->before[i], i, r->after[i]) <= 0;
}

static void find_outward(ring *r)
{
    for (uint32_t i = 0; i < r->count; i++)
        r->outward[i] = turns_outward(r, i);
    if (r->count > FEW)
        tn_corner_tree_make(&r->tree, (const double(*)[2])r->points, r->outward, r->count);
}

/* ---- ears */

static bool is_ear(const ring *r, uint32_t b)
{
    const double(*points)[2] = (const double(*)[2])r->points;
    uint32_t a = r->before[b], c = r->after[b];
    if (area(r, a, b, c) <= 0)
        return false;
    if (r->count > FEW)
        return !tn_corner_tree_meets(&r->tree, a, b, c);
    for (uint32_t i = r->after[c]; i != a; i = r->after[i])
        if (r->outward[i] && tn_corner_in(points, i, a, b, c))
            return false;
    return true;
}

/* The next corner from one on, round the face, that may be an ear; TN_BIT_TREE_NONE if none may. */
static uint32_t next_maybe(const ring *r, uint32_t from)
{
    uint32_t next = tn_bit_tree_next(&r->maybe, from);
    return next == TN_BIT_TREE_NONE ? tn_bit_tree_next(&r->maybe, 0) : next;
}

static uint32_t find_known_ear(ring *r, uint32_t from)
{
    uint32_t i;
    while ((i = next_maybe(r, from)) != TN_BIT_TREE_NONE && !is_ear(r, i))
        tn_bit_tree_remove(&r->maybe, i);
    return i;
}

/* The next ear from a corner on; where the face is folded over itself and none is found, that corner. */
static uint32_t find_ear(ring *r, uint32_t from, uint32_t left)
{
    uint32_t ear = find_known_ear(r, from);
    if (ear == TN_BIT_TREE_NONE && left <= r->looked_left - r->looked_left / 8 - 1) {
        r->looked_left = left;
        for (uint32_t i = 0, k = from; i < left; i++, k = r->after[k])
            tn_bit_tree_add(&r->maybe, k);
        ear = find_known_ear(r, from);
    }
    return ear == TN_BIT_TREE_NONE ? from : ear;
}

/* A neighbour of what was cut off may turn inwards and be an ear now. */
static void look_again(ring *r, uint32_t corner)
{
    tn_bit_tree_add(&r->maybe, corner);
    if (!r->outward[corner] || turns_outward(r, corner))
        return;
    r->outward[corner] = false;
    if (r->count > FEW)
        tn_corner_tree_remove(&r->tree, corner);
}

static void cut_off(ring *r, uint32_t corner)
{
    uint32_t a = r->before[corner], c = r->after[corner];
    r->after[a] = c;
    r->before[c] = a;
    tn_bit_tree_remove(&r->maybe, corner);
    if (r->outward[corner] && r->count > FEW)
        tn_corner_tree_remove(&r->tree, corner);
    r->outward[corner] = false;
    look_again(r, a);
    look_again(r, c);
}

/* False if the work is to end before it is done. */
static bool cut_face(ring *r, const uint32_t *corners, uint32_t *out, tn_watch *watch)
{
    uint32_t at = 0;
    find_outward(r);
    tn_bit_tree_reset(&r->maybe, r->count);
    for (uint32_t i = 0; i < r->count; i++)
        tn_bit_tree_add(&r->maybe, i);
    r->looked_left = r->count;
    for (uint32_t left = r->count; left > 3; left--) {
        if (tn_watch_stopped(watch))
            return false;
        uint32_t ear = find_ear(r, at, left), c = r->after[ear];
        *out++ = corners[r->before[ear]];
        *out++ = corners[ear];
        *out++ = corners[c];
        cut_off(r, ear);
        at = r->after[c]; /* not the same corner again: triangles fan out less */
    }
    *out++ = corners[r->before[at]];
    *out++ = corners[at];
    *out++ = corners[r->after[at]];
    return true;
}

static tn_status cut_all(const tn_mesh *mesh, uint32_t largest, uint32_t *out, tn_error *error)
{
    ring r = {0};
    tn_status status = reserve(&r, largest, error);
    for (size_t f = 0; f < mesh->face_count && status == TN_OK; f++) {
        uint32_t count = mesh->face_first[f + 1] - mesh->face_first[f];
        lay_out(&r, mesh, mesh->corners + mesh->face_first[f], count);
        if (!cut_face(&r, mesh->corners + mesh->face_first[f], out, mesh->watch))
            status = tn_fail_stopped(mesh->watch, error);
        out += 3 * (size_t)(count - 2);
    }
    clear_ring(&r);
    return status;
}

tn_status tn_mesh_triangulate(tn_mesh *mesh, tn_error *error)
{
    size_t triangles = 0;
    uint32_t largest = 3;
    for (size_t f = 0; f < mesh->face_count; f++) {
        uint32_t count = mesh->face_first[f + 1] - mesh->face_first[f];
        triangles += count - 2;
        largest = count > largest ? count : largest;
    }
    if (triangles == mesh->face_count)
        return TN_OK;
    if (triangles > UINT32_MAX / 3)
        return tn_fail(error, TN_LIMIT, E_BOUNDARY_TOO_LARGE, "the mesh would have %zu triangles; the limit is %u",
                       triangles, UINT32_MAX / 3);
    uint32_t *first = malloc((triangles + 1) * sizeof *first), *corners = malloc((3 * triangles + 1) * sizeof *corners);
    uint32_t *group = mesh->face_group ? malloc((triangles + 1) * sizeof *group) : NULL;
    tn_status status = first && corners && (group || !mesh->face_group) ? cut_all(mesh, largest, corners, error)
                                                                        : tn_fail_memory(error);
    if (status != TN_OK) {
        free(first);
        free(corners);
        free(group);
        return status;
    }
    size_t t = 0;
    for (size_t f = 0; f < mesh->face_count; f++) {
        for (uint32_t c = mesh->face_first[f] + 2; c < mesh->face_first[f + 1]; c++, t++) {
            first[t] = (uint32_t)(3 * t);
            if (group)
                group[t] = mesh->face_group[f];
        }
    }
    first[t] = (uint32_t)(3 * t);
    free(mesh->face_first);
    free(mesh->corners);
    free(mesh->face_group);
    mesh->face_first = first;
    mesh->corners = corners;
    mesh->face_group = group;
    mesh->face_count = triangles;
    return TN_OK;
}
