/* Draws the marks of a plan: how doors swing, their tags and those of windows, stairs, spaces that are open to below,
 * where sections are cut, dimensions; with them stairs and names. The front is below: all is turned by half. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/house/model/marks_names.h"
#include "runtime/house/model/model.h"

static void put_leaf(tn_marks *marks, const tn_door_leaf *leaf)
{
    double wide = fabs(leaf->shut - leaf->hinge), tip = leaf->face + leaf->side * wide;
    double h[2] = {leaf->hinge, leaf->face}, s[2] = {leaf->shut, leaf->face}, t[2] = {leaf->hinge, tip};
    int u = leaf->in_y ? 1 : 0, v = 1 - u;
    double turn = (s[u] - h[u]) * (t[v] - h[v]) - (s[v] - h[v]) * (t[u] - h[u]);
    tn_marks_leaf(marks, h[u], h[v], t[u], t[v], turn > 0);
}

/* A leaf that slides, where it is shut. */
static void put_sliding(tn_marks *marks, const tn_door_leaf *leaf)
{
    double h[2] = {leaf->hinge, leaf->face}, s[2] = {leaf->shut, leaf->face};
    int u = leaf->in_y ? 1 : 0, v = 1 - u;
    tn_marks_line(marks, TN_MARK_DOOR, h[u], h[v], s[u], s[v]);
}

static void put_door(tn_marks *marks, const tn_swing *door)
{
    for (int k = 0; k < door->count; k++)
        if (door->sliding)
            put_sliding(marks, &door->leaves[k]);
        else
            put_leaf(marks, &door->leaves[k]);
}

/* Panes of windows that the plan cuts. */
static void put_panes(const tn_house *house, uint32_t storey, tn_marks *marks)
{
    int64_t cut = tn_plan_level(house->form, storey);
    for (size_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        tn_solid pane;
        if (face->storey != storey || face->relation == TN_FACE_UNDER || !tn_house_filling(house, face, &pane) ||
            pane.kind != TN_SOLID_PANE || pane.at.z0 >= cut || pane.at.z1 <= cut)
            continue;
        double x0 = (double)pane.at.x0, x1 = (double)pane.at.x1, y0 = (double)pane.at.y0, y1 = (double)pane.at.y1;
        bool in_y = face->at.x0 == face->at.x1;
        if (in_y)
            tn_marks_pane(marks, (x0 + x1) / 2, y0, (x0 + x1) / 2, y1, x1 - x0);
        else
            tn_marks_pane(marks, x0, (y0 + y1) / 2, x1, (y0 + y1) / 2, y1 - y0);
    }
}

static void put_void(tn_rectangle r, tn_marks *marks)
{
    double x0 = (double)r.x0, x1 = (double)r.x1, y0 = (double)r.y0, y1 = (double)r.y1;
    tn_marks_line(marks, TN_MARK_VOID, x0, y0, x1, y1);
    tn_marks_line(marks, TN_MARK_VOID, x0, y1, x1, y0);
}

/* Both sides of the beams overhead. */
static tn_status put_beams(const tn_house *house, uint32_t storey, tn_marks *marks, tn_error *error)
{
    tn_flights flights;
    tn_bearing bearing = {0};
    tn_status status = tn_flights_stand(house, &flights, error);
    if (status == TN_OK)
        status = tn_house_bearing(house, &flights, &bearing, error);
    for (size_t i = 0; i < bearing.count; i++) {
        const tn_unborne *b = &bearing.items[i];
        double x0 = (double)b->at.x0, x1 = (double)b->at.x1, y0 = (double)b->at.y0, y1 = (double)b->at.y1;
        if (b->beam == TN_NO_RECORD || b->storey != storey + 1)
            continue;
        tn_marks_line(marks, TN_MARK_BEAM, x0, y0, b->in_y ? x0 : x1, b->in_y ? y1 : y0);
        tn_marks_line(marks, TN_MARK_BEAM, b->in_y ? x1 : x0, b->in_y ? y0 : y1, x1, y1);
    }
    tn_bearing_clear(&bearing);
    tn_flights_clear(&flights);
    return status;
}

/* ---- tags of doors and windows */

#define TAG_RADIUS 0.95 /* of a circle around two signs, in the size of lettering */

/* In a circle, which takes its place from the names of rooms. */
static tn_status put_tag(const char *tag, double u, double v, const tn_mark_style *style, tn_taken *taken,
                         tn_marks *marks, tn_error *error)
{
    double radius = fmax(TAG_RADIUS, tn_mark_width(tag) / 2 + 0.25) * style->lettering;
    int64_t half = (int64_t)radius;
    tn_marks_circle(marks, TN_MARK_TAG, u, v, radius);
    tn_marks_text(marks, TN_MARK_TAG, u, v, style->lettering, false, tag);
    tn_rectangle at = {(int64_t)u - half, (int64_t)u + half, (int64_t)v - half, (int64_t)v + half};
    return tn_rectangles_add(&taken->swings, at, error);
}

/* In the quarter that a door sweeps, where nothing stands. */
static tn_status tag_door(const tn_swing *door, const char *tag, const tn_mark_style *style, tn_taken *taken,
                          tn_marks *marks, tn_error *error)
{
    const tn_door_leaf *leaf = &door->leaves[0];
    double wide = fabs(leaf->shut - leaf->hinge), along = leaf->hinge + (leaf->shut - leaf->hinge) * 0.5,
           across = leaf->face + leaf->side * fmax(0.5 * wide, 1.1 * style->lettering);
    if (door->count == 2)
        along = leaf->shut;
    return put_tag(tag, leaf->in_y ? across : along, leaf->in_y ? along : across, style, taken, marks, error);
}

/* Outside of its wall, or, of one between rooms, in the second of them. */
static tn_status tag_window(const tn_house *house, const tn_face *face, const char *tag, const tn_mark_style *style,
                            tn_taken *taken, tn_marks *marks, tn_error *error)
{
    tn_box hole;
    if (!tn_house_hole(house, face, &hole))
        return TN_OK;
    uint32_t cell = tn_face_sheltered(house, face);
    tn_house_side side = tn_face_side(face, cell == TN_NO_CELL ? face->first : cell);
    bool low = side == TN_HOUSE_LEFT || side == TN_HOUSE_BACK, in_y = face->at.x0 == face->at.x1;
    double aside = 1.3 * style->lettering, u = (double)(hole.x0 + hole.x1) / 2, v = (double)(hole.y0 + hole.y1) / 2;
    if (in_y)
        u = low ? (double)hole.x0 - aside : (double)hole.x1 + aside;
    else
        v = low ? (double)hole.y0 - aside : (double)hole.y1 + aside;
    return put_tag(tag, u, v, style, taken, marks, error);
}

/* What the marks of a plan are made from. */
typedef struct tn_planned {
    const tn_house *house;
    uint32_t storey;
    const tn_mark_style *style;
    tn_taken taken;
    tn_swings doors;
    tn_designations names;
} tn_planned;

static tn_status put_tags(tn_planned *p, tn_marks *marks, tn_error *error)
{
    tn_status status = TN_OK;
    size_t door = 0;
    for (uint32_t i = 0; status == TN_OK && i < p->house->face_count; i++) {
        const tn_face *face = &p->house->faces[i];
        const char *tag = face->storey == p->storey ? tn_designation_of(&p->names, face) : NULL;
        bool hung = door < p->doors.count && p->doors.items[door].of == i;
        if (tag && hung)
            status = tag_door(&p->doors.items[door], tag, p->style, &p->taken, marks, error);
        else if (tag)
            status = tag_window(p->house, face, tag, p->style, &p->taken, marks, error);
        door += hung;
    }
    return status;
}

/* ---- symbols */

static tn_status put_symbols(const tn_planned *p, tn_marks *marks, tn_error *error)
{
    const tn_house *house = p->house;
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (face->relation == TN_FACE_UNDER && face->kind == TN_FACE_STAIR) {
            uint32_t cell = face->storey == p->storey ? face->first : face->second;
            if (house->cells[cell].storey == p->storey)
                tn_marks_stair(house, cell, marks);
        }
    }
    status = tn_marks_flights(house, p->storey, p->style, marks, error);
    put_panes(house, p->storey, marks);
    for (size_t i = 0; i < p->doors.count; i++)
        put_door(marks, &p->doors.items[i]);
    for (uint32_t i = 0; i < house->cell_count; i++)
        if (house->cells[i].storey == p->storey && house->cells[i].open)
            put_void(tn_cell_clear(house, i), marks);
    return status == TN_OK && house->form->record->beam_count > 0 ? put_beams(house, p->storey, marks, error) : status;
}

/* ---- dimensions, outside of the house; u, v as drawn */

/* How far the first chain is from the walls, in the size of lettering: tags and marks of sections stand before it. */
#define FIRST_CHAIN 5.5
#define FIRST_CHAIN_COARSE 4.2
#define NEXT_CHAIN 2.8 /* what is written below a chain is apart from what is above the next */
#define SECTION 2.5    /* and its marks, which are 1.3 long: what is written on the first chain is beyond them */
#define SECTION_COARSE 0.3

/* The sides of a plan, as they are drawn: the front is below. */
static const struct tn_plan_side {
    tn_house_side of;
    bool upright, high;
} plan_sides[] = {{TN_HOUSE_FRONT, false, false},
                  {TN_HOUSE_BACK, false, true},
                  {TN_HOUSE_RIGHT, true, false},
                  {TN_HOUSE_LEFT, true, true}};

static void put_place(double *places, size_t *count, int64_t from, int64_t to)
{
    places[(*count)++] = -(double)from;
    places[(*count)++] = -(double)to;
}

/* Where the openings of a side begin and end; none: 0. */
static size_t find_openings(const tn_planned *p, const struct tn_plan_side *side, double *places)
{
    size_t count = 0;
    for (size_t i = 0; i < p->house->face_count; i++) {
        const tn_face *face = &p->house->faces[i];
        tn_box hole;
        uint32_t cell = face->storey == p->storey ? tn_face_sheltered(p->house, face) : TN_NO_CELL;
        if (cell != TN_NO_CELL && tn_face_side(face, cell) == side->of && tn_house_hole(p->house, face, &hole))
            put_place(places, &count, side->upright ? hole.y0 : hole.x0, side->upright ? hole.y1 : hole.x1);
    }
    return count;
}

/* The chains of a side: its openings between the ends of the storey, and, below and at the left, rooms and the whole.
 */
static void dimension_side(const tn_planned *p, const struct tn_plan_side *side, const double low[2],
                           const double high[2], double *places, tn_marks *marks)
{
    const tn_house *house = p->house;
    int across = side->upright ? 0 : 1;
    double lettering = p->style->lettering, out = side->high ? lettering : -lettering,
           at = (side->high ? high : low)[across] + (p->style->coarse ? FIRST_CHAIN_COARSE : FIRST_CHAIN) * out,
           half = (double)house->form->record->wall / 2;
    size_t count = p->style->coarse ? 0 : find_openings(p, side, places), rooms = 0;
    double ends[2] = {INFINITY, -INFINITY}, *planes = places + 2 * house->face_count + 2;
    for (uint32_t i = 0; i < house->cell_count; i++) {
        const tn_rectangle *r = &house->cells[i].at;
        if (house->cells[i].storey == p->storey)
            put_place(planes, &rooms, side->upright ? r->y0 : r->x0, side->upright ? r->y1 : r->x1);
    }
    for (size_t i = 0; i < rooms; i++) {
        ends[0] = fmin(ends[0], planes[i] - half);
        ends[1] = fmax(ends[1], planes[i] + half);
    }
    if (count) {
        places[count++] = ends[0];
        places[count++] = ends[1];
        tn_marks_chain(marks, places, count, at, side->upright, p->style);
        at += NEXT_CHAIN * out;
    }
    if (side->high || rooms == 0)
        return;
    tn_marks_chain(marks, planes, rooms, at, side->upright, p->style);
    tn_marks_chain(marks, ends, 2, at + NEXT_CHAIN * out, side->upright, p->style);
}

/* Lines where sections are cut, outside of the house: arrows look where the section does, each with its letter. */
static void put_sections(const tn_planned *p, const double low[2], const double high[2], tn_marks *marks)
{
    double l = p->style->lettering;
    for (size_t i = 0; i < p->style->section_count; i++) {
        const tn_section_place *section = &p->style->sections[i];
        int across = section->across_x ? 0 : 1, along = 1 - across;
        const char letter[2] = {section->letter, '\0'};
        for (int end = 0; end < 2; end++) {
            double from[2], to[2], tip[2], text[2], out = end ? l : -l;
            from[across] = to[across] = -(double)section->at;
            from[along] = (end ? high : low)[along] + (p->style->coarse ? SECTION_COARSE : SECTION) * out;
            to[along] = from[along] + 1.3 * out;
            tip[across] = to[across] + 1.2 * l; /* sections look towards larger u, or v */
            tip[along] = to[along];
            text[across] = to[across] - 0.8 * l;
            text[along] = to[along];
            tn_marks_line(marks, TN_MARK_SECTION, from[0], from[1], to[0], to[1]);
            tn_marks_line(marks, TN_MARK_SECTION, to[0], to[1], tip[0], tip[1]);
            for (int side = -1; side <= 1; side += 2) {
                double barb[2];
                barb[across] = tip[across] - 0.5 * l;
                barb[along] = tip[along] + side * 0.25 * l;
                tn_marks_line(marks, TN_MARK_SECTION, barb[0], barb[1], tip[0], tip[1]);
            }
            tn_marks_text(marks, TN_MARK_SECTION, text[0], text[1], l, false, letter);
        }
    }
}

static bool put_dimensions(const tn_planned *p, tn_marks *marks)
{
    const tn_house *house = p->house;
    double *places = malloc((2 * house->face_count + 2 * house->cell_count + 4) * sizeof *places);
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    if (!places)
        return false;
    for (uint32_t i = 0; i < house->cell_count; i++) {
        tn_rectangle r = tn_turned(tn_cell_grown(house, &house->cells[i]));
        low[0] = fmin(low[0], (double)r.x0);
        low[1] = fmin(low[1], (double)r.y0);
        high[0] = fmax(high[0], (double)r.x1);
        high[1] = fmax(high[1], (double)r.y1);
    }
    for (size_t i = 0; i < sizeof plan_sides / sizeof *plan_sides; i++)
        dimension_side(p, &plan_sides[i], low, high, places, marks);
    put_sections(p, low, high, marks);
    if (p->style->north)
        tn_marks_north(marks, high, p->style);
    free(places);
    return true;
}

static void turn_taken(tn_taken *taken)
{
    tn_rectangles *all[] = {&taken->items, &taken->stairs, &taken->swings};
    for (int k = 0; k < 3; k++)
        for (size_t i = 0; i < all[k]->count; i++)
            all[k]->items[i] = tn_turned(all[k]->items[i]);
}

tn_status tn_marks_plan(const tn_house *house, uint32_t storey, const tn_mark_style *style, tn_marks *marks,
                        tn_error *error)
{
    tn_planned p = {.house = house, .storey = storey, .style = style};
    tn_status status = tn_designations_find(house, style->us, &p.names, error);
    if (status == TN_OK)
        status = tn_taken_find(house, storey, &p.taken, error);
    if (status == TN_OK)
        status = tn_swings_find(house, storey, &p.taken, &p.doors, error);
    if (status == TN_OK)
        status = put_symbols(&p, marks, error);
    if (status == TN_OK && !style->coarse)
        status = put_tags(&p, marks, error);
    tn_marks_turn(marks);
    turn_taken(&p.taken);
    if (status == TN_OK && !style->bare)
        status = tn_marks_items(house, storey, &p.taken, marks, error);
    if (status == TN_OK && (!put_dimensions(&p, marks) || marks->failed))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_marks_names(house, storey, style, &p.names, &p.taken, marks, error);
    tn_swings_clear(&p.doors);
    tn_taken_clear(&p.taken);
    tn_designations_clear(&p.names);
    return status;
}
