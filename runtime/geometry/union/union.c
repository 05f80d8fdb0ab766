/* The boundary of a union of cells: calls what finds planes, triangles and vertices. */
#include "runtime/geometry/union/union.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/geometry/union/union_parts.h"

/* Rounds: two or three are what random designs take. Steps: 2^52 of them from 0, then 2^44, 2^36. */
enum { ROUNDS = 64, STEPS = 3 };

void tn_union_clear(tn_union *result)
{
    tn_mesh_clear(&result->mesh);
    *result = (tn_union){0};
}

static tn_status make(const tn_cut_box *cells, size_t count, double step, bool merging, tn_union *result,
                      tn_error *error)
{
    tn_grid grid = {.step = step, .merging = merging};
    tn_grid_planes(&grid, cells, count);
    tn_status status = grid.failed ? tn_fail_memory(error) : TN_OK;
    bool again = true;
    for (int round = 0; status == TN_OK && again; round++) { /* each time with other edges */
        tn_mesh_clear(&result->mesh);
        status = round < ROUNDS ? tn_grid_triangles(&grid, &result->mesh, error) : tn_union_too_fine(error);
        if (status == TN_OK)
            status = tn_grid_separate(&grid, &result->mesh, &result->doubled, &again, error);
    }
    tn_grid_clear(&grid);
    return status;
}

/* Edges of one step have no middle to be split at: with longer steps their ends are one vertex. Where no step will do,
 * because crossings that are a few steps apart changed places when they were rounded, these are merged. */
tn_status tn_union_make(const tn_cut_box *cells, size_t count, tn_union *result, tn_error *error)
{
    double step = tn_cut_boxes_step(cells, count);
    tn_status status = TN_LIMIT;
    *result = (tn_union){0};
    for (int attempt = 0; attempt < 2 * STEPS && status == TN_LIMIT; attempt++) {
        tn_union_clear(result);
        status = make(cells, count, ldexp(step, 8 * (attempt % STEPS)), attempt >= STEPS, result, error);
    }
    result->mesh.group_count = (uint32_t)count;
    return status;
}

tn_status tn_union_cells(const tn_cut_box *cells, size_t count, tn_mesh *mesh, tn_error *error)
{
    size_t vertices = 0, faces = 0, corners = 0;
    for (size_t i = 0; i < count; i++) {
        vertices += cells[i].corner_count;
        faces += cells[i].face_count;
        for (uint32_t f = 0; f < cells[i].face_count; f++)
            corners += cells[i].faces[f].count;
    }
    tn_status status = tn_mesh_new(vertices, faces, corners, mesh, error);
    mesh->face_group = status == TN_OK ? malloc((faces + 1) * sizeof *mesh->face_group) : NULL;
    if (status == TN_OK && !mesh->face_group)
        status = tn_fail_memory(error);
    vertices = faces = corners = 0;
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        for (uint32_t f = 0; f < cells[i].face_count; f++) {
            mesh->face_first[faces] = (uint32_t)corners;
            mesh->face_group[faces++] = (uint32_t)i;
            for (uint32_t k = 0; k < cells[i].faces[f].count; k++)
                mesh->corners[corners++] = (uint32_t)vertices + cells[i].faces[f].corner[k];
        }
        for (uint32_t v = 0; v < cells[i].corner_count; v++, vertices++)
            for (int k = 0; k < 3; k++)
                mesh->positions[3 * vertices + (size_t)k] = cells[i].at[v][k];
    }
    if (status == TN_OK)
        mesh->face_first[faces] = (uint32_t)corners;
    mesh->group_count = (uint32_t)count;
    return status;
}
