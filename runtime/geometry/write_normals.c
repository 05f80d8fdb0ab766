/* The normals that a mesh file is to have. */
#include <stdlib.h>
#include <string.h>

#include "runtime/geometry/write.h"

tn_status tn_mesh_style_normals(const tn_mesh *mesh, const tn_mesh_style *style, double **normals, tn_error *error)
{
    *normals = NULL;
    if (!style->normals)
        return TN_OK;
    if (!style->vertex_normals)
        return tn_mesh_normals(mesh, normals, error);
    *normals = malloc((3 * mesh->vertex_count + 1) * sizeof **normals);
    if (!*normals)
        return tn_fail_memory(error);
    memcpy(*normals, style->vertex_normals, 3 * mesh->vertex_count * sizeof **normals);
    return TN_OK;
}

void tn_mesh_style_colour(const tn_mesh_style *style, uint32_t group, unsigned char rgb[3])
{
    if (style->colours)
        memcpy(rgb, style->colours[group], 3);
    else
        tn_group_colour(group, rgb);
}
