/* Measures what light falls on: each triangle, as the sun sees it, less those that are nearer to the sun. */
#include "runtime/growth/sunlit.h"

#include <stdlib.h>

#include "runtime/base/watch.h"
#include "runtime/geometry/union/cover.h"
#include "runtime/growth/surface.h"
#include "runtime/numeric/numeric.h"

#define GRAZING 1e-6 /* sine of the angle between a triangle and the light, up to which it takes none */
#define TOUCH 1e-9   /* of the surface's extent: what lies no further before a triangle does not shade it */

/* As the sun sees it: to the right, up, and towards the sun. */
typedef struct triangle {
    double at[3][3];
    tn_vector normal; /* of unit length; zero where it has no area */
    double area;
} triangle;

typedef struct light {
    triangle *triangles;
    tn_cover *covers;
    tn_box_bounds *bounds;
    tn_box_tree tree;
    tn_box_hits hits;
    tn_cover_pieces pieces;
    uint32_t count;
    double touch;
} light;

static void clear(light *l)
{
    free(l->triangles);
    free(l->covers);
    free(l->bounds);
    free(l->hits.items);
    free(l->pieces.pieces);
    tn_box_tree_clear(&l->tree);
}

/* Two directions across the light; the first is also across the axis that the light runs along least. */
static void look_along(tn_vector sun, tn_vector axes[3])
{
    double x = fabs(sun.x), y = fabs(sun.y), z = fabs(sun.z);
    tn_vector least = x <= y && x <= z ? (tn_vector){1, 0, 0} : y <= z ? (tn_vector){0, 1, 0} : (tn_vector){0, 0, 1};
    axes[2] = tn_normalised(sun);
    axes[0] = tn_normalised(tn_cross(least, axes[2]));
    axes[1] = tn_cross(axes[2], axes[0]);
}

static bool take_triangle(light *l, const tn_mesh *mesh, const tn_vector axes[3], uint32_t face)
{
    triangle *t = &l->triangles[face];
    tn_vector seen[3];
    double flat[3][2];
    for (int k = 0; k < 3; k++) {
        tn_vector p = tn_vector_at(mesh->positions + 3 * (size_t)mesh->corners[3 * (size_t)face + (size_t)k]);
        seen[k] = (tn_vector){tn_dot(p, axes[0]), tn_dot(p, axes[1]), tn_dot(p, axes[2])};
        tn_vector_put(t->at[k], seen[k]);
        flat[k][0] = seen[k].x;
        flat[k][1] = seen[k].y;
    }
    tn_vector twice = tn_cross(tn_sub(seen[1], seen[0]), tn_sub(seen[2], seen[0]));
    t->area = 0.5 * tn_norm(twice);
    t->normal = t->area > 0 ? tn_scale(twice, 0.5 / t->area) : (tn_vector){0, 0, 0};
    bool made = tn_cover_of((const double(*)[2])flat, 3, &l->covers[face]);
    l->bounds[face] = tn_cover_bounds(&l->covers[face]);
    return made;
}

static tn_status prepare(light *l, const tn_mesh *mesh, tn_vector sun, tn_error *error)
{
    tn_vector axes[3];
    double low = INFINITY, high = -INFINITY;
    l->count = (uint32_t)mesh->face_count;
    l->triangles = malloc((l->count + 1) * sizeof *l->triangles);
    l->covers = malloc((l->count + 1) * sizeof *l->covers);
    l->bounds = malloc((l->count + 1) * sizeof *l->bounds);
    if (!l->triangles || !l->covers || !l->bounds)
        return tn_fail_memory(error);
    look_along(sun, axes);
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++) {
        low = tn_smaller(low, mesh->positions[i]);
        high = tn_larger(high, mesh->positions[i]);
    }
    l->touch = TOUCH * (high - low);
    for (uint32_t f = 0; f < l->count; f++)
        if (!take_triangle(l, mesh, axes, f))
            return tn_fail_memory(error);
    return tn_box_tree_make(l->bounds, l->count, &l->tree, error);
}

/* The part of one triangle that is nearer to the sun than the plane of another, as the sun sees it: up to four corners.
 */
static bool part_before(const light *l, const triangle *plane, const triangle *t, tn_cover *part)
{
    double points[4][2], height[3];
    size_t count = 0;
    tn_vector n = plane->normal, from = tn_vector_at(plane->at[0]);
    for (int k = 0; k < 3; k++)
        height[k] = tn_dot(tn_sub(tn_vector_at(t->at[k]), from), n) / n.z - l->touch;
    for (int k = 0; k < 3; k++) {
        int next = (k + 1) % 3;
        if (height[k] > 0) {
            points[count][0] = t->at[k][0];
            points[count++][1] = t->at[k][1];
        }
        if ((height[k] > 0) == (height[next] > 0))
            continue;
        double share = height[k] / (height[k] - height[next]);
        points[count][0] = t->at[k][0] + share * (t->at[next][0] - t->at[k][0]);
        points[count++][1] = t->at[k][1] + share * (t->at[next][1] - t->at[k][1]);
    }
    return tn_cover_of((const double(*)[2])points, count, part);
}

/* Adds what of a triangle takes light. */
static bool add_lit(light *l, uint32_t face, double *lit)
{
    const triangle *t = &l->triangles[face];
    if (fabs(t->normal.z) <= GRAZING)
        return true;
    if (!tn_box_tree_list(&l->tree, &l->bounds[face], &l->hits))
        return false;
    tn_cover_begin(&l->pieces, &l->covers[face]);
    for (size_t i = 0; i < l->hits.count && l->pieces.count; i++) {
        tn_cover part;
        if (l->hits.items[i] == face)
            continue;
        if (!part_before(l, t, &l->triangles[l->hits.items[i]], &part))
            return false;
        tn_cover_less(&l->pieces, &part);
    }
    *lit += tn_cover_left(&l->pieces) / fabs(t->normal.z);
    return !l->pieces.failed;
}

static tn_status measure(light *l, tn_watch *watch, double *share, tn_error *error)
{
    double lit = 0, whole = 0;
    for (uint32_t f = 0; f < l->count; f++) {
        if (tn_watch_stopped_at(watch, f))
            return tn_watch_check(watch, error);
        whole += l->triangles[f].area;
        if (!add_lit(l, f, &lit))
            return tn_fail_memory(error);
    }
    *share = whole > 0 ? tn_smaller(lit / whole, 1) : 0;
    return TN_OK;
}

tn_status tn_sunlit_share(const tn_growth *growth, tn_vector sun, double *share, tn_error *error)
{
    tn_mesh mesh;
    light l = {0};
    tn_status status = tn_surface_mesh(growth, &(tn_surface_options){0}, &mesh, error);
    if (status == TN_OK)
        status = tn_mesh_triangulate(&mesh, error);
    if (status == TN_OK)
        status = prepare(&l, &mesh, sun, error);
    if (status == TN_OK)
        status = measure(&l, tn_growth_settings(growth)->watch, share, error);
    clear(&l);
    tn_mesh_clear(&mesh);
    return status;
}
