/* Writes a house as IFC4 (ISO 16739-1): the project, its storeys, and in these rooms and parts of the building. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/house/export/export.h"
#include "runtime/house/export/step.h"
#include "runtime/house/model/swings.h"
#include "runtime/house/schedule/cost.h"

/* How layers lie in a part that has them: in the direction of its axis, against it, or in no direction that is said. */
typedef enum tn_layers_lie { LIE_ALONG, LIE_AGAINST, LIE_ANYHOW, LIES } tn_layers_lie;

/* What a set of common properties is about. */
typedef enum tn_ifc_common { IFC_WALLS, IFC_DOORS, IFC_WINDOWS, IFC_COMMON_COUNT } tn_ifc_common;

typedef struct tn_ifc {
    tn_stepfile step;
    const tn_house *house;
    const tn_solids *solids;
    uint32_t *rooms;    /* [cell] its room; owned */
    unsigned *walls;    /* [face] the wall that stands in it; owned */
    unsigned *spaces;   /* [cell] the space of the room that begins there; owned */
    unsigned placement; /* of the storey at hand */
    uint32_t storey;
    tn_swings doors; /* of the storey at hand; owned */
    tn_stepfile_list
        *made;           /* parts of each kind that the form has no material for, then those of each material; owned */
    unsigned *materials; /* as in `made`, then of the form's layers; owned */
    tn_stepfile_list layered[TN_LAYERED_COUNT][LIES]; /* parts that consist of layers; owned */
    tn_stepfile_list common[IFC_COMMON_COUNT][2];     /* walls, doors, windows: indoors, and in outside faces; owned */
    bool failed;                                      /* out of memory */
} tn_ifc;

static void ifc_clear(tn_ifc *ifc)
{
    tn_stepfile_clear(&ifc->step);
    free(ifc->rooms);
    free(ifc->walls);
    free(ifc->spaces);
    tn_swings_clear(&ifc->doors);
    for (uint32_t i = 0; ifc->made && i < TN_SOLID_COUNT + ifc->house->form->record->material_count; i++)
        tn_stepfile_list_clear(&ifc->made[i]);
    free(ifc->made);
    free(ifc->materials);
    for (int of = 0; of < TN_LAYERED_COUNT; of++)
        for (int lie = 0; lie < LIES; lie++)
            tn_stepfile_list_clear(&ifc->layered[of][lie]);
    for (int i = 0; i < IFC_COMMON_COUNT; i++)
        for (int outer = 0; outer < 2; outer++)
            tn_stepfile_list_clear(&ifc->common[i][outer]);
}

/* ---- spaces: rooms with their areas, and the walls that bound them */

/* Square metres. */
static double area_of(tn_rectangle r)
{
    return (double)(r.x1 - r.x0) * (double)(r.y1 - r.y0) / 1e18;
}

/* A polygon of the plan from one level to the underside of a roof. */
static unsigned put_facet(tn_ifc *ifc, const tn_slopes *slopes, const tn_facet *facet, double from, int64_t foot)
{
    tn_block_corner corners[TN_FACET_CORNERS];
    for (size_t i = 0; i < facet->count; i++) {
        const tn_fraction *at = facet->at[i];
        corners[i] = (tn_block_corner){tn_fraction_value(at[0]), tn_fraction_value(at[1]), from,
                                       tn_fraction_value(tn_slope_at(slopes, facet->plane, at[0], at[1], foot))};
    }
    return tn_stepfile_prism(&ifc->step, corners, facet->count);
}

/* The clear room of a cell, above the floor of the storey at hand: up to the deck, or to the slab of an open roof.
 * faceted: the room has such a roof somewhere. */
static void put_cell(tn_ifc *ifc, uint32_t cell, bool faceted, tn_stepfile_list *solids)
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
        return;
    }
    if (open)
        slopes = tn_roof_slopes_of(ifc->house, cell);
    size_t count = tn_slopes_cut(&slopes, r, facets);
    for (size_t i = 0; i < count; i++)
        tn_stepfile_list_add(solids, put_facet(ifc, &slopes, &facets[i], (double)from, foot));
}

/* Is some cell of a room open to a roof? */
static bool is_faceted(const tn_ifc *ifc, uint32_t room)
{
    for (uint32_t i = room; i < ifc->house->cell_count; i++)
        if (ifc->rooms[i] == room && tn_cell_is_open_above(ifc->house, i))
            return true;
    return false;
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
    bool faceted = is_faceted(ifc, room);
    for (uint32_t i = room; i < house->cell_count; i++) {
        if (ifc->rooms[i] != room)
            continue;
        put_cell(ifc, i, faceted, &solids);
        gross += house->cells[i].open ? 0 : area_of(house->cells[i].at);
        net += house->cells[i].open ? 0 : area_of(tn_cell_clear(house, i));
    }
    const char *text = tn_stepfile_list_text(&solids);
    unsigned shape = faceted ? tn_stepfile_faceted(step, text) : tn_stepfile_shape(step, text);
    const char *function = tn_text(house->form->module, tn_form_rule(house->form, house->cells[room].function)->name);
    unsigned at = tn_stepfile_placement(step, ifc->placement, 0, 0, 0);
    unsigned space = tn_stepfile_add(step, "IFCSPACE('%s',$,'%s',$,$,#%u,#%u,$,.ELEMENT.,.%s.,$)",
                                     tn_stepfile_guid(step, "space", room).text, tn_stepfile_text(function).text, at,
                                     shape, tn_cell_is_outdoor(house, room) ? "EXTERNAL" : "INTERNAL");
    ifc->spaces[room] = space;
    ifc->failed |= solids.text.failed;
    tn_stepfile_list_clear(&solids);
    tn_stepfile_list_add(list, space);
    put_areas(ifc, space, room, gross, net);
}

static void put_spaces(tn_ifc *ifc, tn_stepfile_list *list)
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
                                ifc->walls[i], tn_face_is_outer(house, face) ? "EXTERNAL" : "INTERNAL");
        }
    }
}

/* The material at a place in `made`, or of a layer without one in the places behind those. */
static unsigned put_material(tn_ifc *ifc, uint32_t place)
{
    const tn_house_form *form = ifc->house->form;
    uint32_t record = place - TN_SOLID_COUNT, layer = record - form->record->material_count;
    const char *name =
        place < TN_SOLID_COUNT ? tn_solid_kind_text((tn_solid_kind)place)
        : record < form->record->material_count
            ? tn_text(form->module, form->module->MATERIAL_records[form->record->material_first + record].name)
            : tn_text(form->module, tn_form_layer(form, layer)->name);
    if (!ifc->materials[place])
        ifc->materials[place] = tn_stepfile_add(&ifc->step, "IFCMATERIAL('%s',$,$)", tn_stepfile_text(name).text);
    return ifc->materials[place];
}

static void associate(tn_ifc *ifc, tn_stepfile_list *parts, const char *kind, unsigned number, unsigned material)
{
    const char *list = tn_stepfile_list_text(parts);
    if (list)
        tn_stepfile_add(&ifc->step, "IFCRELASSOCIATESMATERIAL('%s',$,$,$,%s,#%u)",
                        tn_stepfile_guid(&ifc->step, kind, number).text, list, material);
    ifc->failed |= parts->text.failed;
}

static unsigned put_layer_set(tn_ifc *ifc, tn_layered of)
{
    const tn_house_form *form = ifc->house->form;
    tn_stepfile *step = &ifc->step;
    tn_stepfile_list layers = {0};
    for (uint32_t i = tn_form_layers(form, of); i < form->layers_end[of]; i++) {
        uint32_t part = tn_layer_part(form, i), material = tn_part_material(ifc->house, part);
        unsigned made = put_material(ifc, material == TN_NO_RECORD
                                              ? TN_SOLID_COUNT + form->record->material_count + part - TN_OF_COUNT
                                              : TN_SOLID_COUNT + material - form->record->material_first);
        tn_stepfile_list_add(&layers, tn_stepfile_add(step, "IFCMATERIALLAYER(#%u,%s,$,'%s',$,$,$)", made,
                                                      tn_stepfile_mm((double)tn_form_layer(form, i)->thick).text,
                                                      tn_stepfile_text(tn_form_part_text(form, part)).text));
    }
    const char *list = tn_stepfile_list_text(&layers);
    unsigned set = tn_stepfile_add(step, "IFCMATERIALLAYERSET(%s,'%s',$)", list ? list : "()", tn_names_LAYERED[of]);
    ifc->failed |= layers.text.failed;
    tn_stepfile_list_clear(&layers);
    return set;
}

/* Walls have their layers across, in the direction of their y axis or against it; decks from the top down. */
static void put_layers(tn_ifc *ifc, tn_layered of)
{
    int64_t thick = tn_layered_thick(ifc->house->form->record, of);
    unsigned set = 0;
    for (int lie = 0; lie < LIES; lie++) {
        if (ifc->layered[of][lie].count == 0)
            continue;
        unsigned material = set = set ? set : put_layer_set(ifc, of);
        if (lie != LIE_ANYHOW)
            material =
                tn_stepfile_add(&ifc->step, "IFCMATERIALLAYERSETUSAGE(#%u,.%s.,.%s.,%s,$)", set,
                                of == TN_LAYERED_DECK ? "AXIS3" : "AXIS2", lie == LIE_ALONG ? "POSITIVE" : "NEGATIVE",
                                tn_stepfile_mm(lie == LIE_ALONG ? 0 : (double)thick).text);
        associate(ifc, &ifc->layered[of][lie], "layers", (unsigned)of * LIES + (unsigned)lie, material);
    }
}

static void put_materials(tn_ifc *ifc)
{
    for (uint32_t i = 0; i < TN_SOLID_COUNT + ifc->house->form->record->material_count; i++)
        if (ifc->made[i].count > 0)
            associate(ifc, &ifc->made[i], "material", i, put_material(ifc, i));
    for (int of = 0; of < TN_LAYERED_COUNT; of++)
        put_layers(ifc, (tn_layered)of);
}

/* Are walls, doors and windows in outside faces? */
static void put_common(tn_ifc *ifc)
{
    static const char *const sets[] = {"Pset_WallCommon", "Pset_DoorCommon", "Pset_WindowCommon"};
    tn_stepfile *step = &ifc->step;
    for (unsigned i = 0; i < 2 * IFC_COMMON_COUNT; i++) {
        tn_stepfile_list *parts = &ifc->common[i / 2][i % 2];
        const char *list = tn_stepfile_list_text(parts);
        ifc->failed |= parts->text.failed;
        if (!list)
            continue;
        unsigned property =
            tn_stepfile_add(step, "IFCPROPERTYSINGLEVALUE('IsExternal',$,IFCBOOLEAN(.%s.),$)", i % 2 ? "T" : "F");
        unsigned set = tn_stepfile_add(step, "IFCPROPERTYSET('%s',$,'%s',$,(#%u))",
                                       tn_stepfile_guid(step, "properties", i).text, sets[i / 2], property);
        tn_stepfile_add(step, "IFCRELDEFINESBYPROPERTIES('%s',$,$,$,%s,#%u)",
                        tn_stepfile_guid(step, "properties of parts", i).text, list, set);
    }
}

/* ---- elements: walls with doors and windows, posts, decks, roofs, stairs, furniture */

/* The storey at hand is where a part stands: that of its face, its cell, or its own. */
static uint32_t storey_of(const tn_ifc *ifc, const tn_solid *s)
{
    uint32_t last = ifc->house->form->record->storey_count - 1;
    switch (s->kind) {
    case TN_SOLID_OUTSIDE:
    case TN_SOLID_PARTY:
    case TN_SOLID_PARTITION:
    case TN_SOLID_PANE:
    case TN_SOLID_LEAF:
    case TN_SOLID_FLIGHT:
        return ifc->house->faces[s->of].storey;
    case TN_SOLID_GUARD:
        return tn_guard_storey(ifc->house, s->of);
    case TN_SOLID_ITEM:
    case TN_SOLID_ROOFDECK:
        return ifc->house->cells[s->of].storey;
    default: /* a deck above the last storey belongs to that */
        return s->of > last ? last : s->of;
    }
}

/* Where a part stands: at the low corner of its box, above the floor of the storey at hand. */
static unsigned place(tn_ifc *ifc, const tn_box *b)
{
    double floor = (double)ifc->house->form->level[ifc->storey];
    return tn_stepfile_placement(&ifc->step, ifc->placement, (double)b->x0, (double)b->y0, (double)b->z0 - floor);
}

/* The same, turned by a right angle, so that the x axis goes to the front: at the corner that is low then. */
static unsigned place_turned(tn_ifc *ifc, const tn_box *b)
{
    double floor = (double)ifc->house->form->level[ifc->storey];
    return tn_stepfile_turned(&ifc->step, ifc->placement, (double)b->x1, (double)b->y0, (double)b->z0 - floor, 1);
}

/* The same, within the placement of a part whose box is `outer`, which is not turned. */
static unsigned place_within(tn_ifc *ifc, unsigned within, const tn_box *outer, const tn_box *b)
{
    return tn_stepfile_placement(&ifc->step, within, (double)(b->x0 - outer->x0), (double)(b->y0 - outer->y0),
                                 (double)(b->z0 - outer->z0));
}

static unsigned shape(tn_ifc *ifc, const tn_box *b)
{
    return tn_stepfile_box(&ifc->step, (double)(b->x1 - b->x0), (double)(b->y1 - b->y0), (double)(b->z1 - b->z0));
}

/* Cubic metres. */
static double volume_of(const tn_box *b)
{
    return (double)(b->x1 - b->x0) / 1e9 * ((double)(b->y1 - b->y0) / 1e9) * ((double)(b->z1 - b->z0) / 1e9);
}

static void put_volume(tn_ifc *ifc, unsigned part, const char *set, double volume)
{
    tn_stepfile *step = &ifc->step;
    unsigned quantity = tn_stepfile_add(step, "IFCQUANTITYVOLUME('NetVolume',$,$,%.9f,$)", volume);
    unsigned quantities = tn_stepfile_add(step, "IFCELEMENTQUANTITY('%s',$,'%s',$,$,(#%u))",
                                          tn_stepfile_guid(step, "volume", part).text, set, quantity);
    tn_stepfile_add(step, "IFCRELDEFINESBYPROPERTIES('%s',$,$,$,(#%u),#%u)",
                    tn_stepfile_guid(step, "volume of part", part).text, part, quantities);
}

/* Is a wall as IFC has it turned, so that its x axis is along it? Only one with layers has to be. */
static bool is_turned(const tn_layering *layers)
{
    return layers->count > 0 && layers->axis == 0;
}

static bool is_wall(tn_solid_kind kind)
{
    return kind == TN_SOLID_OUTSIDE || kind == TN_SOLID_PARTY || kind == TN_SOLID_PARTITION;
}

/* Keeps a part for what it is made of. */
static void keep_made(tn_ifc *ifc, const tn_solid *s, unsigned part)
{
    const tn_form_record *form = ifc->house->form->record;
    tn_layering layers = tn_solid_layering(ifc->house, s->kind, s->of, s->item);
    if (layers.count > 0) {
        bool placed = is_wall(s->kind) || s->kind == TN_SOLID_DECK || s->kind == TN_SOLID_ROOFDECK;
        tn_layers_lie lie = !placed                                  ? LIE_ANYHOW
                            : layers.from_high == is_turned(&layers) ? LIE_ALONG
                                                                     : LIE_AGAINST;
        tn_stepfile_list_add(&ifc->layered[tn_form_layer(ifc->house->form, layers.first)->of][lie], part);
        return;
    }
    uint32_t material = tn_part_material(ifc->house, tn_solid_made_part(ifc->house, s->kind, s->of, s->item));
    uint32_t place = material == TN_NO_RECORD ? s->kind : TN_SOLID_COUNT + material - form->material_first;
    tn_stepfile_list_add(&ifc->made[place], part);
}

/* The same, and for its storey. */
static void keep(tn_ifc *ifc, const tn_solid *s, unsigned part, tn_stepfile_list *list)
{
    keep_made(ifc, s, part);
    tn_stepfile_list_add(list, part);
}

/* Keeps a part for the common properties of its kind. */
static void keep_common(tn_ifc *ifc, tn_ifc_common of, uint32_t face, unsigned part)
{
    tn_stepfile_list_add(&ifc->common[of][tn_face_is_outer(ifc->house, &ifc->house->faces[face])], part);
}

/* ---- walls */

static void cover(tn_box *all, const tn_box *b)
{
    all->x0 = b->x0 < all->x0 ? b->x0 : all->x0;
    all->x1 = b->x1 > all->x1 ? b->x1 : all->x1;
    all->y0 = b->y0 < all->y0 ? b->y0 : all->y0;
    all->y1 = b->y1 > all->y1 ? b->y1 : all->y1;
    all->z0 = b->z0 < all->z0 ? b->z0 : all->z0;
    all->z1 = b->z1 > all->z1 ? b->z1 : all->z1;
}

static const tn_swing *swing_of(const tn_ifc *ifc, uint32_t face)
{
    for (size_t i = 0; i < ifc->doors.count; i++)
        if (ifc->doors.items[i].of == face)
            return &ifc->doors.items[i];
    return NULL;
}

/* How often what fills an opening is turned by a right angle, counter-clockwise, so that its x axis is along the wall
 * and it opens in the direction of its y axis: a door as it swings, a window into the first room of its face. */
static int turns_of(const tn_house *house, const tn_face *face, const tn_swing *door)
{
    const tn_rectangle *room = &house->cells[face->first].at;
    bool in_y = face->at.x0 == face->at.x1, up = door   ? door->leaves[0].side > 0
                                                 : in_y ? room->x0 >= face->at.x0
                                                        : room->y0 >= face->at.y0;
    if (in_y)
        return up ? 3 : 1;
    return up ? 0 : 2;
}

/* IfcDoorTypeOperationEnum: the hinges, or where a leaf slides to, are at the left or right for who looks in the
 * direction of the y axis. */
static const char *operation(const tn_swing *door, int turns)
{
    bool low = door->leaves[0].hinge < door->leaves[0].shut, left = low == (turns < 2);
    if (door->sliding)
        return door->count == 2 ? "DOUBLE_DOOR_SLIDING" : left ? "SLIDING_TO_LEFT" : "SLIDING_TO_RIGHT";
    return door->count == 2 ? "DOUBLE_DOOR_SINGLE_SWING" : left ? "SINGLE_SWING_LEFT" : "SINGLE_SWING_RIGHT";
}

/* In the middle of its opening, as thick as `thick` or as the wall. */
static tn_box leaf_of(const tn_box *hole, bool in_y, int64_t thick)
{
    tn_box at = *hole;
    int64_t *low = in_y ? &at.x0 : &at.y0, *high = in_y ? &at.x1 : &at.y1, over = (*high - *low - thick) / 2;
    *low += over > 0 ? over : 0;
    *high -= over > 0 ? over : 0;
    return at;
}

/* The leaf or pane of an opening, which it fills. where: the placement of the opening. */
static void fill(tn_ifc *ifc, uint32_t number, unsigned opening, unsigned where, const tn_box *hole,
                 tn_stepfile_list *list)
{
    tn_stepfile *step = &ifc->step;
    const tn_face *face = &ifc->house->faces[number];
    const tn_opening_record *o = tn_form_opening(ifc->house->form, face->kind);
    const tn_swing *door = swing_of(ifc, number);
    bool in_y = face->at.x0 == face->at.x1;
    int turns = turns_of(ifc->house, face, door);
    tn_box at = leaf_of(hole, in_y, door ? TN_LEAF_NM : TN_PANE_NM);
    double x = (double)(turns == 1 || turns == 2 ? at.x1 : at.x0), y = (double)(turns > 1 ? at.y1 : at.y0),
           along = (double)(in_y ? at.y1 - at.y0 : at.x1 - at.x0),
           across = (double)(in_y ? at.x1 - at.x0 : at.y1 - at.y0);
    unsigned place = tn_stepfile_turned(step, where, x - (double)hole->x0, y - (double)hole->y0, 0, turns),
             body = tn_stepfile_box(step, along, across, (double)(at.z1 - at.z0));
    unsigned part = tn_stepfile_add(step, "%s('%s',$,'%s',$,$,#%u,#%u,$,%s,%s,.%s.,.%s.,$)",
                                    door ? "IFCDOOR" : "IFCWINDOW", tn_stepfile_guid(step, "filling", number).text,
                                    tn_stepfile_text(tn_text(ifc->house->form->module, o->name)).text, place, body,
                                    tn_stepfile_mm((double)o->high).text, tn_stepfile_mm((double)o->wide).text,
                                    door ? "DOOR" : "WINDOW", door ? operation(door, turns) : "SINGLE_PANEL");
    tn_stepfile_add(step, "IFCRELFILLSELEMENT('%s',$,$,$,#%u,#%u)", tn_stepfile_guid(step, "fills", number).text,
                    opening, part);
    keep(ifc, &(tn_solid){.kind = door ? TN_SOLID_LEAF : TN_SOLID_PANE, .of = number}, part, list);
    keep_common(ifc, door ? IFC_DOORS : IFC_WINDOWS, number, part);
}

/* What beams take of a wall's box is cut out of it: of the end of a partition that meets them. */
static void put_pockets(tn_ifc *ifc, uint32_t face, unsigned wall, unsigned within, const tn_box *all, bool turned)
{
    tn_stepfile *step = &ifc->step;
    for (size_t i = 0; i < ifc->solids->box_count; i++) {
        const tn_solid *s = &ifc->solids->boxes[i];
        tn_rectangle at = tn_rectangles_common(&(tn_rectangle){all->x0, all->x1, all->y0, all->y1},
                                               &(tn_rectangle){s->at.x0, s->at.x1, s->at.y0, s->at.y1});
        tn_box pocket = {at.x0, at.x1, at.y0, at.y1, s->at.z0, all->z1};
        if (s->kind != TN_SOLID_BEAM || at.x0 >= at.x1 || at.y0 >= at.y1 || pocket.z0 >= pocket.z1 ||
            s->at.z1 <= all->z0)
            continue;
        unsigned number = face * (unsigned)ifc->solids->box_count + (unsigned)i,
                 where = turned ? tn_stepfile_turned(step, within, (double)(pocket.y0 - all->y0),
                                                     (double)(all->x1 - pocket.x0), (double)(pocket.z0 - all->z0), 3)
                                : place_within(ifc, within, all, &pocket);
        unsigned opening = tn_stepfile_add(step, "IFCOPENINGELEMENT('%s',$,$,$,$,#%u,#%u,$,.RECESS.)",
                                           tn_stepfile_guid(step, "pocket", number).text, where, shape(ifc, &pocket));
        tn_stepfile_add(step, "IFCRELVOIDSELEMENT('%s',$,$,$,#%u,#%u)",
                        tn_stepfile_guid(step, "pocket of wall", number).text, wall, opening);
    }
}

/* The wall of a face as one box, and the opening that is cut out of it. `first` is the first of its boxes. */
static void put_wall(tn_ifc *ifc, size_t first, tn_stepfile_list *list)
{
    const tn_solid *s = &ifc->solids->boxes[first];
    tn_stepfile *step = &ifc->step;
    tn_box all = s->at, hole;
    double volume = 0;
    for (size_t i = first; i < ifc->solids->box_count; i++) {
        const tn_solid *other = &ifc->solids->boxes[i];
        if (!is_wall(other->kind) || other->of != s->of)
            continue;
        cover(&all, &other->at);
        volume += volume_of(&other->at);
    }
    bool open = tn_house_hole(ifc->house, &ifc->house->faces[s->of], &hole);
    if (open)
        cover(&all, &hole);
    tn_layering layers = tn_solid_layering(ifc->house, s->kind, s->of, s->item);
    bool turned = is_turned(&layers);
    unsigned where = turned ? place_turned(ifc, &all) : place(ifc, &all),
             body = turned ? tn_stepfile_box(step, (double)(all.y1 - all.y0), (double)(all.x1 - all.x0),
                                             (double)(all.z1 - all.z0))
                           : shape(ifc, &all);
    unsigned wall = tn_stepfile_add(step, "IFCWALL('%s',$,'%s',$,$,#%u,#%u,$,.%s.)",
                                    tn_stepfile_guid(step, "wall", s->of).text, tn_solid_kind_text(s->kind), where,
                                    body, s->kind == TN_SOLID_PARTITION ? "PARTITIONING" : "SOLIDWALL");
    ifc->walls[s->of] = wall;
    keep(ifc, s, wall, list);
    keep_common(ifc, IFC_WALLS, s->of, wall);
    put_volume(ifc, wall, "Qto_WallBaseQuantities", volume);
    put_pockets(ifc, s->of, wall, where, &all, turned);
    if (!open)
        return;
    unsigned at = turned ? tn_stepfile_turned(step, where, (double)(hole.y0 - all.y0), (double)(all.x1 - hole.x0),
                                              (double)(hole.z0 - all.z0), 3)
                         : place_within(ifc, where, &all, &hole),
             cut = shape(ifc, &hole);
    unsigned opening = tn_stepfile_add(step, "IFCOPENINGELEMENT('%s',$,$,$,$,#%u,#%u,$,.OPENING.)",
                                       tn_stepfile_guid(step, "opening", s->of).text, at, cut);
    tn_stepfile_add(step, "IFCRELVOIDSELEMENT('%s',$,$,$,#%u,#%u)", tn_stepfile_guid(step, "voids", s->of).text, wall,
                    opening);
    if (tn_house_is_filled(ifc->house, &ifc->house->faces[s->of]))
        fill(ifc, s->of, opening, at, &hole, list);
}

/* ---- other boxes */

static void put_guard(tn_ifc *ifc, const tn_solid *s, unsigned number, tn_stepfile_list *list)
{
    tn_stepfile *step = &ifc->step;
    unsigned where = place(ifc, &s->at), body = shape(ifc, &s->at);
    unsigned guard = tn_stepfile_add(step, "IFCRAILING('%s',$,'%s',$,$,#%u,#%u,$,.GUARDRAIL.)",
                                     tn_stepfile_guid(step, "guard", number).text, tn_solid_kind_text(s->kind), where,
                                     body);
    keep(ifc, s, guard, list);
}

static void put_box(tn_ifc *ifc, const tn_solid *s, unsigned number, tn_stepfile_list *list)
{
    tn_stepfile *step = &ifc->step;
    const tn_module *module = ifc->house->form->module;
    unsigned where = place(ifc, &s->at), body = shape(ifc, &s->at);
    bool item = s->kind == TN_SOLID_ITEM, post = s->kind == TN_SOLID_POST, beam = s->kind == TN_SOLID_BEAM;
    const char *name = item   ? tn_text(module, module->TILE_BOX_records[s->item].name)
                       : beam ? tn_text(module, tn_form_beam(ifc->house->form, s->item)->name)
                              : tn_solid_kind_text(s->kind);
    const char *type = item                           ? "NOTDEFINED"
                       : post                         ? "COLUMN"
                       : beam                         ? "BEAM"
                       : s->kind == TN_SOLID_ROOFDECK ? "ROOF"
                       : s->of == 0                   ? "BASESLAB"
                                                      : "FLOOR";
    unsigned part =
        tn_stepfile_add(step, "%s('%s',$,'%s',$,$,#%u,#%u,$,.%s.)",
                        item   ? "IFCFURNITURE"
                        : post ? "IFCCOLUMN"
                        : beam ? "IFCBEAM"
                               : "IFCSLAB",
                        tn_stepfile_guid(step, "box", number).text, tn_stepfile_text(name).text, where, body, type);
    if (!item)
        put_volume(ifc, part,
                   post   ? "Qto_ColumnBaseQuantities"
                   : beam ? "Qto_BeamBaseQuantities"
                          : "Qto_SlabBaseQuantities",
                   volume_of(&s->at));
    keep(ifc, s, part, list);
}

/* ---- roofs and stairs */

/* Cubic metres. */
static double prism_volume(const tn_prism_corner *c, size_t count)
{
    double six = 0;
    for (size_t i = 1; i + 1 < count; i++) {
        const tn_prism_corner *at[3] = {&c[0], &c[i], &c[i + 1]};
        double x[3], y[3], high = 0;
        for (int k = 0; k < 3; k++) {
            x[k] = tn_fraction_value(at[k]->x) / 1e9;
            y[k] = tn_fraction_value(at[k]->y) / 1e9;
            high += (tn_fraction_value(at[k]->high) - tn_fraction_value(at[k]->low)) / 1e9;
        }
        six += ((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])) * high;
    }
    return six / 6;
}

static unsigned put_prism(tn_ifc *ifc, const tn_prism *prism)
{
    const tn_prism_corner *c = ifc->solids->corners + prism->corner_first;
    double floor = (double)ifc->house->form->level[ifc->storey];
    tn_block_corner corners[TN_FACET_CORNERS];
    for (size_t i = 0; i < prism->corner_count; i++)
        corners[i] =
            (tn_block_corner){tn_fraction_value(c[i].x), tn_fraction_value(c[i].y),
                              tn_fraction_value(c[i].low) - floor, tn_fraction_value(c[i].high) - floor};
    return tn_stepfile_prism(&ifc->step, corners, prism->corner_count);
}

/* Does a prism belong to the same part: a slab is all that lies in one plane of a cell's roof, a wall what stands below
 * it, and is cut into layers as the wall of one face? */
static bool is_part(const tn_prism *prism, const tn_prism *of)
{
    return prism->kind == of->kind && prism->of == of->of &&
           (of->kind == TN_SOLID_GABLE ? prism->item == of->item : prism->plane == of->plane);
}

/* The part that begins with a prism; 0: it begins with one before. */
static unsigned put_prisms(tn_ifc *ifc, size_t number)
{
    tn_stepfile *step = &ifc->step;
    const tn_solids *solids = ifc->solids;
    const tn_prism *first = &solids->prisms[number];
    tn_stepfile_list pieces = {0};
    double volume = 0;
    for (size_t i = 0; i < number; i++)
        if (is_part(&solids->prisms[i], first))
            return 0;
    for (size_t i = number; i < solids->prism_count; i++) {
        const tn_prism *prism = &solids->prisms[i];
        if (!is_part(prism, first))
            continue;
        tn_stepfile_list_add(&pieces, put_prism(ifc, prism));
        volume += prism_volume(solids->corners + prism->corner_first, prism->corner_count);
    }
    bool roof = first->kind == TN_SOLID_ROOF;
    unsigned body = tn_stepfile_faceted(step, tn_stepfile_list_text(&pieces)),
             where = tn_stepfile_placement(step, ifc->placement, 0, 0, 0);
    unsigned part =
        tn_stepfile_add(step, "%s('%s',$,'%s',$,$,#%u,#%u,$,.%s.)", roof ? "IFCSLAB" : "IFCWALL",
                        tn_stepfile_guid(step, tn_solid_kind_text(first->kind), (unsigned)number).text,
                        tn_solid_kind_text(first->kind), where, body, roof ? "ROOF" : "SOLIDWALL");
    put_volume(ifc, part, roof ? "Qto_SlabBaseQuantities" : "Qto_WallBaseQuantities", volume);
    keep_made(ifc, &(tn_solid){.kind = first->kind, .of = first->of, .item = first->item}, part);
    ifc->failed |= pieces.text.failed;
    tn_stepfile_list_clear(&pieces);
    return part;
}

/* IfcRoofTypeEnum. */
static const char *roof_type(const tn_shape_record *shape)
{
    switch (shape ? (tn_roof_kind)shape->roof : TN_ROOF_FLAT) {
    case TN_ROOF_SHED_BACK:
    case TN_ROOF_SHED_FRONT:
        return "SHED_ROOF";
    case TN_ROOF_GABLE:
        return "GABLE_ROOF";
    case TN_ROOF_VAULT:
        return "BARREL_ROOF";
    case TN_ROOF_HIP:
        return "HIP_ROOF";
    case TN_ROOF_CROSS_GABLE:
        return "NOTDEFINED";
    default:
        return "FLAT_ROOF";
    }
}

/* The roof of a zone above the storey at hand, which is made of slabs; and the walls below these. */
static void put_roof(tn_ifc *ifc, uint32_t zone, tn_stepfile_list *list)
{
    tn_stepfile *step = &ifc->step;
    tn_stepfile_list slabs = {0};
    for (size_t i = 0; i < ifc->solids->prism_count; i++) {
        const tn_prism *prism = &ifc->solids->prisms[i];
        if (prism->kind == TN_SOLID_FLIGHT)
            continue;
        const tn_cell *cell = &ifc->house->cells[prism->of];
        unsigned part = cell->storey == ifc->storey && cell->zone == zone ? put_prisms(ifc, i) : 0;
        if (part)
            tn_stepfile_list_add(prism->kind == TN_SOLID_ROOF ? &slabs : list, part);
    }
    unsigned number = zone * TN_STOREYS_MAX + ifc->storey;
    const char *parts = tn_stepfile_list_text(&slabs);
    if (parts) {
        unsigned roof =
            tn_stepfile_add(step, "IFCROOF('%s',$,'roof',$,$,#%u,$,$,.%s.)", tn_stepfile_guid(step, "roofs", number).text,
                            tn_stepfile_placement(step, ifc->placement, 0, 0, 0),
                            roof_type(tn_house_shape(ifc->house, zone, TN_CHOICE_ROOF)));
        tn_stepfile_add(step, "IFCRELAGGREGATES('%s',$,$,$,#%u,%s)",
                        tn_stepfile_guid(step, "slabs of roof", number).text, roof, parts);
        tn_stepfile_list_add(list, roof);
    }
    ifc->failed |= slabs.text.failed;
    tn_stepfile_list_clear(&slabs);
}

/* The steps of a flight of which some are wedges, as solids of faces; none: it has no wedges. */
static void put_winding(tn_ifc *ifc, uint32_t face, tn_stepfile_list *steps)
{
    const tn_solids *solids = ifc->solids;
    const tn_rectangle *from = &ifc->house->faces[face].at;
    double x0 = (double)from->x0, y0 = (double)from->y0, floor = (double)ifc->house->form->level[ifc->storey];
    for (size_t i = 0; i < solids->prism_count; i++) {
        const tn_prism *prism = &solids->prisms[i];
        tn_block_corner corners[TN_FACET_CORNERS];
        if (prism->kind != TN_SOLID_FLIGHT || prism->of != face)
            continue;
        for (size_t k = 0; k < prism->corner_count; k++) {
            const tn_prism_corner *c = &solids->corners[prism->corner_first + k];
            corners[k] = (tn_block_corner){tn_fraction_value(c->x) - x0, tn_fraction_value(c->y) - y0,
                                           tn_fraction_value(c->low) - floor, tn_fraction_value(c->high) - floor};
        }
        tn_stepfile_list_add(steps, tn_stepfile_prism(&ifc->step, corners, prism->corner_count));
    }
    for (size_t i = 0; steps->count > 0 && i < solids->box_count; i++) {
        const tn_solid *s = &solids->boxes[i];
        if (s->kind != TN_SOLID_FLIGHT || s->of != face)
            continue;
        double low = (double)s->at.z0 - floor, high = (double)s->at.z1 - floor, x[2], y[2];
        for (int k = 0; k < 2; k++) {
            x[k] = (double)(k ? s->at.x1 : s->at.x0) - x0;
            y[k] = (double)(k ? s->at.y1 : s->at.y0) - y0;
        }
        const tn_block_corner corners[4] = {
            {x[0], y[0], low, high}, {x[1], y[0], low, high}, {x[1], y[1], low, high}, {x[0], y[1], low, high}};
        tn_stepfile_list_add(steps, tn_stepfile_prism(&ifc->step, corners, 4));
    }
}

/* The steps and landings of a flight, as one shape; 0 where a stair has none. */
static unsigned put_steps(tn_ifc *ifc, uint32_t face)
{
    tn_stepfile *step = &ifc->step;
    tn_stepfile_list steps = {0};
    const tn_rectangle *from = &ifc->house->faces[face].at;
    double floor = (double)ifc->house->form->level[ifc->storey];
    put_winding(ifc, face, &steps);
    const char *winding = tn_stepfile_list_text(&steps);
    if (winding) {
        unsigned shape = tn_stepfile_faceted(step, winding);
        ifc->failed |= steps.text.failed;
        tn_stepfile_list_clear(&steps);
        return shape;
    }
    for (size_t i = 0; i < ifc->solids->box_count; i++) {
        const tn_solid *s = &ifc->solids->boxes[i];
        if (s->kind != TN_SOLID_FLIGHT || s->of != face)
            continue;
        double low[3] = {(double)(s->at.x0 - from->x0), (double)(s->at.y0 - from->y0), (double)s->at.z0 - floor},
               high[3] = {(double)(s->at.x1 - from->x0), (double)(s->at.y1 - from->y0), (double)s->at.z1 - floor};
        tn_stepfile_list_add(&steps, tn_stepfile_solid(step, low, high));
    }
    const char *list = tn_stepfile_list_text(&steps);
    unsigned body = list ? tn_stepfile_shape(step, list) : 0;
    ifc->failed |= steps.text.failed;
    tn_stepfile_list_clear(&steps);
    return body;
}

static const char *stair_type(const tn_opening_record *flight)
{
    switch (flight ? (tn_turn)flight->turn : TN_TURN_NONE) {
    case TN_TURN_STRAIGHT:
        return "STRAIGHT_RUN_STAIR";
    case TN_TURN_QUARTER:
        return flight->winders ? "QUARTER_WINDING_STAIR" : "QUARTER_TURN_STAIR";
    case TN_TURN_HALF:
        return flight->winders ? "HALF_WINDING_STAIR" : "HALF_TURN_STAIR";
    case TN_TURN_SPIRAL:
        return "SPIRAL_STAIR";
    default:
        return "NOTDEFINED";
    }
}

static void put_stairs(tn_ifc *ifc, tn_stepfile_list *list)
{
    const tn_house_form *form = ifc->house->form;
    for (uint32_t i = 0; i < ifc->house->face_count; i++) {
        const tn_face *face = &ifc->house->faces[i];
        const tn_opening_record *flight = tn_form_flight(form, face->kind);
        if (face->relation != TN_FACE_UNDER || (face->kind != TN_FACE_STAIR && !flight) ||
            ifc->house->cells[face->first].storey != ifc->storey)
            continue;
        char body[16] = "$";
        unsigned steps = put_steps(ifc, i);
        if (steps)
            snprintf(body, sizeof body, "#%u", steps);
        unsigned where = tn_stepfile_placement(&ifc->step, ifc->placement, (double)face->at.x0, (double)face->at.y0, 0);
        unsigned stair = tn_stepfile_add(&ifc->step, "IFCSTAIR('%s',$,'%s',$,$,#%u,%s,$,.%s.)",
                                         tn_stepfile_guid(&ifc->step, "stair", i).text,
                                         tn_stepfile_text(flight ? tn_text(form->module, flight->name) : "stair").text,
                                         where, body, stair_type(flight));
        if (steps)
            keep(ifc, &(tn_solid){.kind = TN_SOLID_FLIGHT, .of = i}, stair, list);
        else
            tn_stepfile_list_add(list, stair);
    }
}

static void put_elements(tn_ifc *ifc, tn_stepfile_list *list)
{
    for (size_t i = 0; i < ifc->solids->box_count; i++) {
        const tn_solid *s = &ifc->solids->boxes[i];
        if (storey_of(ifc, s) != ifc->storey || s->kind == TN_SOLID_FLIGHT)
            continue;
        if (s->kind == TN_SOLID_GUARD)
            put_guard(ifc, s, (unsigned)i, list);
        else if (!is_wall(s->kind))
            put_box(ifc, s, (unsigned)i, list);
        else if (!ifc->walls[s->of])
            put_wall(ifc, i, list);
    }
    for (uint32_t z = 0; z < ifc->house->form->zone_count; z++)
        put_roof(ifc, ifc->house->form->zones[z], list);
    put_stairs(ifc, list);
}

/* ---- the project, its building and storeys */

static const char *storey_name(const tn_house *house, uint32_t storey)
{
    const tn_house_form *form = house->form;
    return tn_text(form->module, form->module->STOREY_records[form->record->storey_first + storey].name);
}

/* What all instances refer to: axes, units and the context of shapes. Returns the assignment of units. */
static unsigned put_basis(tn_stepfile *step)
{
    step->origin = tn_stepfile_add(step, "IFCCARTESIANPOINT((0.,0.,0.))");
    step->z = tn_stepfile_add(step, "IFCDIRECTION((0.,0.,1.))");
    step->x = tn_stepfile_add(step, "IFCDIRECTION((1.,0.,0.))");
    step->axes = tn_stepfile_add(step, "IFCAXIS2PLACEMENT3D(#%u,#%u,#%u)", step->origin, step->z, step->x);
    unsigned whole = tn_stepfile_add(step, "IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-6,#%u,$)", step->axes);
    step->context = tn_stepfile_add(
        step, "IFCGEOMETRICREPRESENTATIONSUBCONTEXT('Body','Model',*,*,*,*,#%u,$,.MODEL_VIEW.,$)", whole);
    unsigned length = tn_stepfile_add(step, "IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)");
    unsigned area = tn_stepfile_add(step, "IFCSIUNIT(*,.AREAUNIT.,$,.SQUARE_METRE.)");
    unsigned volume = tn_stepfile_add(step, "IFCSIUNIT(*,.VOLUMEUNIT.,$,.CUBIC_METRE.)");
    unsigned angle = tn_stepfile_add(step, "IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.)");
    return tn_stepfile_add(step, "IFCUNITASSIGNMENT((#%u,#%u,#%u,#%u))", length, area, volume, angle);
}

static void aggregate(tn_stepfile *step, unsigned whole, const char *parts, const char *kind, unsigned number)
{
    tn_stepfile_add(step, "IFCRELAGGREGATES('%s',$,$,$,#%u,%s)", tn_stepfile_guid(step, kind, number).text, whole,
                    parts);
}

static void aggregate_one(tn_stepfile *step, unsigned whole, unsigned part, const char *kind)
{
    char list[16];
    snprintf(list, sizeof list, "(#%u)", part);
    aggregate(step, whole, list, kind, 0);
}

/* How the doors of the storey at hand hang. */
static tn_status hang_doors(tn_ifc *ifc, tn_error *error)
{
    tn_taken taken = {0};
    tn_status status = tn_taken_find(ifc->house, ifc->storey, &taken, error);
    tn_swings_clear(&ifc->doors);
    if (status == TN_OK)
        status = tn_swings_find(ifc->house, ifc->storey, &taken, &ifc->doors, error);
    tn_taken_clear(&taken);
    return status;
}

/* A storey with its rooms and parts; *made: itself. */
static tn_status put_storey(tn_ifc *ifc, uint32_t storey, unsigned building, unsigned *made, tn_error *error)
{
    tn_stepfile *step = &ifc->step;
    double level = (double)ifc->house->form->level[storey];
    ifc->placement = tn_stepfile_placement(step, building, 0, 0, level);
    ifc->storey = storey;
    tn_status status = hang_doors(ifc, error);
    if (status != TN_OK)
        return status;
    unsigned self = tn_stepfile_add(
        step, "IFCBUILDINGSTOREY('%s',$,'%s',$,$,#%u,$,$,.ELEMENT.,%s)", tn_stepfile_guid(step, "storey", storey).text,
        tn_stepfile_text(storey_name(ifc->house, storey)).text, ifc->placement, tn_stepfile_mm(level).text);
    tn_stepfile_list spaces = {0}, parts = {0};
    put_spaces(ifc, &spaces);
    put_elements(ifc, &parts);
    const char *list = tn_stepfile_list_text(&spaces);
    if (list)
        aggregate(step, self, list, "rooms", storey);
    list = tn_stepfile_list_text(&parts);
    if (list)
        tn_stepfile_add(step, "IFCRELCONTAINEDINSPATIALSTRUCTURE('%s',$,$,$,%s,#%u)",
                        tn_stepfile_guid(step, "parts", storey).text, list, self);
    ifc->failed |= spaces.text.failed || parts.text.failed;
    tn_stepfile_list_clear(&spaces);
    tn_stepfile_list_clear(&parts);
    *made = self;
    return TN_OK;
}

static tn_status put_storeys(tn_ifc *ifc, unsigned building, unsigned place, tn_error *error)
{
    tn_stepfile_list storeys = {0};
    tn_status status = TN_OK;
    for (uint32_t k = 0; status == TN_OK && k < ifc->house->form->record->storey_count; k++) {
        unsigned storey = 0;
        if (!tn_house_has_storey(ifc->house, k))
            continue;
        status = put_storey(ifc, k, place, &storey, error);
        tn_stepfile_list_add(&storeys, storey);
    }
    const char *list = tn_stepfile_list_text(&storeys);
    if (list)
        aggregate(&ifc->step, building, list, "storeys of building", 0);
    ifc->failed |= storeys.text.failed;
    tn_stepfile_list_clear(&storeys);
    return status;
}

static tn_status put_project(tn_ifc *ifc, const char *name, const char *line, tn_error *error)
{
    tn_stepfile *step = &ifc->step;
    unsigned units = put_basis(step);
    tn_stepfile_name title = tn_stepfile_text(name);
    tn_buffer said = {0};
    ifc->failed |= !tn_stepfile_put_text(&said, line);
    unsigned context = step->context - 1;
    unsigned project =
        tn_stepfile_add(step, "IFCPROJECT('%s',$,'%s','%s',$,$,$,(#%u),#%u)", tn_stepfile_guid(step, "project", 0).text,
                        title.text, said.data ? said.data : "", context, units);
    free(said.data);
    unsigned ground = tn_stepfile_placement(step, 0, 0, 0, 0);
    unsigned site = tn_stepfile_add(step, "IFCSITE('%s',$,'site',$,$,#%u,$,$,.ELEMENT.,$,$,$,$,$)",
                                    tn_stepfile_guid(step, "site", 0).text, ground);
    unsigned place = tn_stepfile_placement(step, ground, 0, 0, 0);
    unsigned building = tn_stepfile_add(step, "IFCBUILDING('%s',$,'%s',$,$,#%u,$,$,.ELEMENT.,$,$,$)",
                                        tn_stepfile_guid(step, "building", 0).text, title.text, place);
    aggregate_one(step, project, site, "site of project");
    aggregate_one(step, site, building, "building of site");
    tn_status status = put_storeys(ifc, building, place, error);
    if (status == TN_OK) {
        put_materials(ifc);
        put_common(ifc);
        put_boundaries(ifc);
    }
    return status == TN_OK && (ifc->failed || step->text.failed) ? tn_fail_memory(error) : status;
}

/* view: how much of IFC the file has; the usage of layers is not in the smaller of the two. */
static void write_file(const tn_stepfile *step, const char *name, const char *view, FILE *out)
{
    fprintf(out,
            "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('ViewDefinition [%s]'),'2;1');\n"
            "FILE_NAME('%s','1970-01-01T00:00:00',(''),(''),'tartan','tartan','');\nFILE_SCHEMA(('IFC4'));\nENDSEC;\n"
            "DATA;\n",
            view, tn_stepfile_text(name).text);
    fwrite(step->text.data, 1, step->text.size, out);
    fputs("ENDSEC;\nEND-ISO-10303-21;\n", out);
}

tn_status tn_house_write_ifc(const tn_house *house, const tn_solids *solids, const char *name, FILE *out,
                             tn_error *error)
{
    tn_ifc ifc = {.house = house, .solids = solids};
    tn_buffer line = {0};
    tn_status status = tn_house_rooms(house, &ifc.rooms, error);
    ifc.walls = calloc(house->face_count + 1, sizeof *ifc.walls);
    ifc.spaces = calloc(house->cell_count + 1, sizeof *ifc.spaces);
    size_t materials = (size_t)TN_SOLID_COUNT + house->form->record->material_count;
    ifc.made = calloc(materials, sizeof *ifc.made);
    ifc.materials = calloc(materials + house->form->record->layer_count, sizeof *ifc.materials);
    if (status == TN_OK && (!ifc.walls || !ifc.spaces || !ifc.made || !ifc.materials))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_house_write(house, &line, error);
    if (status == TN_OK) {
        XXH128_hash_t hash = XXH3_128bits(line.data, line.size);
        snprintf(ifc.step.seed, sizeof ifc.step.seed, "%016" PRIx64 "%016" PRIx64, (uint64_t)hash.high64,
                 (uint64_t)hash.low64);
        status = put_project(&ifc, name, line.data, error);
    }
    if (status == TN_OK)
        write_file(&ifc.step, name, house->form->record->layer_count ? "DesignTransferView_V1.0" : "ReferenceView_V1.2",
                   out);
    ifc_clear(&ifc);
    free(line.data);
    return status;
}
