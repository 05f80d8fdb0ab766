/* Where flights of stairs stand between cells that people go about in.
 *
 * A stack is the cells, one over another, that flights join. Its flights are placed from the lowest on: the first
 * places, in their order, with which every cell of the stack fits. What the flights above can do depends only on where
 * the one below them stands, so that a place from which they cannot go on is tried once.
 *
 * Of a flight by itself, u is how far one has climbed in plan, from the line of the foot, and v is to the right of
 * that. */
#include <stdlib.h>
#include <string.h>

#include "runtime/house/ways.h"

/* ---- the steps of a flight */

/* Treads that fill a rectangle, by their numbers from 1 on. More than one are wedges. */
typedef struct tn_step_box {
    tn_rectangle at; /* x: u; y: v */
    int64_t first, last;
    tn_winding winding; /* of wedges */
} tn_step_box;

/* deep: along u; wide: along v. going: along its middle, with half of the place before it and of that behind it. foot,
 * head: where one stands before the flight and behind it. */
typedef struct tn_flight_shape {
    int64_t risers, deep, wide, going;
    tn_step_box *boxes;
    size_t count;
    tn_rectangle foot, head;
    int64_t path[TN_FLIGHT_PATH_MAX][2];
    size_t path_count;
} tn_flight_shape;

static int64_t risers_of(const tn_opening_record *flight, int64_t height)
{
    int64_t risers = (height + flight->rise_most - 1) / flight->rise_most;
    return risers >= 4 && risers <= TN_FLIGHT_STEPS_MAX && flight->rise_least * risers <= height ? risers : 0;
}

/* With the next treads, so many. */
static void add_treads(tn_flight_shape *s, tn_rectangle at, int64_t count, tn_winding winding)
{
    int64_t before = s->count > 0 ? s->boxes[s->count - 1].last : 0;
    s->boxes[s->count++] = (tn_step_box){at, before + 1, before + count, winding};
}

static void add_box(tn_flight_shape *s, int64_t u0, int64_t u1, int64_t v0, int64_t v1)
{
    add_treads(s, (tn_rectangle){u0, u1, v0, v1}, 1, TN_WINDS_RIGHT);
}

static void add_path(tn_flight_shape *s, int64_t u, int64_t v)
{
    s->path[s->path_count][0] = u;
    s->path[s->path_count++][1] = v;
}

static void shape_straight(tn_flight_shape *s, int64_t w, int64_t g)
{
    for (int64_t i = 0; i + 1 < s->risers; i++)
        add_box(s, i * g, (i + 1) * g, 0, w);
    s->deep = (s->risers - 1) * g;
    s->wide = w;
    s->going = s->deep + w;
    s->head = (tn_rectangle){s->deep, s->deep + w, 0, w};
    add_path(s, s->deep, w / 2);
}

/* Half of the treads up, a landing as wide as both arms or wedges in the two corners, the others back. */
static void shape_half(tn_flight_shape *s, const tn_opening_record *flight)
{
    int64_t w = flight->wide, g = flight->going, treads = s->risers - 1 - tn_flight_corners(flight),
            up = (treads + 1) / 2, back = treads - up, end = up * g;
    for (int64_t i = 0; i < up; i++)
        add_box(s, i * g, (i + 1) * g, 0, w);
    if (flight->winders) {
        add_treads(s, (tn_rectangle){end, end + w, 0, w}, flight->winders, TN_WINDS_RIGHT);
        add_treads(s, (tn_rectangle){end, end + w, w, 2 * w}, flight->winders, TN_WINDS_BACK);
    } else {
        add_box(s, end, end + w, 0, 2 * w);
    }
    for (int64_t i = 1; i <= back; i++)
        add_box(s, end - i * g, end - (i - 1) * g, w, 2 * w);
    s->deep = end + w;
    s->wide = 2 * w;
    s->going = treads * g + 3 * w;
    s->head = (tn_rectangle){end - back * g - w, end - back * g, w, 2 * w};
    add_path(s, end + w / 2, w / 2);
    add_path(s, end + w / 2, w + w / 2);
    add_path(s, end - back * g, w + w / 2);
}

/* As many treads up as fit, a landing or wedges in the corner, the others to the right. */
static void shape_quarter(tn_flight_shape *s, const tn_opening_record *flight, int64_t room)
{
    int64_t w = flight->wide, g = flight->going, corner = tn_flight_corners(flight), treads = s->risers - 1 - corner,
            fit = room > w ? (room - w) / g : 0, up = fit < treads ? fit : treads, on = treads - up, end = up * g;
    for (int64_t i = 0; i < up; i++)
        add_box(s, i * g, (i + 1) * g, 0, w);
    add_treads(s, (tn_rectangle){end, end + w, 0, w}, corner, TN_WINDS_RIGHT);
    for (int64_t i = 0; i < on; i++)
        add_box(s, end, end + w, w + i * g, w + (i + 1) * g);
    s->deep = end + w;
    s->wide = w + on * g;
    s->going = treads * g + 2 * w;
    s->head = (tn_rectangle){end, end + w, s->wide, s->wide + w};
    add_path(s, end + w / 2, w / 2);
    add_path(s, end + w / 2, s->wide);
}

/* One begins at the left half of a side, goes round the middle, and leaves at the right half. The path has its corners
 * where the middle of the steps is beside or before that of the flight. */
static void shape_spiral(tn_flight_shape *s, int64_t w)
{
    int64_t landing = w / 2, near = w / 4, far = w - near;
    add_treads(s, (tn_rectangle){0, w, 0, w}, s->risers - 1, TN_WINDS_ROUND);
    s->deep = s->wide = w;
    s->going = 3 * w;
    s->foot = (tn_rectangle){-landing, 0, 0, landing};
    s->head = (tn_rectangle){-landing, 0, w - landing, w};
    s->path_count = 0;
    add_path(s, 0, near);
    add_path(s, far, near);
    add_path(s, far, far);
    add_path(s, 0, far);
}

/* In a storey so high, with so much room from the line of the foot on. boxes: room for TN_FLIGHT_STEPS_MAX of them.
 * False: the storey is no whole number of steps. */
static bool find_shape(const tn_opening_record *flight, int64_t height, int64_t room, tn_step_box *boxes,
                       tn_flight_shape *s)
{
    int64_t w = flight->wide, g = flight->going;
    *s = (tn_flight_shape){.risers = risers_of(flight, height), .boxes = boxes, .foot = {-w, 0, 0, w}};
    if (s->risers == 0 || (flight->winders && s->risers <= tn_flight_corners(flight)))
        return false;
    add_path(s, 0, w / 2);
    switch ((tn_turn)flight->turn) {
    case TN_TURN_HALF:
        shape_half(s, flight);
        break;
    case TN_TURN_QUARTER:
        shape_quarter(s, flight, room);
        break;
    case TN_TURN_SPIRAL:
        shape_spiral(s, w);
        break;
    default:
        shape_straight(s, w, g);
    }
    return true;
}

/* ---- the stack */

enum { PLACES = 48 }; /* four sides, three distances, two hands, two flushes */

/* A cell with the flights that are placed: what is added to its floor. */
typedef struct tn_stair_floor {
    tn_rectangles obstacles, in_air, landings;
    tn_passage *passages; /* as many as the cell has */
} tn_stair_floor;

typedef struct tn_stack {
    const tn_house *house;
    uint32_t lowest;
    size_t flights;
    const tn_face **faces;       /* [flights] */
    tn_cell_floor *floors;       /* [flights + 1] of its cells */
    tn_flight_place *places;     /* [flights] */
    tn_flight_place *reached;    /* [flights] those below the furthest flight, when that was first tried */
    bool *dead;                  /* [flights][PLACES] from there the flights above cannot go on */
    tn_step_box *boxes;          /* [TN_FLIGHT_STEPS_MAX] scratch */
    tn_stair_floor lower, upper; /* scratch */
    size_t furthest;             /* the flight that was not placed */
} tn_stack;

static const tn_face *flight_in(const tn_house *house, uint32_t cell, bool below)
{
    for (size_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (face->relation == TN_FACE_UNDER && (below ? face->second : face->first) == cell &&
            tn_form_flight(house->form, face->kind))
            return face;
    }
    return NULL;
}

const tn_face *tn_flight_above(const tn_house *house, uint32_t cell)
{
    return flight_in(house, cell, false);
}

const tn_face *tn_flight_below(const tn_house *house, uint32_t cell)
{
    return flight_in(house, cell, true);
}

static void clear_stack(tn_stack *k)
{
    tn_stair_floor *const both[] = {&k->lower, &k->upper};
    for (size_t i = 0; i < 2; i++) {
        free(both[i]->obstacles.items);
        free(both[i]->in_air.items);
        free(both[i]->landings.items);
        free(both[i]->passages);
    }
    for (size_t i = 0; k->floors && i <= k->flights; i++)
        tn_cell_floor_clear(&k->floors[i]);
    free(k->faces);
    free(k->floors);
    free(k->places);
    free(k->reached);
    free(k->dead);
    free(k->boxes);
}

static tn_status begin_stack(const tn_house *house, uint32_t lowest, tn_stack *k, tn_error *error)
{
    tn_status status = TN_OK;
    size_t passages = 1;
    *k = (tn_stack){.house = house, .lowest = lowest};
    while (tn_flight_above(house, lowest + (uint32_t)k->flights))
        k->flights++;
    k->faces = calloc(k->flights + 1, sizeof *k->faces);
    k->floors = calloc(k->flights + 1, sizeof *k->floors);
    k->places = calloc(k->flights + 1, sizeof *k->places);
    k->reached = calloc(k->flights + 1, sizeof *k->reached);
    k->dead = calloc((k->flights + 1) * PLACES, sizeof *k->dead);
    k->boxes = malloc(TN_FLIGHT_STEPS_MAX * sizeof *k->boxes);
    if (!k->faces || !k->floors || !k->places || !k->reached || !k->dead || !k->boxes)
        return tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i <= k->flights; i++) {
        k->faces[i] = tn_flight_above(house, lowest + (uint32_t)i);
        status = tn_cell_floor_find(house, lowest + (uint32_t)i, &k->floors[i], error);
        passages = k->floors[i].passage_count > passages ? k->floors[i].passage_count : passages;
    }
    k->lower.passages = malloc(passages * sizeof *k->lower.passages);
    k->upper.passages = malloc(passages * sizeof *k->upper.passages);
    return status == TN_OK && !(k->lower.passages && k->upper.passages) ? tn_fail_memory(error) : status;
}

/* ---- places in plan */

static int64_t height_of(const tn_stack *k, size_t flight)
{
    uint32_t storey = k->faces[flight]->storey;
    return k->house->form->level[storey + 1] - k->house->form->level[storey];
}

static const tn_opening_record *record_of(const tn_stack *k, size_t flight)
{
    return tn_form_flight(k->house->form, k->faces[flight]->kind);
}

/* What both cells of a flight have clear. */
static tn_rectangle common_of(const tn_stack *k, size_t flight)
{
    const tn_rectangle *a = &k->floors[flight].clear, *b = &k->floors[flight + 1].clear;
    return (tn_rectangle){a->x0 > b->x0 ? a->x0 : b->x0, a->x1 < b->x1 ? a->x1 : b->x1, a->y0 > b->y0 ? a->y0 : b->y0,
                          a->y1 < b->y1 ? a->y1 : b->y1};
}

static bool runs_in_x(tn_house_side side)
{
    return side == TN_HOUSE_BACK || side == TN_HOUSE_FRONT;
}

/* A rectangle of the shape's as it lies in the clear one. */
static tn_rectangle put(const tn_flight_shape *s, const tn_flight_place *p, const tn_rectangle *in, tn_rectangle r)
{
    int64_t across = runs_in_x(p->side) ? in->x1 - in->x0 : in->y1 - in->y0, off = p->right ? across - s->wide : 0;
    int64_t u0 = r.x0 + p->at, u1 = r.x1 + p->at, v0 = (p->mirrored ? s->wide - r.y1 : r.y0) + off,
            v1 = (p->mirrored ? s->wide - r.y0 : r.y1) + off;
    switch (p->side) {
    case TN_HOUSE_BACK:
        return (tn_rectangle){in->x0 + v0, in->x0 + v1, in->y0 + u0, in->y0 + u1};
    case TN_HOUSE_FRONT:
        return (tn_rectangle){in->x1 - v1, in->x1 - v0, in->y1 - u1, in->y1 - u0};
    case TN_HOUSE_LEFT:
        return (tn_rectangle){in->x0 + u0, in->x0 + u1, in->y1 - v1, in->y1 - v0};
    default:
        return (tn_rectangle){in->x1 - u1, in->x1 - u0, in->y0 + v0, in->y0 + v1};
    }
}

/* Sets the place of a number below PLACES, and the shape there; false: there is none. */
static bool place_at(tn_stack *k, size_t flight, size_t number, tn_flight_place *p, tn_flight_shape *s)
{
    static const tn_house_side sides[] = {TN_HOUSE_BACK, TN_HOUSE_FRONT, TN_HOUSE_LEFT, TN_HOUSE_RIGHT};
    enum { WITH_LANDING, ON_THE_LINE, FAR };
    const tn_opening_record *record = record_of(k, flight);
    tn_rectangle in = common_of(k, flight);
    size_t from = number / 4 % 3;
    *p = (tn_flight_place){.side = sides[number / 12], .mirrored = number / 2 % 2, .right = number % 2};
    int64_t room = runs_in_x(p->side) ? in.y1 - in.y0 : in.x1 - in.x0;
    int64_t landing = record->turn == TN_TURN_SPIRAL ? record->wide / 2 : record->wide;
    p->at = from == WITH_LANDING ? landing : 0;
    if (!find_shape(record, height_of(k, flight), room - p->at, k->boxes, s))
        return false;
    if (from == FAR) {
        p->at = room - s->deep;
        if (record->turn == TN_TURN_QUARTER || p->at <= landing)
            return false;
    }
    for (size_t i = 0; i < s->count; i++) {
        tn_rectangle r = put(s, p, &in, s->boxes[i].at);
        if (!tn_rectangle_within(&r, &in))
            return false;
    }
    return true;
}

/* ---- what a flight is to its two cells */

typedef enum tn_step_part { ALL_STEPS, STEPS_IN_WAY, STEPS_IN_HOLE, STEPS_BELOW_DROP } tn_step_part;

#define DROP_NM INT64_C(600000000) /* from so high nobody falls without a guard */

/* Is there no headroom below the treads, for who walks under them; or on them, under the deck above; and does one fall
 * far from the floor above onto them? */
static bool has_part(const tn_stack *k, size_t flight, const tn_flight_shape *s, const tn_step_box *box,
                     tn_step_part part)
{
    int64_t height = height_of(k, flight), deck = k->house->form->record->deck,
            headroom = k->house->form->record->headroom;
    if (part == STEPS_IN_WAY)
        return box->first <= 2 || (box->first - 2) * height < headroom * s->risers;
    bool hole = (height - deck - headroom) *
                s->risers<box->last * height, drop = (s->risers - box->first) * height> DROP_NM * s->risers;
    return part == ALL_STEPS || (hole && (part == STEPS_IN_HOLE || drop));
}

/* Adds a rectangle to the last one if both together are one. */
static bool joins(tn_rectangle *last, const tn_rectangle *next)
{
    bool along_x = last->y0 == next->y0 && last->y1 == next->y1 && (last->x1 == next->x0 || last->x0 == next->x1),
         along_y = last->x0 == next->x0 && last->x1 == next->x1 && (last->y1 == next->y0 || last->y0 == next->y1);
    if (!along_x && !along_y)
        return false;
    *last = (tn_rectangle){last->x0 < next->x0 ? last->x0 : next->x0, last->x1 > next->x1 ? last->x1 : next->x1,
                           last->y0 < next->y0 ? last->y0 : next->y0, last->y1 > next->y1 ? last->y1 : next->y1};
    return true;
}

static tn_status add_steps(const tn_stack *k, size_t flight, const tn_flight_shape *s, const tn_flight_place *p,
                           tn_step_part part, tn_rectangles *to, tn_error *error)
{
    tn_rectangle in = common_of(k, flight);
    size_t before = to->count;
    for (size_t i = 0; i < s->count; i++) {
        if (!has_part(k, flight, s, &s->boxes[i], part))
            continue;
        tn_rectangle r = put(s, p, &in, s->boxes[i].at);
        if (to->count > before && joins(&to->items[to->count - 1], &r))
            continue;
        tn_status status = tn_rectangles_add(to, r, error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static bool is_free(const tn_rectangle *r, const tn_rectangles *obstacles)
{
    for (size_t i = 0; i < obstacles->count; i++)
        if (tn_rectangles_meet(r, &obstacles->items[i]))
            return false;
    return true;
}

bool tn_landing_reaches_over(const tn_cell_floor *floor, const tn_open_side *side, const tn_rectangle *landing)
{
    const tn_rectangle *a = &floor->clear, *b = &side->floor;
    bool in_x = runs_in_x(floor->passages[side->passage].side);
    tn_rectangle both = {
        (in_x ? a->x0 > b->x0 : a->x0 < b->x0) ? a->x0 : b->x0, (in_x ? a->x1 < b->x1 : a->x1 > b->x1) ? a->x1 : b->x1,
        (in_x ? a->y0 < b->y0 : a->y0 > b->y0) ? a->y0 : b->y0, (in_x ? a->y1 > b->y1 : a->y1 < b->y1) ? a->y1 : b->y1};
    return tn_rectangle_within(landing, &both);
}

/* Puts the landing into the cell, or over one of its open sides, which the flight meets then. *stands: it could be. */
static tn_status add_landing(const tn_cell_floor *floor, tn_rectangle landing, tn_stair_floor *to, bool *stands,
                             tn_error *error)
{
    *stands = is_free(&landing, &to->obstacles);
    if (*stands && tn_rectangle_within(&landing, &floor->clear))
        return tn_rectangles_add(&to->landings, landing, error);
    for (size_t i = 0; *stands && i < floor->open_count; i++)
        if (tn_landing_reaches_over(floor, &floor->open_sides[i], &landing)) {
            to->passages[floor->open_sides[i].passage].kind = TN_PASSAGE_MET;
            return TN_OK;
        }
    *stands = false;
    return TN_OK;
}

static tn_status begin_floor(const tn_cell_floor *floor, tn_stair_floor *to, tn_error *error)
{
    tn_status status = TN_OK;
    to->obstacles.count = to->in_air.count = to->landings.count = 0;
    if (floor->passage_count > 0)
        memcpy(to->passages, floor->passages, floor->passage_count * sizeof *to->passages);
    for (size_t i = 0; status == TN_OK && i < floor->obstacles.count; i++)
        status = tn_rectangles_add(&to->obstacles, floor->obstacles.items[i], error);
    return status;
}

static tn_status add_hole(const tn_stack *k, size_t flight, const tn_flight_shape *s, const tn_flight_place *p,
                          tn_stair_floor *to, bool *stands, tn_error *error)
{
    tn_rectangle in = common_of(k, flight);
    tn_status status = add_steps(k, flight, s, p, STEPS_IN_HOLE, &to->obstacles, error);
    if (status == TN_OK)
        status = add_steps(k, flight, s, p, STEPS_IN_HOLE, &to->in_air, error);
    return status == TN_OK ? add_landing(&k->floors[flight + 1], put(s, p, &in, s->head), to, stands, error) : status;
}

/* The flight below the cell, which is placed. */
static tn_status add_below(tn_stack *k, size_t flight, tn_stair_floor *to, bool *stands, tn_error *error)
{
    tn_flight_shape s;
    tn_flight_place *p = &k->places[flight];
    tn_rectangle in = common_of(k, flight);
    int64_t room = runs_in_x(p->side) ? in.y1 - in.y0 : in.x1 - in.x0;
    find_shape(record_of(k, flight), height_of(k, flight), room - p->at, k->boxes, &s);
    return add_hole(k, flight, &s, p, to, stands, error);
}

static tn_floor floor_with(const tn_cell_floor *floor, const tn_stair_floor *with)
{
    tn_floor asked = tn_cell_floor_of(floor);
    asked.obstacles = with->obstacles.items;
    asked.obstacle_count = with->obstacles.count;
    asked.in_air = with->in_air.items;
    asked.in_air_count = with->in_air.count;
    asked.landings = with->landings.items;
    asked.landing_count = with->landings.count;
    asked.passages = with->passages;
    return asked;
}

static tn_status judge(const tn_cell_floor *floor, const tn_stair_floor *with, bool *fits, tn_error *error)
{
    tn_floor asked = floor_with(floor, with);
    return tn_floor_fits(&asked, fits, error);
}

/* What of a place does not do: the first of these. */
typedef enum tn_stand_fault { NO_PLACE, NO_FOOT, NO_HEAD, LOWER_FLOOR, UPPER_FLOOR, PLACE_FITS } tn_stand_fault;

/* Do both cells of a flight fit with it at that place, and with the flight below them, which is placed? */
static tn_status try_place(tn_stack *k, size_t flight, size_t number, tn_stand_fault *fault, tn_error *error)
{
    tn_flight_shape s;
    tn_flight_place p;
    tn_stair_floor *lower = &k->lower, *upper = &k->upper;
    bool fits = place_at(k, flight, number, &p, &s);
    *fault = NO_PLACE;
    if (!fits)
        return TN_OK;
    *fault = NO_FOOT;
    tn_status status = begin_floor(&k->floors[flight], lower, error);
    if (status == TN_OK && flight > 0)
        status = add_below(k, flight - 1, lower, &fits, error);
    place_at(k, flight, number, &p, &s); /* the boxes are this flight's again */
    lower->in_air.count = 0;             /* leaves meet a hole as an obstacle, too */
    if (status == TN_OK)
        status = add_steps(k, flight, &s, &p, STEPS_IN_WAY, &lower->obstacles, error);
    if (status == TN_OK)
        status = add_steps(k, flight, &s, &p, ALL_STEPS, &lower->in_air, error);
    tn_rectangle in = common_of(k, flight);
    if (status == TN_OK && fits)
        status = add_landing(&k->floors[flight], put(&s, &p, &in, s.foot), lower, &fits, error);
    if (status == TN_OK && fits) {
        *fault = NO_HEAD;
        status = begin_floor(&k->floors[flight + 1], upper, error);
    }
    if (status == TN_OK && fits)
        status = add_hole(k, flight, &s, &p, upper, &fits, error);
    if (status == TN_OK && fits) {
        *fault = LOWER_FLOOR;
        status = judge(&k->floors[flight], lower, &fits, error);
    }
    if (status == TN_OK && fits) {
        *fault = UPPER_FLOOR;
        status = judge(&k->floors[flight + 1], upper, &fits, error);
    }
    if (status == TN_OK && fits)
        *fault = PLACE_FITS;
    k->places[flight] = p;
    return status;
}

/* Places the flights from this one on. Recursion is as deep as there are storeys. */
static tn_status place_from(tn_stack *k, size_t flight, bool *placed, tn_error *error)
{
    tn_status status = TN_OK;
    if (flight > k->furthest)
        memcpy(k->reached, k->places, flight * sizeof *k->reached);
    k->furthest = flight > k->furthest ? flight : k->furthest;
    *placed = flight == k->flights;
    for (size_t number = 0; status == TN_OK && !*placed && number < PLACES; number++) {
        bool *dead = &k->dead[flight * PLACES + number];
        tn_stand_fault fault = NO_PLACE;
        if (!*dead)
            status = try_place(k, flight, number, &fault, error);
        if (status == TN_OK && fault == PLACE_FITS)
            status = place_from(k, flight + 1, placed, error);
        *dead |= status == TN_OK && fault == PLACE_FITS && !*placed;
    }
    return status;
}

/* What is around the cells is not known: each flight stands in the first place with room between the planes of walls.
 * How large its steps and its hole are is the same in all its places, but for flights that turn a quarter. */
static bool place_by_size(tn_stack *k)
{
    tn_flight_shape s;
    bool placed = true;
    for (size_t i = 0; i <= k->flights; i++)
        k->floors[i].clear = k->house->cells[k->lowest + i].at;
    for (size_t flight = 0; placed && flight < k->flights; flight++) {
        placed = false;
        for (size_t number = 0; !placed && number < PLACES; number++)
            placed = place_at(k, flight, number, &k->places[flight], &s);
    }
    return placed;
}

static tn_status place_all(const tn_house *house, uint32_t lowest, tn_stack *k, bool *placed, tn_error *error)
{
    tn_status status = begin_stack(house, lowest, k, error);
    *placed = status == TN_OK && house->ways_unknown && place_by_size(k);
    return status == TN_OK && !house->ways_unknown ? place_from(k, 0, placed, error) : status;
}

tn_status tn_stack_fits(const tn_house *house, uint32_t lowest, bool *fits, const tn_face **flight, tn_error *error)
{
    tn_stack k;
    tn_status status = place_all(house, lowest, &k, fits, error);
    *flight = status == TN_OK && !*fits ? k.faces[k.furthest] : NULL;
    clear_stack(&k);
    return status;
}

/* ---- a flight that stands nowhere */

/* How far a person comes with the flight in that place, at which one of its cells does not fit. */
static tn_status stop_on_floor(const tn_stack *k, size_t cell, const tn_stair_floor *with, tn_way_stop *stop,
                               tn_error *error)
{
    tn_floor asked = floor_with(&k->floors[cell], with);
    tn_floor_answer answer = {0};
    tn_status status = tn_floor_ask(&asked, &answer, error);
    if (status == TN_OK && !answer.fits)
        status = tn_floor_stop_find(&asked, &answer, &stop->at, error);
    tn_floor_answer_clear(&answer);
    return status;
}

static tn_status stop_at_place(tn_stack *k, size_t flight, size_t number, tn_stand_fault fault, tn_flight_stop *stop,
                               tn_error *error)
{
    bool above = fault == NO_HEAD || fault == UPPER_FLOOR;
    size_t cell = flight + above;
    tn_flight_place p;
    tn_flight_shape s;
    tn_rectangle in = common_of(k, flight);
    *stop = (tn_flight_stop){.kind = k->faces[flight]->kind,
                             .cell = k->lowest + (uint32_t)cell,
                             .head = above,
                             .landing = fault == NO_FOOT || fault == NO_HEAD,
                             .way = {.way = k->floors[cell].way}};
    tn_status status = TN_OK;
    if (!stop->landing)
        status = stop_on_floor(k, cell, above ? &k->upper : &k->lower, &stop->way, error);
    place_at(k, flight, number, &p, &s);
    if (stop->landing)
        stop->way.at.missed = put(&s, &p, &in, above ? s.head : s.foot);
    if (status == TN_OK)
        status = add_steps(k, flight, &s, &p, above ? STEPS_IN_HOLE : ALL_STEPS, &stop->way.items, error);
    return status;
}

/* No place has room for its steps: from the back, or from the left if less is missing there. */
static tn_status stop_of_size(tn_stack *k, size_t flight, tn_flight_stop *stop, tn_error *error)
{
    static const tn_house_side sides[] = {TN_HOUSE_BACK, TN_HOUSE_LEFT};
    tn_rectangle in = common_of(k, flight);
    *stop = (tn_flight_stop){.kind = k->faces[flight]->kind, .cell = k->lowest + (uint32_t)flight, .size = true};
    stop->way.way = k->floors[flight].way;
    for (size_t i = 0; i < 2; i++) {
        tn_flight_shape s;
        tn_flight_place p = {.side = sides[i]};
        int64_t deep = runs_in_x(p.side) ? in.y1 - in.y0 : in.x1 - in.x0;
        int64_t wide = runs_in_x(p.side) ? in.x1 - in.x0 : in.y1 - in.y0;
        if (!find_shape(record_of(k, flight), height_of(k, flight), deep, k->boxes, &s))
            return TN_OK; /* the storey is no whole number of steps */
        int64_t longer = s.deep - deep, wider = s.wide - wide, most = longer > wider ? longer : wider;
        if (i > 0 && most >= stop->way.at.short_by)
            continue;
        stop->way.at.short_by = most;
        stop->way.at.missed = put(&s, &p, &in, (tn_rectangle){0, s.deep, 0, s.wide});
        stop->way.items.count = 0;
        tn_status status =
            add_steps(k, flight, &s, &(tn_flight_place){.side = sides[i]}, ALL_STEPS, &stop->way.items, error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

/* Of places that get equally far, the one in which a person comes nearest; then the first. */
static bool is_nearer(const tn_flight_stop *stop, const tn_flight_stop *than)
{
    return stop->way.at.stands != than->way.at.stands ? stop->way.at.stands
                                                      : stop->way.at.short_by < than->way.at.short_by;
}

tn_status tn_stack_stop(const tn_house *house, uint32_t lowest, tn_flight_stop *stop, tn_error *error)
{
    tn_stack k;
    bool placed = false;
    tn_stand_fault best = NO_PLACE;
    *stop = (tn_flight_stop){0};
    tn_status status = place_all(house, lowest, &k, &placed, error);
    size_t flight = k.furthest;
    if (status == TN_OK && flight > 0)
        memcpy(k.places, k.reached, flight * sizeof *k.places);
    for (size_t number = 0; status == TN_OK && number < PLACES; number++) {
        tn_stand_fault fault;
        tn_flight_stop here = {0};
        status = try_place(&k, flight, number, &fault, error);
        if (status != TN_OK || fault == NO_PLACE || fault < best)
            continue;
        status = stop_at_place(&k, flight, number, fault, &here, error);
        if (status == TN_OK && (fault > best || is_nearer(&here, stop))) {
            tn_flight_stop worse = *stop;
            *stop = here;
            here = worse;
        }
        best = fault;
        tn_way_stop_clear(&here.way);
    }
    if (status == TN_OK && best == NO_PLACE)
        status = stop_of_size(&k, flight, stop, error);
    clear_stack(&k);
    return status;
}

/* ---- a flight that stands */

static tn_status take_steps(const tn_stack *k, size_t flight, const tn_flight_shape *s, tn_step_part part,
                            tn_rectangle **to, size_t *count, tn_error *error)
{
    tn_rectangles steps = {0};
    tn_status status = add_steps(k, flight, s, &k->places[flight], part, &steps, error);
    *to = steps.items;
    *count = steps.count;
    return status;
}

static void put_point(const tn_flight_shape *s, const tn_flight_place *p, const tn_rectangle *in, int64_t point[2])
{
    tn_rectangle r = put(s, p, in, (tn_rectangle){point[0], point[0], point[1], point[1]});
    point[0] = r.x0;
    point[1] = r.y0;
}

/* Its corners go round the other way, for whoever looks from above. */
static void turn_over(tn_wedge *wedge)
{
    for (size_t i = 1, k = wedge->count - 1; i < k; i++, k--)
        for (int axis = 0; axis < 2; axis++) {
            int64_t at = wedge->at[i][axis];
            wedge->at[i][axis] = wedge->at[k][axis];
            wedge->at[k][axis] = at;
        }
}

static bool goes_clockwise(const tn_wedge *w)
{
    tn_int128 twice = 0;
    for (size_t i = 0; i < w->count; i++) {
        const int64_t *a = w->at[i], *b = w->at[(i + 1) % w->count];
        twice += (tn_int128)a[0] * b[1] - (tn_int128)b[0] * a[1];
    }
    return twice < 0;
}

/* The treads of a rectangle: itself, or wedges. */
static void stand_box(const tn_flight_shape *s, const tn_flight_place *p, const tn_rectangle *in, int64_t height,
                      const tn_step_box *box, tn_flight *to)
{
    for (int64_t n = box->first; n <= box->last; n++) {
        int64_t low = n > 2 ? (n - 2) * height / s->risers : 0, high = n * height / s->risers;
        if (box->first == box->last) {
            tn_rectangle r = put(s, p, in, box->at);
            to->treads[to->tread_count++] = (tn_box){r.x0, r.x1, r.y0, r.y1, low, high};
            return;
        }
        tn_wedge *wedge = &to->wedges[to->wedge_count++];
        tn_wedge_plan(box->winding, &box->at, box->last - box->first + 1, n - box->first, wedge);
        for (size_t i = 0; i < wedge->count; i++)
            put_point(s, p, in, wedge->at[i]);
        if (goes_clockwise(wedge))
            turn_over(wedge);
        wedge->levels[0] = low;
        wedge->levels[1] = (n - 1) * height / s->risers;
        wedge->levels[2] = high;
    }
}

static tn_status stand(tn_stack *k, size_t flight, tn_flight *to, tn_error *error)
{
    tn_flight_shape s;
    const tn_flight_place *p = &k->places[flight];
    tn_rectangle in = common_of(k, flight);
    int64_t height = height_of(k, flight), room = runs_in_x(p->side) ? in.y1 - in.y0 : in.x1 - in.x0;
    find_shape(record_of(k, flight), height, room - p->at, k->boxes, &s);
    to->treads = malloc((size_t)s.risers * sizeof *to->treads);
    to->wedges = malloc((size_t)s.risers * sizeof *to->wedges);
    if (!to->treads || !to->wedges)
        return tn_fail_memory(error);
    for (size_t i = 0; i < s.count; i++)
        stand_box(&s, p, &in, height, &s.boxes[i], to);
    for (size_t i = 0; i < s.path_count; i++) {
        memcpy(to->path[i], s.path[i], sizeof s.path[i]);
        put_point(&s, p, &in, to->path[i]);
    }
    to->path_count = s.path_count;
    to->foot = put(&s, p, &in, s.foot);
    to->head = put(&s, p, &in, s.head);
    to->last = put(&s, p, &in, s.boxes[s.count - 1].at);
    to->length = s.going;
    tn_status status = take_steps(k, flight, &s, STEPS_IN_WAY, &to->low, &to->low_count, error);
    if (status == TN_OK)
        status = take_steps(k, flight, &s, STEPS_IN_HOLE, &to->holes, &to->hole_count, error);
    return status == TN_OK ? take_steps(k, flight, &s, STEPS_BELOW_DROP, &to->drops, &to->drop_count, error) : status;
}

tn_status tn_stack_flight(const tn_house *house, const tn_face *face, tn_flight *flight, tn_error *error)
{
    tn_stack k;
    uint32_t lowest = face->first;
    bool placed = false;
    *flight = (tn_flight){.face = (uint32_t)(face - house->faces)};
    for (const tn_face *below = tn_flight_below(house, lowest); below; below = tn_flight_below(house, lowest))
        lowest = below->first;
    tn_status status = place_all(house, lowest, &k, &placed, error);
    if (status == TN_OK && placed)
        status = stand(&k, face->first - lowest, flight, error);
    clear_stack(&k);
    return status;
}
