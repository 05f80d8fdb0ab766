/* OpenMesh's work by the part `mesh`, which is loaded when it is first needed. */
#include "runtime/base/part.h"
#include "runtime/mesh/openmesh.h"

#define FIND(function, wanted) ((__typeof__(function) *)tn_part_find(TN_WITH_MESH, #function, wanted, error))

tn_status tn_openmesh_read(const char *path, tn_mesh *mesh, tn_error *error)
{
    *mesh = (tn_mesh){0};
    __typeof__(tn_openmesh_read) *read = FIND(tn_openmesh_read, "reading a mesh");
    return read ? read(path, mesh, error) : TN_INVALID;
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
    *bytes = NULL;
    *size = 0;
    __typeof__(tn_openmesh_write) *write = FIND(tn_openmesh_write, "writing OFF, STL or OM");
    return write ? write(mesh, format, y_up, bytes, size, error) : TN_INVALID;
}

tn_status tn_openmesh_smooth(tn_mesh *mesh, unsigned iterations, tn_error *error)
{
    __typeof__(tn_openmesh_smooth) *smooth = FIND(tn_openmesh_smooth, "smoothing a mesh");
    return smooth ? smooth(mesh, iterations, error) : TN_INVALID;
}

tn_status tn_openmesh_subdivide(tn_mesh *mesh, unsigned rounds, tn_error *error)
{
    __typeof__(tn_openmesh_subdivide) *subdivide = FIND(tn_openmesh_subdivide, "subdividing a mesh");
    return subdivide ? subdivide(mesh, rounds, error) : TN_INVALID;
}

tn_status tn_openmesh_decimate(tn_mesh *mesh, size_t faces, tn_error *error)
{
    __typeof__(tn_openmesh_decimate) *decimate = FIND(tn_openmesh_decimate, "decimating a mesh");
    return decimate ? decimate(mesh, faces, error) : TN_INVALID;
}
