/* Lists the faces of a mesh for a picture. */
#include <stdlib.h>

#include "runtime/geometry/crease.h"
#include "runtime/scene/view.h"

static void add_face(const tn_mesh *mesh, const bool *creases, uint32_t face, tn_display_list *display)
{
    uint32_t begin = mesh->face_first[face], end = mesh->face_first[face + 1];
    display->first[face] = begin;
    for (uint32_t c = begin; c < end; c++) {
        for (size_t k = 0; k < 3; k++)
            display->points[c][k] = mesh->positions[3 * (size_t)mesh->corners[c] + k];
        display->edges[c] = !creases || creases[c] ? TN_EDGE_DARK : TN_EDGE_NONE;
    }
    if (mesh->face_group)
        display->groups[face] = mesh->face_group[face];
}

static bool all_triangles(const tn_mesh *mesh)
{
    for (size_t f = 0; f <= mesh->face_count; f++)
        if (mesh->face_first[f] != 3 * f)
            return false;
    return true;
}

tn_status tn_display_list_of_mesh(const tn_mesh *mesh, tn_display_list *display, tn_error *error)
{
    bool *creases = NULL;
    tn_status status =
        tn_display_list_new(mesh->face_count, mesh->face_first[mesh->face_count], mesh->face_group, display, error);
    if (status == TN_OK && all_triangles(mesh))
        status = tn_mesh_creases(mesh, &creases, error);
    if (status != TN_OK)
        return status;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        add_face(mesh, creases, f, display);
    display->first[mesh->face_count] = mesh->face_first[mesh->face_count];
    display->face_count = (uint32_t)mesh->face_count;
    display->watch = mesh->watch;
    free(creases);
    return TN_OK;
}
