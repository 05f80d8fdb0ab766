/* Writes mesh files: what our own writers know by them, the others by OpenMesh. */
#include "driver/mesh/mesh_file.h"

#include <stdlib.h>

#include "runtime/mesh/openmesh.h"

static tn_status decimate(tn_opened *opened, size_t faces, tn_mesh *mesh, tn_error *error)
{
    tn_status status = tn_openmesh_decimate(mesh, faces, error);
    if (status == TN_OK && mesh->face_count > faces + 1) /* collapses take two at a time */
        tn_report_bare(&opened->compilation.diagnostics, TN_NOTE, TN_CODE_NONE,
                       "the mesh keeps %zu triangles: with fewer it would fold", mesh->face_count);
    return status;
}

static bool holds_triangles(tn_file_format format, const tn_mesh *mesh)
{
    return format == TN_FILE_GLB || format == TN_FILE_STL || format == TN_FILE_3MF ||
           (format == TN_FILE_DXF && !mesh->lines);
}

tn_status tn_mesh_change(tn_opened *opened, const tn_mesh_changes *changes, tn_file_format format, tn_mesh *mesh,
                         tn_error *error)
{
    tn_status status = TN_OK;
    if (changes->subdivide)
        status = tn_openmesh_subdivide(mesh, changes->subdivide, error);
    if (status == TN_OK && changes->smooth)
        status = tn_openmesh_smooth(mesh, changes->smooth, error);
    if (status == TN_OK && changes->decimate)
        status = decimate(opened, changes->decimate, mesh, error);
    if (status == TN_OK && (changes->triangulate || holds_triangles(format, mesh)))
        status = tn_mesh_triangulate(mesh, error);
    return status;
}

static tn_status write_by_openmesh(const tn_mesh *mesh, tn_file_format format, bool y_up, FILE *out, tn_error *error)
{
    unsigned char *bytes;
    size_t size;
    tn_status status = tn_openmesh_write(mesh, format, y_up, &bytes, &size, error);
    if (status == TN_OK)
        fwrite(bytes, 1, size, out);
    free(bytes);
    return status;
}

tn_status tn_mesh_file_write(const tn_mesh *mesh, tn_file_format format, const tn_mesh_style *style, FILE *out,
                             tn_error *error)
{
    switch (format) {
    case TN_FILE_OBJ:
        return tn_mesh_write_obj(mesh, style, out, error);
    case TN_FILE_PLY:
        return tn_mesh_write_ply(mesh, style, out, error);
    case TN_FILE_GLB:
        return tn_mesh_write_glb(mesh, style, out, error);
    case TN_FILE_3MF:
        return tn_mesh_write_3mf(mesh, style, out, error);
    case TN_FILE_DXF:
        return tn_mesh_write_dxf(mesh, style, out, error);
    case TN_FILE_SCAD:
        return tn_mesh_write_scad(mesh, style, out, error);
    default:
        return write_by_openmesh(mesh, format, style->y_up, out, error);
    }
}
