/* Measures whether a grown surface could be built, and what light falls on it. */
#include "runtime/growth/soundness.h"

#include <stdlib.h>

#include "runtime/base/watch.h"
#include "runtime/geometry/boundary_mesh.h"
#include "runtime/geometry/crossing.h"
#include "runtime/geometry/union/cover.h"
#include "runtime/geometry/vector.h"
#include "runtime/growth/faults.h"
#include "runtime/growth/growth.h"
#include "runtime/growth/surface.h"
#include "runtime/math/elementary.h"

/* ==== measures what light falls on: each triangle, as the sun sees it, less those that are nearer to the sun */

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

/* The share of the surface's area that light from far away in the direction `sun` falls on, from 0 to 1: what no other
 * part of the surface keeps it from. Either side of the surface takes light. Exact but for rounding: of each triangle
 * of the faces, what lies behind others is cut away. `sun` is not zero, and need not be of length 1. A triangle that
 * the light runs along has none. Quadratic where all of the surface lies behind itself. TN_OK, TN_MEMORY or TN_STOPPED.
 */
static tn_status sunlit_share(const tn_growth *growth, tn_vector sun, double *share, tn_error *error)
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

/* ==== measures whether a grown surface could be built */

#define GROUND 0.01 /* of the height: what is no higher above the lowest vertex stands on the ground */
#define DEGREES 57.29577951308232

static bool is_asked(uint64_t asked, tn_measured first, tn_measured last)
{
    return asked >> first & ((UINT64_C(2) << (last - first)) - 1);
}

static void put(tn_fitness *fitness, tn_measured measured, double value)
{
    fitness->further[measured - TN_MEASURED_WIDTH] = value;
}

static tn_vector corner(const tn_map *map, uint32_t dart)
{
    return tn_vector_at(map->positions + 3 * (size_t)map->origin[dart]);
}

static void measure_extents(const tn_map *map, tn_fitness *fitness, double low[3])
{
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    low[0] = low[1] = low[2] = INFINITY;
    for (size_t i = 0; i < 3 * (size_t)map->vertex_count; i++) {
        low[i % 3] = tn_smaller(low[i % 3], map->positions[i]);
        high[i % 3] = tn_larger(high[i % 3], map->positions[i]);
    }
    put(fitness, TN_MEASURED_WIDTH, high[0] - low[0]);
    put(fitness, TN_MEASURED_DEPTH, high[1] - low[1]);
    put(fitness, TN_MEASURED_HEIGHT, high[2] - low[2]);
}

/* ---- faces */

typedef struct face_sums {
    double area, volume, off_plane, worst, smallest_angle;
} face_sums;

/* The angle between two sides, in degrees; that of a side without length is 0. */
static double angle_between(tn_vector a, tn_vector b)
{
    return DEGREES * tn_atan2(tn_norm(tn_cross(a, b)), tn_dot(a, b));
}

static void add_face(const tn_map *map, uint32_t face, double ground, face_sums *sums)
{
    uint32_t first = map->face_first[face], size = tn_face_size(map, face);
    tn_vector middle = {0, 0, 0}, normal = {0, 0, 0};
    for (uint32_t i = 0; i < size; i++)
        middle = tn_add(middle, tn_scale(corner(map, first + i), 1.0 / size));
    for (uint32_t i = 0; i < size; i++) {
        tn_vector at = corner(map, first + i), next = corner(map, first + (i + 1) % size),
                  before = corner(map, first + (i + size - 1) % size);
        tn_vector part = tn_cross(tn_sub(at, middle), tn_sub(next, middle));
        normal = tn_add(normal, part);
        sums->volume += 0.5 * part.z * ((at.z + next.z + middle.z) / 3 - ground);
        sums->smallest_angle = tn_smaller(sums->smallest_angle, angle_between(tn_sub(next, at), tn_sub(before, at)));
    }
    sums->area += 0.5 * tn_norm(normal);
    tn_vector unit = tn_normalised(normal);
    double off = 0, reach = 0;
    for (uint32_t i = 0; i < size; i++) {
        tn_vector from = tn_sub(corner(map, first + i), middle);
        off = tn_larger(off, fabs(tn_dot(from, unit)));
        reach = tn_larger(reach, tn_norm(from));
    }
    double share = size > 3 && reach > 0 ? off / (2 * reach) : 0;
    sums->off_plane += share;
    sums->worst = tn_larger(sums->worst, share);
}

static void measure_faces(const tn_map *map, double ground, tn_fitness *fitness)
{
    face_sums sums = {.smallest_angle = 180};
    for (uint32_t f = TN_OUTER_FACE + 1; f < map->face_count; f++)
        add_face(map, f, ground, &sums);
    put(fitness, TN_MEASURED_AREA, sums.area);
    put(fitness, TN_MEASURED_VOLUME, fabs(sums.volume));
    put(fitness, TN_MEASURED_PLANARITY, sums.off_plane / tn_larger(1, map->face_count - 1.0));
    put(fitness, TN_MEASURED_WORST_PLANARITY, sums.worst);
    put(fitness, TN_MEASURED_SMALLEST_ANGLE, sums.smallest_angle);
}

/* Each edge once: the dart that runs along it. */
static void measure_edges(const tn_map *map, tn_fitness *fitness)
{
    double sum = 0, squares = 0;
    for (uint32_t f = 0; f < map->face_count; f++) {
        uint32_t first = map->face_first[f], size = tn_face_size(map, f);
        for (uint32_t i = 0; i < size; i++) {
            if (map->side[first + i] & 1)
                continue;
            double length = tn_norm(tn_sub(corner(map, first + (i + 1) % size), corner(map, first + i)));
            sum += length;
            squares += length * length;
        }
    }
    double mean = sum / map->edge_count, variance = tn_larger(0, squares / map->edge_count - mean * mean);
    put(fitness, TN_MEASURED_EDGE_SPREAD, mean > 0 ? sqrt(variance) / mean : 0);
}

/* ---- the span */

typedef struct foot {
    double x, y;
} foot;

static int by_x(const void *left, const void *right)
{
    const foot *a = left, *b = right;
    return a->x != b->x ? (a->x < b->x ? -1 : 1) : a->y < b->y ? -1 : a->y > b->y;
}

/* Feet are in order of x: from the place of x outward, as long as x alone does not lie too far away. */
static double distance_to_feet(const foot *feet, size_t count, double x, double y)
{
    size_t low = 0, high = count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (feet[middle].x < x)
            low = middle + 1;
        else
            high = middle;
    }
    double nearest = INFINITY;
    for (size_t i = low; i < count && (feet[i].x - x) * (feet[i].x - x) < nearest; i++)
        nearest = tn_smaller(nearest, (feet[i].x - x) * (feet[i].x - x) + (feet[i].y - y) * (feet[i].y - y));
    for (size_t i = low; i > 0 && (feet[i - 1].x - x) * (feet[i - 1].x - x) < nearest; i--)
        nearest =
            tn_smaller(nearest, (feet[i - 1].x - x) * (feet[i - 1].x - x) + (feet[i - 1].y - y) * (feet[i - 1].y - y));
    return sqrt(nearest);
}

static tn_status measure_span(const tn_map *map, double ground, tn_fitness *fitness, tn_error *error)
{
    double height = fitness->further[TN_MEASURED_HEIGHT - TN_MEASURED_WIDTH], span = 0;
    foot *feet = malloc((map->vertex_count + 1) * sizeof *feet);
    size_t count = 0;
    if (!feet)
        return tn_fail_memory(error);
    for (size_t v = 0; v < map->vertex_count; v++) {
        const double *p = map->positions + 3 * v;
        if (p[2] <= ground + GROUND * height)
            feet[count++] = (foot){p[0], p[1]};
    }
    qsort(feet, count, sizeof *feet, by_x);
    for (size_t v = 0; v < map->vertex_count; v++)
        span = tn_larger(span, distance_to_feet(feet, count, map->positions[3 * v], map->positions[3 * v + 1]));
    free(feet);
    put(fitness, TN_MEASURED_SPAN, span);
    return TN_OK;
}

/* ---- faults */

static tn_status measure_faults(const tn_growth *growth, tn_fitness *fitness, tn_error *error)
{
    tn_faults faults;
    tn_status status = tn_faults_find(growth, &faults, error);
    if (status != TN_OK)
        return status;
    put(fitness, TN_MEASURED_CROSSED_FACES, faults.crossed.count);
    put(fitness, TN_MEASURED_TURNED_FACES, faults.inverted.count);
    return TN_OK;
}

static tn_status measure_crossings(const tn_growth *growth, tn_fitness *fitness, tn_error *error)
{
    tn_mesh mesh;
    uint64_t count = 0;
    tn_status status = tn_surface_mesh(growth, &(tn_surface_options){0}, &mesh, error);
    if (status == TN_OK)
        status = tn_mesh_triangulate(&mesh, error);
    if (status == TN_OK)
        status = tn_mesh_crossings(&mesh, &count, error);
    tn_mesh_clear(&mesh);
    if (status == TN_OK)
        put(fitness, TN_MEASURED_CROSSINGS, (double)count);
    return status;
}

/* ---- light and likeness */

static void measure_distance(const tn_map *map, const tn_boundary_mesh *target, tn_fitness *fitness)
{
    double sum = 0;
    for (size_t v = 0; target && v < map->vertex_count; v++)
        sum += fabs(tn_boundary_mesh_distance(target, tn_vector_at(map->positions + 3 * v), NULL));
    put(fitness, TN_MEASURED_DISTANCE_TO, target ? sum / map->vertex_count : NAN);
}

static tn_status measure_light(const tn_growth *growth, tn_vector sun, tn_fitness *fitness, tn_error *error)
{
    double share = 0;
    tn_status status = sunlit_share(growth, sun, &share, error);
    put(fitness, TN_MEASURED_SUNLIT, share);
    return status;
}

tn_status tn_soundness_measure(const tn_growth *growth, const tn_measuring *with, uint64_t asked, tn_fitness *fitness,
                               tn_error *error)
{
    const tn_map *map = tn_growth_map(growth);
    tn_status status = TN_OK;
    double low[3];
    if (!is_asked(asked, TN_MEASURED_WIDTH, TN_MEASURED_DISTANCE_TO))
        return TN_OK;
    measure_extents(map, fitness, low);
    if (is_asked(asked, TN_MEASURED_AREA, TN_MEASURED_WORST_PLANARITY) ||
        is_asked(asked, TN_MEASURED_SMALLEST_ANGLE, TN_MEASURED_SMALLEST_ANGLE))
        measure_faces(map, low[2], fitness);
    if (is_asked(asked, TN_MEASURED_EDGE_SPREAD, TN_MEASURED_EDGE_SPREAD))
        measure_edges(map, fitness);
    if (is_asked(asked, TN_MEASURED_SPAN, TN_MEASURED_SPAN))
        status = measure_span(map, low[2], fitness, error);
    if (status == TN_OK && is_asked(asked, TN_MEASURED_CROSSED_FACES, TN_MEASURED_TURNED_FACES))
        status = measure_faults(growth, fitness, error);
    if (status == TN_OK && is_asked(asked, TN_MEASURED_CROSSINGS, TN_MEASURED_CROSSINGS))
        status = measure_crossings(growth, fitness, error);
    if (status == TN_OK && is_asked(asked, TN_MEASURED_SUNLIT, TN_MEASURED_SUNLIT))
        status = measure_light(growth, with->sun, fitness, error);
    if (is_asked(asked, TN_MEASURED_DISTANCE_TO, TN_MEASURED_DISTANCE_TO))
        measure_distance(map, with->target, fitness);
    return status;
}
