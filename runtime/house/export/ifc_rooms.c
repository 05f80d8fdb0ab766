/* Writes the rooms of a building model: spaces with their areas, in zones by what they are for, and what bounds them.
 */
#include <stdio.h>
#include <stdlib.h>

#include "runtime/house/export/ifc.h"

/* ---- bodies */

/* A polygon of the plan from one level to the underside of a roof. */
static unsigned put_facet(tn_ifc *ifc, const tn_slopes *slopes, const tn_facet *facet, double from, int64_t foot,
                          double *volume)
{
    tn_block_corner corners[TN_FACET_CORNERS];
    for (size_t i = 0; i < facet->count; i++) {
        const tn_fraction *at = facet->at[i];
        corners[i] = (tn_block_corner){tn_fraction_value(at[0]), tn_fraction_value(at[1]), from,
                                       tn_fraction_value(tn_slope_at(slopes, facet->plane, at[0], at[1], foot))};
    }
    *volume += tn_ifc_prism_volume(corners, facet->count);
    return tn_stepfile_prism(&ifc->step, corners, facet->count);
}

/* The clear room of a cell, above the floor of the storey at hand: up to the deck, or to the slab of an open roof.
 * faceted: the room has such a roof somewhere. */
static void put_cell(tn_ifc *ifc, uint32_t cell, bool faceted, tn_stepfile_list *solids, double *volume)
{
    const tn_house_form *form = ifc->house->form;
    const tn_cell *c = &ifc->house->cells[cell];
    tn_rectangle r = tn_cell_clear(ifc->house, cell);
    bool open = tn_cell_is_open_above(ifc->house, cell);
    int64_t ground = form->level[ifc->storey], floor = form->level[c->storey] - ground;
    int64_t from = c->open ? floor - form->record->deck : floor; /* a void goes through the deck */
    tn_slopes slopes = {.items = {{0, 0, 0}}, .count = 1, .first = 1, .bottom = 1};
    int64_t foot = open ? form->level[c->storey + 1] - ground : floor + tn_form_clear(form, c->storey);
    tn_facet facets[TN_FACETS_MAX];
    if (!faceted) {
        const double low[3] = {(double)r.x0, (double)r.y0, (double)from},
                     high[3] = {(double)r.x1, (double)r.y1, (double)foot};
        tn_stepfile_list_add(solids, tn_stepfile_solid(&ifc->step, low, high));
        *volume += tn_ifc_box_volume(&(tn_box){r.x0, r.x1, r.y0, r.y1, from, foot});
        return;
    }
    if (open)
        slopes = tn_roof_slopes_of(ifc->house, cell);
    size_t count = tn_slopes_cut(&slopes, r, facets);
    for (size_t i = 0; i < count; i++)
        tn_stepfile_list_add(solids, put_facet(ifc, &slopes, &facets[i], (double)from, foot, volume));
}

/* Is some cell of a room open to a roof? */
static bool is_faceted(const tn_ifc *ifc, uint32_t room)
{
    for (uint32_t i = room; i < ifc->house->cell_count; i++)
        if (ifc->names.rooms[i] == room && tn_cell_is_open_above(ifc->house, i))
            return true;
    return false;
}

/* ---- spaces */

/* Its number, as drawings have it. */
static const char *number_of(const tn_ifc *ifc, uint32_t room)
{
    for (size_t i = 0; i < ifc->names.room_count; i++)
        if (ifc->names.numbered[i].room == room && ifc->names.numbered[i].storey == ifc->storey)
            return ifc->names.numbered[i].number;
    return "";
}

/* A function's name as words. */
static void spell(const char *function, char text[TN_NAME_MAX + 1])
{
    snprintf(text, TN_NAME_MAX + 1, "%s", function);
    for (char *c = text; *c; c++)
        *c = (char)(*c == '-' || *c == '_' ? ' ' : *c);
}

static void put_zone(tn_ifc *ifc, const char *function, unsigned space)
{
    tn_stepfile *step = &ifc->step;
    unsigned *zone = tn_ifc_group_of(ifc, TN_IFC_ZONE, function, space);
    if (*zone == 0)
        *zone = tn_stepfile_add(step, "IFCZONE('%s',$,'%s',$,$,$)", tn_stepfile_guid(step, "zone %s", function).text,
                                tn_stepfile_text(function).text);
}

/* What is added up of a room's cells. level: it is as high as its storey all over. */
typedef struct tn_ifc_room {
    double volume;
    bool level;
    unsigned shape;
} tn_ifc_room;

static tn_ifc_room measure(tn_ifc *ifc, uint32_t room)
{
    tn_ifc_room sums = {0};
    tn_stepfile_list solids = {0};
    bool faceted = is_faceted(ifc, room);
    ifc->step.style = 0;
    sums.level = !faceted;
    for (uint32_t i = room; i < ifc->house->cell_count; i++) {
        if (ifc->names.rooms[i] != room)
            continue;
        put_cell(ifc, i, faceted, &solids, &sums.volume);
        sums.level &= !ifc->house->cells[i].open;
    }
    sums.shape = tn_ifc_shape(ifc, faceted ? "Tessellation" : "SweptSolid", &solids);
    return sums;
}

static void put_space(tn_ifc *ifc, uint32_t room, tn_stepfile_list *list)
{
    const tn_house *house = ifc->house;
    const char *function = tn_text(house->form->module, tn_form_rule(house->form, house->cells[room].function)->name);
    bool outdoor = tn_cell_is_outdoor(house, room);
    tn_ifc_room sums = measure(ifc, room);
    tn_int128 gross, net;
    char key[TN_IFC_CELL_KEY + 10], cell[TN_IFC_CELL_KEY], words[TN_NAME_MAX + 1];
    spell(function, words);
    tn_ifc_cell_key(ifc, room, cell);
    snprintf(key, sizeof key, "space %s", cell);
    const tn_ifc_part part = {.entity = "IFCSPACE",
                              .tail = outdoor ? ",.ELEMENT.,.EXTERNAL.,$" : ",.ELEMENT.,.INTERNAL.,$",
                              .type_tail = ",.NOTDEFINED.,$",
                              .name = number_of(ifc, room),
                              .type_name = function,
                              .long_name = words,
                              .shape = sums.shape,
                              .where = tn_stepfile_placement(&ifc->step, ifc->placement, 0, 0, 0)};
    unsigned space = tn_ifc_put(ifc, &part, key);
    tn_room_areas(house, ifc->names.rooms, room, &gross, &net);
    const tn_ifc_property external = tn_ifc_truth("IsExternal", outdoor);
    const tn_ifc_quantity quantities[] = {{"GrossFloorArea", 'A', (double)gross / 1e18},
                                          {"NetFloorArea", 'A', (double)net / 1e18},
                                          {"NetVolume", 'V', sums.volume},
                                          {"Height", 'L', (double)tn_form_clear(house->form, ifc->storey)}};
    tn_ifc_properties(ifc, space, "Pset_SpaceCommon", function, &external, 1);
    tn_ifc_quantities(ifc, space, "Qto_SpaceBaseQuantities", key, quantities, sums.level ? 4 : 3);
    put_zone(ifc, function, space);
    tn_ifc_classify(ifc, tn_form_parts(house->form) + house->cells[room].function, space);
    ifc->spaces[room] = space;
    tn_stepfile_list_add(list, space);
}

void tn_ifc_put_spaces(tn_ifc *ifc, tn_stepfile_list *list)
{
    for (uint32_t i = 0; i < ifc->house->cell_count; i++)
        if (ifc->names.rooms[i] == i && ifc->house->cells[i].storey == ifc->storey && !ifc->house->cells[i].open)
            put_space(ifc, i, list);
}

/* ---- what bounds them */

/* A side of a space: a flat box, with the way out of the space as its number among right angles from x on, or up or
 * down. */
typedef enum tn_way_out { OUT_UP = 4, OUT_DOWN } tn_way_out;

/* Where it lies: from a corner along its first axis, and up or across. */
static unsigned surface_of(tn_ifc *ifc, const tn_box *b, int out)
{
    tn_stepfile *step = &ifc->step;
    double x0 = (double)b->x0, x1 = (double)b->x1, y0 = (double)b->y0, y1 = (double)b->y1, z0 = (double)b->z0;
    bool flat = out >= OUT_UP;
    int along = flat ? 0 : (out + 1) % 4;
    double wide = flat || along % 2 == 0 ? x1 - x0 : y1 - y0, high = flat ? y1 - y0 : (double)(b->z1 - b->z0);
    const double around[5][2] = {{0, 0}, {wide, 0}, {wide, high}, {0, high}, {0, 0}};
    unsigned corner = tn_stepfile_add(
        step, "IFCCARTESIANPOINT((%s,%s,%s))", tn_stepfile_length(step, along == 2 ? x1 : x0).text,
        tn_stepfile_length(step, along == 3 || out == OUT_DOWN ? y1 : y0).text, tn_stepfile_length(step, z0).text);
    unsigned axes = tn_stepfile_add(step, "IFCAXIS2PLACEMENT3D(#%u,#%u,#%u)", corner,
                                    out == OUT_UP     ? step->z
                                    : out == OUT_DOWN ? step->down
                                                      : step->along[out],
                                    step->along[along]);
    unsigned plane = tn_stepfile_add(step, "IFCPLANE(#%u)", axes), curve = tn_stepfile_curve(step, around, 5);
    unsigned surface = tn_stepfile_add(step, "IFCCURVEBOUNDEDPLANE(#%u,#%u,())", plane, curve);
    return tn_stepfile_add(step, "IFCCONNECTIONSURFACEGEOMETRY(#%u,$)", surface);
}

/* The part that bounds the space of a cell there, if both are. */
static void bound(tn_ifc *ifc, uint32_t cell, unsigned part, tn_box at, int out, bool external, const char *key)
{
    uint32_t room = ifc->names.rooms[cell];
    unsigned space = ifc->spaces[room];
    int64_t floor = ifc->house->form->level[ifc->house->cells[room].storey];
    char of[TN_IFC_CELL_KEY];
    bool empty = (at.x0 >= at.x1) + (at.y0 >= at.y1) + (at.z0 >= at.z1) > 1;
    if (!space || !part || empty)
        return;
    at.z0 -= floor;
    at.z1 -= floor;
    tn_ifc_cell_key(ifc, cell, of);
    unsigned surface = surface_of(ifc, &at, out);
    tn_stepfile_add(&ifc->step, "IFCRELSPACEBOUNDARY('%s',$,'1stLevel',$,#%u,#%u,#%u,.PHYSICAL.,.%s.)",
                    tn_stepfile_guid(&ifc->step, "%s bounds %s", key, of).text, space, part, surface,
                    external ? "EXTERNAL" : "INTERNAL");
}

static int64_t least(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static int64_t most(int64_t a, int64_t b)
{
    return a > b ? a : b;
}

/* The side of a wall, or of what is in it, that a cell of its face sees. */
static void bound_by_wall(tn_ifc *ifc, uint32_t number, uint32_t cell)
{
    const tn_face *face = &ifc->house->faces[number];
    const tn_ifc_wall *wall = &ifc->walls[number];
    bool in_y = face->at.x0 == face->at.x1, external = tn_face_is_outer(ifc->house, face);
    tn_rectangle clear = tn_cell_clear(ifc->house, cell);
    const tn_rectangle *room = &ifc->house->cells[cell].at;
    int64_t half = tn_face_thickness(ifc->house, face) / 2;
    bool beyond = in_y ? room->x0 >= face->at.x0 : room->y0 >= face->at.y0; /* the cell, of the wall */
    int64_t plane = (in_y ? face->at.x0 : face->at.y0) + (beyond ? half : -half);
    int out = (in_y ? 0 : 1) + (beyond ? 2 : 0);
    char key[TN_IFC_FACE_KEY], of[TN_IFC_FACE_KEY + 10];
    tn_box side = wall->box, hole;
    if (in_y) {
        side.x0 = side.x1 = plane;
        side.y0 = most(clear.y0, wall->box.y0);
        side.y1 = least(clear.y1, wall->box.y1);
    } else {
        side.y0 = side.y1 = plane;
        side.x0 = most(clear.x0, wall->box.x0);
        side.x1 = least(clear.x1, wall->box.x1);
    }
    tn_ifc_face_key(ifc, number, key);
    snprintf(of, sizeof of, "wall %s", key);
    bound(ifc, cell, wall->part, side, out, external, of);
    if (!wall->filling || !tn_house_hole(ifc->house, face, &hole))
        return;
    if (in_y)
        hole.x0 = hole.x1 = plane;
    else
        hole.y0 = hole.y1 = plane;
    snprintf(of, sizeof of, "filling %s", key);
    bound(ifc, cell, wall->filling, hole, out, external, of);
}

/* What of the decks above and below lies over or under a cell. */
static void bound_by_decks(tn_ifc *ifc, uint32_t cell)
{
    const tn_house *house = ifc->house;
    const tn_cell *c = &house->cells[cell];
    tn_rectangle clear = tn_cell_clear(house, cell);
    for (size_t i = 0; i < ifc->solids->box_count; i++) {
        const tn_solid *s = &ifc->solids->boxes[i];
        bool below = s->kind == TN_SOLID_DECK && s->of == c->storey && !c->open,
             above = s->kind == TN_SOLID_DECK && s->of == c->storey + 1,
             top = s->kind == TN_SOLID_ROOFDECK && house->cells[s->of].storey == c->storey;
        if (!below && !above && !top)
            continue;
        tn_rectangle at = tn_rectangles_common(&clear, &(tn_rectangle){s->at.x0, s->at.x1, s->at.y0, s->at.y1});
        int64_t z = below ? s->at.z1 : s->at.z0;
        unsigned part = top ? ifc->tops[c->storey] : ifc->floors[c->storey + above];
        if (at.x0 < at.x1 && at.y0 < at.y1)
            bound(ifc, cell, part, (tn_box){at.x0, at.x1, at.y0, at.y1, z, z}, below ? OUT_DOWN : OUT_UP,
                  top || (below && c->storey == 0), below ? "floor" : "ceiling");
    }
}

void tn_ifc_put_boundaries(tn_ifc *ifc)
{
    const tn_house *house = ifc->house;
    for (uint32_t i = 0; i < house->face_count; i++) {
        const uint32_t sides[2] = {house->faces[i].first, house->faces[i].second};
        for (unsigned k = 0; k < 2 && ifc->walls[i].part; k++)
            if (sides[k] != TN_NO_CELL)
                bound_by_wall(ifc, i, sides[k]);
    }
    for (uint32_t i = 0; i < house->cell_count; i++)
        bound_by_decks(ifc, i);
}
