/* Faces cut into triangles by cutting off ears (Meisters 1975): a corner that turns inwards and whose triangle holds no
 * other corner is cut off, until three are left. Only corners that turn outwards can lie in an ear, and a grid tells
 * which of them are near: a face of many thousand corners takes little longer than its share. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/geometry/mesh.h"

#define NONE UINT32_MAX
#define FEW 24u /* outward corners: up to here all are looked at */

/* The outline of the face at hand, in the plane of its normal. Arrays are as long as the largest face. */
typedef struct ring {
    uint32_t count;
    double (*points)[2];
    uint32_t *before, *after; /* the corners that are left */
    bool *outward;            /* turns outwards, so that it may lie in an ear; never set for one that is cut */
    uint32_t outwards;
    uint32_t *cells, *next; /* outward corners by cell, as linked lists */
    double low[2], cell[2];
    uint32_t size[2];
    uint32_t room, cell_room;
} ring;

static void clear_ring(ring *r)
{
    free(r->points);
    free(r->before);
    free(r->after);
    free(r->outward);
    free(r->cells);
    free(r->next);
}

static tn_status reserve(ring *r, uint32_t room, tn_error *error)
{
    r->room = room;
    r->cell_room = room + 2 * (uint32_t)sqrt(room) + 2;
    r->points = malloc(room * sizeof *r->points);
    r->before = malloc(room * sizeof *r->before);
    r->after = malloc(room * sizeof *r->after);
    r->outward = malloc(room * sizeof *r->outward);
    r->cells = malloc(r->cell_room * sizeof *r->cells);
    r->next = malloc(room * sizeof *r->next);
    bool all = r->points && r->before && r->after && r->outward && r->cells && r->next;
    return all ? TN_OK : tn_fail_memory(error);
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

/* Twice the area of a triangle, counter-clockwise. */
static double area(const ring *r, uint32_t a, uint32_t b, uint32_t c)
{
    const double *p = r->points[a], *q = r->points[b], *s = r->points[c];
    return (q[0] - p[0]) * (s[1] - p[1]) - (q[1] - p[1]) * (s[0] - p[0]);
}

static bool turns_outward(const ring *r, uint32_t i)
{
    return area(r, r->before[i], i, r->after[i]) <= 0;
}

/* ---- the grid */

static uint32_t cell_of(const ring *r, int k, double at)
{
    double cell = (at - r->low[k]) / r->cell[k];
    return cell >= r->size[k] ? r->size[k] - 1 : cell > 0 ? (uint32_t)cell : 0;
}

static void lay_grid(ring *r)
{
    double high[2];
    uint32_t fine = (uint32_t)sqrt(r->outwards) + 1;
    for (int k = 0; k < 2; k++) {
        r->low[k] = high[k] = r->points[0][k];
        for (uint32_t i = 1; i < r->count; i++) {
            r->low[k] = fmin(r->low[k], r->points[i][k]);
            high[k] = fmax(high[k], r->points[i][k]);
        }
        r->size[k] = high[k] > r->low[k] ? fine : 1;
        r->cell[k] = high[k] > r->low[k] ? (high[k] - r->low[k]) / fine : 1;
    }
    memset(r->cells, 0xff, (size_t)r->size[0] * r->size[1] * sizeof *r->cells);
    for (uint32_t i = 0; i < r->count; i++) {
        if (!r->outward[i])
            continue;
        uint32_t *cell = &r->cells[cell_of(r, 1, r->points[i][1]) * r->size[0] + cell_of(r, 0, r->points[i][0])];
        r->next[i] = *cell;
        *cell = i;
    }
}

static void find_outward(ring *r)
{
    r->outwards = 0;
    for (uint32_t i = 0; i < r->count; i++)
        r->outwards += r->outward[i] = turns_outward(r, i);
    if (r->outwards > FEW)
        lay_grid(r);
}

/* ---- ears */

static bool lies_in(const ring *r, uint32_t i, uint32_t a, uint32_t b, uint32_t c)
{
    return i != a && i != b && i != c && area(r, a, b, i) >= 0 && area(r, b, c, i) >= 0 && area(r, c, a, i) >= 0;
}

/* Corners that turn inwards by now are left in their cells: they hide nothing, and are passed over. */
static bool cell_is_clear(const ring *r, uint32_t cell, uint32_t a, uint32_t b, uint32_t c)
{
    for (uint32_t i = r->cells[cell]; i != NONE; i = r->next[i])
        if (r->outward[i] && lies_in(r, i, a, b, c))
            return false;
    return true;
}

static bool is_ear(const ring *r, uint32_t b)
{
    uint32_t a = r->before[b], c = r->after[b];
    if (area(r, a, b, c) <= 0)
        return false;
    if (r->outwards <= FEW) {
        for (uint32_t i = r->after[c]; i != a; i = r->after[i])
            if (r->outward[i] && lies_in(r, i, a, b, c))
                return false;
        return true;
    }
    uint32_t low[2], high[2];
    for (int k = 0; k < 2; k++) {
        double p = r->points[a][k], q = r->points[b][k], s = r->points[c][k];
        low[k] = cell_of(r, k, fmin(p, fmin(q, s)));
        high[k] = cell_of(r, k, fmax(p, fmax(q, s)));
    }
    for (uint32_t row = low[1]; row <= high[1]; row++)
        for (uint32_t column = low[0]; column <= high[0]; column++)
            if (!cell_is_clear(r, row * r->size[0] + column, a, b, c))
                return false;
    return true;
}

/* The next ear from a corner on; where the face is folded over itself and has none, that corner. */
static uint32_t find_ear(const ring *r, uint32_t from, uint32_t left)
{
    uint32_t i = from;
    for (uint32_t tried = 0; tried < left; tried++, i = r->after[i])
        if (is_ear(r, i))
            return i;
    return from;
}

static void cut_face(ring *r, const uint32_t *corners, uint32_t *out)
{
    uint32_t at = 0;
    find_outward(r);
    for (uint32_t left = r->count; left > 3; left--) {
        uint32_t ear = find_ear(r, at, left), a = r->before[ear], c = r->after[ear];
        *out++ = corners[a];
        *out++ = corners[ear];
        *out++ = corners[c];
        r->after[a] = c;
        r->before[c] = a;
        r->outward[ear] = false;
        r->outward[a] = r->outward[a] && turns_outward(r, a);
        r->outward[c] = r->outward[c] && turns_outward(r, c);
        at = r->after[c]; /* not the same corner again: triangles fan out less */
    }
    *out++ = corners[r->before[at]];
    *out++ = corners[at];
    *out++ = corners[r->after[at]];
}

static tn_status cut_all(const tn_mesh *mesh, uint32_t largest, uint32_t *out, tn_error *error)
{
    ring r = {0};
    tn_status status = reserve(&r, largest, error);
    for (size_t f = 0; f < mesh->face_count && status == TN_OK; f++) {
        uint32_t count = mesh->face_first[f + 1] - mesh->face_first[f];
        lay_out(&r, mesh, mesh->corners + mesh->face_first[f], count);
        cut_face(&r, mesh->corners + mesh->face_first[f], out);
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
