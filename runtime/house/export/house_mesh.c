/* Makes a mesh of a house, whose groups are kinds of parts and materials. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/utf8.h"
#include "runtime/house/export/export.h"
#include "runtime/house/model/model.h"
#include "runtime/house/schedule/cost.h"

/* Colours of parts in models, in the order of tn_solid_kind. */
static const unsigned char part_colours[TN_SOLID_COUNT][3] = {
    [TN_SOLID_OUTSIDE] = {240, 238, 232}, [TN_SOLID_PARTY] = {240, 238, 232},  [TN_SOLID_PARTITION] = {250, 249, 246},
    [TN_SOLID_POST] = {240, 238, 232},    [TN_SOLID_DECK] = {222, 210, 190},   [TN_SOLID_ROOFDECK] = {222, 210, 190},
    [TN_SOLID_ITEM] = {205, 170, 125},    [TN_SOLID_ROOF] = {110, 120, 132},   [TN_SOLID_PANE] = {170, 208, 232},
    [TN_SOLID_LEAF] = {176, 92, 60},      [TN_SOLID_FLIGHT] = {205, 186, 150}, [TN_SOLID_GUARD] = {150, 132, 112},
    [TN_SOLID_GABLE] = {240, 238, 232},   [TN_SOLID_BEAM] = {150, 120, 90},
};

void tn_house_mesh_colours(const tn_house_form *form, unsigned char colours[TN_HOUSE_GROUPS_MAX][3])
{
    memcpy(colours, part_colours, sizeof part_colours);
    for (uint32_t i = 0; i < form->record->material_count; i++) {
        uint32_t colour = form->module->MATERIAL_records[form->record->material_first + i].colour;
        for (uint32_t k = 0; k < 3; k++)
            colours[TN_SOLID_COUNT + i][k] = (unsigned char)(colour >> (16 - 8 * k) & 255);
    }
}

/* A kind of part, or what it is made of. */
static uint32_t group_of(const tn_house *house, const tn_house_block *b)
{
    uint32_t material = tn_part_material(house, tn_solid_made_part(house, b->kind, b->of, b->item));
    return material == TN_NO_RECORD ? b->kind : TN_SOLID_COUNT + material - house->form->record->material_first;
}

tn_status tn_house_blocks(const tn_house *house, const tn_solids *solids, tn_blocks *blocks, tn_error *error)
{
    tn_status status = tn_blocks_of(house, solids, blocks, error);
    for (size_t i = 0; status == TN_OK && tn_form_has_costs(house->form) && i < blocks->count; i++)
        blocks->items[i].group = group_of(house, &blocks->items[i]);
    return status;
}

static tn_status name_groups(const tn_house_form *form, tn_mesh *mesh, tn_error *error)
{
    mesh->group_names = calloc(mesh->group_count, sizeof *mesh->group_names);
    if (!mesh->group_names)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < mesh->group_count; i++) {
        uint32_t material = form->record->material_first + i - TN_SOLID_COUNT;
        tn_utf8_copy(i < TN_SOLID_COUNT ? tn_solid_kind_text((tn_solid_kind)i)
                                        : tn_text(form->module, form->module->MATERIAL_records[material].name),
                     sizeof mesh->group_names[i], mesh->group_names[i]);
    }
    return TN_OK;
}

tn_status tn_house_mesh(const tn_house *house, const tn_solids *solids, tn_mesh *mesh, tn_error *error)
{
    tn_blocks blocks;
    tn_status status = tn_house_blocks(house, solids, &blocks, error);
    *mesh = (tn_mesh){0};
    if (status == TN_OK)
        status = tn_blocks_mesh(&blocks, TN_SOLID_COUNT + house->form->record->material_count, mesh, error);
    if (status == TN_OK)
        status = name_groups(house->form, mesh, error);
    for (size_t i = 0; status == TN_OK && i < 3 * mesh->vertex_count; i++)
        mesh->positions[i] /= 1e9; /* metres */
    tn_blocks_clear(&blocks);
    return status;
}
