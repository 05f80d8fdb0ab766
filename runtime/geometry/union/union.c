/* The boundary of a union of cells: calls what finds planes, triangles and vertices, and makes a manifold of the
 * triangles. */
#include "runtime/geometry/union/union.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/geometry/union/grid.h"

/* ==== makes a closed set of triangles a manifold: at an edge with more than two triangles, the two that bound the same
 * wedge of the solid belong together, and what belongs together at a vertex shares a vertex of its own */

/* A triangle's edge; low < high are its vertices. */
typedef struct edge {
    uint32_t low, high;
    uint32_t corner; /* where it begins, an index into the mesh's corners */
    bool forward;    /* from low to high */
} edge;

typedef struct separating {
    const tn_grid *grid;
    const uint32_t *corners;
    uint32_t *parent; /* of each corner */
} separating;

static uint32_t find(uint32_t *parent, uint32_t x)
{
    while (parent[x] != x) {
        parent[x] = parent[parent[x]];
        x = parent[x];
    }
    return x;
}

static void join(uint32_t *parent, uint32_t x, uint32_t y)
{
    x = find(parent, x);
    y = find(parent, y);
    if (x < y)
        parent[y] = x;
    else
        parent[x] = y;
}

static uint32_t next_corner(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/* The corners of two triangles at an edge that they share, end by end. */
static void pair(separating *s, const edge *a, const edge *b)
{
    join(s->parent, a->corner, next_corner(b->corner));
    join(s->parent, next_corner(a->corner), b->corner);
}

/* ---- round an edge */

typedef struct arrow {
    int64_t at[3];
} arrow;

static arrow arrow_to(const separating *s, uint32_t from, uint32_t to)
{
    const int64_t *p = s->grid->vertices[from].at, *q = s->grid->vertices[to].at;
    return (arrow){{q[0] - p[0], q[1] - p[1], q[2] - p[2]}};
}

/* The third corner of the edge's triangle, from the edge's low vertex. */
static arrow third(const separating *s, const edge *e)
{
    return arrow_to(s, e->low, s->corners[next_corner(next_corner(e->corner))]);
}

static void cross(const arrow *a, const arrow *b, tn_int128 out[3])
{
    for (int k = 0; k < 3; k++) {
        int u = (k + 1) % 3, v = (k + 2) % 3;
        out[k] = (tn_int128)a->at[u] * b->at[v] - (tn_int128)a->at[v] * b->at[u];
    }
}

/* The sign of axis . (a x b): is b counter-clockwise of a, by less than half a turn? */
static int turn(const arrow *axis, const arrow *a, const arrow *b)
{
    tn_int128 n[3];
    tn_wide sum = tn_wide_of(0);
    cross(a, b, n);
    for (int k = 0; k < 3; k++)
        sum = tn_wide_add(sum, tn_wide_product(n[k], axis->at[k]));
    return tn_wide_sign(sum);
}

/* Do both lie on the same side of the axis, seen along it? The sign of (axis x a) . (axis x b). */
static int same_way(const arrow *axis, const arrow *a, const arrow *b)
{
    tn_int128 m[3], n[3];
    tn_wide sum = tn_wide_of(0);
    cross(axis, a, m);
    cross(axis, b, n);
    for (int k = 0; k < 3; k++)
        sum = tn_wide_add(sum, tn_wide_product(m[k], n[k]));
    return tn_wide_sign(sum);
}

/* Quarters of a turn from the first: 0 with it, 1 before the half, 2 the half, 3 beyond. */
static int quarter(const arrow *axis, const arrow *first, const arrow *a)
{
    int side = turn(axis, first, a);
    return side > 0 ? 1 : side < 0 ? 3 : same_way(axis, first, a) > 0 ? 0 : 2;
}

static bool before(const separating *s, const edge *first, const edge *a, const edge *b)
{
    arrow axis = arrow_to(s, first->low, first->high), o = third(s, first), p = third(s, a), q = third(s, b);
    int x = quarter(&axis, &o, &p), y = quarter(&axis, &o, &q);
    return x != y ? x < y : turn(&axis, &p, &q) > 0;
}

/* In the order of their angle about the edge, each forward triangle has the solid behind it, that is clockwise: the
 * next backward one there is the other side of the wedge. */
static void pair_round(separating *s, edge *edges, size_t count)
{
    for (size_t i = 2; i < count; i++)
        for (size_t k = i; k > 1 && before(s, &edges[0], &edges[k], &edges[k - 1]); k--) {
            edge other = edges[k];
            edges[k] = edges[k - 1];
            edges[k - 1] = other;
        }
    for (size_t i = 0; i < count; i++) {
        if (!edges[i].forward)
            continue;
        size_t depth = 1, k = i;
        while (depth > 0) { /* brackets: a forward opens, a backward closes */
            k = (k + count - 1) % count;
            depth = edges[k].forward ? depth + 1 : depth - 1;
            if (k == i)
                break;
        }
        pair(s, &edges[i], &edges[k]);
    }
}

static int by_end(const void *a, const void *b)
{
    const edge *x = a, *y = b;
    if (x->high != y->high)
        return x->high < y->high ? -1 : 1;
    return x->corner < y->corner ? -1 : x->corner > y->corner;
}

/* Mostly few edges go on from one vertex. */
static void sort_bucket(edge *edges, size_t count)
{
    if (count > 32) {
        qsort(edges, count, sizeof *edges, by_end);
        return;
    }
    for (size_t i = 1; i < count; i++) {
        edge one = edges[i];
        size_t k = i;
        for (; k > 0 && by_end(&one, &edges[k - 1]) < 0; k--)
            edges[k] = edges[k - 1];
        edges[k] = one;
    }
}

static edge edge_at(const tn_mesh *mesh, uint32_t corner)
{
    uint32_t a = mesh->corners[corner], b = mesh->corners[next_corner(corner)];
    return (edge){a < b ? a : b, a < b ? b : a, corner, a < b};
}

/* By low vertex, which is counted, then by high vertex and corner. */
static edge *list_edges(const tn_mesh *mesh, size_t vertices)
{
    size_t count = 3 * mesh->face_count;
    edge *edges = malloc((count + 1) * sizeof *edges);
    size_t *end = calloc(vertices + 2, sizeof *end); /* [v + 1]: where those of v end, once all are placed */
    if (!edges || !end) {
        free(edges);
        free(end);
        return NULL;
    }
    for (uint32_t c = 0; c < count; c++)
        end[edge_at(mesh, c).low + 2]++;
    for (size_t v = 2; v < vertices + 2; v++)
        end[v] += end[v - 1];
    for (uint32_t c = 0; c < count; c++) {
        edge one = edge_at(mesh, c);
        edges[end[one.low + 1]++] = one;
    }
    for (size_t v = 0; v < vertices; v++)
        sort_bucket(edges + end[v], end[v + 1] - end[v]);
    free(end);
    return edges;
}

/* Do two of these edges still have both of their vertices in common? */
static bool is_shared(separating *s, const edge *edges, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < i; k++)
            if (edges[i].forward && edges[k].forward &&
                find(s->parent, edges[i].corner) == find(s->parent, edges[k].corner) &&
                find(s->parent, next_corner(edges[i].corner)) == find(s->parent, next_corner(edges[k].corner)))
                return true;
    return false;
}

/* False if the edge is too short to have a middle. */
static bool split(tn_grid *grid, uint32_t low, uint32_t high)
{
    const int64_t *p = grid->vertices[low].at, *q = grid->vertices[high].at;
    int64_t middle[3];
    for (int k = 0; k < 3; k++)
        middle[k] = p[k] + (q[k] - p[k]) / 2;
    uint32_t vertex = tn_grid_vertex_of(grid, middle);
    if (vertex == low || vertex == high)
        return false;
    if (tn_grid_room(grid, &grid->splits, sizeof *grid->splits, grid->split_count, &grid->split_capacity))
        grid->splits[grid->split_count++] = (tn_grid_split){low, high, vertex};
    return true;
}

static bool split_shared(tn_grid *grid, separating *s, const edge *edges, size_t count)
{
    bool can = true;
    for (size_t first = 0, last; first < count && can; first = last) {
        for (last = first;
             last < count && edges[last].low == edges[first].low && edges[last].high == edges[first].high;)
            last++;
        if (last - first > 2 && is_shared(s, edges + first, last - first))
            can = split(grid, edges[first].low, edges[first].high);
    }
    return can;
}

static bool pair_all(separating *s, edge *edges, size_t count)
{
    for (size_t first = 0, last; first < count; first = last) {
        size_t forward = 0;
        for (last = first; last < count && edges[last].low == edges[first].low && edges[last].high == edges[first].high;
             last++)
            forward += edges[last].forward;
        if (2 * forward != last - first)
            return false;
        if (last - first == 2)
            pair(s, &edges[first], &edges[first + 1]);
        else
            pair_round(s, edges + first, last - first);
    }
    return true;
}

/* ---- vertices */

static tn_status number(const tn_grid *grid, separating *s, tn_mesh *mesh, size_t *doubled, tn_error *error)
{
    size_t corners = 3 * mesh->face_count, used = 0;
    uint32_t *ids = malloc((corners + 1) * sizeof *ids);
    bool *seen = calloc(grid->vertex_count + 1, sizeof *seen);
    mesh->positions = malloc((3 * corners + 1) * sizeof *mesh->positions);
    mesh->face_first = malloc((mesh->face_count + 1) * sizeof *mesh->face_first);
    bool made = ids && seen && mesh->positions && mesh->face_first;
    for (uint32_t c = 0; made && c < corners; c++) {
        uint32_t root = find(s->parent, c), vertex = mesh->corners[c];
        if (root == c) { /* roots are the lowest of their corners */
            ids[c] = (uint32_t)used;
            for (int k = 0; k < 3; k++)
                mesh->positions[3 * used + (size_t)k] = (double)grid->vertices[vertex].at[k] * grid->step;
            used++;
            *doubled += seen[vertex];
            seen[vertex] = true;
        }
        ids[c] = ids[root];
    }
    for (uint32_t c = 0; made && c < corners; c++)
        mesh->corners[c] = ids[c];
    for (size_t f = 0; made && f <= mesh->face_count; f++)
        mesh->face_first[f] = (uint32_t)(3 * f);
    mesh->vertex_count = used;
    free(ids);
    free(seen);
    return made ? TN_OK : tn_fail_memory(error);
}

/* Doubles vertices so that each edge has two triangles and each vertex one umbrella; gives positions. Where cells touch
 * along an edge and are joined round both of its ends, that needs a vertex in its middle: it is added to the grid's
 * splits, *again is set, and triangles are to be made anew. */
static tn_status grid_separate(tn_grid *grid, tn_mesh *mesh, size_t *doubled, bool *again, tn_error *error)
{
    size_t count = 3 * mesh->face_count, splits = grid->split_count;
    separating s = {.grid = grid, .corners = mesh->corners, .parent = malloc((count + 1) * sizeof *s.parent)};
    edge *edges = list_edges(mesh, grid->vertex_count);
    *doubled = 0;
    tn_status status = s.parent && edges ? TN_OK : tn_fail_memory(error);
    for (uint32_t c = 0; status == TN_OK && c < count; c++)
        s.parent[c] = c;
    if (status == TN_OK && !pair_all(&s, edges, count))
        status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "the boundary of the union is not closed");
    else if (status == TN_OK && !split_shared(grid, &s, edges, count))
        status = tn_union_too_fine(error);
    free(edges);
    *again = grid->split_count > splits;
    if (status == TN_OK && grid->failed)
        status = tn_fail_memory(error);
    if (status == TN_OK && !*again)
        status = number(grid, &s, mesh, doubled, error);
    free(s.parent);
    return status;
}

/* ==== the boundary of a union of cells: calls what finds planes, triangles and vertices */

/* Rounds: two or three are what random designs take. Steps: 2^52 of them from 0, then 2^44, 2^36. */
enum { ROUNDS = 64, STEPS = 3 };

void tn_union_clear(tn_union *result)
{
    tn_mesh_clear(&result->mesh);
    *result = (tn_union){0};
}

static tn_status make(const tn_cut_box *cells, size_t count, double step, bool merging, tn_union *result,
                      tn_error *error)
{
    tn_grid grid = {.step = step, .merging = merging};
    tn_grid_planes(&grid, cells, count);
    tn_status status = grid.failed ? tn_fail_memory(error) : TN_OK;
    bool again = true;
    for (int round = 0; status == TN_OK && again; round++) { /* each time with other edges */
        tn_mesh_clear(&result->mesh);
        status = round < ROUNDS ? tn_grid_triangles(&grid, &result->mesh, error) : tn_union_too_fine(error);
        if (status == TN_OK)
            status = grid_separate(&grid, &result->mesh, &result->doubled, &again, error);
    }
    tn_grid_clear(&grid);
    return status;
}

/* Edges of one step have no middle to be split at: with longer steps their ends are one vertex. Where no step will do,
 * because crossings that are a few steps apart changed places when they were rounded, these are merged. */
tn_status tn_union_make(const tn_cut_box *cells, size_t count, tn_union *result, tn_error *error)
{
    double step = tn_cut_boxes_step(cells, count);
    tn_status status = TN_LIMIT;
    *result = (tn_union){0};
    for (int attempt = 0; attempt < 2 * STEPS && status == TN_LIMIT; attempt++) {
        tn_union_clear(result);
        status = make(cells, count, ldexp(step, 8 * (attempt % STEPS)), attempt >= STEPS, result, error);
    }
    result->mesh.group_count = (uint32_t)count;
    return status;
}

tn_status tn_union_cells(const tn_cut_box *cells, size_t count, tn_mesh *mesh, tn_error *error)
{
    size_t vertices = 0, faces = 0, corners = 0;
    for (size_t i = 0; i < count; i++) {
        vertices += cells[i].corner_count;
        faces += cells[i].face_count;
        for (uint32_t f = 0; f < cells[i].face_count; f++)
            corners += cells[i].faces[f].count;
    }
    tn_status status = tn_mesh_new(vertices, faces, corners, mesh, error);
    mesh->face_group = status == TN_OK ? malloc((faces + 1) * sizeof *mesh->face_group) : NULL;
    if (status == TN_OK && !mesh->face_group)
        status = tn_fail_memory(error);
    vertices = faces = corners = 0;
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        for (uint32_t f = 0; f < cells[i].face_count; f++) {
            mesh->face_first[faces] = (uint32_t)corners;
            mesh->face_group[faces++] = (uint32_t)i;
            for (uint32_t k = 0; k < cells[i].faces[f].count; k++)
                mesh->corners[corners++] = (uint32_t)vertices + cells[i].faces[f].corner[k];
        }
        for (uint32_t v = 0; v < cells[i].corner_count; v++, vertices++)
            for (int k = 0; k < 3; k++)
                mesh->positions[3 * vertices + (size_t)k] = cells[i].at[v][k];
    }
    if (status == TN_OK)
        mesh->face_first[faces] = (uint32_t)corners;
    mesh->group_count = (uint32_t)count;
    return status;
}
