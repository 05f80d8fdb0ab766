/* Writes mesh files: what our own writers know by them, the others by OpenMesh. */
#include "cli/common/mesh_output.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "runtime/mesh/openmesh.h"

tn_out_format tn_out_format_of(const char *path)
{
    static const char *const words[TN_OUT_FORMAT_COUNT] = {"",    "obj", "ply", "stl", "off",  "om", "glb",
                                                           "dxf", "svg", "png", "pdf", "scad", "3mf"};
    const char *dot = strrchr(path, '.');
    for (int f = TN_OUT_OBJ; dot && f < TN_OUT_FORMAT_COUNT; f++)
        if (strcasecmp(dot + 1, words[f]) == 0)
            return (tn_out_format)f;
    return TN_OUT_NONE;
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
