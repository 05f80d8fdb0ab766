/* Growing in size: every vertex moves away from the centre by the scale, and by the forces, as far as the boundaries
 * let it ("Genr8", 4.3 and 4.7). */
#include <stdatomic.h>
#include <stdlib.h>

#include "runtime/growth/pass/pass.h"

static uint32_t chunk_count(const tn_map *map)
{
    return (map->vertex_count + TN_CHUNK_VERTICES - 1) / TN_CHUNK_VERTICES;
}

static uint32_t chunk_end(const tn_map *map, uint32_t chunk)
{
    uint32_t begin = chunk * TN_CHUNK_VERTICES;
    return map->vertex_count - begin < TN_CHUNK_VERTICES ? map->vertex_count : begin + TN_CHUNK_VERTICES;
}

typedef struct summing {
    const tn_map *map;
    tn_vector *sums; /* [chunk] */
} summing;

static void sum_chunk(void *context, uint32_t chunk)
{
    const summing *s = context;
    tn_vector sum = {0, 0, 0};
    for (uint32_t v = chunk * TN_CHUNK_VERTICES, end = chunk_end(s->map, chunk); v < end; v++)
        sum = tn_add(sum, tn_vector_at(s->map->positions + 3 * (size_t)v));
    s->sums[chunk] = sum;
}

/* The mean of the vertices: sums of fixed stretches, added in order, so that it does not depend on threads. */
static tn_status mean(const tn_growth *growth, tn_vector *centre, tn_error *error)
{
    const tn_map *map = &growth->map;
    uint32_t chunks = chunk_count(map);
    summing s = {map, malloc(chunks * sizeof *s.sums)};
    if (!s.sums)
        return tn_fail_memory(error);
    tn_status status = tn_crew_share(growth->crew, chunks, sum_chunk, &s, error);
    tn_vector sum = {0, 0, 0};
    for (uint32_t c = 0; c < chunks && status == TN_OK; c++)
        sum = tn_add(sum, s.sums[c]);
    free(s.sums);
    *centre = tn_scale(sum, 1.0 / map->vertex_count);
    return status;
}

/* Which vertices are on the outline; NULL if none stays. */
static tn_status find_fixed(const tn_growth *growth, unsigned char **fixed, tn_error *error)
{
    const tn_map *map = &growth->map;
    *fixed = NULL;
    if (!growth->options.fixed_perimeter)
        return TN_OK;
    unsigned char *is = calloc(map->vertex_count, 1);
    if (!is)
        return tn_fail_memory(error);
    uint32_t first = map->face_first[TN_OUTER_FACE];
    for (uint32_t i = 0; i < tn_face_size(map, TN_OUTER_FACE); i++)
        is[map->origin[first + i]] = 1;
    *fixed = is;
    return TN_OK;
}

typedef struct outcome {
    bool finite, moved;
} outcome;

static outcome displace(const tn_growth *growth, double *position, tn_vector centre)
{
    const double *scale = growth->options.scale;
    tn_vector x = tn_vector_at(position), r = tn_sub(x, centre);
    tn_vector d = {(scale[0] - 1) * r.x, (scale[1] - 1) * r.y, (scale[2] - 1) * r.z};
    if (growth->environment->force_count)
        d = tn_add(d, tn_environment_force(growth->environment, x));
    tn_vector y = growth->hard ? tn_environment_move(growth->environment, x, d) : tn_add(x, d);
    tn_vector_put(position, y);
    return (outcome){isfinite(y.x + y.y + y.z), y.x != x.x || y.y != x.y || y.z != x.z};
}

typedef struct displacing {
    tn_growth *growth;
    tn_vector centre;
    const unsigned char *fixed; /* [vertex] or NULL */
    atomic_bool infinite, moved;
} displacing;

static void displace_chunk(void *context, uint32_t chunk)
{
    displacing *d = context;
    const tn_map *map = &d->growth->map;
    outcome all = {true, false};
    for (uint32_t v = chunk * TN_CHUNK_VERTICES, end = chunk_end(map, chunk); v < end; v++) {
        if (d->fixed && d->fixed[v])
            continue;
        outcome one = displace(d->growth, map->positions + 3 * (size_t)v, d->centre);
        all.finite = all.finite && one.finite;
        all.moved = all.moved || one.moved;
    }
    if (!all.finite)
        atomic_store(&d->infinite, true);
    if (all.moved)
        atomic_store(&d->moved, true);
}

tn_status tn_growth_displace(tn_growth *growth, tn_error *error)
{
    displacing d = {.growth = growth, .centre = tn_vector_at(growth->options.start)};
    unsigned char *fixed;
    tn_status status = TN_OK;
    if (!growth->options.fixed_centre)
        status = mean(growth, &d.centre, error);
    if (status == TN_OK)
        status = find_fixed(growth, &fixed, error);
    if (status != TN_OK)
        return status;
    d.fixed = fixed;
    status = tn_crew_share(growth->crew, chunk_count(&growth->map), displace_chunk, &d, error);
    free(fixed);
    if (status != TN_OK)
        return status;
    growth->moved = d.moved;
    if (d.infinite || !isfinite(growth->length)) {
        tn_fail(error, TN_LIMIT, E_GROWTH_COORDINATES, "in step %u a coordinate leaves the range of numbers",
                growth->steps + 1);
        tn_error_help(error, "take fewer steps, or a scale nearer to 1");
        return TN_LIMIT;
    }
    return TN_OK;
}
