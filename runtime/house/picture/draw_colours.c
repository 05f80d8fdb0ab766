/* The colours and hatches of drawings: of a form's materials, or of kinds of parts. */
#include <stdlib.h>
#include <string.h>

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

/* What words in the names of materials and layers say of them; an `s` may follow. */
static const struct {
    const char *word;
    tn_hatch hatch;
} hatch_words[] = {
    {"brick", TN_HATCH_MASONRY},
    {"block", TN_HATCH_DIAGONAL},
    {"stone", TN_HATCH_DIAGONAL},
    {"masonry", TN_HATCH_DIAGONAL},
    {"render", TN_HATCH_DOTTED},
    {"plaster", TN_HATCH_DOTTED},
    {"plasterboard", TN_HATCH_DOTTED},
    {"gypsum", TN_HATCH_DOTTED},
    {"stucco", TN_HATCH_DOTTED},
    {"concrete", TN_HATCH_CONCRETE},
    {"screed", TN_HATCH_CONCRETE},
    {"cement", TN_HATCH_CONCRETE},
    {"timber", TN_HATCH_TIMBER},
    {"wood", TN_HATCH_TIMBER},
    {"board", TN_HATCH_TIMBER},
    {"clapboard", TN_HATCH_TIMBER},
    {"plank", TN_HATCH_TIMBER},
    {"shingle", TN_HATCH_TIMBER},
    {"joist", TN_HATCH_TIMBER},
    {"stud", TN_HATCH_TIMBER},
    {"rafter", TN_HATCH_TIMBER},
    {"sheathing", TN_HATCH_TIMBER},
    {"ply", TN_HATCH_TIMBER},
    {"plywood", TN_HATCH_TIMBER},
    {"batten", TN_HATCH_TIMBER},
    {"cedar", TN_HATCH_TIMBER},
    {"pine", TN_HATCH_TIMBER},
    {"oak", TN_HATCH_TIMBER},
    {"larch", TN_HATCH_TIMBER},
    {"spruce", TN_HATCH_TIMBER},
    {"insulation", TN_HATCH_INSULATION},
    {"wool", TN_HATCH_INSULATION},
    {"batt", TN_HATCH_INSULATION},
    {"cellulose", TN_HATCH_INSULATION},
    {"foam", TN_HATCH_INSULATION},
    {"cork", TN_HATCH_INSULATION},
    {"straw", TN_HATCH_INSULATION},
    {"earth", TN_HATCH_EARTH},
    {"loam", TN_HATCH_EARTH},
    {"adobe", TN_HATCH_EARTH},
    {"tile", TN_HATCH_TILES},
};

/* Is the word, or more of it, one of those? */
static bool find_hatch(const char *word, size_t size, tn_hatch *hatch)
{
    for (size_t i = 0; i < sizeof hatch_words / sizeof *hatch_words; i++) {
        size_t length = strlen(hatch_words[i].word);
        bool more = size == length + 1 && word[length] == 's';
        if ((size == length || more) && strncmp(word, hatch_words[i].word, length) == 0) {
            *hatch = hatch_words[i].hatch;
            return true;
        }
    }
    return false;
}

/* By the last of the words in a name that says something: of `brick-wool` it is wool. */
static bool hatch_of_name(const char *name, tn_hatch *hatch)
{
    bool found = false;
    while (*name) {
        size_t size = strcspn(name, "-_ ");
        found |= find_hatch(name, size, hatch);
        name += size;
        name += strspn(name, "-_ ");
    }
    return found;
}

/* By its name; one whose name says nothing has another than the one that the form declares before it. */
static tn_hatch hatch_of_material(const tn_house_form *form, uint32_t material)
{
    static const tn_hatch others[] = {TN_HATCH_MASONRY, TN_HATCH_DIAGONAL, TN_HATCH_TIMBER};
    tn_hatch hatch = TN_HATCH_TIMBER;
    for (uint32_t m = form->record->material_first; m <= material; m++) {
        size_t next = 0;
        while (next < 3 && others[next] != hatch)
            next++;
        if (!hatch_of_name(tn_text(form->module, form->module->MATERIAL_records[m].name), &hatch))
            hatch = others[(next + 1) % 3];
    }
    return hatch;
}

/* That of a part's material; if it has none, `other`. */
static tn_hatch hatch_of_part(const tn_house *house, uint32_t part, tn_hatch other)
{
    uint32_t material = tn_part_material(house, part);
    return material == TN_NO_RECORD ? other : hatch_of_material(house->form, material);
}

static tn_hatch hatch_of(const tn_house *house, const tn_cut_face *cut)
{
    uint32_t group = tn_solid_groups[cut->kind];
    tn_hatch other = group == TN_GROUP_FLOOR || group == TN_GROUP_FLIGHT ? TN_HATCH_CONCRETE
                     : group == TN_GROUP_ROOF                            ? TN_HATCH_TIMBER
                                                                         : TN_HATCH_DIAGONAL;
    if (group != TN_GROUP_WALL && group != TN_GROUP_FLOOR && group != TN_GROUP_ROOF)
        return other;
    tn_hatch hatch = hatch_of_part(house, tn_solid_made_part(house, cut->kind, cut->of, cut->item), other);
    return group == TN_GROUP_FLOOR && hatch == TN_HATCH_TIMBER ? TN_HATCH_LEVEL : hatch; /* unlike wooden walls */
}

/* A layer that is called insulation, or what else, is that, whatever it is made of. */
tn_status tn_house_layer_hatches(const tn_house *house, tn_hatch **made, tn_error *error)
{
    const tn_house_form *form = house->form;
    *made = malloc((form->record->layer_count + 1) * sizeof **made);
    if (!*made)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < form->record->layer_count; i++)
        if (!hatch_of_name(tn_text(form->module, tn_form_layer(form, i)->name), &(*made)[i]))
            (*made)[i] = hatch_of_part(house, tn_layer_part(form, i), TN_HATCH_DIAGONAL);
    return TN_OK;
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

tn_status tn_house_cuts_layers(const tn_house *house, const tn_house_projection *projection, double **made,
                               tn_error *error)
{
    *made = malloc((projection->cut_count + 1) * sizeof **made);
    if (!*made)
        return tn_fail_memory(error);
    for (size_t i = 0; i < projection->cut_count; i++) {
        const tn_cut_face *cut = &projection->cuts[i];
        tn_layering layers = tn_solid_layering(house, cut->kind, cut->of, cut->item);
        int64_t least = layers.count > 0 ? INT64_MAX : 0;
        for (uint32_t k = layers.first; k < layers.first + layers.count; k++)
            least = tn_form_layer(layers.form, k)->thick < least ? tn_form_layer(layers.form, k)->thick : least;
        (*made)[i] = (double)least;
    }
    return TN_OK;
}
