/* Points and lines counted in steps, and what is decided of them: exactly, in 128 and 256 bits. */
#include <stdlib.h>
#include <string.h>

#include "runtime/geometry/union/grid.h"

enum { NEAR = 4 }; /* steps: crossings were seen to be two apart */

void tn_grid_clear(tn_grid *grid)
{
    free(grid->vertices);
    tn_hash_clear(&grid->vertex_index);
    free(grid->lines);
    tn_hash_clear(&grid->line_index);
    free(grid->stops);
    free(grid->line_stops);
    free(grid->corners);
    free(grid->rings);
    free(grid->splits);
    *grid = (tn_grid){0};
}

tn_status tn_union_too_fine(tn_error *error)
{
    return tn_fail(error, TN_LIMIT, E_SOLID_TOO_FINE,
                   "some details are so small against the whole that they cannot be meshed");
}

bool tn_grid_room(tn_grid *grid, void *items, size_t size, size_t count, size_t *capacity)
{
    grid->failed = grid->failed || count >= TN_NOTHING - 1 || !tn_array_reserve(items, capacity, count, 1, size);
    return !grid->failed;
}

/* ---- numbers of vertices and lines */

static uint64_t mix(uint64_t hash, uint64_t value)
{
    hash = (hash ^ value) * UINT64_C(0x9e3779b97f4a7c15);
    return hash ^ hash >> 29;
}

static uint64_t hash_vertex(const tn_grid_vertex *v)
{
    return mix(mix(mix(1, (uint64_t)v->at[0]), (uint64_t)v->at[1]), (uint64_t)v->at[2]);
}

static uint64_t hash_line(const tn_grid_line *l)
{
    uint64_t hash = mix(mix(mix(l->kind, (uint64_t)l->p), (uint64_t)l->q), (uint64_t)l->a);
    return mix(mix(mix(hash, (uint64_t)l->b), (uint64_t)l->c), (uint64_t)(l->c >> 64));
}

static bool same_line(const tn_grid_line *x, const tn_grid_line *y)
{
    return x->kind == y->kind && x->p == y->p && x->q == y->q && x->a == y->a && x->b == y->b && x->c == y->c;
}

typedef struct wanted_vertex {
    const tn_grid *grid;
    tn_grid_vertex vertex;
} wanted_vertex;

static bool is_vertex(const void *context, uint32_t number)
{
    const wanted_vertex *w = context;
    return memcmp(&w->grid->vertices[number], &w->vertex, sizeof w->vertex) == 0;
}

typedef struct wanted_line {
    const tn_grid *grid;
    tn_grid_line line;
} wanted_line;

static bool is_line(const void *context, uint32_t number)
{
    const wanted_line *w = context;
    return same_line(&w->grid->lines[number], &w->line);
}

uint32_t tn_grid_vertex_of(tn_grid *grid, const int64_t at[3])
{
    wanted_vertex wanted = {grid, {{at[0], at[1], at[2]}}};
    uint32_t number = (uint32_t)grid->vertex_count;
    if (!tn_grid_room(grid, &grid->vertices, sizeof wanted.vertex, grid->vertex_count, &grid->vertex_capacity))
        return 0;
    grid->failed =
        tn_hash_enter(&grid->vertex_index, hash_vertex(&wanted.vertex), is_vertex, &wanted, &number, NULL) != TN_OK;
    if (!grid->failed && number == grid->vertex_count)
        grid->vertices[grid->vertex_count++] = wanted.vertex;
    return grid->failed ? 0 : number;
}

static uint32_t line_of(tn_grid *grid, tn_grid_line line)
{
    wanted_line wanted = {grid, line};
    uint32_t number = (uint32_t)grid->line_count;
    if (!tn_grid_room(grid, &grid->lines, sizeof line, grid->line_count, &grid->line_capacity))
        return 0;
    grid->failed = tn_hash_enter(&grid->line_index, hash_line(&line), is_line, &wanted, &number, NULL) != TN_OK;
    if (!grid->failed && number == grid->line_count)
        grid->lines[grid->line_count++] = line;
    return grid->failed ? 0 : number;
}

/* ---- lines */

static int64_t divisor_of(int64_t a, int64_t b)
{
    a = a < 0 ? -a : a;
    b = b < 0 ? -b : b;
    while (b) {
        int64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* Two vertices that differ in one coordinate, or in two where an edge of a cell lies in a face of its box. */
uint32_t tn_grid_line_through(tn_grid *grid, uint32_t from, uint32_t to)
{
    if (grid->failed)
        return 0;
    const int64_t *p = grid->vertices[from].at, *q = grid->vertices[to].at;
    int differ = 0, along = 0, level = 0;
    for (int k = 0; k < 3; k++) {
        differ += p[k] != q[k];
        along = p[k] != q[k] ? k : along;
        level = p[k] == q[k] ? k : level;
    }
    if (differ == 1)
        return line_of(grid,
                       (tn_grid_line){.kind = (uint32_t)along, .p = p[along == 0 ? 1 : 0], .q = p[along == 2 ? 1 : 2]});
    if (differ == 3)
        return line_of(
            grid, (tn_grid_line){.kind = TN_GRID_FREE, .p = from < to ? from : to, .q = from < to ? to : from});
    int u = (level + 1) % 3, v = (level + 2) % 3;
    int64_t a = p[v] - q[v], b = q[u] - p[u], divisor = divisor_of(a, b);
    if (a < 0 || (a == 0 && b < 0))
        divisor = -divisor;
    a /= divisor;
    b /= divisor;
    return line_of(grid, (tn_grid_line){.kind = 3u + (uint32_t)level,
                                        .p = p[level],
                                        .a = a,
                                        .b = b,
                                        .c = (tn_int128)a * p[u] + (tn_int128)b * p[v]});
}

void tn_grid_stop_at(tn_grid *grid, uint32_t line, uint32_t vertex)
{
    if (tn_grid_room(grid, &grid->stops, sizeof *grid->stops, grid->stop_count, &grid->stop_capacity))
        grid->stops[grid->stop_count++] = (tn_grid_stop){line, vertex};
}

/* a * u + b * v = c in the plane across the axis. */
static tn_grid_line in_plane(const tn_grid *grid, int axis, uint32_t line)
{
    tn_grid_line l = grid->lines[line];
    if (l.kind >= 3)
        return l;
    int u = (axis + 1) % 3, v = (axis + 2) % 3, fixed = (int)l.kind == u ? v : u;
    int first = l.kind == 0 ? 1 : 0; /* the axis that p is of */
    l.a = fixed == u;
    l.b = fixed == v;
    l.c = fixed == first ? l.p : l.q;
    return l;
}

int tn_grid_inside(const tn_grid *grid, int axis, uint32_t line, uint32_t from, uint32_t to)
{
    tn_grid_line l = in_plane(grid, axis, line);
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int64_t *p = grid->vertices[from].at, *q = grid->vertices[to].at;
    int64_t a = p[v] - q[v], b = q[u] - p[u]; /* grows to the left */
    return l.a ? ((a > 0) == (l.a > 0) ? 1 : -1) : ((b > 0) == (l.b > 0) ? 1 : -1);
}

static int sign_of(tn_int128 value)
{
    return (value > 0) - (value < 0);
}

/* Is the point where its vertex is, not rounded? A corner is, and so is where two lines along axes cross. */
static bool is_whole(const tn_grid *grid, const tn_grid_point *point)
{
    return point->one == TN_NOTHING || (grid->lines[point->one].kind < 3 && grid->lines[point->other].kind < 3);
}

/* The side of a vertex. A line along an axis, as nearly all are where walls are upright, needs one comparison. */
static int side_of_vertex(const tn_grid *grid, int axis, uint32_t line, const int64_t at[3])
{
    const tn_grid_line *l = &grid->lines[line];
    if (l->kind >= 3)
        return sign_of((tn_int128)l->a * at[(axis + 1) % 3] + (tn_int128)l->b * at[(axis + 2) % 3] - l->c);
    int fixed = 3 - axis - (int)l->kind;
    int64_t coordinate = fixed == (l->kind == 0 ? 1 : 0) ? l->p : l->q; /* p is of the first of the other axes */
    return (at[fixed] > coordinate) - (at[fixed] < coordinate);
}

int tn_grid_side(const tn_grid *grid, int axis, uint32_t line, const tn_grid_point *point)
{
    if (line == point->one || line == point->other)
        return 0;
    if (is_whole(grid, point))
        return side_of_vertex(grid, axis, line, grid->vertices[point->vertex].at);
    tn_grid_line l = in_plane(grid, axis, line);
    tn_grid_line m = in_plane(grid, axis, point->one), n = in_plane(grid, axis, point->other);
    tn_int128 w = (tn_int128)m.a * n.b - (tn_int128)n.a * m.b;
    tn_wide x = tn_wide_subtract(tn_wide_product(m.c, n.b), tn_wide_product(n.c, m.b));
    tn_wide y = tn_wide_subtract(tn_wide_product(n.c, m.a), tn_wide_product(m.c, n.a));
    tn_wide value = tn_wide_add(tn_wide_multiply(x, tn_wide_of(l.a)), tn_wide_multiply(y, tn_wide_of(l.b)));
    return tn_wide_sign(tn_wide_subtract(value, tn_wide_product(l.c, w))) * sign_of(w);
}

/* ---- where lines cross */

/* numerator / denominator to the nearest whole number, a half upward; the denominator is above 0. */
static int64_t nearest(tn_wide numerator, tn_int128 denominator)
{
    bool exact;
    tn_wide d = tn_wide_of(2 * denominator);
    tn_wide n = tn_wide_add(tn_wide_add(numerator, numerator), tn_wide_of(denominator));
    if (tn_wide_sign(n) >= 0)
        return (int64_t)tn_wide_quotient(n, d, &exact);
    int64_t below = (int64_t)tn_wide_quotient(tn_wide_negate(n), d, &exact);
    return -below - !exact;
}

static int64_t nearest_small(tn_int128 numerator, tn_int128 denominator)
{
    tn_int128 n = 2 * numerator + denominator, d = 2 * denominator, quotient = n / d;
    return (int64_t)(quotient - (n % d < 0));
}

/* Moves a crossing to the nearest vertex of the plane that is at most NEAR steps away, if there is one. Lines that were
 * one before their ends were rounded cross a third side by side; at a thin corner those crossings would change places.
 */
static void move_to_near(const tn_grid *grid, int u, int v, int64_t at[3])
{
    int64_t nearest_square = INT64_MAX;
    wanted_vertex one = {grid, {{at[0], at[1], at[2]}}};
    tn_grid_vertex best = one.vertex;
    for (int64_t du = -NEAR; du <= NEAR && grid->vertex_count; du++)
        for (int64_t dv = -NEAR; dv <= NEAR; dv++) {
            one.vertex.at[u] = at[u] + du;
            one.vertex.at[v] = at[v] + dv;
            bool nearer = du * du + dv * dv < nearest_square;
            if (!nearer || tn_hash_find(&grid->vertex_index, hash_vertex(&one.vertex), is_vertex, &one) == TN_HASH_NONE)
                continue;
            nearest_square = du * du + dv * dv;
            best = one.vertex;
        }
    memcpy(at, best.at, sizeof best.at);
}

tn_grid_point tn_grid_crossing(tn_grid *grid, int axis, int64_t w, uint32_t one, uint32_t other)
{
    if (grid->failed)
        return (tn_grid_point){0, one, other};
    tn_grid_line m = in_plane(grid, axis, one), n = in_plane(grid, axis, other);
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    int64_t at[3];
    at[axis] = w;
    if (n.kind < 3) {
        tn_grid_line swapped = m;
        m = n;
        n = swapped;
    }
    tn_int128 det = (tn_int128)m.a * n.b - (tn_int128)n.a * m.b;
    int64_t turn = det < 0 ? -1 : 1;
    if (m.kind < 3 && m.a) { /* u is known */
        at[u] = (int64_t)m.c;
        at[v] = nearest_small(turn * (n.c - n.a * m.c), turn * (tn_int128)n.b);
    } else if (m.kind < 3) {
        at[v] = (int64_t)m.c;
        at[u] = nearest_small(-turn * (n.c - n.b * m.c), -turn * (tn_int128)n.a);
    } else {
        tn_wide x = tn_wide_subtract(tn_wide_product(m.c, n.b), tn_wide_product(n.c, m.b));
        tn_wide y = tn_wide_subtract(tn_wide_product(n.c, m.a), tn_wide_product(m.c, n.a));
        at[u] = nearest(turn < 0 ? tn_wide_negate(x) : x, turn * det);
        at[v] = nearest(turn < 0 ? tn_wide_negate(y) : y, turn * det);
    }
    if (grid->merging)
        move_to_near(grid, u, v, at);
    tn_grid_point point = {tn_grid_vertex_of(grid, at), one, other};
    tn_grid_stop_at(grid, one, point.vertex);
    tn_grid_stop_at(grid, other, point.vertex);
    return point;
}

void tn_grid_add_ring(tn_grid *grid, const tn_ring_corner *corners, uint32_t count, uint32_t cell, uint32_t face)
{
    if (!tn_grid_room(grid, &grid->rings, sizeof *grid->rings, grid->ring_count, &grid->ring_capacity))
        return;
    grid->rings[grid->ring_count++] = (tn_ring){(uint32_t)grid->corner_count, count, cell, face};
    for (uint32_t i = 0; i < count; i++) {
        if (!tn_grid_room(grid, &grid->corners, sizeof *grid->corners, grid->corner_count, &grid->corner_capacity))
            return;
        grid->corners[grid->corner_count++] = corners[i];
    }
}
