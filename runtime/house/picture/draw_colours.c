/* The colours and hatches of drawings: of a form's materials, or of kinds of parts. */
#include <stdlib.h>

#include "runtime/house/picture/draw_parts.h"
#include "runtime/house/schedule/cost.h"

/* Surfaces that the lamp lights fully have these colours where the form names no material. */
static const double colours[TN_GROUP_COUNT][3] = {
    [TN_GROUP_WALL] = {0.97, 0.96, 0.94},  [TN_GROUP_FLOOR] = {0.93, 0.90, 0.84},  [TN_GROUP_ROOF] = {0.62, 0.66, 0.72},
    [TN_GROUP_ITEM] = {0.84, 0.74, 0.60},  [TN_GROUP_PANE] = {0.70, 0.84, 0.93},   [TN_GROUP_LEAF] = {0.74, 0.46, 0.34},
    [TN_GROUP_GUARD] = {0.80, 0.76, 0.70}, [TN_GROUP_FLIGHT] = {0.93, 0.90, 0.84},
};

#define FACING 0.79 /* how light a surface is that looks at the eye (render.c) */

static bool shows_materials(const tn_house_form *form, tn_aspect_kind kind)
{
    return form->record->material_count && (kind == TN_ASPECT_ELEVATION || kind == TN_ASPECT_AXONOMETRIC);
}

static uint32_t material_group(const tn_house *house, const tn_house_block *block)
{
    uint32_t material = tn_part_material(house, tn_solid_made_part(house, block->kind, block->of, block->item));
    return material == TN_NO_RECORD ? 0 : 1 + material - house->form->record->material_first;
}

const tn_grouping *tn_house_grouping(const tn_house_form *form, tn_aspect_kind kind, tn_grouping *grouping)
{
    *grouping = (tn_grouping){material_group, form->record->material_count};
    return shows_materials(form, kind) ? grouping : NULL;
}

double tn_house_ambient(const tn_house_form *form, tn_aspect_kind kind)
{
    return shows_materials(form, kind) ? 0.62 : 0.45;
}

void tn_house_colour_groups(tn_mesh *mesh)
{
    for (size_t f = 0; f < mesh->face_count; f++)
        if (mesh->face_group[f] >= TN_GROUP_COUNT)
            mesh->face_group[f] = TN_GROUP_COUNT + mesh->face_group[f] / TN_GROUP_COUNT - 1;
}

/* In drawings that look straight at surfaces, these have their full colour. */
void tn_house_palette(const tn_house_form *form, tn_aspect_kind kind, double palette[TN_PALETTE_MAX][3])
{
    double ambient = tn_house_ambient(form, kind);
    double factor = kind == TN_ASPECT_AXONOMETRIC ? 1.04 : 1 / (ambient + (1 - ambient) * FACING);
    for (int g = 0; g < TN_GROUP_COUNT; g++)
        for (int k = 0; k < 3; k++)
            palette[g][k] = colours[g][k] * factor;
    for (uint32_t m = 0; shows_materials(form, kind) && m < form->record->material_count; m++) {
        uint32_t colour = form->module->MATERIAL_records[form->record->material_first + m].colour;
        for (int k = 0; k < 3; k++)
            palette[TN_GROUP_COUNT + m][k] = (double)(colour >> (16 - 8 * k) & 255) / 255 * factor;
    }
}

#define CUT_LIGHT 0.6 /* how much white there is in the colour of what is cut */

tn_status tn_house_layer_colours(const tn_house *house, double (**made)[3], tn_error *error)
{
    const tn_house_form *form = house->form;
    *made = NULL;
    if (form->record->layer_count == 0)
        return TN_OK;
    double(*of)[3] = *made = malloc(form->record->layer_count * sizeof **made);
    if (!of)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < form->record->layer_count; i++) {
        uint32_t material = tn_part_material(house, tn_layer_part(form, i));
        uint32_t colour = material == TN_NO_RECORD ? 0xd8d8d8 : form->module->MATERIAL_records[material].colour;
        for (int k = 0; k < 3; k++)
            of[i][k] = CUT_LIGHT + (1 - CUT_LIGHT) * (double)(colour >> (16 - 8 * k) & 255) / 255;
    }
    return TN_OK;
}

/* ---- hatches */

/* Walls of different materials have different hatches, in the order in which the form declares them. */
static tn_hatch hatch_of_wall(const tn_house *house, const tn_cut_face *cut)
{
    static const tn_hatch hatches[] = {TN_HATCH_MASONRY, TN_HATCH_DIAGONAL, TN_HATCH_TIMBER};
    uint32_t material = tn_part_material(house, tn_solid_made_part(house, cut->kind, cut->of, cut->item));
    return material == TN_NO_RECORD
               ? TN_HATCH_DIAGONAL
               : hatches[(material - house->form->record->material_first) % (sizeof hatches / sizeof *hatches)];
}

static tn_hatch hatch_of(const tn_house *house, const tn_cut_face *cut)
{
    switch (tn_solid_groups[cut->kind]) {
    case TN_GROUP_WALL:
        return hatch_of_wall(house, cut);
    case TN_GROUP_FLOOR:
    case TN_GROUP_FLIGHT:
        return TN_HATCH_CONCRETE;
    case TN_GROUP_ROOF:
        return TN_HATCH_TIMBER;
    default:
        return TN_HATCH_DIAGONAL;
    }
}

tn_status tn_house_hatches(const tn_house *house, const tn_house_projection *projection, tn_hatch **made,
                           tn_error *error)
{
    *made = malloc((projection->cut_count + 1) * sizeof **made);
    if (!*made)
        return tn_fail_memory(error);
    for (size_t i = 0; i < projection->cut_count; i++)
        (*made)[i] = hatch_of(house, &projection->cuts[i]);
    return TN_OK;
}
