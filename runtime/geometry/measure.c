/* Measures a closed mesh of triangles: by the tetrahedra that its triangles make with the origin; and its walls, by
 * shooting inward from each triangle. */
#include "runtime/geometry/measure.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/geometry/boundary_mesh.h"

/* ---- parts */

static uint32_t find_part(uint32_t *part, uint32_t v)
{
    while (part[v] != v) {
        part[v] = part[part[v]];
        v = part[v];
    }
    return v;
}

static void join_vertices(const tn_mesh *mesh, uint32_t *part)
{
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        part[v] = v;
    for (size_t i = 0; i < 3 * mesh->face_count; i++) {
        uint32_t a = find_part(part, mesh->corners[i]);
        uint32_t b = find_part(part, mesh->corners[i % 3 == 2 ? i - 2 : i + 1]);
        if (a != b)
            part[a > b ? a : b] = a > b ? b : a;
    }
}

static void widen(double low[3], double high[3], const double *p)
{
    for (int k = 0; k < 3; k++) {
        low[k] = fmin(low[k], p[k]);
        high[k] = fmax(high[k], p[k]);
    }
}

static tn_status measure_parts(const tn_mesh *mesh, double small, tn_mesh_measures *m, tn_error *error)
{
    uint32_t *part = malloc((mesh->vertex_count + 1) * sizeof *part);
    double(*box)[6] = malloc((mesh->vertex_count + 1) * sizeof *box);
    if (!part || !box) {
        free(part);
        free(box);
        return tn_fail_memory(error);
    }
    join_vertices(mesh, part);
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        const double *p = mesh->positions + 3 * (size_t)v;
        uint32_t own = find_part(part, v);
        if (own == v) /* the lowest of its part comes first */
            memcpy(box[v], (double[]){p[0], p[1], p[2], p[0], p[1], p[2]}, sizeof box[v]);
        widen(box[own], box[own] + 3, p);
    }
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        if (part[v] != v)
            continue;
        m->parts++;
        const double *b = box[v];
        bool is_small = b[3] - b[0] < small && b[4] - b[1] < small && b[5] - b[2] < small;
        if (is_small && m->small_parts++ == 0)
            memcpy(m->small_part, mesh->positions + 3 * (size_t)v, sizeof m->small_part);
    }
    free(part);
    free(box);
    return TN_OK;
}

/* ---- sums */

static double area_of(const double *a, const double *b, const double *c)
{
    double u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
    }
    double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    return sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
}

static double six_volumes(const double *a, const double *b, const double *c)
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* Adds a tetrahedron's integrals of x and of x x' (Tonon, "Explicit exact formulas for the 3-D tetrahedron inertia
 * tensor", 2004). */
static void add_tetrahedron(const double *a, const double *b, const double *c, double first[3], double second[3][3])
{
    double v = six_volumes(a, b, c), sum[3];
    for (int i = 0; i < 3; i++) {
        sum[i] = a[i] + b[i] + c[i];
        first[i] += v * sum[i] / 24;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            second[i][j] += v * (sum[i] * sum[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]) / 120;
}

static void finish_inertia(double second[3][3], tn_mesh_measures *m)
{
    double about[3][3], trace = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            about[i][j] = second[i][j] - m->volume * m->centroid[i] * m->centroid[j];
    for (int i = 0; i < 3; i++)
        trace += about[i][i];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m->inertia[i][j] = (i == j ? trace : 0) - about[i][j];
}

tn_status tn_mesh_measure(const tn_mesh *mesh, double small, tn_mesh_measures *m, tn_error *error)
{
    double sixfold = 0, first[3] = {0}, second[3][3] = {{0}};
    *m = (tn_mesh_measures){0};
    if (mesh->vertex_count == 0)
        return TN_OK;
    memcpy(m->low, mesh->positions, sizeof m->low);
    memcpy(m->high, mesh->positions, sizeof m->high);
    for (size_t v = 0; v < mesh->vertex_count; v++)
        widen(m->low, m->high, mesh->positions + 3 * v);
    for (size_t f = 0; f < mesh->face_count; f++) {
        const double *p[3];
        for (int k = 0; k < 3; k++)
            p[k] = mesh->positions + 3 * (size_t)mesh->corners[3 * f + (size_t)k];
        sixfold += six_volumes(p[0], p[1], p[2]);
        m->area += area_of(p[0], p[1], p[2]);
        add_tetrahedron(p[0], p[1], p[2], first, second);
    }
    m->volume = sixfold / 6;
    for (int i = 0; i < 3 && m->volume != 0; i++)
        m->centroid[i] = first[i] / m->volume;
    finish_inertia(second, m);
    m->euler = (int64_t)mesh->vertex_count - (int64_t)mesh->face_count / 2;
    return measure_parts(mesh, small, m, error);
}

/* ---- walls */

#define SHARE 0.01 /* of the area, that may be thinner */

typedef struct wall {
    double thickness, area;
} wall;

static int thinner(const void *left, const void *right)
{
    const wall *a = left, *b = right;
    return a->thickness < b->thickness ? -1 : a->thickness > b->thickness;
}

static double diagonal_of(const tn_mesh *mesh)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, sum = 0;
    for (size_t v = 0; v < 3 * mesh->vertex_count; v++) {
        low[v % 3] = fmin(low[v % 3], mesh->positions[v]);
        high[v % 3] = fmax(high[v % 3], mesh->positions[v]);
    }
    for (int k = 0; k < 3; k++)
        sum += (high[k] - low[k]) * (high[k] - low[k]);
    return sqrt(sum);
}

/* From just behind the triangle's middle to the first triangle that is met from inside. */
static wall measure_wall(const tn_mesh *mesh, const tn_boundary_mesh *boundary, uint32_t triangle, double reach)
{
    tn_vector a = tn_vector_at(mesh->positions + 3 * (size_t)mesh->corners[3 * triangle]),
              b = tn_vector_at(mesh->positions + 3 * (size_t)mesh->corners[3 * triangle + 1]),
              c = tn_vector_at(mesh->positions + 3 * (size_t)mesh->corners[3 * triangle + 2]);
    tn_vector normal = tn_cross(tn_sub(b, a), tn_sub(c, a));
    double length = tn_norm(normal);
    wall w = {INFINITY, length / 2};
    if (!(length > 0))
        return w;
    tn_vector middle = tn_scale(tn_add(tn_add(a, b), c), 1.0 / 3);
    tn_vector inward = tn_scale(normal, -reach / length);
    tn_vector start = tn_add(middle, tn_scale(inward, 1e-9));
    tn_mesh_hit hit;
    if (tn_boundary_mesh_hit(boundary, true, start, inward, TN_NO_TRIANGLE, &hit))
        w.thickness = (hit.t + 1e-9) * reach;
    return w;
}

static double hundredth_of(const wall *walls, size_t count)
{
    double total = 0, thinner_area = 0;
    for (size_t i = 0; i < count; i++)
        total += walls[i].area;
    for (size_t i = 0; i < count; i++) {
        thinner_area += walls[i].area;
        if (thinner_area >= SHARE * total)
            return walls[i].thickness;
    }
    return 0;
}

tn_status tn_mesh_thickness(const tn_mesh *mesh, tn_thickness *thickness, tn_error *error)
{
    tn_boundary_mesh *boundary = NULL;
    *thickness = (tn_thickness){0, 0};
    if (mesh->face_count == 0)
        return TN_OK;
    wall *walls = malloc(mesh->face_count * sizeof *walls);
    tn_status status = walls ? tn_boundary_mesh_new(mesh->positions, mesh->vertex_count, mesh->corners,
                                                    mesh->face_count, &boundary, error)
                             : tn_fail_memory(error);
    double reach = 2 * diagonal_of(mesh);
    for (size_t i = 0; i < mesh->face_count && status == TN_OK; i++)
        walls[i] = measure_wall(mesh, boundary, (uint32_t)i, reach);
    if (status == TN_OK) {
        qsort(walls, mesh->face_count, sizeof *walls, thinner);
        *thickness = (tn_thickness){walls[0].thickness, hundredth_of(walls, mesh->face_count)};
    }
    tn_boundary_mesh_free(boundary);
    free(walls);
    return status;
}
