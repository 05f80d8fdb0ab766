/* Measures whether a grown surface could be built. */
#include "runtime/growth/soundness.h"

#include <stdlib.h>

#include "runtime/geometry/boundary_mesh.h"
#include "runtime/geometry/crossing.h"
#include "runtime/geometry/vector.h"
#include "runtime/growth/faults.h"
#include "runtime/growth/sunlit.h"
#include "runtime/growth/surface.h"
#include "runtime/numeric/numeric.h"

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
    tn_status status = tn_sunlit_share(growth, sun, &share, error);
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
