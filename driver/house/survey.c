/* Goes through all trays of a form's schema. */
#include <stdlib.h>
#include <string.h>

#include "driver/house/survey_parts.h"
#include "runtime/base/array.h"

#define DECISIONS_MAX 100000000u /* a second or two */

static bool decides(const tn_survey *s, uint32_t function, const tn_cell *cell)
{
    return tn_house_decide(&s->house, function, cell);
}

static void add_to(uint64_t *set, uint32_t number)
{
    set[number / 64] |= UINT64_C(1) << number % 64;
}

/* ---- classes of cells */

static tn_status add_class(tn_survey *s, const tn_cell *cell, bool outdoor, tn_error *error)
{
    if (!tn_array_reserve_from(&s->classes, &s->class_room, 64, s->class_count, 1, sizeof *s->classes))
        return tn_fail_memory(error);
    tn_cell_class *class = &s->classes[s->class_count];
    int64_t wide = cell->at.x1 - cell->at.x0, deep = cell->at.y1 - cell->at.y0;
    tn_survey_see_ends(s, cell);
    uint64_t *met = calloc(s->met_words + s->words, sizeof *met);
    if (!met)
        return tn_fail_memory(error);
    *class = (tn_cell_class){cell->zone, cell->storey, cell->open, outdoor, wide, deep, met, met + s->met_words};
    for (uint32_t i = 0; i < s->form.record->face_count; i++) {
        const tn_face_line_record *line = &s->form.module->FACE_LINE_records[s->form.record->face_first + i];
        uint64_t first = decides(s, line->first, cell);
        uint64_t second = line->second != TN_NO_RECORD && decides(s, line->second, cell);
        met[i / 32] |= (first | second << 1) << 2 * (i % 32);
    }
    size_t at = 0;
    for (; at < s->class_count; at++) {
        tn_cell_class *other = &s->classes[at];
        if (other->zone == class->zone && other->storey == class->storey && other->open == class->open &&
            other->outdoor == class->outdoor && memcmp(other->met, met, s->met_words * sizeof *met) == 0)
            break;
    }
    tn_cell_class *into = &s->classes[at];
    into->wide = wide > into->wide ? wide : into->wide;
    into->deep = deep > into->deep ? deep : into->deep;
    if (cell->function != TN_NO_FUNCTION)
        add_to(into->functions, cell->function);
    if (at < s->class_count)
        free(met);
    else
        s->class_count++;
    return TN_OK;
}

/* ---- places */

static bool is_place(const tn_survey *s, const tn_survey_place *place, const tn_cell *cell)
{
    return place->wide == cell->at.x1 - cell->at.x0 && place->deep == cell->at.y1 - cell->at.y0 &&
           place->open == cell->open && memcmp(place->may, s->may, s->words * sizeof *s->may) == 0;
}

/* The cell has one more tray; s->may: which functions it may have. */
static tn_status add_place(tn_survey *s, const tn_cell *cell, tn_error *error)
{
    size_t *first = &s->first_places[(size_t)cell->zone * s->form.record->storey_count + cell->storey], at = *first;
    s->cells++;
    while (at != TN_NO_PLACE && !is_place(s, &s->places[at], cell))
        at = s->places[at].next;
    if (at != TN_NO_PLACE) {
        s->places[at].cells++;
        return TN_OK;
    }
    if (s->place_count == TN_SURVEY_PLACES_MAX)
        return TN_OK;
    uint64_t *may = malloc(s->words * sizeof *may);
    if (!may || !tn_array_reserve_from(&s->places, &s->place_room, 64, s->place_count, 1, sizeof *s->places)) {
        free(may);
        return tn_fail_memory(error);
    }
    memcpy(may, s->may, s->words * sizeof *may);
    s->places[s->place_count] = (tn_survey_place){.zone = cell->zone,
                                                  .storey = cell->storey,
                                                  .wide = cell->at.x1 - cell->at.x0,
                                                  .deep = cell->at.y1 - cell->at.y0,
                                                  .open = cell->open,
                                                  .may = may,
                                                  .cells = 1,
                                                  .next = *first};
    *first = s->place_count++;
    return TN_OK;
}

/* From small to large; those of a size as they were found. */
static int compare_places(const void *a, const void *b)
{
    const tn_survey_place *first = a, *second = b;
    if (first->wide != second->wide)
        return first->wide > second->wide ? 1 : -1;
    if (first->deep != second->deep)
        return first->deep > second->deep ? 1 : -1;
    return first->next > second->next ? 1 : -1;
}

/* Sorts the places, and chains them anew. */
static void sort_places(tn_survey *s)
{
    for (size_t i = 0; i < s->place_count; i++) {
        s->places[i].next = i;
        s->first_places[(size_t)s->places[i].zone * s->form.record->storey_count + s->places[i].storey] = TN_NO_PLACE;
    }
    if (s->place_count > 0)
        qsort(s->places, s->place_count, sizeof *s->places, compare_places);
    for (size_t i = s->place_count; i-- > 0;) {
        tn_survey_place *place = &s->places[i];
        size_t *first = &s->first_places[(size_t)place->zone * s->form.record->storey_count + place->storey];
        place->next = *first;
        *first = i;
    }
}

/* ---- cells */

static bool meets(const tn_survey *s, const tn_cell *cell, tn_cell_rule_kind kind)
{
    for (uint32_t i = s->form.kinds_end[kind - 1]; i < s->form.kinds_end[kind]; i++)
        if (decides(s, tn_form_rule(&s->form, i)->decides, cell))
            return true;
    return false;
}

/* Is the cell open to the one below it? Notes which voids say so; those that meet cells of the lowest storey mean
 * nothing there. */
static bool see_voids(tn_survey *s, const tn_cell *cell)
{
    bool above = cell->storey > 0, open = false;
    for (uint32_t i = s->form.kinds_end[TN_CELL_VOID - 1]; i < s->form.kinds_end[TN_CELL_VOID]; i++)
        if (decides(s, tn_form_rule(&s->form, i)->decides, cell)) {
            s->voids[i] |= above ? TN_VOID_ABOVE : TN_VOID_LOWEST;
            open = above;
        }
    return open;
}

/* The cell with this function. */
static tn_status see_function(tn_survey *s, tn_cell *cell, uint32_t function, tn_error *error)
{
    add_to(s->may, function);
    s->functions[function] = true;
    cell->function = function;
    tn_status status = add_class(s, cell, tn_form_is_outdoor(&s->form, function), error);
    cell->function = TN_NO_FUNCTION;
    return status;
}

/* A void is in the open if the cell below is, which may be or not. */
static tn_status see_void(tn_survey *s, const tn_cell *cell, tn_error *error)
{
    tn_status status = add_class(s, cell, false, error);
    return status == TN_OK && s->form.has_outdoor ? add_class(s, cell, true, error) : status;
}

/* A cell with each function that it may have. `surely`: is it there in every section? */
static tn_status see_cell(tn_survey *s, tn_cell *cell, bool surely, tn_error *error)
{
    bool any = false;
    tn_status status = cell->open ? see_void(s, cell, error) : TN_OK;
    memset(s->may, 0, s->words * sizeof *s->may);
    for (uint32_t f = 0; status == TN_OK && f < tn_form_functions(&s->form); f++) {
        if (!tn_cell_may(&s->house, cell, f))
            continue;
        any = true;
        status = see_function(s, cell, f, error);
    }
    if (!any && !cell->open && surely && !s->bare) {
        s->bare = true;
        s->bare_cell = *cell;
        s->bare_tray = s->tray;
    }
    return status == TN_OK ? add_place(s, cell, error) : status;
}

static tn_status see_tray(tn_survey *s, tn_error *error)
{
    int64_t width = tn_tray_value_record(s->schema, s->tray, s->form.width)->length;
    tn_status status = TN_OK;
    for (uint32_t z = 0; z < s->form.zone_count; z++) {
        uint32_t zone = s->form.zones[z], most = tn_survey_storeys(s, zone, true),
                 least = tn_survey_storeys(s, zone, false);
        int64_t depth = tn_tray_value_record(s->schema, s->tray, zone)->length;
        tn_cell cell = {.zone = zone, .at = {0, width, 0, depth}, .function = TN_NO_FUNCTION};
        s->widest = depth > s->widest ? depth : s->widest;
        for (; status == TN_OK && depth > 0 && cell.storey < most && !meets(s, &cell, TN_CELL_NO); cell.storey++) {
            cell.open = see_voids(s, &cell);
            status = see_cell(s, &cell, cell.storey < least, error);
        }
    }
    s->widest = width > s->widest ? width : s->widest;
    return status;
}

/* ---- forms */

tn_status tn_survey_trays(tn_survey *s, tn_error *error)
{
    const tn_form_record *form = s->form.record;
    uint64_t lines = 2 * (uint64_t)form->face_count + form->rule_count + s->end_count + 1;
    tn_status status = TN_OK;
    if ((uint64_t)s->schema->tray_count * s->form.zone_count * form->storey_count * lines > DECISIONS_MAX)
        return TN_OK;
    for (s->tray = 0; status == TN_OK && s->tray < s->schema->tray_count; s->tray++) {
        status = see_tray(s, error);
        if (status == TN_OK && tn_watch_stopped_at(s->form.module->watch, s->tray))
            status = tn_fail_stopped(s->form.module->watch, error);
    }
    sort_places(s);
    s->complete = status == TN_OK;
    return status == TN_OK ? tn_survey_faces(s, error) : status;
}

static void find_bare_functions(tn_survey *s)
{
    for (uint32_t f = 0; f < tn_form_functions(&s->form); f++) {
        uint32_t tile = 0;
        while (tile < s->form.record->tile_count && !tn_survey_serves(s, tile, f))
            tile++;
        if (tile == s->form.record->tile_count)
            add_to(s->bare_functions, f);
    }
}

/* Room for what is noted of functions, tiles and kinds of faces. */
static tn_status make_room(tn_survey *s, tn_error *error)
{
    const tn_form_record *form = s->form.record;
    size_t kinds = TN_FACE_KIND_COUNT + (size_t)form->opening_count;
    size_t stacks = (size_t)s->schema->record->field_count * form->storey_count;
    s->words = tn_form_functions(&s->form) / 64 + 1;
    s->met_words = form->face_count / 32 + 1;
    s->functions = calloc((size_t)form->rule_count + 1, sizeof *s->functions);
    s->voids = calloc((size_t)form->rule_count + 1, sizeof *s->voids);
    s->bare_functions = calloc(s->words, sizeof *s->bare_functions);
    s->may = calloc(s->words, sizeof *s->may);
    s->shelters = calloc(s->words, sizeof *s->shelters);
    s->uses = calloc(kinds, sizeof *s->uses);
    s->first_places = malloc((stacks + 1) * sizeof *s->first_places);
    if (!s->functions || !s->voids || !s->bare_functions || !s->may || !s->shelters || !s->uses || !s->first_places)
        return tn_fail_memory(error);
    for (size_t i = 0; i < stacks; i++)
        s->first_places[i] = TN_NO_PLACE;
    find_bare_functions(s);
    for (size_t i = 0; i < kinds; i++) {
        uint64_t *sets = calloc(3 * s->words, sizeof *sets);
        if (!sets)
            return tn_fail_memory(error);
        s->uses[i] = (tn_kind_use){.outside_of = sets, .between_of = sets + s->words, .under_of = sets + 2 * s->words};
    }
    return TN_OK;
}

tn_status tn_survey_begin(const tn_module *module, uint32_t form, tn_opened *opened, tn_survey **survey,
                          tn_error *error)
{
    tn_survey *s = calloc(1, sizeof *s);
    *survey = NULL;
    if (!s)
        return tn_fail_memory(error);
    s->opened = opened;
    tn_status status = tn_form_schema(module, form, &s->schema, error);
    if (status == TN_OK) {
        tn_form_ready(module, form, s->schema, &s->form);
        s->house = (tn_house){.form = &s->form, .trays = &s->tray, .length = 1};
        status = make_room(s, error);
    }
    if (status == TN_OK)
        status = tn_survey_sections(s, error);
    if (status == TN_OK)
        *survey = s;
    else
        tn_survey_free(s);
    return status;
}

tn_status tn_survey_new(const tn_module *module, uint32_t form, tn_survey **survey, tn_error *error)
{
    tn_status status = tn_survey_begin(module, form, NULL, survey, error);
    if (status == TN_OK)
        status = tn_survey_trays(*survey, error);
    if (status != TN_OK) {
        tn_survey_free(*survey);
        *survey = NULL;
    }
    return status;
}

void tn_survey_free(tn_survey *s)
{
    if (!s)
        return;
    for (size_t i = 0; i < s->class_count; i++)
        free(s->classes[i].met);
    for (size_t i = 0; i < s->place_count; i++)
        free(s->places[i].may);
    for (size_t i = 0; s->uses && i < TN_FACE_KIND_COUNT + (size_t)s->form.record->opening_count; i++)
        free(s->uses[i].outside_of);
    free(s->classes);
    free(s->links);
    free(s->ends);
    free(s->places);
    free(s->first_places);
    free(s->functions);
    free(s->voids);
    free(s->bare_functions);
    free(s->may);
    free(s->shelters);
    free(s->uses);
    free(s->with);
    tn_schema_free(s->schema);
    free(s);
}
