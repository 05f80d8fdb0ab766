/* Tries tiles and flights in the cells of a form, as far as their size says. */
#include <stdlib.h>

#include "driver/house/survey_parts.h"

/* ---- in one place */

bool tn_survey_serves(const tn_survey *s, uint32_t tile, uint32_t function)
{
    const tn_module *module = s->form.module;
    const tn_tile_record *record = &module->TILE_records[s->form.record->tile_first + tile];
    for (uint32_t i = 0; i < record->purpose_count; i++)
        if (module->HOUSE_ITEM_records[record->purpose_first + i].number == function)
            return true;
    return false;
}

/* A room whose walls are that thick together, across the row and along it. */
static tn_status try_room(const tn_survey *s, const tn_survey_place *place, uint32_t tile, const int64_t off[2],
                          bool fits[2], tn_error *error)
{
    int64_t wide = place->wide - off[0], deep = place->deep - off[1], high = tn_form_clear(&s->form, place->storey);
    tn_status status = tn_tile_turned_in(&s->form, wide, deep, high, tile, &fits[0], error);
    return status == TN_OK ? tn_tile_turned_in(&s->form, deep, wide, high, tile, &fits[1], error) : status;
}

static tn_status try_walled(const tn_survey *s, const tn_survey_place *place, uint32_t tile, tn_tile_fits *fits,
                            tn_error *error)
{
    int64_t thin = s->form.record->partition, thick = s->form.record->wall;
    const int64_t off[] = {thin, (thin + thick) / 2, thick};
    size_t rooms = 0;
    for (size_t i = 0; i < 9; i++) {
        bool so[2];
        tn_variants layouts = {0};
        tn_status status = try_room(s, place, tile, (int64_t[2]){off[i % 3], off[i / 3]}, so, error);
        if (status == TN_OK && (so[0] || so[1]))
            status = tn_tile_variants_in(&s->form, place->wide - off[i % 3], place->deep - off[i / 3],
                                         tn_form_clear(&s->form, place->storey), tile, &layouts, error);
        fits->layouts = layouts.count > fits->layouts ? layouts.count : fits->layouts;
        tn_variants_clear(&layouts);
        if (status != TN_OK)
            return status;
        fits->straight |= so[0];
        fits->turned |= so[1];
        rooms += so[0] || so[1];
    }
    fits->fit = rooms == 9 ? TN_FITS_WALLED : rooms ? TN_FITS_THIN : TN_FITS_NOWHERE;
    return TN_OK;
}

/* Did a tile come further in this room than in another, or as far in a larger one? */
static bool is_further(const tn_tile_failure *now, const tn_tile_failure *before)
{
    if (now->obstacle != before->obstacle)
        return now->obstacle > before->obstacle;
    return (tn_int128)now->wide * now->deep > (tn_int128)before->wide * before->deep;
}

/* Half a wall less on some side. */
static tn_status try_open(const tn_survey *s, const tn_survey_place *place, uint32_t tile, tn_tile_fits *fits,
                          tn_error *error)
{
    int64_t thin = s->form.record->partition, thick = s->form.record->wall;
    const int64_t off[] = {0, thin / 2, thick / 2, thin, (thin + thick) / 2, thick};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < 36 && fits->fit == TN_FITS_NOWHERE; i++) {
        tn_tile_failure failure;
        status = tn_tile_fails_in(&s->form, place->wide - off[i % 6], place->deep - off[i / 6],
                                  tn_form_clear(&s->form, place->storey), tile, &failure, error);
        if (status == TN_OK && failure.obstacle == TN_TILE_STANDS)
            fits->fit = TN_FITS_OPEN;
        else if (status == TN_OK && is_further(&failure, &fits->further))
            fits->further = failure;
    }
    return status;
}

tn_status tn_survey_tile(const tn_survey *s, const tn_survey_place *place, uint32_t tile, tn_tile_fits *fits,
                         tn_error *error)
{
    int64_t thin = s->form.record->partition;
    uint32_t record = s->form.record->tile_first + tile;
    *fits = (tn_tile_fits){.fit = TN_FITS_NOWHERE};
    tn_status status = try_walled(s, place, record, fits, error);
    if (status == TN_OK && fits->fit == TN_FITS_NOWHERE)
        status = try_open(s, place, record, fits, error);
    if (status == TN_OK && fits->fit == TN_FITS_NOWHERE)
        status = tn_tile_fails_in(&s->form, place->wide - thin, place->deep - thin,
                                  tn_form_clear(&s->form, place->storey), record, &fits->failure, error);
    return status;
}

bool tn_survey_climbs(const tn_survey *s, const tn_survey_place *place, uint32_t opening)
{
    const tn_opening_record *flight = tn_form_flight(&s->form, TN_FACE_KIND_COUNT + opening);
    tn_cell cell = {.zone = place->zone, .storey = place->storey, .at = {0, place->wide, 0, place->deep}};
    const tn_house house = {.form = &s->form, .cells = &cell};
    const tn_face face = {.relation = TN_FACE_UNDER, .storey = place->storey, .at = cell.at};
    bool climbs = false;
    for (uint32_t f = 0; !climbs && place->storey + 1 < s->form.record->storey_count && f < tn_form_functions(&s->form);
         f++) {
        cell.function = f;
        climbs = tn_survey_has(place->may, f) && flight && tn_flight_fits(&house, &face, flight);
    }
    return climbs;
}

/* ---- in all of them */

bool tn_survey_is_for(const tn_survey *s, const tn_survey_place *place, uint32_t tile)
{
    for (uint32_t f = 0; f < tn_form_functions(&s->form); f++)
        if (tn_survey_has(place->may, f) && tn_survey_serves(s, tile, f))
            return true;
    return false;
}

tn_status tn_survey_tile_anywhere(const tn_survey *s, uint32_t tile, bool *fits, tn_tile_failure *further,
                                  tn_error *error)
{
    tn_status status = TN_OK;
    *further = (tn_tile_failure){.obstacle = TN_TILE_STANDS};
    *fits = s->place_count == TN_SURVEY_PLACES_MAX; /* not all are known */
    for (size_t i = 0; status == TN_OK && !*fits && i < s->place_count; i++) {
        tn_tile_fits found;
        if (!tn_survey_is_for(s, &s->places[i], tile))
            continue;
        status = tn_survey_tile(s, &s->places[i], tile, &found, error);
        *fits = status == TN_OK && found.fit != TN_FITS_NOWHERE;
        if (status == TN_OK && is_further(&found.further, further))
            *further = found.further;
    }
    return status;
}

/* ---- clear rooms of any size */

#define EDGES_MAX 100u

/* Sizes at which what is measured from one side meets what is measured from the other. */
typedef struct edges {
    int64_t at[EDGES_MAX];
    size_t count;
    bool full;
    int64_t least, most;
} edges;

/* At the size itself, or a nanometre above it, may be another answer than below. */
static void add_edge(edges *e, int64_t size)
{
    for (int64_t at = size; at <= size + 1; at++) {
        bool there = at < e->least || at > e->most;
        for (size_t i = 0; !there && i < e->count; i++)
            there = e->at[i] == at;
        if (!there && e->count == EDGES_MAX)
            e->full = true;
        else if (!there)
            e->at[e->count++] = at;
    }
}

/* One end of a box: from the left (or the back), or from the right (the front). */
typedef struct box_end {
    int64_t length;
    bool from_far;
} box_end;

static box_end end_of(const tn_tile_box_record *box, bool deep, bool to)
{
    if (deep)
        return to ? (box_end){box->y_to, box->flags & TN_TILE_Y_TO_FRONT}
                  : (box_end){box->y_from, box->flags & TN_TILE_Y_FROM_FRONT};
    return to ? (box_end){box->x_to, box->flags & TN_TILE_X_TO_RIGHT}
              : (box_end){box->x_from, box->flags & TN_TILE_X_FROM_RIGHT};
}

static void find_edges(const tn_house_form *form, const tn_tile_record *tile, bool deep, edges *e)
{
    const tn_tile_box_record *boxes = form->module->TILE_BOX_records + tile->box_first;
    *e = (edges){.least = deep ? tile->deep_least : tile->wide_least, .most = deep ? tile->deep_most : tile->wide_most};
    add_edge(e, e->least);
    for (uint32_t i = 0; i < 2 * tile->box_count; i++) {
        box_end a = end_of(&boxes[i / 2], deep, i % 2);
        add_edge(e, a.length);
        for (uint32_t k = 0; k < 2 * tile->box_count; k++) {
            box_end b = end_of(&boxes[k / 2], deep, k % 2);
            if (!a.from_far && b.from_far)
                add_edge(e, a.length + b.length);
        }
    }
    add_edge(e, e->most);
}

static int64_t lesser(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

/* The height of the highest storey: a box without a height reaches up to its deck. */
static int64_t highest(const tn_house_form *form)
{
    int64_t high = 0;
    for (uint32_t i = 0; i < form->record->storey_count; i++)
        high = tn_form_clear(form, i) > high ? tn_form_clear(form, i) : high;
    return high;
}

tn_status tn_tile_rooms_find(const tn_house_form *form, uint32_t tile, tn_tile_rooms *rooms, tn_error *error)
{
    uint32_t number = form->record->tile_first + tile;
    const tn_tile_record *record = &form->module->TILE_records[number];
    edges wide, deep;
    tn_status status = TN_OK;
    *rooms = (tn_tile_rooms){.wide = INT64_MAX, .deep = INT64_MAX};
    find_edges(form, record, false, &wide);
    find_edges(form, record, true, &deep);
    rooms->known = !wide.full && !deep.full;
    for (size_t i = 0; status == TN_OK && rooms->known && i < wide.count * deep.count; i++) {
        int64_t w = wide.at[i % wide.count], d = deep.at[i / wide.count];
        bool fits = false;
        if (rooms->any && w >= rooms->wide && w <= rooms->wide_most && d >= rooms->deep && d <= rooms->deep_most)
            continue;
        status = tn_tile_turned_in(form, w, d, highest(form), number, &fits, error);
        if (!fits)
            continue;
        rooms->any = true;
        rooms->wide = lesser(rooms->wide, w);
        rooms->deep = lesser(rooms->deep, d);
        rooms->wide_most = w > rooms->wide_most ? w : rooms->wide_most;
        rooms->deep_most = d > rooms->deep_most ? d : rooms->deep_most;
    }
    return status;
}
