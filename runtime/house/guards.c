/* The guards that keep people from falling, if the form asks for ways: around the holes that flights leave in floors, at
 * voids, at sides that are open to the outside, and before doors that lead to nothing (docs/houses.md).
 *
 * A guard stands on the open side, so that it takes no floor. Where a post, a wall or a flight stands, there is none. */
#include <stdlib.h>

#include "runtime/house/solids.h"

#define METRIC_THICK_NM INT64_C(50000000)
#define FEET_THICK_NM INT64_C(50800000) /* 2" */
#define GAP_NM INT64_C(100000000)       /* nobody falls through a gap that is narrower, between a hole and a wall */

/* The guards of a storey. foot: what posts and walls stand on; taken: by guards that are there. */
typedef struct tn_guarding {
    const tn_house *house;
    uint32_t storey;
    int64_t thick, floor, high; /* high: how high they are there */
    const tn_rectangles *foot;
    const tn_flights *flights;
    tn_rectangles taken;
    tn_solids *solids;
} tn_guarding;

uint32_t tn_guard_storey(const tn_house *house, uint32_t face)
{
    return house->faces[face].storey + (house->faces[face].relation == TN_FACE_UNDER);
}

static int64_t least(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static int64_t most(int64_t a, int64_t b)
{
    return a > b ? a : b;
}

static tn_rectangle common(const tn_rectangle *a, const tn_rectangle *b)
{
    return (tn_rectangle){most(a->x0, b->x0), least(a->x1, b->x1), most(a->y0, b->y0), least(a->y1, b->y1)};
}

static tn_status add_all(tn_rectangles *to, const tn_rectangles *from, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < from->count; i++)
        status = tn_rectangles_add(to, from->items[i], error);
    return status;
}

/* ---- what stands in their way */

/* Puts guards on these rectangles, so high above the floor, where neither walls nor other guards nor `flights` are. */
static tn_status put_on(tn_guarding *g, uint32_t of, const tn_rectangles *on, const tn_rectangles *flights,
                        int64_t high, tn_error *error)
{
    tn_rectangles less = {0}, pieces = {0};
    tn_status status = add_all(&less, g->foot, error);
    if (status == TN_OK)
        status = add_all(&less, &g->taken, error);
    if (status == TN_OK && flights)
        status = add_all(&less, flights, error);
    if (status == TN_OK)
        status = tn_region_cut(on, &less, &pieces, error);
    for (size_t i = 0; status == TN_OK && i < pieces.count; i++) {
        const tn_rectangle *r = &pieces.items[i];
        tn_solid guard = {.kind = TN_SOLID_GUARD,
                          .of = of,
                          .at = {r->x0, r->x1, r->y0, r->y1, g->floor, g->floor + high}};
        status = tn_solids_add(g->solids, guard, error);
        if (status == TN_OK)
            status = tn_rectangles_add(&g->taken, *r, error);
    }
    free(less.items);
    free(pieces.items);
    return status;
}

/* Below a step of the storey's own flights guards end at it. */
static tn_status put_below(tn_guarding *g, uint32_t of, const tn_rectangles *on, const tn_box *step, tn_error *error)
{
    tn_rectangles below = {0};
    tn_rectangle at = {step->x0, step->x1, step->y0, step->y1};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < on->count; i++)
        if (tn_rectangles_meet(&on->items[i], &at))
            status = tn_rectangles_add(&below, common(&on->items[i], &at), error);
    if (status == TN_OK && below.count > 0)
        status = put_on(g, of, &below, NULL, step->z0, error);
    free(below.items);
    return status;
}

/* Puts guards below a step, and adds it to those in the way of others. */
static tn_status see_step(tn_guarding *g, uint32_t of, const tn_rectangles *on, const tn_box *step,
                          tn_rectangles *steps, tn_error *error)
{
    if (step->z0 >= g->high)
        return TN_OK;
    tn_status status = tn_rectangles_add(steps, (tn_rectangle){step->x0, step->x1, step->y0, step->y1}, error);
    return status == TN_OK && step->z0 > 0 ? put_below(g, of, on, step, error) : status;
}

static tn_status put_guards(tn_guarding *g, uint32_t of, const tn_rectangles *on, tn_error *error)
{
    tn_rectangles steps = {0};
    tn_status status = TN_OK;
    for (size_t f = 0; f < g->flights->count; f++) {
        const tn_flight *flight = &g->flights->items[f];
        if (g->house->faces[flight->face].storey != g->storey)
            continue;
        for (size_t t = 0; status == TN_OK && t < flight->tread_count; t++)
            status = see_step(g, of, on, &flight->treads[t], &steps, error);
        for (size_t w = 0; status == TN_OK && w < flight->wedge_count; w++) {
            tn_box around = tn_wedge_box(&flight->wedges[w]);
            status = see_step(g, of, on, &around, &steps, error);
        }
    }
    if (status == TN_OK)
        status = put_on(g, of, on, &steps, g->high, error);
    free(steps.items);
    return status;
}

/* ---- holes */

/* The strip along a side of a rectangle, so deep: inside it, or (beyond) outside. */
static tn_rectangle strip_of(const tn_rectangle *r, tn_house_side side, int64_t deep, bool beyond)
{
    int64_t in = beyond ? 0 : deep, out = beyond ? deep : 0;
    switch (side) {
    case TN_HOUSE_BACK:
        return (tn_rectangle){r->x0, r->x1, r->y0 - out, r->y0 + in};
    case TN_HOUSE_FRONT:
        return (tn_rectangle){r->x0, r->x1, r->y1 - in, r->y1 + out};
    case TN_HOUSE_LEFT:
        return (tn_rectangle){r->x0 - out, r->x0 + in, r->y0, r->y1};
    default:
        return (tn_rectangle){r->x1 - in, r->x1 + out, r->y0, r->y1};
    }
}

/* Where one steps off a flight at a side of its last steps, as a strip beyond them; an empty one: at no place. */
static tn_rectangle head_line(const tn_flight *flight, tn_house_side side)
{
    tn_rectangle beyond = strip_of(&flight->last, side, 1, true);
    return common(&beyond, &flight->head);
}

/* The part of a side's strip that is beside a rectangle near it. */
static tn_rectangle beside(const tn_rectangle *strip, bool in_x, const tn_rectangle *near)
{
    tn_rectangle part = *strip;
    if (in_x) {
        part.x0 = most(part.x0, near->x0);
        part.x1 = least(part.x1, near->x1);
    } else {
        part.y0 = most(part.y0, near->y0);
        part.y1 = least(part.y1, near->y1);
    }
    return part;
}

/* Adds guards in a part of a hole along one of its sides: not at the rest of the hole, a wall, or where one steps off
 * the flight. */
static tn_status guard_side(const tn_guarding *g, const tn_flight *flight, const tn_rectangles *walls,
                            const tn_rectangle *part, tn_house_side side, tn_rectangles *on, tn_error *error)
{
    bool in_x = side == TN_HOUSE_BACK || side == TN_HOUSE_FRONT;
    tn_rectangle reach = strip_of(part, side, GAP_NM, true), strip = strip_of(part, side, 1, true);
    tn_rectangles edge = {&strip, 1, 1}, shut = {0}, open = {0};
    tn_status status = tn_rectangles_add(&shut, head_line(flight, side), error);
    for (size_t i = 0; status == TN_OK && i < flight->hole_count; i++)
        status = tn_rectangles_add(&shut, flight->holes[i], error);
    for (size_t i = 0; status == TN_OK && i < walls->count; i++)
        if (tn_rectangles_meet(&reach, &walls->items[i]))
            status = tn_rectangles_add(&shut, beside(&strip, in_x, &walls->items[i]), error);
    if (status == TN_OK)
        status = tn_region_cut(&edge, &shut, &open, error);
    int64_t deep = least(g->thick, in_x ? part->y1 - part->y0 : part->x1 - part->x0);
    for (size_t i = 0; status == TN_OK && i < open.count; i++) {
        tn_rectangle inside = strip_of(part, side, deep, false);
        status = tn_rectangles_add(on, beside(&inside, in_x, &open.items[i]), error);
    }
    free(shut.items);
    free(open.items);
    return status;
}

static tn_status guard_hole(tn_guarding *g, const tn_flight *flight, const tn_rectangles *walls, tn_error *error)
{
    tn_rectangles on = {0};
    tn_status status = TN_OK;
    for (size_t i = 0; i < flight->drop_count; i++)
        for (tn_house_side side = TN_HOUSE_BACK; status == TN_OK && side <= TN_HOUSE_RIGHT; side++)
            status = guard_side(g, flight, walls, &flight->drops[i], side, &on, error);
    if (status == TN_OK)
        status = put_guards(g, flight->face, &on, error);
    free(on.items);
    return status;
}

/* ---- faces */

/* Has a cell a floor? It has none if it is open to the cell below. */
static bool has_floor(const tn_house *house, uint32_t cell)
{
    for (size_t i = 0; i < house->face_count; i++)
        if (house->faces[i].relation == TN_FACE_UNDER && house->faces[i].second == cell)
            return house->faces[i].kind != TN_FACE_OPEN;
    return true;
}

/* The rectangle along a face from one place to another, from one distance to another on the side of the drop. */
static tn_rectangle along_face(const tn_face *face, bool up, int64_t from, int64_t to, int64_t near, int64_t far)
{
    bool in_y = face->at.x0 == face->at.x1;
    int64_t plane = in_y ? face->at.x0 : face->at.y0, low = up ? plane + near : plane - far,
            high = up ? plane + far : plane - near;
    return in_y ? (tn_rectangle){low, high, from, to} : (tn_rectangle){from, to, low, high};
}

/* The passage of a face, through its wall. */
static tn_rectangle passage_of(const tn_house *house, const tn_face *face, const tn_opening_record *opening)
{
    int64_t half = tn_face_thickness(house, face) / 2, from = tn_opening_begins(face, opening);
    return along_face(face, true, from, from + opening->wide, -half, half);
}

/* Before a void it stands at the wall, in the void. Outside, where eaves may hang, it stands in the wall, as thick as
 * the leaf leaves it room. */
static tn_status guard_door(tn_guarding *g, uint32_t index, const tn_opening_record *opening, bool up, tn_error *error)
{
    const tn_face *face = &g->house->faces[index];
    bool outside = face->relation == TN_FACE_OUTSIDE;
    int64_t wall = tn_face_thickness(g->house, face), from = tn_opening_begins(face, opening), to = from + opening->wide,
            high = least(g->high, opening->sill + opening->high);
    if (!(opening->flags & TN_PASSAGE) || opening->sill >= high)
        return TN_OK;
    int64_t leaf = opening->flags & TN_LEAFLESS ? 0 : least(TN_LEAF_NM, wall),
            deep = least(g->thick, leaf ? (wall - leaf) / 2 : wall), near = outside ? wall / 2 - deep : wall / 2;
    tn_rectangle at = along_face(face, up, from, to, near, outside ? wall / 2 : near + g->thick);
    if (!outside)
        return put_guards(g, index, &(tn_rectangles){&at, 1, 1}, error);
    tn_solid guard = {.kind = TN_SOLID_GUARD,
                      .of = index,
                      .at = {at.x0, at.x1, at.y0, at.y1, g->floor + opening->sill, g->floor + high}};
    return deep > 0 ? tn_solids_add(g->solids, guard, error) : TN_OK;
}

/* Where a face leads from a floor to none. up: the drop is at the right of it, or in front. */
static tn_status guard_face(tn_guarding *g, uint32_t index, tn_error *error)
{
    const tn_face *face = &g->house->faces[index];
    const tn_opening_record *opening = tn_form_opening(g->house->form, face->kind);
    bool outside = face->relation == TN_FACE_OUTSIDE, first = has_floor(g->house, face->first),
         second = !outside && has_floor(g->house, face->second), in_y = face->at.x0 == face->at.x1;
    if ((!opening && face->kind != TN_FACE_OPEN) || first == second)
        return TN_OK;
    const tn_rectangle *floor = &g->house->cells[first ? face->first : face->second].at;
    bool up = in_y ? floor->x0 < face->at.x0 : floor->y0 < face->at.y0;
    if (opening)
        return guard_door(g, index, opening, up, error);
    int64_t half = least(g->thick, g->house->form->record->wall) / 2;
    tn_rectangle at = along_face(face, up, in_y ? face->at.y0 : face->at.x0, in_y ? face->at.y1 : face->at.x1,
                                 outside ? -half : 0, outside ? half : g->thick);
    return put_guards(g, index, &(tn_rectangles){&at, 1, 1}, error);
}

/* ---- all of them */

/* What of the storey's walls nobody walks through. */
static tn_status find_walls(const tn_guarding *g, tn_rectangles *walls, tn_error *error)
{
    tn_rectangles doors = {0};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < g->house->face_count; i++) {
        const tn_face *face = &g->house->faces[i];
        const tn_opening_record *opening = tn_form_opening(g->house->form, face->kind);
        if (face->storey == g->storey && opening && opening->flags & TN_PASSAGE)
            status = tn_rectangles_add(&doors, passage_of(g->house, face, opening), error);
    }
    if (status == TN_OK)
        status = tn_region_cut(g->foot, &doors, walls, error);
    free(doors.items);
    return status;
}

static tn_status guard_storey(tn_guarding *g, tn_error *error)
{
    tn_rectangles walls = {0};
    tn_status status = find_walls(g, &walls, error);
    for (size_t i = 0; status == TN_OK && i < g->flights->count; i++)
        if (tn_guard_storey(g->house, g->flights->items[i].face) == g->storey)
            status = guard_hole(g, &g->flights->items[i], &walls, error);
    for (uint32_t i = 0; status == TN_OK && i < g->house->face_count; i++)
        if (g->house->faces[i].storey == g->storey && g->house->faces[i].relation != TN_FACE_UNDER)
            status = guard_face(g, i, error);
    free(walls.items);
    return status;
}

tn_status tn_house_guards(const tn_house *house, const tn_rectangles *foot, const tn_flights *flights,
                          tn_solids *solids, tn_error *error)
{
    const tn_house_form *form = house->form;
    bool feet = tn_house_length_style(house) == TN_STYLE_FEET;
    tn_status status = TN_OK;
    for (uint32_t k = 1; status == TN_OK && form->record->guard > 0 && k < form->record->storey_count; k++) {
        tn_guarding g = {.house = house,
                         .storey = k,
                         .thick = feet ? FEET_THICK_NM : METRIC_THICK_NM,
                         .floor = form->level[k],
                         .high = least(form->record->guard, tn_form_clear(form, k)),
                         .foot = &foot[k],
                         .flights = flights,
                         .solids = solids};
        status = guard_storey(&g, error);
        free(g.taken.items);
    }
    return status;
}
