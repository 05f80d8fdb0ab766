/* Keeps meshes as arrays. */
#include "runtime/geometry/mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/hash_table.h"
#include "runtime/base/watch.h"

/* ==== keeps meshes as arrays */

tn_status tn_mesh_check(const tn_mesh *mesh, tn_error *error)
{
    return tn_watch_check(mesh->watch, error);
}

void tn_mesh_clear(tn_mesh *mesh)
{
    free(mesh->positions);
    free(mesh->face_first);
    free(mesh->corners);
    free(mesh->face_group);
    free(mesh->group_names);
    free(mesh->lines);
    free(mesh->line_group);
    *mesh = (tn_mesh){0};
}

tn_status tn_mesh_new(size_t vertices, size_t faces, size_t corners, tn_mesh *mesh, tn_error *error)
{
    *mesh = (tn_mesh){.vertex_count = vertices, .face_count = faces};
    mesh->positions = malloc((3 * vertices + 1) * sizeof *mesh->positions);
    mesh->face_first = malloc((faces + 1) * sizeof *mesh->face_first);
    mesh->corners = malloc((corners + 1) * sizeof *mesh->corners);
    if (mesh->positions && mesh->face_first && mesh->corners)
        return TN_OK;
    tn_mesh_clear(mesh);
    return tn_fail_memory(error);
}

/* A copy of an array; NULL for NULL. Sets *failed where out of memory. */
static void *copy_array(const void *array, size_t size, bool *failed)
{
    void *copy = array ? malloc(size + 1) : NULL;
    *failed |= array && !copy;
    if (copy && size)
        memcpy(copy, array, size);
    return copy;
}

tn_status tn_mesh_copy(const tn_mesh *mesh, tn_mesh *copy, tn_error *error)
{
    bool failed = false;
    size_t corners = mesh->face_count ? mesh->face_first[mesh->face_count] : 0;
    *copy = *mesh;
    copy->positions = copy_array(mesh->positions, 3 * mesh->vertex_count * sizeof *mesh->positions, &failed);
    copy->face_first = copy_array(mesh->face_first, (mesh->face_count + 1) * sizeof *mesh->face_first, &failed);
    copy->corners = copy_array(mesh->corners, corners * sizeof *mesh->corners, &failed);
    copy->face_group = copy_array(mesh->face_group, mesh->face_count * sizeof *mesh->face_group, &failed);
    copy->group_names = copy_array(mesh->group_names, mesh->group_count * sizeof *mesh->group_names, &failed);
    copy->lines = copy_array(mesh->lines, 2 * mesh->line_count * sizeof *mesh->lines, &failed);
    copy->line_group = copy_array(mesh->line_group, mesh->line_count * sizeof *mesh->line_group, &failed);
    if (!failed)
        return TN_OK;
    tn_mesh_clear(copy);
    return tn_fail_memory(error);
}

static const double *place(const tn_mesh *mesh, uint32_t vertex)
{
    return mesh->positions + 3 * (size_t)vertex;
}

void tn_mesh_face_normal(const tn_mesh *mesh, const uint32_t *corners, uint32_t count, double n[3])
{
    const double *first = place(mesh, corners[0]);
    n[0] = n[1] = n[2] = 0;
    for (uint32_t i = 1; i + 1 < count; i++) {
        const double *p = place(mesh, corners[i]), *q = place(mesh, corners[i + 1]);
        double a[3], b[3];
        for (int k = 0; k < 3; k++) {
            a[k] = p[k] - first[k];
            b[k] = q[k] - first[k];
        }
        n[0] += a[1] * b[2] - a[2] * b[1];
        n[1] += a[2] * b[0] - a[0] * b[2];
        n[2] += a[0] * b[1] - a[1] * b[0];
    }
}

/* ---- normals */

tn_status tn_mesh_normals(const tn_mesh *mesh, double **normals, tn_error *error)
{
    double *sums = calloc(3 * mesh->vertex_count + 1, sizeof *sums);
    if (!sums)
        return tn_fail_memory(error);
    for (size_t f = 0; f < mesh->face_count; f++) {
        double n[3];
        uint32_t first = mesh->face_first[f], end = mesh->face_first[f + 1];
        tn_mesh_face_normal(mesh, mesh->corners + first, end - first, n);
        for (uint32_t c = first; c < end; c++)
            for (int k = 0; k < 3; k++)
                sums[3 * (size_t)mesh->corners[c] + (size_t)k] += n[k];
    }
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        double *n = sums + 3 * v, length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3; k++)
            n[k] = length > 1e-300 ? n[k] / length : 0;
    }
    *normals = sums;
    return TN_OK;
}

/* ---- welding */

static uint64_t hash_place(const double *p)
{
    uint64_t hash = 0;
    for (int k = 0; k < 3; k++) {
        double c = p[k] == 0 ? 0 : p[k]; /* the two zeros are one place */
        uint64_t bits;
        memcpy(&bits, &c, sizeof bits);
        hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

typedef struct wanted_place {
    const tn_mesh *mesh;
    const double *at;
} wanted_place;

static bool is_at(const void *context, uint32_t vertex)
{
    const wanted_place *w = context;
    const double *p = w->at, *q = place(w->mesh, vertex);
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

/* For each vertex the first one at its place. */
static tn_status find_first(const tn_mesh *mesh, uint32_t *first, tn_error *error)
{
    tn_hash_table index = {0};
    tn_status status = tn_hash_reserve(&index, mesh->vertex_count, error);
    for (uint32_t v = 0; v < mesh->vertex_count && status == TN_OK; v++) {
        wanted_place wanted = {mesh, place(mesh, v)};
        first[v] = v;
        status = tn_hash_enter(&index, hash_place(wanted.at), is_at, &wanted, &first[v], error);
    }
    tn_hash_clear(&index);
    return status;
}

/* Without corners that repeat the one before; false if fewer than three remain. */
static bool weld_face(tn_mesh *mesh, uint32_t first, uint32_t end, const uint32_t *number, uint32_t *at)
{
    uint32_t begin = *at;
    for (uint32_t c = first; c < end; c++) {
        uint32_t v = number[mesh->corners[c]];
        if (*at == begin || mesh->corners[*at - 1] != v)
            mesh->corners[(*at)++] = v;
    }
    while (*at > begin + 1 && mesh->corners[*at - 1] == mesh->corners[begin])
        (*at)--;
    if (*at - begin >= 3)
        return true;
    *at = begin;
    return false;
}

tn_status tn_mesh_weld(tn_mesh *mesh, tn_error *error)
{
    uint32_t *first = malloc((mesh->vertex_count + 1) * sizeof *first);
    if (!first)
        return tn_fail_memory(error);
    tn_status status = find_first(mesh, first, error);
    if (status != TN_OK) {
        free(first);
        return status;
    }
    uint32_t kept = 0;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        if (first[v] != v) {
            first[v] = first[first[v]]; /* an earlier vertex: it has its new number */
            continue;
        }
        memmove(mesh->positions + 3 * (size_t)kept, place(mesh, v), 3 * sizeof(double));
        first[v] = kept++;
    }
    mesh->vertex_count = kept;
    uint32_t at = 0, begin = 0, next = mesh->face_first[0];
    size_t faces = 0;
    for (size_t f = 0; f < mesh->face_count; f++) {
        uint32_t start = next;
        next = mesh->face_first[f + 1]; /* before its slot is written */
        if (!weld_face(mesh, start, next, first, &at))
            continue;
        if (mesh->face_group)
            mesh->face_group[faces] = mesh->face_group[f];
        mesh->face_first[faces++] = begin;
        begin = at;
    }
    mesh->face_first[faces] = at;
    mesh->face_count = faces;
    free(first);
    return TN_OK;
}

void tn_group_colour(uint32_t group, unsigned char rgb[3])
{
    /* Okabe and Ito's colours, which all readers can tell apart, without black and yellow */
    static const unsigned char colours[][3] = {{0, 114, 178},  {213, 94, 0},  {0, 158, 115}, {204, 121, 167},
                                               {86, 180, 233}, {230, 159, 0}, {120, 94, 60}};
    const uint32_t count = sizeof colours / sizeof *colours;
    const unsigned char *c = colours[group % count];
    for (int k = 0; k < 3; k++) { /* then all of them darker, then lighter */
        uint32_t round = group / count % 3;
        rgb[k] = (unsigned char)(round == 0 ? c[k] : round == 1 ? c[k] / 2 : (c[k] + 255) / 2);
    }
}

/* ==== moves vertices that share a place apart, for files that tell vertices by their places only */

typedef struct placed {
    double at[3];
    uint32_t vertex;
} placed;

static int by_place(const void *a, const void *b)
{
    const placed *p = a, *q = b;
    for (int k = 0; k < 3; k++)
        if (p->at[k] != q->at[k])
            return p->at[k] < q->at[k] ? -1 : 1;
    return p->vertex < q->vertex ? -1 : p->vertex > q->vertex;
}

static bool same_place(const placed *p, const placed *q)
{
    return p->at[0] == q->at[0] && p->at[1] == q->at[1] && p->at[2] == q->at[2];
}

static double diagonal_of(const tn_mesh *mesh)
{
    double square = 0;
    for (size_t k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t v = 0; v < mesh->vertex_count; v++) {
            low = fmin(low, mesh->positions[3 * v + k]);
            high = fmax(high, mesh->positions[3 * v + k]);
        }
        square += mesh->vertex_count ? (high - low) * (high - low) : 0;
    }
    return sqrt(square);
}

tn_status tn_mesh_pull_apart(tn_mesh *mesh, double share, size_t *moved, tn_error *error)
{
    size_t count = mesh->vertex_count;
    double *normals, by = share * diagonal_of(mesh);
    placed *all = malloc((count + 1) * sizeof *all);
    *moved = 0;
    if (!all)
        return tn_fail_memory(error);
    tn_status status = tn_mesh_normals(mesh, &normals, error);
    if (status != TN_OK) {
        free(all);
        return status;
    }
    for (size_t v = 0; v < count; v++) {
        memcpy(all[v].at, mesh->positions + 3 * v, sizeof all[v].at);
        all[v].vertex = (uint32_t)v;
    }
    qsort(all, count, sizeof *all, by_place);
    for (size_t i = 0; i < count; i++) {
        if (!(i > 0 && same_place(&all[i], &all[i - 1])) && !(i + 1 < count && same_place(&all[i], &all[i + 1])))
            continue;
        for (size_t k = 0; k < 3; k++)
            mesh->positions[3 * (size_t)all[i].vertex + k] -= by * normals[3 * (size_t)all[i].vertex + k];
        ++*moved;
    }
    free(normals);
    free(all);
    return TN_OK;
}
