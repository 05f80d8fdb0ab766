/* Finds the inside of meshes line by line: where a line along the first axis meets triangles, its winding number
 * changes.
 *
 * Whether a line meets a triangle is asked of the triangle's sides as seen along the line. A side is always taken in
 * the same order of its ends, and a line through it counts as moved a little, the same way everywhere; so the two
 * triangles of a side agree on which of them the line meets. */
#include "runtime/geometry/winding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

enum { CROSSINGS_MAX = 100000000, CHECK_EVERY = 1024 };

/* A line meets a triangle: where along it, and by how much winding changes. */
typedef struct crossing {
    double at;
    uint32_t line;
    int32_t turn;
} crossing;

typedef struct crossings {
    crossing *items;
    size_t count, capacity;
} crossings;

static const double *vertex(const tn_mesh *mesh, uint32_t index)
{
    return mesh->positions + 3 * (size_t)index;
}

/* Is a before b, seen along the lines? */
static bool is_first(const double *a, const double *b)
{
    return a[1] != b[1] ? a[1] < b[1] : a[2] < b[2];
}

/* On which side of the one from a to b the line is: the sign of *amount, which may be 0 if a moved line's is not. */
static int side_of(const double *a, const double *b, const double line[2], double *amount)
{
    bool turned = !is_first(a, b);
    const double *from = turned ? b : a, *to = turned ? a : b;
    double along[2] = {to[1] - from[1], to[2] - from[2]};
    double f = along[0] * (line[1] - from[2]) - along[1] * (line[0] - from[1]);
    int sign = (f > 0) - (f < 0);
    if (sign == 0)
        sign = along[1] != 0 ? (along[1] < 0) - (along[1] > 0) : (along[0] > 0) - (along[0] < 0);
    *amount = fabs(f);
    return turned ? -sign : sign;
}

/* By how much the winding number changes where the line meets the triangle, and where that is; 0: it does not. */
static int meet(const double *const corner[3], const double line[2], double *at)
{
    double weight[3];
    int turn = 0;
    for (int i = 0; i < 3; i++) {
        int side = side_of(corner[(i + 1) % 3], corner[(i + 2) % 3], line, &weight[i]);
        if (side == 0 || (i > 0 && side != turn))
            return 0;
        turn = side;
    }
    double sum = weight[0] + weight[1] + weight[2];
    *at = sum > 0 ? (weight[0] * corner[0][0] + weight[1] * corner[1][0] + weight[2] * corner[2][0]) / sum
                  : (corner[0][0] + corner[1][0] + corner[2][0]) / 3;
    return turn;
}

/* The cells along an axis whose middle may lie from low to high. */
static void cells_between(const tn_mesh_grid *grid, int axis, double low, double high, uint32_t *first, uint32_t *end)
{
    double a = low / grid->size[axis] - grid->low[axis] - 0.5, b = high / grid->size[axis] - grid->low[axis] - 0.5;
    double from = floor(a < b ? a : b), to = ceil(a < b ? b : a) + 1, most = grid->count[axis];
    *first = from > 0 ? (uint32_t)(from < most ? from : most) : 0;
    *end = to > 0 ? (uint32_t)(to < most ? to : most) : 0;
}

static double middle(const tn_mesh_grid *grid, int axis, uint32_t cell)
{
    return (grid->low[axis] + cell + 0.5) * grid->size[axis];
}

static tn_status meet_lines(const tn_mesh *mesh, uint32_t face, const tn_mesh_grid *grid, crossings *list,
                            tn_error *error)
{
    const uint32_t *c = &mesh->corners[3 * (size_t)face];
    const double *const corner[3] = {vertex(mesh, c[0]), vertex(mesh, c[1]), vertex(mesh, c[2])};
    uint32_t first[2], end[2];
    for (int k = 0; k < 2; k++) {
        double a = corner[0][k + 1], b = corner[1][k + 1], d = corner[2][k + 1];
        cells_between(grid, k + 1, fmin(a, fmin(b, d)), fmax(a, fmax(b, d)), &first[k], &end[k]);
    }
    for (uint32_t k = first[1]; k < end[1]; k++) {
        for (uint32_t j = first[0]; j < end[0]; j++) {
            const double line[2] = {middle(grid, 1, j), middle(grid, 2, k)};
            double at;
            int turn = meet(corner, line, &at);
            if (turn == 0)
                continue;
            if (list->count == CROSSINGS_MAX)
                return tn_fail(error, TN_LIMIT, TN_CODE_NONE, "its surface lies in too many layers");
            if (!tn_array_reserve(&list->items, &list->capacity, list->count, 1, sizeof *list->items))
                return tn_fail_memory(error);
            list->items[list->count++] = (crossing){at, k * grid->count[1] + j, turn};
        }
    }
    return TN_OK;
}

static int by_line(const void *a, const void *b)
{
    const crossing *one = a, *other = b;
    if (one->line != other->line)
        return one->line < other->line ? -1 : 1;
    if (one->at != other->at)
        return one->at < other->at ? -1 : 1;
    return (one->turn > other->turn) - (one->turn < other->turn);
}

/* The first cell of a line whose middle lies behind a place. */
static uint32_t cell_behind(const tn_mesh_grid *grid, double at)
{
    double cell = floor(at / grid->size[0] - grid->low[0] - 0.5);
    uint32_t from = cell > 0 ? (uint32_t)(cell < grid->count[0] ? cell : grid->count[0]) : 0;
    while (from > 0 && middle(grid, 0, from - 1) > at)
        from--;
    while (from < grid->count[0] && !(middle(grid, 0, from) > at))
        from++;
    return from;
}

static void fill_lines(const crossings *list, const tn_mesh_grid *grid, uint64_t *bits)
{
    int64_t winding = 0;
    for (size_t i = 0; i + 1 < list->count; i++) {
        const crossing *from = &list->items[i], *to = &list->items[i + 1];
        winding += from->turn;
        if (to->line != from->line) {
            winding = 0;
            continue;
        }
        if (winding == 0)
            continue;
        size_t row = (size_t)from->line * grid->count[0];
        for (uint32_t cell = cell_behind(grid, from->at), end = cell_behind(grid, to->at); cell < end; cell++)
            bits[(row + cell) / 64] |= UINT64_C(1) << (row + cell) % 64;
    }
}

tn_status tn_mesh_fill_grid(const tn_mesh *mesh, const tn_mesh_grid *grid, uint64_t *bits, tn_error *error)
{
    crossings list = {0};
    tn_status status = TN_OK;
    for (uint32_t face = 0; face < mesh->face_count && status == TN_OK; face++) {
        if (face % CHECK_EVERY == 0)
            status = tn_mesh_check(mesh, error);
        if (status == TN_OK)
            status = meet_lines(mesh, face, grid, &list, error);
    }
    if (status == TN_OK && list.count > 0) {
        qsort(list.items, list.count, sizeof *list.items, by_line);
        fill_lines(&list, grid, bits);
    }
    free(list.items);
    return status;
}

/* ---- openings */

/* A side of a face, its lower vertex first. */
typedef struct side {
    uint32_t low, high;
    int32_t way; /* 1: the face goes from low to high */
} side;

static int by_ends(const void *a, const void *b)
{
    const side *one = a, *other = b;
    if (one->low != other->low)
        return one->low < other->low ? -1 : 1;
    return (one->high > other->high) - (one->high < other->high);
}

tn_status tn_mesh_opening(const tn_mesh *mesh, size_t *count, double ends[2][3], tn_error *error)
{
    size_t sides = 0;
    side *all = malloc((mesh->face_first[mesh->face_count] + (size_t)1) * sizeof *all);
    *count = 0;
    if (!all)
        return tn_fail_memory(error);
    for (size_t f = 0; f < mesh->face_count; f++) {
        for (uint32_t c = mesh->face_first[f]; c < mesh->face_first[f + 1]; c++) {
            uint32_t from = mesh->corners[c],
                     to = mesh->corners[c + 1 < mesh->face_first[f + 1] ? c + 1 : mesh->face_first[f]];
            all[sides++] = from < to ? (side){from, to, 1} : (side){to, from, -1};
        }
    }
    qsort(all, sides, sizeof *all, by_ends);
    for (size_t i = 0, next; i < sides; i = next) {
        int64_t sum = 0;
        for (next = i; next < sides && by_ends(&all[i], &all[next]) == 0; next++)
            sum += all[next].way;
        if (sum == 0)
            continue;
        if (++*count > 1)
            continue;
        memcpy(ends[0], vertex(mesh, all[i].low), sizeof ends[0]);
        memcpy(ends[1], vertex(mesh, all[i].high), sizeof ends[1]);
    }
    free(all);
    return TN_OK;
}
