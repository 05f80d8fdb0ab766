/* Goes through all trays of a form's schema, and warns about what of the form comes to nothing. */
#include <stdlib.h>
#include <string.h>

#include "driver/house/survey_parts.h"
#include "runtime/base/array.h"
#include "runtime/base/length.h"
#include "runtime/house/bare.h"

#define DECISIONS_MAX 100000000u /* a second or two */

static bool decides(const tn_survey *s, uint32_t function, const tn_cell *cell)
{
    return tn_house_decide(&s->house, function, cell);
}

/* ---- classes of cells */

static tn_status add_class(tn_survey *s, const tn_cell *cell, tn_error *error)
{
    if (!tn_array_reserve_from(&s->classes, &s->class_room, 64, s->class_count, 1, sizeof *s->classes))
        return tn_fail_memory(error);
    tn_cell_class *class = &s->classes[s->class_count];
    int64_t wide = cell->at.x1 - cell->at.x0, deep = cell->at.y1 - cell->at.y0;
    *class = (tn_cell_class){cell->zone, cell->storey, cell->open, wide, deep, calloc(s->words, sizeof *class->met)};
    if (!class->met)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < s->form.record->face_count; i++) {
        const tn_face_line_record *line = &s->form.module->FACE_LINE_records[s->form.record->face_first + i];
        uint64_t first = decides(s, line->first, cell);
        uint64_t second = line->second != TN_NO_RECORD && decides(s, line->second, cell);
        class->met[i / 32] |= (first | second << 1) << 2 * (i % 32);
    }
    for (size_t i = 0; i < s->class_count; i++) {
        tn_cell_class *other = &s->classes[i];
        if (other->zone == class->zone && other->storey == class->storey && other->open == class->open &&
            memcmp(other->met, class->met, s->words * sizeof *class->met) == 0) {
            other->wide = wide > other->wide ? wide : other->wide;
            other->deep = deep > other->deep ? deep : other->deep;
            free(class->met);
            return TN_OK;
        }
    }
    s->class_count++;
    return TN_OK;
}

/* ---- tiles */

/* Did a tile come further in this room than in those before, or as far in a larger one? */
static bool is_further(const tn_tile_failure *now, const tn_tile_failure *before)
{
    if (now->obstacle != before->obstacle)
        return now->obstacle > before->obstacle;
    return (tn_int128)now->wide * now->deep > (tn_int128)before->wide * before->deep;
}

/* A side of the room has no wall, a partition or an outside wall: half of it is taken off. */
static tn_status try_sizes(tn_survey *s, uint32_t tile, const tn_cell *cell, tn_error *error)
{
    const int64_t off[] = {0, s->form.record->partition / 2, s->form.record->wall / 2};
    int64_t wide = cell->at.x1 - cell->at.x0, deep = cell->at.y1 - cell->at.y0;
    tn_tile_failure failure = {.obstacle = TN_TILE_NO_SIDE};
    tn_status status = TN_OK;
    for (int i = 0; status == TN_OK && i < 81 && failure.obstacle != TN_TILE_STANDS; i++) {
        status =
            tn_tile_fails_in(&s->form, wide - off[i % 3] - off[i / 3 % 3], deep - off[i / 9 % 3] - off[i / 27],
                             tn_form_clear(&s->form, cell->storey), s->form.record->tile_first + tile, &failure, error);
        if (status == TN_OK && is_further(&failure, &s->failures[tile]))
            s->failures[tile] = failure;
    }
    s->tiles[tile] |= failure.obstacle == TN_TILE_STANDS;
    return status;
}

static tn_status try_tiles(tn_survey *s, tn_cell *cell, tn_error *error)
{
    tn_status status = TN_OK;
    s->house.cells = cell;
    for (uint32_t i = 0; status == TN_OK && i < s->form.record->tile_count; i++)
        if (!s->tiles[i] && tn_tile_is_for(&s->house, 0, s->form.record->tile_first + i))
            status = try_sizes(s, i, cell, error);
    return status;
}

/* ---- flights */

/* The flights for which there is room in the cell, and no tile in the way. */
static void try_flights(tn_survey *s, tn_cell *cell)
{
    s->house.cells = cell;
    for (uint32_t i = 0; cell->storey + 1 < s->form.record->storey_count && i < s->form.record->opening_count; i++) {
        const tn_opening_record *flight = tn_form_flight(&s->form, TN_FACE_KIND_COUNT + i);
        const tn_face face = {.relation = TN_FACE_UNDER, .storey = cell->storey, .at = cell->at};
        s->climbs[i] |= flight && tn_flight_fits(&s->house, &face, flight);
    }
}

/* ---- cells */

/* How many storeys a zone has in some section, or in every one. */
static uint32_t storeys_of(const tn_survey *s, uint32_t zone, bool most)
{
    const tn_form_record *record = s->form.record;
    for (uint32_t i = 0; i < record->choice_count; i++) {
        const tn_choice_record *choice = tn_form_choice(&s->form, i);
        if (choice->kind != TN_CHOICE_STOREYS || choice->zone != s->schema->record->field_first + zone)
            continue;
        uint32_t found = s->form.module->SHAPE_records[choice->shape_first].storeys;
        for (uint32_t k = 1; k < choice->shape_count; k++) {
            uint32_t other = s->form.module->SHAPE_records[choice->shape_first + k].storeys;
            found = (other > found) == most ? other : found;
        }
        return found;
    }
    return record->storey_count;
}

static bool meets(const tn_survey *s, const tn_cell *cell, tn_cell_rule_kind kind)
{
    for (uint32_t i = s->form.kinds_end[kind - 1]; i < s->form.kinds_end[kind]; i++)
        if (decides(s, tn_form_rule(&s->form, i)->decides, cell))
            return true;
    return false;
}

/* A cell with each function that it may have. `surely`: is it there in every section? */
static tn_status see_cell(tn_survey *s, tn_cell *cell, bool surely, tn_error *error)
{
    bool any = false;
    tn_status status = TN_OK;
    if (cell->open)
        return add_class(s, cell, error);
    for (uint32_t f = 0; status == TN_OK && f < tn_form_functions(&s->form); f++) {
        if (!tn_cell_may(&s->house, cell, f))
            continue;
        any = s->functions[f] = true;
        cell->function = f;
        status = add_class(s, cell, error);
        if (status == TN_OK)
            status = try_tiles(s, cell, error);
        try_flights(s, cell);
    }
    cell->function = TN_NO_FUNCTION;
    if (!any && surely && !s->bare) {
        s->bare = true;
        s->bare_cell = *cell;
        s->bare_tray = s->tray;
    }
    return status;
}

static tn_status see_tray(tn_survey *s, tn_error *error)
{
    int64_t width = tn_tray_value_record(s->schema, s->tray, s->form.width)->length;
    tn_status status = TN_OK;
    for (uint32_t z = 0; z < s->form.zone_count; z++) {
        uint32_t zone = s->form.zones[z], most = storeys_of(s, zone, true), least = storeys_of(s, zone, false);
        int64_t depth = tn_tray_value_record(s->schema, s->tray, zone)->length;
        tn_cell cell = {.zone = zone, .at = {0, width, 0, depth}, .function = TN_NO_FUNCTION};
        s->widest = depth > s->widest ? depth : s->widest;
        for (; status == TN_OK && depth > 0 && cell.storey < most && !meets(s, &cell, TN_CELL_NO); cell.storey++) {
            cell.open = cell.storey > 0 && meets(s, &cell, TN_CELL_VOID);
            status = see_cell(s, &cell, cell.storey < least, error);
        }
    }
    s->widest = width > s->widest ? width : s->widest;
    return status;
}

/* ---- what is said */

static void warn_functions(const tn_survey *s)
{
    for (uint32_t f = 0; f < tn_form_functions(&s->form); f++) {
        const tn_cell_rule_record *rule = tn_form_rule(&s->form, f);
        if (s->functions[f] || tn_survey_allows(s, W_FUNCTION_NEVER, TN_SURVEY_SPAN(rule)))
            continue;
        tn_diagnostic *d = tn_report(tn_survey_list(s), W_FUNCTION_NEVER, TN_SURVEY_SPAN(rule),
                                     "no cell may have the function `%s`", tn_text(s->form.module, rule->name));
        tn_help(tn_survey_list(s), d, "no one cell meets all items after `at` and is kept by every `void` and `no`");
    }
}

static tn_status warn_bare(const tn_survey *s, tn_error *error)
{
    const tn_form_record *form = s->form.record;
    tn_buffer line = {0};
    if (!s->bare || tn_form_functions(&s->form) == 0 || tn_survey_allows(s, W_NO_FUNCTION, TN_SURVEY_SPAN(form)))
        return TN_OK;
    bool ok = tn_plan_write_line(s->schema, &s->bare_tray, 1, &line);
    tn_diagnostic *d = tn_report(
        tn_survey_list(s), W_NO_FUNCTION, TN_SURVEY_SPAN(form),
        "form `%s`: no function may take the %s in storey `%s` of some trays", tn_text(s->form.module, form->name),
        tn_text(s->form.module, s->schema->fields[s->bare_cell.zone].name),
        tn_text(s->form.module, s->form.module->STOREY_records[form->storey_first + s->bare_cell.storey].name));
    tn_note(tn_survey_list(s), d, NULL, "this plan has no house: %s", ok ? line.data : "");
    tn_help(tn_survey_list(s), d, "add a function for such cells; or say that they are not there: `no cell(...)`");
    free(line.data);
    return ok ? TN_OK : tn_fail_memory(error);
}

static void warn_tiles(const tn_survey *s)
{
    for (uint32_t i = 0; i < s->form.record->tile_count; i++) {
        const tn_tile_record *tile = &s->form.module->TILE_records[s->form.record->tile_first + i];
        if (s->tiles[i] || tn_survey_allows(s, W_TILE_NEVER, TN_SURVEY_SPAN(tile)))
            continue;
        tn_diagnostic *d = tn_report(tn_survey_list(s), W_TILE_NEVER, TN_SURVEY_SPAN(tile),
                                     "tile `%s` fits into no cell", tn_text(s->form.module, tile->name));
        char why[4 * TN_NAME_MAX];
        tn_tile_failure_text(&s->form, &s->failures[i], why, sizeof why);
        if (s->failures[i].obstacle > TN_TILE_NO_SIDE)
            tn_note(tn_survey_list(s), d, NULL, "where it comes furthest, %s", why);
        if (s->failures[i].obstacle == TN_TILE_MEETS_BOX)
            tn_help(tn_survey_list(s), d, "items of a tile may not overlap, nor be in what it keeps free");
        else
            tn_help(tn_survey_list(s), d,
                    "make its boxes, or its `wide` and `deep`, smaller: they must fit between the walls of a room, "
                    "beside each other");
    }
}

bool tn_survey_names(const tn_survey *s, uint32_t kind)
{
    const tn_module *module = s->form.module;
    for (uint32_t i = 0; i < s->form.record->face_count; i++) {
        const tn_face_line_record *line = &module->FACE_LINE_records[s->form.record->face_first + i];
        for (uint32_t k = 0; k < line->kind_count; k++)
            if (module->HOUSE_ITEM_records[line->kind_first + k].number == kind)
                return true;
    }
    return false;
}

static void warn_opening(const tn_survey *s, uint32_t number)
{
    const tn_opening_record *opening = &s->form.module->OPENING_records[s->form.record->opening_first + number];
    const char *name = tn_text(s->form.module, opening->name);
    bool flight = tn_form_flight(&s->form, TN_FACE_KIND_COUNT + number);
    bool named = tn_survey_names(s, TN_FACE_KIND_COUNT + number);
    bool wider = opening->wide + s->form.record->wall > s->widest;
    if ((named && !wider && s->used[TN_FACE_KIND_COUNT + number]) ||
        tn_survey_allows(s, W_OPENING_NEVER, TN_SURVEY_SPAN(opening)))
        return;
    tn_diagnostic *d = tn_report(tn_survey_list(s), W_OPENING_NEVER, TN_SURVEY_SPAN(opening),
                                 !named   ? "no face has the opening `%s`"
                                 : flight ? "no face can have the flight `%s`"
                                 : wider  ? "opening `%s` is wider than every face"
                                          : "no face can have the opening `%s`",
                                 name);
    if (!named)
        tn_help(tn_survey_list(s), d, "name it in a line such as `face cell(any) %s = %s`",
                flight ? "under cell(any)" : "outside", name);
    else if (flight)
        tn_help(tn_survey_list(s), d, TN_FLIGHT_NEEDS);
    else
        tn_help(tn_survey_list(s), d,
                wider ? "a face has to be as wide as the opening and a `wall` added"
                      : "the faces of the lines that name it are narrower than it and a `wall` added, or lower, or "
                        "lines before these decide them");
}

/* ---- forms */

static tn_status see_all(tn_survey *s, tn_error *error)
{
    const tn_form_record *form = s->form.record;
    uint64_t lines = 2 * (uint64_t)form->face_count + form->rule_count + 1;
    tn_status status = TN_OK;
    if ((uint64_t)s->schema->tray_count * s->form.zone_count * form->storey_count * lines > DECISIONS_MAX)
        return TN_OK;
    for (s->tray = 0; status == TN_OK && s->tray < s->schema->tray_count; s->tray++)
        status = see_tray(s, error);
    if (status != TN_OK)
        return status;
    warn_functions(s);
    warn_tiles(s);
    status = warn_bare(s, error);
    if (status == TN_OK)
        status = tn_survey_faces(s, error);
    for (uint32_t i = 0; status == TN_OK && i < form->opening_count; i++)
        warn_opening(s, i);
    return status;
}

static tn_status survey(tn_opened *opened, uint32_t index, tn_error *error)
{
    const tn_module *module = opened->module;
    const tn_form_record *form = &module->FORM_records[index];
    tn_survey s = {.opened = opened, .words = form->face_count / 32 + 1};
    tn_status status = tn_schema_new(module, form->schema, 0, &s.schema, error);
    if (status == TN_LIMIT)
        return TN_OK; /* said of the schema */
    if (status != TN_OK)
        return status;
    tn_form_ready(module, index, s.schema, &s.form);
    s.house = (tn_house){.form = &s.form, .trays = &s.tray, .length = 1};
    s.functions = calloc((size_t)form->rule_count + 1, sizeof *s.functions);
    s.tiles = calloc((size_t)form->tile_count + 1, sizeof *s.tiles);
    s.failures = calloc((size_t)form->tile_count + 1, sizeof *s.failures);
    s.climbs = calloc((size_t)form->opening_count + 1, sizeof *s.climbs);
    s.used = calloc(TN_FACE_KIND_COUNT + (size_t)form->opening_count, sizeof *s.used);
    status = s.functions && s.tiles && s.failures && s.climbs && s.used ? tn_survey_sections(&s, error)
                                                                        : tn_fail_memory(error);
    if (status == TN_OK)
        status = see_all(&s, error);
    for (size_t i = 0; i < s.class_count; i++)
        free(s.classes[i].met);
    free(s.classes);
    free(s.functions);
    free(s.tiles);
    free(s.failures);
    free(s.climbs);
    free(s.used);
    tn_schema_free(s.schema);
    return status;
}

tn_status tn_house_survey(tn_opened *opened, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && opened->compiled && i < opened->module->FORM_count; i++)
        if (!(opened->module->FORM_records[i].flags & TN_IMPORTED))
            status = survey(opened, i, error);
    return status;
}
