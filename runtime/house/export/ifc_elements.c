/* Adds the parts of a house to its building model: walls with what fills their openings, posts, decks, roofs, stairs
 * and furniture. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/house/export/ifc_parts.h"
#include "runtime/house/schedule/cost.h"

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

/* Keeps a part for its storey, and for what it is made of. */
static void keep(tn_ifc *ifc, const tn_solid *s, unsigned part, tn_stepfile_list *list)
{
    uint32_t material = tn_part_material(ifc->house, tn_solid_made_part(ifc->house, s->kind, s->of, s->item));
    tn_stepfile_list_add(list, part);
    tn_stepfile_list_add(
        &ifc->made[material == TN_NO_RECORD ? s->kind
                                            : TN_SOLID_COUNT + material - ifc->house->form->record->material_first],
        part);
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

static bool is_wall(tn_solid_kind kind)
{
    return kind == TN_SOLID_OUTSIDE || kind == TN_SOLID_PARTY || kind == TN_SOLID_PARTITION;
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

/* IfcDoorTypeOperationEnum: the hinges, or where a leaf slides to, are at the left or right for who looks in the direction
 * of the y axis. */
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
    unsigned place = tn_stepfile_turned(step, where, x - (double)hole->x0, y - (double)hole->y0, turns),
             body = tn_stepfile_box(step, along, across, (double)(at.z1 - at.z0));
    unsigned part = tn_stepfile_add(step, "%s('%s',$,'%s',$,$,#%u,#%u,$,%s,%s,.%s.,.%s.,$)",
                                    door ? "IFCDOOR" : "IFCWINDOW", tn_stepfile_guid(step, "filling", number).text,
                                    tn_stepfile_text(tn_text(ifc->house->form->module, o->name)).text, place, body,
                                    tn_stepfile_mm((double)o->high).text, tn_stepfile_mm((double)o->wide).text,
                                    door ? "DOOR" : "WINDOW", door ? operation(door, turns) : "SINGLE_PANEL");
    tn_stepfile_add(step, "IFCRELFILLSELEMENT('%s',$,$,$,#%u,#%u)", tn_stepfile_guid(step, "fills", number).text,
                    opening, part);
    keep(ifc, &(tn_solid){.kind = door ? TN_SOLID_LEAF : TN_SOLID_PANE, .of = number}, part, list);
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
    unsigned where = place(ifc, &all), body = shape(ifc, &all);
    unsigned wall = tn_stepfile_add(step, "IFCWALL('%s',$,'%s',$,$,#%u,#%u,$,.%s.)",
                                    tn_stepfile_guid(step, "wall", s->of).text, tn_solid_kind_text(s->kind), where,
                                    body, s->kind == TN_SOLID_PARTITION ? "PARTITIONING" : "SOLIDWALL");
    ifc->walls[s->of] = wall;
    keep(ifc, s, wall, list);
    put_volume(ifc, wall, "Qto_WallBaseQuantities", volume);
    if (!open)
        return;
    unsigned at = place_within(ifc, where, &all, &hole), cut = shape(ifc, &hole);
    unsigned opening = tn_stepfile_add(step, "IFCOPENINGELEMENT('%s',$,$,$,$,#%u,#%u,$,.OPENING.)",
                                       tn_stepfile_guid(step, "opening", s->of).text, at, cut);
    tn_stepfile_add(step, "IFCRELVOIDSELEMENT('%s',$,$,$,#%u,#%u)", tn_stepfile_guid(step, "voids", s->of).text, wall,
                    opening);
    if (tn_house_is_filled(ifc->house, &ifc->house->faces[s->of]))
        fill(ifc, s->of, opening, at, &hole, list);
}

/* ---- other boxes */

static void put_box(tn_ifc *ifc, const tn_solid *s, unsigned number, tn_stepfile_list *list)
{
    tn_stepfile *step = &ifc->step;
    const tn_module *module = ifc->house->form->module;
    unsigned where = place(ifc, &s->at), body = shape(ifc, &s->at);
    bool item = s->kind == TN_SOLID_ITEM, post = s->kind == TN_SOLID_POST;
    const char *name = item ? tn_text(module, module->TILE_BOX_records[s->item].name) : tn_solid_kind_text(s->kind);
    const char *type = item                           ? "NOTDEFINED"
                       : post                         ? "COLUMN"
                       : s->kind == TN_SOLID_ROOFDECK ? "ROOF"
                       : s->of == 0                   ? "BASESLAB"
                                                      : "FLOOR";
    unsigned part =
        tn_stepfile_add(step, "%s('%s',$,'%s',$,$,#%u,#%u,$,.%s.)",
                        item   ? "IFCFURNITURE"
                        : post ? "IFCCOLUMN"
                               : "IFCSLAB",
                        tn_stepfile_guid(step, "box", number).text, tn_stepfile_text(name).text, where, body, type);
    if (!item)
        put_volume(ifc, part, post ? "Qto_ColumnBaseQuantities" : "Qto_SlabBaseQuantities", volume_of(&s->at));
    keep(ifc, s, part, list);
}

/* ---- roofs and stairs */

static unsigned put_point(tn_stepfile *step, tn_fraction across, double height)
{
    return tn_stepfile_add(step, "IFCCARTESIANPOINT((%s,%s))", tn_stepfile_mm(tn_fraction_value(across)).text,
                           tn_stepfile_mm(height).text);
}

/* The end of a roof: below along its underside, and back along its line. Its axes are across the ridge and upwards. */
static unsigned put_profile(tn_ifc *ifc, const tn_prism *p, double floor)
{
    tn_stepfile *step = &ifc->step;
    const tn_roof_point *points = ifc->solids->points + p->point_first;
    tn_stepfile_list line = {0};
    unsigned first = 0;
    for (size_t i = 0; i < p->point_count; i++) {
        if (!p->slab && i > 0 && i + 1 < p->point_count)
            continue;
        double under = p->slab ? tn_fraction_value(points[i].z) - (double)p->slab : (double)p->base;
        unsigned point = put_point(step, points[i].y, under - floor);
        tn_stepfile_list_add(&line, point);
        first = first ? first : point;
    }
    for (size_t i = p->point_count; i-- > 0;)
        tn_stepfile_list_add(&line, put_point(step, points[i].y, tn_fraction_value(points[i].z) - floor));
    tn_stepfile_list_add(&line, first);
    const char *list = tn_stepfile_list_text(&line);
    unsigned curve = tn_stepfile_add(step, "IFCPOLYLINE(%s)", list ? list : "()");
    ifc->failed |= line.text.failed;
    tn_stepfile_list_clear(&line);
    return tn_stepfile_add(step, "IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#%u)", curve);
}

/* A roof along x is extruded to the right, from its left end; one across the row to the back, from its front end. */
static void put_roof(tn_ifc *ifc, unsigned number, tn_stepfile_list *list)
{
    tn_stepfile *step = &ifc->step;
    const tn_prism *p = &ifc->solids->prisms[number];
    unsigned profile = put_profile(ifc, p, (double)ifc->house->form->level[ifc->storey]);
    unsigned y = tn_stepfile_add(step, "IFCDIRECTION((0.,%s,0.))", p->across ? "-1." : "1.");
    unsigned axes = tn_stepfile_add(step, "IFCAXIS2PLACEMENT3D(#%u,#%u,#%u)", step->origin, p->across ? y : step->x,
                                    p->across ? step->x : y);
    char solid[16];
    snprintf(solid, sizeof solid, "(#%u)",
             tn_stepfile_add(step, "IFCEXTRUDEDAREASOLID(#%u,#%u,#%u,%s)", profile, axes, step->z,
                             tn_stepfile_mm((double)(p->to - p->from)).text));
    unsigned body = tn_stepfile_shape(step, solid),
             where = tn_stepfile_placement(step, ifc->placement, p->across ? 0 : (double)p->from,
                                           p->across ? (double)p->to : 0, 0);
    unsigned roof = tn_stepfile_add(step, "IFCROOF('%s',$,'roof',$,$,#%u,#%u,$,.NOTDEFINED.)",
                                    tn_stepfile_guid(step, "roof", number).text, where, body);
    keep(ifc, &(tn_solid){.kind = TN_SOLID_ROOF, .of = p->of}, roof, list);
}

/* The steps and landings of a flight, as one shape; 0 where a stair has none. */
static unsigned put_steps(tn_ifc *ifc, uint32_t face)
{
    tn_stepfile *step = &ifc->step;
    tn_stepfile_list steps = {0};
    const tn_rectangle *from = &ifc->house->faces[face].at;
    double floor = (double)ifc->house->form->level[ifc->storey];
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
        return "QUARTER_TURN_STAIR";
    case TN_TURN_HALF:
        return "HALF_TURN_STAIR";
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

void tn_ifc_elements(tn_ifc *ifc, tn_stepfile_list *list)
{
    for (size_t i = 0; i < ifc->solids->box_count; i++) {
        const tn_solid *s = &ifc->solids->boxes[i];
        if (storey_of(ifc, s) != ifc->storey || s->kind == TN_SOLID_FLIGHT)
            continue;
        if (!is_wall(s->kind))
            put_box(ifc, s, (unsigned)i, list);
        else if (!ifc->walls[s->of])
            put_wall(ifc, i, list);
    }
    for (unsigned i = 0; i < ifc->solids->prism_count; i++)
        if (ifc->house->cells[ifc->solids->prisms[i].of].storey == ifc->storey)
            put_roof(ifc, i, list);
    put_stairs(ifc, list);
}
