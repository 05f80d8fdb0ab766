/* OpenMesh's work in a build without the part `mesh`: there is none. */
#include "runtime/base/error.h"
#include "runtime/mesh/openmesh.h"

tn_status tn_openmesh_read(const char *path, tn_mesh *mesh, tn_error *error)
{
    (void)path;
    *mesh = (tn_mesh){0};
    return tn_part_absent(TN_WITH_MESH, "reading a mesh", error);
}

static tn_status read_mesh(void *context, const char *path, tn_mesh *mesh, tn_error *error)
{
    (void)context;
    return tn_openmesh_read(path, mesh, error);
}

const tn_mesh_reader tn_openmesh_reader = {read_mesh, NULL};

tn_status tn_openmesh_write(const tn_mesh *mesh, tn_file_format format, bool y_up, unsigned char **bytes, size_t *size,
                            tn_error *error)
{
    (void)mesh, (void)format, (void)y_up;
    *bytes = NULL;
    *size = 0;
    return tn_part_absent(TN_WITH_MESH, "writing OFF, STL or OM", error);
}

tn_status tn_openmesh_smooth(tn_mesh *mesh, unsigned iterations, tn_error *error)
{
    (void)mesh, (void)iterations;
    return tn_part_absent(TN_WITH_MESH, "smoothing a mesh", error);
}

tn_status tn_openmesh_subdivide(tn_mesh *mesh, unsigned rounds, tn_error *error)
{
    (void)mesh, (void)rounds;
    return tn_part_absent(TN_WITH_MESH, "subdividing a mesh", error);
}

tn_status tn_openmesh_decimate(tn_mesh *mesh, size_t faces, tn_error *error)
{
    (void)mesh, (void)faces;
    return tn_part_absent(TN_WITH_MESH, "decimating a mesh", error);
}
