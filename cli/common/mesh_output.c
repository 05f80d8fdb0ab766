/* Writes mesh files: what our own writers know by them, the others by OpenMesh. */
#include "cli/common/mesh_output.h"

#include <stdlib.h>

#include "runtime/base/formats.h"
#include "runtime/mesh/openmesh.h"

tn_out_format tn_out_format_of(const char *path)
{
    static const tn_out_format formats[TN_FILE_FORMATS + 1] = {
        [TN_FILE_OBJ] = TN_OUT_OBJ, [TN_FILE_PLY] = TN_OUT_PLY,   [TN_FILE_STL] = TN_OUT_STL,
        [TN_FILE_OFF] = TN_OUT_OFF, [TN_FILE_OM] = TN_OUT_OM,     [TN_FILE_GLB] = TN_OUT_GLB,
        [TN_FILE_DXF] = TN_OUT_DXF, [TN_FILE_SVG] = TN_OUT_SVG,   [TN_FILE_PNG] = TN_OUT_PNG,
        [TN_FILE_PDF] = TN_OUT_PDF, [TN_FILE_SCAD] = TN_OUT_SCAD, [TN_FILE_3MF] = TN_OUT_3MF};
    return formats[tn_file_format_of(path)];
}

static tn_status decimate(tn_job *job, size_t faces, tn_mesh *mesh, tn_error *error)
{
    tn_status status = tn_openmesh_decimate(mesh, faces, error);
    if (status == TN_OK && mesh->face_count > faces + 1) /* collapses take two at a time */
        tn_job_note(job, "the mesh keeps %zu triangles: with fewer it would fold", mesh->face_count);
    return status;
}

tn_status tn_out_rework(tn_job *job, const tn_out_changes *changes, tn_out_format format, tn_mesh *mesh,
                        tn_error *error)
{
    tn_status status = TN_OK;
    if (changes->subdivide.given)
        status = tn_openmesh_subdivide(mesh, (unsigned)changes->subdivide.value, error);
    if (status == TN_OK && changes->smooth.given)
        status = tn_openmesh_smooth(mesh, (unsigned)changes->smooth.value, error);
    if (status == TN_OK && changes->decimate.given)
        status = decimate(job, (size_t)changes->decimate.value, mesh, error);
    if (status == TN_OK && (changes->triangulate || format == TN_OUT_GLB || format == TN_OUT_STL ||
                            format == TN_OUT_3MF || (format == TN_OUT_DXF && !mesh->lines)))
        status = tn_mesh_triangulate(mesh, error);
    return status;
}

static tn_status write_by_openmesh(const tn_mesh *mesh, tn_out_format format, bool y_up, FILE *out, tn_error *error)
{
    unsigned char *bytes;
    size_t size;
    tn_openmesh_format kind = format == TN_OUT_OFF   ? TN_OPENMESH_OFF
                              : format == TN_OUT_STL ? TN_OPENMESH_STL
                                                     : TN_OPENMESH_OM;
    tn_status status = tn_openmesh_write(mesh, kind, y_up, &bytes, &size, error);
    if (status == TN_OK)
        fwrite(bytes, 1, size, out); /* failing shows when the output is committed */
    free(bytes);
    return status;
}

tn_status tn_out_mesh(const tn_mesh *mesh, tn_out_format format, const tn_mesh_style *style, FILE *out, tn_error *error)
{
    switch (format) {
    case TN_OUT_OBJ:
        return tn_mesh_write_obj(mesh, style, out, error);
    case TN_OUT_PLY:
        return tn_mesh_write_ply(mesh, style, out, error);
    case TN_OUT_GLB:
        return tn_mesh_write_glb(mesh, style, out, error);
    case TN_OUT_3MF:
        return tn_mesh_write_3mf(mesh, style, out, error);
    case TN_OUT_DXF:
        return tn_mesh_write_dxf(mesh, style, out, error);
    case TN_OUT_SCAD:
        return tn_mesh_write_scad(mesh, style, out, error);
    default:
        return write_by_openmesh(mesh, format, style->y_up, out, error);
    }
}
