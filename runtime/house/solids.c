/* Builds the solids of a house: posts and walls with their openings, decks, roofs, guards, and what stands in the
 * rooms. */
#include "runtime/house/solids.h"
#include "runtime/base/array.h"

#include <stdlib.h>
#include <string.h>

const char *tn_solid_kind_text(tn_solid_kind kind)
{
    static const char *const words[] = {"outside", "party", "partition", "post", "deck",  "roofdeck",
                                        "item",    "roof",  "pane",      "leaf", "flight", "guard", "gable", "beam"};
    return words[kind];
}

tn_status tn_solids_add(tn_solids *solids, tn_solid solid, tn_error *error)
{
    if (!tn_array_reserve_from(&solids->boxes, &solids->box_room, 64, solids->box_count, 1, sizeof *solids->boxes))
        return tn_fail_memory(error);
    solids->boxes[solids->box_count++] = solid;
    return TN_OK;
}

static tn_status put(tn_solids *solids, tn_solid_kind kind, uint32_t of, tn_rectangle r, int64_t z0, int64_t z1,
                     tn_error *error)
{
    return tn_solids_add(solids, (tn_solid){.kind = kind, .of = of, .at = {r.x0, r.x1, r.y0, r.y1, z0, z1}}, error);
}

tn_rectangle tn_cell_grown(const tn_house *house, const tn_cell *cell)
{
    int64_t half = house->form->record->wall / 2;
    return (tn_rectangle){cell->at.x0 - half, cell->at.x1 + half, cell->at.y0 - half, cell->at.y1 + half};
}

/* ---- walls */

/* A wall between the posts at its ends; `from` and `to` run along it. */
typedef struct tn_wall {
    const tn_face *face;
    tn_solid_kind kind;
    uint32_t of;
    int64_t thick, from, to;
} tn_wall;

static tn_rectangle wall_part(const tn_wall *wall, int64_t from, int64_t to)
{
    const tn_rectangle *at = &wall->face->at;
    int64_t half = wall->thick / 2;
    if (at->x0 == at->x1)
        return (tn_rectangle){at->x0 - half, at->x0 + half, from, to};
    return (tn_rectangle){from, to, at->y0 - half, at->y0 + half};
}

/* Jamb, sill, lintel, jamb. */
static tn_status put_opening(tn_solids *solids, const tn_wall *wall, const tn_opening_record *o, int64_t z0, int64_t z1,
                             tn_error *error)
{
    int64_t from = tn_opening_begins(wall->face, o), to = from + o->wide;
    tn_status status = TN_OK;
    if (wall->from < from)
        status = put(solids, wall->kind, wall->of, wall_part(wall, wall->from, from), z0, z1, error);
    if (status == TN_OK && o->sill)
        status = put(solids, wall->kind, wall->of, wall_part(wall, from, to), z0, z0 + o->sill, error);
    if (status == TN_OK && o->sill + o->high < z1 - z0)
        status = put(solids, wall->kind, wall->of, wall_part(wall, from, to), z0 + o->sill + o->high, z1, error);
    if (status == TN_OK && to < wall->to)
        status = put(solids, wall->kind, wall->of, wall_part(wall, to, wall->to), z0, z1, error);
    return status;
}

static tn_status put_wall(const tn_house *house, uint32_t index, const tn_posts *posts, tn_rectangles *foot,
                          tn_solids *solids, tn_error *error)
{
    const tn_face *face = &house->faces[index];
    const tn_house_form *form = house->form;
    tn_wall wall = {.face = face, .of = index, .thick = tn_face_thickness(house, face)};
    if (wall.thick == 0)
        return TN_OK;
    const tn_post *first = tn_posts_find(posts, face->at.x0, face->at.y0),
                  *last = tn_posts_find(posts, face->at.x1, face->at.y1);
    bool in_y = face->at.x0 == face->at.x1;
    wall.from = in_y ? face->at.y0 + first->thick_y / 2 : face->at.x0 + first->thick_x / 2;
    wall.to = in_y ? face->at.y1 - last->thick_y / 2 : face->at.x1 - last->thick_x / 2;
    wall.kind = tn_face_wall(house, face);
    int64_t z0 = form->level[face->storey], z1 = z0 + tn_form_clear(form, face->storey);
    const tn_opening_record *opening = tn_form_opening(form, face->kind);
    tn_status status = tn_rectangles_add(foot, wall_part(&wall, wall.from, wall.to), error);
    if (status != TN_OK)
        return status;
    return opening ? put_opening(solids, &wall, opening, z0, z1, error)
                   : put(solids, wall.kind, index, wall_part(&wall, wall.from, wall.to), z0, z1, error);
}

/* The posts and walls of a storey; `foot`: the rectangles that they stand on. */
static tn_status put_walls(const tn_house *house, uint32_t storey, tn_rectangles *foot, tn_solids *solids,
                           tn_error *error)
{
    const tn_house_form *form = house->form;
    int64_t z0 = form->level[storey], z1 = z0 + tn_form_clear(form, storey);
    tn_posts posts;
    tn_status status = tn_house_posts(house, storey, NULL, &posts, error);
    for (size_t i = 0; status == TN_OK && i < posts.count; i++) {
        const tn_post *post = &posts.items[i];
        if (!post->thick_x || !post->thick_y)
            continue;
        tn_rectangle at = tn_post_at(post);
        tn_solid solid = {TN_SOLID_POST, storey, TN_NO_FACE, {at.x0, at.x1, at.y0, at.y1, z0, z1}};
        if (form->record->layer_count > 0)
            solid.item = tn_post_wall(house, storey, post);
        status = tn_solids_add(solids, solid, error);
        if (status == TN_OK)
            status = tn_rectangles_add(foot, tn_post_at(post), error);
    }
    for (uint32_t i = 0; status == TN_OK && i < house->face_count; i++)
        if (house->faces[i].storey == storey)
            status = put_wall(house, i, &posts, foot, solids, error);
    free(posts.items);
    return status;
}

/* ---- beams */

/* A wall or post, and what of it is not in the way of beams. */
static tn_status put_around(const tn_solid *solid, const tn_solids *beams, tn_solids *kept, tn_error *error)
{
    tn_rectangle at = {solid->at.x0, solid->at.x1, solid->at.y0, solid->at.y1};
    tn_rectangles whole = {&at, 1, 1}, met = {0}, rest = {0};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < beams->box_count; i++) {
        const tn_box *beam = &beams->boxes[i].at;
        tn_rectangle under = {beam->x0, beam->x1, beam->y0, beam->y1};
        if (!tn_rectangles_meet(&at, &under) || beam->z0 >= solid->at.z1 || beam->z1 <= solid->at.z0)
            continue;
        tn_solid below = *solid;
        under = tn_rectangles_common(&at, &under);
        below.at = (tn_box){under.x0, under.x1, under.y0, under.y1, solid->at.z0, beam->z0};
        status = tn_rectangles_add(&met, under, error);
        if (status == TN_OK && below.at.z0 < below.at.z1)
            status = tn_solids_add(kept, below, error);
    }
    if (status == TN_OK && met.count == 0)
        status = tn_solids_add(kept, *solid, error);
    else if (status == TN_OK)
        status = tn_region_cut(&whole, &met, &rest, error);
    for (size_t i = 0; status == TN_OK && i < rest.count; i++)
        status = put(kept, solid->kind, solid->of, rest.items[i], solid->at.z0, solid->at.z1, error);
    for (size_t i = 0; status == TN_OK && i < rest.count; i++)
        kept->boxes[kept->box_count - 1 - i].item = solid->item;
    free(met.items);
    free(rest.items);
    return status;
}

/* The beams below walls that nothing else bears, in the place of what stands there. So far there are walls and posts. */
static tn_status put_beams(const tn_house *house, const tn_flights *flights, tn_solids *solids, tn_error *error)
{
    tn_bearing bearing;
    tn_solids beams = {0}, kept = {0};
    if (house->form->record->beam_count == 0)
        return TN_OK;
    tn_status status = tn_house_bearing(house, flights, &bearing, error);
    for (size_t i = 0; status == TN_OK && i < bearing.count; i++) {
        const tn_unborne *b = &bearing.items[i];
        if (b->beam != TN_NO_RECORD)
            status = tn_solids_add(&beams, (tn_solid){TN_SOLID_BEAM, b->storey - 1, b->beam, b->at}, error);
    }
    for (size_t i = 0; status == TN_OK && beams.box_count > 0 && i < solids->box_count; i++)
        status = put_around(&solids->boxes[i], &beams, &kept, error);
    for (size_t i = 0; status == TN_OK && i < beams.box_count; i++)
        status = tn_solids_add(&kept, beams.boxes[i], error);
    if (status == TN_OK && beams.box_count > 0) {
        tn_solids_clear(solids);
        *solids = kept;
        kept = (tn_solids){0};
    }
    tn_bearing_clear(&bearing);
    tn_solids_clear(&beams);
    tn_solids_clear(&kept);
    return status;
}

/* ---- decks */

/* Is there a hole in the floor of a cell: a stair below, or the cell below is open to it? */
static bool has_hole(const tn_house *house, uint32_t cell)
{
    for (size_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (face->relation == TN_FACE_UNDER && face->second == cell)
            return face->kind == TN_FACE_STAIR || face->kind == TN_FACE_OPEN;
    }
    return false;
}

/* Flights below a storey leave holes in its floor. */
static tn_status find_holes(const tn_house *house, uint32_t storey, const tn_flights *flights, tn_rectangles *holes,
                            tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < flights->count; i++) {
        const tn_flight *flight = &flights->items[i];
        if (house->faces[flight->face].storey + 1 != storey)
            continue;
        for (size_t h = 0; status == TN_OK && h < flight->hole_count; h++)
            status = tn_rectangles_add(holes, flight->holes[h], error);
    }
    return status;
}

/* Posts may stand in its way, where thicker walls end than those around it. foot: of its storey. */
static tn_status put_step(const tn_house *house, const tn_flight *flight, const tn_box *step, const tn_rectangles *foot,
                          tn_solids *solids, tn_error *error)
{
    int64_t floor = house->form->level[house->faces[flight->face].storey];
    tn_rectangle at = {step->x0, step->x1, step->y0, step->y1};
    tn_rectangles pieces = {0};
    tn_status status = tn_region_cut(&(tn_rectangles){&at, 1, 1}, foot, &pieces, error);
    for (size_t i = 0; status == TN_OK && i < pieces.count; i++)
        status = put(solids, TN_SOLID_FLIGHT, flight->face, pieces.items[i], floor + step->z0, floor + step->z1, error);
    free(pieces.items);
    return status;
}

/* The deck below a storey's floor; its rectangles are kept for the roof decks. */
static tn_status put_deck(const tn_house *house, uint32_t storey, const tn_flights *flights, const tn_rectangles *foot,
                          tn_rectangles *deck, tn_solids *solids, tn_error *error)
{
    tn_rectangles floors = {0}, holes = {0};
    tn_status status = find_holes(house, storey, flights, &holes, error);
    for (uint32_t i = 0; status == TN_OK && i < house->cell_count; i++)
        if (house->cells[i].storey == storey && !has_hole(house, i))
            status = tn_rectangles_add(&floors, tn_cell_grown(house, &house->cells[i]), error);
    for (size_t i = 0; status == TN_OK && storey > 0 && i < foot->count; i++)
        status = tn_rectangles_add(&floors, foot->items[i], error);
    if (status == TN_OK)
        status = tn_region_cut(&floors, &holes, deck, error);
    int64_t z1 = house->form->level[storey];
    for (size_t i = 0; status == TN_OK && i < deck->count; i++)
        status = put(solids, TN_SOLID_DECK, storey, deck->items[i], z1 - house->form->record->deck, z1, error);
    free(floors.items);
    free(holes.items);
    return status;
}

/* ---- what stands in the rooms */

static tn_status put_items(const tn_house *house, uint32_t index, tn_solids *solids, tn_error *error)
{
    const tn_cell *cell = &house->cells[index];
    int64_t floor = house->form->level[cell->storey];
    tn_variants v;
    tn_status status = tn_tile_variants(house, index, &v, error);
    const tn_tile_variant *variant = status == TN_OK && v.count > 0 ? &v.variants[cell->variant] : NULL;
    for (size_t i = 0; variant && status == TN_OK && i < variant->item_count; i++) {
        const tn_standing_item *item = &v.items[variant->item_first + i];
        tn_solid solid = {.kind = TN_SOLID_ITEM, .of = index, .item = item->box, .at = item->at};
        solid.at.z0 += floor;
        solid.at.z1 += floor;
        status = tn_solids_add(solids, solid, error);
    }
    tn_variants_clear(&v);
    return status;
}

/* One of the two pieces of a wedge: those beside it have the same levels, so that they have whole faces in common. */
static tn_status put_wedge(const tn_wedge *wedge, uint32_t face, int64_t floor, size_t piece, tn_solids *solids,
                           tn_error *error)
{
    tn_prism prism = {.kind = TN_SOLID_FLIGHT,
                      .of = face,
                      .rise = {0, 1},
                      .corner_first = solids->corner_count,
                      .corner_count = wedge->count};
    if (!tn_array_reserve_from(&solids->prisms, &solids->prism_room, 16, solids->prism_count, 1,
                               sizeof *solids->prisms) ||
        !tn_array_reserve_from(&solids->corners, &solids->corner_room, 64, solids->corner_count, wedge->count,
                               sizeof *solids->corners))
        return tn_fail_memory(error);
    for (size_t i = 0; i < wedge->count; i++)
        solids->corners[solids->corner_count++] = (tn_prism_corner){{wedge->at[i][0], 1},
                                                                    {wedge->at[i][1], 1},
                                                                    {floor + wedge->levels[piece], 1},
                                                                    {floor + wedge->levels[piece + 1], 1}};
    solids->prisms[solids->prism_count++] = prism;
    return TN_OK;
}

static tn_status put_wedges(const tn_house *house, const tn_flight *flight, tn_solids *solids, tn_error *error)
{
    int64_t floor = house->form->level[house->faces[flight->face].storey];
    tn_status status = TN_OK;
    for (size_t i = 0; i < flight->wedge_count; i++)
        for (size_t piece = 0; status == TN_OK && piece < 2; piece++)
            if (flight->wedges[i].levels[piece] < flight->wedges[i].levels[piece + 1])
                status = put_wedge(&flight->wedges[i], flight->face, floor, piece, solids, error);
    return status;
}

static tn_status put_stairs(const tn_house *house, const tn_rectangles *foot, const tn_flights *flights,
                            tn_solids *solids, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < flights->count; i++) {
        const tn_flight *flight = &flights->items[i];
        const tn_rectangles *posts = &foot[house->faces[flight->face].storey];
        for (size_t t = 0; status == TN_OK && t < flight->tread_count; t++)
            status = put_step(house, flight, &flight->treads[t], posts, solids, error);
        if (status == TN_OK)
            status = put_wedges(house, flight, solids, error);
    }
    return status == TN_OK ? tn_house_guards(house, foot, flights, solids, error) : status;
}

static tn_status put_building(const tn_house *house, bool items, const tn_flights *flights, tn_solids *solids,
                              tn_error *error)
{
    uint32_t storeys = house->form->record->storey_count;
    tn_rectangles foot[TN_STOREYS_MAX + 1] = {{0}}, decks[TN_STOREYS_MAX + 1] = {{0}};
    tn_status status = TN_OK;
    for (uint32_t k = 0; status == TN_OK && k < storeys; k++)
        status = put_walls(house, k, &foot[k], solids, error);
    if (status == TN_OK)
        status = put_beams(house, flights, solids, error);
    for (uint32_t k = 0; status == TN_OK && k <= storeys; k++)
        status = put_deck(house, k, flights, &foot[k], &decks[k], solids, error);
    if (status == TN_OK)
        status = tn_house_roofs(house, decks, foot, solids, error);
    for (uint32_t i = 0; status == TN_OK && items && i < house->cell_count; i++)
        status = put_items(house, i, solids, error);
    if (status == TN_OK)
        status = put_stairs(house, foot, flights, solids, error);
    for (uint32_t k = 0; k <= storeys; k++) {
        free(foot[k].items);
        free(decks[k].items);
    }
    return status;
}

static tn_status put_all(const tn_house *house, bool items, tn_solids *solids, tn_error *error)
{
    tn_flights flights;
    *solids = (tn_solids){0};
    tn_status status = tn_flights_stand(house, &flights, error);
    if (status == TN_OK)
        status = put_building(house, items, &flights, solids, error);
    tn_flights_clear(&flights);
    return status;
}

tn_status tn_house_solids(const tn_house *house, tn_solids *solids, tn_error *error)
{
    return put_all(house, true, solids, error);
}

tn_status tn_house_shell(const tn_house *house, tn_solids *solids, tn_error *error)
{
    return put_all(house, false, solids, error);
}

void tn_solids_clear(tn_solids *solids)
{
    free(solids->boxes);
    free(solids->prisms);
    free(solids->corners);
    *solids = (tn_solids){0};
}
