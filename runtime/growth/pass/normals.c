/* Finds the normals of faces in rows. */
#include "runtime/growth/pass/normals.h"

#define FLAT                                                                                                           \
    1e-12 /* of the squares of a face's extent: a face this flat has no normal, rather than one that rounding chose */
#define MANY 5u /* faces; fewer are sooner done one by one */

/* Newell's sum for one more point of each face. Points are taken relative to the first, so that a face far from the
 * origin keeps its precision. */
TN_INLINED void add_some(tn_normals *restrict n, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        tn_vector a = tn_rows_at(n->before, i), b = tn_sub(tn_rows_at(n->point, i), tn_rows_at(n->first, i));
        tn_rows_put(n->sum, i, tn_add(tn_rows_at(n->sum, i), tn_cross(a, b)));
        tn_rows_put(n->before, i, b);
        n->span[i] += tn_dot(b, b);
    }
}

TN_ANY_WIDTH static void add_points(tn_normals *restrict n)
{
    TN_EACH_LENGTH(n->count, add_some, n);
}

/* Sums become units; `before` gets their squares. */
TN_INLINED void make_some(tn_normals *restrict n, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        tn_vector sum = tn_rows_at(n->sum, i);
        double square = tn_dot(sum, sum);
        n->before[0][i] = square;
        tn_rows_put(n->sum, i, tn_scale(sum, 1 / sqrt(square)));
    }
}

TN_ANY_WIDTH static void make_units(tn_normals *restrict n)
{
    TN_EACH_LENGTH(n->count, make_some, n);
}

static void gather(const tn_normals *n, uint32_t corner, tn_row *points)
{
    const tn_map *map = n->map;
    for (uint32_t i = 0; i < n->count; i++) {
        uint32_t vertex = map->origin[n->darts[i] + corner];
        tn_rows_put(points, i, tn_vector_at(map->positions + 3 * (size_t)vertex));
    }
    tn_rows_fill(points, n->count);
}

static bool is_flat(double square, double span)
{
    return !(square > FLAT * FLAT * span * span && sqrt(square) > 1e-300);
}

/* The same for one face. */
static tn_vector normal_of(const tn_map *map, uint32_t face)
{
    const uint32_t *origin = map->origin + map->face_first[face];
    uint32_t size = tn_face_size(map, face);
    tn_vector first = tn_vector_at(map->positions + 3 * (size_t)origin[0]), n = {0, 0, 0}, before = {0, 0, 0};
    double span = 0;
    for (uint32_t i = 1; i < size; i++) {
        tn_vector p = tn_sub(tn_vector_at(map->positions + 3 * (size_t)origin[i]), first);
        n = tn_add(n, tn_cross(before, p));
        span += tn_dot(p, p);
        before = p;
    }
    double square = tn_dot(n, n);
    return is_flat(square, span) ? (tn_vector){0, 0, 0} : tn_scale(n, 1 / sqrt(square));
}

static void find_together(tn_normals *n)
{
    gather(n, 0, n->first);
    for (uint32_t i = 0; i < tn_row_length(n->count); i++) {
        tn_rows_put(n->before, i, (tn_vector){0, 0, 0});
        tn_rows_put(n->sum, i, (tn_vector){0, 0, 0});
        n->span[i] = 0;
    }
    for (uint32_t corner = 1; corner < n->size; corner++) {
        gather(n, corner, n->point);
        add_points(n);
    }
    make_units(n);
    for (uint32_t i = 0; i < n->count; i++) {
        tn_vector normal = is_flat(n->before[0][i], n->span[i]) ? (tn_vector){0, 0, 0} : tn_rows_at(n->sum, i);
        tn_vector_put(n->normals + 3 * (size_t)n->faces[i], normal);
    }
}

void tn_normals_finish(tn_normals *n)
{
    if (n->count >= MANY)
        find_together(n);
    else
        for (uint32_t i = 0; i < n->count; i++)
            tn_vector_put(n->normals + 3 * (size_t)n->faces[i], normal_of(n->map, n->faces[i]));
    n->count = 0;
}

void tn_normals_start(tn_normals *n, const tn_map *map, double *normals)
{
    n->map = map;
    n->normals = normals;
    n->count = n->size = 0;
}

void tn_normals_add(tn_normals *n, uint32_t face)
{
    uint32_t size = tn_face_size(n->map, face);
    if (size != n->size) {
        tn_normals_finish(n);
        n->size = size;
    }
    n->faces[n->count] = face;
    n->darts[n->count] = n->map->face_first[face];
    if (++n->count == TN_ROW)
        tn_normals_finish(n);
}
