/* Counts the triangles that cross: pairs are looked for in cubes as large as the largest triangle. */
#include "runtime/geometry/crossing.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/base/watch.h"
#include "runtime/geometry/vector.h"

/* (7 + 56 e) e with e = 2^-53: what rounding can make of the determinant of `side_of`. Source: Shewchuk, "Adaptive
 * Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997, o3derrboundA. */
#define ROUNDING 7.771561172376103e-16

typedef struct box {
    tn_vector low, high;
} box;

/* A triangle in one of the cubes that its box reaches. */
typedef struct entry {
    uint64_t cube;
    uint32_t face;
} entry;

/* ---- two triangles */

/* The side of the plane through a, b and c on which d lies: 1 or -1, and 0 if that is not certain. */
static int side_of(tn_vector a, tn_vector b, tn_vector c, tn_vector d)
{
    tn_vector p = tn_sub(a, d), q = tn_sub(b, d), r = tn_sub(c, d);
    double det = p.x * (q.y * r.z - q.z * r.y) + q.x * (r.y * p.z - r.z * p.y) + r.x * (p.y * q.z - p.z * q.y);
    double size = fabs(p.x) * (fabs(q.y * r.z) + fabs(q.z * r.y)) + fabs(q.x) * (fabs(r.y * p.z) + fabs(r.z * p.y)) +
                  fabs(r.x) * (fabs(p.y * q.z) + fabs(p.z * q.y));
    return det > ROUNDING * size ? 1 : det < -ROUNDING * size ? -1 : 0;
}

/* Does the side from p to q run through the inside of the triangle? */
static bool pierces(tn_vector p, tn_vector q, const tn_vector t[3])
{
    int from = side_of(t[0], t[1], t[2], p);
    if (from == 0 || side_of(t[0], t[1], t[2], q) != -from)
        return false;
    int turn = side_of(p, q, t[0], t[1]);
    return turn != 0 && side_of(p, q, t[1], t[2]) == turn && side_of(p, q, t[2], t[0]) == turn;
}

/* The corners of a that are no corners of b, as bits. */
static unsigned own_corners(const uint32_t *a, const uint32_t *b)
{
    unsigned own = 0;
    for (unsigned i = 0; i < 3; i++)
        own |= a[i] != b[0] && a[i] != b[1] && a[i] != b[2] ? 1u << i : 0;
    return own;
}

/* Does a side of p, of corners of its own, run through q? */
static bool any_pierces(const tn_vector p[3], unsigned own, const tn_vector q[3])
{
    for (unsigned i = 0; i < 3; i++)
        if (own >> i & 1 && own >> ((i + 1) % 3) & 1 && pierces(p[i], p[(i + 1) % 3], q))
            return true;
    return false;
}

static void corners_of(const tn_mesh *mesh, uint32_t face, tn_vector at[3])
{
    for (uint32_t k = 0; k < 3; k++)
        at[k] = tn_vector_at(mesh->positions + 3 * (size_t)mesh->corners[3 * (size_t)face + k]);
}

static bool cross(const tn_mesh *mesh, uint32_t a, uint32_t b)
{
    const uint32_t *ca = mesh->corners + 3 * (size_t)a, *cb = mesh->corners + 3 * (size_t)b;
    tn_vector p[3], q[3];
    corners_of(mesh, a, p);
    corners_of(mesh, b, q);
    return any_pierces(p, own_corners(ca, cb), q) || any_pierces(q, own_corners(cb, ca), p);
}

/* ---- cubes */

static box box_of(const tn_mesh *mesh, uint32_t face)
{
    tn_vector at[3];
    corners_of(mesh, face, at);
    box b = {at[0], at[0]};
    for (int k = 1; k < 3; k++) {
        b.low = (tn_vector){fmin(b.low.x, at[k].x), fmin(b.low.y, at[k].y), fmin(b.low.z, at[k].z)};
        b.high = (tn_vector){fmax(b.high.x, at[k].x), fmax(b.high.y, at[k].y), fmax(b.high.z, at[k].z)};
    }
    return b;
}

static bool boxes_meet(const box *a, const box *b)
{
    return a->low.x <= b->high.x && b->low.x <= a->high.x && a->low.y <= b->high.y && b->low.y <= a->high.y &&
           a->low.z <= b->high.z && b->low.z <= a->high.z;
}

/* The cube at these numbers; far apart ones may share a key, which costs time only. */
static uint64_t cube_at(int64_t x, int64_t y, int64_t z)
{
    return ((uint64_t)x & 0x1fffff) | ((uint64_t)y & 0x1fffff) << 21 | ((uint64_t)z & 0x1fffff) << 42;
}

static uint64_t cube_of(tn_vector at, double side)
{
    return cube_at((int64_t)floor(at.x / side), (int64_t)floor(at.y / side), (int64_t)floor(at.z / side));
}

static int by_cube(const void *left, const void *right)
{
    const entry *a = left, *b = right;
    return a->cube != b->cube ? (a->cube < b->cube ? -1 : 1) : (a->face > b->face) - (a->face < b->face);
}

/* Puts the triangle into the cubes that its box reaches: 1 to 8. */
static size_t put(const box *b, double side, uint32_t face, entry *to)
{
    size_t count = 0;
    for (int64_t z = (int64_t)floor(b->low.z / side); z <= (int64_t)floor(b->high.z / side); z++)
        for (int64_t y = (int64_t)floor(b->low.y / side); y <= (int64_t)floor(b->high.y / side); y++)
            for (int64_t x = (int64_t)floor(b->low.x / side); x <= (int64_t)floor(b->high.x / side); x++)
                to[count++] = (entry){cube_at(x, y, z), face};
    return count;
}

/* The pairs of a cube; a pair that shares several cubes is of the one where both boxes have begun. */
static uint64_t count_in_cube(const tn_mesh *mesh, const box *boxes, const entry *entries, size_t count, double side)
{
    uint64_t crossing = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t k = i + 1; k < count; k++) {
            const box *a = &boxes[entries[i].face], *b = &boxes[entries[k].face];
            tn_vector both = {fmax(a->low.x, b->low.x), fmax(a->low.y, b->low.y), fmax(a->low.z, b->low.z)};
            if (boxes_meet(a, b) && cube_of(both, side) == entries[i].cube)
                crossing += cross(mesh, entries[i].face, entries[k].face);
        }
    return crossing;
}

static double largest_of(tn_vector v)
{
    return fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z)));
}

/* Not so small that the cubes could not be numbered. */
static double largest_side(const box *boxes, size_t count)
{
    double side = 1e-300, reach = 0;
    for (size_t f = 0; f < count; f++) {
        side = fmax(side, largest_of(tn_sub(boxes[f].high, boxes[f].low)));
        reach = fmax(reach, fmax(largest_of(boxes[f].low), largest_of(boxes[f].high)));
    }
    return fmax(side * (1 + 1e-9), reach * 0x1p-40);
}

tn_status tn_mesh_crossings(const tn_mesh *mesh, uint64_t *count, tn_error *error)
{
    size_t entry_count = 0, faces = mesh->face_count;
    box *boxes = malloc((faces + 1) * sizeof *boxes);
    entry *entries = malloc((8 * faces + 1) * sizeof *entries);
    tn_status status = boxes && entries ? TN_OK : tn_fail_memory(error);
    *count = 0;
    if (status == TN_OK) {
        for (uint32_t f = 0; f < faces; f++)
            boxes[f] = box_of(mesh, f);
        double side = largest_side(boxes, faces);
        for (uint32_t f = 0; f < faces; f++)
            entry_count += put(&boxes[f], side, f, entries + entry_count);
        qsort(entries, entry_count, sizeof *entries, by_cube);
        for (size_t i = 0, end; i < entry_count && status == TN_OK; i = end) {
            for (end = i; end < entry_count && entries[end].cube == entries[i].cube;)
                end++;
            *count += count_in_cube(mesh, boxes, entries + i, end - i, side);
            status = tn_watch_stopped_at(mesh->watch, i) ? tn_fail_stopped(mesh->watch, error) : TN_OK;
        }
    }
    free(boxes);
    free(entries);
    return status;
}
