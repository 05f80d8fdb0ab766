#include "runtime/growth/faults.h"

#include <stdlib.h>

#include "runtime/base/share.h"
#include "runtime/base/watch.h"
#include "runtime/geometry/outline.h"
#include "runtime/geometry/vector.h"

#define FLAT 1e-12     /* of the squares of a face's extent: a smaller area is none */
#define AGAINST -0.866 /* cosine of 150 degrees */
#define CHUNK 1024

typedef struct search {
    const tn_map *map;
    const uint32_t *face_of; /* [edge side] */
    double (*normals)[3];    /* [face] twice its area long */
    uint32_t crossed, inverted;
    uint32_t first_crossed, first_inverted; /* each one's lowest edge side */
    bool out_of_memory;
    tn_watch *watch; /* or NULL */
} search;

static tn_vector corner(const tn_map *map, uint32_t dart)
{
    return tn_vector_at(map->positions + 3 * (size_t)map->origin[dart]);
}

/* Newell's normal, twice the area long; zero where rounding would decide it. */
static tn_vector face_normal(const tn_map *map, uint32_t face, tn_vector *other)
{
    uint32_t first = map->face_first[face], end = map->face_first[face + 1];
    tn_vector start = corner(map, first), before = {0, 0, 0}, n = {0, 0, 0};
    double span = 0, largest = 0;
    *other = n;
    for (uint32_t d = first + 1; d < end; d++) {
        tn_vector p = tn_sub(corner(map, d), start), part = tn_cross(before, p);
        n = tn_add(n, part);
        span += tn_dot(p, p);
        if (tn_dot(part, part) > largest) {
            largest = tn_dot(part, part);
            *other = part;
        }
        before = p;
    }
    if (!(largest > FLAT * FLAT * span * span))
        *other = (tn_vector){0, 0, 0};
    return tn_dot(n, n) > FLAT * FLAT * span * span ? n : (tn_vector){0, 0, 0};
}

/* Does the outline turn the same way at every corner, as seen along its normal? With four corners it is simple then, as
 * nearly all faces are: a figure of eight turns both ways. */
static bool is_convex(const tn_map *map, uint32_t face, tn_vector n)
{
    uint32_t first = map->face_first[face], size = tn_face_size(map, face);
    tn_vector p[4];
    for (uint32_t i = 0; i < size; i++)
        p[i] = corner(map, first + i);
    for (uint32_t i = 0; i < size; i++) {
        tn_vector in = tn_sub(p[i], p[(i + size - 1) % size]), out = tn_sub(p[(i + 1) % size], p[i]);
        if (tn_dot(tn_cross(in, out), n) <= 0)
            return false;
    }
    return true;
}

static void fail(search *s)
{
#pragma omp atomic write
    s->out_of_memory = true;
}

/* Keeps the face's normal. Does the outline cross itself, seen along it? A figure of eight has none: then along its
 * largest part's. */
static bool is_crossed(search *s, uint32_t face, tn_outline *outline)
{
    const tn_map *map = s->map;
    uint32_t first = map->face_first[face], size = tn_face_size(map, face);
    tn_vector other, n = face_normal(map, face, &other);
    tn_vector_put(s->normals[face], n);
    if (size < 4 || (size == 4 && is_convex(map, face, n)))
        return false;
    n = tn_normalised(tn_dot(n, n) > 0 ? n : other);
    if (tn_dot(n, n) == 0)
        return false;
    tn_vector x = tn_normalised(fabs(n.x) < 0.8 ? (tn_vector){0, n.z, -n.y} : (tn_vector){-n.z, 0, n.x});
    tn_vector y = tn_cross(n, x), start = corner(map, first);
    bool crossed = false;
    if (!tn_outline_reserve(outline, size)) {
        fail(s);
        return false;
    }
    for (uint32_t i = 0; i < size; i++) {
        tn_vector p = tn_sub(corner(map, first + i), start);
        outline->points[i][0] = tn_dot(p, x);
        outline->points[i][1] = tn_dot(p, y);
    }
    if (!tn_outline_crosses(outline, &crossed))
        fail(s);
    return crossed;
}

static bool is_inverted(const search *s, uint32_t face)
{
    const tn_map *map = s->map;
    tn_vector n = tn_vector_at(s->normals[face]), around = {0, 0, 0};
    for (uint32_t d = map->face_first[face]; d < map->face_first[face + 1]; d++) {
        uint32_t beyond = s->face_of[map->side[d] ^ 1];
        if (beyond != TN_OUTER_FACE)
            around = tn_add(around, tn_vector_at(s->normals[beyond]));
    }
    return tn_dot(n, around) < AGAINST * tn_norm(n) * tn_norm(around);
}

/* A face's place in the order in which faces are written. */
static uint32_t lowest_side(const tn_map *map, uint32_t face)
{
    uint32_t lowest = UINT32_MAX;
    for (uint32_t d = map->face_first[face]; d < map->face_first[face + 1]; d++)
        lowest = map->side[d] < lowest ? map->side[d] : lowest;
    return lowest;
}

static void look_for_crossed(search *s, int threads)
{
    uint32_t count = 0, first = UINT32_MAX;
#pragma omp parallel num_threads(threads) if (s->map->face_count > CHUNK)
    {
        tn_outline outline = {.watch = s->watch};
#pragma omp for schedule(static, CHUNK) reduction(+ : count) reduction(min : first)
        for (uint32_t f = TN_OUTER_FACE + 1; f < s->map->face_count; f++) {
            if (tn_watch_stopped(s->watch) || !is_crossed(s, f, &outline))
                continue;
            count++;
            uint32_t side = lowest_side(s->map, f);
            first = side < first ? side : first;
        }
        tn_outline_clear(&outline);
    }
    s->crossed = count;
    s->first_crossed = first;
}

static void look_for_inverted(search *s, int threads)
{
    uint32_t count = 0, first = UINT32_MAX;
#pragma omp parallel for num_threads(threads) schedule(static, CHUNK) reduction(+ : count) reduction(min : first)     \
    if (s->map->face_count > CHUNK)
    for (uint32_t f = TN_OUTER_FACE + 1; f < s->map->face_count; f++) {
        if (tn_watch_stopped(s->watch) || !is_inverted(s, f))
            continue;
        count++;
        uint32_t side = lowest_side(s->map, f);
        first = side < first ? side : first;
    }
    s->inverted = count;
    s->first_inverted = first;
}

static tn_fault fault_at(const search *s, uint32_t count, uint32_t side)
{
    const tn_map *map = s->map;
    tn_fault fault = {.count = count};
    if (count == 0)
        return fault;
    uint32_t face = s->face_of[side];
    for (uint32_t d = map->face_first[face]; d < map->face_first[face + 1]; d++)
        for (int k = 0; k < 3; k++)
            fault.place[k] += map->positions[3 * (size_t)map->origin[d] + (size_t)k] / tn_face_size(map, face);
    return fault;
}

tn_status tn_faults_find(const tn_growth *growth, tn_faults *faults, tn_error *error)
{
    const tn_map *map = tn_growth_map(growth);
    int wanted = tn_growth_settings(growth)->threads, threads = wanted > 0 ? wanted : tn_thread_count();
    uint32_t *face_of = NULL;
    tn_watch *watch = tn_growth_settings(growth)->watch;
    search s = {.map = map, .watch = watch, .normals = calloc(map->face_count, sizeof *s.normals)};
    tn_status status = s.normals ? tn_map_twins(map, NULL, &face_of, error) : tn_fail_memory(error);
    if (status == TN_OK) {
        s.face_of = face_of;
        look_for_crossed(&s, threads);
        if (s.out_of_memory)
            status = tn_fail_memory(error);
    }
    if (status == TN_OK) {
        look_for_inverted(&s, threads);
        if (tn_watch_stopped(watch))
            status = tn_fail_stopped(error);
    }
    if (status == TN_OK) {
        faults->crossed = fault_at(&s, s.crossed, s.first_crossed);
        faults->inverted = fault_at(&s, s.inverted, s.first_inverted);
    }
    free(face_of);
    free(s.normals);
    return status;
}
