/* Writes the walls of a storey of a building model, with their openings, and what fills these.
 *
 * The x axis of a wall goes along the line of its face, from its low end to its high one. Where walls meet, one of them
 * takes the whole of the corner, that as which it is cut into layers, and the others end at it. */
#include <stdio.h>
#include <stdlib.h>

#include "runtime/house/export/ifc.h"

static bool is_wall(tn_solid_kind kind)
{
    return kind == TN_SOLID_OUTSIDE || kind == TN_SOLID_PARTY || kind == TN_SOLID_PARTITION;
}

static bool runs_in_y(const tn_face *face)
{
    return face->at.x0 == face->at.x1;
}

/* ---- where walls are */

static void cover(tn_ifc_wall *wall, const tn_box *b)
{
    tn_box *all = &wall->box;
    if (all->x0 == all->x1) { /* nothing so far */
        *all = *b;
        return;
    }
    all->x0 = b->x0 < all->x0 ? b->x0 : all->x0;
    all->x1 = b->x1 > all->x1 ? b->x1 : all->x1;
    all->y0 = b->y0 < all->y0 ? b->y0 : all->y0;
    all->y1 = b->y1 > all->y1 ? b->y1 : all->y1;
    all->z0 = b->z0 < all->z0 ? b->z0 : all->z0;
    all->z1 = b->z1 > all->z1 ? b->z1 : all->z1;
}

/* The post that a box is, or a piece of. */
static const tn_post *post_of(const tn_posts *posts, const tn_box *box)
{
    for (size_t i = 0; i < posts->count; i++) {
        tn_rectangle at = tn_post_at(&posts->items[i]);
        if (box->x0 >= at.x0 && box->x1 <= at.x1 && box->y0 >= at.y0 && box->y1 <= at.y1)
            return &posts->items[i];
    }
    return NULL;
}

/* Does the form make posts of something of which it makes no wall? Then they stand in corners, too. */
static bool posts_are_apart(const tn_house *house)
{
    uint32_t of_posts = tn_part_material(house, TN_OF_POST);
    return of_posts != TN_NO_RECORD && of_posts != tn_part_material(house, TN_OF_WALL) &&
           of_posts != tn_part_material(house, TN_OF_PARTY) && of_posts != tn_part_material(house, TN_OF_PARTITION);
}

/* Finds the boxes of the storey's walls, and which take its posts. */
static void find_walls(tn_ifc *ifc, const tn_posts *posts)
{
    const tn_solids *solids = ifc->solids;
    bool apart = ifc->house->form->record->layer_count == 0 && posts_are_apart(ifc->house);
    for (size_t i = 0; i < solids->box_count; i++) {
        const tn_solid *s = &solids->boxes[i];
        uint32_t face = TN_NO_FACE;
        if (is_wall(s->kind) && ifc->house->faces[s->of].storey == ifc->storey)
            face = s->of;
        const tn_post *post =
            s->kind == TN_SOLID_POST && s->of == ifc->storey && !apart ? post_of(posts, &s->at) : NULL;
        if (post)
            face = tn_post_wall(ifc->house, ifc->storey, post);
        if (face == TN_NO_FACE)
            continue;
        ifc->joined[i] = post != NULL;
        cover(&ifc->walls[face], &s->at);
        ifc->walls[face].volume += tn_ifc_box_volume(&s->at);
    }
}

/* A box in the place of a face: along it, across it, up from the floor of the storey. */
static void in_face(const tn_ifc *ifc, const tn_face *face, const tn_box *b, double low[3], double high[3])
{
    const tn_rectangle *at = &face->at;
    int64_t floor = ifc->house->form->level[ifc->storey];
    bool in_y = runs_in_y(face);
    low[0] = (double)(in_y ? b->y0 - at->y0 : b->x0 - at->x0);
    high[0] = (double)(in_y ? b->y1 - at->y0 : b->x1 - at->x0);
    low[1] = (double)(in_y ? at->x0 - b->x1 : b->y0 - at->y0);
    high[1] = (double)(in_y ? at->x0 - b->x0 : b->y1 - at->y0);
    low[2] = (double)(b->z0 - floor);
    high[2] = (double)(b->z1 - floor);
}

/* ---- doors and windows */

static const tn_swing *swing_of(const tn_ifc *ifc, uint32_t face)
{
    for (size_t i = 0; i < ifc->doors.count; i++)
        if (ifc->doors.items[i].of == face)
            return &ifc->doors.items[i];
    return NULL;
}

/* Does what fills an opening open in the direction of the wall's y axis: a door as it swings, a window into the first
 * room of its face? */
static bool opens_along(const tn_house *house, const tn_face *face, const tn_swing *door)
{
    const tn_rectangle *room = &house->cells[face->first].at;
    bool in_y = runs_in_y(face), up = door   ? door->leaves[0].side > 0
                                      : in_y ? room->x0 >= face->at.x0
                                             : room->y0 >= face->at.y0;
    return in_y ? !up : up;
}

/* IfcDoorTypeOperationEnum: the hinges, or where a leaf slides to, are at the left or right for who looks in the
 * direction of the y axis. */
static const char *operation(const tn_swing *door, bool along)
{
    bool low = door->leaves[0].hinge < door->leaves[0].shut, left = low == along;
    if (door->sliding)
        return door->count == 2 ? "DOUBLE_DOOR_SLIDING" : left ? "SLIDING_TO_LEFT" : "SLIDING_TO_RIGHT";
    return door->count == 2 ? "DOUBLE_DOOR_SINGLE_SWING" : left ? "SINGLE_SWING_LEFT" : "SINGLE_SWING_RIGHT";
}

/* In words, to tell doors of one kind apart. */
static const char *hand_of(const tn_swing *door, bool along)
{
    bool low = door->leaves[0].hinge < door->leaves[0].shut;
    return door->count == 2 ? "" : low == along ? " left" : " right";
}

/* What doors and windows of one opening have in common. */
static void describe_filling(tn_ifc *ifc, uint32_t number, unsigned part, const char *type)
{
    const tn_face *face = &ifc->house->faces[number];
    const tn_opening_record *o = tn_form_opening(ifc->house->form, face->kind);
    bool door = swing_of(ifc, number) != NULL;
    double wide = (double)o->wide, high = (double)o->high;
    const tn_ifc_property external = tn_ifc_truth("IsExternal", tn_face_is_outer(ifc->house, face));
    const tn_ifc_quantity quantities[] = {{"Width", 'L', wide},
                                          {"Height", 'L', high},
                                          {"Perimeter", 'L', 2 * (wide + high)},
                                          {"Area", 'A', wide * high / 1e18}};
    tn_ifc_properties(ifc, part, door ? "Pset_DoorCommon" : "Pset_WindowCommon", type, &external, 1);
    tn_ifc_quantities(ifc, part, door ? "Qto_DoorBaseQuantities" : "Qto_WindowBaseQuantities", NULL, quantities, 4);
}

/* The leaf or pane of an opening, in the middle of it, as thick as it is or as the wall. size: of the opening; where:
 * its placement. */
static void fill(tn_ifc *ifc, uint32_t number, unsigned opening, unsigned where, const double size[3], const char *key,
                 tn_stepfile_list *list)
{
    tn_stepfile *step = &ifc->step;
    const tn_face *face = &ifc->house->faces[number];
    const tn_opening_record *o = tn_form_opening(ifc->house->form, face->kind);
    const tn_swing *door = swing_of(ifc, number);
    const char *name = tn_text(ifc->house->form->module, o->name);
    bool along = opens_along(ifc->house, face, door);
    const tn_solid solid = {.kind = door ? TN_SOLID_LEAF : TN_SOLID_PANE, .of = number};
    double thick = door ? (double)TN_LEAF_NM : (double)TN_PANE_NM;
    thick = thick < size[1] ? thick : size[1];
    const double low[3] = {0, 0, 0}, high[3] = {size[0], thick, size[2]};
    char type[TN_NAME_MAX + 20], tail[160], type_tail[80], own[TN_IFC_FACE_KEY + 20];
    snprintf(type_tail, sizeof type_tail, ",.NOTDEFINED.,.%s.,.F.,$", door ? operation(door, along) : "SINGLE_PANEL");
    snprintf(tail, sizeof tail, door ? ",%s,%s,.DOOR.,.%s.,$" : ",%s,%s,.WINDOW.,.%s.,$",
             tn_stepfile_length(step, size[2]).text, tn_stepfile_length(step, size[0]).text,
             door ? operation(door, along) : "SINGLE_PANEL");
    snprintf(type, sizeof type, "%s%s", name, door ? hand_of(door, along) : "");
    snprintf(own, sizeof own, "%s %s", door ? "door" : "window", key);
    tn_ifc_part part = {.entity = door ? "IFCDOOR" : "IFCWINDOW",
                        .tail = tail,
                        .type_tail = type_tail,
                        .name = name,
                        .type_name = type};
    part.where = tn_stepfile_turned(step, where, along ? 0 : size[0],
                                    along ? (size[1] - thick) / 2 : (size[1] + thick) / 2, 0, along ? 0 : 2);
    tn_ifc_look_as(ifc, &solid);
    part.shape = tn_ifc_box(ifc, low, high);
    unsigned made = tn_ifc_put(ifc, &part, own);
    tn_stepfile_add(step, "IFCRELFILLSELEMENT('%s',$,$,$,#%u,#%u)", tn_stepfile_guid(step, "fills %s", own).text,
                    opening, made);
    describe_filling(ifc, number, made, type);
    tn_ifc_make_of(ifc, &solid, made);
    tn_stepfile_list_add(list, made);
    ifc->walls[number].filling = made;
}

/* ---- openings */

/* What is cut out of a wall, by its low and high corner there. Returns its instance; *at: its placement. */
static unsigned cut(tn_ifc *ifc, const char *kind, const char *key, unsigned wall, unsigned where, const double low[3],
                    const double high[3], unsigned *at)
{
    tn_stepfile *step = &ifc->step;
    const double origin[3] = {0, 0, 0}, size[3] = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    step->style = 0;
    *at = tn_stepfile_placement(step, where, low[0], low[1], low[2]);
    unsigned shape = tn_ifc_box(ifc, origin, size);
    unsigned opening = tn_stepfile_add(step, "IFCOPENINGELEMENT('%s',$,$,$,$,#%u,#%u,$,.%s.)",
                                       tn_stepfile_guid(step, "%s %s", kind, key).text, *at, shape, kind);
    tn_stepfile_add(step, "IFCRELVOIDSELEMENT('%s',$,$,$,#%u,#%u)",
                    tn_stepfile_guid(step, "voids %s %s", kind, key).text, wall, opening);
    return opening;
}

/* What beams take of a wall's box is cut out of it: of the end of a partition that meets them. */
static void put_pockets(tn_ifc *ifc, uint32_t number, const char *key, unsigned where)
{
    const tn_face *face = &ifc->house->faces[number];
    const tn_ifc_wall *wall = &ifc->walls[number];
    for (size_t i = 0; i < ifc->solids->box_count; i++) {
        const tn_solid *s = &ifc->solids->boxes[i];
        tn_rectangle at = tn_rectangles_common(&(tn_rectangle){wall->box.x0, wall->box.x1, wall->box.y0, wall->box.y1},
                                               &(tn_rectangle){s->at.x0, s->at.x1, s->at.y0, s->at.y1});
        tn_box pocket = {at.x0, at.x1, at.y0, at.y1, s->at.z0, wall->box.z1};
        double low[3], high[3];
        unsigned placed;
        if (s->kind != TN_SOLID_BEAM || at.x0 >= at.x1 || at.y0 >= at.y1 || pocket.z0 >= pocket.z1 ||
            s->at.z1 <= wall->box.z0)
            continue;
        in_face(ifc, face, &pocket, low, high);
        cut(ifc, "RECESS", key, wall->part, where, low, high, &placed);
    }
}

static void put_opening(tn_ifc *ifc, uint32_t number, const tn_box *hole, const char *key, unsigned where,
                        tn_stepfile_list *list)
{
    double low[3], high[3];
    unsigned at;
    const tn_face *face = &ifc->house->faces[number];
    in_face(ifc, face, hole, low, high);
    unsigned opening = cut(ifc, "OPENING", key, ifc->walls[number].part, where, low, high, &at);
    const double size[3] = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    const tn_ifc_quantity quantities[] = {{"Width", 'L', size[0]},
                                          {"Height", 'L', size[2]},
                                          {"Depth", 'L', size[1]},
                                          {"Area", 'A', size[0] * size[2] / 1e18},
                                          {"Volume", 'V', size[0] * size[1] * size[2] / 1e27}};
    tn_ifc_quantities(ifc, opening, "Qto_OpeningElementBaseQuantities", NULL, quantities, 5);
    if (tn_house_is_filled(ifc->house, face))
        fill(ifc, number, opening, at, size, key, list);
}

/* ---- walls */

/* Its axis along the line of its face, from end to end, and its box about that. */
static unsigned shape_of(tn_ifc *ifc, const tn_face *face, const double low[3], const double high[3])
{
    tn_stepfile *step = &ifc->step;
    const tn_rectangle *at = &face->at;
    const double axis[2][2] = {{0, 0}, {(double)(runs_in_y(face) ? at->y1 - at->y0 : at->x1 - at->x0), 0}};
    char list[16];
    unsigned line = tn_stepfile_add(step, "IFCSHAPEREPRESENTATION(#%u,'Axis','Curve2D',(#%u))", step->axes_context,
                                    tn_stepfile_curve(step, axis, 2));
    snprintf(list, sizeof list, "(#%u)", tn_stepfile_solid(step, low, high));
    return tn_stepfile_shape(step, tn_stepfile_body(step, "SweptSolid", list), line);
}

/* From end to end with what it takes of corners. */
static void describe_wall(tn_ifc *ifc, uint32_t number, const char *type, const char *key, const double low[3],
                          const double high[3])
{
    const tn_ifc_wall *wall = &ifc->walls[number];
    const tn_face *face = &ifc->house->faces[number];
    double length = high[0] - low[0], thick = high[1] - low[1], tall = high[2] - low[2];
    const tn_ifc_property properties[] = {
        tn_ifc_truth("IsExternal", tn_face_is_outer(ifc->house, face)),
        tn_ifc_truth("LoadBearing", tn_face_wall(ifc->house, face) != TN_SOLID_PARTITION)};
    const tn_ifc_quantity quantities[] = {{"Length", 'L', length},
                                          {"Width", 'L', thick},
                                          {"Height", 'L', tall},
                                          {"GrossFootprintArea", 'A', length * thick / 1e18},
                                          {"GrossSideArea", 'A', length * tall / 1e18},
                                          {"NetSideArea", 'A', wall->volume / (thick / 1e9)},
                                          {"GrossVolume", 'V', length * thick * tall / 1e27},
                                          {"NetVolume", 'V', wall->volume}};
    tn_ifc_properties(ifc, wall->part, "Pset_WallCommon", type, properties, 2);
    tn_ifc_quantities(ifc, wall->part, "Qto_WallBaseQuantities", key, quantities, 8);
}

static void put_wall(tn_ifc *ifc, uint32_t number, tn_stepfile_list *list)
{
    tn_stepfile *step = &ifc->step;
    tn_ifc_wall *wall = &ifc->walls[number];
    const tn_face *face = &ifc->house->faces[number];
    const tn_solid solid = {.kind = tn_face_wall(ifc->house, face), .of = number};
    const char *tail = solid.kind == TN_SOLID_PARTITION ? ",.PARTITIONING." : ",.SOLIDWALL.";
    char key[TN_IFC_FACE_KEY], own[TN_IFC_FACE_KEY + 10], type[100];
    double low[3], high[3];
    tn_box hole;
    bool open = tn_house_hole(ifc->house, face, &hole);
    if (open)
        cover(wall, &hole);
    in_face(ifc, face, &wall->box, low, high);
    tn_ifc_face_key(ifc, number, key);
    snprintf(own, sizeof own, "wall %s", key);
    tn_ifc_sized_name(ifc, tn_solid_kind_text(solid.kind), tn_face_thickness(ifc->house, face), type, sizeof type);
    tn_ifc_look_as(ifc, &solid);
    tn_ifc_part part = {
        .entity = "IFCWALL",
        .tail = tail,
        .name = tn_solid_kind_text(solid.kind),
        .type_name = type,
        .where = tn_stepfile_turned(step, ifc->placement, (double)face->at.x0, (double)face->at.y0, 0, runs_in_y(face)),
        .shape = shape_of(ifc, face, low, high)};
    wall->part = tn_ifc_put(ifc, &part, own);
    tn_stepfile_list_add(list, wall->part);
    tn_ifc_make_of(ifc, &solid, wall->part);
    describe_wall(ifc, number, type, own, low, high);
    put_pockets(ifc, number, key, part.where);
    if (open)
        put_opening(ifc, number, &hole, key, part.where, list);
}

/* ---- how walls meet */

/* Does a wall end at the post's place: at its start (1) or end (2)? */
static int ends_at(const tn_ifc *ifc, uint32_t number, const tn_post *post)
{
    const tn_face *face = &ifc->house->faces[number];
    if (!ifc->walls[number].part || face->storey != ifc->storey)
        return 0;
    return face->at.x0 == post->x && face->at.y0 == post->y   ? 1
           : face->at.x1 == post->x && face->at.y1 == post->y ? 2
                                                              : 0;
}

static void connect(tn_ifc *ifc, uint32_t first, int first_end, uint32_t second, int second_end)
{
    static const char *const ends[] = {"NOTDEFINED", "ATSTART", "ATEND"};
    char keys[2][TN_IFC_FACE_KEY];
    tn_ifc_face_key(ifc, first, keys[0]);
    tn_ifc_face_key(ifc, second, keys[1]);
    tn_stepfile_add(&ifc->step, "IFCRELCONNECTSPATHELEMENTS('%s',$,$,$,$,#%u,#%u,(),(),.%s.,.%s.)",
                    tn_stepfile_guid(&ifc->step, "%s meets %s", keys[0], keys[1]).text, ifc->walls[first].part,
                    ifc->walls[second].part, ends[second_end], ends[first_end]);
}

/* All that end at a post's place meet the one that takes it, or the first. */
static void connect_at(tn_ifc *ifc, const tn_post *post)
{
    uint32_t main = tn_post_wall(ifc->house, ifc->storey, post);
    for (uint32_t i = 0; main == TN_NO_FACE && i < ifc->house->face_count; i++)
        main = ends_at(ifc, i, post) ? i : main;
    int end = main == TN_NO_FACE ? 0 : ends_at(ifc, main, post);
    for (uint32_t i = 0; end && i < ifc->house->face_count; i++) {
        int other = i == main ? 0 : ends_at(ifc, i, post);
        if (other)
            connect(ifc, main, end, i, other);
    }
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

tn_status tn_ifc_put_walls(tn_ifc *ifc, tn_stepfile_list *list, tn_error *error)
{
    tn_posts posts = {0};
    tn_status status = hang_doors(ifc, error);
    if (status == TN_OK)
        status = tn_house_posts(ifc->house, ifc->storey, NULL, &posts, error);
    if (status == TN_OK)
        find_walls(ifc, &posts);
    for (uint32_t i = 0; status == TN_OK && i < ifc->house->face_count; i++)
        if (ifc->house->faces[i].storey == ifc->storey && ifc->walls[i].volume > 0)
            put_wall(ifc, i, list);
    for (size_t i = 0; status == TN_OK && i < posts.count; i++)
        connect_at(ifc, &posts.items[i]);
    free(posts.items);
    return status;
}
