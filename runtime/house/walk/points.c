/* Finds the points of a house that walks go by: what stands on the floor of each cell, where its passages are passed,
 * and how far these are from each other. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/walk/walk.h"

/* ---- floors that were found before */

enum { FLOOR_WORDS_MAX = 1 << 22 }; /* of all keys: with more they are forgotten */

static void forget(tn_walk_floors *f)
{
    for (uint32_t i = 0; i < f->floors.count; i++)
        free(f->lengths[i]);
    tn_interner_clear(&f->floors);
}

void tn_walk_floors_clear(tn_walk_floors *f)
{
    forget(f);
    tn_interner_clear(&f->alike);
    free(f->lengths);
    free(f->key.data);
    *f = (tn_walk_floors){0};
}

static bool push_long(tn_key *key, int64_t value)
{
    return tn_key_push(key, (uint32_t)value) && tn_key_push(key, (uint32_t)((uint64_t)value >> 32));
}

static bool push_rectangle(tn_key *key, const tn_rectangle *r, const tn_rectangle *from)
{
    return push_long(key, r->x0 - from->x0) && push_long(key, r->x1 - from->x0) && push_long(key, r->y0 - from->y0) &&
           push_long(key, r->y1 - from->y0);
}

/* Wherever the floor is, its ways are as long. */
static bool make_key(const tn_floor *floor, const tn_point *ends, size_t count, tn_key *key)
{
    const tn_rectangle *clear = &floor->clear;
    key->size = 0;
    bool ok = push_long(key, floor->way) && push_long(key, clear->x1 - clear->x0) &&
              push_long(key, clear->y1 - clear->y0) && push_long(key, (int64_t)floor->passage_count) &&
              push_long(key, (int64_t)floor->obstacle_count);
    for (size_t i = 0; ok && i < floor->passage_count; i++) {
        const tn_rectangle gate = tn_floor_gate(floor, &floor->passages[i]);
        ok = push_rectangle(key, &gate, clear);
    }
    for (size_t i = 0; ok && i < floor->obstacle_count; i++)
        ok = push_rectangle(key, &floor->obstacles[i], clear);
    for (size_t i = 0; ok && i < count; i++)
        ok = push_long(key, ends[i].x - clear->x0) && push_long(key, ends[i].y - clear->y0);
    return ok;
}

/* [count][count] */
static tn_status find_ends(const tn_floor *floor, const tn_point *ends, size_t count, int64_t **lengths,
                           tn_error *error)
{
    tn_floor_paths paths;
    *lengths = tn_array_new(tn_size_of(count, count) + 1, sizeof **lengths);
    tn_status status = tn_floor_paths_find(floor, ends, count, &paths, error);
    if (status == TN_OK && !*lengths)
        status = tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        memcpy(*lengths + i * count, paths.lengths + i * paths.count, count * sizeof **lengths);
    tn_floor_paths_clear(&paths);
    return status;
}

static tn_status lengths_over(tn_walk_floors *f, const tn_floor *floor, const tn_point *ends, size_t count,
                              const int64_t **lengths, tn_error *error)
{
    uint32_t before = f->floors.count;
    if (!make_key(floor, ends, count, &f->key) ||
        !tn_array_reserve(&f->lengths, &f->room, before, 1, sizeof *f->lengths))
        return tn_fail_memory(error);
    uint32_t number = tn_intern(&f->floors, f->key.data, f->key.size);
    if (number == UINT32_MAX)
        return tn_fail_memory(error);
    if (number == before)
        f->lengths[number] = NULL;
    tn_status status = f->lengths[number] ? TN_OK : find_ends(floor, ends, count, &f->lengths[number], error);
    if (status != TN_OK) { /* the next one asks again */
        free(f->lengths[number]);
        f->lengths[number] = NULL;
    }
    *lengths = f->lengths[number];
    return status;
}

/* ---- what stands on floors */

/* Those of one of the tiles. */
static tn_status add_items(const tn_house *house, const tn_variants *tiles, size_t chosen, tn_rectangles *to,
                           tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && chosen < tiles->count && i < tiles->variants[chosen].item_count; i++) {
        const tn_box *at = &tiles->items[tiles->variants[chosen].item_first + i].at;
        if (at->z0 < house->form->record->headroom)
            status = tn_rectangles_add(to, (tn_rectangle){at->x0, at->x1, at->y0, at->y1}, error);
    }
    return status;
}

static tn_status add_own_items(const tn_house *house, uint32_t cell, tn_rectangles *to, tn_error *error)
{
    tn_variants tiles;
    tn_status status = tn_tile_variants(house, cell, &tiles, error);
    if (status == TN_OK)
        status = add_items(house, &tiles, house->cells[cell].variant, to, error);
    tn_variants_clear(&tiles);
    return status;
}

/* Below a flight what one cannot walk under, above it its hole. */
static tn_status add_flights(const tn_walks *w, uint32_t cell, tn_rectangles *to, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < w->flights.count; i++) {
        const tn_flight *flight = &w->flights.items[i];
        const tn_face *face = &w->house->faces[flight->face];
        for (size_t k = 0; status == TN_OK && face->first == cell && k < flight->low_count; k++)
            status = tn_rectangles_add(to, flight->low[k], error);
        for (size_t k = 0; status == TN_OK && face->second == cell && k < flight->hole_count; k++)
            status = tn_rectangles_add(to, flight->holes[k], error);
    }
    return status;
}

static tn_status find_floor(tn_walks *w, uint32_t cell, tn_error *error)
{
    tn_cell_floor *floor = &w->cells[cell].floor;
    tn_status status = tn_cell_floor_find(w->house, cell, floor, error);
    w->cells[cell].has_passage = floor->passage_count > 0;
    for (size_t i = 0; i < floor->passage_count; i++) {
        uint32_t face = floor->passage_faces[i];
        *(w->house->faces[face].first == cell ? &w->first_of[face] : &w->second_of[face]) = true;
    }
    if (status == TN_OK)
        status = add_own_items(w->house, cell, &floor->obstacles, error);
    return status == TN_OK ? add_flights(w, cell, &floor->obstacles, error) : status;
}

/* ---- points */

static tn_status add_point(tn_walks *w, tn_walk_point point, tn_error *error)
{
    if (!tn_array_reserve(&w->points, &w->room, w->count, 1, sizeof *w->points))
        return tn_fail_memory(error);
    point.over = TN_NO_POINT;
    w->points[w->count++] = point;
    return TN_OK;
}

static bool runs_in_x(tn_house_side side)
{
    return side == TN_HOUSE_BACK || side == TN_HOUSE_FRONT;
}

/* The whole of an open side, less half a wall at both ends. */
static void whole_side(const tn_house *house, const tn_face *face, tn_house_side side, int64_t *from, int64_t *to)
{
    int64_t half = house->form->record->wall / 2;
    *from = (runs_in_x(side) ? face->at.x0 : face->at.y0) + half;
    *to = (runs_in_x(side) ? face->at.x1 : face->at.y1) - half;
}

/* Is it an open side at which one of the cells is bare? */
static bool is_wide(const tn_walks *w, uint32_t cell, uint32_t index)
{
    const tn_face *face = &w->house->faces[index];
    uint32_t other = face->first == cell ? face->second : face->first;
    return face->kind == TN_FACE_OPEN && other != TN_NO_CELL &&
           (tn_face_seen(w->house, index, cell).beyond == TN_BEYOND_BARE ||
            tn_face_seen(w->house, index, other).beyond == TN_BEYOND_BARE);
}

static tn_status add_spot(tn_walks *w, uint32_t cell, const tn_floor *floor, const tn_passage *passage, uint32_t face,
                          tn_walk_spot spot, tn_error *error)
{
    const tn_rectangle line = tn_floor_points(floor, passage);
    return add_point(w, (tn_walk_point){cell, face, spot, .at = tn_rectangle_middle(&line)}, error);
}

/* passages: of the floor, and behind these room for two more of each: at the ends of wide sides one stands in them. */
static tn_status add_passage(tn_walks *w, uint32_t cell, tn_floor *floor, tn_passage *passages, size_t i,
                             tn_error *error)
{
    uint32_t face = w->cells[cell].floor.passage_faces[i];
    tn_passage low = passages[i], high = passages[i];
    tn_status status = add_spot(w, cell, floor, &passages[i], face, TN_SPOT_MIDDLE, error);
    if (status != TN_OK || !is_wide(w, cell, face))
        return status;
    whole_side(w->house, &w->house->faces[face], passages[i].side, &low.from, &high.to);
    low.to = low.from + floor->way;
    high.from = high.to - floor->way;
    passages[floor->passage_count++] = low;
    passages[floor->passage_count++] = high;
    status = add_spot(w, cell, floor, &low, face, TN_SPOT_LOW, error);
    return status == TN_OK ? add_spot(w, cell, floor, &high, face, TN_SPOT_HIGH, error) : status;
}

/* The open side over which a landing of a flight in the cell reaches; NULL: it lies in the cell. */
static const tn_face *reached_side(const tn_walks *w, uint32_t cell, const tn_rectangle *landing)
{
    const tn_cell_floor *floor = &w->cells[cell].floor;
    for (size_t i = 0; !tn_rectangle_within(landing, &floor->clear) && i < floor->open_count; i++)
        if (tn_landing_reaches_over(floor, &floor->open_sides[i], landing))
            return &w->house->faces[floor->passage_faces[floor->open_sides[i].passage]];
    return NULL;
}

static int64_t not_outside(int64_t at, int64_t low, int64_t high)
{
    return at < low ? low : at > high ? high : at;
}

/* Where one stands on it, in a cell that it reaches into: on the side, if its middle is not in there. */
static tn_point landing_point(const tn_rectangle *clear, const tn_rectangle *landing)
{
    tn_point middle = tn_rectangle_middle(landing);
    return (tn_point){not_outside(middle.x, clear->x0, clear->x1), not_outside(middle.y, clear->y0, clear->y1)};
}

/* A landing that reaches into the cell over an open side is floor there, as far as that is wide. */
static void open_side(tn_floor *floor, tn_passage *passages, tn_house_side side, const tn_rectangle *landing)
{
    bool in_x = runs_in_x(side);
    passages[floor->passage_count++] = (tn_passage){side, TN_PASSAGE_OPEN, in_x ? landing->x0 : landing->y0,
                                                    in_x ? landing->x1 : landing->y1};
}

/* One of a flight, in its own cell, if it lies in this one. */
static tn_status add_landing(tn_walks *w, uint32_t cell, uint32_t own, const tn_flight *flight,
                             const tn_rectangle *landing, tn_floor *floor, tn_passage *passages, tn_error *error)
{
    const tn_face *side = reached_side(w, own, landing);
    uint32_t in = !side ? own : side->first == own ? side->second : side->first;
    if (in != cell)
        return TN_OK;
    if (side)
        open_side(floor, passages, tn_face_side(side, cell), landing);
    const tn_walk_point point = {cell, flight->face, TN_SPOT_LANDING, .at = landing_point(&floor->clear, landing),
                                 .across = flight->length};
    return add_point(w, point, error);
}

/* The landings that lie in a cell: of the flights that stand. */
static tn_status add_landings(tn_walks *w, uint32_t cell, tn_floor *floor, tn_passage *passages, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < w->flights.count; i++) {
        const tn_flight *flight = &w->flights.items[i];
        const tn_face *face = &w->house->faces[flight->face];
        if (flight->tread_count + flight->wedge_count == 0)
            continue;
        status = add_landing(w, cell, face->first, flight, &flight->foot, floor, passages, error);
        if (status == TN_OK)
            status = add_landing(w, cell, face->second, flight, &flight->head, floor, passages, error);
    }
    return status;
}

/* Those where nobody can stand are no points. */
static tn_status keep_free(tn_walks *w, tn_walk_cell *c, const tn_floor *floor, tn_walk_floors *floors,
                           tn_error *error)
{
    tn_point *ends = tn_array_new((uint64_t)(w->count - c->first) + 1, sizeof *ends);
    const int64_t *lengths;
    uint32_t all = w->count - c->first;
    if (!ends)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < all; i++)
        ends[i] = w->points[c->first + i].at;
    tn_status status = lengths_over(floors, floor, ends, all, &lengths, error);
    w->count = c->first;
    for (uint32_t i = 0; status == TN_OK && i < all; i++) {
        if (lengths[i * (size_t)all + i] == TN_NO_PATH)
            continue;
        ends[w->count - c->first] = ends[i];
        w->points[w->count++] = w->points[c->first + i];
    }
    c->count = w->count - c->first;
    if (status == TN_OK)
        status = lengths_over(floors, floor, ends, c->count, &c->lengths, error);
    free(ends);
    return status;
}

/* The floor of a cell with what is at the ends of wide sides; the passages are the caller's to free. */
static tn_status add_points(tn_walks *w, uint32_t cell, tn_floor *floor, tn_passage **passages, tn_error *error)
{
    const tn_cell_floor *own = &w->cells[cell].floor;
    *floor = tn_cell_floor_of(own);
    *passages = tn_array_new(3 * (uint64_t)own->passage_count + 2 * w->flights.count + 1, sizeof **passages);
    if (!*passages)
        return tn_fail_memory(error);
    if (own->passage_count > 0)
        memcpy(*passages, own->passages, own->passage_count * sizeof **passages);
    floor->passages = *passages;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < own->passage_count; i++)
        status = add_passage(w, cell, floor, *passages, i, error);
    return status == TN_OK ? add_landings(w, cell, floor, *passages, error) : status;
}

static tn_status find_points(tn_walks *w, uint32_t cell, tn_walk_floors *floors, tn_error *error)
{
    tn_walk_cell *c = &w->cells[cell];
    tn_floor floor;
    tn_passage *passages;
    c->first = w->count;
    tn_status status = add_points(w, cell, &floor, &passages, error);
    if (status == TN_OK)
        status = keep_free(w, c, &floor, floors, error);
    free(passages);
    return status;
}

/* What is over each point: the same spot of the face in the other cell, or the flight's other landing. */
static void join_points(tn_walks *w)
{
    for (uint32_t i = 0; i < w->count; i++)
        for (uint32_t k = i + 1; k < w->count; k++) {
            tn_walk_point *a = &w->points[i], *b = &w->points[k];
            if (a->face != b->face || a->spot != b->spot)
                continue;
            a->over = k;
            b->over = i;
            if (a->spot != TN_SPOT_LANDING)
                a->across = b->across = tn_distance_up(a->at, b->at);
        }
}

static tn_status begin(const tn_house *house, tn_walk_floors *floors, tn_walks *w, tn_error *error)
{
    *w = (tn_walks){.house = house,
                    .cell_count = house->cell_count,
                    .cells = calloc(house->cell_count + 1, sizeof *w->cells),
                    .first_of = calloc(house->face_count + 1, sizeof *w->first_of),
                    .second_of = calloc(house->face_count + 1, sizeof *w->second_of)};
    if (floors->floors.words_used > FLOOR_WORDS_MAX)
        forget(floors);
    return w->cells && w->first_of && w->second_of ? TN_OK : tn_fail_memory(error);
}

tn_status tn_walks_find(const tn_house *house, tn_walk_floors *floors, tn_walks *w, tn_error *error)
{
    tn_status status = begin(house, floors, w, error);
    if (status == TN_OK)
        status = tn_flights_stand(house, &w->flights, error);
    for (uint32_t i = 0; status == TN_OK && i < house->cell_count; i++)
        if (!house->cells[i].open)
            status = find_floor(w, i, error);
    for (uint32_t i = 0; status == TN_OK && i < house->cell_count; i++)
        if (!house->cells[i].open)
            status = find_points(w, i, floors, error);
    if (status == TN_OK)
        join_points(w);
    return status;
}

void tn_walks_clear(tn_walks *w)
{
    for (size_t i = 0; w->cells && i < w->cell_count; i++)
        tn_cell_floor_clear(&w->cells[i].floor);
    tn_flights_clear(&w->flights);
    free(w->cells);
    free(w->points);
    free(w->first_of);
    free(w->second_of);
    *w = (tn_walks){0};
}

/* ---- tiles */

/* The number of the points of a cell, as they are now. */
static tn_status number_points(const tn_walks *w, uint32_t cell, tn_walk_floors *floors, uint32_t *number,
                               tn_error *error)
{
    const tn_walk_cell *c = &w->cells[cell];
    tn_key *key = &floors->key;
    bool ok = true;
    key->size = 0;
    for (uint32_t i = 0; ok && i < c->count; i++)
        ok = tn_key_push(key, w->points[c->first + i].face) && tn_key_push(key, w->points[c->first + i].spot);
    for (size_t i = 0; ok && i < (size_t)c->count * c->count; i++)
        ok = push_long(key, c->lengths[i]);
    *number = ok ? tn_intern(&floors->alike, key->data, key->size) : UINT32_MAX;
    return *number != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* Flights stand neither in cells with tiles nor before them. */
tn_status tn_walk_tiles(const tn_house *house, uint32_t cell, const tn_variants *tiles, tn_walk_floors *floors,
                        uint32_t *numbers, tn_error *error)
{
    tn_walks w;
    tn_cell_floor *floor;
    tn_status status = begin(house, floors, &w, error);
    if (status == TN_OK)
        status = tn_cell_floor_find(house, cell, &w.cells[cell].floor, error);
    floor = status == TN_OK ? &w.cells[cell].floor : NULL;
    bool alike = floor && (floor->passage_count == 0 ||
                           (floor->passage_count == 1 && !is_wide(&w, cell, floor->passage_faces[0])));
    size_t own = floor ? floor->obstacles.count : 0;
    for (size_t i = 0; status == TN_OK && i < tiles->count; i++) {
        numbers[i] = 0;
        if (alike) /* one comes in and goes out there */
            continue;
        floor->obstacles.count = own;
        w.count = 0;
        status = add_items(house, tiles, i, &floor->obstacles, error);
        if (status == TN_OK)
            status = find_points(&w, cell, floors, error);
        if (status == TN_OK)
            status = number_points(&w, cell, floors, &numbers[i], error);
    }
    tn_walks_clear(&w);
    return status;
}

/* ---- lines */

/* On one floor, from point to point of it. */
static tn_status add_floor_lines(const tn_walks *walks, uint32_t from, uint32_t to, tn_walk_line **lines, size_t *room,
                                 size_t *count, tn_error *error)
{
    tn_walks again = *walks; /* whose points are found once more, behind those that there are */
    uint32_t cell = walks->points[from].cell;
    const tn_point ends[2] = {walks->points[from].at, walks->points[to].at};
    tn_floor floor;
    tn_passage *passages;
    tn_floor_paths paths = {0};
    again.points = NULL;
    again.count = 0;
    again.room = 0;
    tn_status status = add_points(&again, cell, &floor, &passages, error);
    free(again.points);
    if (status == TN_OK)
        status = tn_floor_paths_find(&floor, ends, 2, &paths, error);
    free(passages);
    tn_point *points = status == TN_OK ? tn_array_new(paths.count + 1, sizeof *points) : NULL;
    if (status == TN_OK && (!points || !tn_array_reserve(lines, room, *count, paths.count, sizeof **lines)))
        status = tn_fail_memory(error);
    size_t there = status == TN_OK ? tn_floor_path_points(&paths, 0, 1, points) : 0;
    for (size_t i = 0; i + 1 < there; i++)
        (*lines)[(*count)++] = (tn_walk_line){walks->house->cells[cell].storey, points[i], points[i + 1]};
    free(points);
    tn_floor_paths_clear(&paths);
    return status;
}

/* Through a wall, or along a flight, on the lower floor. */
static tn_status add_across(const tn_walks *w, uint32_t from, uint32_t to, tn_walk_line **lines, size_t *room,
                            size_t *count, tn_error *error)
{
    const tn_walk_point *a = &w->points[from], *b = &w->points[to];
    uint32_t storey = w->house->faces[a->face].storey;
    const tn_flight *flight = NULL;
    for (size_t i = 0; a->spot == TN_SPOT_LANDING && i < w->flights.count; i++)
        if (w->flights.items[i].face == a->face)
            flight = &w->flights.items[i];
    size_t inner = flight ? flight->path_count : 0;
    bool down = flight && w->house->cells[a->cell].storey > w->house->cells[b->cell].storey;
    tn_point at = a->at;
    if (!tn_array_reserve(lines, room, *count, inner + 1, sizeof **lines))
        return tn_fail_memory(error);
    for (size_t i = 0; i < inner; i++) {
        const int64_t *corner = flight->path[down ? inner - 1 - i : i];
        (*lines)[(*count)++] = (tn_walk_line){storey, at, {corner[0], corner[1]}};
        at = (tn_point){corner[0], corner[1]};
    }
    (*lines)[(*count)++] = (tn_walk_line){storey, at, b->at};
    return TN_OK;
}

tn_status tn_walks_lines(const tn_walks *w, const int64_t *lengths, const uint32_t *next, uint32_t from,
                         tn_walk_line **lines, size_t *count, tn_error *error)
{
    tn_status status = TN_OK;
    size_t room = 0;
    *lines = NULL;
    *count = 0;
    while (status == TN_OK && lengths[from] > 0) {
        uint32_t to = next[from];
        bool across = w->points[from].over == to;
        status = (across ? add_across : add_floor_lines)(w, from, to, lines, &room, count, error);
        from = to;
    }
    return status;
}
