/* Adds the rooms of a house to its building model: spaces with their areas, and the walls that bound them. */
#include <inttypes.h>
#include <stdlib.h>

#include "runtime/house/export/ifc_parts.h"

void tn_ifc_clear(tn_ifc *ifc)
{
    tn_stepfile_clear(&ifc->step);
    free(ifc->rooms);
    free(ifc->walls);
    free(ifc->spaces);
    tn_swings_clear(&ifc->doors);
    for (uint32_t i = 0; ifc->made && i < TN_SOLID_COUNT + ifc->house->form->record->material_count; i++)
        tn_stepfile_list_clear(&ifc->made[i]);
    free(ifc->made);
}

/* Square metres. */
static double area_of(tn_rectangle r)
{
    return (double)(r.x1 - r.x0) * (double)(r.y1 - r.y0) / 1e18;
}

/* The clear box of a cell, above the floor of the storey at hand. */
static unsigned put_cell(tn_ifc *ifc, uint32_t cell)
{
    const tn_cell *c = &ifc->house->cells[cell];
    const tn_house_form *form = ifc->house->form;
    tn_rectangle r = tn_cell_clear(ifc->house, cell);
    double floor = (double)(form->level[c->storey] - form->level[ifc->storey]);
    double from = c->open ? floor - (double)form->record->deck : floor; /* a void goes through the deck */
    const double low[3] = {(double)r.x0, (double)r.y0, from},
                 high[3] = {(double)r.x1, (double)r.y1, floor + (double)tn_form_clear(form, c->storey)};
    return tn_stepfile_solid(&ifc->step, low, high);
}

static void put_areas(tn_ifc *ifc, unsigned space, uint32_t room, double gross, double net)
{
    tn_stepfile *step = &ifc->step;
    unsigned a = tn_stepfile_add(step, "IFCQUANTITYAREA('GrossFloorArea',$,$,%.6f,$)", gross);
    unsigned b = tn_stepfile_add(step, "IFCQUANTITYAREA('NetFloorArea',$,$,%.6f,$)", net);
    unsigned set = tn_stepfile_add(step, "IFCELEMENTQUANTITY('%s',$,'Qto_SpaceBaseQuantities',$,$,(#%u,#%u))",
                                   tn_stepfile_guid(step, "areas", room).text, a, b);
    tn_stepfile_add(step, "IFCRELDEFINESBYPROPERTIES('%s',$,$,$,(#%u),#%u)",
                    tn_stepfile_guid(step, "areas of room", room).text, space, set);
}

static void put_space(tn_ifc *ifc, uint32_t room, tn_stepfile_list *list)
{
    const tn_house *house = ifc->house;
    tn_stepfile *step = &ifc->step;
    tn_stepfile_list solids = {0};
    double gross = 0, net = 0;
    for (uint32_t i = room; i < house->cell_count; i++) {
        if (ifc->rooms[i] != room)
            continue;
        tn_stepfile_list_add(&solids, put_cell(ifc, i));
        gross += house->cells[i].open ? 0 : area_of(house->cells[i].at);
        net += house->cells[i].open ? 0 : area_of(tn_cell_clear(house, i));
    }
    unsigned shape = tn_stepfile_shape(step, tn_stepfile_list_text(&solids));
    const char *function = tn_text(house->form->module, tn_form_rule(house->form, house->cells[room].function)->name);
    unsigned space = tn_stepfile_add(step, "IFCSPACE('%s',$,'%s',$,$,#%u,#%u,$,.ELEMENT.,.INTERNAL.,$)",
                                     tn_stepfile_guid(step, "space", room).text, tn_stepfile_text(function).text,
                                     tn_stepfile_placement(step, ifc->placement, 0, 0, 0), shape);
    ifc->spaces[room] = space;
    ifc->failed |= solids.text.failed;
    tn_stepfile_list_clear(&solids);
    tn_stepfile_list_add(list, space);
    put_areas(ifc, space, room, gross, net);
}

void tn_ifc_spaces(tn_ifc *ifc, tn_stepfile_list *list)
{
    for (uint32_t i = 0; i < ifc->house->cell_count; i++)
        if (ifc->rooms[i] == i && ifc->house->cells[i].storey == ifc->storey && !ifc->house->cells[i].open)
            put_space(ifc, i, list);
}

/* Which walls bound which rooms. */
static void put_boundaries(tn_ifc *ifc)
{
    const tn_house *house = ifc->house;
    for (size_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        const uint32_t sides[2] = {face->first, face->second};
        for (unsigned k = 0; k < 2 && ifc->walls[i]; k++) {
            unsigned space = sides[k] == TN_NO_CELL ? 0 : ifc->spaces[ifc->rooms[sides[k]]];
            if (space)
                tn_stepfile_add(&ifc->step, "IFCRELSPACEBOUNDARY('%s',$,$,$,#%u,#%u,$,.PHYSICAL.,.%s.)",
                                tn_stepfile_guid(&ifc->step, "boundary", (unsigned)(2 * i + k)).text, space,
                                ifc->walls[i], face->relation == TN_FACE_OUTSIDE ? "EXTERNAL" : "INTERNAL");
        }
    }
}

void tn_ifc_materials(tn_ifc *ifc)
{
    const tn_house_form *form = ifc->house->form;
    for (uint32_t i = 0; i < TN_SOLID_COUNT + form->record->material_count; i++) {
        const char *list = tn_stepfile_list_text(&ifc->made[i]);
        if (!list) {
            ifc->failed |= ifc->made[i].text.failed;
            continue;
        }
        uint32_t record = form->record->material_first + i - TN_SOLID_COUNT;
        const char *name = i < TN_SOLID_COUNT ? tn_solid_kind_text((tn_solid_kind)i)
                                              : tn_text(form->module, form->module->MATERIAL_records[record].name);
        unsigned material = tn_stepfile_add(&ifc->step, "IFCMATERIAL('%s',$,$)", tn_stepfile_text(name).text);
        tn_stepfile_add(&ifc->step, "IFCRELASSOCIATESMATERIAL('%s',$,$,$,%s,#%u)",
                        tn_stepfile_guid(&ifc->step, "material", i).text, list, material);
    }
    put_boundaries(ifc);
}
