/* What a person meets in a cell of a house, and why it does not fit. */
#include "runtime/house/ways.h"

#include <stdio.h>
#include <stdlib.h>

#define DOUBLE_LEAF_NM INT64_C(1219200000) /* 4': wider doors have two leaves */

int64_t tn_cell_way(const tn_house *house, uint32_t cell)
{
    const tn_cell *c = &house->cells[cell];
    int64_t own = c->open || c->function == TN_NO_FUNCTION ? 0 : tn_form_rule(house->form, c->function)->way;
    return own > 0 ? own : house->form->record->way;
}

/* ---- what is beyond a face */

tn_face_view tn_face_seen(const tn_house *house, uint32_t index, uint32_t cell)
{
    const tn_face *face = &house->faces[index];
    if (house->views)
        return house->views[index];
    uint32_t other = face->first == cell ? face->second : face->first;
    tn_face_view view = {.beyond = TN_BEYOND_OUTSIDE, .leaf = tn_face_leaf(house, face) == cell};
    if (other == TN_NO_CELL)
        return view;
    const tn_cell *beyond = &house->cells[other];
    bool bare = !beyond->open && beyond->function != TN_NO_FUNCTION && tn_form_is_bare(house->form, beyond->function);
    view.beyond = beyond->open ? TN_BEYOND_VOID : bare ? TN_BEYOND_BARE : TN_BEYOND_FURNISHED;
    view.floor = beyond->at;
    return view;
}

/* ---- passages and leaves */

static bool runs_in_x(tn_house_side side)
{
    return side == TN_HOUSE_BACK || side == TN_HOUSE_FRONT;
}

/* Can a person go through what is in the face? Outside above the lowest storey nobody does. */
static bool is_passage(const tn_house *house, const tn_face *face, const tn_face_view *view, int64_t way)
{
    const tn_opening_record *opening = tn_form_opening(house->form, face->kind);
    int64_t x = face->at.x1 - face->at.x0, y = face->at.y1 - face->at.y0, length = x > y ? x : y;
    bool outside = view->beyond == TN_BEYOND_OUTSIDE;
    if (opening ? !(opening->flags & TN_PASSAGE) || opening->wide < way : face->kind != TN_FACE_OPEN || outside)
        return false;
    return length >= way + house->form->record->wall && view->beyond != TN_BEYOND_VOID &&
           !(outside && face->storey > 0);
}

/* The clear rectangle's strip along a side, from one place to another, so deep. */
static tn_rectangle along_side(const tn_rectangle *clear, tn_house_side side, int64_t from, int64_t to, int64_t deep)
{
    switch (side) {
    case TN_HOUSE_BACK:
        return (tn_rectangle){from, to, clear->y0, clear->y0 + deep};
    case TN_HOUSE_FRONT:
        return (tn_rectangle){from, to, clear->y1 - deep, clear->y1};
    case TN_HOUSE_LEFT:
        return (tn_rectangle){clear->x0, clear->x0 + deep, from, to};
    default:
        return (tn_rectangle){clear->x1 - deep, clear->x1, from, to};
    }
}

/* A bare cell's floor begins half a wall from its other sides, and at the face, or at the clear rectangle if that ends
 * before the face. */
static tn_rectangle floor_beyond(const tn_house *house, const tn_face *face, tn_house_side side,
                                 const tn_rectangle *beyond, const tn_rectangle *clear)
{
    tn_rectangle floor = tn_rectangle_grown(beyond, -house->form->record->wall / 2);
    switch (side) {
    case TN_HOUSE_BACK:
        floor.y1 = face->at.y0 > clear->y0 ? face->at.y0 : clear->y0;
        break;
    case TN_HOUSE_FRONT:
        floor.y0 = face->at.y0 < clear->y1 ? face->at.y0 : clear->y1;
        break;
    case TN_HOUSE_LEFT:
        floor.x1 = face->at.x0 > clear->x0 ? face->at.x0 : clear->x0;
        break;
    default:
        floor.x0 = face->at.x0 < clear->x1 ? face->at.x0 : clear->x1;
    }
    return floor;
}

static void add_leaf(tn_cell_floor *floor, uint32_t index, tn_house_side side, int64_t from, int64_t wide)
{
    int64_t deep = wide <= DOUBLE_LEAF_NM ? wide : wide / 2;
    floor->leaf_faces[floor->leaf_count] = index;
    floor->leaves[floor->leaf_count++] = along_side(&floor->clear, side, from, from + wide, deep);
}

static void add_passage(const tn_house *house, uint32_t index, tn_house_side side, const tn_face_view *view,
                        tn_cell_floor *floor)
{
    const tn_face *face = &house->faces[index];
    const tn_opening_record *opening = tn_form_opening(house->form, face->kind);
    bool in_x = runs_in_x(side), free = !opening && view->beyond == TN_BEYOND_BARE;
    int64_t from = in_x ? face->at.x0 : face->at.y0, to = in_x ? face->at.x1 : face->at.y1;
    int64_t half = house->form->record->wall / 2, begins = opening ? tn_opening_begins(face, opening) : from,
            ends = opening ? begins + opening->wide : to, middle = tn_opening_from(begins + ends, floor->way);
    tn_passage passage = {side, opening ? TN_PASSAGE_DOOR : TN_PASSAGE_OPEN, middle, middle + floor->way};
    if (free) {
        passage.from = from + half;
        passage.to = to - half;
        floor->open_sides[floor->open_count++] =
            (tn_open_side){floor->passage_count, floor_beyond(house, face, side, &view->floor, &floor->clear)};
    }
    floor->passage_faces[floor->passage_count] = index;
    floor->passages[floor->passage_count++] = passage;
    if (view->leaf)
        add_leaf(floor, index, side, begins, opening->wide);
}

/* ---- obstacles */

/* What stands in the clear rectangle; walls around it do not. */
static tn_status add_obstacle(tn_cell_floor *floor, tn_rectangle r, tn_error *error)
{
    return tn_rectangles_meet(&r, &floor->clear) ? tn_rectangles_add(&floor->obstacles, r, error) : TN_OK;
}

static tn_status add_posts(const tn_house *house, uint32_t cell, tn_cell_floor *floor, tn_error *error)
{
    const tn_cell *c = &house->cells[cell];
    tn_posts posts;
    tn_status status = tn_house_posts(house, c->storey, &c->at, &posts, error);
    for (size_t i = 0; status == TN_OK && i < posts.count; i++)
        if (posts.items[i].thick_x && posts.items[i].thick_y)
            status = add_obstacle(floor, tn_post_at(&posts.items[i]), error);
    free(posts.items);
    return status;
}

/* Where nobody can stand upright under one height of a roof, in a clear rectangle: strips across its slope. */
typedef struct tn_low_strips {
    tn_rectangle items[2];
    size_t count;
} tn_low_strips;

/* What of a roof is lower than the headroom is looked for along one axis, in the middle of the other. */
typedef struct tn_lowness {
    tn_slopes slopes;
    bool in_x;
    int64_t height, headroom; /* of the foot of its slab */
} tn_lowness;

/* Is the underside of the roof lower than the headroom at a place across its ridge? */
static bool is_low(const tn_lowness *of, int64_t at)
{
    tn_fraction place = tn_fraction_whole(at);
    return tn_fraction_less(tn_slopes_at(&of->slopes, place, place, of->height), tn_fraction_whole(of->headroom));
}

/* The first place from `low` on, or (up) the last one before `high`, where that is not so; whole, rounded away from
 * where one can stand. A roof rises from its lower ends, so that one search finds it. */
static int64_t end_of_low(const tn_lowness *of, int64_t low, int64_t high, bool up)
{
    while (high - low > 1) {
        int64_t middle = low + (high - low) / 2;
        *(is_low(of, middle) == up ? &high : &low) = middle;
    }
    return up ? low : high;
}

/* The highest place of the roof between two places across its ridge: one of them, or the middle of the cell. */
static int64_t crest_of(const tn_lowness *of, int64_t from, int64_t to, int64_t middle)
{
    const int64_t places[3] = {from, middle < from ? from : middle > to ? to : middle, to};
    int64_t best = from;
    tn_fraction most = {0, 1};
    for (int i = 0; i < 3; i++) {
        tn_fraction at = tn_fraction_whole(places[i]), height = tn_slopes_at(&of->slopes, at, at, of->height);
        if (i > 0 && !tn_fraction_less(most, height))
            continue;
        most = height;
        best = places[i];
    }
    return best;
}

static tn_low_strips low_strips(const tn_lowness *of, const tn_rectangle *cell, const tn_rectangle *clear)
{
    bool in_x = of->in_x;
    int64_t from = in_x ? clear->x0 : clear->y0, to = in_x ? clear->x1 : clear->y1;
    int64_t crest = crest_of(of, from, to, in_x ? (cell->x0 + cell->x1) / 2 : (cell->y0 + cell->y1) / 2);
    tn_low_strips strips = {.items = {*clear, *clear}};
    if (is_low(of, crest)) {
        strips.count = 1;
        return strips;
    }
    if (is_low(of, from)) {
        tn_rectangle *strip = &strips.items[strips.count++];
        *(in_x ? &strip->x1 : &strip->y1) = end_of_low(of, from, crest, false);
    }
    if (is_low(of, to)) {
        tn_rectangle *strip = &strips.items[strips.count++];
        *(in_x ? &strip->x0 : &strip->y0) = end_of_low(of, crest, to, true);
    }
    return strips;
}

/* The strips under one of the two heights of which a roof is the greater. */
static tn_low_strips low_under(const tn_lowness *roof, size_t first, size_t count, const tn_rectangle *cell,
                               const tn_rectangle *clear)
{
    tn_lowness one = *roof;
    one.slopes.count = one.slopes.first = count;
    for (size_t i = 0; i < count; i++)
        one.slopes.items[i] = roof->slopes.items[first + i];
    one.in_x = one.slopes.items[0].x != 0;
    return low_strips(&one, cell, clear);
}

/* Under an open roof, where nobody can stand upright: strips at its lower ends, or where two gables cross, what strips
 * under both of them have in common. */
static tn_status add_roof(const tn_house *house, uint32_t index, tn_cell_floor *floor, tn_error *error)
{
    const tn_cell *cell = &house->cells[index];
    const tn_shape_record *shape = tn_house_shape(house, cell->zone, TN_CHOICE_ROOF);
    int64_t height = house->form->level[cell->storey + 1] - house->form->level[cell->storey],
            headroom = house->form->record->headroom;
    if (!shape || !(shape->flags & TN_ROOF_OPEN) || height >= headroom || !tn_cell_is_top(house, index))
        return TN_OK;
    tn_lowness roof = {.slopes = tn_roof_slopes(house, cell), .height = height, .headroom = headroom};
    size_t first = roof.slopes.first, others = roof.slopes.count - first;
    tn_low_strips low = low_under(&roof, 0, first, &cell->at, &floor->clear);
    tn_low_strips also = {.items = {floor->clear}, .count = 1};
    if (others > 0)
        also = low_under(&roof, first, others, &cell->at, &floor->clear);
    tn_status status = TN_OK;
    for (size_t i = 0; i < low.count; i++)
        for (size_t k = 0; status == TN_OK && k < also.count; k++) {
            tn_rectangle common = tn_rectangles_common(&low.items[i], &also.items[k]);
            if (common.x0 < common.x1 && common.y0 < common.y1)
                status = add_obstacle(floor, common, error);
        }
    return status;
}

/* ---- a cell */

static tn_status make_room(const tn_house *house, uint32_t cell, tn_cell_floor *floor, tn_error *error)
{
    size_t count = 1;
    for (size_t i = 0; i < house->face_count; i++)
        count += house->faces[i].first == cell || house->faces[i].second == cell;
    floor->passages = malloc(count * sizeof *floor->passages);
    floor->passage_faces = malloc(count * sizeof *floor->passage_faces);
    floor->leaves = malloc(count * sizeof *floor->leaves);
    floor->leaf_faces = malloc(count * sizeof *floor->leaf_faces);
    floor->open_sides = malloc(count * sizeof *floor->open_sides);
    return floor->passages && floor->passage_faces && floor->leaves && floor->leaf_faces && floor->open_sides
               ? TN_OK
               : tn_fail_memory(error);
}

tn_status tn_cell_floor_find(const tn_house *house, uint32_t cell, tn_cell_floor *floor, tn_error *error)
{
    *floor = (tn_cell_floor){.way = tn_cell_way(house, cell), .clear = tn_cell_clear(house, cell)};
    tn_status status = make_room(house, cell, floor, error);
    for (uint32_t i = 0; status == TN_OK && i < house->face_count; i++) {
        tn_house_side side = tn_face_side(&house->faces[i], cell);
        if (side == TN_HOUSE_ANY_SIDE)
            continue;
        tn_face_view view = tn_face_seen(house, i, cell);
        if (is_passage(house, &house->faces[i], &view, floor->way))
            add_passage(house, i, side, &view, floor);
    }
    if (status == TN_OK)
        status = add_posts(house, cell, floor, error);
    return status == TN_OK ? add_roof(house, cell, floor, error) : status;
}

void tn_cell_floor_clear(tn_cell_floor *floor)
{
    free(floor->passages);
    free(floor->passage_faces);
    free(floor->leaves);
    free(floor->leaf_faces);
    free(floor->open_sides);
    free(floor->obstacles.items);
    *floor = (tn_cell_floor){0};
}

tn_floor tn_cell_floor_of(const tn_cell_floor *floor)
{
    return (tn_floor){.way = floor->way,
                      .clear = floor->clear,
                      .obstacles = floor->obstacles.items,
                      .obstacle_count = floor->obstacles.count,
                      .leaves = floor->leaves,
                      .leaf_count = floor->leaf_count,
                      .passages = floor->passages,
                      .passage_count = floor->passage_count};
}

/* ---- what is wrong */

tn_way_fault tn_way_fault_of(const tn_house *house, uint32_t cell, const tn_cell_floor *floor,
                             const tn_floor_answer *answer)
{
    tn_way_fault fault = {.fault = answer->fault, .keep = answer->of};
    if (answer->fault == TN_FLOOR_FITS || answer->fault == TN_FLOOR_KEEP)
        return fault;
    uint32_t index = (answer->fault == TN_FLOOR_LEAF ? floor->leaf_faces : floor->passage_faces)[answer->of];
    fault.kind = house->faces[index].kind;
    fault.side = tn_face_side(&house->faces[index], cell);
    return fault;
}

tn_status tn_cell_ways(const tn_house *house, uint32_t cell, tn_way_fault *fault, tn_error *error)
{
    tn_cell_floor floor;
    tn_floor_answer answer = {0};
    *fault = (tn_way_fault){0};
    if (!tn_form_asks_ways(house->form) || house->ways_unknown || house->cells[cell].open ||
        tn_flight_below(house, cell))
        return TN_OK;
    if (tn_flight_above(house, cell)) {
        const tn_face *flight = NULL;
        bool fits = false;
        tn_status status = tn_stack_fits(house, cell, &fits, &flight, error);
        fault->flight = !fits;
        fault->kind = flight ? flight->kind : 0;
        return status;
    }
    tn_status status = tn_cell_floor_find(house, cell, &floor, error);
    const tn_floor asked = tn_cell_floor_of(&floor);
    if (status == TN_OK)
        status = tn_floor_ask(&asked, &answer, error);
    if (status == TN_OK)
        *fault = tn_way_fault_of(house, cell, &floor, &answer);
    tn_floor_answer_clear(&answer);
    tn_cell_floor_clear(&floor);
    return status;
}

void tn_way_stop_clear(tn_way_stop *stop)
{
    tn_floor_stop_clear(&stop->at);
    free(stop->items.items);
    *stop = (tn_way_stop){0};
}

tn_status tn_cell_stop(const tn_house *house, uint32_t cell, tn_way_stop *stop, tn_error *error)
{
    tn_cell_floor floor;
    tn_floor_answer answer = {0};
    *stop = (tn_way_stop){.way = tn_cell_way(house, cell)};
    tn_status status = tn_cell_floor_find(house, cell, &floor, error);
    const tn_floor asked = tn_cell_floor_of(&floor);
    if (status == TN_OK)
        status = tn_floor_ask(&asked, &answer, error);
    if (status == TN_OK && !answer.fits)
        status = tn_floor_stop_find(&asked, &answer, &stop->at, error);
    tn_floor_answer_clear(&answer);
    tn_cell_floor_clear(&floor);
    return status;
}

void tn_way_length_text(const tn_house *house, int64_t length, char text[64])
{
    tn_length_style style = tn_house_length_style(house);
    int64_t step = style == TN_STYLE_FEET ? INT64_C(3175000) : INT64_C(1000000);
    tn_length_write_style((length + step - 1) / step * step, style, text, 64);
}

void tn_way_stop_text(const tn_house *house, const tn_way_stop *stop, char *text, size_t size)
{
    char wide[64], far[64];
    tn_way_length_text(house, stop->way, wide);
    tn_way_length_text(house, stop->at.short_by, far);
    bool leaf = stop->at.square.x0 == stop->at.square.x1;
    if (leaf)
        text[0] = '\0';
    else if (stop->at.stands)
        snprintf(text, size, "a person, %s wide, comes within %s of it", wide, far);
    else
        snprintf(text, size, "a person is %s wide there", wide);
}

void tn_flight_stop_text(const tn_house *house, const tn_flight_stop *stop, const char *cell, char *text, size_t size)
{
    char far[64], person[200];
    tn_way_length_text(house, stop->way.at.short_by, far);
    tn_way_stop_text(house, &stop->way, person, sizeof person);
    if (stop->size && stop->way.items.count > 0)
        snprintf(text, size, "its steps are %s longer or wider than the room for them", far);
    else if (stop->size)
        text[0] = '\0';
    else if (stop->landing)
        snprintf(text, size, "in the nearest one, the landing at its %s has no room in %s",
                 stop->head ? "head" : "foot", cell);
    else if (*person)
        snprintf(text, size, "in the nearest one, something in %s is not reached: %s", cell, person);
    else
        snprintf(text, size, "in the nearest one, a leaf in %s has no room", cell);
}

static const char *const side_texts[] = {"", "at the back", "at the front", "at the left", "at the right"};

void tn_way_fault_text(const tn_house_form *form, const tn_way_fault *fault, char *text, size_t size)
{
    char at[TN_NAME_MAX + 40];
    if (fault->kind == TN_FACE_OPEN)
        snprintf(at, sizeof at, "open side %s", side_texts[fault->side]);
    else
        snprintf(at, sizeof at, "`%s` %s", tn_form_kind_text(form, fault->kind), side_texts[fault->side]);
    if (fault->flight)
        snprintf(text, size, "with these walls and doors there is no place for `%s`",
                 tn_form_kind_text(form, fault->kind));
    else if (fault->fault == TN_FLOOR_SHUT)
        snprintf(text, size, "nobody can come in by the %s", at);
    else if (fault->fault == TN_FLOOR_APART)
        snprintf(text, size, "no way leads through to the %s", at);
    else if (fault->fault == TN_FLOOR_LEAF)
        snprintf(text, size, "the leaf of the %s has no room", at);
    else
        snprintf(text, size, "no way leads to what is kept free");
}

tn_status tn_cell_fillings(const tn_house *house, uint32_t cell, size_t *count, tn_error *error)
{
    tn_variants tiles;
    tn_way_fault fault;
    tn_status status = tn_tile_variants(house, cell, &tiles, error);
    *count = tiles.count;
    if (status == TN_OK && !tiles.wanted) {
        status = tn_cell_ways(house, cell, &fault, error);
        *count = fault.fault == TN_FLOOR_FITS && !fault.flight;
    }
    tn_variants_clear(&tiles);
    return status;
}
