/* Answers what is inside of a boundary mesh and what meets it, by a tree of its triangles; and reads the meshes that
 * rule files name. */
#include "runtime/geometry/boundary_mesh.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xxhash.h>

#include "runtime/geometry/select_nth.h"
#include "runtime/math/elementary.h"

/* ==== answers what is inside of a boundary mesh and what meets it, by a tree of its triangles */

#define LEAF_TRIANGLES 4u
#define TREE_DEPTH_MAX 64
#define TOUCH 1e-9
#define PI 3.14159265358979323846
/* A point of an edge is off by rounding: a few units in the last place of the largest coordinate. */
#define SAME 1e-14
/* The clearance grid has this many cells a side: 32^3 doubles are 256 KiB, and most vertices of a growing surface are
 * further from a boundary than a cell is wide. */
#define GRID 32

typedef struct node {
    double low[3], high[3];
    uint32_t
        first; /* a leaf's first entry of `order`; an inner node's second child (the first child follows the node) */
    uint32_t count; /* triangles of a leaf; 0: an inner node */
} node;

struct tn_boundary_mesh {
    tn_vector *corner; /* [triangle][3] */
    tn_vector *normal; /* [triangle] unit */
    uint32_t count;
    uint32_t *order; /* triangles in tree order */
    node *nodes;
    uint32_t node_count;
    bool solid;
    double touch; /* places this close are the same */
    double low[3], cell[3];
    double *clearance; /* [GRID^3] signed distance at the cell's centre */
};

void tn_boundary_mesh_free(tn_boundary_mesh *mesh)
{
    if (!mesh)
        return;
    free(mesh->corner);
    free(mesh->normal);
    free(mesh->order);
    free(mesh->nodes);
    free(mesh->clearance);
    free(mesh);
}

bool tn_boundary_mesh_is_solid(const tn_boundary_mesh *mesh)
{
    return mesh->solid;
}

/* ---- building */

static double component(tn_vector a, int k)
{
    return k == 0 ? a.x : k == 1 ? a.y : a.z;
}

static double centre(const tn_boundary_mesh *mesh, uint32_t triangle, int k)
{
    const tn_vector *c = &mesh->corner[3 * (size_t)triangle];
    return component(c[0], k) + component(c[1], k) + component(c[2], k);
}

static void bound(const tn_boundary_mesh *mesh, node *box, uint32_t begin, uint32_t end)
{
    for (int k = 0; k < 3; k++) {
        box->low[k] = INFINITY;
        box->high[k] = -INFINITY;
        for (uint32_t i = begin; i < end; i++) {
            for (int c = 0; c < 3; c++) {
                double v = component(mesh->corner[3 * (size_t)mesh->order[i] + (size_t)c], k);
                box->low[k] = tn_smaller(box->low[k], v);
                box->high[k] = tn_larger(box->high[k], v);
            }
        }
    }
}

static bool before(const void *mesh, uint32_t a, uint32_t b, int axis)
{
    double x = centre(mesh, a, axis), y = centre(mesh, b, axis);
    return x < y || (x == y && a < b);
}

static void build(tn_boundary_mesh *mesh, uint32_t begin, uint32_t end)
{
    node *here = &mesh->nodes[mesh->node_count++];
    bound(mesh, here, begin, end);
    if (end - begin <= LEAF_TRIANGLES) {
        here->first = begin;
        here->count = end - begin;
        return;
    }
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if (here->high[k] - here->low[k] > here->high[axis] - here->low[axis])
            axis = k;
    uint32_t middle = begin + (end - begin) / 2;
    tn_select_nth(mesh->order, begin, end, middle, axis, before, mesh);
    here->count = 0;
    build(mesh, begin, middle); /* halves each time: at most 32 deep */
    here->first = mesh->node_count;
    build(mesh, middle, end);
}

typedef struct edge_use {
    uint32_t from, to;
} edge_use;

static int compare_uses(const void *a, const void *b)
{
    const edge_use *x = a, *y = b;
    if (x->from != y->from)
        return x->from < y->from ? -1 : 1;
    return x->to < y->to ? -1 : x->to > y->to;
}

/* Is every edge used once in each direction? */
static tn_status find_solid(tn_boundary_mesh *mesh, const uint32_t *triangles, size_t count, tn_error *error)
{
    edge_use *uses = malloc(2 * 3 * count * sizeof *uses);
    if (!uses)
        return tn_fail_memory(error);
    edge_use *turned = uses + 3 * count;
    for (size_t i = 0; i < 3 * count; i++) {
        uint32_t from = triangles[i], to = triangles[i % 3 == 2 ? i - 2 : i + 1];
        uses[i] = (edge_use){from, to};
        turned[i] = (edge_use){to, from};
    }
    qsort(uses, 3 * count, sizeof *uses, compare_uses);
    qsort(turned, 3 * count, sizeof *turned, compare_uses);
    mesh->solid = memcmp(uses, turned, 3 * count * sizeof *uses) == 0;
    for (size_t i = 1; i < 3 * count && mesh->solid; i++)
        mesh->solid = compare_uses(&uses[i - 1], &uses[i]) != 0;
    free(uses);
    return TN_OK;
}

/* A solid wound inside out is turned: its normals point outwards. */
static void turn_outwards(tn_boundary_mesh *mesh)
{
    double volume = 0;
    for (uint32_t i = 0; i < mesh->count; i++) {
        const tn_vector *c = &mesh->corner[3 * (size_t)i];
        volume += tn_dot(c[0], tn_cross(c[1], c[2]));
    }
    if (!mesh->solid || volume >= 0)
        return;
    for (uint32_t i = 0; i < mesh->count; i++)
        mesh->normal[i] = tn_scale(mesh->normal[i], -1);
}

static double largest_coordinate(const node *box)
{
    double most = 0;
    for (int k = 0; k < 3; k++)
        most = tn_larger(most, tn_larger(fabs(box->low[k]), fabs(box->high[k])));
    return most;
}

static tn_status build_clearance(tn_boundary_mesh *mesh, tn_error *error)
{
    double *clearance = malloc(sizeof *clearance * GRID * GRID * GRID);
    if (!clearance)
        return tn_fail_memory(error);
    for (int k = 0; k < 3; k++) {
        double width = mesh->nodes[0].high[k] - mesh->nodes[0].low[k];
        mesh->low[k] = mesh->nodes[0].low[k] - width / 16 - 1e-6;
        mesh->cell[k] = (width * 9 / 8 + 2e-6) / GRID;
    }
    size_t n = 0;
    for (int z = 0; z < GRID; z++)
        for (int y = 0; y < GRID; y++)
            for (int x = 0; x < GRID; x++) {
                tn_vector p = {mesh->low[0] + (x + 0.5) * mesh->cell[0], mesh->low[1] + (y + 0.5) * mesh->cell[1],
                               mesh->low[2] + (z + 0.5) * mesh->cell[2]};
                clearance[n++] = tn_boundary_mesh_distance(mesh, p, NULL);
            }
    mesh->clearance = clearance;
    return TN_OK;
}

static tn_status take_triangles(tn_boundary_mesh *mesh, const double *positions, size_t vertex_count,
                                const uint32_t *triangles, size_t count, tn_error *error)
{
    for (size_t i = 0; i < 3 * vertex_count; i++)
        if (!isfinite(positions[i]))
            return tn_fail(error, TN_INVALID, TN_CODE_NONE,
                           "the boundary mesh has a coordinate that is not a finite number");
    for (size_t i = 0; i < count; i++) {
        tn_vector c[3];
        for (int k = 0; k < 3; k++) {
            if (triangles[3 * i + (size_t)k] >= vertex_count)
                return tn_fail(error, TN_INVALID, TN_CODE_NONE,
                               "the boundary mesh has a face with a vertex that does not exist");
            c[k] = tn_vector_at(positions + 3 * (size_t)triangles[3 * i + (size_t)k]);
        }
        tn_vector n = tn_cross(tn_sub(c[1], c[0]), tn_sub(c[2], c[0]));
        if (tn_norm(n) <= 1e-300)
            continue;
        memcpy(&mesh->corner[3 * (size_t)mesh->count], c, sizeof c);
        mesh->normal[mesh->count] = tn_normalised(n);
        mesh->order[mesh->count] = mesh->count;
        mesh->count++;
    }
    if (mesh->count == 0)
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "the boundary mesh has no face with an area");
    return TN_OK;
}

tn_status tn_boundary_mesh_new(const double *positions, size_t vertex_count, const uint32_t *triangles,
                               size_t triangle_count, tn_boundary_mesh **result, tn_error *error)
{
    *result = NULL;
    if (triangle_count > UINT32_MAX / 8)
        return tn_fail(error, TN_LIMIT, E_BOUNDARY_TOO_LARGE, "the boundary mesh has %zu triangles; the limit is %u",
                       triangle_count, UINT32_MAX / 8);
    tn_boundary_mesh *mesh = calloc(1, sizeof *mesh);
    if (!mesh)
        return tn_fail_memory(error);
    size_t room = triangle_count ? triangle_count : 1;
    mesh->corner = malloc(3 * room * sizeof *mesh->corner);
    mesh->normal = malloc(room * sizeof *mesh->normal);
    mesh->order = malloc(room * sizeof *mesh->order);
    mesh->nodes = malloc(2 * room * sizeof *mesh->nodes);
    tn_status status = TN_OK;
    if (!mesh->corner || !mesh->normal || !mesh->order || !mesh->nodes)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = take_triangles(mesh, positions, vertex_count, triangles, triangle_count, error);
    if (status == TN_OK)
        status = find_solid(mesh, triangles, triangle_count, error);
    if (status == TN_OK) {
        turn_outwards(mesh);
        build(mesh, 0, mesh->count);
        mesh->touch = SAME * largest_coordinate(&mesh->nodes[0]);
        status = build_clearance(mesh, error);
    }
    if (status != TN_OK) {
        tn_boundary_mesh_free(mesh);
        return status;
    }
    *result = mesh;
    return TN_OK;
}

/* ---- the nearest point */

static double box_distance2(const node *box, tn_vector x)
{
    double dx = tn_larger(tn_larger(box->low[0] - x.x, x.x - box->high[0]), 0);
    double dy = tn_larger(tn_larger(box->low[1] - x.y, x.y - box->high[1]), 0);
    double dz = tn_larger(tn_larger(box->low[2] - x.z, x.z - box->high[2]), 0);
    return dx * dx + dy * dy + dz * dz;
}

static tn_vector nearest_on_segment(tn_vector a, tn_vector b, tn_vector x)
{
    tn_vector d = tn_sub(b, a);
    double length2 = tn_dot(d, d), t = length2 > 0 ? tn_dot(tn_sub(x, a), d) / length2 : 0;
    return tn_along(a, d, t < 0 ? 0 : t > 1 ? 1 : t);
}

/* Within the triangle's prism (*inner) the foot of the perpendicular; otherwise the nearest point of the three edges.
 */
static tn_vector nearest_on_triangle(const tn_vector c[3], tn_vector n, tn_vector x, bool *inner)
{
    *inner = true;
    for (int k = 0; k < 3 && *inner; k++) {
        tn_vector along = tn_sub(c[(k + 1) % 3], c[k]);
        *inner = tn_dot(tn_cross(along, tn_sub(x, c[k])), n) >= 0;
    }
    if (*inner)
        return tn_along(x, n, -tn_dot(tn_sub(x, c[0]), n));
    tn_vector best = c[0];
    double best2 = INFINITY;
    for (int k = 0; k < 3; k++) {
        tn_vector p = nearest_on_segment(c[k], c[(k + 1) % 3], x), d = tn_sub(x, p);
        if (tn_dot(d, d) < best2) {
            best2 = tn_dot(d, d);
            best = p;
        }
    }
    return best;
}

/* The triangle's normal by its winding, which points inwards where the solid is wound inside out. */
static tn_vector wound_normal(const tn_vector c[3])
{
    return tn_normalised(tn_cross(tn_sub(c[1], c[0]), tn_sub(c[2], c[0])));
}

typedef struct nearest_search {
    tn_vector point;
    double distance2;
    uint32_t triangle; /* that has the point, */
    bool inner;        /* on none of its edges */
} nearest_search;

static void consider(const tn_boundary_mesh *mesh, uint32_t triangle, tn_vector x, nearest_search *search)
{
    const tn_vector *c = &mesh->corner[3 * (size_t)triangle];
    bool inner;
    tn_vector p = nearest_on_triangle(c, wound_normal(c), x, &inner), d = tn_sub(x, p);
    double d2 = tn_dot(d, d);
    if (d2 < search->distance2)
        *search = (nearest_search){p, d2, triangle, inner};
}

/* The angle that a triangle fills at a point of it; at one of its edges half a turn, 0 if the point is none of its
 * own. */
static double angle_at(const tn_vector c[3], tn_vector p, double touch)
{
    bool inner;
    for (int k = 0; k < 3; k++) {
        if (tn_norm(tn_sub(p, c[k])) > touch)
            continue;
        tn_vector u = tn_sub(c[(k + 1) % 3], c[k]), v = tn_sub(c[(k + 2) % 3], c[k]);
        return tn_atan2(tn_norm(tn_cross(u, v)), tn_dot(u, v));
    }
    for (int k = 0; k < 3; k++)
        if (tn_norm(tn_sub(p, nearest_on_segment(c[k], c[(k + 1) % 3], p))) <= touch)
            return PI;
    return tn_norm(tn_sub(p, nearest_on_triangle(c, wound_normal(c), p, &inner))) <= touch ? 2 * PI : 0;
}

/* The sum of the normals of all triangles that meet in p, each times its angle there: the angle-weighted pseudonormal
 * (Baerentzen and Aanaes, "Signed distance computation using the angle weighted pseudonormal", 2005). No plane of one
 * of these triangles says on which side of an edge or corner a place is: a sharp one has some pass on either side. */
static tn_vector pseudonormal(const tn_boundary_mesh *mesh, tn_vector p)
{
    double touch = mesh->touch;
    tn_vector sum = {0, 0, 0};
    uint32_t stack[TREE_DEPTH_MAX];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
        uint32_t at = stack[--top];
        const node *here = &mesh->nodes[at];
        if (box_distance2(here, p) > touch * touch)
            continue;
        if (!here->count) {
            stack[top++] = here->first;
            stack[top++] = at + 1;
        }
        for (uint32_t i = 0; i < here->count; i++) {
            uint32_t triangle = mesh->order[here->first + i];
            double angle = angle_at(&mesh->corner[3 * (size_t)triangle], p, touch);
            sum = tn_along(sum, mesh->normal[triangle], angle);
        }
    }
    return sum;
}

/* Is x behind the nearest point that was found? */
static bool is_inside(const tn_boundary_mesh *mesh, tn_vector x, const nearest_search *found)
{
    const tn_vector *c = &mesh->corner[3 * (size_t)found->triangle];
    if (found->inner)
        return tn_dot(tn_sub(x, c[0]), mesh->normal[found->triangle]) < 0;
    tn_vector p = found->point;
    for (int k = 0; k < 3; k++)
        if (tn_norm(tn_sub(p, c[k])) <= mesh->touch)
            p = c[k];
    return tn_dot(tn_sub(x, p), pseudonormal(mesh, p)) < 0;
}

double tn_boundary_mesh_distance(const tn_boundary_mesh *mesh, tn_vector x, tn_vector *nearest)
{
    nearest_search search = {.distance2 = INFINITY};
    uint32_t stack[TREE_DEPTH_MAX];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
        uint32_t at = stack[--top];
        const node *here = &mesh->nodes[at];
        if (box_distance2(here, x) > search.distance2 * (1 + 1e-10) + 1e-24)
            continue;
        if (here->count) {
            for (uint32_t i = 0; i < here->count; i++)
                consider(mesh, mesh->order[here->first + i], x, &search);
            continue;
        }
        uint32_t first = at + 1, second = here->first;
        if (box_distance2(&mesh->nodes[first], x) > box_distance2(&mesh->nodes[second], x)) {
            first = here->first;
            second = at + 1;
        }
        stack[top++] = second;
        stack[top++] = first;
    }
    if (nearest)
        *nearest = search.point;
    double d = sqrt(search.distance2);
    return mesh->solid && is_inside(mesh, x, &search) ? -d : d;
}

bool tn_boundary_mesh_clear(const tn_boundary_mesh *mesh, tn_vector x, double reach, int *sign)
{
    double box2 = box_distance2(&mesh->nodes[0], x);
    if (box2 > 0 && sqrt(box2) > reach) {
        *sign = 1;
        return true;
    }
    double u = (x.x - mesh->low[0]) / mesh->cell[0], v = (x.y - mesh->low[1]) / mesh->cell[1],
           w = (x.z - mesh->low[2]) / mesh->cell[2];
    if (!(u >= 0 && u < GRID && v >= 0 && v < GRID && w >= 0 && w < GRID))
        return false;
    int i = (int)u, j = (int)v, k = (int)w;
    double clearance = mesh->clearance[(k * GRID + j) * GRID + i];
    tn_vector off = {(u - i - 0.5) * mesh->cell[0], (v - j - 0.5) * mesh->cell[1], (w - k - 0.5) * mesh->cell[2]};
    *sign = clearance < 0 ? -1 : 1;
    return fabs(clearance) - tn_norm(off) > reach + TOUCH;
}

/* ---- the first triangle that a segment meets */

typedef struct segment {
    tn_vector x, d;
    double inverse[3];
    bool inside;
    uint32_t except;
} segment;

static bool box_meets(const node *box, const segment *s, double until)
{
    double enter = 0, leave = until;
    for (int k = 0; k < 3; k++) {
        double x = component(s->x, k), low = box->low[k] - TOUCH, high = box->high[k] + TOUCH;
        if (component(s->d, k) == 0) {
            if (x < low || x > high)
                return false;
            continue;
        }
        double t0 = (low - x) * s->inverse[k], t1 = (high - x) * s->inverse[k];
        enter = tn_larger(enter, tn_smaller(t0, t1));
        leave = tn_smaller(leave, tn_larger(t0, t1));
    }
    return enter <= leave;
}

static bool triangle_meets(const tn_boundary_mesh *mesh, uint32_t triangle, const segment *s, tn_mesh_hit *hit)
{
    const tn_vector *c = &mesh->corner[3 * (size_t)triangle];
    tn_vector n = mesh->normal[triangle];
    double height = tn_dot(tn_sub(s->x, c[0]), n);
    if (mesh->solid ? s->inside : height < 0) {
        n = tn_scale(n, -1);
        height = -height;
    }
    double along = tn_dot(s->d, n);
    if (along >= 0 || height < -TOUCH)
        return false;
    double t = tn_larger(0, height) / -along;
    if (!(t < 1))
        return false;
    tn_vector p = tn_along(s->x, s->d, t), geometric = tn_cross(tn_sub(c[1], c[0]), tn_sub(c[2], c[0]));
    double area2 = tn_dot(geometric, geometric);
    for (int k = 0; k < 3; k++) {
        tn_vector edge = tn_sub(c[(k + 1) % 3], c[k]);
        /* a little wider than the triangle, so that nothing slips between two */
        if (tn_dot(tn_cross(edge, tn_sub(p, c[k])), geometric) < -1e-9 * area2)
            return false;
    }
    *hit = (tn_mesh_hit){t, n, triangle};
    return true;
}

bool tn_boundary_mesh_hit(const tn_boundary_mesh *mesh, bool inside, tn_vector x, tn_vector d, uint32_t except,
                          tn_mesh_hit *best)
{
    segment s = {x, d, {1 / d.x, 1 / d.y, 1 / d.z}, inside, except};
    bool found = false;
    uint32_t stack[TREE_DEPTH_MAX];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
        uint32_t at = stack[--top];
        const node *here = &mesh->nodes[at];
        if (!box_meets(here, &s, found ? best->t : 1))
            continue;
        if (!here->count) {
            stack[top++] = here->first;
            stack[top++] = at + 1;
            continue;
        }
        for (uint32_t i = 0; i < here->count; i++) {
            uint32_t triangle = mesh->order[here->first + i];
            tn_mesh_hit hit;
            if (triangle == except || !triangle_meets(mesh, triangle, &s, &hit))
                continue;
            if (found && (hit.t > best->t || (hit.t == best->t && hit.triangle > best->triangle)))
                continue;
            *best = hit;
            found = true;
        }
    }
    return found;
}

const tn_vector *tn_boundary_mesh_corners(const tn_boundary_mesh *mesh, size_t *count)
{
    *count = mesh->count;
    return mesh->corner;
}

uint64_t tn_boundary_mesh_hash(const tn_boundary_mesh *mesh, uint64_t seed)
{
    return XXH3_64bits_withSeed(mesh->corner, 3 * (size_t)mesh->count * sizeof *mesh->corner, seed);
}

/* ==== finds and reads the meshes that rule files name */

/* name, told from the folder of a file; the caller frees it. */
static char *beside(const char *file, const char *name)
{
    const char *slash = name[0] == '/' ? NULL : strrchr(file, '/');
    size_t folder = slash ? (size_t)(slash - file) + 1 : 0, size = strlen(name) + 1;
    char *path = malloc(folder + size);
    if (path) {
        memcpy(path, file, folder);
        memcpy(path + folder, name, size);
    }
    return path;
}

static tn_status read_mesh(const tn_mesh_reader *reader, const char *path, tn_boundary_mesh **result, tn_error *error)
{
    tn_mesh mesh;
    tn_status status = reader->read(reader->context, path, &mesh, error);
    if (status != TN_OK)
        return status;
    status = tn_mesh_triangulate(&mesh, error);
    if (status == TN_OK)
        status = tn_boundary_mesh_new(mesh.positions, mesh.vertex_count, mesh.corners, mesh.face_count, result, error);
    tn_mesh_clear(&mesh);
    return status;
}

tn_status tn_boundary_mesh_find(const tn_mesh_reader *reader, const char *opened, const char *source, const char *name,
                                const char *what, const char *rules, tn_boundary_mesh **result, tn_error *error)
{
    char *near = beside(opened, name), *once = beside(source, name);
    tn_status status = near && once ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && access(near, F_OK) == 0) {
        status = read_mesh(reader, near, result, error);
    } else if (status == TN_OK && access(once, F_OK) == 0) {
        status = read_mesh(reader, once, result, error);
    } else if (status == TN_OK) {
        status = tn_fail(error, TN_IO, E_CANNOT_READ, "there is no mesh %.200s", near);
        if (strcmp(near, once) == 0)
            tn_error_help(error, "a %s's path starts at the folder of the %s that names it", what, rules);
        else
            tn_error_help(error, "put it there; where the %s was compiled it was %.200s", rules, once);
    }
    free(near);
    free(once);
    return status;
}
