/* Pairs the edges of triangles, and finds those at which a mesh bends, or one group meets another. */
#include "runtime/geometry/edges.h"

#include <math.h>
#include <stdlib.h>

/* ---- pairs the edges of triangles that have the same two vertices, by sorting */

typedef struct side {
    uint32_t low, high; /* vertices */
    uint32_t corner;
} side;

static int by_edge(const void *a, const void *b)
{
    const side *x = a, *y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    if (x->high != y->high)
        return x->high < y->high ? -1 : 1;
    return x->corner < y->corner ? -1 : x->corner > y->corner;
}

static void pair_sides(const side *sides, size_t count, uint32_t *twins)
{
    for (size_t i = 0; i + 1 < count; i++) {
        if (sides[i].low != sides[i + 1].low || sides[i].high != sides[i + 1].high)
            continue;
        twins[sides[i].corner] = sides[i + 1].corner;
        twins[sides[i + 1].corner] = sides[i].corner;
        i++;
    }
}

uint32_t *tn_mesh_twins(const tn_mesh *mesh)
{
    size_t count = 3 * mesh->face_count;
    side *sides = malloc((count + 1) * sizeof *sides);
    uint32_t *twins = malloc((count + 1) * sizeof *twins);
    if (!sides || !twins) {
        free(sides);
        free(twins);
        return NULL;
    }
    for (size_t c = 0; c < count; c++) {
        uint32_t a = mesh->corners[c], b = mesh->corners[c % 3 == 2 ? c - 2 : c + 1];
        sides[c] = (side){a < b ? a : b, a < b ? b : a, (uint32_t)c};
        twins[c] = TN_NO_TWIN;
    }
    qsort(sides, count, sizeof *sides, by_edge);
    pair_sides(sides, count, twins);
    free(sides);
    return twins;
}

/* ---- finds the edges at which a mesh of triangles bends, or one group meets another */

/* Triangles whose normals have a product above this lie in one plane: they are not exactly so after rounding. */
#define FLAT (1 - 1e-9)

/* A triangle that is less high than this share of the mesh is a line, and says nothing of a plane. */
#define THIN 1e-7

/* A row of so many thin triangles side by side is gone over. */
enum { THIN_ROW_MAX = 16 };

typedef struct creasing {
    const tn_mesh *mesh;
    const uint32_t *twins;
    double thin; /* how high a triangle is that says nothing */
} creasing;

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static uint32_t next_corner(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

static double squared_length(const tn_mesh *mesh, uint32_t corner)
{
    const double *a = mesh->positions + 3 * (size_t)mesh->corners[corner],
                 *b = mesh->positions + 3 * (size_t)mesh->corners[next_corner(corner)];
    const double along[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    return dot(along, along);
}

static bool is_thin(const creasing *c, uint32_t face)
{
    double n[3], longest = 0;
    tn_mesh_face_normal(c->mesh, c->mesh->corners + 3 * (size_t)face, 3, n);
    for (uint32_t i = 3 * face; i < 3 * face + 3; i++)
        longest = fmax(longest, squared_length(c->mesh, i));
    return dot(n, n) < longest * c->thin * c->thin; /* the normal is as long as the triangle is large, twice */
}

/* The first triangle from there on that is not thin, over the long sides of those that are. TN_NO_TWIN: the mesh ends.
 * corner: of the side by which one comes. */
static uint32_t look_through(const creasing *c, uint32_t corner)
{
    for (int i = 0; i < THIN_ROW_MAX && corner != TN_NO_TWIN && is_thin(c, corner / 3); i++) {
        uint32_t one = next_corner(corner), other = next_corner(one);
        corner = c->twins[squared_length(c->mesh, one) > squared_length(c->mesh, other) ? one : other];
    }
    return corner == TN_NO_TWIN ? TN_NO_TWIN : corner / 3;
}

static bool bends(const tn_mesh *mesh, uint32_t face, uint32_t other)
{
    double n[3], m[3];
    if (mesh->face_group && mesh->face_group[face] != mesh->face_group[other])
        return true;
    tn_mesh_face_normal(mesh, mesh->corners + 3 * (size_t)face, 3, n);
    tn_mesh_face_normal(mesh, mesh->corners + 3 * (size_t)other, 3, m);
    return !(dot(n, m) > FLAT * sqrt(dot(n, n) * dot(m, m)));
}

static bool is_crease(const creasing *c, uint32_t corner)
{
    uint32_t twin = c->twins[corner];
    if (twin == TN_NO_TWIN)
        return true;
    uint32_t face = look_through(c, corner), other = look_through(c, twin);
    return face == TN_NO_TWIN || other == TN_NO_TWIN || bends(c->mesh, face, other);
}

/* The longest side of the box around the mesh, wherever that lies. */
static double size_of(const tn_mesh *mesh)
{
    double size = 0;
    for (size_t k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < mesh->face_count * 3; i++) {
            low = fmin(low, mesh->positions[3 * (size_t)mesh->corners[i] + k]);
            high = fmax(high, mesh->positions[3 * (size_t)mesh->corners[i] + k]);
        }
        size = fmax(size, high - low);
    }
    return size;
}

tn_status tn_mesh_creases(const tn_mesh *mesh, bool **creases, tn_error *error)
{
    size_t count = 3 * mesh->face_count;
    uint32_t *twins = tn_mesh_twins(mesh);
    const creasing c = {mesh, twins, THIN * size_of(mesh)};
    *creases = malloc(count + 1);
    if (!twins || !*creases) {
        free(twins);
        free(*creases);
        *creases = NULL;
        return tn_fail_memory(error);
    }
    for (uint32_t i = 0; i < count; i++)
        (*creases)[i] = is_crease(&c, i);
    free(twins);
    return TN_OK;
}
