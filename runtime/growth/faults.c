/* Counts faces that cross themselves or are turned over. */
#include "runtime/growth/faults.h"

#include <stdlib.h>

#include "runtime/base/crew.h"
#include "runtime/geometry/outline.h"
#include "runtime/geometry/vector.h"

#define FLAT 1e-12     /* of the squares of a face's extent: a smaller area is none */
#define AGAINST -0.866 /* cosine of 150 degrees */
#define CHUNK 1024u    /* faces that are looked at at a time */

/* What a thread found. */
typedef struct tally {
    tn_outline outline;
    uint32_t count, first; /* faces at fault, and the lowest of their edge sides */
} tally;

typedef struct search {
    const tn_map *map;
    const uint32_t *face_of; /* [edge side] */
    double (*normals)[3];    /* [face] twice its area long */
    tally *tallies;          /* [thread] */
    tn_crew *crew;
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

/* Keeps the face's normal. *crossed: does the outline cross itself, seen along it? A figure of eight has none: then
 * along its largest part's. False: out of memory. */
static bool find_crossed(const search *s, uint32_t face, tn_outline *outline, bool *crossed)
{
    const tn_map *map = s->map;
    uint32_t first = map->face_first[face], size = tn_face_size(map, face);
    tn_vector other, n = face_normal(map, face, &other);
    *crossed = false;
    tn_vector_put(s->normals[face], n);
    if (size < 4 || (size == 4 && is_convex(map, face, n)))
        return true;
    n = tn_normalised(tn_dot(n, n) > 0 ? n : other);
    if (tn_dot(n, n) == 0)
        return true;
    tn_vector x = tn_normalised(fabs(n.x) < 0.8 ? (tn_vector){0, n.z, -n.y} : (tn_vector){-n.z, 0, n.x});
    tn_vector y = tn_cross(n, x), start = corner(map, first);
    if (!tn_outline_reserve(outline, size))
        return false;
    for (uint32_t i = 0; i < size; i++) {
        tn_vector p = tn_sub(corner(map, first + i), start);
        outline->points[i][0] = tn_dot(p, x);
        outline->points[i][1] = tn_dot(p, y);
    }
    return tn_outline_crosses(outline, crossed);
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

static void add(const search *s, tally *found, uint32_t face)
{
    uint32_t side = lowest_side(s->map, face);
    found->count++;
    found->first = side < found->first ? side : found->first;
}

static uint32_t chunk_end(const search *s, size_t chunk)
{
    uint32_t faces = s->map->face_count, begin = (uint32_t)chunk * CHUNK;
    return faces - begin < CHUNK ? faces : begin + CHUNK;
}

static tn_status look_for_crossed(void *context, unsigned thread, size_t chunk, tn_error *error)
{
    const search *s = context;
    tally *found = &s->tallies[thread];
    for (uint32_t f = (uint32_t)chunk * CHUNK, end = chunk_end(s, chunk); f < end; f++) {
        bool crossed = false;
        if (f != TN_OUTER_FACE && !find_crossed(s, f, &found->outline, &crossed))
            return tn_fail_memory(error);
        if (crossed)
            add(s, found, f);
    }
    return TN_OK;
}

static tn_status look_for_inverted(void *context, unsigned thread, size_t chunk, tn_error *error)
{
    const search *s = context;
    (void)error;
    for (uint32_t f = (uint32_t)chunk * CHUNK, end = chunk_end(s, chunk); f < end; f++)
        if (f != TN_OUTER_FACE && is_inverted(s, f))
            add(s, &s->tallies[thread], f);
    return TN_OK;
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

/* Looks at all faces, and puts together what the threads found. */
static tn_status look(search *s, tn_crew_work *work, tn_fault *fault, tn_error *error)
{
    unsigned threads = tn_crew_threads(s->crew);
    uint32_t count = 0, first = UINT32_MAX;
    for (unsigned t = 0; t < threads; t++)
        s->tallies[t] = (tally){.outline = s->tallies[t].outline, .first = UINT32_MAX};
    tn_status status = tn_crew_run(s->crew, s->map->face_count / CHUNK + 1, 1, work, s, error);
    for (unsigned t = 0; t < threads; t++) {
        count += s->tallies[t].count;
        first = s->tallies[t].first < first ? s->tallies[t].first : first;
    }
    if (status == TN_OK)
        *fault = fault_at(s, count, first);
    return status;
}

static tn_status prepare(search *s, tn_watch *watch, tn_error *error)
{
    unsigned threads = tn_crew_threads(s->crew);
    s->normals = calloc(s->map->face_count, sizeof *s->normals);
    s->tallies = calloc(threads, sizeof *s->tallies);
    if (!s->normals || !s->tallies)
        return tn_fail_memory(error);
    for (unsigned t = 0; t < threads; t++)
        s->tallies[t].outline.watch = watch;
    return TN_OK;
}

tn_status tn_faults_find(const tn_growth *growth, tn_faults *faults, tn_error *error)
{
    const tn_growth_options *options = tn_growth_settings(growth);
    uint32_t *face_of = NULL;
    search s = {.map = tn_growth_map(growth),
                .crew = tn_crew_new(options->threads > 0 ? (unsigned)options->threads : 0, options->watch)};
    tn_status status = s.crew ? prepare(&s, options->watch, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_map_twins(s.map, NULL, &face_of, error);
    s.face_of = face_of;
    if (status == TN_OK)
        status = look(&s, look_for_crossed, &faults->crossed, error);
    if (status == TN_OK)
        status = look(&s, look_for_inverted, &faults->inverted, error);
    for (unsigned t = 0; s.tallies && t < tn_crew_threads(s.crew); t++)
        tn_outline_clear(&s.tallies[t].outline);
    tn_crew_free(s.crew);
    free(face_of);
    free(s.normals);
    free(s.tallies);
    return status;
}
