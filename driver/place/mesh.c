/* Turns placed models into closed meshes. */
#include <stdio.h>
#include <stdlib.h>

#include "driver/place/bodies.h"
#include "driver/place/colours.h"
#include "driver/place/groups.h"
#include "driver/place/shape.h"
#include "runtime/geometry/union/union.h"

/* The bodies as cells of a union, with their parts' groups. */
static tn_status list_cells(const tn_module *module, const tn_placed_model *model, const tn_bodies *bodies,
                            const uint32_t *groups, tn_cut_box **cells, uint32_t **cell_groups, tn_error *error)
{
    *cells = malloc((bodies->count + 1) * sizeof **cells);
    *cell_groups = malloc((bodies->count + 1) * sizeof **cell_groups);
    if (!*cells || !*cell_groups)
        return tn_fail_memory(error);
    for (size_t i = 0; i < bodies->count; i++) {
        tn_body_shape(module, model, &bodies->items[i], &(*cells)[i]);
        (*cell_groups)[i] = groups[bodies->items[i].part];
    }
    return bodies->count > 0 ? TN_OK : tn_no_bodies(error);
}

/* The union's groups are cells: they become colours. */
static tn_status take_mesh(tn_union *u, const uint32_t *cell_groups, const tn_colour_groups *list, tn_mesh *mesh,
                           unsigned char (**palette)[3], tn_error *error)
{
    *mesh = u->mesh;
    u->mesh = (tn_mesh){0};
    free(mesh->group_names);
    mesh->group_names = calloc(list->count + 1, sizeof *mesh->group_names);
    *palette = calloc(list->count + 1, sizeof **palette);
    if (!mesh->group_names || !*palette)
        return tn_fail_memory(error);
    for (size_t f = 0; f < mesh->face_count; f++)
        mesh->face_group[f] = cell_groups[mesh->face_group[f]];
    mesh->group_count = (uint32_t)list->count;
    for (size_t i = 0; i < list->count; i++) {
        double rgb[3];
        tn_ldraw_colour(list->items[i], rgb);
        snprintf(mesh->group_names[i], sizeof *mesh->group_names, "colour-%d", list->items[i]);
        for (int k = 0; k < 3; k++)
            (*palette)[i][k] = (unsigned char)(255 * rgb[k] + 0.5);
    }
    return TN_OK;
}

tn_status tn_placed_mesh(const tn_module *module, const tn_placed_model *model, tn_mesh *mesh,
                         unsigned char (**palette)[3], tn_error *error)
{
    tn_bodies bodies = {0};
    tn_placed_joints joints;
    tn_colour_groups list = {0};
    uint32_t *groups, *cell_groups = NULL;
    tn_cut_box *cells = NULL;
    tn_union u = {0};
    *mesh = (tn_mesh){0};
    *palette = NULL;
    tn_status status = tn_colour_groups_add(&list, model, &groups, error);
    tn_status found = tn_placed_joints_find(module, model, NULL, &joints, error);
    status = status == TN_OK ? found : status;
    if (status == TN_OK)
        status = tn_bodies_list(module, model, &joints, &bodies, error);
    if (status == TN_OK)
        status = list_cells(module, model, &bodies, groups, &cells, &cell_groups, error);
    if (status == TN_OK)
        status = tn_union_make(cells, bodies.count, &u, error);
    if (status == TN_OK)
        status = take_mesh(&u, cell_groups, &list, mesh, palette, error);
    tn_union_clear(&u);
    tn_placed_joints_clear(&joints);
    tn_bodies_clear(&bodies);
    free(cells);
    free(cell_groups);
    free(groups);
    free(list.items);
    return status;
}
