/* Writes the roof of a building model, which is made of slabs, and the walls below it. */
#include <math.h>
#include <stdio.h>

#include "runtime/house/export/ifc.h"

size_t tn_ifc_corners(const tn_ifc *ifc, const tn_prism *prism, tn_block_corner corners[TN_FACET_CORNERS])
{
    const tn_prism_corner *c = ifc->solids->corners + prism->corner_first;
    double floor = (double)ifc->house->form->level[ifc->storey];
    for (size_t i = 0; i < prism->corner_count; i++)
        corners[i] = (tn_block_corner){tn_fraction_value(c[i].x), tn_fraction_value(c[i].y),
                                       tn_fraction_value(c[i].low) - floor, tn_fraction_value(c[i].high) - floor};
    return prism->corner_count;
}

/* Does a prism belong to the same part: a slab is all that lies in one plane of a cell's roof, a wall what stands below
 * it, and is cut into layers as the wall of one face? */
static bool is_part(const tn_prism *prism, const tn_prism *of)
{
    return prism->kind == of->kind && prism->of == of->of &&
           (of->kind == TN_SOLID_GABLE ? prism->item == of->item : prism->plane == of->plane);
}

/* The part that begins with a prism: its bodies, how much it holds, and how large it is in plan. */
typedef struct tn_ifc_prisms {
    const tn_prism *first;
    unsigned shape;
    double volume, plan;
} tn_ifc_prisms;

static tn_solid solid_of(const tn_prism *prism)
{
    return (tn_solid){.kind = prism->kind, .of = prism->of, .item = prism->item};
}

/* Writes it as an element, which it is said to be, placed within another. */
static unsigned put_part(tn_ifc *ifc, const tn_ifc_prisms *prisms, tn_ifc_part part, unsigned within, const char *key)
{
    part.name = tn_solid_kind_text(prisms->first->kind);
    part.shape = prisms->shape;
    part.where = tn_stepfile_placement(&ifc->step, within, 0, 0, 0);
    return tn_ifc_put(ifc, &part, key);
}

/* False if the part begins with a prism before. */
static bool take_part(tn_ifc *ifc, size_t number, tn_ifc_prisms *part)
{
    const tn_solids *solids = ifc->solids;
    tn_stepfile_list bodies = {0};
    *part = (tn_ifc_prisms){.first = &solids->prisms[number]};
    for (size_t i = 0; i < number; i++)
        if (is_part(&solids->prisms[i], part->first))
            return false;
    const tn_solid solid = solid_of(part->first);
    tn_ifc_look_as(ifc, &solid);
    for (size_t i = number; i < solids->prism_count; i++) {
        tn_block_corner corners[TN_FACET_CORNERS], flat[TN_FACET_CORNERS];
        if (!is_part(&solids->prisms[i], part->first))
            continue;
        size_t count = tn_ifc_corners(ifc, &solids->prisms[i], corners);
        for (size_t k = 0; k < count; k++)
            flat[k] = (tn_block_corner){corners[k].x, corners[k].y, 0, 1e9};
        tn_stepfile_list_add(&bodies, tn_stepfile_prism(&ifc->step, corners, count));
        part->volume += tn_ifc_prism_volume(corners, count);
        part->plan += tn_ifc_prism_volume(flat, count);
    }
    part->shape = tn_ifc_shape(ifc, "Tessellation", &bodies);
    return true;
}

/* ---- walls below roofs */

static void put_gable(tn_ifc *ifc, const tn_ifc_prisms *gable, tn_stepfile_list *list)
{
    const tn_prism *first = gable->first;
    const tn_solid solid = solid_of(first);
    const char *name = tn_solid_kind_text(first->kind);
    char key[TN_IFC_CELL_KEY + TN_IFC_FACE_KEY + 10], cell[TN_IFC_CELL_KEY], face[TN_IFC_FACE_KEY] = "";
    tn_ifc_cell_key(ifc, first->of, cell);
    if (first->item != TN_NO_FACE)
        tn_ifc_face_key(ifc, first->item, face);
    snprintf(key, sizeof key, "gable %s, %s", cell, face);
    const tn_ifc_part part = {.entity = "IFCWALL", .tail = ",.SOLIDWALL.", .type_name = name};
    unsigned wall = put_part(ifc, gable, part, ifc->placement, key);
    const tn_ifc_quantity quantities[] = {{"GrossFootprintArea", 'A', gable->plan},
                                          {"GrossVolume", 'V', gable->volume},
                                          {"NetVolume", 'V', gable->volume}};
    tn_ifc_property external = {.name = NULL};
    if (first->item != TN_NO_FACE)
        external = tn_ifc_truth("IsExternal", tn_face_is_outer(ifc->house, &ifc->house->faces[first->item]));
    tn_ifc_properties(ifc, wall, "Pset_WallCommon", name, &external, external.name != NULL);
    tn_ifc_quantities(ifc, wall, "Qto_WallBaseQuantities", key, quantities, 3);
    tn_ifc_make_of(ifc, &solid, wall);
    tn_stepfile_list_add(list, wall);
}

void tn_ifc_put_gables(tn_ifc *ifc, tn_stepfile_list *list)
{
    for (size_t i = 0; i < ifc->solids->prism_count; i++) {
        const tn_prism *prism = &ifc->solids->prisms[i];
        tn_ifc_prisms gable;
        if (prism->kind == TN_SOLID_GABLE && ifc->house->cells[prism->of].storey == ifc->storey &&
            take_part(ifc, i, &gable))
            put_gable(ifc, &gable, list);
    }
}

/* ---- the roof */

/* IfcRoofTypeEnum. */
static const char *roof_type(const tn_shape_record *shape)
{
    switch (shape ? (tn_roof_kind)shape->roof : TN_ROOF_FLAT) {
    case TN_ROOF_SHED_BACK:
    case TN_ROOF_SHED_FRONT:
        return ",.SHED_ROOF.";
    case TN_ROOF_GABLE:
        return ",.GABLE_ROOF.";
    case TN_ROOF_VAULT:
        return ",.BARREL_ROOF.";
    case TN_ROOF_HIP:
        return ",.HIP_ROOF.";
    case TN_ROOF_CROSS_GABLE:
        return ",.NOTDEFINED.";
    default:
        return ",.FLAT_ROOF.";
    }
}

/* Of all zones that have some of it; if they differ, none that IFC knows. */
static const char *whole_type(const tn_ifc *ifc)
{
    const char *type = NULL;
    for (size_t i = 0; i < ifc->solids->prism_count; i++) {
        const tn_prism *prism = &ifc->solids->prisms[i];
        if (prism->kind != TN_SOLID_ROOF)
            continue;
        const char *of = roof_type(tn_house_shape(ifc->house, ifc->house->cells[prism->of].zone, TN_CHOICE_ROOF));
        if (type && type != of)
            return ",.NOTDEFINED.";
        type = of;
    }
    return type;
}

/* What is added up of slabs: along their slopes, and in plan. */
typedef struct tn_ifc_roof {
    unsigned where;
    double area, plan;
    tn_stepfile_list slabs;
} tn_ifc_roof;

static void put_slab(tn_ifc *ifc, const tn_ifc_prisms *slab, tn_ifc_roof *roof)
{
    const char *name = tn_solid_kind_text(TN_SOLID_ROOF);
    const tn_prism *first = slab->first;
    const tn_solid solid = solid_of(first);
    char key[TN_IFC_CELL_KEY + 40], cell[TN_IFC_CELL_KEY], type[100];
    double rise = tn_fraction_value(first->rise), longer = sqrt(1 + rise * rise);
    tn_ifc_cell_key(ifc, first->of, cell);
    snprintf(key, sizeof key, "slab %zu of roof over %s", first->plane, cell);
    tn_ifc_sized_name(ifc, name, ifc->house->form->record->roof, type, sizeof type);
    const tn_ifc_part part = {.entity = "IFCSLAB", .tail = ",.ROOF.", .type_name = type};
    unsigned made = put_part(ifc, slab, part, roof->where, key);
    const tn_ifc_property external = tn_ifc_truth("IsExternal", true);
    const tn_ifc_quantity quantities[] = {{"Width", 'L', (double)ifc->house->form->record->roof / longer},
                                          {"GrossArea", 'A', slab->plan * longer},
                                          {"NetArea", 'A', slab->plan * longer},
                                          {"GrossVolume", 'V', slab->volume},
                                          {"NetVolume", 'V', slab->volume}};
    tn_ifc_properties(ifc, made, "Pset_SlabCommon", type, &external, 1);
    tn_ifc_quantities(ifc, made, "Qto_SlabBaseQuantities", key, quantities, 5);
    tn_ifc_make_of(ifc, &solid, made);
    tn_stepfile_list_add(&roof->slabs, made);
    roof->area += slab->plan * longer;
    roof->plan += slab->plan;
}

/* The whole is written after its parts, but placed before them. */
static unsigned put_whole(tn_ifc *ifc, const char *type, tn_ifc_roof *roof)
{
    const char *name = tn_solid_kind_text(TN_SOLID_ROOF);
    const tn_ifc_part part = {.entity = "IFCROOF", .tail = type, .name = name, .type_name = name, .where = roof->where};
    unsigned made = tn_ifc_put(ifc, &part, "roof");
    const char *slabs = tn_stepfile_list_text(&roof->slabs);
    tn_stepfile_add(&ifc->step, "IFCRELAGGREGATES('%s',$,$,$,#%u,%s)",
                    tn_stepfile_guid(&ifc->step, "slabs of roof").text, made, slabs ? slabs : "()");
    const tn_ifc_property external = tn_ifc_truth("IsExternal", true);
    const tn_ifc_quantity quantities[] = {
        {"GrossArea", 'A', roof->area}, {"NetArea", 'A', roof->area}, {"ProjectedArea", 'A', roof->plan}};
    tn_ifc_properties(ifc, made, "Pset_RoofCommon", name, &external, 1);
    tn_ifc_quantities(ifc, made, "Qto_RoofBaseQuantities", "roof", quantities, 3);
    tn_ifc_classify(ifc, TN_OF_ROOF, made);
    return made;
}

void tn_ifc_put_roof(tn_ifc *ifc, tn_stepfile_list *list)
{
    const tn_solids *solids = ifc->solids;
    const char *type = whole_type(ifc);
    uint32_t highest = 0;
    for (size_t i = 0; i < solids->prism_count; i++) {
        const tn_prism *prism = &solids->prisms[i];
        uint32_t storey = prism->kind == TN_SOLID_ROOF ? ifc->house->cells[prism->of].storey : 0;
        highest = storey > highest ? storey : highest;
    }
    if (!type || ifc->storey != highest)
        return;
    tn_ifc_roof roof = {.where = tn_stepfile_placement(&ifc->step, ifc->placement, 0, 0, 0)};
    for (size_t i = 0; i < solids->prism_count; i++) {
        tn_ifc_prisms slab;
        if (solids->prisms[i].kind == TN_SOLID_ROOF && take_part(ifc, i, &slab))
            put_slab(ifc, &slab, &roof);
    }
    tn_stepfile_list_add(list, put_whole(ifc, type, &roof));
    ifc->failed |= roof.slabs.text.failed;
    tn_stepfile_list_clear(&roof.slabs);
}
