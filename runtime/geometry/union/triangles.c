/* From the polygons of a boundary to triangles: every vertex on an edge's line, between its ends, becomes a corner of
 * the polygon; then ears are cut off, none without area. */
#include <stdlib.h>
#include <string.h>

#include "runtime/geometry/union/grid.h"

enum { ROUNDS = 16, CAREFUL = 48 /* corners up to which the best ear is looked for */ };

/* What is known of a corner without an ear: as long as its neighbours stay, or only until another is cut off. */
#define NO_EAR (-1.0)
#define UNDECIDED (-2.0)

typedef struct outline {
    const tn_grid *grid;
    int u, v;    /* seen along the third axis */
    bool turned; /* clockwise there */
    uint32_t *ring;
    double *ears; /* of each corner: how round its ear is, NO_EAR or UNDECIDED */
    size_t count, capacity, ear_capacity;
    uint32_t *triangles;
    uint32_t *cells;
    size_t triangle_count, triangle_capacity, cell_capacity;
    bool failed;
} outline;

/* ---- the vertices of each line in order */

/* The axis along which it moves fastest. */
static int leading_axis(const tn_grid_line *line)
{
    if (line->kind < 3 || line->kind == TN_GRID_FREE)
        return (int)line->kind % 3;
    int u = ((int)line->kind - 3 + 1) % 3, v = ((int)line->kind - 3 + 2) % 3;
    int64_t a = line->a, b = line->b < 0 ? -line->b : line->b;
    return b >= a ? u : v;
}

/* Along the line: by the leading axis, then by the other as the line slopes. Rounding keeps this order. */
static int along(const tn_grid *grid, uint32_t line, uint32_t x, uint32_t y)
{
    const tn_grid_line *l = &grid->lines[line];
    const int64_t *p = grid->vertices[x].at, *q = grid->vertices[y].at;
    int lead = leading_axis(l);
    if (p[lead] != q[lead] || l->kind < 3 || l->kind == TN_GRID_FREE)
        return (p[lead] > q[lead]) - (p[lead] < q[lead]);
    int u = ((int)l->kind - 3 + 1) % 3, v = ((int)l->kind - 3 + 2) % 3, second = lead == u ? v : u;
    int rising = (l->a > 0) == (l->b > 0) ? -1 : 1;
    return rising * ((p[second] > q[second]) - (p[second] < q[second]));
}

/* Insertion for short lists, merging for long ones. */
static void sort_stops(const tn_grid *grid, tn_grid_stop *stops, tn_grid_stop *room, size_t count)
{
    if (count < 12) {
        for (size_t i = 1; i < count; i++)
            for (size_t k = i; k > 0 && along(grid, stops[k].line, stops[k].vertex, stops[k - 1].vertex) < 0; k--) {
                tn_grid_stop other = stops[k];
                stops[k] = stops[k - 1];
                stops[k - 1] = other;
            }
        return;
    }
    size_t half = count / 2, i = 0, k = half, at = 0;
    sort_stops(grid, stops, room, half);
    sort_stops(grid, stops + half, room, count - half);
    while (i < half && k < count)
        room[at++] = along(grid, stops[k].line, stops[k].vertex, stops[i].vertex) < 0 ? stops[k++] : stops[i++];
    while (i < half)
        room[at++] = stops[i++];
    while (k < count)
        room[at++] = stops[k++];
    memcpy(stops, room, count * sizeof *stops);
}

/* Each vertex of a line once: `last` says on which line a vertex was seen last. */
static size_t without_repeats(tn_grid_stop *stops, size_t count, uint32_t *last)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (last[stops[i].vertex] != stops[i].line) {
            last[stops[i].vertex] = stops[i].line;
            stops[kept++] = stops[i];
        }
    return kept;
}

/* Stops by their lines; first[l + 1] is where those of line l begin, and at the end where they end. */
static void stops_by_line(const tn_grid *grid, size_t *first, tn_grid_stop *sorted)
{
    for (size_t i = 0; i < grid->stop_count; i++)
        first[grid->stops[i].line + 2]++;
    for (size_t l = 0; l < grid->line_count; l++)
        first[l + 2] += first[l + 1];
    for (size_t i = 0; i < grid->stop_count; i++)
        sorted[first[grid->stops[i].line + 1]++] = grid->stops[i];
}

static bool gather_stops(tn_grid *grid)
{
    size_t *first = calloc(grid->line_count + 2, sizeof *first), kept = 0;
    uint32_t *last = malloc((grid->vertex_count + 1) * sizeof *last);
    tn_grid_stop *sorted = malloc((grid->stop_count + 1) * sizeof *sorted);
    tn_grid_stop *room = malloc((grid->stop_count + 1) * sizeof *room);
    bool made = first && last && sorted && room;
    if (made) {
        memset(last, 0xff, grid->vertex_count * sizeof *last);
        stops_by_line(grid, first, sorted);
        for (size_t l = 0; l < grid->line_count; l++) {
            size_t begin = first[l], count = without_repeats(sorted + begin, first[l + 1] - begin, last);
            sort_stops(grid, sorted + begin, room, count);
            memmove(sorted + kept, sorted + begin, count * sizeof *sorted);
            first[l] = kept;
            kept += count;
        }
        first[grid->line_count] = kept;
    }
    free(room);
    free(last);
    free(grid->line_stops);
    grid->line_stops = first;
    if (!made) {
        free(sorted);
        return false;
    }
    free(grid->stops);
    grid->stops = sorted;
    grid->stop_capacity = grid->stop_count + 1;
    grid->stop_count = kept;
    return true;
}

/* ---- outlines */

static int by_ends(const void *a, const void *b)
{
    const tn_grid_split *x = a, *y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    return x->high < y->high ? -1 : x->high > y->high;
}

static const tn_grid_split *split_of(const tn_grid *grid, uint32_t a, uint32_t b)
{
    const tn_grid_split wanted = {a < b ? a : b, a < b ? b : a, 0};
    if (grid->split_count == 0)
        return NULL;
    return bsearch(&wanted, grid->splits, grid->split_count, sizeof wanted, by_ends);
}

static void push(outline *o, uint32_t vertex)
{
    if (o->count > 0 && o->ring[o->count - 1] == vertex)
        return;
    if (o->failed || !tn_array_reserve(&o->ring, &o->capacity, o->count, 1, sizeof *o->ring))
        o->failed = true;
    else
        o->ring[o->count++] = vertex;
}

static size_t stop_of(const tn_grid *grid, uint32_t line, uint32_t vertex)
{
    size_t low = grid->line_stops[line], high = grid->line_stops[line + 1];
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (along(grid, line, grid->stops[middle].vertex, vertex) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static void push_edge(outline *o, uint32_t line, uint32_t from, uint32_t to)
{
    const tn_grid *grid = o->grid;
    push(o, from);
    if (from == to)
        return;
    size_t a = stop_of(grid, line, from), b = stop_of(grid, line, to);
    for (; a < b; a++)
        push(o, grid->stops[a].vertex);
    for (; a > b; a--)
        push(o, grid->stops[a].vertex);
}

/* Corners that go there and back again are left out. */
static void drop_spurs(outline *o)
{
    for (size_t k = 0; o->count >= 2 && k < o->count;) {
        size_t next = (k + 1) % o->count, after = (k + 2) % o->count;
        bool repeats = o->ring[k] == o->ring[next], returns = o->count > 2 && o->ring[k] == o->ring[after];
        if (!repeats && !returns) {
            k++;
            continue;
        }
        memmove(o->ring + next, o->ring + next + 1, (o->count - next - 1) * sizeof *o->ring);
        o->count--;
        k = 0;
    }
}

/* Edges that get a vertex in their middle; halves may get one again. */
static void insert_splits(outline *o)
{
    for (size_t k = 0; k < o->count && o->count >= 3 && o->grid->split_count && !o->failed;) {
        const tn_grid_split *split = split_of(o->grid, o->ring[k], o->ring[(k + 1) % o->count]);
        if (!split) {
            k++;
        } else if (!tn_array_reserve(&o->ring, &o->capacity, o->count, 1, sizeof *o->ring)) {
            o->failed = true;
        } else {
            memmove(o->ring + k + 2, o->ring + k + 1, (o->count - k - 1) * sizeof *o->ring);
            o->ring[k + 1] = split->middle;
            o->count++;
        }
    }
}

static tn_int128 area_twice(const outline *o, uint32_t a, uint32_t b, uint32_t c)
{
    const int64_t *p = o->grid->vertices[a].at, *q = o->grid->vertices[b].at, *r = o->grid->vertices[c].at;
    tn_int128 area =
        (tn_int128)(q[o->u] - p[o->u]) * (r[o->v] - p[o->v]) - (tn_int128)(q[o->v] - p[o->v]) * (r[o->u] - p[o->u]);
    return o->turned ? -area : area;
}

static void face_cap(outline *o)
{
    double n[3] = {0, 0, 0};
    const int64_t *z = o->grid->vertices[o->ring[0]].at;
    for (size_t i = 1; i + 1 < o->count; i++) {
        const int64_t *p = o->grid->vertices[o->ring[i]].at, *q = o->grid->vertices[o->ring[i + 1]].at;
        for (int k = 0; k < 3; k++) {
            int u = (k + 1) % 3, v = (k + 2) % 3;
            n[k] += (double)(p[u] - z[u]) * (double)(q[v] - z[v]) - (double)(p[v] - z[v]) * (double)(q[u] - z[u]);
        }
    }
    int most = 0;
    for (int k = 1; k < 3; k++)
        most = fabs(n[k]) > fabs(n[most]) ? k : most;
    o->u = (most + 1) % 3;
    o->v = (most + 2) % 3;
    o->turned = n[most] < 0;
}

static void trace(outline *o, const tn_ring *ring)
{
    const tn_grid *grid = o->grid;
    const tn_ring_corner *corners = grid->corners + ring->first;
    o->count = 0;
    for (uint32_t k = 0; k < ring->count; k++)
        push_edge(o, corners[k].line, corners[k].point.vertex, corners[(k + 1) % ring->count].point.vertex);
    if (o->count > 1 && o->ring[o->count - 1] == o->ring[0])
        o->count--;
    drop_spurs(o);
    insert_splits(o);
    o->turned = false;
    if (ring->face != TN_CUT_BOX_CAP) {
        o->u = ((int)ring->face / 2 + 1) % 3;
        o->v = ((int)ring->face / 2 + 2) % 3;
    } else if (o->count >= 3) {
        face_cap(o);
    }
}

/* ---- ears */

static int64_t least(int64_t a, int64_t b, int64_t c)
{
    int64_t least = a < b ? a : b;
    return c < least ? c : least;
}

static int64_t most(int64_t a, int64_t b, int64_t c)
{
    int64_t most = a > b ? a : b;
    return c > most ? c : most;
}

static bool holds_other(const outline *o, size_t a, size_t b, size_t c)
{
    const tn_grid_vertex *vertices = o->grid->vertices;
    uint32_t p = o->ring[a], q = o->ring[b], r = o->ring[c];
    const int64_t *at_p = vertices[p].at, *at_q = vertices[q].at, *at_r = vertices[r].at;
    int64_t low_u = least(at_p[o->u], at_q[o->u], at_r[o->u]), high_u = most(at_p[o->u], at_q[o->u], at_r[o->u]);
    int64_t low_v = least(at_p[o->v], at_q[o->v], at_r[o->v]), high_v = most(at_p[o->v], at_q[o->v], at_r[o->v]);
    for (size_t k = 0; k < o->count; k++) {
        uint32_t x = o->ring[k];
        int64_t u = vertices[x].at[o->u], v = vertices[x].at[o->v];
        if (u < low_u || u > high_u || v < low_v || v > high_v || x == p || x == q || x == r)
            continue;
        if (area_twice(o, p, q, x) >= 0 && area_twice(o, q, r, x) >= 0 && area_twice(o, r, p, x) >= 0)
            return true;
    }
    return false;
}

static double length_square(const outline *o, uint32_t a, uint32_t b)
{
    const int64_t *p = o->grid->vertices[a].at, *q = o->grid->vertices[b].at;
    double du = (double)(p[o->u] - q[o->u]), dv = (double)(p[o->v] - q[o->v]);
    return du * du + dv * dv;
}

/* How far a triangle of an area is from being a line: the square of the sine of its smallest angle. */
static double roundness(const outline *o, tn_int128 twice, uint32_t a, uint32_t b, uint32_t c)
{
    double area = (double)twice, x = length_square(o, a, b), y = length_square(o, b, c), z = length_square(o, c, a);
    double least = fmin(x, fmin(y, z));
    return area * area / (x * y * z / least);
}

/* An edge that is to be split is no diagonal: only outlines are split. */
static double judge_ear(const outline *o, size_t k)
{
    size_t before = k ? k - 1 : o->count - 1, after = k + 1 < o->count ? k + 1 : 0;
    uint32_t a = o->ring[before], b = o->ring[k], c = o->ring[after];
    tn_int128 area = area_twice(o, a, b, c);
    if (area <= 0)
        return NO_EAR;
    if (holds_other(o, before, k, after) || (o->count > 3 && split_of(o->grid, a, c)))
        return UNDECIDED;
    return roundness(o, area, a, b, c);
}

/* The next ear from a corner on; among few corners the roundest. o->count where there is none. */
static size_t find_ear(outline *o, size_t from)
{
    size_t best = o->count;
    double most = -1;
    for (size_t i = 0, k = from; i < o->count; i++, k = k + 1 < o->count ? k + 1 : 0) {
        if (o->ears[k] == UNDECIDED)
            o->ears[k] = judge_ear(o, k);
        if (o->ears[k] < 0)
            continue;
        if (o->count > CAREFUL)
            return k;
        if (o->ears[k] > most) {
            most = o->ears[k];
            best = k;
        }
    }
    return best;
}

static void cut_ear(outline *o, size_t ear)
{
    size_t behind = o->count - ear - 1;
    memmove(o->ring + ear, o->ring + ear + 1, behind * sizeof *o->ring);
    memmove(o->ears + ear, o->ears + ear + 1, behind * sizeof *o->ears);
    o->count--;
    o->ears[ear ? ear - 1 : o->count - 1] = UNDECIDED;
    o->ears[ear < o->count ? ear : 0] = UNDECIDED;
}

static void add_triangle(outline *o, uint32_t cell, bool turn, uint32_t a, uint32_t b, uint32_t c)
{
    if (o->failed ||
        !tn_array_reserve(&o->triangles, &o->triangle_capacity, 3 * o->triangle_count, 3, sizeof *o->triangles) ||
        !tn_array_reserve(&o->cells, &o->cell_capacity, o->triangle_count, 1, sizeof *o->cells)) {
        o->failed = true;
        return;
    }
    uint32_t *t = o->triangles + 3 * o->triangle_count;
    t[0] = a;
    t[1] = turn ? c : b;
    t[2] = turn ? b : c;
    o->cells[o->triangle_count++] = cell;
}

/* False if no ear with area is left, though corners are. */
static bool cut_ears(outline *o, const tn_ring *ring)
{
    bool turn = ring->face != TN_CUT_BOX_CAP && ring->face % 2 == 0;
    size_t at = 0;
    if (!tn_array_reserve(&o->ears, &o->ear_capacity, 0, o->count, sizeof *o->ears)) {
        o->failed = true;
        return false;
    }
    for (size_t k = 0; k < o->count; k++)
        o->ears[k] = UNDECIDED;
    while (o->count >= 3) {
        size_t ear = find_ear(o, at);
        if (ear == o->count)
            return false;
        size_t before = (ear + o->count - 1) % o->count, after = (ear + 1) % o->count;
        add_triangle(o, ring->cell, turn, o->ring[before], o->ring[ear], o->ring[after]);
        cut_ear(o, ear);
        at = o->count ? (ear + 1) % o->count : 0;
        if (o->count == 2)
            break;
    }
    return true;
}

static bool is_line(const outline *o)
{
    for (size_t i = 1; i + 1 < o->count; i++)
        if (area_twice(o, o->ring[0], o->ring[i], o->ring[i + 1]) != 0)
            return false;
    return true;
}

/* A polygon that rounding made a line: its corners lie on its longest edge, and become corners of what is beside it. */
static void fold(tn_grid *grid, const tn_ring *ring)
{
    const tn_ring_corner *corners = grid->corners + ring->first;
    uint32_t longest = 0;
    double most = -1;
    for (uint32_t k = 0; k < ring->count; k++) {
        const int64_t *p = grid->vertices[corners[k].point.vertex].at,
                      *q = grid->vertices[corners[(k + 1) % ring->count].point.vertex].at;
        double length = 0;
        for (int axis = 0; axis < 3; axis++)
            length += fabs((double)(p[axis] - q[axis]));
        if (length > most) {
            most = length;
            longest = k;
        }
    }
    for (uint32_t k = 0; k < ring->count; k++)
        tn_grid_stop_at(grid, grid->corners[ring->first + longest].line, grid->corners[ring->first + k].point.vertex);
}

/* Traces all outlines and cuts them up, unless one turns out to be a line: those are folded, which changes outlines
 * beside them, and all are to be traced once more. */
static bool cut_all(tn_grid *grid, outline *o, bool *stuck)
{
    bool settled = true;
    o->triangle_count = 0;
    *stuck = false;
    for (size_t r = 0; r < grid->ring_count && !o->failed; r++) {
        trace(o, &grid->rings[r]);
        if (o->count < 3)
            continue;
        if (is_line(o)) {
            fold(grid, &grid->rings[r]);
            settled = false;
        } else if (settled && !*stuck) {
            *stuck = !cut_ears(o, &grid->rings[r]);
        }
    }
    return settled;
}

tn_status tn_grid_triangles(tn_grid *grid, tn_mesh *mesh, tn_error *error)
{
    outline o = {.grid = grid};
    bool done = false, stuck = false;
    tn_status status = TN_OK;
    if (grid->split_count)
        qsort(grid->splits, grid->split_count, sizeof *grid->splits, by_ends);
    for (int round = 0; round < ROUNDS && !done && status == TN_OK; round++) {
        if (grid->failed || !gather_stops(grid))
            o.failed = true;
        else
            done = cut_all(grid, &o, &stuck);
        if (o.failed)
            status = tn_fail_memory(error);
    }
    if (status == TN_OK && (!done || stuck))
        status = tn_union_too_fine(error);
    free(o.ring);
    free(o.ears);
    if (status != TN_OK) {
        free(o.triangles);
        free(o.cells);
        return status;
    }
    mesh->corners = o.triangles;
    mesh->face_group = o.cells;
    mesh->face_count = o.triangle_count;
    return TN_OK;
}
