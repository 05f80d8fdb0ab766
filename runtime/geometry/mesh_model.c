/* Keeps meshes as trees of named parts, and writes their materials. */
#include "runtime/geometry/mesh_model.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/geometry/write_text.h"

void tn_mesh_model_clear(tn_mesh_model *model)
{
    for (size_t i = 0; i < model->node_count; i++) {
        free(model->nodes[i].name);
        free(model->nodes[i].facts);
    }
    for (size_t i = 0; i < model->material_count; i++)
        free(model->materials[i].name);
    free(model->nodes);
    free(model->materials);
    free(model->pieces);
    free(model->facts);
    *model = (tn_mesh_model){0};
}

/* ---- made */

/* Siblings of a node that is being made stand behind their parent. */
static bool is_taken(const tn_mesh_model *model, uint32_t parent, const char *name)
{
    for (size_t i = (size_t)parent + 1; i < model->node_count; i++)
        if (model->nodes[i].parent == parent && strcmp(model->nodes[i].name, name) == 0)
            return true;
    return false;
}

/* NULL: there was no memory. */
static char *name_apart(const tn_mesh_model *model, uint32_t parent, const char *name)
{
    char *made = strdup(name);
    for (unsigned n = 2; made && is_taken(model, parent, made); n++) {
        free(made);
        if (asprintf(&made, "%s-%u", name, n) < 0)
            made = NULL;
    }
    return made;
}

tn_status tn_mesh_model_node(tn_mesh_model *model, uint32_t parent, const char *name, uint32_t *node, tn_error *error)
{
    if (!tn_array_reserve(&model->nodes, &model->node_room, model->node_count, 1, sizeof *model->nodes))
        return tn_fail_memory(error);
    char *own = name_apart(model, parent, name);
    if (!own)
        return tn_fail_memory(error);
    *node = (uint32_t)model->node_count;
    model->nodes[model->node_count++] = (tn_mesh_node){.name = own, .parent = parent};
    return TN_OK;
}

tn_status tn_mesh_model_material(tn_mesh_model *model, const char *name, const unsigned char rgb[3], double opacity,
                                 uint32_t *material, tn_error *error)
{
    if (!tn_array_reserve(&model->materials, &model->material_room, model->material_count, 1, sizeof *model->materials))
        return tn_fail_memory(error);
    tn_mesh_material made = {.name = strdup(name), .rgb = {rgb[0], rgb[1], rgb[2]}, .opacity = opacity};
    if (!made.name)
        return tn_fail_memory(error);
    *material = (uint32_t)model->material_count;
    model->materials[model->material_count++] = made;
    return TN_OK;
}

tn_status tn_mesh_model_piece(tn_mesh_model *model, tn_mesh_piece piece, tn_error *error)
{
    if (!tn_array_reserve(&model->pieces, &model->piece_room, model->piece_count, 1, sizeof *model->pieces))
        return tn_fail_memory(error);
    model->pieces[model->piece_count++] = piece;
    return TN_OK;
}

/* ---- the order of faces */

tn_status tn_mesh_sort_faces(tn_mesh *mesh, tn_error *error)
{
    size_t *at = calloc((size_t)mesh->group_count + 2, sizeof *at);
    uint32_t *corners = malloc((3 * mesh->face_count + 1) * sizeof *corners),
             *groups = malloc((mesh->face_count + 1) * sizeof *groups);
    if (!at || !corners || !groups) {
        free(at);
        free(corners);
        free(groups);
        return tn_fail_memory(error);
    }
    for (size_t f = 0; f < mesh->face_count; f++)
        at[mesh->face_group[f] + 1]++;
    for (uint32_t g = 0; g < mesh->group_count; g++)
        at[g + 1] += at[g];
    for (size_t f = 0; f < mesh->face_count; f++) {
        size_t to = at[mesh->face_group[f]]++;
        memcpy(corners + 3 * to, mesh->corners + 3 * f, 3 * sizeof *corners);
        groups[to] = mesh->face_group[f];
    }
    free(at);
    free(mesh->corners);
    free(mesh->face_group);
    mesh->corners = corners;
    mesh->face_group = groups;
    return TN_OK;
}

/* ---- MTL */

static void write_material(tn_text_out *out, const tn_mesh_material *material)
{
    tn_text_add(out, "newmtl ");
    tn_text_word(out, material->name);
    tn_text_add(out, "\nKd");
    for (int k = 0; k < 3; k++) {
        tn_text_add(out, " ");
        tn_text_decimal(out, material->rgb[k] / 255.0);
    }
    tn_text_add(out, "\nKs 0 0 0\nd ");
    tn_text_decimal(out, material->opacity);
    tn_text_add(out, "\nillum 1\n");
    tn_text_flush(out, false);
}

tn_status tn_mesh_write_mtl(const tn_mesh_model *model, FILE *stream, tn_error *error)
{
    tn_text_out *out = malloc(sizeof *out);
    if (!out)
        return tn_fail_memory(error);
    tn_text_begin(out, stream, 1e7); /* five decimals */
    for (size_t i = 0; i < model->material_count; i++)
        write_material(out, &model->materials[i]);
    tn_text_flush(out, true);
    free(out);
    return TN_OK;
}
