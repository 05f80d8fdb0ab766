/* Plane by plane: the faces that look to the high side less those that look to the low side against them, and the other
 * way round. Faces of one kind do not overlap, since boxes do not.
 *
 * Faces are convex. One is taken from another by cutting off, edge by edge, what lies outside the edge; so pieces stay
 * convex, and each of their corners is a corner of a face or where two lines of faces cross. */
#include <stdlib.h>
#include <string.h>

#include "runtime/geometry/select_nth.h"
#include "runtime/geometry/union/box_tree.h"
#include "runtime/geometry/union/grid.h"

enum {
    CUT_MAX = 4096, /* corners of a piece: each cut adds one, and a face has few edges */
    FEW = 32,       /* faces that are taken from a piece one by one; of more, the piece is halved */
    DEPTH = 48      /* of halving; about twice what even halves need */
};

/* A face in a plane. */
typedef struct flat {
    int64_t w; /* of the plane */
    uint32_t axis, cell;
    bool high; /* its outside is the high side */
    int64_t low_u, high_u, low_v, high_v;
    uint32_t first, count; /* corners, counter-clockwise in the plane's u and v */
} flat;

typedef struct piece {
    uint32_t first, count;
} piece;

typedef struct planes {
    tn_grid *grid;
    flat *flats;
    size_t flat_count, flat_capacity;
    tn_ring_corner *corners; /* of flats */
    size_t corner_count, corner_capacity;
    /* pieces of the face at hand */
    tn_ring_corner *cut;
    size_t cut_count, cut_capacity;
    piece *pieces, *left;
    size_t piece_count, piece_capacity, left_count, left_capacity;
    tn_box_hits hits; /* faces of the other side that may lie against what is at hand; a stack of lists */
} planes;

static bool room(planes *p, void *items, size_t size, size_t count, size_t *capacity)
{
    return tn_grid_room(p->grid, items, size, count, capacity);
}

/* ---- faces of cells */

static int64_t steps(const tn_grid *grid, double x)
{
    return (int64_t)rint(x / grid->step);
}

/* Is the ring of vertices in a plane of the cell's box? A cap may have been rounded into one. */
static bool level_at(const tn_grid *grid, const uint32_t *ring, uint32_t count, int axis, int64_t w)
{
    for (uint32_t i = 0; i < count; i++)
        if (grid->vertices[ring[i]].at[axis] != w)
            return false;
    return true;
}

/* Which face the ring is in fact: that of the box whose plane all of it lies in, or the cap. */
static uint32_t face_of(const tn_grid *grid, const tn_cut_box *cell, const tn_cut_box_face *face, const uint32_t *ring,
                        uint32_t count)
{
    for (uint32_t side = 0; side < 6 && face->side == TN_CUT_BOX_CAP; side++) {
        double w = side & 1 ? cell->high[side / 2] : cell->low[side / 2];
        if (level_at(grid, ring, count, (int)(side / 2), steps(grid, w)))
            return side;
    }
    return face->side;
}

/* The ring without corners where it goes straight on, as corners of the plane. */
static uint32_t straighten(tn_grid *grid, const uint32_t *ring, uint32_t count, tn_ring_corner *out)
{
    uint32_t lines[8], kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        lines[i] = tn_grid_line_through(grid, ring[i], ring[(i + 1) % count]);
        tn_grid_stop_at(grid, lines[i], ring[i]);
        tn_grid_stop_at(grid, lines[i], ring[(i + 1) % count]);
    }
    for (uint32_t i = 0; i < count; i++)
        if (lines[i] != lines[(i + count - 1) % count])
            out[kept++] = (tn_ring_corner){.point = {ring[i], TN_NOTHING, TN_NOTHING}, .line = lines[i]};
    return kept >= 3 ? kept : 0;
}

/* Turned so that it is counter-clockwise in u and v, whichever side it looks to; with its bounds. */
static void add_flat(planes *p, flat one, const tn_ring_corner *ring, uint32_t count)
{
    tn_grid *grid = p->grid;
    int u = ((int)one.axis + 1) % 3, v = ((int)one.axis + 2) % 3;
    one.first = (uint32_t)p->corner_count;
    one.count = count;
    one.low_u = one.low_v = INT64_MAX;
    one.high_u = one.high_v = INT64_MIN;
    for (uint32_t k = 0; k < count; k++) {
        tn_ring_corner corner = ring[one.high ? k : count - 1 - k];
        if (!one.high)
            corner.line = ring[(2 * count - 2 - k) % count].line;
        const int64_t *at = grid->vertices[corner.point.vertex].at;
        uint32_t next = ring[one.high ? (k + 1) % count : (2 * count - 2 - k) % count].point.vertex;
        corner.side = tn_grid_inside(grid, (int)one.axis, corner.line, corner.point.vertex, next);
        one.low_u = at[u] < one.low_u ? at[u] : one.low_u;
        one.high_u = at[u] > one.high_u ? at[u] : one.high_u;
        one.low_v = at[v] < one.low_v ? at[v] : one.low_v;
        one.high_v = at[v] > one.high_v ? at[v] : one.high_v;
        if (!room(p, &p->corners, sizeof corner, p->corner_count, &p->corner_capacity))
            return;
        p->corners[p->corner_count++] = corner;
    }
    if (room(p, &p->flats, sizeof one, p->flat_count, &p->flat_capacity))
        p->flats[p->flat_count++] = one;
}

static void add_face(planes *p, const tn_cut_box *cell, uint32_t index, const tn_cut_box_face *face,
                     const uint32_t *vertices)
{
    uint32_t ring[8], count = 0;
    tn_ring_corner corners[8];
    for (uint32_t k = 0; k < face->count; k++) {
        uint32_t vertex = vertices[face->corner[k]];
        if (count == 0 || ring[count - 1] != vertex)
            ring[count++] = vertex;
    }
    while (count > 1 && ring[count - 1] == ring[0])
        count--;
    if (count < 3 || p->grid->failed)
        return;
    uint32_t kept = straighten(p->grid, ring, count, corners);
    uint32_t side = face_of(p->grid, cell, face, ring, count);
    if (kept == 0 || p->grid->failed)
        return;
    if (side == TN_CUT_BOX_CAP) {
        tn_grid_add_ring(p->grid, corners, kept, index, TN_CUT_BOX_CAP);
        return;
    }
    /* A cap in the plane of a low face looks to the high side: its orientation says so. */
    bool high = face->side == TN_CUT_BOX_CAP ? false : side & 1;
    flat one = {.w = p->grid->vertices[ring[0]].at[side / 2], .axis = side / 2, .cell = index, .high = high};
    if (face->side == TN_CUT_BOX_CAP) {
        int u = ((int)one.axis + 1) % 3, v = ((int)one.axis + 2) % 3;
        const int64_t *a = p->grid->vertices[corners[0].point.vertex].at,
                      *b = p->grid->vertices[corners[1].point.vertex].at,
                      *c = p->grid->vertices[corners[2].point.vertex].at;
        one.high = (tn_int128)(b[u] - a[u]) * (c[v] - a[v]) > (tn_int128)(b[v] - a[v]) * (c[u] - a[u]);
    }
    add_flat(p, one, corners, kept);
}

static void add_cell(planes *p, const tn_cut_box *cell, uint32_t index)
{
    uint32_t vertices[TN_CUT_BOX_CORNERS];
    for (int k = 0; k < 3; k++)
        if (steps(p->grid, cell->low[k]) >= steps(p->grid, cell->high[k]))
            return; /* thinner than a step */
    for (uint32_t i = 0; i < cell->corner_count; i++) {
        int64_t at[3];
        for (int k = 0; k < 3; k++)
            at[k] = steps(p->grid, cell->at[i][k]);
        vertices[i] = tn_grid_vertex_of(p->grid, at);
    }
    for (uint32_t f = 0; f < cell->face_count; f++)
        add_face(p, cell, index, &cell->faces[f], vertices);
}

/* ---- cutting */

static void put(planes *p, tn_grid_point point, uint32_t line, int side)
{
    if (room(p, &p->cut, sizeof *p->cut, p->cut_count, &p->cut_capacity))
        p->cut[p->cut_count++] = (tn_ring_corner){point, line, side};
}

/* What of a piece is on one side of a line: the corners whose signs times `turn` are not below 0. */
static piece part_of(planes *p, piece of, const int *signs, int turn, uint32_t line, int side,
                     const tn_grid_point *crossings)
{
    piece part = {(uint32_t)p->cut_count, 0};
    for (uint32_t k = 0; k < of.count && !p->grid->failed; k++) {
        tn_ring_corner corner = p->cut[of.first + k];
        int here = turn * signs[k], next = turn * signs[(k + 1) % of.count];
        if (here > 0 || (here == 0 && next > 0))
            put(p, corner.point, corner.line, corner.side);
        else if (here == 0)
            put(p, corner.point, line, turn * side);
        if (here > 0 && next < 0)
            put(p, crossings[k], line, turn * side);
        else if (here < 0 && next > 0)
            put(p, crossings[k], corner.line, corner.side);
    }
    part.count = (uint32_t)p->cut_count - part.first;
    return part;
}

typedef enum cut_result { CUT_OUTSIDE, CUT_INSIDE, CUT_BOTH } cut_result;

/* Cuts a piece along a line; where it lies on both sides, what is inside and what is outside. */
static cut_result cut(planes *p, int axis, int64_t w, piece of, const tn_ring_corner *edge, piece *inside,
                      piece *outside)
{
    int signs[CUT_MAX];
    tn_grid_point crossings[CUT_MAX];
    bool in = false, out = false;
    if (of.count > CUT_MAX)
        p->grid->failed = true;
    for (uint32_t k = 0; k < of.count && !p->grid->failed; k++) {
        const tn_grid_point *point = &p->cut[of.first + k].point;
        signs[k] = edge->side * tn_grid_side(p->grid, axis, edge->line, point);
        in |= signs[k] > 0;
        out |= signs[k] < 0;
        if (signs[k] == 0)
            tn_grid_stop_at(p->grid, edge->line, point->vertex);
    }
    if (!in || p->grid->failed)
        return CUT_OUTSIDE;
    if (!out)
        return CUT_INSIDE;
    for (uint32_t k = 0; k < of.count; k++)
        if (signs[k] * signs[(k + 1) % of.count] < 0)
            crossings[k] = tn_grid_crossing(p->grid, axis, w, p->cut[of.first + k].line, edge->line);
    *inside = part_of(p, of, signs, 1, edge->line, edge->side, crossings);
    *outside = part_of(p, of, signs, -1, edge->line, edge->side, crossings);
    return CUT_BOTH;
}

static void keep(planes *p, piece one)
{
    if (room(p, &p->left, sizeof one, p->left_count, &p->left_capacity))
        p->left[p->left_count++] = one;
}

/* Leaves of a piece what is outside a face. */
static void take_away(planes *p, const flat *face, piece one)
{
    size_t before = p->left_count;
    piece rest = one, outside;
    for (uint32_t k = 0; k < face->count && !p->grid->failed; k++) {
        const tn_ring_corner edge = p->corners[face->first + k];
        cut_result result = cut(p, (int)face->axis, face->w, rest, &edge, &rest, &outside);
        if (result == CUT_OUTSIDE) { /* they only touch, if that: it stays as it was */
            p->left_count = before;
            keep(p, one);
            return;
        }
        if (result == CUT_BOTH)
            keep(p, outside);
    }
}

/* Does a piece lie beside the bounds of a face? It may touch them with corners of a cell; others are known as far as
 * they are rounded. What only touches is not to be cut: lines that nearly go on in each other would cross nearby. */
static bool apart(const planes *p, piece one, const flat *face)
{
    int u = ((int)face->axis + 1) % 3, v = ((int)face->axis + 2) % 3;
    bool left = true, right = true, below = true, above = true;
    for (uint32_t k = 0; k < one.count; k++) {
        const tn_grid_point *point = &p->cut[one.first + k].point;
        const int64_t *at = p->grid->vertices[point->vertex].at;
        int64_t over = point->one == TN_NOTHING ? 1 : 0;
        left &= at[u] < face->low_u + over;
        right &= at[u] > face->high_u - over;
        below &= at[v] < face->low_v + over;
        above &= at[v] > face->high_v - over;
    }
    return left || right || below || above;
}

static void subtract(planes *p, const flat *face)
{
    p->left_count = 0;
    for (size_t i = 0; i < p->piece_count && !p->grid->failed; i++) {
        if (apart(p, p->pieces[i], face))
            keep(p, p->pieces[i]);
        else
            take_away(p, face, p->pieces[i]);
    }
    piece *pieces = p->pieces;
    size_t capacity = p->piece_capacity;
    p->pieces = p->left;
    p->piece_count = p->left_count;
    p->piece_capacity = p->left_capacity;
    p->left = pieces;
    p->left_capacity = capacity;
}

/* ---- many faces against one */

/* Takes faces from a piece one by one, and keeps what is left as polygons of the boundary. */
static void cover_few(planes *p, const flat *of, const flat *others, piece one, size_t first, size_t count)
{
    p->piece_count = 0;
    if (room(p, &p->pieces, sizeof one, p->piece_count, &p->piece_capacity))
        p->pieces[p->piece_count++] = one;
    for (size_t i = first; i < first + count && !p->grid->failed; i++)
        subtract(p, &others[p->hits.items[i]]);
    for (size_t i = 0; i < p->piece_count && !p->grid->failed; i++)
        tn_grid_add_ring(p->grid, p->cut + p->pieces[i].first, p->pieces[i].count, of->cell, 2 * of->axis + of->high);
}

static int64_t low_of(const flat *face, int second)
{
    return second ? face->low_v : face->low_u;
}

static bool starts_before(const void *context, uint32_t a, uint32_t b, int second)
{
    const flat *faces = context;
    int64_t p = low_of(&faces[a], second), q = low_of(&faces[b], second);
    return p < q || (p == q && a < b);
}

/* The edge of a face at its low side in u, or in v, if it goes along an axis there. */
static const tn_ring_corner *low_edge(const planes *p, const flat *face, int second)
{
    uint32_t fixed = (face->axis + 1 + (uint32_t)second) % 3, along = (face->axis + 2 - (uint32_t)second) % 3;
    for (uint32_t k = 0; k < face->count; k++) {
        const tn_ring_corner *corner = &p->corners[face->first + k];
        if (p->grid->lines[corner->line].kind == along &&
            p->grid->vertices[corner->point.vertex].at[fixed] == low_of(face, second))
            return corner;
    }
    return NULL;
}

/* Do the low sides of faces spread more in v than in u? */
static int wider_way(const planes *p, const flat *others, size_t first, size_t count)
{
    double spread[2];
    for (int k = 0; k < 2; k++) {
        int64_t low = INT64_MAX, high = INT64_MIN;
        for (size_t i = first; i < first + count; i++) {
            int64_t at = low_of(&others[p->hits.items[i]], k);
            low = at < low ? at : low;
            high = at > high ? at : high;
        }
        spread[k] = (double)high - (double)low;
    }
    return spread[1] > spread[0];
}

/* Cuts a piece along the low side of a face in the middle of many, or of one beyond it. */
static bool halve(planes *p, const flat *others, piece one, size_t first, size_t count, piece halves[2])
{
    int second = wider_way(p, others, first, count);
    size_t middle = first + count / 2;
    tn_select_nth(p->hits.items, (uint32_t)first, (uint32_t)(first + count), (uint32_t)middle, second, starts_before,
                  others);
    for (size_t i = middle; i < first + count && i < middle + 8; i++) {
        const flat *face = &others[p->hits.items[i]];
        const tn_ring_corner *edge = low_edge(p, face, second);
        if (edge && cut(p, (int)face->axis, face->w, one, edge, &halves[0], &halves[1]) == CUT_BOTH)
            return true;
    }
    return false;
}

/* Halves a piece until few faces lie against each part of it, so that not each part meets each face. */
static void cover_piece(planes *p, const flat *of, const flat *others, piece one, size_t first, size_t count, int depth)
{
    piece halves[2];
    if (count <= FEW || depth == DEPTH || !halve(p, others, one, first, count, halves)) {
        cover_few(p, of, others, one, first, count);
        return;
    }
    for (int h = 0; h < 2; h++) {
        size_t begin = p->hits.count;
        for (size_t i = first; i < first + count; i++)
            if (!apart(p, halves[h], &others[p->hits.items[i]]) &&
                room(p, &p->hits.items, sizeof *p->hits.items, p->hits.count, &p->hits.capacity))
                p->hits.items[p->hits.count++] = p->hits.items[i];
        cover_piece(p, of, others, halves[h], begin, p->hits.count - begin, depth + 1);
        p->hits.count = begin;
    }
}

static piece whole_piece(planes *p, const flat *of)
{
    p->cut_count = 0;
    for (uint32_t k = 0; k < of->count; k++) {
        tn_ring_corner corner = p->corners[of->first + k];
        put(p, corner.point, corner.line, corner.side);
    }
    return (piece){0, of->count};
}

/* ---- planes */

static int compare(int64_t a, int64_t b)
{
    return (a > b) - (a < b);
}

/* By plane, side, bounds, cell. */
static int in_order(const void *a, const void *b)
{
    const flat *x = a, *y = b;
    if (x->axis != y->axis)
        return x->axis < y->axis ? -1 : 1;
    if (x->w != y->w)
        return compare(x->w, y->w);
    if (x->high != y->high)
        return x->high ? 1 : -1;
    if (x->low_u != y->low_u)
        return compare(x->low_u, y->low_u);
    return x->cell < y->cell ? -1 : x->cell > y->cell;
}

static tn_box_bounds bounds_of(const flat *face)
{
    return (tn_box_bounds){{(double)face->low_u, (double)face->low_v, 0},
                           {(double)face->high_u, (double)face->high_v, 0}};
}

/* Takes the faces of the other side from each of one side. */
static void cover(planes *p, const flat *faces, size_t count, const flat *others, size_t other_count)
{
    tn_box_tree tree = {0};
    tn_box_bounds *bounds = count ? malloc((other_count + 1) * sizeof *bounds) : NULL;
    for (size_t k = 0; bounds && k < other_count; k++)
        bounds[k] = bounds_of(&others[k]);
    if (count && (!bounds || tn_box_tree_make(bounds, (uint32_t)other_count, &tree, &(tn_error){0}) != TN_OK))
        p->grid->failed = true;
    for (size_t i = 0; i < count && !p->grid->failed; i++) {
        piece one = whole_piece(p, &faces[i]);
        const tn_box_bounds face = bounds_of(&faces[i]);
        p->grid->failed |= !tn_box_tree_list(&tree, &face, &p->hits);
        cover_piece(p, &faces[i], others, one, 0, p->hits.count, 0);
    }
    tn_box_tree_clear(&tree);
    free(bounds);
}

static void cover_planes(planes *p)
{
    qsort(p->flats, p->flat_count, sizeof *p->flats, in_order);
    for (size_t first = 0, high, last; first < p->flat_count; first = last) {
        const flat *f = &p->flats[first];
        for (last = first; last < p->flat_count && p->flats[last].axis == f->axis && p->flats[last].w == f->w;)
            last++;
        for (high = first; high < last && !p->flats[high].high;)
            high++;
        cover(p, p->flats + first, high - first, p->flats + high, last - high);
        cover(p, p->flats + high, last - high, p->flats + first, high - first);
    }
}

/* ---- caps */

/* A cap by its vertices, the lowest of them first. */
typedef struct cap {
    uint32_t ring, count;
    uint32_t vertices[8];
} cap;

static int by_number(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static int by_vertices(const void *a, const void *b)
{
    const cap *x = a, *y = b;
    if (x->count != y->count)
        return x->count < y->count ? -1 : 1;
    for (uint32_t i = 0; i < x->count; i++)
        if (x->vertices[i] != y->vertices[i])
            return x->vertices[i] < y->vertices[i] ? -1 : 1;
    return (x->ring > y->ring) - (x->ring < y->ring);
}

static cap cap_of(const tn_grid *grid, uint32_t ring)
{
    cap one = {.ring = ring, .count = grid->rings[ring].count};
    for (uint32_t i = 0; i < one.count; i++)
        one.vertices[i] = grid->corners[grid->rings[ring].first + i].point.vertex;
    qsort(one.vertices, one.count, sizeof *one.vertices, by_number);
    return one;
}

/* Two cells that lie against each other along a cap have the whole of it in common: neither is of the boundary. All
 * rings are caps so far. */
static void drop_pairs(tn_grid *grid)
{
    cap *caps = malloc((grid->ring_count + 1) * sizeof *caps);
    bool *dropped = calloc(grid->ring_count + 1, sizeof *dropped);
    grid->failed |= !caps || !dropped;
    if (!grid->failed) {
        size_t kept = 0;
        for (uint32_t i = 0; i < grid->ring_count; i++)
            caps[i] = cap_of(grid, i);
        qsort(caps, grid->ring_count, sizeof *caps, by_vertices);
        for (size_t i = 0; i + 1 < grid->ring_count; i++) {
            const cap *one = &caps[i], *next = &caps[i + 1];
            bool same = one->count == next->count &&
                        memcmp(one->vertices, next->vertices, one->count * sizeof *one->vertices) == 0;
            if (same && !dropped[one->ring])
                dropped[one->ring] = dropped[next->ring] = true;
        }
        for (size_t i = 0; i < grid->ring_count; i++)
            if (!dropped[i])
                grid->rings[kept++] = grid->rings[i];
        grid->ring_count = kept;
    }
    free(caps);
    free(dropped);
}

void tn_grid_planes(tn_grid *grid, const tn_cut_box *cells, size_t count)
{
    planes p = {.grid = grid};
    for (size_t i = 0; i < count && !grid->failed; i++)
        add_cell(&p, &cells[i], (uint32_t)i);
    if (!grid->failed)
        drop_pairs(grid);
    if (!grid->failed && p.flat_count)
        cover_planes(&p);
    free(p.flats);
    free(p.corners);
    free(p.cut);
    free(p.pieces);
    free(p.left);
    free(p.hits.items);
}
