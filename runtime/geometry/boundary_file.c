/* Finds and reads the meshes that rule files name. */
#include "runtime/geometry/boundary_file.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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
