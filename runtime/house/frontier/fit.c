/* Counts the tiles that fit in a cell, by what is in its faces and where walls meet at it: each combination once.
 *
 * A cell is built again by itself: its own faces, and short ends of the walls that make posts at its corners. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/parts.h"

enum {
    BASE_FUNCTION,
    BASE_STOREY,
    BASE_WIDTH,
    BASE_Y0 = BASE_WIDTH + 2,
    BASE_Y1 = BASE_Y0 + 2,
    BASE_FACES = BASE_Y1 + 2
};
enum { BASE_FACE_SIDE, BASE_FACE_KIND, BASE_FACE_WORDS };
enum { SIDE_FACES, SIDE_FIRST };
enum { FACE_KIND, FACE_Y0, FACE_Y1 = FACE_Y0 + 2, FACE_WORDS = FACE_Y1 + 2 };
enum { POST_Y, POST_THICK = POST_Y + 2, POST_WORDS };
enum { THICK_X = 1, THICK_Y = 2 }; /* as thick as an outside wall */

static uint32_t kind_word(const tn_face *face)
{
    return face->kind << 1 | (face->relation == TN_FACE_OUTSIDE);
}

tn_status tn_strip_fit_base(tn_strip *strip, const tn_house *house, uint32_t cell, uint32_t *base, tn_error *error)
{
    const tn_cell *c = &house->cells[cell];
    tn_key *key = &strip->key;
    key->size = 0;
    bool ok = tn_key_push(key, c->function) && tn_key_push(key, c->storey) &&
              tn_push_long(key, (uint64_t)(c->at.x1 - c->at.x0)) && tn_push_long(key, (uint64_t)c->at.y0) &&
              tn_push_long(key, (uint64_t)c->at.y1);
    for (size_t i = 0; ok && i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        bool back = face->side == TN_HOUSE_BACK || face->side == TN_HOUSE_FRONT;
        if (!back || (face->first != cell && face->second != cell))
            continue;
        bool front = (face->side == TN_HOUSE_FRONT) == (face->first == cell);
        ok = tn_key_push(key, front ? TN_HOUSE_FRONT : TN_HOUSE_BACK) && tn_key_push(key, kind_word(face));
    }
    *base = ok ? tn_intern(&strip->bases, key->data, key->size) : UINT32_MAX;
    return *base != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

tn_status tn_strip_fit_side(tn_strip *strip, const tn_house *house, uint32_t cell, tn_house_side side, int64_t x,
                            const tn_posts *posts, uint32_t *fit, tn_error *error)
{
    const tn_cell *c = &house->cells[cell];
    int64_t wall = house->form->record->wall;
    tn_key *key = &strip->key;
    key->size = 0;
    bool ok = tn_key_push(key, 0);
    (void)side;
    for (size_t i = 0; ok && i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (face->relation == TN_FACE_UNDER || face->at.x0 != x || face->at.x1 != x ||
            (face->first != cell && face->second != cell))
            continue;
        ok = tn_key_push(key, kind_word(face)) && tn_push_long(key, (uint64_t)face->at.y0) &&
             tn_push_long(key, (uint64_t)face->at.y1);
        key->data[SIDE_FACES]++;
    }
    for (size_t i = 0; ok && i < posts->count; i++) {
        const tn_post *post = &posts->items[i];
        if (post->x != x || post->y < c->at.y0 || post->y > c->at.y1 || post->thick_x == 0 || post->thick_y == 0)
            continue;
        uint32_t thick = (post->thick_x == wall ? THICK_X : 0u) | (post->thick_y == wall ? THICK_Y : 0u);
        ok = tn_push_long(key, (uint64_t)post->y) && tn_key_push(key, thick);
    }
    *fit = ok ? tn_intern(&strip->sides, key->data, key->size) : UINT32_MAX;
    return *fit != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* ---- the cell by itself */

enum { CELL, OTHER, CELLS }; /* the other cell has the ends of walls that are not the cell's */

static tn_face *add(tn_house *house, uint32_t first, tn_house_side side, uint32_t kind, tn_rectangle at)
{
    tn_face *face = &house->faces[house->face_count++];
    bool outside = kind & 1;
    *face = (tn_face){.first = first,
                      .second = outside ? TN_NO_CELL : OTHER,
                      .relation = outside ? TN_FACE_OUTSIDE : TN_FACE_BESIDE,
                      .side = side,
                      .at = at,
                      .storey = house->cells[CELL].storey,
                      .kind = kind >> 1};
    return face;
}

/* A short end of a wall, as thick as an outside wall or a partition. */
static void add_end(tn_house *house, bool thick, tn_rectangle at)
{
    add(house, OTHER, TN_HOUSE_BACK, (uint32_t)TN_FACE_WALL << 1 | thick, at);
}

static void add_side(const tn_strip *strip, tn_house *house, uint32_t side, bool left)
{
    size_t size;
    const uint32_t *words = tn_interned(&strip->sides, side, &size), *end = words + size;
    int64_t x = left ? house->cells[CELL].at.x0 : house->cells[CELL].at.x1, away = left ? -1 : 1;
    uint32_t faces = words[SIDE_FACES];
    for (words += SIDE_FIRST; faces > 0; faces--, words += FACE_WORDS)
        add(house, CELL, left ? TN_HOUSE_LEFT : TN_HOUSE_RIGHT, words[FACE_KIND],
            (tn_rectangle){x, x, (int64_t)tn_both(words + FACE_Y0), (int64_t)tn_both(words + FACE_Y1)});
    for (; words < end; words += POST_WORDS) {
        int64_t y = (int64_t)tn_both(words + POST_Y);
        add_end(house, words[POST_THICK] & THICK_X, (tn_rectangle){x, x, y, y});
        add_end(house, words[POST_THICK] & THICK_Y,
                left ? (tn_rectangle){x + away, x, y, y} : (tn_rectangle){x, x + away, y, y});
    }
}

static tn_status build(const tn_strip *strip, uint32_t base, uint32_t left, uint32_t right, tn_house *house,
                       tn_error *error)
{
    size_t size, sides[2];
    const uint32_t *words = tn_interned(&strip->bases, base, &size);
    tn_interned(&strip->sides, left, &sides[0]);
    tn_interned(&strip->sides, right, &sides[1]);
    *house = (tn_house){.form = strip->form, .length = 1, .cell_count = CELLS};
    memcpy(house->shapes, strip->shapes, strip->form->record->choice_count * sizeof *strip->shapes);
    house->cells = calloc(CELLS, sizeof *house->cells);
    house->faces = calloc(size + sides[0] + sides[1] + 1, sizeof *house->faces);
    if (!house->cells || !house->faces)
        return tn_fail_memory(error);
    int64_t wide = (int64_t)tn_both(words + BASE_WIDTH), y0 = (int64_t)tn_both(words + BASE_Y0),
            y1 = (int64_t)tn_both(words + BASE_Y1);
    house->cells[CELL] = house->cells[OTHER] =
        (tn_cell){.storey = words[BASE_STOREY], .function = words[BASE_FUNCTION], .at = {0, wide, y0, y1}};
    for (size_t i = BASE_FACES; i < size; i += BASE_FACE_WORDS) {
        int64_t y = words[i + BASE_FACE_SIDE] == TN_HOUSE_BACK ? y0 : y1;
        add(house, CELL, (tn_house_side)words[i + BASE_FACE_SIDE], words[i + BASE_FACE_KIND],
            (tn_rectangle){0, wide, y, y});
    }
    add_side(strip, house, left, true);
    add_side(strip, house, right, false);
    return TN_OK;
}

tn_status tn_strip_fit(tn_strip *strip, uint32_t base, uint32_t left, uint32_t right, uint32_t *tiles, tn_error *error)
{
    uint32_t before = strip->fit_keys[1].count;
    uint32_t at = tn_number(&strip->fit_keys[0], (uint64_t)base << 32 | left);
    at = at == UINT32_MAX ? at : tn_number(&strip->fit_keys[1], (uint64_t)at << 32 | right);
    if (at == UINT32_MAX || !tn_array_reserve(&strip->fits, &strip->fit_room, before, 1, sizeof *strip->fits))
        return tn_fail_memory(error);
    if (at < before) {
        *tiles = strip->fits[at];
        return TN_OK;
    }
    tn_house house;
    tn_variants variants = {0};
    tn_status status = build(strip, base, left, right, &house, error);
    if (status == TN_OK)
        status = tn_tile_variants(&house, CELL, &variants, error);
    *tiles = (uint32_t)variants.count;
    if (status == TN_OK && strip->prices.items)
        status = tn_strip_list_tiles(strip, &house, &variants, tiles, error);
    strip->fits[at] = *tiles;
    tn_variants_clear(&variants);
    free(house.cells);
    free(house.faces);
    return status;
}
