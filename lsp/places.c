/* Says where functions of forms may be, what storeys have, and what sections choose. */
#include "lsp/places.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/house/survey.h"
#include "lsp/facts.h"
#include "runtime/base/array.h"
#include "runtime/base/length.h"
#include "runtime/house/solids.h"
#include "runtime/plan/measure/amount.h"

/* A form that was gone through, and where the words go. */
typedef struct place_words {
    const tn_survey *survey;
    const tn_module *module;
    tn_length_style style;
    bool tries; /* there are few enough tiles and sizes of cells to try each tile in each */
    FILE *out;
} place_words;

enum { TN_NAMES_SHOWN = 10, TN_SIZES_SHOWN = 6, TN_TRIES_MAX = 50000 };

/* Sizes of cells, each once: "8' by 4', 12' by 8' and 3 more". */
typedef struct words_sizes {
    int64_t seen[64][2];
    size_t count;
} words_sizes;

/* The first place of a zone (by its number among the form's) and storey; TN_NO_PLACE: there is none. */
static inline size_t words_first(const place_words *w, uint32_t zone, uint32_t storey)
{
    const tn_survey *s = w->survey;
    return s->first_places[(size_t)s->form.zones[zone] * s->form.record->storey_count + storey];
}

static tn_status words_tile(const place_words *w, uint32_t tile, tn_error *error);
static void words_opening(const place_words *w, uint32_t opening);

enum { FACTS_MAX = 20000, VALUES_SHOWN = 12 };

/* ---- words */

static void words_count(const place_words *w, uint64_t number)
{
    char digits[24];
    snprintf(digits, sizeof digits, "%" PRIu64, number);
    tn_facts_grouped(w->out, digits);
}

static void words_length(const place_words *w, int64_t nanometres)
{
    char text[64];
    tn_length_write_style(nanometres, w->style, text, sizeof text);
    fputs(text, w->out);
}

static const char *field_name(const place_words *w, uint32_t field)
{
    return tn_text(w->module, w->survey->schema->fields[field].name);
}

static const char *storey_name(const place_words *w, uint32_t storey)
{
    return tn_text(w->module, w->module->STOREY_records[w->survey->form.record->storey_first + storey].name);
}

/* "machine, ground" */
static void words_stack(const place_words *w, uint32_t zone, uint32_t storey)
{
    fprintf(w->out, "%s, %s", field_name(w, zone), storey_name(w, storey));
}

/* "`entry`, `bath` and 3 more"; "no function" where the set is empty. */
static void words_functions(const place_words *w, const uint64_t *set)
{
    size_t found = 0;
    for (uint32_t f = 0; f < tn_form_functions(&w->survey->form); f++) {
        if (!tn_survey_has(set, f))
            continue;
        if (found < TN_NAMES_SHOWN)
            fprintf(w->out, "%s`%s`", found ? ", " : "", tn_text(w->module, tn_form_rule(&w->survey->form, f)->name));
        found++;
    }
    if (found > TN_NAMES_SHOWN)
        fprintf(w->out, " and %zu more", found - TN_NAMES_SHOWN);
    if (found == 0)
        fprintf(w->out, "none");
}

/* Storeys of a set of bits: "`ground`, `upper`". */
static void words_storeys(const place_words *w, uint64_t storeys)
{
    bool any = false;
    for (uint32_t i = 0; i < w->survey->form.record->storey_count; i++) {
        if (!(storeys >> i & 1))
            continue;
        fprintf(w->out, "%s`%s`", any ? ", " : "", storey_name(w, i));
        any = true;
    }
}

static void words_size(const place_words *w, words_sizes *sizes, const tn_survey_place *place)
{
    for (size_t i = 0; i < sizes->count; i++)
        if (sizes->seen[i][0] == place->wide && sizes->seen[i][1] == place->deep)
            return;
    if (sizes->count < TN_SIZES_SHOWN) {
        fputs(sizes->count ? ", " : "", w->out);
        words_length(w, place->wide);
        fputs(" by ", w->out);
        words_length(w, place->deep);
    }
    if (sizes->count == sizeof sizes->seen / sizeof *sizes->seen)
        return;
    sizes->seen[sizes->count][0] = place->wide;
    sizes->seen[sizes->count++][1] = place->deep;
}

static void words_more(const place_words *w, const words_sizes *sizes)
{
    if (sizes->count == sizeof sizes->seen / sizeof *sizes->seen)
        fprintf(w->out, " and others");
    else if (sizes->count > TN_SIZES_SHOWN)
        fprintf(w->out, " and %zu more", sizes->count - TN_SIZES_SHOWN);
}

static void write_area(const place_words *w, const tn_survey_place *place)
{
    tn_amount_unit unit = tn_amount_unit_of(w->survey->schema, 2);
    tn_buffer text = {0};
    mpq_t area;
    mpq_init(area);
    mpz_set_si(mpq_numref(area), place->wide);
    mpz_mul_si(mpq_numref(area), mpq_numref(area), place->deep);
    if (tn_amount_write(unit, area, &text))
        fputs(text.data, w->out);
    free(text.data);
    mpq_clear(area);
}

/* ---- functions */

/* Cells of a zone and a storey in which a function may be. */
typedef struct stack_use {
    uint64_t cells, all, alone;                /* all: also those of other functions; alone: no other may be there */
    const tn_survey_place *smallest, *largest; /* by area */
    int64_t wide, wide_most, deep, deep_most;
} stack_use;

static bool is_larger(const tn_survey_place *a, const tn_survey_place *b)
{
    return (tn_int128)a->wide * a->deep > (tn_int128)b->wide * b->deep;
}

static void take_place(stack_use *use, const tn_survey_place *place)
{
    bool first = use->cells == 0;
    use->cells += place->cells;
    use->smallest = first || is_larger(use->smallest, place) ? place : use->smallest;
    use->largest = first || is_larger(place, use->largest) ? place : use->largest;
    use->wide = first || place->wide < use->wide ? place->wide : use->wide;
    use->wide_most = first || place->wide > use->wide_most ? place->wide : use->wide_most;
    use->deep = first || place->deep < use->deep ? place->deep : use->deep;
    use->deep_most = first || place->deep > use->deep_most ? place->deep : use->deep_most;
}

static void write_range(const place_words *w, int64_t least, int64_t most, const char *what)
{
    words_length(w, least);
    if (most > least) {
        fputs(" to ", w->out);
        words_length(w, most);
    }
    fputs(what, w->out);
}

static void write_stack(const place_words *w, uint32_t zone, uint32_t storey, const stack_use *use)
{
    fputs("\n- ", w->out);
    words_stack(w, zone, storey);
    fputs(": ", w->out);
    words_count(w, use->cells);
    fputs(" of ", w->out);
    words_count(w, use->all);
    fputs(" cells, ", w->out);
    write_range(w, use->wide, use->wide_most, " wide and ");
    write_range(w, use->deep, use->deep_most, " deep, ");
    write_area(w, use->smallest);
    if (is_larger(use->largest, use->smallest)) {
        fputs(" to ", w->out);
        write_area(w, use->largest);
    }
}

static void count_stack(const place_words *w, size_t place, uint32_t function, uint64_t *others, stack_use *use)
{
    for (*use = (stack_use){0}; place != TN_NO_PLACE; place = w->survey->places[place].next) {
        const tn_survey_place *at = &w->survey->places[place];
        bool alone = true;
        use->all += at->cells;
        if (!tn_survey_has(at->may, function))
            continue;
        take_place(use, at);
        for (uint32_t f = 0; f < tn_form_functions(&w->survey->form); f++) {
            if (f == function || !tn_survey_has(at->may, f))
                continue;
            others[f / 64] |= UINT64_C(1) << f % 64;
            alone = false;
        }
        use->alone += alone ? at->cells : 0;
    }
}

/* "Over all 5,875 trays of `lahave` it may be in 2,350 of 23,500 cells:" */
static void write_sum(const place_words *w, uint64_t cells, const char *what)
{
    const tn_survey *s = w->survey;
    fputs("\nOver all ", w->out);
    words_count(w, s->schema->tray_count);
    fprintf(w->out, " trays of `%s` and all options, %s", tn_text(w->module, s->schema->record->name), what);
    words_count(w, cells);
    fputs(" of ", w->out);
    words_count(w, s->cells);
    fputs(" cells:\n", w->out);
}

/* Cells of its that are too small for all of its tiles, with walls round them. */
static tn_status write_bare(const place_words *w, uint32_t function, tn_error *error)
{
    const tn_survey *s = w->survey;
    words_sizes sizes = {0};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < s->place_count; i++) {
        const tn_survey_place *place = &s->places[i];
        bool fits = false, any = false;
        for (uint32_t t = 0;
             status == TN_OK && !fits && tn_survey_has(place->may, function) && t < s->form.record->tile_count; t++) {
            tn_tile_fits found;
            if (!tn_survey_serves(s, t, function))
                continue;
            any = true;
            status = tn_survey_tile(s, place, t, &found, error);
            fits = status == TN_OK && found.fit >= TN_FITS_THIN;
        }
        if (status != TN_OK || !any || fits)
            continue;
        if (sizes.count == 0)
            fputs("\n- none of its tiles fits with walls round it in cells of ", w->out);
        words_size(w, &sizes, place);
    }
    words_more(w, &sizes);
    return status;
}

static void write_others(const place_words *w, const uint64_t *others, uint64_t cells, uint64_t alone)
{
    if (cells == alone) {
        fputs(cells ? "\n- no other function may be there" : "", w->out);
        return;
    }
    fputs("\n- other functions there: ", w->out);
    words_functions(w, others);
    if (alone == 0)
        return;
    fputs("; in ", w->out);
    words_count(w, alone);
    fputs(" of these cells no other may be", w->out);
}

static tn_status write_function(const place_words *w, uint32_t function, tn_error *error)
{
    const tn_survey *s = w->survey;
    uint64_t cells = 0, alone = 0, *others = calloc(s->words, sizeof *others);
    stack_use use;
    if (!others)
        return tn_fail_memory(error);
    for (size_t i = 0; i < s->place_count; i++)
        cells += tn_survey_has(s->places[i].may, function) ? s->places[i].cells : 0;
    write_sum(w, cells, "it may be in ");
    for (uint32_t z = 0; z < s->form.zone_count; z++)
        for (uint32_t k = 0; k < s->form.record->storey_count; k++) {
            count_stack(w, words_first(w, z, k), function, others, &use);
            alone += use.alone;
            if (use.cells > 0)
                write_stack(w, s->form.zones[z], k, &use);
        }
    write_others(w, others, cells, alone);
    free(others);
    return w->tries ? write_bare(w, function, error) : TN_OK;
}

/* ---- storeys, choices, forms */

static void write_storey_zone(const place_words *w, uint32_t zone, uint32_t storey)
{
    const tn_survey *s = w->survey;
    uint64_t cells = 0, open = 0;
    for (size_t i = words_first(w, zone, storey); i != TN_NO_PLACE; i = s->places[i].next) {
        cells += s->places[i].cells;
        open += s->places[i].open ? s->places[i].cells : 0;
    }
    if (cells == 0)
        return;
    fprintf(w->out, "\n- %s: ", field_name(w, s->form.zones[zone]));
    words_count(w, cells);
    fputs(" cells", w->out);
    if (open > 0) {
        fputs(", ", w->out);
        words_count(w, open);
        fputs(" of them open to the cell below", w->out);
    }
    uint64_t sections = tn_survey_sections_with(s, s->form.zones[zone], storey);
    if (!s->counted || sections == s->stands)
        return;
    fputs(", in ", w->out);
    words_count(w, sections);
    fputs(" of ", w->out);
    words_count(w, s->stands);
    fputs(" combinations of options", w->out);
}

static void write_storey(const place_words *w, uint32_t storey)
{
    const tn_survey *s = w->survey;
    uint64_t cells = 0;
    for (size_t i = 0; i < s->place_count; i++)
        cells += s->places[i].storey == storey ? s->places[i].cells : 0;
    write_sum(w, cells, "it has ");
    for (uint32_t z = 0; z < s->form.zone_count; z++)
        write_storey_zone(w, z, storey);
    fputs("\n- from the floor to the ceiling: ", w->out);
    words_length(w, tn_form_clear(&s->form, storey));
}

static void write_choice(const place_words *w, const tn_choice_record *choice)
{
    const tn_survey *s = w->survey;
    for (uint32_t i = 0; i < choice->shape_count && i < VALUES_SHOWN; i++) {
        uint32_t shape = choice->shape_first + i;
        fprintf(w->out, "\n- `%s`: in ", tn_text(w->module, w->module->SHAPE_records[shape].spelling));
        words_count(w, s->with[shape]);
        fputs(" of ", w->out);
        words_count(w, s->stands);
        fputs(" combinations of options", w->out);
    }
    if (choice->shape_count > VALUES_SHOWN)
        fprintf(w->out, "\n- and %u more", choice->shape_count - VALUES_SHOWN);
}

static void write_form(const place_words *w)
{
    const tn_survey *s = w->survey;
    fputs("\n- ", w->out);
    words_count(w, s->schema->tray_count);
    fprintf(w->out, " trays of `%s` have ", tn_text(w->module, s->schema->record->name));
    words_count(w, s->cells);
    fputs(" cells", w->out);
    if (!s->counted)
        return;
    fputs("\n- ", w->out);
    words_count(w, s->stands);
    fputs(" combinations of options", w->out);
    if (s->stands == s->sections)
        return;
    fputs("; ", w->out);
    words_count(w, s->sections - s->stands);
    fputs(" more are forbidden", w->out);
}

/* ---- facts */

/* Something to write about a declaration; `index` within the form. */
static tn_status write_part(const place_words *w, tn_symbol_kind kind, uint32_t index, tn_error *error)
{
    switch (kind) {
    case TN_SYMBOL_FUNCTION:
        return write_function(w, index, error);
    case TN_SYMBOL_TILE:
        return words_tile(w, index, error);
    case TN_SYMBOL_OPENING:
        words_opening(w, index);
        return TN_OK;
    case TN_SYMBOL_STOREY:
        write_storey(w, index);
        return TN_OK;
    case TN_SYMBOL_CHOICE:
        write_choice(w, tn_form_choice(&w->survey->form, index));
        return TN_OK;
    default:
        write_form(w);
        return TN_OK;
    }
}

static bool take_fact(tn_place_facts *facts, const place_words *w, tn_symbol_kind kind, uint32_t name, char *text)
{
    if (facts->count == FACTS_MAX ||
        !tn_array_reserve(&facts->items, &facts->capacity, facts->count, 1, sizeof *facts->items))
        return false;
    tn_place_fact fact = {kind, strdup(tn_text(w->module, w->survey->form.record->name)),
                          strdup(tn_text(w->module, name)), text};
    if (fact.form && fact.name) {
        facts->items[facts->count++] = fact;
        return true;
    }
    free(fact.form);
    free(fact.name);
    return false;
}

static void add_fact(tn_place_facts *facts, place_words *w, tn_symbol_kind kind, uint32_t index, uint32_t name)
{
    char *text = NULL;
    size_t size = 0;
    tn_error error;
    w->out = open_memstream(&text, &size);
    if (!w->out || tn_watch_stopped(w->module->watch)) {
        if (w->out)
            fclose(w->out);
        free(text);
        return;
    }
    tn_status status = write_part(w, kind, index, &error);
    if (fclose(w->out) != 0 || status != TN_OK || !take_fact(facts, w, kind, name, text))
        free(text);
}

static void add_parts(tn_place_facts *facts, place_words *w)
{
    const tn_form_record *form = w->survey->form.record;
    const tn_module *module = w->module;
    add_fact(facts, w, TN_SYMBOL_FORM, 0, form->name);
    for (uint32_t i = 0; i < form->storey_count; i++)
        add_fact(facts, w, TN_SYMBOL_STOREY, i, module->STOREY_records[form->storey_first + i].name);
    for (uint32_t i = 0; i < tn_form_functions(&w->survey->form); i++)
        add_fact(facts, w, TN_SYMBOL_FUNCTION, i, tn_form_rule(&w->survey->form, i)->name);
    for (uint32_t i = 0; i < form->opening_count; i++)
        add_fact(facts, w, TN_SYMBOL_OPENING, i, module->OPENING_records[form->opening_first + i].name);
    for (uint32_t i = 0; i < form->tile_count; i++)
        add_fact(facts, w, TN_SYMBOL_TILE, i, module->TILE_records[form->tile_first + i].name);
    for (uint32_t i = 0; i < form->choice_count && w->survey->counted; i++)
        add_fact(facts, w, TN_SYMBOL_CHOICE, i, tn_form_choice(&w->survey->form, i)->name);
}

void tn_place_facts_add(tn_place_facts *facts, const tn_module *module)
{
    for (uint32_t i = 0; i < module->FORM_count; i++) {
        tn_survey *survey;
        tn_error error;
        if (tn_survey_new(module, i, &survey, &error) != TN_OK)
            continue;
        const tn_house house = {.form = &survey->form};
        place_words words = {.survey = survey, .module = module, .style = tn_house_length_style(&house)};
        words.tries = survey->place_count * survey->form.record->tile_count <= TN_TRIES_MAX;
        if (survey->complete && survey->place_count < TN_SURVEY_PLACES_MAX)
            add_parts(facts, &words);
        tn_survey_free(survey);
    }
}

void tn_place_facts_clear(tn_place_facts *facts)
{
    for (size_t i = 0; i < facts->count; i++) {
        free(facts->items[i].form);
        free(facts->items[i].name);
        free(facts->items[i].text);
    }
    free(facts->items);
    *facts = (tn_place_facts){0};
}

void tn_place_facts_write(const tn_place_facts *facts, const tn_symbol *symbol, FILE *out)
{
    const tn_symbol *form = symbol->kind == TN_SYMBOL_FORM ? symbol : symbol->parent;
    for (size_t i = 0; form && i < facts->count; i++) {
        const tn_place_fact *fact = &facts->items[i];
        if (fact->kind == symbol->kind && strcmp(fact->form, form->name) == 0 && strcmp(fact->name, symbol->name) == 0)
            fputs(fact->text, out);
    }
}

/* ---- the rooms that a tile needs */

/* "7' to 12' wide". A least size is a nanometre above one at which something is still in the way, or that size itself.
 */
static void write_side(const place_words *w, int64_t least, int64_t most, const char *what)
{
    bool above = least % 1000 == 1, bounded = most < TN_HOUSE_LENGTH_MAX;
    if (least > 1) {
        fputs(above ? "over " : bounded ? "" : "at least ", w->out);
        words_length(w, least - above);
    }
    if (bounded) {
        fputs(least <= 1 ? "at most " : above ? " and at most " : " to ", w->out);
        words_length(w, most);
    }
    fputs(least > 1 || bounded ? what : "", w->out);
}

static tn_status write_rooms(const place_words *w, uint32_t tile, tn_error *error)
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
static bool write_sizes(const place_words *w, const tile_places *found, size_t place, tn_tile_fit fit,
                        const char *words)
{
    words_sizes sizes = {0};
    for (; place != TN_NO_PLACE; place = w->survey->places[place].next) {
        if (!found->for_it[place] || found->fits[place].fit != fit)
            continue;
        fputs(sizes.count ? "" : words, w->out);
        words_size(w, &sizes, &w->survey->places[place]);
    }
    words_more(w, &sizes);
    return sizes.count > 0;
}

static void write_turns(const place_words *w, const tile_places *found, size_t place)
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

static void write_tile_stack(const place_words *w, const tile_places *found, uint32_t zone, uint32_t storey)
{
    size_t first = words_first(w, zone, storey);
    bool walled = fits_into(w->survey, found, first, TN_FITS_WALLED),
         thin = fits_into(w->survey, found, first, TN_FITS_THIN),
         open = fits_into(w->survey, found, first, TN_FITS_OPEN);
    if (!walled && !thin && !open)
        return;
    fputs("\n- ", w->out);
    words_stack(w, w->survey->form.zones[zone], storey);
    write_sizes(w, found, first, TN_FITS_WALLED, ": cells of ");
    write_sizes(w, found, first, TN_FITS_THIN,
                walled ? "; if some walls are partitions, also " : ": if some walls are partitions, cells of ");
    if (walled || thin)
        write_turns(w, found, first);
    write_sizes(w, found, first, TN_FITS_OPEN,
                walled || thin ? "; if a side has no wall, also " : ": if a side has no wall, cells of ");
}

/* It fits nowhere: what is in the way in the largest cell. */
static void write_failure(const place_words *w, const tile_places *found)
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
    words_stack(w, s->places[largest].zone, s->places[largest].storey);
    fputs(", ", w->out);
    words_length(w, s->places[largest].wide);
    fputs(" by ", w->out);
    words_length(w, s->places[largest].deep);
    fprintf(w->out, ": %s", text);
}

static void write_places(const place_words *w, const tile_places *found)
{
    const tn_survey *s = w->survey;
    for (size_t i = 0; i < s->place_count; i++) {
        if (!found->for_it[i] || found->fits[i].fit == TN_FITS_NOWHERE)
            continue;
        fputs("\n\nWith walls round the room (cells: along the row by from back to front):\n", w->out);
        for (uint32_t z = 0; z < s->form.zone_count; z++)
            for (uint32_t k = 0; k < s->form.record->storey_count; k++)
                write_tile_stack(w, found, z, k);
        return;
    }
    write_failure(w, found);
}

static tn_status words_tile(const place_words *w, uint32_t tile, tn_error *error)
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

static void write_faces(const place_words *w, const char *where, uint64_t storeys, const uint64_t *functions)
{
    if (storeys == 0)
        return;
    fprintf(w->out, "\n- may be in %s, storey ", where);
    words_storeys(w, storeys);
    fputs(": ", w->out);
    words_functions(w, functions);
}

static void write_uses(const place_words *w, const tn_kind_use *use)
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

static void write_flight(const place_words *w, uint32_t opening)
{
    const tn_survey *s = w->survey;
    for (uint32_t z = 0; z < s->form.zone_count; z++)
        for (uint32_t k = 0; k < s->form.record->storey_count; k++) {
            words_sizes sizes = {0};
            for (size_t i = words_first(w, z, k); i != TN_NO_PLACE; i = s->places[i].next) {
                if (!tn_survey_climbs(s, &s->places[i], opening))
                    continue;
                if (sizes.count == 0) {
                    fputs("\n- has room in ", w->out);
                    words_stack(w, s->form.zones[z], k);
                    fputs(": cells of ", w->out);
                }
                words_size(w, &sizes, &s->places[i]);
            }
            words_more(w, &sizes);
        }
}

static void write_needs(const place_words *w, const tn_opening_record *opening)
{
    const tn_survey *s = w->survey;
    uint64_t storeys = 0;
    for (uint32_t i = 0; i < s->form.record->storey_count; i++)
        storeys |= (uint64_t)(opening->sill + opening->high <= tn_form_clear(&s->form, i)) << i;
    int64_t in_x = tn_opening_needs(&s->form, opening, true), in_y = tn_opening_needs(&s->form, opening, false);
    fputs("\n- needs a face at least ", w->out);
    words_length(w, in_x);
    if (in_y != in_x) {
        fputs(" (at the left and right ", w->out);
        words_length(w, in_y);
        fputs(")", w->out);
    }
    fputs(" wide and ", w->out);
    words_length(w, opening->sill + opening->high);
    fputs(" high", w->out);
    fputs(storeys ? ": storey " : "; no storey is so high", w->out);
    words_storeys(w, storeys);
}

static void words_opening(const place_words *w, uint32_t opening)
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
