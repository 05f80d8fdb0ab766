/* Says where tiles of forms fit, and which faces may have their openings and flights. */
#include <stdlib.h>
#include <string.h>

#include "lsp/places_parts.h"

/* ---- the rooms that a tile needs */

/* "7' to 12' wide". A least size is a nanometre above one at which something is still in the way, or that size itself.
 */
static void write_side(const tn_place_words *w, int64_t least, int64_t most, const char *what)
{
    bool above = least % 1000 == 1, bounded = most < TN_HOUSE_LENGTH_MAX;
    if (least > 1) {
        fputs(above ? "over " : bounded ? "" : "at least ", w->out);
        tn_words_length(w, least - above);
    }
    if (bounded) {
        fputs(least <= 1 ? "at most " : above ? " and at most " : " to ", w->out);
        tn_words_length(w, most);
    }
    fputs(least > 1 || bounded ? what : "", w->out);
}

static tn_status write_rooms(const tn_place_words *w, uint32_t tile, tn_error *error)
{
    tn_tile_rooms rooms;
    tn_status status = tn_tile_rooms_find(&w->survey->form, tile, &rooms, error);
    if (status != TN_OK || !rooms.known || !rooms.any)
        return status; /* where none is large enough, what is in the way is said below */
    bool wide = rooms.wide > 1 || rooms.wide_most < TN_HOUSE_LENGTH_MAX;
    bool deep = rooms.deep > 1 || rooms.deep_most < TN_HOUSE_LENGTH_MAX;
    if (!wide && !deep)
        return TN_OK;
    fputs("\n- fits only into clear rooms ", w->out);
    write_side(w, rooms.wide, rooms.wide_most, " wide");
    fputs(wide && deep ? " and " : "", w->out);
    write_side(w, rooms.deep, rooms.deep_most, " deep");
    fputs(" (its back behind)", w->out);
    return TN_OK;
}

/* ---- the cells that it fits into */

/* A tile in each place. `for_it`: may a cell there have one of its functions? */
typedef struct tile_places {
    uint32_t tile;
    bool *for_it;
    tn_tile_fits *fits;
} tile_places;

static tn_status try_places(const tn_survey *s, tile_places *found, tn_error *error)
{
    tn_status status = TN_OK;
    found->for_it = calloc(s->place_count + 1, sizeof *found->for_it);
    found->fits = calloc(s->place_count + 1, sizeof *found->fits);
    if (!found->for_it || !found->fits)
        return tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < s->place_count; i++) {
        found->for_it[i] = tn_survey_is_for(s, &s->places[i], found->tile);
        if (found->for_it[i])
            status = tn_survey_tile(s, &s->places[i], found->tile, &found->fits[i], error);
    }
    return status;
}

/* The sizes of a zone's and storey's cells into which it fits so, after some words. False where there are none. */
static bool write_sizes(const tn_place_words *w, const tile_places *found, size_t place, tn_tile_fit fit,
                        const char *words)
{
    tn_words_sizes sizes = {0};
    for (; place != TN_NO_PLACE; place = w->survey->places[place].next) {
        if (!found->for_it[place] || found->fits[place].fit != fit)
            continue;
        fputs(sizes.count ? "" : words, w->out);
        tn_words_size(w, &sizes, &w->survey->places[place]);
    }
    tn_words_more(w, &sizes);
    return sizes.count > 0;
}

static void write_turns(const tn_place_words *w, const tile_places *found, size_t place)
{
    bool straight = false, turned = false;
    size_t layouts = 0;
    for (; place != TN_NO_PLACE; place = w->survey->places[place].next) {
        const tn_tile_fits *fits = &found->fits[place];
        straight |= fits->straight;
        turned |= fits->turned;
        layouts = fits->layouts > layouts ? fits->layouts : layouts;
    }
    fprintf(w->out, "; its back at %s; ",
            !turned     ? "the back or the front"
            : !straight ? "the left or the right"
                        : "any side");
    if (layouts == 1)
        fputs("1 layout", w->out);
    else
        fprintf(w->out, "up to %zu layouts", layouts);
}

static bool fits_into(const tn_survey *s, const tile_places *found, size_t place, tn_tile_fit fit)
{
    for (; place != TN_NO_PLACE; place = s->places[place].next)
        if (found->for_it[place] && found->fits[place].fit == fit)
            return true;
    return false;
}

static void write_stack(const tn_place_words *w, const tile_places *found, uint32_t zone, uint32_t storey)
{
    size_t first = tn_words_first(w, zone, storey);
    bool walled = fits_into(w->survey, found, first, TN_FITS_WALLED),
         thin = fits_into(w->survey, found, first, TN_FITS_THIN),
         open = fits_into(w->survey, found, first, TN_FITS_OPEN);
    if (!walled && !thin && !open)
        return;
    fputs("\n- ", w->out);
    tn_words_stack(w, w->survey->form.zones[zone], storey);
    write_sizes(w, found, first, TN_FITS_WALLED, ": cells of ");
    write_sizes(w, found, first, TN_FITS_THIN,
                walled ? "; if some walls are partitions, also " : ": if some walls are partitions, cells of ");
    if (walled || thin)
        write_turns(w, found, first);
    write_sizes(w, found, first, TN_FITS_OPEN,
                walled || thin ? "; if a side has no wall, also " : ": if a side has no wall, cells of ");
}

/* It fits nowhere: what is in the way in the largest cell. */
static void write_failure(const tn_place_words *w, const tile_places *found)
{
    const tn_survey *s = w->survey;
    size_t largest = TN_NO_PLACE;
    char text[300];
    for (size_t i = 0; i < s->place_count; i++) {
        const tn_survey_place *place = &s->places[i], *other = largest == TN_NO_PLACE ? NULL : &s->places[largest];
        if (found->for_it[i] && (!other || (tn_int128)place->wide * place->deep > (tn_int128)other->wide * other->deep))
            largest = i;
    }
    if (largest == TN_NO_PLACE) {
        fputs("\n- no cell may have a function that it is for", w->out);
        return;
    }
    tn_tile_failure_text(&s->form, s->form.record->tile_first + found->tile, &found->fits[largest].failure, w->style,
                         text, sizeof text);
    fputs("\n- it fits nowhere; in the largest cell for it, ", w->out);
    tn_words_stack(w, s->places[largest].zone, s->places[largest].storey);
    fputs(", ", w->out);
    tn_words_length(w, s->places[largest].wide);
    fputs(" by ", w->out);
    tn_words_length(w, s->places[largest].deep);
    fprintf(w->out, ": %s", text);
}

static void write_places(const tn_place_words *w, const tile_places *found)
{
    const tn_survey *s = w->survey;
    for (size_t i = 0; i < s->place_count; i++) {
        if (!found->for_it[i] || found->fits[i].fit == TN_FITS_NOWHERE)
            continue;
        fputs("\n\nWith walls round the room (cells: along the row by from back to front):\n", w->out);
        for (uint32_t z = 0; z < s->form.zone_count; z++)
            for (uint32_t k = 0; k < s->form.record->storey_count; k++)
                write_stack(w, found, z, k);
        return;
    }
    write_failure(w, found);
}

tn_status tn_words_tile(const tn_place_words *w, uint32_t tile, tn_error *error)
{
    tile_places found = {.tile = tile};
    tn_status status = write_rooms(w, tile, error);
    if (status == TN_OK && w->tries)
        status = try_places(w->survey, &found, error);
    if (status == TN_OK && w->tries)
        write_places(w, &found);
    free(found.for_it);
    free(found.fits);
    return status;
}

/* ---- openings and flights */

static void write_faces(const tn_place_words *w, const char *where, uint64_t storeys, const uint64_t *functions)
{
    if (storeys == 0)
        return;
    fprintf(w->out, "\n- may be in %s, storey ", where);
    tn_words_storeys(w, storeys);
    fputs(": ", w->out);
    tn_words_functions(w, functions);
}

static void write_uses(const tn_place_words *w, const tn_kind_use *use)
{
    static const char *const names[] = {"", "back", "front", "left", "right"};
    char outside[64] = "outside walls";
    size_t size = strlen(outside);
    bool all = use->sides == (1U << TN_HOUSE_SIDE_COUNT) - 2;
    for (int side = TN_HOUSE_BACK; !all && side < TN_HOUSE_SIDE_COUNT; side++)
        if (use->sides >> side & 1)
            size += (size_t)snprintf(outside + size, sizeof outside - size, ", %s", names[side]);
    write_faces(w, outside, use->outside, use->outside_of);
    write_faces(w, "walls between cells", use->between, use->between_of);
    write_faces(w, "floors between cells", use->under, use->under_of);
    if (!use->used)
        fputs("\n- no face may have it", w->out);
}

static void write_flight(const tn_place_words *w, uint32_t opening)
{
    const tn_survey *s = w->survey;
    for (uint32_t z = 0; z < s->form.zone_count; z++)
        for (uint32_t k = 0; k < s->form.record->storey_count; k++) {
            tn_words_sizes sizes = {0};
            for (size_t i = tn_words_first(w, z, k); i != TN_NO_PLACE; i = s->places[i].next) {
                if (!tn_survey_climbs(s, &s->places[i], opening))
                    continue;
                if (sizes.count == 0) {
                    fputs("\n- has room in ", w->out);
                    tn_words_stack(w, s->form.zones[z], k);
                    fputs(": cells of ", w->out);
                }
                tn_words_size(w, &sizes, &s->places[i]);
            }
            tn_words_more(w, &sizes);
        }
}

static void write_needs(const tn_place_words *w, const tn_opening_record *opening)
{
    const tn_survey *s = w->survey;
    uint64_t storeys = 0;
    for (uint32_t i = 0; i < s->form.record->storey_count; i++)
        storeys |= (uint64_t)(opening->sill + opening->high <= tn_form_clear(&s->form, i)) << i;
    fputs("\n- needs a face at least ", w->out);
    tn_words_length(w, opening->wide + s->form.record->wall);
    fputs(" wide and ", w->out);
    tn_words_length(w, opening->sill + opening->high);
    fputs(" high", w->out);
    fputs(storeys ? ": storey " : "; no storey is so high", w->out);
    tn_words_storeys(w, storeys);
}

void tn_words_opening(const tn_place_words *w, uint32_t opening)
{
    const tn_survey *s = w->survey;
    const tn_opening_record *record = &w->module->OPENING_records[s->form.record->opening_first + opening];
    if (tn_form_flight(&s->form, TN_FACE_KIND_COUNT + opening))
        write_flight(w, opening);
    else
        write_needs(w, record);
    if (s->met)
        write_uses(w, &s->uses[TN_FACE_KIND_COUNT + opening]);
}
