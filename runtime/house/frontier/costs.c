/* Tiles and costs: how many tiles fit in a cell, what the arrangements of a tray's tiles cost, and what houses cost
 * without them.
 *
 * ==== tiles that fit
 *
 * By what is in the faces of a cell and where walls meet at it: each combination is counted once. A cell is built again
 * by itself: its own faces, and short ends of the walls that make posts at its corners. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/frontier.h"
#include "runtime/house/frontier/states.h"
#include "runtime/house/schedule/cost.h"
#include "runtime/house/ways.h"

/* Words of a base: then come the functions of its cells, of which there are more than one if flights join them; then
 * faces. Words of a side: for each of the cells the number of its faces and of its posts, then these. */
enum {
    BASE_CELLS,
    BASE_STOREY,
    BASE_ZONE, /* if the roof above is in people's way; else NO_ZONE */
    BASE_WIDTH,
    BASE_Y0 = BASE_WIDTH + 2,
    BASE_Y1 = BASE_Y0 + 2,
    BASE_FUNCTIONS = BASE_Y1 + 2
};
enum { BASE_FACE_CELL, BASE_FACE_SIDE, BASE_FACE_KIND, BASE_FACE_WORDS };
enum { SIDE_FACES, SIDE_POSTS, SIDE_FIRST };
enum { SIDE_FACE_Y0, SIDE_FACE_Y1 = SIDE_FACE_Y0 + 2, SIDE_FACE_KIND = SIDE_FACE_Y1 + 2, SIDE_FACE_WORDS };
enum {
    FLOOR_X0,
    FLOOR_X1 = FLOOR_X0 + 2,
    FLOOR_Y0 = FLOOR_X1 + 2,
    FLOOR_Y1 = FLOOR_Y0 + 2,
    FLOOR_WORDS = FLOOR_Y1 + 2
};
enum { POST_Y, POST_THICK = POST_Y + 2, POST_WORDS };
enum { THICK_X = 1, THICK_Y = 2 };                                                     /* as thick as an outside wall */
enum { KIND_OUTER = 1, KIND_LEAF = 2, KIND_FLOOR = 4, KIND_BEYOND = 8, KIND_OF = 32 }; /* FLOOR: its words follow */
#define NO_ZONE UINT32_MAX

bool tn_frontier_fills(const tn_frontier *frontier, const tn_house *house, uint32_t cell)
{
    const tn_cell *c = &house->cells[cell];
    return !c->open && frontier->tiles.tiled[c->function] &&
           !(tn_form_asks_ways(frontier->form) && tn_flight_below(house, cell));
}

/* How many cells are filled together: those that flights join. */
static uint32_t cells_from(const tn_frontier *frontier, const tn_house *house, uint32_t cell)
{
    uint32_t count = 1;
    while (tn_form_asks_ways(frontier->form) && tn_flight_above(house, cell + count - 1))
        count++;
    return count;
}

/* What is in the face, as the cell sees it: without furniture, what nobody comes in by is a wall. */
static uint32_t kind_seen(const tn_frontier *frontier, const tn_cell *cell, const tn_face *face)
{
    const tn_opening_record *opening = tn_form_opening(frontier->form, face->kind);
    bool shut = face->relation == TN_FACE_OUTSIDE && face->storey > 0;
    bool plain = opening && (shut || !(opening->flags & TN_PASSAGE)) && !frontier->tiles.furnished[cell->function];
    return plain ? TN_FACE_WALL : face->kind;
}

/* Appends the word of a face, and with it the floor beyond if a flight may reach over to that; x from the cell's left.
 */
static bool push_face(tn_frontier *frontier, const tn_house *house, uint32_t index, uint32_t cell, bool flights,
                      tn_key *key)
{
    const tn_face *face = &house->faces[index];
    const tn_cell *c = &house->cells[cell];
    uint32_t kind = kind_seen(frontier, c, face), word = kind * KIND_OF + tn_face_is_outer(house, face);
    if (!tn_form_asks_ways(frontier->form))
        return tn_key_push(key, word);
    tn_face_view view = tn_face_seen(house, index, cell);
    bool open = face->kind == TN_FACE_OPEN, floor = flights && open && view.beyond == TN_BEYOND_BARE;
    word += KIND_BEYOND * (open || view.beyond != TN_BEYOND_BARE ? view.beyond : TN_BEYOND_FURNISHED);
    word += (view.leaf && kind != TN_FACE_WALL ? KIND_LEAF : 0) + (floor ? KIND_FLOOR : 0);
    return tn_key_push(key, word) &&
           (!floor || (tn_push_long(key, (uint64_t)(view.floor.x0 - c->at.x0)) &&
                       tn_push_long(key, (uint64_t)(view.floor.x1 - c->at.x0)) &&
                       tn_push_long(key, (uint64_t)view.floor.y0) && tn_push_long(key, (uint64_t)view.floor.y1)));
}

/* ---- of its own walls */

static bool push_own_faces(tn_frontier *frontier, const tn_house *house, uint32_t first, uint32_t count, tn_key *key)
{
    bool ok = true;
    for (uint32_t i = 0; ok && i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        for (uint32_t k = 0; ok && k < count; k++) {
            tn_house_side side = tn_face_side(face, first + k);
            bool flight = face->relation == TN_FACE_UNDER && face->first == first + k && k + 1 < count;
            if (flight)
                ok = tn_key_push(key, k) && tn_key_push(key, TN_HOUSE_ANY_SIDE) &&
                     tn_key_push(key, face->kind * KIND_OF);
            else if (side == TN_HOUSE_BACK || side == TN_HOUSE_FRONT)
                ok = tn_key_push(key, k) && tn_key_push(key, side) &&
                     push_face(frontier, house, i, first + k, count > 1, key);
        }
    }
    return ok;
}

/* Does an open roof above the cell leave too little headroom somewhere? */
static bool is_lowered(const tn_frontier *frontier, const tn_house *house, uint32_t cell)
{
    const tn_house_form *form = frontier->form;
    uint32_t storey = house->cells[cell].storey;
    return tn_form_asks_ways(form) && form->level[storey + 1] - form->level[storey] < form->record->headroom &&
           tn_cell_is_top(house, cell);
}

tn_status tn_frontier_fit_base(tn_frontier *frontier, const tn_house *house, uint32_t cell, uint32_t *base,
                               tn_error *error)
{
    const tn_cell *c = &house->cells[cell];
    uint32_t count = cells_from(frontier, house, cell), top = cell + count - 1;
    tn_key *key = &frontier->key;
    key->size = 0;
    bool ok = tn_key_push(key, count) && tn_key_push(key, c->storey) &&
              tn_key_push(key, is_lowered(frontier, house, top) ? c->zone : NO_ZONE) &&
              tn_push_long(key, (uint64_t)(c->at.x1 - c->at.x0)) && tn_push_long(key, (uint64_t)c->at.y0) &&
              tn_push_long(key, (uint64_t)c->at.y1);
    for (uint32_t k = 0; ok && k < count; k++)
        ok = tn_key_push(key, house->cells[cell + k].function);
    ok = ok && push_own_faces(frontier, house, cell, count, key);
    *base = ok ? tn_intern(&frontier->tiles.bases, key->data, key->size) : UINT32_MAX;
    return *base != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* ---- of a side */

static bool push_posts(const tn_house *house, const tn_cell *c, int64_t x, const tn_posts *posts, size_t head,
                       tn_key *key)
{
    int64_t wall = house->form->record->wall;
    bool ok = true;
    for (size_t i = 0; ok && i < posts->count; i++) {
        const tn_post *post = &posts->items[i];
        if (post->x != x || post->y < c->at.y0 || post->y > c->at.y1 || post->thick_x == 0 || post->thick_y == 0)
            continue;
        uint32_t thick = (post->thick_x == wall ? THICK_X : 0u) | (post->thick_y == wall ? THICK_Y : 0u);
        ok = tn_push_long(key, (uint64_t)post->y) && tn_key_push(key, thick);
        key->data[head + SIDE_POSTS]++;
    }
    return ok;
}

static bool push_side_faces(tn_frontier *frontier, const tn_house *house, uint32_t cell, int64_t x, bool flights,
                            size_t head, tn_key *key)
{
    bool ok = true;
    for (uint32_t i = 0; ok && i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (face->relation == TN_FACE_UNDER || face->at.x0 != x || face->at.x1 != x ||
            (face->first != cell && face->second != cell))
            continue;
        ok = tn_push_long(key, (uint64_t)face->at.y0) && tn_push_long(key, (uint64_t)face->at.y1) &&
             push_face(frontier, house, i, cell, flights, key);
        key->data[head + SIDE_FACES]++;
    }
    return ok;
}

tn_status tn_frontier_fit_side(tn_frontier *frontier, const tn_house *house, uint32_t cell, int64_t x,
                               const tn_posts *posts, uint32_t *fit, tn_error *error)
{
    uint32_t count = cells_from(frontier, house, cell);
    tn_key *key = &frontier->key;
    tn_status status = TN_OK;
    key->size = 0;
    for (uint32_t k = 0; status == TN_OK && k < count; k++) {
        const tn_cell *c = &house->cells[cell + k];
        tn_posts own = {0};
        size_t head = key->size;
        if (k > 0)
            status = tn_house_posts(house, c->storey, NULL, &own, error);
        if (status == TN_OK && !(tn_key_push(key, 0) && tn_key_push(key, 0) &&
                                 push_side_faces(frontier, house, cell + k, x, count > 1, head, key) &&
                                 push_posts(house, c, x, k > 0 ? &own : posts, head, key)))
            status = tn_fail_memory(error);
        free(own.items);
    }
    *fit = status == TN_OK ? tn_intern(&frontier->tiles.sides, key->data, key->size) : UINT32_MAX;
    return status == TN_OK && *fit == UINT32_MAX ? tn_fail_memory(error) : status;
}

/* ---- the cell by itself */

/* The house of a cell, or of those that flights join: they come first, then another, which has the ends of walls that
 * are not theirs. */
typedef struct tn_cells_alone {
    tn_house house;
    tn_face_view *views; /* [faces] */
    uint32_t cells;
} tn_cells_alone;

enum { CELL };

static tn_face_view *add(tn_cells_alone *alone, uint32_t first, tn_house_side side, uint32_t kind, tn_rectangle at)
{
    tn_house *house = &alone->house;
    bool outside = kind & KIND_OUTER;
    house->faces[house->face_count] = (tn_face){.first = first,
                                                .second = outside ? TN_NO_CELL : alone->cells,
                                                .relation = outside ? TN_FACE_OUTSIDE : TN_FACE_BESIDE,
                                                .side = side,
                                                .at = at,
                                                .storey = house->cells[first].storey,
                                                .kind = kind / KIND_OF};
    alone->views[house->face_count] = (tn_face_view){
        .beyond = (tn_beyond)(kind / KIND_BEYOND % (KIND_OF / KIND_BEYOND)), .leaf = (kind & KIND_LEAF) != 0};
    return &alone->views[house->face_count++];
}

/* Reads the floor that follows the word of a face, if one does. Returns where the next word is. */
static const uint32_t *read_floor(uint32_t kind, const uint32_t *words, tn_face_view *view)
{
    if (!(kind & KIND_FLOOR))
        return words;
    view->floor = (tn_rectangle){(int64_t)tn_both(words + FLOOR_X0), (int64_t)tn_both(words + FLOOR_X1),
                                 (int64_t)tn_both(words + FLOOR_Y0), (int64_t)tn_both(words + FLOOR_Y1)};
    return words + FLOOR_WORDS;
}

/* A short end of a wall, as thick as an outside wall or a partition. */
static void add_end(tn_cells_alone *alone, uint32_t storey, bool thick, tn_rectangle at)
{
    add(alone, alone->cells, TN_HOUSE_BACK, TN_FACE_WALL * KIND_OF + (thick ? KIND_OUTER : 0), at);
    alone->house.faces[alone->house.face_count - 1].storey = storey;
}

static void add_side(const tn_frontier *frontier, tn_cells_alone *alone, uint32_t side, bool left)
{
    size_t size;
    const uint32_t *words = tn_interned(&frontier->tiles.sides, side, &size);
    int64_t x = left ? alone->house.cells[CELL].at.x0 : alone->house.cells[CELL].at.x1, away = left ? -1 : 1;
    for (uint32_t k = 0; k < alone->cells; k++) {
        uint32_t faces = words[SIDE_FACES], posts = words[SIDE_POSTS], storey = alone->house.cells[k].storey;
        for (words += SIDE_FIRST; faces > 0; faces--) {
            int64_t y0 = (int64_t)tn_both(words + SIDE_FACE_Y0), y1 = (int64_t)tn_both(words + SIDE_FACE_Y1);
            uint32_t kind = words[SIDE_FACE_KIND];
            tn_face_view *view =
                add(alone, k, left ? TN_HOUSE_LEFT : TN_HOUSE_RIGHT, kind, (tn_rectangle){x, x, y0, y1});
            words = read_floor(kind, words + SIDE_FACE_WORDS, view);
        }
        for (; posts > 0; posts--, words += POST_WORDS) {
            int64_t y = (int64_t)tn_both(words + POST_Y);
            add_end(alone, storey, words[POST_THICK] & THICK_X, (tn_rectangle){x, x, y, y});
            add_end(alone, storey, words[POST_THICK] & THICK_Y,
                    left ? (tn_rectangle){x + away, x, y, y} : (tn_rectangle){x, x + away, y, y});
        }
    }
}

static void add_own(tn_cells_alone *alone, const uint32_t *words, const uint32_t *end)
{
    tn_house *house = &alone->house;
    tn_rectangle at = house->cells[CELL].at;
    while (words < end) {
        uint32_t cell = words[BASE_FACE_CELL], side = words[BASE_FACE_SIDE], kind = words[BASE_FACE_KIND];
        int64_t y = side == TN_HOUSE_BACK ? at.y0 : at.y1;
        tn_face_view *view = add(alone, cell, (tn_house_side)side, kind, (tn_rectangle){at.x0, at.x1, y, y});
        if (side == TN_HOUSE_ANY_SIDE) {
            tn_face *face = &house->faces[house->face_count - 1];
            face->relation = TN_FACE_UNDER;
            face->second = cell + 1;
            face->at = at;
        }
        words = read_floor(kind, words + BASE_FACE_WORDS, view);
    }
}

static void add_cells(tn_cells_alone *alone, const uint32_t *words)
{
    tn_house *house = &alone->house;
    tn_cell cell = {.zone = words[BASE_ZONE],
                    .at = {0, (int64_t)tn_both(words + BASE_WIDTH), (int64_t)tn_both(words + BASE_Y0),
                           (int64_t)tn_both(words + BASE_Y1)}};
    for (uint32_t k = 0; k <= alone->cells; k++) {
        house->cells[k] = cell;
        house->cells[k].tray = k == alone->cells;
        house->cells[k].storey = words[BASE_STOREY] + (k == alone->cells ? 0 : k);
        house->cells[k].function = k == alone->cells ? TN_NO_FUNCTION : words[BASE_FUNCTIONS + k];
    }
}

static void clear_alone(tn_cells_alone *alone)
{
    free(alone->house.cells);
    free(alone->house.faces);
    free(alone->views);
}

static tn_status build(const tn_frontier *frontier, uint32_t base, uint32_t left, uint32_t right, tn_cells_alone *alone,
                       tn_error *error)
{
    size_t size, sides[2];
    const uint32_t *words = tn_interned(&frontier->tiles.bases, base, &size);
    tn_interned(&frontier->tiles.sides, left, &sides[0]);
    tn_interned(&frontier->tiles.sides, right, &sides[1]);
    size_t faces = size + sides[0] + sides[1] + 1;
    *alone = (tn_cells_alone){.cells = words[BASE_CELLS]};
    alone->house = (tn_house){.form = frontier->form, .length = 1, .cell_count = (size_t)alone->cells + 1};
    memcpy(alone->house.shapes, frontier->shapes, frontier->form->record->choice_count * sizeof *frontier->shapes);
    alone->house.cells = calloc(alone->house.cell_count, sizeof *alone->house.cells);
    alone->house.faces = calloc(faces, sizeof *alone->house.faces);
    alone->views = calloc(faces, sizeof *alone->views);
    if (!alone->house.cells || !alone->house.faces || !alone->views)
        return tn_fail_memory(error);
    alone->house.views = alone->views;
    add_cells(alone, words);
    add_own(alone, words + BASE_FUNCTIONS + alone->cells, words + size);
    add_side(frontier, alone, left, true);
    add_side(frontier, alone, right, false);
    return TN_OK;
}

/* The tiles that fit; of a cell without tiles one without items, if it is as it has to be. */
static tn_status find_tiles(const tn_cells_alone *alone, tn_variants *tiles, tn_error *error)
{
    size_t count = 0;
    tn_status status = tn_tile_variants(&alone->house, CELL, tiles, error);
    if (status != TN_OK || tiles->wanted)
        return status;
    status = tn_cell_fillings(&alone->house, CELL, &count, error);
    tiles->variants = status == TN_OK ? calloc(1, sizeof *tiles->variants) : NULL;
    tiles->items = status == TN_OK ? calloc(1, sizeof *tiles->items) : NULL;
    tiles->count = count;
    return status == TN_OK && !(tiles->variants && tiles->items) ? tn_fail_memory(error) : status;
}

tn_status tn_frontier_fit(tn_frontier *frontier, uint32_t base, uint32_t left, uint32_t right, uint32_t *tiles,
                          tn_error *error)
{
    uint32_t before = frontier->tiles.fit_keys[1].count;
    uint32_t at = tn_number(&frontier->tiles.fit_keys[0], (uint64_t)base << 32 | left);
    at = at == UINT32_MAX ? at : tn_number(&frontier->tiles.fit_keys[1], (uint64_t)at << 32 | right);
    if (at == UINT32_MAX ||
        !tn_array_reserve(&frontier->tiles.fits, &frontier->tiles.fit_room, before, 1, sizeof *frontier->tiles.fits))
        return tn_fail_memory(error);
    if (at < before) {
        *tiles = frontier->tiles.fits[at];
        return TN_OK;
    }
    tn_cells_alone alone;
    tn_variants variants = {0};
    tn_status status = build(frontier, base, left, right, &alone, error);
    if (status == TN_OK)
        status = find_tiles(&alone, &variants, error);
    *tiles = (uint32_t)variants.count;
    if (status == TN_OK && frontier->prices.items)
        status = tn_frontier_list_tiles(frontier, &alone.house, &variants, tiles, error);
    frontier->tiles.fits[at] = *tiles;
    tn_variants_clear(&variants);
    clear_alone(&alone);
    return status;
}

void tn_frontier_tiles_clear(tn_frontier_tiles *tiles)
{
    free(tiles->tiled);
    free(tiles->furnished);
    tn_interner_clear(&tiles->bases);
    tn_interner_clear(&tiles->sides);
    tn_numbering_clear(&tiles->fit_keys[0]);
    tn_numbering_clear(&tiles->fit_keys[1]);
    free(tiles->fits);
    tn_interner_clear(&tiles->lists);
    tn_interner_clear(&tiles->pending);
    tn_frontier_known_clear(&tiles->arrangements);
    tn_frontier_known_clear(&tiles->pending_of);
}

/* ==== sums
 *
 * Sums of the tiles of a tray: how many arrangements cost how much. If tiles have no prices, that is one number. */

/* ---- sums at hand: of the tiles so far */

static int compare_sums(const void *a, const void *b)
{
    const tn_frontier_sum *p = a, *q = b;
    return (p->cost > q->cost) - (p->cost < q->cost);
}

/* Sums of the same cost become one. False: there are more than 2^64 arrangements. */
static bool join_sums(tn_frontier_sum *sums, size_t *count)
{
    size_t kept = 0;
    bool ok = true;
    qsort(sums, *count, sizeof *sums, compare_sums);
    for (size_t i = 0; ok && i < *count; i++) {
        if (kept > 0 && sums[kept - 1].cost == sums[i].cost)
            ok = !__builtin_add_overflow(sums[kept - 1].times, sums[i].times, &sums[kept - 1].times);
        else
            sums[kept++] = sums[i];
    }
    *count = kept;
    return ok;
}

/* Adds each tile of a list to each of the sums. */
static tn_status add_list(tn_frontier *frontier, uint32_t list, tn_error *error)
{
    tn_frontier_sums *s = &frontier->sums;
    const tn_int128 *steps = frontier->prices.steps;
    size_t words, count = 0;
    const uint32_t *added = tn_interned(&frontier->prices.lists, list, &words);
    bool ok = true;
    if (!tn_array_reserve(&s->more, &s->more_room, 0, s->count * (words / 2) + 1, sizeof *s->more))
        return tn_fail_memory(error);
    for (size_t i = 0; i < s->count; i++)
        for (size_t w = 0; ok && w < words; w += 2) {
            tn_frontier_sum sum = {s->items[i].cost + (steps ? steps[added[w]] : 0), 0};
            ok = !__builtin_mul_overflow(s->items[i].times, (uint64_t)added[w + 1], &sum.times);
            s->more[count++] = sum;
        }
    if (count > 0)
        ok = ok && join_sums(s->more, &count);
    tn_frontier_sum *items = s->items;
    size_t room = s->room;
    s->items = s->more;
    s->room = s->more_room;
    s->more = items;
    s->more_room = room;
    s->count = count;
    return ok ? TN_OK : tn_frontier_limit(frontier, NULL, "a tray has more than 2^64 arrangements of tiles", error);
}

/* Adds the tiles of a cell: `fit` as of tn_frontier_fit. */
static tn_status add_tiles(tn_frontier *frontier, uint32_t fit, tn_error *error)
{
    tn_frontier_sums *s = &frontier->sums;
    if (frontier->prices.items)
        return add_list(frontier, fit, error);
    s->count = fit > 0;
    if (__builtin_mul_overflow(s->items[0].times, (uint64_t)fit, &s->items[0].times))
        return tn_frontier_limit(frontier, NULL, "a tray has more than 2^64 arrangements of tiles", error);
    return TN_OK;
}

static tn_status begin(tn_frontier *frontier, tn_error *error)
{
    tn_frontier_sums *s = &frontier->sums;
    if (!tn_array_reserve(&s->items, &s->room, 0, 1, sizeof *s->items))
        return tn_fail_memory(error);
    s->items[0] = (tn_frontier_sum){0, 1};
    s->count = 1;
    return TN_OK;
}

/* The tiles of the left slice: no sum if one of its cells has none. */
static tn_status multiply(tn_frontier *frontier, uint32_t pending, uint32_t sides, tn_error *error)
{
    size_t count, cells;
    const uint32_t *words = tn_interned(&frontier->tiles.pending, pending, &count);
    const uint32_t *fits = tn_interned(&frontier->tiles.lists, sides, &cells);
    tn_status status = begin(frontier, error);
    for (size_t i = 0; status == TN_OK && frontier->sums.count > 0 && i < count; i += PENDING_WORDS) {
        uint32_t fit = 0;
        const tn_frontier_one *one = &frontier->merged.one[words[i + PENDING_CLASS]];
        status = tn_frontier_fit(frontier, one->base, one->left, fits[words[i + PENDING_CELL]] - 1, &fit, error);
        if (status == TN_OK)
            status = add_tiles(frontier, frontier->prices.items ? fit : fit / one->factor, error);
    }
    return status;
}

/* ---- how many, without prices */

tn_status tn_frontier_end_pending(tn_frontier *frontier, uint32_t pending, uint32_t left_fits, uint64_t *times,
                                  tn_error *error)
{
    uint32_t *result;
    bool met;
    tn_status status = tn_frontier_known_at(&frontier->tiles.arrangements, pending, left_fits, 2, &result, &met, error);
    if (status == TN_OK && !met) {
        status = multiply(frontier, pending, left_fits, error);
        uint64_t found = status == TN_OK && frontier->sums.count > 0 ? frontier->sums.items[0].times : 0;
        result[0] = tn_low(found);
        result[1] = tn_high(found);
    }
    *times = status == TN_OK ? tn_both(result) : 0;
    return status;
}

/* ---- sums that are kept: the same tiles come with many totals */

enum { KEPT_FIRST, KEPT_COUNT, KEPT_WORDS };
enum { KEPT_MAX = 1 << 21 }; /* sums: 64 MB */

static tn_status keep(tn_frontier_sums *s, uint32_t result[KEPT_WORDS], tn_error *error)
{
    if (s->kept_count + s->count > KEPT_MAX)
        return TN_OK;
    if (!tn_array_reserve(&s->kept, &s->kept_room, s->kept_count, s->count, sizeof *s->kept))
        return tn_fail_memory(error);
    memcpy(s->kept + s->kept_count, s->items, s->count * sizeof *s->kept);
    result[KEPT_FIRST] = (uint32_t)s->kept_count;
    result[KEPT_COUNT] = (uint32_t)s->count;
    s->kept_count += s->count;
    return TN_OK;
}

static tn_status find_kept(tn_frontier *frontier, uint32_t pending, uint32_t left_fits, tn_error *error)
{
    tn_frontier_sums *s = &frontier->sums;
    uint32_t *result;
    bool met;
    tn_status status = tn_frontier_known_at(&s->places, pending, left_fits, KEPT_WORDS, &result, &met, error);
    if (status == TN_OK && !met)
        result[KEPT_FIRST] = TN_FRONTIER_NONE; /* not kept, as long as nothing else is known */
    bool kept = status == TN_OK && result[KEPT_FIRST] != TN_FRONTIER_NONE;
    if (status == TN_OK && !kept)
        status = multiply(frontier, pending, left_fits, error);
    if (status == TN_OK && !met)
        status = keep(s, result, error);
    s->found = kept ? s->kept + result[KEPT_FIRST] : s->items;
    s->found_count = kept ? result[KEPT_COUNT] : s->count;
    return status;
}

tn_status tn_frontier_sum_tiles(tn_frontier *frontier, uint32_t pending, uint32_t left_fits, tn_error *error)
{
    tn_frontier_sums *s = &frontier->sums;
    if (frontier->prices.items && frontier->prices.steps)
        return find_kept(frontier, pending, left_fits, error);
    uint64_t times = 1;
    tn_status status = frontier->prices.items ? multiply(frontier, pending, left_fits, error)
                                              : tn_frontier_end_pending(frontier, pending, left_fits, &times, error);
    if (status == TN_OK && !frontier->prices.items)
        status = tn_frontier_sum_one(frontier, times, error);
    s->found = s->items;
    s->found_count = s->count;
    return status;
}

tn_status tn_frontier_sum_one(tn_frontier *frontier, uint64_t times, tn_error *error)
{
    tn_frontier_sums *s = &frontier->sums;
    tn_status status = begin(frontier, error);
    if (status != TN_OK)
        return status;
    s->items[0].times = times;
    s->count = s->found_count = times > 0;
    s->found = s->items;
    return TN_OK;
}

void tn_frontier_sums_clear(tn_frontier_sums *sums)
{
    free(sums->items);
    free(sums->more);
    free(sums->kept);
    tn_frontier_known_clear(&sums->places);
}

/* ==== prices
 *
 * What houses cost, in parts that add up: each tray by itself, between plain walls at its sides, and what
 * stands in each interface between two trays, which is the difference to that.
 *
 * Such parts know all that there is as long as nothing reaches over a whole tray: what a wall, a deck or a roof is at a
 * interface depends on the trays at both of its sides alone. If that is not so, costs are not counted (E1685). */

/* ---- which costs can be counted so */

enum {
    BY_NUMBER = 1u << TN_PER_EACH,
    BY_VOLUME = 1u << TN_PER_CUBIC_FOOT | 1u << TN_PER_CUBIC_METRE,
    BY_ANY = BY_NUMBER | 1u << TN_PER_SQUARE_FOOT | 1u << TN_PER_SQUARE_METRE | BY_VOLUME
};

/* Has a part a price of such a kind, in any section? */
static bool is_priced(const tn_house_form *form, uint32_t part, uint32_t by)
{
    for (uint32_t i = 0; i < form->record->material_count; i++) {
        const tn_material_record *material = &form->module->MATERIAL_records[form->record->material_first + i];
        for (uint32_t p = 0; p < material->part_count && by >> material->unit & 1; p++)
            if (form->module->HOUSE_ITEM_records[material->part_first + p].number == part)
                return true;
    }
    return false;
}

/* The same of the layers of what is built, by what a material is for. */
static bool are_layers_priced(const tn_house_form *form, tn_material_part built, uint32_t by)
{
    static const tn_material_part kinds[TN_LAYERED_COUNT] = {[TN_LAYERED_OUTSIDE] = TN_OF_WALL,
                                                             [TN_LAYERED_PARTY] = TN_OF_PARTY,
                                                             [TN_LAYERED_PARTITION] = TN_OF_PARTITION,
                                                             [TN_LAYERED_DECK] = TN_OF_DECK,
                                                             [TN_LAYERED_ROOF] = TN_OF_ROOF};
    bool priced = false;
    for (uint32_t i = 0; !priced && i < form->record->layer_count; i++)
        priced = kinds[tn_form_layer(form, i)->of] == built && is_priced(form, tn_layer_part(form, i), by);
    return priced;
}

static bool is_built_priced(const tn_house_form *form, tn_material_part built, uint32_t by)
{
    return is_priced(form, built, by) || are_layers_priced(form, built, by);
}

static bool are_walls_priced(const tn_house_form *form, uint32_t by)
{
    return is_built_priced(form, TN_OF_WALL, by) || is_built_priced(form, TN_OF_PARTY, by) ||
           is_built_priced(form, TN_OF_PARTITION, by);
}

/* The same of beams, and of what they take the place of. */
static bool are_beams_priced(const tn_house_form *form)
{
    bool priced = are_walls_priced(form, BY_ANY) || is_priced(form, TN_OF_POST, BY_ANY);
    for (uint32_t i = 0; !priced && i < form->record->beam_count; i++)
        priced = is_priced(form, tn_form_guard_part(form) + 1 + i, BY_ANY);
    return priced;
}

/* The same of roofs, and of the walls below them, which have the layers of party walls above these. */
static bool are_roofs_priced(const tn_house_form *form)
{
    return is_built_priced(form, TN_OF_ROOF, BY_ANY) || is_built_priced(form, TN_OF_WALL, BY_ANY) ||
           are_layers_priced(form, TN_OF_PARTY, BY_ANY);
}

static bool are_items_priced(const tn_house_form *form)
{
    for (uint32_t part = tn_form_openings_part(form) + form->record->opening_count; part < tn_form_guard_part(form); part++)
        if (is_priced(form, part, BY_ANY))
            return true;
    return false;
}

/* The zones' roofs of the section. */
typedef struct tn_roofs {
    bool across, hip;
    int64_t eaves; /* the widest */
} tn_roofs;

static tn_roofs roofs_of(const tn_frontier *frontier)
{
    tn_house section = {.form = frontier->form};
    tn_roofs roofs = {0};
    memcpy(section.shapes, frontier->shapes, frontier->form->record->choice_count * sizeof *section.shapes);
    for (uint32_t z = 0; z < frontier->form->zone_count; z++) {
        const tn_shape_record *shape = tn_house_shape(&section, frontier->form->zones[z], TN_CHOICE_ROOF);
        roofs.across =
            roofs.across || (shape && (shape->flags & TN_ROOF_ACROSS || shape->roof == TN_ROOF_CROSS_GABLE));
        roofs.hip = roofs.hip || (shape && shape->roof == TN_ROOF_HIP);
        roofs.eaves = shape && shape->eaves > roofs.eaves ? shape->eaves : roofs.eaves;
    }
    return roofs;
}

static tn_status refuse(const tn_frontier *frontier, const char *why, const char *help, tn_error *error)
{
    const tn_house_added *added = frontier->added;
    uint32_t k = 0;
    while (mpq_sgn(added->of[k]->cost) == 0)
        k++;
    tn_fail(error, TN_LIMIT, E_COST_OF_ALL, "the costs that `%.60s` adds up cannot be counted: %s",
            tn_text(frontier->form->module, added->of[k]->of.name), why);
    tn_error_help(error, "%s", help);
    return TN_LIMIT;
}

static tn_status check_widths(const tn_frontier *frontier, const tn_roofs *roofs, const bool *trays, tn_error *error)
{
    const tn_house_form *form = frontier->form;
    int64_t wall = form->record->wall > form->record->partition ? form->record->wall : form->record->partition;
    int64_t reach = wall + (is_built_priced(form, TN_OF_ROOF, BY_ANY) ? 2 * roofs->eaves : 0);
    for (tn_tray t = 0; frontier->trays_most > 1 && t < form->schema->tray_count; t++)
        if (trays[t] && tn_tray_value_record(form->schema, t, form->width)->length < reach)
            return refuse(frontier, "a tray is narrower than the walls and eaves at its sides together",
                          "make the eaves or the walls of the form narrower, or leave out the narrow trays", error);
    return TN_OK;
}

/* Does an opening take the whole height of a storey? */
static bool is_full(const tn_house_form *form, const tn_opening_record *opening)
{
    for (uint32_t k = 0; opening->turn == TN_TURN_NONE && k < form->record->storey_count; k++)
        if (opening->sill == 0 && opening->high == tn_form_clear(form, k))
            return true;
    return false;
}

static tn_status check_openings(const tn_frontier *frontier, tn_error *error)
{
    const tn_house_form *form = frontier->form;
    bool walls = are_walls_priced(form, BY_NUMBER);
    if (form->record->guard > 0 && is_priced(form, tn_form_guard_part(form), BY_ANY))
        return refuse(frontier, "where guards stand depends on all trays around a flight or a void",
                      "give guards no price, or ask nothing about costs", error);
    if (form->record->beam_count > 0 && are_beams_priced(form))
        return refuse(frontier, "where beams stand, in the place of what, depends on all trays along a wall",
                      "ask about single houses, whose costs have them, or leave the lines `beam` out to count", error);
    for (uint32_t i = 0; i < form->record->opening_count; i++) {
        const tn_opening_record *opening = &form->module->OPENING_records[form->record->opening_first + i];
        if (walls && is_full(form, opening))
            return refuse(frontier, "an opening can leave nothing of a wall, and walls have a price each",
                          "give the price of walls per area, or per volume", error);
        if (opening->turn != TN_TURN_NONE && is_built_priced(form, TN_OF_DECK, BY_NUMBER))
            return refuse(frontier, "flights cut floors in pieces, and these have a price each",
                          "give the price of floors per area, or per volume", error);
        if (opening->turn == TN_TURN_QUARTER && tn_form_asks_ways(form) && is_built_priced(form, TN_OF_DECK, BY_ANY))
            return refuse(frontier, "how large the hole above a flight that turns a quarter is depends on its place",
                          "give floors no price, or ask nothing about costs", error);
        if (opening->turn == TN_TURN_QUARTER && is_priced(form, tn_form_openings_part(form) + i, BY_VOLUME))
            return refuse(frontier, "a flight that turns a quarter has a price per volume",
                          "give its price per area, or for each", error);
    }
    return TN_OK;
}

tn_status tn_frontier_prices_begin(tn_frontier *frontier, tn_error *error)
{
    tn_frontier_prices *p = &frontier->prices;
    for (uint32_t k = 0; k < frontier->added->count; k++)
        p->asked = p->asked || mpq_sgn(frontier->added->of[k]->cost) != 0;
    if (!p->asked)
        return TN_OK;
    p->items = are_items_priced(frontier->form);
    p->across = roofs_of(frontier).across && are_roofs_priced(frontier->form);
    const uint32_t none = 0; /* the first list is that of a cell in which nothing fits */
    return tn_intern(&p->lists, &none, 0) == UINT32_MAX ? tn_fail_memory(error) : TN_OK;
}

tn_status tn_frontier_prices_check(const tn_frontier *frontier, const bool *trays, tn_error *error)
{
    tn_roofs roofs = roofs_of(frontier);
    if (roofs.hip && are_roofs_priced(frontier->form))
        return refuse(frontier, "the options have a hip roof, whose ends are cut off as far as the whole row says",
                      "keep houses without: `prune option(...)`", error);
    if (frontier->prices.across && roofs.eaves > 0)
        return refuse(frontier, "the options have eaves, and a roof that goes `across`",
                      "keep houses that have only one of both: `prune option(...)`", error);
    tn_status status = check_widths(frontier, &roofs, trays, error);
    return status == TN_OK ? check_openings(frontier, error) : status;
}

void tn_frontier_prices_clear(tn_frontier_prices *p)
{
    for (uint32_t i = 0; i < p->numbers.count; i++)
        mpq_clear(p->exact[i]);
    tn_interner_clear(&p->numbers);
    tn_interner_clear(&p->alone.keys);
    tn_interner_clear(&p->interfaces.keys);
    tn_interner_clear(&p->shapes);
    tn_interner_clear(&p->lists);
    free(p->exact);
    free(p->steps);
    free(p->alone.costs);
    free(p->interfaces.costs);
    free(p->key.data);
}

/* ---- exact costs, numbered */

static bool push_integer(tn_key *key, const mpz_t number)
{
    size_t words = (mpz_sizeinbase(number, 2) + 31) / 32, written = 0;
    bool ok = tn_key_push(key, (uint32_t)(mpz_sgn(number) + 1)) && tn_key_push(key, (uint32_t)words);
    size_t first = key->size;
    for (size_t i = 0; ok && i < words; i++)
        ok = tn_key_push(key, 0);
    if (ok)
        mpz_export(key->data + first, &written, -1, sizeof *key->data, 0, 0, number);
    return ok;
}

tn_status tn_frontier_cost_number(tn_frontier *frontier, const mpq_t cost, uint32_t *number, tn_error *error)
{
    tn_frontier_prices *p = &frontier->prices;
    uint32_t before = p->numbers.count;
    p->key.size = 0;
    bool ok = push_integer(&p->key, mpq_numref(cost)) && push_integer(&p->key, mpq_denref(cost)) &&
              tn_array_reserve(&p->exact, &p->room, before, 1, sizeof *p->exact);
    *number = ok ? tn_intern(&p->numbers, p->key.data, p->key.size) : UINT32_MAX;
    if (*number == UINT32_MAX)
        return tn_fail_memory(error);
    if (*number < before)
        return TN_OK;
    mpq_init(p->exact[before]);
    mpq_set(p->exact[before], cost);
    return TN_OK;
}

void tn_frontier_cost_unit(const tn_frontier *frontier, mpq_t unit)
{
    mpq_t cost;
    mpq_init(cost);
    for (uint32_t i = 0; i < frontier->prices.numbers.count; i++) {
        mpq_abs(cost, frontier->prices.exact[i]);
        tn_common_unit(unit, cost);
    }
    mpq_clear(cost);
}

tn_status tn_frontier_settle(tn_frontier *frontier, const tn_frontier_units *units, tn_error *error)
{
    tn_frontier_prices *p = &frontier->prices;
    p->steps = calloc((size_t)p->numbers.count + 1, sizeof *p->steps);
    frontier->units = units;
    if (!p->steps)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < p->numbers.count; i++)
        if (!tn_steps_of(p->exact[i], units->cost, &p->steps[i]))
            return tn_too_fine(error);
    return TN_OK;
}

/* ---- trays */

/* The number of the house's cost without what stands in its rooms, less what trays to the left and right of an
 * interface cost by themselves (NULL: nothing is taken off), by the key at hand: it is found once. */
static tn_status keyed_cost(tn_frontier *frontier, tn_frontier_keyed *known, const tn_house *house,
                            const tn_frontier_edge *left, const tn_frontier_edge *right, uint32_t *number,
                            tn_error *error)
{
    tn_frontier_prices *p = &frontier->prices;
    uint32_t before = known->keys.count;
    bool ok = tn_array_reserve(&known->costs, &known->room, before, 1, sizeof *known->costs);
    uint32_t at = ok ? tn_intern(&known->keys, p->key.data, p->key.size) : UINT32_MAX;
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    if (at == before) {
        mpq_t cost;
        tn_house part = *house;
        part.ways_unknown = true; /* flights cost the same in all their places */
        mpq_init(cost);
        status = tn_house_exact_cost(&part, tn_house_shell, cost, error);
        if (left)
            mpq_sub(cost, cost, p->exact[left->cost]);
        if (right)
            mpq_sub(cost, cost, p->exact[right->cost]);
        if (status == TN_OK)
            status = tn_frontier_cost_number(frontier, cost, &known->costs[at], error);
        mpq_clear(cost);
    }
    *number = known->costs[at];
    return status;
}

/* Is what stands in the face an outside wall, and which of its cells is indoors? */
static bool push_shelter(const tn_house *house, const tn_face *face, tn_key *key)
{
    enum { FIRST = 1, OUTER = 2 };
    bool outer = tn_face_is_outer(house, face), first = outer && tn_face_sheltered(house, face) == face->first;
    return tn_key_push(key, (outer ? OUTER : 0u) | (first ? FIRST : 0u));
}

tn_status tn_frontier_tray_cost(tn_frontier *frontier, const tn_house *house, uint32_t *number, tn_error *error)
{
    tn_frontier_prices *p = &frontier->prices;
    p->key.size = 0;
    bool ok = tn_key_push(&p->key, house->trays[0]);
    for (size_t i = 0; ok && i < house->face_count; i++)
        if (tn_face_is_inner(&house->faces[i]))
            ok = tn_key_push(&p->key, house->faces[i].kind) && push_shelter(house, &house->faces[i], &p->key);
    return ok ? keyed_cost(frontier, &p->alone, house, NULL, NULL, number, error) : tn_fail_memory(error);
}

/* Is there no floor above the face? */
static bool is_hole(const tn_face *face)
{
    return face->relation == TN_FACE_UNDER && (face->kind == TN_FACE_STAIR || face->kind == TN_FACE_OPEN);
}

bool tn_frontier_push_shape(const tn_frontier *frontier, const tn_house *house, tn_key *key)
{
    int64_t width = tn_tray_value_record(frontier->form->schema, house->trays[0], frontier->form->width)->length;
    bool ok = tn_push_long(key, frontier->prices.across ? (uint64_t)width : 0);
    for (size_t i = 0; ok && i < house->cell_count; i++) {
        const tn_cell *cell = &house->cells[i];
        ok = tn_push_long(key, (uint64_t)cell->at.y0) && tn_push_long(key, (uint64_t)cell->at.y1) &&
             tn_key_push(key, cell->storey << 2 | (uint32_t)tn_cell_is_outdoor(house, (uint32_t)i) << 1 | cell->open) &&
             tn_key_push(key, cell->zone);
    }
    for (size_t i = 0; ok && i < house->face_count; i++)
        if (house->faces[i].relation == TN_FACE_UNDER)
            ok = tn_key_push(key, is_hole(&house->faces[i]));
    return ok;
}

/* ---- interfaces */

tn_status tn_frontier_interface_cost(tn_frontier *frontier, const tn_frontier_border *border, const tn_house *house,
                                     uint32_t *number, tn_error *error)
{
    tn_frontier_prices *p = &frontier->prices;
    p->key.size = 0;
    bool ok = tn_key_push(&p->key, border->left ? border->left->shape : TN_FRONTIER_NONE) &&
              tn_key_push(&p->key, border->right ? border->right->shape : TN_FRONTIER_NONE);
    for (size_t i = 0; ok && i < border->count; i++)
        ok = tn_key_push(&p->key, house->faces[border->faces[i]].kind);
    return ok ? keyed_cost(frontier, &p->interfaces, house, border->left, border->right, number, error)
              : tn_fail_memory(error);
}

/* ---- tiles */

/* {cost, how many} of each cost, from the cost of each. */
static bool push_list(tn_key *key, uint32_t *costs, size_t count)
{
    bool ok = true;
    key->size = 0;
    if (count > 0)
        qsort(costs, count, sizeof *costs, tn_words_compare);
    for (size_t i = 0, end; ok && i < count; i = end) {
        for (end = i; end < count && costs[end] == costs[i];)
            end++;
        ok = tn_key_push(key, costs[i]) && tn_key_push(key, (uint32_t)(end - i));
    }
    return ok;
}

tn_status tn_frontier_list_tiles(tn_frontier *frontier, const tn_house *house, const tn_variants *variants,
                                 uint32_t *list, tn_error *error)
{
    tn_frontier_prices *p = &frontier->prices;
    uint32_t *costs = malloc((variants->count + 1) * sizeof *costs);
    mpq_t cost;
    mpq_init(cost);
    tn_status status = costs ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < variants->count; i++) {
        const tn_tile_variant *variant = &variants->variants[i];
        tn_house_items_cost(house, variants->items + variant->item_first, variant->item_count, cost);
        status = tn_frontier_cost_number(frontier, cost, &costs[i], error);
    }
    if (status == TN_OK) {
        bool ok = push_list(&p->key, costs, variants->count);
        *list = ok ? tn_intern(&p->lists, p->key.data, p->key.size) : UINT32_MAX;
        status = *list != UINT32_MAX ? TN_OK : tn_fail_memory(error);
    }
    mpq_clear(cost);
    free(costs);
    return status;
}
