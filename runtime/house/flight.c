/* Flights of stairs: whether they fit between two cells, and where their treads are. */
#include <stdlib.h>

#include "runtime/house/ways.h"

/* ---- how many steps, and how large */

/* Lengths along the way up and across it. risers: 0 where it cannot be. `first`, `second`: treads before and after the
 * landing; straight flights have no landing, and only the first. */
typedef struct tn_steps {
    int64_t risers, first, second;
    int64_t deep, wide; /* what it takes with the places before and after it */
} tn_steps;

static int64_t storey_height(const tn_house *house, const tn_face *face)
{
    return house->form->level[face->storey + 1] - house->form->level[face->storey];
}

/* In a room so deep and wide, seen from where one begins to climb. */
static tn_steps steps_of(const tn_opening_record *flight, int64_t height, int64_t deep, int64_t wide)
{
    int64_t risers = (height + flight->rise_most - 1) / flight->rise_most, w = flight->wide, g = flight->going;
    tn_steps none = {0};
    if (risers < 4 || risers > TN_FLIGHT_STEPS_MAX || flight->rise_least > height / risers)
        return none;
    tn_steps steps = {.risers = risers};
    int64_t treads = risers - 2; /* without one for the landing; the last riser leads to the floor */
    switch ((tn_turn)flight->turn) {
    case TN_TURN_HALF:
        steps.first = (treads + 1) / 2;
        steps.second = treads - steps.first;
        steps.deep = 2 * w + steps.first * g;
        steps.wide = 2 * w;
        break;
    case TN_TURN_QUARTER:
        if (deep < 2 * w)
            return none;
        steps.first = (deep - 2 * w) / g < treads - 1 ? (deep - 2 * w) / g : treads - 1;
        steps.second = treads - steps.first;
        steps.deep = 2 * w + steps.first * g;
        steps.wide = 2 * w + steps.second * g;
        break;
    default:
        steps.first = risers - 1;
        steps.deep = 2 * w + steps.first * g;
        steps.wide = w;
    }
    return steps.first >= 1 && steps.deep <= deep && steps.wide <= wide ? steps : none;
}

/* If the form asks for ways: the steps alone, in a room that is so deep as they are climbed at first. */
static tn_steps bare_steps_of(const tn_opening_record *flight, int64_t height, int64_t deep)
{
    int64_t w = flight->wide, g = flight->going, risers = (height + flight->rise_most - 1) / flight->rise_most;
    tn_steps steps = {.risers = risers, .first = risers - 1, .deep = (risers - 1) * g, .wide = w};
    if (risers < 4 || risers > TN_FLIGHT_STEPS_MAX || flight->rise_least * risers > height)
        return (tn_steps){0};
    bool half = flight->turn == TN_TURN_HALF, spiral = flight->turn == TN_TURN_SPIRAL;
    if (spiral)
        steps.first = 0;
    if (spiral || flight->turn == TN_TURN_STRAIGHT) {
        steps.deep = spiral ? w : steps.deep;
        return steps;
    }
    int64_t treads = risers - 1 - tn_flight_corners(flight), fit = deep > w ? (deep - w) / g : 0;
    if (treads < 0)
        return (tn_steps){0};
    steps.first = half ? (treads + 1) / 2 : fit < treads ? fit : treads;
    steps.second = treads - steps.first;
    steps.deep = steps.first * g + w;
    steps.wide = half ? 2 * w : w + steps.second * g;
    return steps;
}

/* Have the steps room there, whatever walls and doors there are? */
static bool has_room(const tn_opening_record *flight, int64_t height, int64_t deep, int64_t wide)
{
    tn_steps steps = bare_steps_of(flight, height, deep);
    return steps.risers > 0 && steps.deep <= deep && steps.wide <= wide;
}

static tn_flight_size bare_size(const tn_opening_record *flight, int64_t height)
{
    tn_steps steps = bare_steps_of(flight, height, TN_HOUSE_LENGTH_MAX);
    tn_flight_size size = {steps.risers, steps.deep, steps.wide, flight->turn == TN_TURN_QUARTER};
    int64_t treads = steps.first + steps.second, first = (treads + 1) / 2;
    if (size.turns && steps.risers) { /* about as much each way */
        size.deep = flight->wide + first * flight->going;
        size.wide = flight->wide + (treads - first) * flight->going;
    }
    return size;
}

tn_flight_size tn_flight_size_in(const tn_house_form *form, uint32_t storey, const tn_opening_record *flight)
{
    int64_t height = form->level[storey + 1] - form->level[storey];
    bool turns = flight->turn == TN_TURN_QUARTER;
    if (tn_form_asks_ways(form))
        return bare_size(flight, height);
    tn_steps steps = steps_of(flight, height, TN_HOUSE_LENGTH_MAX, TN_HOUSE_LENGTH_MAX);
    tn_flight_size size = {steps.risers, steps.deep, steps.wide, turns};
    if (turns && steps.risers) { /* about as much each way */
        int64_t treads = steps.first + steps.second, first = (treads + 1) / 2;
        size.deep = 2 * flight->wide + first * flight->going;
        size.wide = 2 * flight->wide + (treads - first) * flight->going;
    }
    return size;
}

/* What of a face is clear, whatever walls there are. */
static tn_rectangle clear_of(const tn_house *house, const tn_face *face)
{
    const tn_form_record *form = house->form->record;
    int64_t half = (form->wall > form->partition ? form->wall : form->partition) / 2;
    const tn_rectangle *at = &face->at;
    return (tn_rectangle){at->x0 + half, at->x1 - half, at->y0 + half, at->y1 - half};
}

static tn_steps steps_from(const tn_house *house, const tn_face *face, const tn_opening_record *flight,
                           tn_house_side side)
{
    tn_rectangle r = clear_of(house, face);
    bool in_y = side == TN_HOUSE_BACK || side == TN_HOUSE_FRONT;
    int64_t x = r.x1 - r.x0, y = r.y1 - r.y0;
    return steps_of(flight, storey_height(house, face), in_y ? y : x, in_y ? x : y);
}

static bool has_tiles(const tn_house *house, uint32_t cell)
{
    for (uint32_t i = 0; i < house->form->record->tile_count; i++)
        if (tn_tile_is_for(house, cell, house->form->record->tile_first + i))
            return true;
    return false;
}

bool tn_flight_fits(const tn_house *house, const tn_face *face, const tn_opening_record *flight)
{
    if (face->relation != TN_FACE_UNDER || has_tiles(house, face->first) || has_tiles(house, face->second))
        return false;
    int64_t x = face->at.x1 - face->at.x0, y = face->at.y1 - face->at.y0;
    if (tn_form_asks_ways(house->form))
        return has_room(flight, storey_height(house, face), y, x) || has_room(flight, storey_height(house, face), x, y);
    return steps_from(house, face, flight, TN_HOUSE_BACK).risers ||
           steps_from(house, face, flight, TN_HOUSE_LEFT).risers;
}

/* ---- where it stands */

/* Can one come into the lower cell from this side? */
static bool is_entered(const tn_house *house, uint32_t cell, tn_house_side side)
{
    static const tn_house_side opposite[] = {TN_HOUSE_ANY_SIDE, TN_HOUSE_FRONT, TN_HOUSE_BACK, TN_HOUSE_RIGHT,
                                             TN_HOUSE_LEFT};
    for (size_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        const tn_opening_record *opening = tn_form_opening(house->form, face->kind);
        bool here =
            (face->first == cell && face->side == side) || (face->second == cell && face->side == opposite[side]);
        if (here && face->relation != TN_FACE_UNDER &&
            (face->kind == TN_FACE_OPEN || (opening && opening->flags & TN_PASSAGE)))
            return true;
    }
    return false;
}

static tn_house_side side_of(const tn_house *house, const tn_face *face, const tn_opening_record *flight)
{
    tn_house_side first = TN_HOUSE_ANY_SIDE;
    for (tn_house_side side = TN_HOUSE_BACK; side <= TN_HOUSE_RIGHT; side++) {
        if (!steps_from(house, face, flight, side).risers)
            continue;
        if (is_entered(house, face->first, side))
            return side;
        first = first == TN_HOUSE_ANY_SIDE ? side : first;
    }
    return first;
}

/* A place so far up the way and so far across it. */
static void place_of(tn_rectangle r, tn_house_side side, int64_t along, int64_t across, int64_t at[2])
{
    at[0] = side == TN_HOUSE_LEFT ? r.x0 + along : side == TN_HOUSE_RIGHT ? r.x1 - along : r.x0 + across;
    at[1] = side == TN_HOUSE_BACK ? r.y0 + along : side == TN_HOUSE_FRONT ? r.y1 - along : r.y0 + across;
}

static tn_rectangle rectangle_of(tn_rectangle r, tn_house_side side, int64_t along0, int64_t along1, int64_t across0,
                                 int64_t across1)
{
    int64_t a[2], b[2];
    place_of(r, side, along0, across0, a);
    place_of(r, side, along1, across1, b);
    return (tn_rectangle){a[0] < b[0] ? a[0] : b[0], a[0] < b[0] ? b[0] : a[0], a[1] < b[1] ? a[1] : b[1],
                          a[1] < b[1] ? b[1] : a[1]};
}

/* Between places along and across the way, at level `number` of the steps: as thick as two rises, but for the first. */
static void put_tread(tn_flight *to, tn_rectangle at, int64_t number, int64_t height, int64_t risers)
{
    int64_t low = number > 2 ? (number - 2) * height / risers : 0;
    to->treads[to->tread_count++] = (tn_box){at.x0, at.x1, at.y0, at.y1, low, number * height / risers};
}

static void put_path(tn_flight *to, tn_rectangle r, tn_house_side side, int64_t along, int64_t across)
{
    place_of(r, side, along, across, to->path[to->path_count++]);
}

static void stand_second(tn_flight *to, const tn_opening_record *flight, tn_rectangle r, tn_house_side side,
                         const tn_steps *steps, int64_t height)
{
    int64_t w = flight->wide, g = flight->going, end = w + steps->first * g, next = steps->first + 1;
    bool half = flight->turn == TN_TURN_HALF;
    put_tread(to, rectangle_of(r, side, end, end + w, 0, half ? 2 * w : w), next, height, steps->risers);
    for (int64_t i = 0; i < steps->second; i++)
        put_tread(to,
                  half ? rectangle_of(r, side, end - (i + 1) * g, end - i * g, w, 2 * w)
                       : rectangle_of(r, side, end, end + w, w + i * g, w + (i + 1) * g),
                  next + 1 + i, height, steps->risers);
    to->holes[to->hole_count++] = half ? rectangle_of(r, side, end - steps->second * g, end + w, w, 2 * w)
                                       : rectangle_of(r, side, end, end + w, w, w + steps->second * g);
    put_path(to, r, side, end + w / 2, w / 2);
    if (half)
        put_path(to, r, side, end + w / 2, w + w / 2);
    put_path(to, r, side, half ? end - steps->second * g : end + w / 2, half ? w + w / 2 : w + steps->second * g);
}

tn_status tn_flight_stand(const tn_house *house, const tn_face *face, tn_flight *to, tn_error *error)
{
    const tn_opening_record *flight = tn_form_flight(house->form, face->kind);
    *to = (tn_flight){.face = (uint32_t)(face - house->faces)};
    if (flight && tn_form_asks_ways(house->form))
        return tn_stack_flight(house, face, to, error);
    tn_house_side side = flight ? side_of(house, face, flight) : TN_HOUSE_ANY_SIDE;
    if (side == TN_HOUSE_ANY_SIDE)
        return TN_OK;
    tn_steps steps = steps_from(house, face, flight, side);
    tn_rectangle r = clear_of(house, face);
    int64_t w = flight->wide, g = flight->going, height = storey_height(house, face);
    to->treads = malloc((size_t)steps.risers * sizeof *to->treads);
    to->holes = malloc(2 * sizeof *to->holes);
    if (!to->treads || !to->holes)
        return tn_fail_memory(error);
    for (int64_t i = 0; i < steps.first; i++)
        put_tread(to, rectangle_of(r, side, w + i * g, w + (i + 1) * g, 0, w), i + 1, height, steps.risers);
    put_path(to, r, side, w, w / 2);
    bool turns = flight->turn != TN_TURN_STRAIGHT;
    int64_t end = w + steps.first * g;
    to->holes[to->hole_count++] = rectangle_of(r, side, w, turns ? end + w : end, 0, w);
    if (turns)
        stand_second(to, flight, r, side, &steps, height);
    else
        put_path(to, r, side, end, w / 2);
    return TN_OK;
}

void tn_flight_clear(tn_flight *flight)
{
    free(flight->holes);
    free(flight->drops);
    free(flight->low);
    free(flight->treads);
    free(flight->wedges);
    *flight = (tn_flight){0};
}

tn_status tn_flights_stand(const tn_house *house, tn_flights *flights, tn_error *error)
{
    tn_status status = TN_OK;
    size_t count = 0;
    for (size_t i = 0; i < house->face_count; i++)
        count += house->faces[i].relation == TN_FACE_UNDER && tn_form_flight(house->form, house->faces[i].kind);
    *flights = (tn_flights){.items = calloc(count + 1, sizeof *flights->items)};
    if (!flights->items)
        return tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < house->face_count; i++)
        if (house->faces[i].relation == TN_FACE_UNDER && tn_form_flight(house->form, house->faces[i].kind))
            status = tn_flight_stand(house, &house->faces[i], &flights->items[flights->count++], error);
    return status;
}

void tn_flights_clear(tn_flights *flights)
{
    for (size_t i = 0; i < flights->count; i++)
        tn_flight_clear(&flights->items[i]);
    free(flights->items);
    *flights = (tn_flights){0};
}
