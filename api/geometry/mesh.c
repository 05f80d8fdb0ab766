/* The C interface to meshes as arrays. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "api/geometry/mesh.h"

tartan_status tn_api_mesh(tn_mesh *made, tartan_mesh **mesh, tartan_error *error)
{
    tartan_mesh *held = malloc(sizeof *held);
    if (!held) {
        tn_mesh_clear(made);
        return tn_api_memory(error);
    }
    *held = (tartan_mesh){.mesh = *made};
    held->mesh.watch = NULL; /* whoever waited for its making waits no more */
    *mesh = held;
    return TARTAN_OK;
}

static tn_status no_reader(const char *path, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_CANNOT_READ, "the mesh %.300s is not read: the options have no reader of meshes",
            path);
    tn_error_help(error, "set read_mesh to tartan_mesh_read, of libtartan-mesh");
    return TN_INVALID;
}

static tn_status read_by(void *context, const char *path, tn_mesh *mesh, tn_error *error)
{
    tartan_mesh_reader *const *read = context;
    tartan_mesh *made = NULL;
    tartan_error said = {.status = TARTAN_OK};
    *mesh = (tn_mesh){0};
    if (!*read)
        return no_reader(path, error);
    tartan_status status = (*read)(path, &made, &said);
    if (status == TARTAN_OK && made) {
        *mesh = made->mesh;
        free(made);
        return TN_OK;
    }
    tartan_mesh_free(made);
    tn_status failed = status == TARTAN_OK ? TN_INVALID : (tn_status)status;
    tn_fail(error, failed, (tn_code)said.code, "%.400s", said.message[0] ? said.message : "there is no such mesh");
    if (said.help[0])
        tn_error_help(error, "%.300s", said.help);
    return failed;
}

tn_mesh_reader tn_api_mesh_reader(tartan_mesh_reader **read)
{
    return (tn_mesh_reader){read_by, read};
}

void tartan_mesh_free(tartan_mesh *mesh)
{
    if (!mesh)
        return;
    tn_mesh_clear(&mesh->mesh);
    free(mesh);
}

static tartan_status check(const double *positions, size_t vertices, const uint32_t *first, const uint32_t *corners,
                           size_t faces, tartan_error *error)
{
    if ((vertices && !positions) || !first || (first[faces] && !corners))
        return tn_api_missing(error, "array of the mesh");
    for (size_t i = 0; i < 3 * vertices; i++)
        if (!isfinite(positions[i]))
            return tn_api_refuse(error, TARTAN_INVALID, "vertex %zu has a position that is not finite", i / 3);
    if (first[0] != 0)
        return tn_api_refuse(error, TARTAN_INVALID, "the corners of the first face begin at 0, not at %u",
                             (unsigned)first[0]);
    for (size_t f = 0; f < faces; f++)
        if (first[f + 1] < first[f] || first[f + 1] - first[f] < 3)
            return tn_api_refuse(error, TARTAN_INVALID, "face %zu has fewer than three corners", f);
    for (size_t c = 0; c < first[faces]; c++)
        if (corners[c] >= vertices)
            return tn_api_refuse(error, TARTAN_INVALID, "corner %zu is vertex %u, and there are %zu", c,
                                 (unsigned)corners[c], vertices);
    return TARTAN_OK;
}

tartan_status tartan_mesh_new(const double *positions, size_t vertex_count, const uint32_t *face_first,
                              const uint32_t *corners, size_t face_count, tartan_mesh **mesh, tartan_error *error)
{
    tn_mesh made;
    tn_error found;
    if (vertex_count > UINT32_MAX - 1 || face_count > UINT32_MAX - 1)
        return tn_api_refuse(error, TARTAN_LIMIT, "a mesh has fewer than 2^32 vertices and faces");
    tartan_status status = check(positions, vertex_count, face_first, corners, face_count, error);
    if (status != TARTAN_OK)
        return status;
    if (tn_mesh_new(vertex_count, face_count, face_first[face_count], &made, &found) != TN_OK)
        return tn_api_fail(&found, error);
    if (vertex_count)
        memcpy(made.positions, positions, 3 * vertex_count * sizeof *positions);
    memcpy(made.face_first, face_first, (face_count + 1) * sizeof *face_first);
    if (face_first[face_count])
        memcpy(made.corners, corners, face_first[face_count] * sizeof *corners);
    return tn_api_mesh(&made, mesh, error);
}

/* ---- its arrays */

const double *tartan_mesh_positions(const tartan_mesh *mesh, size_t *vertex_count)
{
    *vertex_count = mesh->mesh.vertex_count;
    return mesh->mesh.positions;
}

const uint32_t *tartan_mesh_faces(const tartan_mesh *mesh, const uint32_t **corners, size_t *face_count)
{
    *corners = mesh->mesh.corners;
    *face_count = mesh->mesh.face_count;
    return mesh->mesh.face_first;
}

const uint32_t *tartan_mesh_lines(const tartan_mesh *mesh, size_t *line_count)
{
    *line_count = mesh->mesh.line_count;
    return mesh->mesh.lines;
}

const uint32_t *tartan_mesh_face_groups(const tartan_mesh *mesh)
{
    return mesh->mesh.face_group;
}

const uint32_t *tartan_mesh_line_groups(const tartan_mesh *mesh)
{
    return mesh->mesh.line_group;
}

uint32_t tartan_mesh_group_count(const tartan_mesh *mesh)
{
    return mesh->mesh.group_count;
}

const char *tartan_mesh_group_name(const tartan_mesh *mesh, uint32_t group)
{
    return group < mesh->mesh.group_count ? mesh->mesh.group_names[group] : NULL;
}

tartan_status tartan_mesh_normals(const tartan_mesh *mesh, double *normals, tartan_error *error)
{
    double *made;
    tn_error found;
    if (!mesh || !normals)
        return tn_api_missing(error, mesh ? "room for normals" : "mesh");
    if (tn_mesh_normals(&mesh->mesh, &made, &found) != TN_OK)
        return tn_api_fail(&found, error);
    if (mesh->mesh.vertex_count)
        memcpy(normals, made, 3 * mesh->mesh.vertex_count * sizeof *made);
    free(made);
    return TARTAN_OK;
}

tartan_status tartan_mesh_triangulate(tartan_mesh *mesh, tartan_error *error)
{
    tn_error found;
    if (!mesh)
        return tn_api_missing(error, "mesh");
    return tn_mesh_triangulate(&mesh->mesh, &found) == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}
