/* Writes what stands in a storey of a building model by itself: posts, beams, guards, furniture. */
#include <stdio.h>

#include "runtime/house/export/ifc.h"

/* ---- what parts are known by */

void tn_ifc_cell_key(const tn_ifc *ifc, uint32_t index, char key[TN_IFC_CELL_KEY])
{
    const tn_cell *cell = &ifc->house->cells[index];
    const tn_house_form *form = ifc->house->form;
    const tn_schema *schema = form->schema;
    snprintf(key, TN_IFC_CELL_KEY, "%u %s %s", cell->tray, tn_text(schema->module, schema->fields[cell->zone].name),
             tn_text(form->module, form->module->STOREY_records[form->record->storey_first + cell->storey].name));
}

void tn_ifc_face_key(const tn_ifc *ifc, uint32_t index, char key[TN_IFC_FACE_KEY])
{
    const tn_face *face = &ifc->house->faces[index];
    char first[TN_IFC_CELL_KEY], second[TN_IFC_CELL_KEY];
    tn_ifc_cell_key(ifc, face->first, first);
    if (face->second == TN_NO_CELL)
        snprintf(second, sizeof second, "side %d", (int)face->side);
    else
        tn_ifc_cell_key(ifc, face->second, second);
    snprintf(key, TN_IFC_FACE_KEY, "%s, %s", first, second);
}

/* A place in plan is known by the first cell that has a corner there. */
static void corner_key(const tn_ifc *ifc, int64_t x, int64_t y, char *key, size_t size)
{
    char cell[TN_IFC_CELL_KEY];
    for (uint32_t i = 0; i < ifc->house->cell_count; i++) {
        const tn_cell *c = &ifc->house->cells[i];
        bool right = c->at.x1 == x, front = c->at.y1 == y;
        if (c->storey != ifc->storey || (!right && c->at.x0 != x) || (!front && c->at.y0 != y))
            continue;
        tn_ifc_cell_key(ifc, i, cell);
        snprintf(key, size, "%s, corner %d", cell, 2 * front + right);
        return;
    }
    snprintf(key, size, "%u", ifc->storey);
}

void tn_ifc_sized_name(const tn_ifc *ifc, const char *word, int64_t thick, char *text, size_t size)
{
    char length[64];
    tn_length_write_style(thick, tn_house_length_style(ifc->house), length, sizeof length);
    snprintf(text, size, "%s %s", word, length);
}

/* ---- shapes */

double tn_ifc_box_volume(const tn_box *b)
{
    return (double)(b->x1 - b->x0) / 1e9 * ((double)(b->y1 - b->y0) / 1e9) * ((double)(b->z1 - b->z0) / 1e9);
}

double tn_ifc_prism_volume(const tn_block_corner *c, size_t count)
{
    double six = 0;
    for (size_t i = 1; i + 1 < count; i++) {
        double x[2], y[2], high = c[0].high - c[0].low;
        for (size_t k = 0; k < 2; k++) {
            x[k] = (c[i + k].x - c[0].x) / 1e9;
            y[k] = (c[i + k].y - c[0].y) / 1e9;
            high += c[i + k].high - c[i + k].low;
        }
        six += (x[0] * y[1] - x[1] * y[0]) * (high / 1e9);
    }
    return six / 6;
}

unsigned tn_ifc_shape(tn_ifc *ifc, const char *kind, tn_stepfile_list *solids)
{
    const char *list = tn_stepfile_list_text(solids);
    unsigned shape = list ? tn_stepfile_shape(&ifc->step, tn_stepfile_body(&ifc->step, kind, list), 0) : 0;
    ifc->failed |= solids->text.failed;
    tn_stepfile_list_clear(solids);
    return shape;
}

unsigned tn_ifc_box(tn_ifc *ifc, const double low[3], const double high[3])
{
    char list[16];
    snprintf(list, sizeof list, "(#%u)", tn_stepfile_solid(&ifc->step, low, high));
    return tn_stepfile_shape(&ifc->step, tn_stepfile_body(&ifc->step, "SweptSolid", list), 0);
}

/* A box that stands at its low corner, in a storey or in another placement that is not turned, whose origin is at
 * (x, y) of the plan. */
static unsigned stand(tn_ifc *ifc, const tn_solid *s, unsigned within, unsigned *where)
{
    const tn_box *b = &s->at;
    double floor = (double)ifc->house->form->level[ifc->storey];
    const double low[3] = {0, 0, 0},
                 high[3] = {(double)(b->x1 - b->x0), (double)(b->y1 - b->y0), (double)(b->z1 - b->z0)};
    *where = tn_stepfile_placement(&ifc->step, within, (double)b->x0, (double)b->y0, (double)b->z0 - floor);
    tn_ifc_look_as(ifc, s);
    return tn_ifc_box(ifc, low, high);
}

/* ---- posts and beams */

/* One of the two: as long as `length`, and across that by two others. */
static void put_bar(tn_ifc *ifc, const tn_solid *s, const tn_ifc_part *part, const char *key, const double across[2],
                    double length, tn_stepfile_list *list)
{
    bool post = s->kind == TN_SOLID_POST;
    tn_ifc_part placed = *part;
    placed.shape = stand(ifc, s, ifc->placement, &placed.where);
    unsigned bar = tn_ifc_put(ifc, &placed, key);
    const tn_ifc_property bears = tn_ifc_truth("LoadBearing", true);
    const tn_ifc_quantity quantities[] = {{"Length", 'L', length},
                                          {"CrossSectionArea", 'A', across[0] * across[1] / 1e18},
                                          {"OuterSurfaceArea", 'A', 2 * (across[0] + across[1]) * length / 1e18},
                                          {"GrossVolume", 'V', tn_ifc_box_volume(&s->at)},
                                          {"NetVolume", 'V', tn_ifc_box_volume(&s->at)}};
    tn_ifc_properties(ifc, bar, post ? "Pset_ColumnCommon" : "Pset_BeamCommon", part->type_name, &bears, 1);
    tn_ifc_quantities(ifc, bar, post ? "Qto_ColumnBaseQuantities" : "Qto_BeamBaseQuantities", key, quantities, 5);
    tn_ifc_make_of(ifc, s, bar);
    tn_stepfile_list_add(list, bar);
}

static void put_post(tn_ifc *ifc, const tn_solid *s, tn_stepfile_list *list)
{
    char key[TN_IFC_FACE_KEY], where[TN_IFC_CELL_KEY + 20], type[100];
    const tn_box *b = &s->at;
    int64_t x = b->x1 - b->x0, y = b->y1 - b->y0;
    corner_key(ifc, b->x0 + x / 2, b->y0 + y / 2, where, sizeof where);
    snprintf(key, sizeof key, "post %s", where);
    tn_ifc_sized_name(ifc, "post", x < y ? x : y, type, sizeof type);
    const tn_ifc_part part = {
        .entity = "IFCCOLUMN", .tail = ",.COLUMN.", .name = tn_solid_kind_text(s->kind), .type_name = type};
    put_bar(ifc, s, &part, key, (double[]){(double)x, (double)y}, (double)(b->z1 - b->z0), list);
}

static void put_beam(tn_ifc *ifc, const tn_solid *s, tn_stepfile_list *list)
{
    char key[TN_IFC_FACE_KEY], where[TN_IFC_CELL_KEY + 20];
    const tn_box *b = &s->at;
    const char *name = tn_text(ifc->house->form->module, tn_form_beam(ifc->house->form, s->item)->name);
    int64_t x = b->x1 - b->x0, y = b->y1 - b->y0;
    bool in_x = x > y;
    corner_key(ifc, in_x ? b->x0 : b->x0 + x / 2, in_x ? b->y0 + y / 2 : b->y0, where, sizeof where);
    snprintf(key, sizeof key, "beam %s", where);
    const tn_ifc_part part = {.entity = "IFCBEAM", .tail = ",.BEAM.", .name = name, .type_name = name};
    put_bar(ifc, s, &part, key, (double[]){(double)(in_x ? y : x), (double)(b->z1 - b->z0)}, (double)(in_x ? x : y),
            list);
}

/* ---- guards and furniture */

unsigned tn_ifc_put_guard(tn_ifc *ifc, const tn_solid *s, unsigned within)
{
    char key[TN_IFC_FACE_KEY + 20], face[TN_IFC_FACE_KEY], type[100];
    double x = (double)(s->at.x1 - s->at.x0), y = (double)(s->at.y1 - s->at.y0);
    tn_ifc_face_key(ifc, s->of, face);
    snprintf(key, sizeof key, "guard %s", face);
    tn_ifc_sized_name(ifc, "guard", s->at.z1 - s->at.z0, type, sizeof type);
    tn_ifc_part part = {
        .entity = "IFCRAILING", .tail = ",.GUARDRAIL.", .name = tn_solid_kind_text(s->kind), .type_name = type};
    part.shape = stand(ifc, s, within, &part.where);
    unsigned guard = tn_ifc_put(ifc, &part, key);
    tn_ifc_property high = {.name = "Height"};
    snprintf(high.value, sizeof high.value, "IFCPOSITIVELENGTHMEASURE(%s)",
             tn_stepfile_length(&ifc->step, (double)(s->at.z1 - s->at.z0)).text);
    const tn_ifc_quantity length = {"Length", 'L', x > y ? x : y};
    tn_ifc_properties(ifc, guard, "Pset_RailingCommon", type, &high, 1);
    tn_ifc_quantities(ifc, guard, "Qto_RailingBaseQuantities", NULL, &length, 1);
    tn_ifc_make_of(ifc, s, guard);
    return guard;
}

/* IfcFurnitureTypeEnum, of what plans draw. */
static const char *furniture_type(tn_item_symbol symbol)
{
    switch (symbol) {
    case TN_SYMBOL_BED:
        return ".BED.";
    case TN_SYMBOL_TABLE:
        return ".TABLE.";
    case TN_SYMBOL_CHAIR:
        return ".CHAIR.";
    case TN_SYMBOL_SOFA:
        return ".SOFA.";
    case TN_SYMBOL_DESK:
        return ".DESK.";
    case TN_SYMBOL_SHELF:
        return ".SHELF.";
    default:
        return ".NOTDEFINED.";
    }
}

static void put_item(tn_ifc *ifc, const tn_solid *s, tn_stepfile_list *list)
{
    const tn_module *module = ifc->house->form->module;
    const tn_tile_box_record *box = &module->TILE_BOX_records[s->item];
    char key[TN_IFC_CELL_KEY + TN_NAME_MAX + 10], cell[TN_IFC_CELL_KEY], tail[20];
    tn_ifc_cell_key(ifc, s->of, cell);
    snprintf(key, sizeof key, "item %s %s", tn_text(module, box->name), cell);
    snprintf(tail, sizeof tail, ",%s", furniture_type((tn_item_symbol)box->symbol));
    tn_ifc_part part = {.entity = "IFCFURNITURE",
                        .tail = tail,
                        .type_tail = ",.NOTDEFINED.,.NOTDEFINED.",
                        .name = tn_text(module, box->name),
                        .type_name = tn_text(module, box->name)};
    part.shape = stand(ifc, s, ifc->placement, &part.where);
    unsigned item = tn_ifc_put(ifc, &part, key);
    tn_ifc_make_of(ifc, s, item);
    tn_stepfile_list_add(list, item);
}

/* ---- all of them */

/* Guards around flights are part of their stairs. */
static bool is_of_stair(const tn_ifc *ifc, const tn_solid *guard)
{
    return tn_form_flight(ifc->house->form, ifc->house->faces[guard->of].kind) != NULL;
}

void tn_ifc_put_parts(tn_ifc *ifc, tn_stepfile_list *list)
{
    ifc->floors[ifc->storey] = tn_ifc_put_deck(ifc, false, list);
    ifc->tops[ifc->storey] = tn_ifc_put_deck(ifc, true, list);
    for (size_t i = 0; i < ifc->solids->box_count; i++) {
        const tn_solid *s = &ifc->solids->boxes[i];
        if (s->kind == TN_SOLID_POST && s->of == ifc->storey && !ifc->joined[i])
            put_post(ifc, s, list);
        else if (s->kind == TN_SOLID_BEAM && s->of == ifc->storey)
            put_beam(ifc, s, list);
        else if (s->kind == TN_SOLID_GUARD && tn_guard_storey(ifc->house, s->of) == ifc->storey && !is_of_stair(ifc, s))
            tn_stepfile_list_add(list, tn_ifc_put_guard(ifc, s, ifc->placement));
        else if (s->kind == TN_SOLID_ITEM && ifc->house->cells[s->of].storey == ifc->storey)
            put_item(ifc, s, list);
    }
}
