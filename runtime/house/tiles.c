/* Finds the tiles that fit in a cell: on each side, turned, plain and mirrored. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/ways.h"

/* What a tile must not stand in, beside its own items: posts, and what openings need clear. */
typedef struct tn_room {
    const tn_house *house;
    uint32_t cell;
    tn_rectangle clear; /* its walls taken off */
    int64_t height;
    tn_box *taken;
    size_t taken_count, taken_room, posts;                              /* the first of the taken are posts */
    uint64_t kinds[TN_HOUSE_SIDE_COUNT][(TN_FACE_KINDS_MAX + 63) / 64]; /* on each side */
    bool ways;                                                          /* people have to be able to go about in it: */
    bool anywhere; /* the same, where it is not known what its sides are */
    tn_cell_floor floor;
} tn_room;

tn_house_side tn_face_side(const tn_face *face, uint32_t cell)
{
    static const tn_house_side opposite[] = {[TN_HOUSE_BACK] = TN_HOUSE_FRONT,
                                             [TN_HOUSE_FRONT] = TN_HOUSE_BACK,
                                             [TN_HOUSE_LEFT] = TN_HOUSE_RIGHT,
                                             [TN_HOUSE_RIGHT] = TN_HOUSE_LEFT};
    if (face->relation == TN_FACE_UNDER)
        return TN_HOUSE_ANY_SIDE;
    return face->first == cell ? face->side : face->second == cell ? opposite[face->side] : TN_HOUSE_ANY_SIDE;
}

tn_rectangle tn_cell_clear(const tn_house *house, uint32_t cell)
{
    int64_t back[TN_HOUSE_SIDE_COUNT] = {0};
    for (size_t i = 0; i < house->face_count; i++) {
        tn_house_side side = tn_face_side(&house->faces[i], cell);
        bool posts = tn_face_is_open_side(house, &house->faces[i]); /* the room ends where they do */
        int64_t half = (posts ? house->form->record->wall : tn_face_thickness(house, &house->faces[i])) / 2;
        if (half > back[side])
            back[side] = half;
    }
    tn_rectangle at = house->cells[cell].at;
    return (tn_rectangle){at.x0 + back[TN_HOUSE_LEFT], at.x1 - back[TN_HOUSE_RIGHT], at.y0 + back[TN_HOUSE_BACK],
                          at.y1 - back[TN_HOUSE_FRONT]};
}

static bool overlap(const tn_box *a, const tn_box *b)
{
    return a->x0 < b->x1 && b->x0 < a->x1 && a->y0 < b->y1 && b->y0 < a->y1 && a->z0 < b->z1 && b->z0 < a->z1;
}

static tn_status take(tn_room *room, tn_box box, tn_error *error)
{
    if (!tn_array_reserve_from(&room->taken, &room->taken_room, 16, room->taken_count, 1, sizeof *room->taken))
        return tn_fail_memory(error);
    room->taken[room->taken_count++] = box;
    return TN_OK;
}

/* The space that an opening of the room's side needs clear. */
static tn_status take_clearance(tn_room *room, const tn_face *face, tn_house_side side, tn_error *error)
{
    const tn_opening_record *o = tn_form_opening(room->house->form, face->kind);
    if (!o || o->clear == 0)
        return TN_OK;
    tn_rectangle c = room->clear;
    int64_t from = tn_opening_begins(face, o), to = from + o->wide;
    tn_box box = side == TN_HOUSE_BACK    ? (tn_box){from, to, c.y0, c.y0 + o->clear, 0, 0}
                 : side == TN_HOUSE_FRONT ? (tn_box){from, to, c.y1 - o->clear, c.y1, 0, 0}
                 : side == TN_HOUSE_LEFT  ? (tn_box){c.x0, c.x0 + o->clear, from, to, 0, 0}
                                          : (tn_box){c.x1 - o->clear, c.x1, from, to, 0, 0};
    box.z0 = o->sill;
    box.z1 = o->sill + o->high;
    return take(room, box, error);
}

/* The posts at the cell: where walls in x and in y meet. */
static tn_status take_posts(tn_room *room, tn_error *error)
{
    const tn_cell *cell = &room->house->cells[room->cell];
    tn_posts posts;
    tn_status status = tn_house_posts(room->house, cell->storey, &cell->at, &posts, error);
    for (size_t i = 0; status == TN_OK && i < posts.count; i++) {
        const tn_post *post = &posts.items[i];
        tn_rectangle at = tn_post_at(post);
        if (post->thick_x && post->thick_y)
            status = take(room, (tn_box){at.x0, at.x1, at.y0, at.y1, 0, room->height}, error);
    }
    free(posts.items);
    return status;
}

static tn_status enter(tn_room *room, tn_error *error)
{
    const tn_house *house = room->house;
    room->clear = tn_cell_clear(house, room->cell);
    room->height = tn_form_clear(house->form, house->cells[room->cell].storey);
    tn_status status = take_posts(room, error);
    room->posts = room->taken_count;
    for (size_t i = 0; status == TN_OK && i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        tn_house_side side = tn_face_side(face, room->cell);
        if (side == TN_HOUSE_ANY_SIDE)
            continue;
        room->kinds[side][face->kind / 64] |= UINT64_C(1) << face->kind % 64;
        status = take_clearance(room, face, side, error);
    }
    room->ways = tn_form_asks_ways(house->form) && !house->ways_unknown;
    return status == TN_OK && room->ways ? tn_cell_floor_find(house, room->cell, &room->floor, error) : status;
}

static void leave(tn_room *room)
{
    free(room->taken);
    tn_cell_floor_clear(&room->floor);
}

/* ---- one tile on one side */

typedef struct tn_placing {
    tn_room *room;
    const tn_tile_record *tile;
    tn_house_side side;
    bool mirrored;
    int64_t wide, deep; /* of the clear room, seen with the back behind */
    tn_tile_failure failure;
    tn_way_stop *stop; /* NULL, or how far people come is wanted, too */
} tn_placing;

static bool fail(tn_placing *p, tn_tile_obstacle obstacle, uint32_t box, uint32_t other)
{
    p->failure = (tn_tile_failure){.obstacle = obstacle,
                                   .box = p->tile->box_first + box,
                                   .other = other,
                                   .wide = p->wide,
                                   .deep = p->deep,
                                   .high = p->room->height,
                                   .side = p->side,
                                   .mirrored = p->mirrored};
    return false;
}

static bool stands_against(const tn_room *room, const tn_tile_record *tile, tn_house_side side)
{
    uint64_t allowed[(TN_FACE_KINDS_MAX + 63) / 64] = {0};
    const tn_house_item_record *items = room->house->form->module->HOUSE_ITEM_records;
    for (uint32_t i = 0; i < tile->against_count; i++) {
        uint32_t kind = items[tile->against_first + i].number;
        allowed[kind / 64] |= UINT64_C(1) << kind % 64;
    }
    for (size_t w = 0; tile->against_count > 0 && w < sizeof allowed / sizeof *allowed; w++)
        if (room->kinds[side][w] & ~allowed[w])
            return false;
    return true;
}

/* Where a box of the tile comes to be; false where it does not fit into the room. */
static bool place(const tn_placing *p, const tn_tile_box_record *box, tn_box *at)
{
    const tn_rectangle *c = &p->room->clear;
    int64_t u0 = box->flags & TN_TILE_X_FROM_RIGHT ? p->wide - box->x_from : box->x_from;
    int64_t u1 = box->flags & TN_TILE_X_TO_RIGHT ? p->wide - box->x_to : box->x_to;
    int64_t v0 = box->flags & TN_TILE_Y_FROM_FRONT ? p->deep - box->y_from : box->y_from;
    int64_t v1 = box->flags & TN_TILE_Y_TO_FRONT ? p->deep - box->y_to : box->y_to;
    int64_t z0 = box->up_low, z1 = box->up_high ? box->up_high : p->room->height;
    if (u0 < 0 || u0 >= u1 || u1 > p->wide || v0 < 0 || v0 >= v1 || v1 > p->deep || z0 >= z1 || z1 > p->room->height)
        return false;
    if (p->mirrored) {
        int64_t other = p->wide - u1;
        u1 = p->wide - u0;
        u0 = other;
    }
    *at = p->side == TN_HOUSE_BACK    ? (tn_box){c->x0 + u0, c->x0 + u1, c->y0 + v0, c->y0 + v1, z0, z1}
          : p->side == TN_HOUSE_FRONT ? (tn_box){c->x1 - u1, c->x1 - u0, c->y1 - v1, c->y1 - v0, z0, z1}
          : p->side == TN_HOUSE_LEFT  ? (tn_box){c->x0 + v0, c->x0 + v1, c->y1 - u1, c->y1 - u0, z0, z1}
                                      : (tn_box){c->x1 - v1, c->x1 - v0, c->y0 + u0, c->y0 + u1, z0, z1};
    return true;
}

/* Room for the items of one more variant; for none too, so that there is an array. */
static bool make_room(tn_variants *v, size_t items)
{
    return tn_array_reserve_from(&v->variants, &v->room, 8, v->count, 1, sizeof *v->variants) &&
           tn_array_reserve_from(&v->items, &v->item_room, 8, v->item_count, items + 1, sizeof *v->items);
}

/* Puts the tile's items behind those that are there. False where something does not fit. */
static bool stands(tn_placing *p, tn_variants *v, size_t *count)
{
    const tn_tile_box_record *boxes = p->room->house->form->module->TILE_BOX_records + p->tile->box_first;
    tn_standing_item *items = v->items + v->item_count;
    tn_box keep;
    *count = 0;
    for (uint32_t i = 0; i < p->tile->box_count; i++) {
        if (boxes[i].flags & TN_TILE_KEEP)
            continue;
        tn_standing_item *item = &items[*count];
        item->box = p->tile->box_first + i;
        if (!place(p, &boxes[i], &item->at))
            return fail(p, TN_TILE_BEYOND, i, 0);
        for (size_t k = 0; k < *count; k++)
            if (overlap(&items[k].at, &item->at))
                return fail(p, TN_TILE_MEETS_BOX, i, items[k].box);
        for (size_t k = 0; k < p->room->taken_count; k++)
            if (overlap(&p->room->taken[k], &item->at))
                return fail(p, k < p->room->posts ? TN_TILE_MEETS_POST : TN_TILE_MEETS_CLEAR, i, 0);
        ++*count;
    }
    for (uint32_t i = 0; i < p->tile->box_count; i++) {
        if (!(boxes[i].flags & TN_TILE_KEEP))
            continue;
        if (!place(p, &boxes[i], &keep))
            return fail(p, TN_TILE_BEYOND, i, 0);
        for (size_t k = 0; k < *count; k++)
            if (overlap(&items[k].at, &keep))
                return fail(p, TN_TILE_MEETS_BOX, i, items[k].box);
    }
    return true;
}

/* ---- ways past it */

/* What stands lower than a person is high is in the way, as far as it stands on the floor or hangs over it. */
static tn_status add_items(tn_placing *p, const tn_variants *v, size_t count, tn_error *error)
{
    tn_room *room = p->room;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        const tn_box *at = &v->items[v->item_count + i].at;
        if (at->z0 < room->house->form->record->headroom)
            status = tn_rectangles_add(&room->floor.obstacles, (tn_rectangle){at->x0, at->x1, at->y0, at->y1}, error);
    }
    return status;
}

static tn_status add_keeps(const tn_placing *p, tn_rectangles *keeps, tn_error *error)
{
    const tn_tile_box_record *boxes = p->room->house->form->module->TILE_BOX_records + p->tile->box_first;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < p->tile->box_count; i++) {
        tn_box at;
        if (boxes[i].flags & TN_TILE_KEEP && place(p, &boxes[i], &at))
            status = tn_rectangles_add(keeps, (tn_rectangle){at.x0, at.x1, at.y0, at.y1}, error);
    }
    return status;
}

/* The TILE_BOX of a keep, by its number among them. */
static uint32_t keep_of(const tn_placing *p, size_t number)
{
    const tn_tile_box_record *boxes = p->room->house->form->module->TILE_BOX_records + p->tile->box_first;
    uint32_t i = 0;
    while (!(boxes[i].flags & TN_TILE_KEEP) || number-- > 0)
        i++;
    return p->tile->box_first + i;
}

static bool fail_ways(tn_placing *p, const tn_floor_answer *answer)
{
    static const tn_tile_obstacle obstacles[] = {[TN_FLOOR_FITS] = TN_TILE_STANDS,
                                                 [TN_FLOOR_SHUT] = TN_TILE_SHUTS,
                                                 [TN_FLOOR_APART] = TN_TILE_CUTS,
                                                 [TN_FLOOR_KEEP] = TN_TILE_CLOSES_KEEP,
                                                 [TN_FLOOR_LEAF] = TN_TILE_MEETS_LEAF};
    tn_way_fault fault = tn_way_fault_of(p->room->house, p->room->cell, &p->room->floor, answer);
    uint32_t last = p->tile->box_count > 0 ? p->tile->box_count - 1 : 0;
    fail(p, obstacles[fault.fault], last, fault.fault == TN_FLOOR_KEEP ? keep_of(p, fault.keep) : 0);
    p->failure.kind = fault.kind;
    p->failure.at = fault.side;
    return false;
}

/* The items stand behind those that are there. *good: can people go about with them? */
static tn_status ask_ways(tn_placing *p, const tn_variants *v, size_t count, bool *good, tn_error *error)
{
    tn_rectangles *obstacles = &p->room->floor.obstacles, keeps = {0};
    size_t own = obstacles->count;
    tn_floor_answer answer = {0};
    tn_status status = add_items(p, v, count, error);
    if (status == TN_OK)
        status = add_keeps(p, &keeps, error);
    tn_floor asked = tn_cell_floor_of(&p->room->floor);
    asked.keeps = keeps.items;
    asked.keep_count = keeps.count;
    if (status == TN_OK)
        status = tn_floor_ask(&asked, &answer, error);
    *good = status == TN_OK && (answer.fits || fail_ways(p, &answer));
    if (status == TN_OK && !*good && p->stop)
        status = tn_floor_stop_find(&asked, &answer, &p->stop->at, error);
    tn_floor_answer_clear(&answer);
    obstacles->count = own;
    free(keeps.items);
    return status;
}

/* The same where it is not known how one comes in: a person may stand half through each side. *good: can one go from
 * each keep to each other then? */
static tn_status ask_keeps(tn_placing *p, const tn_variants *v, size_t count, bool *good, tn_error *error)
{
    tn_rectangles *obstacles = &p->room->floor.obstacles, keeps = {0};
    size_t keep = SIZE_MAX;
    uint32_t last = p->tile->box_count > 0 ? p->tile->box_count - 1 : 0;
    tn_status status = add_items(p, v, count, error);
    if (status == TN_OK)
        status = add_keeps(p, &keeps, error);
    tn_floor asked = tn_cell_floor_of(&p->room->floor);
    asked.clear = tn_rectangle_grown(&p->room->clear, asked.way / 2);
    asked.keeps = keeps.items;
    asked.keep_count = keeps.count;
    if (status == TN_OK)
        status = tn_floor_keeps_joined(&asked, &keep, error);
    *good = status == TN_OK && (keep == SIZE_MAX || fail(p, TN_TILE_CLOSES_KEEP, last, keep_of(p, keep)));
    obstacles->count = 0;
    free(keeps.items);
    return status;
}

/* Does the tile stand, and leaves it ways to go? *count: its items. */
static tn_status try_to_stand(tn_placing *p, tn_variants *v, size_t *count, bool *good, tn_error *error)
{
    *good = stands(p, v, count);
    if (*good && p->room->ways)
        return ask_ways(p, v, *count, good, error);
    return *good && p->room->anywhere ? ask_keeps(p, v, *count, good, error) : TN_OK;
}

/* ---- equal layouts count once */

static bool same_item(const tn_module *module, const tn_standing_item *a, const tn_standing_item *b)
{
    const tn_tile_box_record *boxes = module->TILE_BOX_records;
    return memcmp(&a->at, &b->at, sizeof a->at) == 0 &&
           strcmp(tn_text(module, boxes[a->box].name), tn_text(module, boxes[b->box].name)) == 0;
}

/* Items of one tile do not overlap, so that two layouts of as many are equal where each item of one is in the other. */
static bool is_new(const tn_module *module, const tn_variants *v, const tn_standing_item *items, size_t count)
{
    for (size_t i = 0; i < v->count; i++) {
        const tn_tile_variant *other = &v->variants[i];
        size_t same = 0;
        for (size_t k = 0; other->item_count == count && k < count; k++)
            for (size_t m = 0; m < count; m++)
                same += same_item(module, &items[k], &v->items[other->item_first + m]);
        if (other->item_count == count && same == count)
            return false;
    }
    return true;
}

/* ---- all of them */

/* The tile with its back on a side. False where the side or the size of the room is not one of its. */
static bool turn(tn_room *room, uint32_t tile, tn_house_side side, tn_placing *p)
{
    const tn_tile_record *record = &room->house->form->module->TILE_records[tile];
    bool across = side == TN_HOUSE_BACK || side == TN_HOUSE_FRONT;
    int64_t x = room->clear.x1 - room->clear.x0, y = room->clear.y1 - room->clear.y0;
    *p = (tn_placing){.room = room, .tile = record, .side = side, .wide = across ? x : y, .deep = across ? y : x};
    if (!stands_against(room, record, side))
        return fail(p, TN_TILE_NO_SIDE, 0, 0);
    return (p->wide >= record->wide_least && p->wide <= record->wide_most && p->deep >= record->deep_least &&
            p->deep <= record->deep_most) ||
           fail(p, TN_TILE_SIZE, 0, 0);
}

static tn_status try_side(tn_room *room, uint32_t tile, tn_house_side side, tn_variants *v, tn_error *error)
{
    const tn_module *module = room->house->form->module;
    const tn_tile_record *record = &module->TILE_records[tile];
    tn_placing placing;
    if (!turn(room, tile, side, &placing))
        return TN_OK;
    for (int mirrored = 0; mirrored < 2; mirrored++) {
        size_t count;
        bool good = false;
        placing.mirrored = mirrored;
        if (!make_room(v, record->box_count))
            return tn_fail_memory(error);
        tn_status status = try_to_stand(&placing, v, &count, &good, error);
        if (status != TN_OK)
            return status;
        if (!good || !is_new(module, v, v->items + v->item_count, count))
            continue;
        v->variants[v->count++] = (tn_tile_variant){tile, side, mirrored, v->item_count, count};
        v->item_count += count;
    }
    return TN_OK;
}

static bool is_for(const tn_house_form *form, uint32_t tile, uint32_t function)
{
    const tn_tile_record *record = &form->module->TILE_records[tile];
    for (uint32_t i = 0; i < record->purpose_count; i++)
        if (form->module->HOUSE_ITEM_records[record->purpose_first + i].number == function)
            return true;
    return false;
}

static const tn_house_side all_sides[] = {TN_HOUSE_BACK, TN_HOUSE_FRONT, TN_HOUSE_LEFT, TN_HOUSE_RIGHT};

bool tn_tile_is_for(const tn_house *house, uint32_t cell, uint32_t tile)
{
    return !house->cells[cell].open && is_for(house->form, tile, house->cells[cell].function);
}

/* The failure of the more boxes, or else the later one in tn_tile_obstacle, came further. */
static bool is_further(const tn_tile_failure *a, const tn_tile_failure *b)
{
    bool boxes = a->obstacle >= TN_TILE_BEYOND && b->obstacle >= TN_TILE_BEYOND;
    return boxes && a->box != b->box ? a->box > b->box : a->obstacle > b->obstacle;
}

/* Turned to each side, plain and mirrored: the failure that came furthest is kept. */
static tn_status find_failure(tn_room *room, uint32_t tile, tn_tile_failure *failure, tn_error *error)
{
    tn_variants v = {0};
    tn_status status = TN_OK;
    size_t count;
    *failure = (tn_tile_failure){.obstacle = TN_TILE_NO_SIDE};
    if (!make_room(&v, room->house->form->module->TILE_records[tile].box_count)) {
        tn_variants_clear(&v);
        return tn_fail_memory(error);
    }
    for (size_t i = 0; status == TN_OK && i < 2 * (sizeof all_sides / sizeof *all_sides); i++) {
        tn_placing p;
        bool good = turn(room, tile, all_sides[i / 2], &p);
        p.mirrored = i % 2;
        if (good)
            status = try_to_stand(&p, &v, &count, &good, error);
        if (good) {
            failure->obstacle = TN_TILE_STANDS;
            break;
        }
        if (is_further(&p.failure, failure))
            *failure = p.failure;
    }
    tn_variants_clear(&v);
    return status;
}

tn_status tn_tile_fails(const tn_house *house, uint32_t cell, uint32_t tile, tn_tile_failure *failure, tn_error *error)
{
    tn_room room = {.house = house, .cell = cell};
    tn_status status = enter(&room, error);
    if (status == TN_OK)
        status = find_failure(&room, tile, failure, error);
    leave(&room);
    return status;
}

bool tn_tile_failure_stops(const tn_tile_failure *failure)
{
    return failure->obstacle >= TN_TILE_SHUTS;
}

static tn_status note_items(const tn_variants *v, size_t count, tn_way_stop *stop, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        const tn_box *at = &v->items[i].at;
        status = tn_rectangles_add(&stop->items, (tn_rectangle){at->x0, at->x1, at->y0, at->y1}, error);
    }
    return status;
}

tn_status tn_tile_stop(const tn_house *house, uint32_t cell, uint32_t tile, const tn_tile_failure *failure,
                       tn_way_stop *stop, tn_error *error)
{
    tn_room room = {.house = house, .cell = cell};
    tn_variants v = {0};
    tn_placing p;
    size_t count = 0;
    bool good;
    *stop = (tn_way_stop){.way = tn_cell_way(house, cell)};
    tn_status status = enter(&room, error);
    if (status == TN_OK && !make_room(&v, house->form->module->TILE_records[tile].box_count))
        status = tn_fail_memory(error);
    if (status == TN_OK && turn(&room, tile, failure->side, &p)) {
        p.mirrored = failure->mirrored;
        p.stop = stop;
        status = try_to_stand(&p, &v, &count, &good, error);
    }
    if (status == TN_OK)
        status = note_items(&v, count, stop, error);
    tn_variants_clear(&v);
    leave(&room);
    return status;
}

/* What people need in the cells that the tile is for, the least of it. */
static int64_t least_way(const tn_house_form *form, uint32_t tile)
{
    int64_t least = form->record->way;
    for (uint32_t f = 0; f < tn_form_functions(form); f++) {
        int64_t own = tn_form_rule(form, f)->way;
        if (own > 0 && own < least && is_for(form, tile, f))
            least = own;
    }
    return least;
}

/* An empty room of a clear size, in which not more is known of ways than the tile itself says. */
static tn_room room_of(const tn_house *house, int64_t wide, int64_t deep, int64_t height, uint32_t tile)
{
    tn_room room = {.house = house, .clear = {0, wide, 0, deep}, .height = height};
    room.anywhere = tn_form_asks_ways(house->form);
    room.floor.way = least_way(house->form, tile);
    return room;
}

tn_status tn_tile_fails_in(const tn_house_form *form, int64_t wide, int64_t deep, int64_t height, uint32_t tile,
                           tn_tile_failure *failure, tn_error *error)
{
    const tn_house house = {.form = form};
    tn_room room = room_of(&house, wide, deep, height, tile);
    tn_status status = find_failure(&room, tile, failure, error);
    leave(&room);
    return status;
}

tn_status tn_tile_turned_in(const tn_house_form *form, int64_t wide, int64_t deep, int64_t height, uint32_t tile,
                            bool *stands_there, tn_error *error)
{
    const tn_house house = {.form = form};
    tn_room room = room_of(&house, wide, deep, height, tile);
    tn_variants v = {0};
    tn_placing p;
    size_t count;
    *stands_there = false;
    tn_status status = make_room(&v, form->module->TILE_records[tile].box_count) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && turn(&room, tile, TN_HOUSE_BACK, &p))
        status = try_to_stand(&p, &v, &count, stands_there, error);
    tn_variants_clear(&v);
    leave(&room);
    return status;
}

tn_status tn_tile_variants_in(const tn_house_form *form, int64_t wide, int64_t deep, int64_t height, uint32_t tile,
                              tn_variants *variants, tn_error *error)
{
    const tn_house house = {.form = form};
    tn_room room = room_of(&house, wide, deep, height, tile);
    tn_status status = TN_OK;
    *variants = (tn_variants){.wanted = true};
    for (size_t i = 0; status == TN_OK && i < sizeof all_sides / sizeof *all_sides; i++)
        status = try_side(&room, tile, all_sides[i], variants, error);
    leave(&room);
    return status;
}

tn_status tn_tile_variants(const tn_house *house, uint32_t cell, tn_variants *variants, tn_error *error)
{
    const tn_house_form *form = house->form;
    tn_room room = {.house = house, .cell = cell};
    tn_status status = TN_OK;
    *variants = (tn_variants){0};
    for (uint32_t t = 0; t < form->record->tile_count && status == TN_OK; t++) {
        uint32_t tile = form->record->tile_first + t;
        if (house->cells[cell].open || !is_for(form, tile, house->cells[cell].function))
            continue;
        if (!variants->wanted)
            status = enter(&room, error);
        variants->wanted = true;
        for (size_t i = 0; status == TN_OK && i < sizeof all_sides / sizeof *all_sides; i++)
            status = try_side(&room, tile, all_sides[i], variants, error);
    }
    leave(&room);
    return status;
}

void tn_variants_clear(tn_variants *variants)
{
    free(variants->variants);
    free(variants->items);
    *variants = (tn_variants){0};
}

void tn_variant_text(const tn_house_form *form, const tn_tile_variant *variant, char text[TN_VARIANT_TEXT])
{
    static const char *const sides[] = {"", "back", "front", "left", "right"};
    snprintf(text, TN_VARIANT_TEXT, "%s.%s%s", tn_text(form->module, form->module->TILE_records[variant->tile].name),
             sides[variant->side], variant->mirrored ? ".m" : "");
}

static bool is_too_high(const tn_house_form *form, const tn_tile_failure *failure)
{
    const tn_tile_box_record *box = &form->module->TILE_BOX_records[failure->box];
    return box->up_low >= failure->high || box->up_high > failure->high;
}

/* "it stands against wall or sash, and no side of the room is that" */
static void say_no_side(const tn_house_form *form, uint32_t tile, char *text, size_t size)
{
    const tn_module *module = form->module;
    const tn_tile_record *record = &module->TILE_records[tile];
    size_t used = (size_t)snprintf(text, size, "it stands against ");
    for (uint32_t i = 0; i < record->against_count && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%s",
                                 i == 0                           ? ""
                                 : i + 1 == record->against_count ? " or "
                                                                  : ", ",
                                 tn_form_kind_text(form, module->HOUSE_ITEM_records[record->against_first + i].number));
    if (used < size)
        snprintf(text + used, size - used, ", and no side of the room is that");
}

/* "where it comes furthest, no way leads through to the `door` at the left" */
static void say_no_way(const tn_house_form *form, const tn_tile_failure *failure, char *text, size_t size)
{
    static const char lead[] = "where it comes furthest, ";
    const tn_way_fault fault = {.fault = failure->obstacle == TN_TILE_SHUTS  ? TN_FLOOR_SHUT
                                         : failure->obstacle == TN_TILE_CUTS ? TN_FLOOR_APART
                                                                             : TN_FLOOR_LEAF,
                                .kind = failure->kind,
                                .side = failure->at};
    snprintf(text, size, "%s", lead);
    if (size > sizeof lead)
        tn_way_fault_text(form, &fault, text + sizeof lead - 1, size - (sizeof lead - 1));
}

void tn_tile_failure_text(const tn_house_form *form, uint32_t tile, const tn_tile_failure *failure,
                          tn_length_style style, char *text, size_t size)
{
    const tn_module *module = form->module;
    bool boxes = module->TILE_records[tile].box_count > 0;
    const char *box = boxes ? tn_text(module, module->TILE_BOX_records[failure->box].name) : "";
    char wide[64], deep[64], high[64];
    tn_length_write_style(failure->wide, style, wide, sizeof wide);
    tn_length_write_style(failure->deep, style, deep, sizeof deep);
    tn_length_write_style(failure->high, style, high, sizeof high);
    switch (failure->obstacle) {
    case TN_TILE_NO_SIDE:
        say_no_side(form, tile, text, size);
        return;
    case TN_TILE_SIZE:
        snprintf(text, size, "the room is %s wide and %s deep, and it asks for another size", wide, deep);
        return;
    case TN_TILE_BEYOND:
        if (is_too_high(form, failure))
            snprintf(text, size, "`%s` reaches higher than the room, which is %s high", box, high);
        else
            snprintf(text, size, "`%s` is not inside the room, which is %s wide and %s deep", box, wide, deep);
        return;
    case TN_TILE_MEETS_BOX:
        snprintf(text, size, "`%s` and `%s` are in each other's way", box,
                 tn_text(module, module->TILE_BOX_records[failure->other].name));
        return;
    case TN_TILE_MEETS_POST:
        snprintf(text, size, "`%s` meets a corner of thicker walls", box);
        return;
    case TN_TILE_MEETS_CLEAR:
        snprintf(text, size, "`%s` stands where an opening is kept clear", box);
        return;
    case TN_TILE_CLOSES_KEEP:
        snprintf(text, size, "where it comes furthest, no way leads to `%s`",
                 tn_text(module, module->TILE_BOX_records[failure->other].name));
        return;
    default:
        say_no_way(form, failure, text, size);
    }
}
